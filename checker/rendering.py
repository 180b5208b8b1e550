"""Words for what the checker has found: a failure, a step of a story, z3's answer in, one line each out.

What happened in a mission is worded by `runtime.executive.rendering`.
"""

import re
from collections.abc import Sequence
from typing import assert_never

from checker.conditions.condition import Condition
from checker.conditions.rendering import literal_text
from checker.counterfactual.time_spent import LongPart
from checker.culprit import is_value
from checker.influence import InfluenceLine
from checker.limits import Limit
from checker.losses import Exceeded
from checker.oracle import CODE_NAMES, Judgement
from checker.proofs.called import Called
from checker.proofs.conflict import Confirmation, Finding
from checker.requested import PlannerChoice
from checker.resource_lines import user_text
from checker.sampling.rendering import describe, number
from checker.standing import Standing
from checker.steps import Step, StepKind
from checker.story import Story
from checker.waiting import Waiting
from compiler.program import DomainConstant
from nddl_lang.text.printable import counted
from runtime.constraints.domains.tags import HALF_INF
from runtime.executive.outcome import (
    Abort,
    ConflictElement,
    Deadlock,
    ElementKind,
    Event,
    EventKind,
    LevelChange,
    OpenGoal,
    ReasonKind,
    SourcePlace,
)
from runtime.executive.rendering import (
    choice_text,
    deadlock_text,
    element_text,
    event_text,
    goal_text,
    reason_text,
    token_text,
)
from runtime.plan.readout.names import VariableName
from runtime.plan.readout.open_levels import LevelUser
from runtime.plan.readout.statements import Term

_COMPARED = re.compile(r"[<>=!]")
_EQUALITY = re.compile(r"[^=<>!]+==[^=<>!]+")

_ORIGINS = {
    ElementKind.CLOCK: " (by the clock)",
    ElementKind.OBSERVATION: " (as observed)",
    ElementKind.REQUEST: " (as asked for)",
    ElementKind.ORDER: " (by the order of tokens)",
}
_READ = {StepKind.LEVEL: "with the number of", StepKind.PART: "by"}  # lines that the line of a step reads
_TRIED_ORDER = " (by an order of tokens that was tried in vain)"
_KINDS = {
    ReasonKind.NO_LOOKAHEAD: "its owner does not look ahead",
    ReasonKind.DECLINED: "its owner's code does not do it",
    ReasonKind.NO_OWNER: "nobody owns the timeline any more",
    ReasonKind.UNKNOWN_PREDICATE: "the timeline has no such predicate",
    ReasonKind.MISFIT: "its arguments do not fit",
    ReasonKind.TIMES: "its times do not fit",
    ReasonKind.DROPPED: "dropped in a repair",
    ReasonKind.LACKING: "an owner had given up what it needed",
    ReasonKind.REJECTED: "the planner found no place for it",
    ReasonKind.CLOCK: "the plan did not allow it to be that late",
    ReasonKind.GOES_ON: "a token went on longer than planned",
    ReasonKind.ENDED: "a token ended when the plan did not allow it",
    ReasonKind.CANNOT_GO_ON: "a token could not go on",
    ReasonKind.CANNOT_START: "a token could not start",
    ReasonKind.NONE_CAN_START: "no token could start",
    ReasonKind.DID_NOT_START: "a token did not start in time",
    ReasonKind.UNMET: "what was asked of the present could not be met",
    ReasonKind.NO_INSERTION: "no place for a token",
    ReasonKind.NO_PLAN: "no plan inside the window",
}


