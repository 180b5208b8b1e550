"""One failed mission in, its story out: the steps from what was drawn to the line where the agent gave up."""

from collections.abc import Container, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain
from pathlib import Path

from checker.batch.result import MissionResult
from checker.broken_plans import Breaking, blamed, broken_plan, fails_by_repairs
from checker.causes import (
    Failed,
    beginning_of,
    dead_ends,
    decided_at,
    draws_behind,
    events_to_abort,
    failed_at,
    lines_that_rule_out,
    missed_after,
)
from checker.counterfactual.goals_behind import asking_for, promised_goals
from checker.counterfactual.promises import first_violated, of_first_violated
from checker.culprit import culprit_of, in_telling_order, is_unbounded
from checker.findings import Fault
from checker.influence import Branch, Influence, parameters_that_choose
from checker.long_parts import with_parts
from checker.oracle import Judgement, given_up
from checker.proofs.conflict import Confirmation, confirm, needed_elements
from checker.proofs.places import ModelText
from checker.requested import PlannerChoice, left_open, lines_that_ask, who_chose
from checker.resource_lines import lines_of_amount, with_uses
from checker.standing import Standing, StandingLines
from checker.steps import Step, StepKind, without_repeats
from checker.told_draws import acting_lines, draws_of, in_time, shown_tokens
from checker.told_events import failed_owner, lost_events, promised_events, sent_requests
from checker.waiting import beside, held_up, kept_open_by, waited_for
from runtime.executive.configuration import AgentConfiguration, CodeConfiguration, PropertyKind
from runtime.executive.events import heads_of, single_events
from runtime.executive.outcome import (
    Abort,
    Conflict,
    ConflictElement,
    Deadlock,
    ElementKind,
    Event,
    EventKind,
    LevelChange,
    OpenGoal,
    Outcome,
    ReasonKind,
    SourcePlace,
)

_MOST_LINES = 8  # that rule out what was tried
_MOST_CHANGES = 6  # of a level
_MOST_GOALS = 2  # that lead to what a property promises
_MOST_LEADING = 3  # requests that do
_MOST_ENDS = 3  # flaws against which there was nothing to choose


@dataclass(frozen=True, slots=True)
class Story:
    """Why one mission failed; `fault` ties it to the others that failed alike.

    Of the conflict only what its contradiction needs is told.
    """

    number: int
    seed: int
    judgement: Judgement
    open_goals: tuple[OpenGoal, ...]
    last_tick: int
    final_tick: int
    steps: tuple[Step, ...]
    fault: Fault | None
    confirmation: Confirmation | None = None  # z3's word on the conflict of this mission
    refusal: Event | None = None  # what was missed had been refused with
    coded: tuple[CodeConfiguration, ...] = ()  # the reactors in Python that it goes through
    others_go_on: bool = False  # who gave up was killed


