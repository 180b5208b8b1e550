"""Find the known name that a mistyped one was meant to be."""

from collections.abc import Iterable

_MOST_SLIPS = 3
_SHORTENED = 3
_MOST_COMPARED = 150  # names that look alike; so that a thousand complaints stay quick


def nearest(name: str, candidates: Iterable[str]) -> str | None:
    """The candidate that differs least from `name`; None where all differ too much.

    A slip is a letter put in, left out or replaced, or two neighbours swapped; capitals are none. Of several the one
    of the same letters is taken, then the one that begins most alike, that ends most alike, that is in capitals where
    `name` is, and then the first.
    """
    limit = min(max(1, len(name) // 3), _MOST_SLIPS)
    folded = name.casefold()
    best: str | None = None
    best_distance, best_likeness = limit, (False, -1, -1, False)
    letters, compared = set(folded), 0
    for candidate in candidates:
        if candidate == name or abs(len(candidate) - len(name)) > best_distance or compared >= _MOST_COMPARED:
            continue
        other = candidate.casefold()
        # A slip changes at most two of the letters that occur.
        if len(letters.symmetric_difference(other)) > 2 * limit:
            continue
        compared += 1
        distance = 0 if other == folded else _distance(folded, other, best_distance)
        if distance > best_distance:
            continue
        same_letters = sorted(folded) == sorted(other)
        ends = _common(folded[::-1], other[::-1])
        likeness = (same_letters, _common(folded, other), ends, candidate.isupper() == name.isupper())
        if distance < best_distance or likeness > best_likeness:
            best, best_distance, best_likeness = candidate, distance, likeness
    return best


def begun(name: str, candidates: Iterable[str]) -> str | None:
    """The only candidate that begins with `name`, which was cut short; None for a name of one or two letters."""
    folded = name.casefold()
    found = {each for each in candidates if each != name and each.casefold().startswith(folded)}
    return found.pop() if len(found) == 1 and len(name) >= _SHORTENED else None


def _common(one: str, other: str) -> int:
    """How many letters both begin with."""
    count = 0
    for a, b in zip(one, other, strict=False):
        if a != b:
            break
        count += 1
    return count


def _distance(one: str, other: str, limit: int) -> int:
    """Insertions, deletions, replacements and swaps of neighbours from `one` to `other`, or more than `limit`."""
    shorter = min(len(one), len(other))
    start = _common(one, other)
    end = 0
    while end < shorter - start and one[-1 - end] == other[-1 - end]:
        end += 1
    if start == end == 0 and one[1:2] != other[1:2] and one[:2] != other[1::-1]:
        return limit + 1
    one, other = one[start : len(one) - end], other[start : len(other) - end]
    # Only cells within `limit` of the diagonal can lead to an answer.
    far = limit + 1
    before: list[int] = []
    previous = [min(column, far) for column in range(len(other) + 1)]
    for i, letter in enumerate(one, 1):
        first, last = max(1, i - limit), min(len(other), i + limit)
        current = [far] * (len(other) + 1)
        current[first - 1] = i if first == 1 else far
        least = current[first - 1]
        for j in range(first, last + 1):
            cost = min(previous[j], current[j - 1]) + 1
            if previous[j - 1] + (letter != other[j - 1]) < cost:
                cost = previous[j - 1] + (letter != other[j - 1])
            if i > 1 and j > 1 and letter == other[j - 2] and one[i - 2] == other[j - 1]:
                cost = min(cost, before[j - 2] + 1)
            current[j] = cost
            least = min(least, cost)
        if least > limit:
            return far
        before, previous = previous, current
    return previous[-1]