def failure_text(judgement: Judgement, open_goals: Sequence[OpenGoal] = (), refusal: Event | None = None) -> str:
    """Why a mission failed, or could not be flown; empty for one that passed.

    `refusal` is the answer of an owner, as of which something was missed.
    """
    if judgement.broken is not None:
        seen = f": {judgement.broken.seen}" if judgement.broken.seen else ""
        also = ", ".join(f"`{one.name}` at tick {one.tick}" for one in judgement.also)
        text = f"the property `{judgement.broken.name}` is violated at tick {judgement.broken.tick}{seen}"
        return f"{text}; so is {also}" if also else text
    if judgement.exceeded is not None:
        return _exceeded_text(judgement.exceeded)
    if judgement.reason is None:
        return judgement.message
    goals = ", ".join(goal_text(goal) for goal in open_goals)
    text = reason_text(judgement.reason) + (f": {goals}" if goals else "")
    return text if refusal is None else f"{_refusal_text(refusal)}; so {text}"


def _refusal_text(refusal: Event) -> str:
    """That an owner did not take a request, and why; arguments that may be anything are left out."""
    asked = token_text(refusal.predicate, tuple(one for one in refusal.arguments if not _is_anything(one[1])))
    why = "" if refusal.reason is None else f" ({reason_text(refusal.reason)})"
    verb = "refused" if refusal.kind is EventKind.REFUSE else "rejected"
    return f"{refusal.reactor} {verb} {asked} on {refusal.timeline} at tick {refusal.tick}{why}"


def _is_anything(domain: DomainConstant) -> bool:
    return domain.interval is not None and domain.interval[0] <= -HALF_INF and domain.interval[1] >= HALF_INF


def _exceeded_text(exceeded: Exceeded) -> str:
    """A limit of [check] that a mission did not keep."""
    what = {
        Limit.REJECTED: "goals were given up",
        Limit.LATE: "goals were late",
        Limit.REPAIRS: "repairs of plans",
        Limit.UNDELIVERED: "requests were not delivered",
    }[exceeded.limit]
    return f"{exceeded.found} {what}, and `{exceeded.limit.value}` is {exceeded.most}"


def kind_text(kind: ReasonKind | None) -> str:
    """What sort of reason it was, where reasons of one sort are counted together."""
    return _KINDS.get(kind, kind.value) if kind is not None else "for no known reason"


def lines_text(rule: str, count: int) -> str:
    """What so many steps in a row tell, each a line of one rule."""
    return f"it acts through {count} lines of the rule of {rule}"


def step_text(step: Step, story: Story) -> str:
    """What a step tells, without its tick and its place."""
    match step.subject:
        case (draw, parameter):
            clipped = "" if draw.raw == draw.value else f" (drawn {number(draw.raw)}, then clipped)"
            manner = f": {describe(parameter)}" if parameter is not None else ""
            return f"{draw.parameter} is {number(draw.value)}{clipped}{manner}"
        case str(rule):
            return f"it acts through the rule of {rule}"
        case InfluenceLine(rule=rule):
            return f"the rule of {rule} asks for it"
        case PlannerChoice(reactor=reactor, argument=argument, is_open=is_open):
            so = "it asked for any value" if is_open else "its planner chose"
            return f"no line of {reactor} says what {argument} is: {so}"
        case Event() as event:
            return event_line(event)
        case ConflictElement() as element:
            return element_line(element, step.is_tried) + (
                f", and so of {counted(step.alike, 'more token')}" if step.alike else ""
            )
        case Deadlock() as deadlock:
            tried = ", ".join(choice_text(one.choice) for one in deadlock.tried)
            return f"{deadlock_text(deadlock)}; {f'tried in vain: {tried}' if tried else 'there is nothing to choose'}"
        case Waiting() as waiting:
            return waiting_text(waiting)
        case LevelChange() as change:
            return _change_text(change)
        case LevelUser() as user:
            return user_text(user)
        case LongPart() as part:
            return _part_text(part)
        case Abort() | None as abort:
            return _end_text(abort, story)
        case _:
            assert_never(step.subject)


def _change_text(change: LevelChange) -> str:
    """What happens to the level of a resource, and for whom."""
    what = f"{'takes' if change.amount < 0 else 'gives'} {number(abs(change.amount))}"
    who = " and ".join(dict.fromkeys(asker for asker, _ in change.askers)) or "something"
    side = "of" if change.amount < 0 else "to"
    return f"{who} {what} {side} {change.resource}: its level is {number(change.level)}"