def tell(
    result: MissionResult,
    agent: AgentConfiguration,
    influence: Influence,
    fault: Fault | None,
    text: ModelText | None = None,
    taken: Container[Branch] | None = None,
    usual: Container[Breaking] = frozenset(),
    decisive: Sequence[str] = (),
) -> Story:
    """The story of a mission that failed and whose outcome is at hand; z3 reads the meaning of lines from `text`.

    `taken` are the branches that the mission took, if that is known; `usual` is where plans break although missions
    pass; `decisive` are the parameters that set the mission apart from one that passes.
    """
    outcome = result.outcome
    assert outcome is not None
    failed = blamed(result)
    conflict = failed.conflict
    first = broken_plan(result, usual)
    broken = None if fails_by_repairs(result) else first
    conflicts = [one for one in (conflict, broken.conflict if broken is not None else None) if one is not None]
    confirmation = _confirmed(result, conflict, fault, text)
    levels = _levels(result, text)
    changes = [[Step(StepKind.LEVEL, one.tick, one, next(iter(places), None))] for one, places in levels]
    drawn = _drawn_at(influence, (place for _, places in levels for place in places))
    known = suspects(outcome, fault, first) or _choosing(outcome, conflict, text)
    parameters = tuple(dict.fromkeys((*known, *decisive, *drawn)))
    until = _decided_at(result, outcome)
    acting = acting_lines(influence, outcome, until, taken, conflicts)
    draws = draws_of(outcome, agent, acting, parameters, until, conflicts)
    redrawn = [] if broken is None else draws_of(outcome, agent, acting, parameters, broken.tick, conflicts[-1:])
    shown = shown_tokens(outcome, acting, parameters, until, conflicts)
    indices = {
        *shown,
        *sent_requests(outcome, conflict, until),
        *(sent_requests(outcome, broken.conflict, broken.tick) if broken is not None else ()),
        *(index for index in events_to_abort(outcome, parameters) if index >= min(shown, default=0)),
    }
    indices |= {one for one in _begun(outcome, broken) if one is not None}
    way = [outcome.events[index] for index in sorted(indices)]
    if draws:
        way = [event for event in way if event.kind is not EventKind.SAMPLE]
    abort = given_up(outcome)
    ended = outcome.last_tick if abort is None else abort.tick
    if result.judgement.exceeded is not None:
        way = lost_events(outcome, result.judgement.exceeded.limit)
    dead = failed_owner(result.judgement, outcome)
    way = sorted([*way, *dead, *promised_events(result, outcome, agent)], key=lambda event: event.tick)
    wished = [[one] for one in _wished(outcome, agent, text)] if result.judgement.broken is not None else []
    told = in_time(changes, _events(way, broken, outcome, agent, text, taken), is_behind=True)
    of_conflict = _as_tried(_conflict(conflict, confirmation), failed)
    steps = [
        *in_time([*redrawn, *draws, *wished], told),
        *with_parts(_with_askers(of_conflict, outcome, text, taken), outcome, text, taken),
        *_tried(failed, text),
        *_kept_open(outcome, agent, text),
        *(Step(StepKind.WAITING, None, one) for one in waited_for(outcome, agent)),
        *(Step(StepKind.WAITING, at, one) for at, one in held_up(result.judgement.broken, broken, outcome, agent)),
        Step(StepKind.ABORT, ended, abort, abort.reason.raised if abort is not None else None),
    ]
    return Story(
        result.number,
        result.seed,
        result.judgement,
        result.open_goals,
        ended,
        outcome.final_tick,
        tuple(_with_conditions(without_repeats(_with_open(steps, outcome, text)), text)),
        fault,
        confirmation,
        missed_after(outcome),
        _in_python(steps, agent),
        outcome.last_tick > ended,
    )


def _in_python(steps: Sequence[Step], agent: AgentConfiguration) -> tuple[CodeConfiguration, ...]:
    """The reactors in the project's Python that published or asked for what is told, or gave up."""
    subjects = [step.subject for step in steps]
    heard = {one.reactor for one in subjects if isinstance(one, Event | Abort)}
    return tuple(one for one in agent.coded if one.file and one.name in heard)


def _confirmed(
    result: MissionResult, conflict: Conflict | None, fault: Fault | None, text: ModelText | None
) -> Confirmation | None:
    """z3's word on the conflict, which is known already of the example of a fault."""
    if fault is not None and fault.confirmation is not None and fault.bucket.example == result.number:
        return fault.confirmation
    return confirm(conflict, text) if conflict is not None else None


def suspects(outcome: Outcome, fault: Fault | None, broken: Event | None) -> tuple[str, ...]:
    """The parameters that the story begins with: those of the condition, else those that the failure depends on.

    These are what broke a plan first, by its repair, and what ended the mission.
    """
    if fault is not None and fault.condition is not None:
        return fault.condition.parameters
    spoken = broken.conflict.parameters if broken is not None and broken.conflict is not None else ()
    return tuple(dict.fromkeys((*spoken, *draws_behind(outcome))))


def _choosing(outcome: Outcome, conflict: Conflict | None, text: ModelText | None) -> tuple[str, ...]:
    """The parameters that decide whether what was observed, and ended the mission, comes at all."""
    abort = given_up(outcome)
    seen = {abort.reason.predicate} if abort is not None else set[str]()
    for element in conflict.elements if conflict is not None else ():
        if element.kind is ElementKind.OBSERVATION:
            seen |= {one.token.predicate for one in element.variables if one.token is not None}
    programs = text.programs.values() if text is not None else ()
    return tuple(dict.fromkeys(name for program in programs for name in parameters_that_choose(program, seen)))


def _begun(outcome: Outcome, broken: Event | None) -> Iterator[int | None]:
    """Where that began which goes on, at the abort and where a plan broke before."""
    abort = given_up(outcome)
    if abort is not None:
        yield beginning_of(abort.reason, abort.timelines, outcome)
    if broken is not None and broken.reason is not None and broken.conflict is not None:
        seen = {one.observed[1] for one in broken.conflict.elements if one.observed is not None}
        yield beginning_of(broken.reason, seen, outcome)


def _decided_at(result: MissionResult, outcome: Outcome) -> int:
    """The tick at which it was decided that the mission fails; what came later is no part of why."""
    if result.judgement.broken is not None and result.judgement.broken.tick is not None:
        return result.judgement.broken.tick
    end = decided_at(outcome)
    return outcome.events[end].tick if end >= 0 else outcome.last_tick


