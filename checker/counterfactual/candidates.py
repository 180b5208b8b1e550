"""A failed mission in, the lines out that may be the mistaken one, the likeliest first.

Three sources: the conflict that ended it (and those of what was tried and repaired before), what is said of tokens and
goals that found no place, and, by the dependence graph, the lines that bear on these. Lines of rules whose predicate
never held or was never asked for in the mission come after all others.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from checker.causes import culprit_of, failed_by
from checker.counterfactual.dependence import Dependence
from checker.mutation.edits import EditSite
from nddl_lang.text.read import real_path
from runtime.executive.outcome import Conflict, Deadlock, EventKind, Outcome, SourcePlace

_CULPRIT, _CONFLICT, _LOG, _EVENT, _NAMED = 0.0, 0.25, 0.5, 1.0, 1.5
_UNSEEN = 4.0  # added for lines of a rule that nothing fired


class Suspicion(StrEnum):
    """What made a line a candidate."""

    CONFLICT = "conflict"
    SEARCH = "failure log"
    TRACE = "trace"  # a repair, a refusal or a rejection on the way
    DEPENDENCE = "dependence"


@dataclass(frozen=True, eq=False, slots=True)
class Candidate:
    """A site that is worth a trial: `far` from what ended the mission, by lines that hang together."""

    site: EditSite
    far: float
    source: Suspicion


def candidates_of(outcome: Outcome, graph: Dependence, root: Path) -> list[Candidate]:
    """All lines that can have a part in it, the nearest first."""
    roots: dict[int, tuple[float, Suspicion]] = {}

    def note(place: SourcePlace | None, far: float, source: Suspicion) -> None:
        if place is not None:
            for number in graph.at(str(real_path(root / place.file)), place.line):
                if number not in roots or far < roots[number][0]:
                    roots[number] = (far, source)

    conflict = failed_by(outcome).conflict
    culprit = culprit_of(conflict)
    for place in (culprit.place, *culprit.limits):
        note(place, _CULPRIT, Suspicion.CONFLICT)
    for place, far, source in _named(outcome, conflict):
        note(place, far, source)
    for predicate in _predicates(outcome):
        for number in graph.of_predicate(predicate):
            roots.setdefault(number, (_NAMED, Suspicion.TRACE))
    distances = graph.distances({number: far for number, (far, _) in roots.items()})
    seen = _held(outcome)
    found = []
    for number, site in enumerate(graph.sites):
        if number not in distances:
            continue
        far, source = roots.get(number, (0.0, Suspicion.DEPENDENCE))
        is_unseen = bool(site.rule) and site.rule.rpartition(".")[2] not in seen
        found.append(Candidate(site, distances[number] + _UNSEEN * is_unseen, source))
    return sorted(found, key=lambda one: one.far)


def _named(outcome: Outcome, conflict: Conflict | None) -> Iterator[tuple[SourcePlace | None, float, Suspicion]]:
    """The places that the outcome names, how near each is, and where it stands."""
    for element in conflict.elements if conflict is not None else ():
        yield element.place, _CONFLICT, Suspicion.CONFLICT
    if outcome.abort is not None:
        for each in outcome.abort.repairs:
            yield from _places(each, _CONFLICT, Suspicion.CONFLICT)
        yield from _logged(outcome.abort.deadlock)
    for goal in outcome.open_goals:
        yield from _places(goal.conflict, _CONFLICT, Suspicion.CONFLICT)
        yield from _logged(goal.deadlock)
    for event in outcome.events:
        if event.kind in (EventKind.RELAX, EventKind.REJECT, EventKind.REFUSE, EventKind.KILL):
            yield from _places(event.conflict, _EVENT, Suspicion.TRACE)
            yield from _logged(event.deadlock, _EVENT)


def _logged(deadlock: Deadlock | None, far: float = _LOG) -> Iterator[tuple[SourcePlace | None, float, Suspicion]]:
    for conflict in deadlock.conflicts() if deadlock is not None else ():
        yield from _places(conflict, far, Suspicion.SEARCH)


def _places(
    conflict: Conflict | None, far: float, source: Suspicion
) -> Iterator[tuple[SourcePlace | None, float, Suspicion]]:
    for element in conflict.elements if conflict is not None else ():
        yield element.place, far, source


def _predicates(outcome: Outcome) -> set[str]:
    """The predicates of what ended the mission, or of what it left open."""
    found = {goal.predicate for goal in outcome.open_goals}
    reason = outcome.abort.reason if outcome.abort is not None else None
    while reason is not None:
        found |= {reason.predicate, reason.token.predicate.rpartition(".")[2] if reason.token is not None else ""}
        reason = reason.because
    return found - {""}


def _held(outcome: Outcome) -> set[str]:
    """The predicates, without their classes, of all that was observed or asked for, and of what the conflicts name."""
    found = {event.predicate for event in outcome.events}
    found |= _predicates(outcome)
    conflict = failed_by(outcome).conflict
    for element in conflict.elements if conflict is not None else ():
        found.add(element.rule.rpartition(".")[2])
    return found