def _part_text(part: LongPart) -> str:
    """How much of the time of a token a part of it took."""
    what = token_text(part.predicate, part.arguments)
    of = f"{part.total} ticks that {part.whole} lasts since tick {part.begun}"
    return f"{what} on {part.timeline} takes {part.ticks} of the {of}"


def step_label(step: Step, causes: Sequence[SourcePlace]) -> str:
    """What marks the step at which it breaks, and those at the lines that were found to be causes, likeliest first."""
    number = cause_number(step.place, causes)
    marks = [f"cause {number}"] if number else []
    if step.kind is StepKind.ABORT and step.place is not None:
        marks.insert(0, "where it breaks")
    if step.kind in (StepKind.FAULT, StepKind.BROKEN) and isinstance(step.subject, ConflictElement):
        marks.insert(0, breaking_text(step.subject, is_repaired=step.kind is StepKind.BROKEN))
    return f"   <== {', '.join(marks)}" if marks else ""


def breaking_text(element: ConflictElement | None, *, is_repaired: bool = False) -> str:
    """What the element of a conflict is that it breaks at, or that the plan broke at which was repaired."""
    if is_value(element):
        return "the value that did not fit the plan" if is_repaired else "the value that does not fit"
    return "where the plan broke" if is_repaired else "where it breaks"


def beside(step: Step) -> list[tuple[str, SourcePlace, bool]]:
    """The lines that are told beside the one of a step: what each is, where it stands, and whether that is marked."""
    told = [("where the object is made", step.made, False)] if step.made is not None else []
    told += [(_standing_text(one), one.place, False) for one in step.under]
    asked = step.subject.asked if isinstance(step.subject, LongPart) else ()
    told += [("as asked for by", one, False) for one in asked]
    said = _READ.get(step.kind, "where the limit is set")
    return [*told, *((said, limit, step.kind not in _READ) for limit in step.limits)]


def _standing_text(standing: Standing) -> str:
    """That a line stands under a condition."""
    return "which stands in the `else` of" if standing.is_else else "which stands under"


def cause_number(place: SourcePlace | None, causes: Sequence[SourcePlace]) -> int:
    """Which of the causes stands at the line of a place, from 1; 0 for none."""
    if place is None:
        return 0
    return next((k for k, one in enumerate(causes, 1) if (one.file, one.line) == (place.file, place.line)), 0)


def confirmation_text(found: Confirmation, condition: Condition | None = None) -> str:
    """What z3 says, as the end of a sentence that begins with its name."""
    match found.finding:
        case Finding.CONFIRMED:
            text = f"confirms the conflict: its {len(found.core)} statements contradict each other"
            text += ", and none can be left out" if found.is_minimal else ""
            if len(found.core) == 1:
                text = "confirms the conflict: its one statement cannot hold"
            text += f" ({found.written} read from the model's text)" if found.written else ""
            text += "".join(_called_text(one) for one in found.called)
            if condition is not None and condition.in_terms:
                text += ", just where " + " and ".join(literal_text(one) for one in condition.in_terms)
        case Finding.REFUTED:
            text = "does not confirm the conflict: by themselves its statements can hold together"
        case Finding.UNKNOWN:
            text = "could not decide whether the statements of the conflict can hold together"
    missing = found.untranslated
    return text + (f" (not told to it: {', '.join(missing)})" if missing else "")


def _called_text(one: Called) -> str:
    """What is known of a constraint in Python, and by what."""
    where = f" ({one.file}:{one.line})" if one.file else ""
    refused = f", and refuses {', '.join(one.refused)}" if one.refused else ""
    return f", but for `{one.name}`{where}, which is Python: it was called {one.calls} times{refused}"