def _events(
    way: Sequence[Event],
    broken: Event | None,
    outcome: Outcome,
    agent: AgentConfiguration,
    text: ModelText | None,
    taken: Container[Branch] | None,
) -> Iterator[Step]:
    """The events on the way, and where a plan broke first, with what broke it."""
    if broken is None:
        yield from (Step(StepKind.EVENT, event.tick, event) for event in way)
        return
    events = list(single_events(outcome.events))
    behind = [one for one in events[events.index(broken) :] if one.tick == broken.tick]
    rest = [event for event in way if event is not broken]
    before = [event for event in rest if event.tick <= broken.tick and event not in behind]
    yield from (Step(StepKind.EVENT, event.tick, event) for event in before)
    yield Step(StepKind.EVENT, broken.tick, broken)
    yield from (Step(StepKind.WAITING, broken.tick, one) for one in beside(broken, outcome, agent))
    confirmation = confirm(broken.conflict, text) if broken.conflict is not None else None
    yield from _with_askers(_conflict(broken.conflict, confirmation, StepKind.BROKEN), outcome, text, taken)
    yield from (Step(StepKind.EVENT, event.tick, event) for event in rest if event not in before)


def _conflict(
    conflict: Conflict | None, confirmation: Confirmation | None, kind: StepKind = StepKind.FAULT
) -> list[Step]:
    """The elements of the conflict that its contradiction needs, from the draw outwards, the culprit last."""
    if conflict is None or confirmation is None:
        return []
    culprit = culprit_of(conflict)
    needed = needed_elements(conflict, confirmation)
    steps = [
        Step(StepKind.CAUSE, None, element, element.place)
        for number, element in (
            (number, conflict.elements[number]) for number in in_telling_order(conflict, culprit.number)
        )
        if number != culprit.number
        and number in needed
        and element.kind is not ElementKind.SAMPLE
        and not _is_only_resource(element, conflict)
        and not is_unbounded(element)
        and (element.place is None or element.place not in culprit.limits)
    ]
    if culprit.element is not None:
        steps.append(Step(kind, None, culprit.element, culprit.place, culprit.limits))
    return steps


def _as_tried(steps: list[Step], failed: Failed) -> list[Step]:
    """The steps of a conflict that a search came to: where it put what it found no place for was tried in vain."""
    flaws = set(_flaws_in(failed.deadlock))
    return [replace(step, is_tried=_is_order_of(step.subject, flaws)) for step in steps]


def _flaws_in(deadlock: Deadlock | None) -> Iterator[str]:
    """The names of what had no choice left."""
    if deadlock is not None:
        yield from (deadlock.flaw.name,) if deadlock.flaw is not None else ()
        for one in deadlock.tried:
            yield from _flaws_in(one.leads_to)


def _is_order_of(subject: object, names: Container[str]) -> bool:
    """Whether an element is an order of a token with one of the names and another one."""
    if not isinstance(subject, ConflictElement) or subject.kind is not ElementKind.ORDER:
        return False
    tokens = {str(one.token) for one in subject.variables if one.token is not None}
    return len(tokens) > 1 and any(one in names for one in tokens)


def _with_askers(
    steps: list[Step], outcome: Outcome, text: ModelText | None, taken: Container[Branch] | None
) -> Iterator[Step]:
    """The steps, with the lines by which an argument came to be asked for before the step that says so."""
    held = {predicate for *_, predicate in heads_of(outcome.events)}
    events = single_events(outcome.events)
    held |= {event.predicate for event in events if event.kind is EventKind.REQUEST}
    elements = [step.subject for step in steps if isinstance(step.subject, ConflictElement)]
    observed = {one.observed[1] for one in elements if one.observed is not None}
    for step in steps:
        if isinstance(step.subject, ConflictElement) and text is not None:
            asking = (step.subject, text.programs, text.root, held)
            lines = lines_that_ask(*asking, taken, outcome.events, observed)
            yield from (Step(StepKind.ASKED, None, line, line.place) for line in lines)
            chosen = None if lines else who_chose(step.subject, text.programs, events, text.root)
            if chosen is not None and not lines_that_ask(*asking):
                yield Step(StepKind.CHOSEN, None, chosen, chosen.place)
        yield step


def _levels(result: MissionResult, text: ModelText | None) -> list[tuple[LevelChange, tuple[SourcePlace, ...]]]:
    """The last changes that led to the violated level of a property, each with the lines that say how much it is."""
    changes = result.judgement.broken.changes if result.judgement.broken is not None else ()
    led = [one for one in changes if (one.amount < 0) == (changes[-1].amount < 0)][-_MOST_CHANGES:]
    return [(one, lines_of_amount(one, text.programs, text.root) if text is not None else ()) for one in led]


