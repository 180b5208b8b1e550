"""The lines of a rule in; out: whether a line says of one axis what a line beside it says of another.

After `carry.dx == bx - ax;` comes `carry.dy == by - ay;`: where `bx` stands in the second line, `by` is meant.
"""

import re
from collections import defaultdict
from collections.abc import Iterator, Sequence

from checker.mutation.edits import EditSite, SmallEdit

_TOKEN = re.compile(r"[A-Za-z_]\w*|\d[\w.]*|[^\s\w]+")
_LEAST = 2  # words that change together


class Siblings:
    """What each line of a rule would be if it were written as another one, with the end of all words changed alike."""

    def __init__(self, sites: Sequence[EditSite]) -> None:
        self._of: dict[object, list[tuple[str, ...]]] = defaultdict(list)
        for site in sites:
            if site.rule and not site.is_rule:
                self._of[site.file, site.scope].append(tuple(_TOKEN.findall(site.text)))

    def completes(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether a line is a sibling of another one after an edit, and is none before."""
        before, after = (tuple(_TOKEN.findall(text)) for text in (site.text, site.after(edit)))
        others = [one for one in self._of[site.file, site.scope] if len(one) == len(after) and one != before]
        return any(after in _siblings(one, after) for one in others) and not any(
            before in _siblings(one, before) for one in others
        )


def _siblings(line: tuple[str, ...], like: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
    """A line with the last letter of words changed as it differs from another line where both first differ."""
    pair = next(((one, other) for one, other in zip(line, like, strict=False) if one != other), None)
    if pair is not None and len(pair[0]) == len(pair[1]) and pair[0][:-1] == pair[1][:-1]:
        old, new = (one[-1].lower() for one in pair)
        named = [one for one in line if one[-1].lower() == old and (one[0].isalpha() or one[0] == "_")]
        if len(named) >= _LEAST:
            yield tuple(one[:-1] + _like(new, one[-1]) if one in named else one for one in line)


def _like(letter: str, other: str) -> str:
    """A letter in the case of another one."""
    return letter.upper() if other.isupper() else letter
