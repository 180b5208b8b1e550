"""The lines of a rule in; out: whether a line says of one axis what a line beside it says of another.

After `carry.dx == bx - ax;` comes `carry.dy == by - ay;`: where `bx` stands in the second line, `by` is meant.
"""

import re
from collections import defaultdict
from collections.abc import Iterator, Sequence

from checker.mutation.edits import EditSite, SmallEdit

_TOKEN = re.compile(r"[A-Za-z_]\w*|\d[\w.]*|[^\s\w]+")
_LEAST = 2  # words that change together

_Words = tuple[str, ...]


class Siblings:
    """What each line of a rule would be if it were written as another one, with the end of all words changed alike."""

    def __init__(self, sites: Sequence[EditSite]) -> None:
        self._of: dict[object, list[_Words]] = defaultdict(list)
        for site in sites:
            if site.rule and not site.is_rule:
                line = _words(site.text)
                self._of[site.file, site.scope, _stems(line)].append(line)

    def completes(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether a line is a sibling of another one after an edit, and is none before."""
        before, after = _words(site.text), _words(site.after(edit))
        if not self._is_sibling(after, site, before):
            return False
        return len(before) != len(after) or not self._is_sibling(before, site, before)

    def _is_sibling(self, line: _Words, site: EditSite, own: _Words) -> bool:
        """Whether words are a sibling of a line of the rule that is not written as `own`."""
        others = self._of.get((site.file, site.scope, _stems(line)), ())
        return any(line in _siblings(one, line) for one in others if one != own)


def _words(text: str) -> _Words:
    return tuple(_TOKEN.findall(text))


def _stems(line: _Words) -> _Words:
    """A line without the last letter of each word, which siblings have in common."""
    return tuple(one[:-1] if _is_word(one) else one for one in line)


def _is_word(token: str) -> bool:
    return token[0].isalpha() or token[0] == "_"


def _siblings(line: _Words, like: _Words) -> Iterator[_Words]:
    """A line with the last letter of words changed as it differs from another line where both first differ."""
    pair = next(((one, other) for one, other in zip(line, like, strict=False) if one != other), None)
    if pair is not None and len(pair[0]) == len(pair[1]) and pair[0][:-1] == pair[1][:-1]:
        old, new = (one[-1].lower() for one in pair)
        named = [one for one in line if one[-1].lower() == old and _is_word(one)]
        if len(named) >= _LEAST:
            yield tuple(one[:-1] + _like(new, one[-1]) if one in named else one for one in line)


def _like(letter: str, other: str) -> str:
    """A letter in the case of another one."""
    return letter.upper() if other.isupper() else letter
