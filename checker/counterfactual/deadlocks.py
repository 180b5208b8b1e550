"""A search that failed in; out: the lines of which one must be wrong, as they contradict each other in any world.

Each choice that was tried is ruled out by a conflict. z3 leaves of it what the contradiction needs. Where no draw,
observation or request is needed, only a change of these lines lets the search find anything.
"""

from checker.causes import Failed
from checker.proofs.conflict import Finding, confirm
from checker.proofs.places import ModelText
from runtime.executive.outcome import Conflict, ElementKind, SourcePlace

_MOST_CONFLICTS = 6
_EFFORT = 4_000_000  # of z3, for each
_WORLD = (ElementKind.OBSERVATION, ElementKind.REQUEST, ElementKind.SAMPLE, ElementKind.SHARED_END)


def lines_at_odds(failed: Failed, text: ModelText) -> frozenset[SourcePlace]:
    """The lines of the contradictions; none where something else may have a part in them."""
    conflicts = list(dict.fromkeys(failed.deadlock.conflicts())) if failed.deadlock is not None else []
    if len(conflicts) > _MOST_CONFLICTS:
        return frozenset()
    found: set[SourcePlace] = set()
    for conflict in conflicts:
        needed = _needed(conflict, text)
        if needed is None or any(conflict.elements[number].kind in _WORLD for number in needed):
            return frozenset()
        found |= {place for number in needed if (place := conflict.elements[number].place) is not None}
    return frozenset(found)


def _needed(conflict: Conflict, text: ModelText) -> tuple[int, ...] | None:
    """The elements that z3 needs, all where it does not know; None where what it was not told may have a part."""
    answer = confirm(conflict, text, _EFFORT)
    if answer.untranslated:
        return None
    return answer.core if answer.finding is Finding.CONFIRMED else tuple(range(len(conflict.elements)))
