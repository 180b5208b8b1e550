"""A failed mission in, the lines out that may be the mistaken one, the likeliest first.

Four sources: the conflict that ended it (and those of what was tried and repaired before), what is said of tokens and
goals that found no place, rules and branches that passing missions do not reach, and, by the dependence graph, the
lines that bear on these. Where a property was violated, or a reactor ended without a conflict, what was observed there
stands for them. Lines of rules whose predicate never held, nor was asked for in the mission, come after all others.
"""

import math
import re
from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path

from checker.causes import ANSWERS, Failed, dead_ends, failed_by, in_common, refusals
from checker.counterfactual.deadlocks import lines_at_odds
from checker.counterfactual.dependence import Dependence
from checker.counterfactual.promises import first_violated, forbids_values, promised_levels
from checker.counterfactual.python_ways import read_in_python
from checker.counterfactual.removals import forbidden_by, limited_between, removes_check
from checker.counterfactual.smallness import is_loosening
from checker.counterfactual.time_spent import limited_token, time_inside, time_spent
from checker.culprit import culprit_of, own_elements
from checker.mutation.edits import EditSite, SmallEdit
from checker.oracle import given_up
from checker.proofs.places import ModelText
from compiler.program import TOKEN_TIMES
from nddl_lang.text.read import real_path
from nddl_lang.text.source import Span
from runtime.executive.configuration import CodeConfiguration, PropertyConfiguration, TokenPattern
from runtime.executive.events import heads_of, single_events
from runtime.executive.outcome import Abort, Conflict, Deadlock, ElementKind, Event, EventKind, Outcome, SourcePlace
from runtime.solver.tags import RESOURCE_THREAT

_CULPRIT, _CONFLICT, _LOG, _OBSERVED, _COVERED, _EVENT, _AWAITED, _NAMED = 0.0, 0.25, 0.5, 0.5, 0.75, 1.0, 1.0, 1.5
_AWAITED_END = 0.75  # of what another reactor had seen that only asked for something
_ASKER = 1.0  # of a line by which another reactor only asked for something
_UNSAID = 3.0  # of what bears on a token, where a property says what its arguments are
_READ = 1.0  # of what bears on the arguments that Python read which published what failed, or raised
_STEP = 0.3  # of a line behind another one, by a local variable of a rule whose token was observed
_UNDER = 0.3  # of the condition that a line of the conflict stands under
_PASSED = 0.4  # length of the way through a line that only passes a value on
_LEVEL = 0.5  # of what changes the level of a resource that rules something out
_OUTSIDE = 3.0  # added where other lines contradict each other, whatever happens
_TROUBLES = (EventKind.RELAX, EventKind.REJECT, EventKind.REFUSE, EventKind.KILL)
_TELLING, _MOST_TOLD = 3.0, 0.6  # what a conflict tells of its lines together, and of one
_TIME = "start"
_MOMENTS = ("start", "end")
_WORD = re.compile(r"[A-Za-z_]\w*")
_UNSEEN = 4.0  # added for lines of a rule that nothing fired


class Suspicion(StrEnum):
    """What made a line a candidate."""

    CONFLICT = "conflict"
    SEARCH = "failure log"
    TRACE = "trace"  # a repair, a refusal or a rejection on the way
    COVERAGE = "coverage"  # passing missions do not reach it
    DEPENDENCE = "dependence"


@dataclass(frozen=True, eq=False, slots=True)
class Candidate:
    """A site that is worth a trial: `far` from what ended the mission, by lines that hang together.

    It is so much nearer for trials as lines on the way only pass a value on. A line of the conflict is tried so much
    sooner as it is `told` by it: a conflict of few lines tells more of each. `is_proven`: a number did what it is
    there for before the failure. `is_linted`: lint warns of the line. `observed` are the parameters that were observed
    to be what the line forbids, `between` those of them that have a limit on the other side too.
    """

    site: EditSite
    far: float
    source: Suspicion
    nearer: float = 0.0
    told: float = 0.0
    is_proven: bool = False
    is_linted: bool = False
    observed: frozenset[str] = frozenset()
    between: frozenset[str] = frozenset()

    def takes_away(self, edit: SmallEdit) -> bool:
        """Whether an edit takes a demand away altogether, or what was observed out of what the line forbids."""
        return is_loosening(edit, self.site) or removes_check(edit, self.site, self.observed, self.between)


