"""Words for what happens in a mission: an event, reason or conflict in, one line out. Nobody else words them."""

import json
from math import inf
from typing import Any

from compiler.program import DomainConstant
from runtime.executive.messages import Arguments
from runtime.executive.outcome import (
    ChoiceKind,
    ConflictElement,
    Deadlock,
    Draw,
    ElementKind,
    Event,
    EventKind,
    FailedChoice,
    OpenGoal,
    Operand,
    Reason,
    ReasonKind,
    Term,
    TokenName,
    VariableName,
)

HALF_INFINITY = 2**51  # bounds beyond count as infinite (docs/engine.md)
REASONS = {
    ReasonKind.NO_LOOKAHEAD: "its owner does not look ahead and takes no goals",
    ReasonKind.NO_OWNER: "nobody owns `{timeline}` any more",
    ReasonKind.UNKNOWN_PREDICATE: "`{timeline}` has no predicate `{predicate}`",
    ReasonKind.MISFIT: "its arguments do not fit",
    ReasonKind.TOO_LATE: "too late",
    ReasonKind.DROPPED: "dropped in the repair",
    ReasonKind.REJECTED: "the planner found no place for it",
    ReasonKind.RECALLED: "taken back",
    ReasonKind.CLOCK: "the plan does not allow it to be tick {tick}",
    ReasonKind.GOES_ON: "{token} goes on at tick {tick}, later than the plan allows",
    ReasonKind.ENDED: "{token} ended at tick {tick}, when the plan does not allow it",
    ReasonKind.CANNOT_GO_ON: "{token} cannot go on at tick {tick}",
    ReasonKind.CANNOT_START: "{token} cannot start at tick {tick}",
    ReasonKind.NONE_CAN_START: "no {predicate} can start at tick {tick}",
    ReasonKind.DID_NOT_START: "{token} was to start by tick {tick} and did not",
    ReasonKind.UNMET: "what is asked of the present cannot be met",
    ReasonKind.CANNOT_RELAX: "the plan cannot be relaxed",
    ReasonKind.NO_PLACE: "no place for {token}",
    ReasonKind.NO_PLAN: "no plan inside the window",
    ReasonKind.STEPS: "more than {limit} decisions are needed about what holds at tick {tick}",
    ReasonKind.DEPTH: "more than {limit} decisions are needed at once",
    ReasonKind.RAISED: "its code failed: {message}",
    ReasonKind.GOALS_OPEN: "mandatory goals stayed open",
    ReasonKind.NO_RECORD: "ended at tick {tick} of {limit} without an abort record",
}
INFIX = {"eq": "==", "neq": "!=", "leq": "<=", "lt": "<"}
SIGNS = {"addEq": "+", "mulEq": "*", "temporalDistance": "+"}


# ---- names and values ----


def token_name(token: TokenName) -> str:
    """A token of the plan: `Gps.Active#7`."""
    return f"{token.predicate}#{token.key}"


def variable_name(variable: VariableName) -> str:
    """A variable of the plan: `Gps.Active#7.duration`, `Gps.Active#7::rate`, or that of a global one."""
    if variable.token is None:
        return variable.name
    return f"{token_name(variable.token)}{'::' if variable.is_local else '.'}{variable.name}"


def domain_text(domain: DomainConstant) -> str:
    """A domain: the value if there is one, `[lo hi]` or `{a, b}` otherwise."""
    if domain.interval is not None:
        lower, upper = domain.interval
        return repr(lower) if lower == upper else f"[{_bound(lower)} {_bound(upper)}]"
    values = [_value(value) for value in domain.values or ()]
    return values[0] if len(values) == 1 else "{" + ", ".join(values) + "}"


def token_text(predicate: str, arguments: Arguments) -> str:
    """What holds, or is to hold, on a timeline: `Run(distance=240.0)`."""
    inside = ", ".join(f"{name}={domain_text(domain)}" for name, domain in arguments)
    return f"{predicate}({inside})" if inside else predicate


def draw_text(draw: Draw) -> str:
    """A drawn value: `GPS_HIT_RATE = 3.9 (drawn 4.2)`."""
    clipped = "" if draw.raw == draw.value else f" (drawn {draw.raw!r})"
    return f"{draw.parameter} = {draw.value!r}{clipped}"


def _bound(value: float | int) -> str:
    return "+inf" if value >= HALF_INFINITY else "-inf" if value <= -HALF_INFINITY else repr(value)


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
            return draw_text(event.draw)
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
    """A reason as a clause."""
    token = token_name(reason.token) if reason.token is not None else ""
    return REASONS[reason.kind].format(
        token=token,
        predicate=reason.predicate,
        timeline=reason.timeline,
        tick=reason.tick,
        limit=reason.limit,
        message=reason.message,
    )


def goal_text(goal: OpenGoal) -> str:
    """A goal that stayed open, with its reason."""
    what = token_text(goal.predicate, goal.arguments)
    return f"{what}: {reason_text(goal.reason)}" if goal.reason is not None else what


# ---- conflicts ----


def element_text(element: ConflictElement) -> str:
    """What an element of a conflict says."""
    match element.kind:
        case ElementKind.LONGEST:
            assert element.token is not None
            return f"{token_name(element.token)} lasts as long as the model lets it"
        case ElementKind.SHARED_END:
            assert element.observed is not None
            predicate, timeline = element.observed
            return f"{predicate} on `{timeline}` is observed as long as it lasts"
        case _:
            assert element.says is not None
            return term_text(element.says)


