"""Traces as plans: what observations of a mission tell of each timeline."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

from checker.judge.reading import read_json, read_token
from checker.judge.written_values import DocumentError, TypedValues
from compiler.program import Program
from runtime.executive.record import ReactorRecord, TokenRecord

_FORM = "one event a line, each with tick, kind, timeline, predicate"


def read_events(text: str) -> list[dict[str, Any]]:
    """The events of a trace in JSON Lines."""
    return [_event(line, number) for number, line in enumerate(text.splitlines(), 1) if line.strip()]


def plan_of_trace(
    events: Sequence[dict[str, Any]],
    timelines: tuple[str, ...],
    base: ReactorRecord,
    program: Program,
    *,
    last: int,
    step: float = 0.0,
) -> ReactorRecord:
    """What a trace up to tick `last` tells of some timelines: each observation holds until the next of its timeline.

    Floats are rounded to `step`.
    """
    classes = {each.name: each.class_name for each in base.objects}
    types = TypedValues(program, base.objects)
    tokens: list[TokenRecord] = []
    for timeline in timelines:
        seen = {event["tick"]: event for event in events if _is_observation(event, timeline)}
        ticks = sorted(seen)
        for tick, following in pairwise([*ticks, None]):
            assert tick is not None
            event = seen[tick]
            end = {"between": [last + 1, None]} if following is None else following
            written = {name: _argument(value, step) for name, value in event.get("arguments", {}).items()}
            data = {"predicate": f"{classes[timeline]}.{event['predicate']}", "object": timeline, "start": tick}
            data |= {"end": end, "origin": "observation", "tick": last}
            known = next((each for each in program.predicates if each.name == data["predicate"]), None)
            names = [parameter.name for parameter in known.parameters] if known is not None else []
            data["arguments"] = {name: value for name, value in written.items() if name in names}
            tokens.append(read_token(data, len(tokens), program, types))
    return base._replace(last_tick=last, script_tokens=(), tokens=tuple(tokens))


def _event(text: str, number: int) -> dict[str, Any]:
    event = read_json(text, f"line {number}")
    if not isinstance(event, dict) or type(event.get("tick")) is not int:
        raise DocumentError(f"line {number} has no `tick`", _FORM)
    if event.get("kind") == "observation":
        if not isinstance(event.get("predicate"), str):
            raise DocumentError(f"line {number} has no `predicate`", _FORM)
        if not isinstance(event.get("arguments", {}), dict):
            raise DocumentError(f"line {number}: its `arguments` are no object of JSON", _FORM)
    return event


def _is_observation(event: dict[str, Any], timeline: str) -> bool:
    return event.get("kind") == "observation" and event.get("timeline") == timeline


def _argument(value: Any, step: float) -> Any:
    """An argument of a trace: a value, `[lower, upper]` of numbers, or a list of names."""
    if isinstance(value, float) and step > 0.0:
        return {"between": [value - step / 2, value + step / 2]}
    if not isinstance(value, list):
        return value
    ends = [None if each in ("inf", "-inf") else each for each in value]
    is_range = len(ends) == 2 and all(isinstance(each, (int, float)) or each is None for each in ends)
    return {"between": ends} if is_range else {"one_of": value}
