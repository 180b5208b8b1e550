"""Words for what happens in a mission: an event, reason or conflict in, one line out. Nobody else words them."""

import json
from sys import float_info
from typing import Any

from compiler.program import DomainConstant
from runtime.constraints.domains.tags import HALF_INF
from runtime.executive.messages import Arguments
from runtime.executive.outcome import (
    ChoiceKind,
    ConflictElement,
    Deadlock,
    Draw,
    ElementKind,
    Event,
    EventKind,
    OpenGoal,
    PresentChoice,
    Reason,
    ReasonKind,
)
from runtime.plan.readout.cause_rendering import words
from runtime.plan.readout.names import VariableName
from runtime.plan.readout.statements import Argument
from runtime.solver.learning.attempts import Resolver
from runtime.solver.learning.rendering import flaw_words, resolver_words

_REASONS = {
    ReasonKind.NO_LOOKAHEAD: "its owner does not look ahead and takes no goals",
    ReasonKind.NO_OWNER: "nobody owns `{timeline}` any more",
    ReasonKind.UNKNOWN_PREDICATE: "`{timeline}` has no predicate `{predicate}`",
    ReasonKind.MISFIT: "its arguments do not fit{message}",
    ReasonKind.TIMES: "its times do not fit{message}",
    ReasonKind.TOO_LATE: "too late",
    ReasonKind.DROPPED: "dropped in the repair",
    ReasonKind.LACKING: "an owner has given up what it needs",
    ReasonKind.REJECTED: "the planner found no place for it",
    ReasonKind.RECALLED: "taken back",
    ReasonKind.CLOCK: "the plan does not allow it to be tick {tick}",
    ReasonKind.GOES_ON: "{token}{since} goes on at tick {tick}, later than the plan allows",
    ReasonKind.ENDED: "{token}{since} ended at tick {tick}, when the plan does not allow it",
    ReasonKind.CANNOT_GO_ON: "{token}{since} cannot go on at tick {tick}",
    ReasonKind.CANNOT_START: "{token} cannot start at tick {tick}",
    ReasonKind.NONE_CAN_START: "no {predicate} can start at tick {tick}",
    ReasonKind.DID_NOT_START: "{token} was to start by tick {tick} and did not",
    ReasonKind.UNMET: "what is asked of the present cannot be met",
    ReasonKind.CANNOT_RELAX: "the plan cannot be relaxed",
    ReasonKind.NO_INSERTION: "no place for {token}",
    ReasonKind.NO_PLAN: "no plan inside the window",
    ReasonKind.STEPS: "more than {limit} decisions are needed about what holds at tick {tick}",
    ReasonKind.DEPTH: "more than {limit} decisions are needed at once",
    ReasonKind.UNLOADABLE: "its model does not load: {message}",
    ReasonKind.RAISED: "its code failed: {message}",
    ReasonKind.DECLINED: "its code does not do it: {message}",
    ReasonKind.GOALS_OPEN: "mandatory goals stayed open",
    ReasonKind.HELD_FAILED: "`{timeline}` holds `Failed` from tick {tick} on",
    ReasonKind.NO_RECORD: "ended at tick {tick} of {limit} without an abort record",
    ReasonKind.CUT_LOOSE: "it began, and a repair has cut it loose from what was to end it",
    ReasonKind.CUT_OFF: "{predicate} on `{timeline}` counts as achieved, but was cut off by a repair",
}


# ---- names and values ----


def _domain_text(domain: DomainConstant) -> str:
    """A domain: the value if there is one, `[lo hi]` or `{a, b}` otherwise."""
    if domain.interval is not None:
        lower, upper = domain.interval
        return repr(lower) if lower == upper else f"[{_bound(lower)} {_bound(upper)}]"
    values = [_value(value) for value in domain.values or ()]
    return values[0] if len(values) == 1 else "{" + ", ".join(values) + "}"