def candidates_of(
    outcome: Outcome,
    graph: Dependence,
    root: Path,
    properties: Sequence[PropertyConfiguration] = (),
    exercised: Sequence[Span] = (),
    text: ModelText | None = None,
    coded: Sequence[CodeConfiguration] = (),
) -> list[Candidate]:
    """All lines that can have a part in it, the nearest first; `exercised` rules and branches passing missions lack.

    Where reactors in Python are on the way, among those `coded`, what they had read stands for what they published.
    With the `text` of the models z3 is asked which lines of a search that failed must have a part in it.
    """
    roots: dict[int, tuple[float, Suspicion]] = {}

    def put(number: int, far: float, source: Suspicion) -> None:
        if number not in roots or far < roots[number][0]:
            roots[number] = (far, source)

    def note(place: SourcePlace | None, far: float, source: Suspicion) -> None:
        if place is not None:
            for number in graph.at(str(real_path(root / place.file)), place.line):
                put(number, far, source)

    failed = failed_by(outcome)
    culprit = culprit_of(failed.conflict)
    at_odds = lines_at_odds(failed, text) if text is not None else frozenset()
    for place in (culprit.place, *culprit.limits, *sorted(at_odds, key=lambda one: (one.file, one.line, one.column))):
        note(place, _CULPRIT, Suspicion.CONFLICT)
    troubles = [event for event in single_events(outcome.events) if event.kind in _TROUBLES]
    first = next((one for one in troubles if one.conflict is not None or one.deadlock is not None), None)
    for place, far, source in _named(outcome, failed.conflict, troubles, first):
        note(place, far, source)
    observed = _observed(failed.conflict) | _observed(first.conflict if first is not None else None)
    waited_for = _observed(failed.conflict, is_by_askers=True) - observed
    seen_at = dict.fromkeys(sorted(observed), _OBSERVED) | dict.fromkeys(sorted(waited_for), _AWAITED_END)
    for (token, variable), least in seen_at.items():
        for number, steps in graph.behind(token, variable):
            put(number, least + _STEP * steps, Suspicion.CONFLICT)
    for token in sorted({token for token, _ in observed}):  # that it came at all, its owner decided
        for number, steps in graph.choosing(token):
            put(number, _OBSERVED + _STEP * steps, Suspicion.CONFLICT)
    for predicate, name in sorted(read_in_python(outcome, observed, coded)):
        for number in graph.of_predicate(predicate, name):
            put(number, _READ, Suspicion.TRACE)
    asked = _asked(failed.conflict) | _asked(first.conflict if first is not None else None)
    answers = [*refusals(outcome), *((first,) if first is not None and first.kind in ANSWERS else ())]
    asked |= {(event.predicate, _TIME) for event in answers}
    for token, variable in sorted(asked):
        asking = dict.fromkeys(graph.asking(token, variable), _OBSERVED)
        if variable in TOKEN_TIMES:  # who asks for a time has it from the limits of its own token
            rules = sorted({graph.sites[number].rule for number in asking})
            asking |= {one: _OBSERVED + _STEP for rule in rules for one in graph.setting(rule, variable)} | asking
        for number, far in asking.items():
            put(number, far, Suspicion.CONFLICT)
    for token, variable in sorted(observed):  # when a token came, who asked for it has said
        for number in graph.asking(token, variable) if variable in _MOMENTS else ():
            put(number, _OBSERVED + _STEP, Suspicion.CONFLICT)
    ways = [way for one in (failed, first) if one is not None for way in dead_ends(one.deadlock)]
    for *before, last in ways:  # a resource that is used too much, whatever else is chosen
        trying = {one.flaw.predicate for one in before if one.flaw is not None}
        used = last.flaw.name if last.flaw is not None and last.flaw.kind == RESOURCE_THREAT else ""
        for number in graph.of_level(used) if used else ():
            put(number, _CONFLICT if graph.sites[number].rule in trying else _LEVEL, Suspicion.CONFLICT)
    for predicate in sorted(_tokens_in(outcome, failed, first)):
        for number in graph.of_resource(predicate):
            put(number, _LEVEL, Suspicion.CONFLICT)
    for resource in promised_levels(outcome, properties):
        for number in graph.of_level(resource):
            put(number, _LEVEL, Suspicion.TRACE)
    held = {predicate for *_, predicate in heads_of(outcome.events)}
    predicates = _ended_by(outcome, held) | _violated(outcome, properties)
    if not roots and not predicates:
        predicates = set(_latest(outcome).values())
    arguments = _arguments(outcome, properties)
    for predicate, name in sorted(arguments):
        for number in sorted(graph.of_predicate(predicate, name)):
            if _sets(graph.sites[number].text, name):
                roots.setdefault(number, (_OBSERVED, Suspicion.TRACE))
    spoken = {predicate for predicate, _ in arguments} if forbids_values(outcome, properties) else set[str]()
    named = {number for predicate in predicates - spoken for number in graph.of_predicate(predicate)}
    awaited = graph.expected_with(roots or named, held) if failed.deadlock is None else ()
    for far, numbers in (
        (_AWAITED, {number for predicate in awaited for number in graph.of_predicate(predicate)}),
        (_NAMED, named),
        (_UNSAID, {number for predicate in spoken for number in graph.of_predicate(predicate)}),
    ):
        for number in sorted(numbers):
            put(number, far, Suspicion.TRACE)
    for predicate, share in time_spent(outcome).items():
        for number in graph.lasting(predicate):
            put(number, -math.log(share), Suspicion.TRACE)
    parts = graph.children(limited_token(outcome))
    for predicate, share in time_inside(outcome).items():
        for number, steps in graph.lengthening(predicate) if predicate in parts else ():
            put(number, -math.log(share) + _STEP * steps, Suspicion.TRACE)
    for span in exercised:
        for number in graph.within(span):
            put(number, _COVERED, Suspicion.COVERAGE)
    for number, (far, source) in list(roots.items()):
        for condition in graph.conditions(number) if far <= _CONFLICT else ():
            put(condition, far + _UNDER, source)
    given = {number: far for number, (far, _) in roots.items()}
    distances, reached = graph.distances(given), graph.distances(given, _PASSED)
    seen = held | _named_predicates(outcome)
    if failed.deadlock is not None:  # a search tries tokens that are never flown
        near = [number for number, (far, _) in roots.items() if far <= _LOG]
        seen |= {name.rpartition(".")[2] for name in graph.tokens_at(near)}
    inside = {number for place in at_odds for number in graph.at(str(real_path(root / place.file)), place.line)}
    abort = given_up(outcome)
    behind = first if first is not None and abort is not None and first.reactor != abort.reactor else None
    told = [_told(failed.conflict, graph, root)]
    told.append({number for token, variable in waited_for for number, _ in graph.behind(token, variable)})
    if behind is not None:  # who ended may know only that another one took as long as it was asked to
        conflict = behind.conflict if behind.deadlock is None else in_common(behind.deadlock)
        slices = [graph.behind(token, variable) for token, variable in _observed(conflict)]
        told.append(_told(conflict, graph, root) | {number for lines in slices for number, _ in lines})
    proven = graph.proven(_over(outcome))
    limited = _sites_at(culprit.place, graph, root)
    seen_to_fail = forbidden_by(failed.conflict)
    found = []
    for number, site in enumerate(graph.sites):
        if number not in distances:
            continue
        far, source = roots.get(number, (0.0, Suspicion.DEPENDENCE))
        is_unseen = bool(site.rule) and site.rule.rpartition(".")[2] not in seen
        is_outside = bool(inside) and number not in inside
        added = _UNSEEN * is_unseen + _OUTSIDE * is_outside
        sooner = max((min(_TELLING / len(lines), _MOST_TOLD) for lines in told if number in lines), default=0.0)
        nearer = distances[number] - reached[number]
        candidate = Candidate(site, distances[number] + added, source, nearer, sooner, number in proven)
        if number in limited:
            candidate = replace(
                candidate, observed=seen_to_fail, between=limited_between(seen_to_fail, site, graph.sites)
            )
        found.append(candidate)
    return sorted(found, key=lambda one: one.far)