def event_line(event: Event) -> str:
    """An event with who and where, but for its tick."""
    who = event.reactor or "the mission file"
    about = f" on {event.timeline}" if event.timeline else ""
    match event.kind:
        case EventKind.OBSERVATION:
            return f"{who} publishes {event.timeline} = {token_text(event.predicate, event.arguments)}"
        case EventKind.REQUEST:
            end = event.bounds.end[1] if event.bounds is not None else HALF_INF
            until = f", to end by tick {end}" if end < HALF_INF else ""
            if not event.reactor and event.bounds is not None and event.bounds.start[1] < HALF_INF:
                earliest, latest = event.bounds.start
                until = f", to begin between ticks {max(earliest, 0)} and {latest}{until}"
            return f"{who} requests {token_text(event.predicate, event.arguments)}{about}{until}"
        case EventKind.SAMPLE:
            return f"{who} draws {event_text(event)}"
        case EventKind.RELAX:
            return f"{who} repairs its plan: {event_text(event)}"
        case _:
            return f"{who}: {event.kind} {event_text(event)}{about}"


def element_line(element: ConflictElement, is_tried: bool = False) -> str:
    """What an element says, whose it is, and, where no line of the model says it, what does.

    `is_tried`: it is an order of tokens that the planner gave up again.
    """
    text = element_text(element)
    if element.written and not _COMPARED.search(element.written):
        text = f"`{text}`, a part of this line"
    if _is_half(element):
        text += f", by `{_on_one_line(element)}`"
    is_told = element.kind is ElementKind.REQUEST or element.token is None  # whose it is, or that it does not matter
    if not is_told and element.token is not None and not element.names(element.token):
        text = f"{element.token}: {text}"
    return text + (_TRIED_ORDER if is_tried else _executed(element) or _ORIGINS.get(element.kind, ""))


def _executed(element: ConflictElement) -> str:
    """What the executive does with a token of its own, or that two tokens are one; empty for another order."""
    says = element.says
    if element.kind is not ElementKind.ORDER or not isinstance(says, Term):
        return ""
    match says.name, says.arguments:
        case "bounds", (VariableName(name="start"), lower, upper) if lower == upper:
            return " (as the executive begins it)"
        case "bounds", (VariableName(name="end"), lower, upper):
            return " (as the executive ends it)" if lower == upper else " (as it goes on)"
        case "precedence", (VariableName(token=one) as first, VariableName(token=other) as second, 0):
            is_one = one is not None and other is not None and one != other and one.predicate == other.predicate
            return " (both are one token)" if is_one and first.name == second.name else ""
        case _:
            return ""


def _is_half(element: ConflictElement) -> bool:
    """Whether an element is one side of an equality that the modeler wrote."""
    is_ordered = isinstance(element.says, Term) and element.says.name == "precedence"
    return is_ordered and bool(_EQUALITY.fullmatch(_on_one_line(element)))


def _on_one_line(element: ConflictElement) -> str:
    return " ".join(element.place.text.split()).rstrip(";") if element.place is not None else ""


def waiting_text(waiting: Waiting) -> str:
    """What was asked for and was not over, and how far it had come."""
    asked = f"{waiting.predicate} on `{waiting.timeline}`, asked for by {waiting.sender or 'the mission file'}"
    held = ", ".join(
        f"`{timeline}` holds {predicate} since tick {tick}" for timeline, predicate, tick in waiting.holding
    )
    if waiting.since is None:
        return f"{asked} at tick {waiting.asked}, has not begun" + (f": {held}" if held else "")
    used = f"; of what {waiting.owner} uses, {held}" if held else ""
    return f"{asked} at tick {waiting.asked}, goes on since tick {waiting.since}{used}"


def _end_text(abort: Abort | None, story: Story) -> str:
    code = story.judgement.code
    name = CODE_NAMES.get(code) or failure_text(story.judgement, story.open_goals)
    if abort is None:
        return f"the mission fails ({code}: {name})"
    repairs = f" after {abort.relaxes} repairs" if abort.relaxes else ""
    left = "; the others go on" if story.others_go_on else ""
    return f"{abort.reactor} gives up{repairs} ({code}: {name}){left}"