def token_text(predicate: str, arguments: Arguments) -> str:
    """What holds, or is to hold, on a timeline: `Run(distance=240.0)`."""
    inside = ", ".join(f"{name}={_domain_text(domain)}" for name, domain in arguments)
    return f"{predicate}({inside})" if inside else predicate


def _draw_text(draw: Draw) -> str:
    """A drawn value: `GPS_HIT_RATE = 3.9 (drawn 4.2)`."""
    clipped = "" if draw.raw == draw.value else f" (drawn {draw.raw!r})"
    return f"{draw.parameter} = {draw.value!r}{clipped}"


def _bound(value: float | int) -> str:
    if abs(value) < float_info.min:
        return repr(type(value)(0))  # an open bound next to zero
    return "+inf" if value >= HALF_INF else "-inf" if value <= -HALF_INF else repr(value)


def _value(value: float | int | bool | str) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return value if isinstance(value, str) else repr(value)


# ---- events ----


def event_text(event: Event) -> str:
    """What happened, without tick, kind, reactor and timeline."""
    what = token_text(event.predicate, event.arguments) if event.predicate else ""
    why = reason_text(event.reason) if event.reason is not None else ""
    match event.kind:
        case EventKind.SAMPLE:
            assert event.draw is not None
            return _draw_text(event.draw)
        case EventKind.RELAX:
            return ": ".join(filter(None, (event.stage, why)))
        case EventKind.END:
            return " ".join(filter(None, (f"mission over at tick {event.tick}", event.code and f"({event.code})")))
        case _:
            return ": ".join(filter(None, (event.code, what, why)))


def trace_line(event: Event) -> str:
    """An event as a line of the canonical text of a trace."""
    return f"{event.tick:>7}  {event.reactor:<12} {event.kind:<12} {event.timeline:<10} {event_text(event)}".rstrip()


def reason_text(reason: Reason) -> str:
    """A reason as a clause, and what it came of."""
    origin = f" ({reason_text(reason.repair)})" if reason.repair is not None else ""
    text = _REASONS[reason.kind].format(
        token=reason.token,
        predicate=reason.predicate,
        timeline=reason.timeline,
        tick=reason.tick,
        since="" if reason.since is None else f" of tick {reason.since}",
        limit=reason.limit,
        message=reason.message,
    )
    return text + origin


def goal_text(goal: OpenGoal) -> str:
    """A goal that stayed open, with its reason."""
    what = token_text(goal.predicate, goal.arguments)
    return f"{what}: {reason_text(goal.reason)}" if goal.reason is not None else what


# ---- conflicts ----


def element_text(element: ConflictElement) -> str:
    """What an element of a conflict says."""
    match element.kind:
        case ElementKind.LONGEST:
            return f"{element.token} lasts as long as the model lets it"
        case ElementKind.SHARED_END:
            assert element.observed is not None
            predicate, timeline = element.observed
            return f"{predicate} on `{timeline}` is observed as long as it lasts"
        case _:
            assert element.says is not None
            return element.written or words(element.says)


# ---- what was tried ----


def choice_text(choice: Resolver | PresentChoice) -> str:
    """A choice that was tried, without its conflict."""
    if isinstance(choice, Resolver):
        return resolver_words(choice)
    match choice.kind:
        case ChoiceKind.EXTEND:
            return f"{choice.token} goes on"
        case ChoiceKind.NEXT:
            return f"{choice.token} starts"
        case ChoiceKind.NEW:
            return f"a new {choice.predicate} starts"
        case ChoiceKind.OBSERVE:
            return f"{choice.predicate} was observed and stands by itself"
        case ChoiceKind.MEET:
            return f"what was observed is {choice.token}"


def deadlock_text(deadlock: Deadlock) -> str:
    """A flaw, or a timeline, for which no choice is left."""
    return flaw_words(deadlock.flaw) if deadlock.flaw is not None else f"nothing can hold on `{deadlock.timeline}`"