def _drawn_at(influence: Influence, places: Iterable[SourcePlace]) -> tuple[str, ...]:
    """The parameters that act through a line that stands at one of the places."""
    known = {(one.file, one.line) for one in places}
    return tuple(
        name for name, lines in influence.items() if any((one.place.file, one.place.line) in known for one in lines)
    )


def _with_open(steps: Sequence[Step], outcome: Outcome, text: ModelText | None) -> Iterator[Step]:
    """The steps, with the arguments that were left open before what went on longer than planned."""
    told: set[PlannerChoice] = set()
    for step in steps:
        reason = step.subject.reason if isinstance(step.subject, Event | Abort) else None
        if text is not None and reason is not None and reason.kind is ReasonKind.GOES_ON and reason.token is not None:
            tick = outcome.last_tick if reason.tick is None else reason.tick
            found = left_open(reason.token, tick, text.programs, outcome.events, text.root)
            fresh = [one for one in found if one not in told]
            told.update(fresh)
            yield from (Step(StepKind.CHOSEN, None, one, one.place) for one in fresh)
        yield step


def _with_conditions(steps: list[Step], text: ModelText | None) -> Iterator[Step]:
    """The steps, those of elements with the conditions of their lines, each told once, and their objects' places."""
    told: set[Standing] = set()
    lines = StandingLines(text.programs, text.root) if text is not None else None
    for step in steps:
        if lines is not None and isinstance(step.subject, ConflictElement):
            under = tuple(one for one in lines.of(step.subject) if one not in told)
            told.update(under)
            yield replace(step, under=under, made=lines.made(step.subject))
        else:
            yield step


def _wished(outcome: Outcome, agent: AgentConfiguration, text: ModelText | None) -> Iterator[Step]:
    """The goals that lead to what a violated property promises by some time, each with the line that says when.

    Of what it promises within a time what led there was asked for since, and the same on other timelines.
    """
    known = text.programs if text is not None else {}
    programs = [known[one.name] for one in agent.reactors if one.name in known]  # none of a model in error
    if len(programs) < len(agent.reactors):
        return
    goals = promised_goals(outcome, agent, programs)
    requests = [one for one in single_events(outcome.events) if one.kind is EventKind.REQUEST]
    for event in requests if len(goals) <= _MOST_GOALS else ():
        number = -1 if event.request is None else -event.request - 1
        if not event.reactor and number in goals:
            yield Step(StepKind.EVENT, event.tick, event, dict(agent.goals[number].places).get("start"))
    for kept in of_first_violated(outcome, agent.properties):
        broken = first_violated(outcome)
        if kept.kind is PropertyKind.WITHIN and kept.then is not None and broken is not None:
            due, wanted = range(broken.tick or 0, (broken.tick or 0) + kept.ticks + 1), kept.then
            leading = asking_for(wanted, agent, programs) | {wanted.predicate}
            found = [one for one in requests if one.reactor and one.tick in due and one.predicate in leading]
            found = [one for one in found if one.timeline != wanted.timeline]  # those are told with their answers
            yield from (Step(StepKind.EVENT, one.tick, one) for one in found[:_MOST_LEADING])


def _kept_open(outcome: Outcome, agent: AgentConfiguration, text: ModelText | None) -> Iterator[Step]:
    """What a goal that stays open for no other reason asked for in vain, with what rules that out."""
    for event in kept_open_by(outcome, agent):
        yield from _tried(failed_at(event), text)
        yield Step(StepKind.EVENT, event.tick, event)


def _is_only_resource(element: ConflictElement, conflict: Conflict) -> bool:
    """Whether an element says that a use is of the only resource there is; the resource names its users."""
    if element.kind is not ElementKind.DECLARATION or element.place is not None:
        return False
    named = {one for other in conflict.elements if other.kind is ElementKind.RESOURCE for one in other.variables}
    return any(one.kind == "object" and one in named for one in element.variables)


def _tried(failed: Failed, text: ModelText | None) -> list[Step]:
    """What the search tried in vain, and the lines that rule it out and that the conflict does not name."""
    if failed.deadlock is None:
        return []
    limits = culprit_of(failed.conflict).limits
    lines = [one for one in lines_that_rule_out(failed) if one.place not in limits][:_MOST_LINES]
    steps = [Step(StepKind.CAUSE, None, element, element.place) for element in lines]
    ends = dict.fromkeys(way[-1] for way in dead_ends(failed.deadlock) if len(way) > 1)
    known = (text.programs, text.root) if text is not None else ({}, Path())
    told = [with_uses(one, *known) for one in (failed.deadlock, *list(ends)[:_MOST_ENDS])]
    return [*steps, *chain.from_iterable(told)]