def _over(outcome: Outcome) -> set[str]:
    """The predicates of which a token was over before the mission ended: another one began on its timeline."""
    last: dict[str, str] = {}
    found: set[str] = set()
    for _, _, timeline, predicate in heads_of(outcome.events):
        found |= {last[timeline]} if timeline in last else set()
        last[timeline] = predicate
    return found


def _told(conflict: Conflict | None, graph: Dependence, root: Path) -> set[int]:
    """The sites of the lines that a conflict names."""
    places = [one.place for one in own_elements(conflict) if one.place is not None]
    return {number for place in places for number in graph.at(str(real_path(root / place.file)), place.line)}


def _sites_at(place: SourcePlace | None, graph: Dependence, root: Path) -> set[int]:
    return set() if place is None else set(graph.at(str(real_path(root / place.file)), place.line))


def _observed(conflict: Conflict | None, *, is_by_askers: bool = False) -> set[tuple[str, str]]:
    """Predicates, each with a parameter or time that a conflict has from observation: a line of the owner set it.

    By askers: what others had seen who asked for something as late as that let them.
    """
    own = own_elements(conflict)
    return {
        (variable.token.predicate, variable.name)
        for element in (conflict.elements if conflict is not None else ())
        if element.kind is ElementKind.OBSERVATION and (element in own) is not is_by_askers
        for variable in element.variables
        if variable.token is not None
    }


