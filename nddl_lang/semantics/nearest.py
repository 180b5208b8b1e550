"""Find the known name that a mistyped one was meant to be."""

from collections.abc import Iterable


def nearest(name: str, candidates: Iterable[str]) -> str | None:
    """The candidate that differs least from `name`, the first of several; None where all differ too much."""
    limit = max(1, len(name) // 3)
    folded = name.casefold()
    best: str | None = None
    best_distance = limit + 1
    for candidate in candidates:
        if candidate == name or abs(len(candidate) - len(name)) >= best_distance:
            continue
        other = candidate.casefold()
        distance = 0 if other == folded else _distance(folded, other, best_distance - 1)
        if distance < best_distance:
            best, best_distance = candidate, distance
    return best


def _distance(one: str, other: str, limit: int) -> int:
    """Insertions, deletions, replacements and swaps of neighbours from `one` to `other`, or more than `limit`."""
    if one[:1] != other[:1] and one[1:2] != other[1:2] and one[-1:] != other[-1:]:
        return limit + 1
    before: list[int] = []
    previous = list(range(len(other) + 1))
    for i, letter in enumerate(one, 1):
        current = [i]
        for j, match in enumerate(other, 1):
            cost = min(previous[j] + 1, current[j - 1] + 1, previous[j - 1] + (letter != match))
            if i > 1 and j > 1 and letter == other[j - 2] and one[i - 2] == match:
                cost = min(cost, before[j - 2] + 1)
            current.append(cost)
        if min(current) > limit:
            return limit + 1
        before, previous = previous, current
    return previous[-1]