def term_text(term: Term) -> str:
    """A constraint as a modeler writes it."""
    match term.name, term.arguments:
        case "precedence", (source, target, int(weight)) if weight < 0:
            return f"{operand_text(target)} + {-weight} <= {operand_text(source)}"
        case "precedence", (source, target, weight):
            plus = f" + {weight}" if weight else ""
            return f"{operand_text(target)} <= {operand_text(source)}{plus}"
        case "bounds", (variable, float() | int() as lower, float() | int() as upper):
            return _bounds_text(operand_text(variable), lower, upper)
        case "member", (variable, value):
            return f"{operand_text(variable)} = {value}"
        case "member", (variable, *values):
            return f"{operand_text(variable)} in {{{', '.join(map(operand_text, values))}}}"
        case "sampledParameter", (variable, parameter, value):
            return f"{operand_text(variable)} = {parameter} = {value!r}"
    texts = [operand_text(argument) for argument in term.arguments]
    if term.name in INFIX and len(texts) == 2:
        return f"{texts[0]} {INFIX[term.name]} {texts[1]}"
    if term.name in SIGNS and len(texts) == 3:
        return f"{texts[0]} {SIGNS[term.name]} {texts[1]} == {texts[2]}"
    return f"{term.name}({', '.join(texts)})"


def operand_text(operand: Operand) -> str:
    """A variable by its name in the model, a number, or a symbol."""
    match operand:
        case VariableName():
            return variable_name(operand)
        case str():
            return operand
        case _:
            return repr(operand)


def _bounds_text(name: str, lower: float, upper: float) -> str:
    if lower == upper:
        return f"{name} = {lower}"
    if lower == -inf:
        return f"{name} may be anything" if upper == inf else f"{name} <= {upper}"
    return f"{name} >= {lower}" if upper == inf else f"{name} in [{lower}, {upper}]"


# ---- what was tried ----


def choice_text(choice: FailedChoice) -> str:
    """A choice that was tried, without its conflict."""
    token = token_name(choice.token) if choice.token is not None else ""
    other = token_name(choice.other) if choice.other is not None else ""
    match choice.kind:
        case ChoiceKind.ACTIVATE:
            return f"activate {token}"
        case ChoiceKind.MERGE:
            return f"merge {token} into {other}"
        case ChoiceKind.REJECT:
            return f"reject {token}"
        case ChoiceKind.ORDER:
            return f"{token} before {other}"
        case ChoiceKind.SPECIFY:
            assert choice.variable is not None and choice.value is not None
            return f"{variable_name(choice.variable)} = {operand_text(choice.value)}"
        case ChoiceKind.EXTEND:
            return f"{token} goes on"
        case ChoiceKind.NEXT:
            return f"{token} starts"
        case ChoiceKind.NEW:
            return f"a new {choice.predicate} starts"
        case ChoiceKind.OBSERVE:
            return f"{choice.predicate} was observed and stands by itself"
        case ChoiceKind.MEET:
            return f"what was observed is {other}"


def deadlock_text(deadlock: Deadlock) -> str:
    """A flaw that no choice mends."""
    if deadlock.token is not None:
        return f"{token_name(deadlock.token)} has no place"
    if deadlock.variable is not None:
        return f"{variable_name(deadlock.variable)} has no value"
    return f"nothing can hold on `{deadlock.timeline}`"


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
        "arguments": {name: domain_data(domain) for name, domain in event.arguments},
        "causes": list(event.causes),
    }
    if event.token is not None:
        data["token"] = token_name(event.token)
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
        data["reason"] = reason_data(event.reason)
    if event.conflict is not None:
        data["conflict"] = [element_data(element) for element in event.conflict.elements]
    if event.deadlock is not None:
        data["tried"] = deadlock_data(event.deadlock)
    return data


def domain_data(domain: DomainConstant) -> Any:
    """A domain: a value, `[lo, hi]` or a list; infinite bounds are `-inf` and `inf`."""
    if domain.interval is not None:
        lower, upper = domain.interval
        return lower if lower == upper else [_number_data(lower), _number_data(upper)]
    values = list(domain.values or ())
    return values[0] if len(values) == 1 else values


def reason_data(reason: Reason) -> dict[str, Any]:
    """A reason: its kind, what it is about, and the words for it."""
    found: dict[str, Any] = {"kind": reason.kind.value}
    if reason.token is not None:
        found["token"] = token_name(reason.token)
    for name in ("predicate", "timeline", "tick", "limit", "message"):
        if (value := getattr(reason, name)) not in (None, ""):
            found[name] = value
    return found | {"words": reason_text(reason)}


def element_data(element: ConflictElement) -> dict[str, Any]:
    """An element of a conflict."""
    place = element.place
    return {
        "kind": element.kind.value,
        "rule": element.rule,
        "token": token_name(element.token) if element.token is not None else None,
        "place": place and {"file": place.file, "line": place.line, "column": place.column, "text": place.text},
        "terms": [[term.name, *(_operand_data(one) for one in term.arguments)] for term in element.terms],
        "words": element_text(element),
    }


def deadlock_data(deadlock: Deadlock) -> dict[str, Any]:
    """A flaw, with each choice that was tried and why it failed."""
    return {
        "flaw": deadlock_text(deadlock),
        "choices": [
            {
                "choice": choice_text(one),
                "conflict": None if one.conflict is None else [element_data(each) for each in one.conflict.elements],
                "leads_to": None if one.leads_to is None else deadlock_data(one.leads_to),
            }
            for one in deadlock.tried
        ],
    }


def _operand_data(operand: Operand) -> Any:
    match operand:
        case VariableName():
            return {"variable": variable_name(operand), "reactor": operand.reactor}
        case str():
            return operand
        case _:
            return _number_data(operand)


def _number_data(value: float | int) -> float | int | str:
    return "inf" if value >= HALF_INFINITY else "-inf" if value <= -HALF_INFINITY else value