def _asked(conflict: Conflict | None) -> set[tuple[str, str]]:
    """Predicates, each with a parameter or time that another reactor asked for: a line of its model set it."""
    return {
        (variable.token.predicate, variable.name)
        for element in (conflict.elements if conflict is not None else ())
        if element.kind is ElementKind.REQUEST and element.place is None
        for variable in element.variables
        if variable.token is not None
    }


def _tokens_in(outcome: Outcome, failed: Failed, first: Event | None) -> set[str]:
    """The predicates of the tokens that conflicts speak of: of the end, of what was tried, of the first trouble."""
    ends: tuple[Failed | Event | Abort | None, ...] = (failed, first, given_up(outcome))
    conflicts = [one.conflict for one in ends if one is not None and one.conflict is not None]
    conflicts += [each for one in ends if one is not None and one.deadlock for each in one.deadlock.conflicts()]
    elements = (element for conflict in conflicts for element in own_elements(conflict))
    variables = (variable for element in elements for variable in element.variables)
    return {variable.token.predicate for variable in variables if variable.token is not None}


def _named(
    outcome: Outcome, conflict: Conflict | None, troubles: Sequence[Event], first: Event | None
) -> Iterator[tuple[SourcePlace | None, float, Suspicion]]:
    """The places that the outcome names, how near each is, and where it stands.

    Of the repairs, refusals and rejections the `first` with a known cause counts most: what comes later may follow.
    """
    own = set(own_elements(conflict))
    for element in conflict.elements if conflict is not None else ():
        yield element.place, _CONFLICT if element in own else _ASKER, Suspicion.CONFLICT
    refused = [one for one in refusals(outcome) if one.conflict is not None or one.deadlock is not None]
    for one in refused:
        yield from _places(one.conflict, _CONFLICT, Suspicion.CONFLICT)
        yield from _logged(one.deadlock)
    far = _EVENT if refused else _CONFLICT  # what was missed only shows that it was refused
    abort = given_up(outcome)
    if abort is not None:
        for each in (abort.conflict, *abort.repairs):
            yield from _places(each, far, Suspicion.CONFLICT)
        yield from _logged(abort.deadlock)
    for goal in outcome.open_goals:
        yield from _places(goal.conflict, far, Suspicion.CONFLICT)
        yield from _logged(goal.deadlock)
    for event in troubles:
        yield from _places(event.conflict, _CONFLICT if event is first else _EVENT, Suspicion.TRACE)
        yield from _logged(event.deadlock, _LOG if event is first else _EVENT)


