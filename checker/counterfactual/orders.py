"""The lines of a rule in; out: whether a relation of two tokens says the contrary of what a limit between them says.

`turn.start <= out.end + PAUSE_MAX;` counts from the end of `out`: so `out` comes first, whatever `before` says.
"""

import re
from collections import defaultdict
from collections.abc import Sequence

from checker.mutation.edits import EditSite, SmallEdit, inverse_of
from checker.mutation.kinds import EditKind

_LATER = re.compile(r"\s*(\w+)\.start\s*[<>]=?\s*(\w+)\.end\b.*;", re.DOTALL)
_SINCE_START = re.compile(r"\s*(\w+)\.start\s*<=?\s*(\w+)\.start\s*\+.*;", re.DOTALL)
_ORDERED = re.compile(r"\s*(\w+)\s+(before|after|meets|met_by)\s+(\w+)\s*;")
_WAIT = re.compile(r"\s*(\w+)\.end\b[^<>=]*<=?\s*(\w+)\.start\b[^<>=]*;", re.DOTALL)
_WAITED = re.compile(r"\s*(\w+)\.start\b[^<>=]*>=?\s*(\w+)\.end\b[^<>=]*;", re.DOTALL)
_MADE = re.compile(r"(?:contains|starts|ends|any)\s*\(\s*[\w.]+\s+(\w+)\s*\)")
_TURNED = ("after", "met_by")
_HOLDING = ("contains", "ends", "equals")  # the end of the other token is within the own one


class Orders:
    """Of each rule, which of two tokens comes first by the limits on the time between them."""

    def __init__(self, sites: Sequence[EditSite]) -> None:
        self._first: dict[object, set[tuple[str, str]]] = defaultdict(set)
        self._related: dict[object, set[tuple[str, str]]] = defaultdict(set)  # by relations
        self._made: dict[object, list[str]] = defaultdict(list)  # the tokens that it asks for, as it names them
        for site in sites:
            if site.rule and (order := _order(site.text)) is not None:
                self._join(self._related[site.file, site.scope], *order)
            if site.rule and (made := _MADE.match(site.text)):
                self._made[site.file, site.scope].append(made.group(1))
            if site.rule and (found := _LATER.fullmatch(site.text)):
                self._first[site.file, site.scope].add((found.group(2), found.group(1)))

    @staticmethod
    def _join(related: set[tuple[str, str]], first: str, second: str) -> None:
        """Note that a token comes before another one, and what follows from that."""
        before = {first, *(one for one, other in related if other == first)}
        after = {second, *(other for one, other in related if one == second)}
        related |= {(one, other) for one in before for other in after}

    def as_written(self, edit: SmallEdit, site: EditSite) -> int:
        """1 where a line has two tokens in the order then in which the rule asks for them, -1 if it had before."""
        before, after = (_order(text) or _order_by_times(text) for text in (site.text, site.after(edit)))
        if before is None or after is None or before == after:
            return 0
        made = self._made[site.file, site.scope]
        if not {*before, *after} <= set(made):
            return 0
        return (made.index(after[0]) < made.index(after[1])) - (made.index(before[0]) < made.index(before[1]))

    def rights(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether a relation says the same as such a limit after an edit, and said the contrary before."""
        known = self._first.get((site.file, site.scope), ())
        before, after = (_order(text) for text in (site.text, site.after(edit)))
        return before is not None and after in known and before[::-1] == after and before not in known

    def denies(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether a relation says the contrary of such a limit after an edit, and said the same before."""
        known = self._first.get((site.file, site.scope), ())
        before, after = (_order(text) for text in (site.text, site.after(edit)))
        return before is not None and before in known and before[::-1] == after

    def counts_from_end(self, edit: SmallEdit, site: EditSite) -> bool:
        """Whether the wait of a token for the one before it counts from the end of that one after an edit.

        From its start counts how long both take together, and few limit that by the start of the second.
        """
        before, after = _SINCE_START.fullmatch(site.text), _LATER.fullmatch(site.after(edit))
        if before is None or after is None or before.groups() != after.groups():
            return False
        return before.groups()[::-1] in self._related.get((site.file, site.scope), ())


def lets_go(edit: SmallEdit, site: EditSite) -> bool:
    """Whether a token need not go on any more until one that it asks for is over: `contained_by` for `contains`."""
    is_own = edit.kind is EditKind.RELATION and edit.begin == site.begin
    return is_own and edit.old in _HOLDING and edit.new not in (*_HOLDING, "any")


def is_order_turned(edit: SmallEdit, site: EditSite) -> bool:
    """Whether a relation of two named tokens, or a limit of their times, says the same with the tokens swapped."""
    is_between = edit.kind is EditKind.RELATION and edit.begin > site.begin
    return edit.kind is EditKind.TURN or (is_between and edit.new == inverse_of(edit.old) != edit.old)


def _order_by_times(text: str) -> tuple[str, str] | None:
    """Two tokens, the one first after whose end the other one begins."""
    if (found := _WAIT.fullmatch(text)) is not None:
        return found.group(1), found.group(2)
    return (found.group(2), found.group(1)) if (found := _WAITED.fullmatch(text)) is not None else None


def _order(text: str) -> tuple[str, str] | None:
    """Two tokens, the one that a relation has first before the other."""
    found = _ORDERED.fullmatch(text)
    if found is None:
        return None
    one, relation, other = found.groups()
    return (other, one) if relation in _TURNED else (one, other)
