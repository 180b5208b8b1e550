"""Edits that wait for a trial, the likeliest first; what a trial tells of one line changes the turn of others.

Where a change of a line has helped, the mistake is at that line or at one that hangs together with it by a variable:
`REPORT_AFTER` ten times as large helps where `take.start` is written for `take.end` beside it. Where a change left the
failure as it was, to the last event, the line has no part in it. What was given up as it took too long elsewhere waits.
"""

import heapq
from collections import Counter
from collections.abc import Callable, Collection
from itertools import count

from checker.counterfactual.candidates import Candidate
from checker.counterfactual.numbers import is_raised
from checker.counterfactual.word_odds import is_comparison_turned
from checker.mutation.edits import EditSite, SmallEdit, inverse_of
from checker.mutation.kinds import NUMBERS, EditKind

_BESIDE = 0.5  # how much of the wait is left for an edit of a line beside one that has helped
_IDLE = 0.8  # how much later the edits of a line are tried that has no part in the failure
_MOST_VAIN, _TIRED = 5, 0.1  # edits of one line in vain, and how much later the others are tried for each more
_ENDLESS = 3.0  # how much later what may leave a search without an end, as it did elsewhere

_COMPUTING = (EditKind.FORMULA, EditKind.OPERATOR, EditKind.SIGN)

_Entry = tuple[float, int, Candidate, SmallEdit]


class Turns:
    """A queue whose order changes; `beside` tells the lines that hang together with one."""

    def __init__(self, beside: Callable[[EditSite], Collection[EditSite]]) -> None:
        self._beside = beside
        self._queue: list[_Entry] = []
        self._order = count()
        self._vain: Counter[EditSite] = Counter()
        self._favoured: set[EditSite] = set()
        self._encouraged: set[EditSite] = set()
        self._doubted: set[tuple[EditSite, int | None]] = set()

    def __bool__(self) -> bool:
        return bool(self._queue)

    def add(self, at: float, candidate: Candidate, edit: SmallEdit) -> None:
        """Let an edit wait until `at`."""
        heapq.heappush(self._queue, (at, next(self._order), candidate, edit))

    def pop(self) -> tuple[float, Candidate, SmallEdit]:
        """The edit whose turn it is."""
        at, _, candidate, edit = heapq.heappop(self._queue)
        return at, candidate, edit

    def favour(self, site: EditSite) -> None:
        """Try the lines beside one that has helped sooner."""
        new = set(self._beside(site)) - self._favoured
        self._favoured |= new
        self._hasten(new)

    def encourage(self, site: EditSite) -> None:
        """Try the other edits of a line sooner of which one let the mission come farther."""
        self._hasten({site} - self._encouraged)
        self._encouraged.add(site)

    def turn_round(self, site: EditSite, worse: SmallEdit) -> None:
        """Try a number the other way sooner of which a change one way has made it worse, and further that way later."""

        def is_same(candidate: Candidate, edit: SmallEdit) -> bool:
            return candidate.site is site and edit.begin == worse.begin and edit.kind in NUMBERS

        self._move(self._sooner, lambda one, edit: is_same(one, edit) and is_raised(edit) != is_raised(worse))
        self._delay(_IDLE, lambda one, edit: is_same(one, edit) and is_raised(edit) == is_raised(worse))

    def doubt(self, site: EditSite, place: int | None) -> None:
        """Try what else may stand at a place of a line later; at any of its places where none is given.

        But for a relation or comparison the other way round: a planner that is free may choose as it had to. And of a
        condition each value takes the branch for others.
        """
        if (site, place) not in self._doubted and (site, None) not in self._doubted:
            self._doubted.add((site, place))
            is_case = place is not None and not site.text.endswith(";")
            self._delay(
                _IDLE,
                lambda candidate, edit: (
                    candidate.site is site
                    and _is_doubtful(edit, place)
                    and not (is_case and edit.kind is EditKind.VALUE)
                ),
            )

    def tire(self, site: EditSite) -> None:
        """Try the other edits of a line later of which many were in vain: lines that were not tried have their turn."""
        self._vain[site] += 1
        if self._vain[site] > _MOST_VAIN:
            self._delay(_TIRED, lambda candidate, _: candidate.site is site)

    def avoid(self, lost: SmallEdit) -> None:
        """Try what else writes a word later that left a flight without an end: it costs as much as many others."""
        self._delay(_ENDLESS, lambda _, edit: edit.kind is lost.kind and edit.new == lost.new)

    def _hasten(self, sites: Collection[EditSite]) -> None:
        self._move(self._sooner, lambda candidate, _: candidate.site in sites)

    @staticmethod
    def _sooner(at: float) -> float:
        return at * _BESIDE if at > 0.0 else at

    def _delay(self, wait: float, concerns: Callable[[Candidate, SmallEdit], bool]) -> None:
        self._move(lambda at: at + wait, concerns)

    def _move(self, to: Callable[[float], float], concerns: Callable[[Candidate, SmallEdit], bool]) -> None:
        self._queue = [
            (to(at) if concerns(candidate, edit) else at, number, candidate, edit)
            for at, number, candidate, edit in self._queue
        ]
        heapq.heapify(self._queue)


def _is_doubtful(edit: SmallEdit, place: int | None) -> bool:
    if place is not None and (edit.kind in _COMPUTING or edit.kind is EditKind.SETTING):
        return False  # a quotient is small where a product is large; and which way Python is better off is not known
    is_turned = is_comparison_turned(edit) or (edit.kind is EditKind.RELATION and edit.new == inverse_of(edit.old))
    return place in (None, edit.begin) and not is_turned