def _logged(deadlock: Deadlock | None, far: float = _LOG) -> Iterator[tuple[SourcePlace | None, float, Suspicion]]:
    for conflict in deadlock.conflicts() if deadlock is not None else ():
        yield from _places(conflict, far, Suspicion.SEARCH)


def _places(
    conflict: Conflict | None, far: float, source: Suspicion
) -> Iterator[tuple[SourcePlace | None, float, Suspicion]]:
    for element in own_elements(conflict):
        yield element.place, far, source


def _ended_by(outcome: Outcome, begun: Container[str]) -> set[str]:
    """The predicates of what ended the mission, or of what it left open, but for goals that it ended before."""
    later = {
        goal.predicate
        for goal in outcome.open_goals
        if outcome.abort is not None and goal.reason is None and goal.conflict is None and goal.predicate not in begun
    }
    return _predicates(outcome) - later


def _predicates(outcome: Outcome) -> set[str]:
    """The predicates of what ended the mission, or of what it left open."""
    found = {goal.predicate for goal in outcome.open_goals}
    abort = given_up(outcome)
    reason = abort.reason if abort is not None else None
    while reason is not None:
        found |= {reason.predicate, reason.token.predicate.rpartition(".")[2] if reason.token is not None else ""}
        reason = reason.repair
    return found - {""}


def _violated(outcome: Outcome, properties: Sequence[PropertyConfiguration]) -> set[str]:
    """The predicates that the first violated property is about; of a timeline alone, what it held last."""
    return {predicate for predicate, _ in _broken(outcome, properties)}


def _arguments(outcome: Outcome, properties: Sequence[PropertyConfiguration]) -> set[tuple[str, str]]:
    """The same, each with the words of what the property says of its arguments."""
    broken = _broken(outcome, properties)
    said = [(name, [*dict(pattern.parameters), *_WORD.findall(pattern.where)]) for name, pattern in broken]
    return {(predicate, word) for predicate, words in said for word in words}


def _sets(text: str, name: str) -> bool:
    """Whether a line says what an argument is."""
    return re.match(rf"\s*(?:\w+\.)?{name}\s*==", text) is not None


def _broken(outcome: Outcome, properties: Sequence[PropertyConfiguration]) -> list[tuple[str, TokenPattern]]:
    """The patterns of the first violated property, each with the predicate that it is about."""
    broken = first_violated(outcome)
    if given_up(outcome) is not None or broken is None:
        return []
    patterns = [pattern for each in properties if each.name == broken.name for pattern in (each.pattern, each.then)]
    latest = _latest(outcome, broken.tick)
    named = [(one.predicate or latest.get(one.timeline, ""), one) for one in patterns if one is not None]
    return [(predicate, one) for predicate, one in named if predicate]


def _latest(outcome: Outcome, tick: int | None = None) -> dict[str, str]:
    """The predicate that was observed last on each timeline, until the end or a tick."""
    return {
        timeline: predicate for _, at, timeline, predicate in heads_of(outcome.events) if tick is None or at <= tick
    }


def _named_predicates(outcome: Outcome) -> set[str]:
    """The predicates, without their classes, of what was asked for and came of it, and of what the conflicts name."""
    found = {event.predicate for event in single_events(outcome.events)}
    found |= _predicates(outcome)
    conflict = failed_by(outcome).conflict
    for element in conflict.elements if conflict is not None else ():
        found.add(element.rule.rpartition(".")[2])
    return found