# ---- the machine form ----


def trace_json(event: Event) -> str:
    """An event as a line of a JSON Lines trace; what does not belong to its kind is left out (docs/report.md)."""
    return json.dumps(event_data(event), ensure_ascii=False, separators=(",", ":"), allow_nan=False)


def event_data(event: Event) -> dict[str, Any]:
    """An event as plain data."""
    data: dict[str, Any] = {
        "tick": event.tick,
        "phase": event.phase.value,
        "kind": event.kind.value,
        "reactor": event.reactor,
        "timeline": event.timeline,
        "predicate": event.predicate,
        "arguments": {name: _domain_data(domain) for name, domain in event.arguments},
        "causes": list(event.causes),
    }
    if event.token is not None:
        data["token"] = str(event.token)
    if event.request is not None:
        data["request"] = event.request
    if event.bounds is not None:
        bounds = event.bounds
        times = {"start": bounds.start, "end": bounds.end, "duration": bounds.duration}
        data |= {name: [_number_data(bound) for bound in pair] for name, pair in times.items()}
    if event.draw is not None:
        data |= {"parameter": event.draw.parameter, "raw": event.draw.raw, "value": event.draw.value}
    if event.stage is not None:
        data["stage"] = event.stage.value
    if event.code:
        data["code"] = event.code
    if event.reason is not None:
        data["reason"] = _reason_data(event.reason)
    if event.conflict is not None:
        data["conflict"] = [_element_data(element) for element in event.conflict.elements]
    if event.deadlock is not None:
        data["tried"] = _deadlock_data(event.deadlock)
    return data


def _domain_data(domain: DomainConstant) -> Any:
    """A domain: a value, `[lo, hi]` or a list; infinite bounds are `-inf` and `inf`."""
    if domain.interval is not None:
        lower, upper = domain.interval
        return lower if lower == upper else [_number_data(lower), _number_data(upper)]
    values = list(domain.values or ())
    return values[0] if len(values) == 1 else values


def _reason_data(reason: Reason) -> dict[str, Any]:
    """A reason: its kind, what it is about, and the words for it."""
    found: dict[str, Any] = {"kind": reason.kind.value}
    if reason.token is not None:
        found["token"] = str(reason.token)
    for name in ("predicate", "timeline", "tick", "since", "limit", "message"):
        if (value := getattr(reason, name)) not in (None, ""):
            found[name] = value
    if reason.repair is not None:
        found["because"] = _reason_data(reason.repair)
    return found | {"words": reason_text(reason)}


def _element_data(element: ConflictElement) -> dict[str, Any]:
    """An element of a conflict."""
    place = element.place
    return {
        "kind": element.kind.value,
        "rule": element.rule,
        "token": str(element.token) if element.token is not None else None,
        "place": place and {"file": place.file, "line": place.line, "column": place.column, "text": place.text},
        "terms": [[term.name, *map(_argument_data, term.arguments), *term.values] for term in element.terms],
        "words": element_text(element),
    }


def _deadlock_data(deadlock: Deadlock) -> dict[str, Any]:
    """A flaw, with each choice that was tried and why it failed."""
    return {
        "flaw": deadlock_text(deadlock),
        "choices": [
            {
                "choice": choice_text(one.choice),
                "conflict": None if one.conflict is None else [_element_data(each) for each in one.conflict.elements],
                "leads_to": None if one.leads_to is None else _deadlock_data(one.leads_to),
            }
            for one in deadlock.tried
        ],
    }


def _argument_data(argument: Argument) -> Any:
    match argument:
        case VariableName():
            return {"variable": str(argument), "reactor": argument.reactor}
        case str():
            return argument
        case _:
            return _number_data(argument)


def _number_data(value: float | int) -> float | int | str:
    return "inf" if value >= HALF_INF else "-inf" if value <= -HALF_INF else value
