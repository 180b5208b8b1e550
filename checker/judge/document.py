"""Plans, records and traces as JSON: what docs/validate.md describes in, records that the judge reads out, and back."""

import json
from math import inf, isinf
from typing import Any

from compiler.program import Program
from runtime.executive.record import (
    NOBODY,
    BodyRun,
    GuardRun,
    MissionRecord,
    OpenValues,
    ReactorRecord,
    TokenRecord,
    Value,
    ValueRange,
)

STATES = ("active", "merged", "inactive", "rejected")
ANY = {"between": [None, None]}
BRANCHES = ("waiting", "then", "else")


class DocumentError(ValueError):
    """A document that is not of the form that docs/validate.md describes."""


# ---- values ----


def value_data(value: Value) -> Any:
    """A value as JSON: itself, `{"between": [lower, upper]}` (null: no bound) or `{"one_of": [...]}`."""
    if isinstance(value, ValueRange):
        return {"between": [None if isinf(end) else end for end in value]}
    if isinstance(value, OpenValues):
        return {"one_of": list(value.values)}
    return value


def read_value(data: Any, where: str) -> Value:
    """The value that `value_data` wrote."""
    match data:
        case bool() | int() | float() | str():
            return data
        case {"between": [lower, upper]}:
            return ValueRange(-inf if lower is None else lower, inf if upper is None else upper)
        case {"one_of": [*values]}:
            return OpenValues(tuple(values))
        case _:
            raise DocumentError(f"{where} is no value: {json.dumps(data)}")


# ---- records ----


def record_data(record: MissionRecord) -> dict[str, Any]:
    """A mission's record as JSON."""
    return {"reactors": [_reactor_data(each) for each in record.reactors]}


def _reactor_data(record: ReactorRecord) -> dict[str, Any]:
    return {
        "reactor": record.reactor,
        "last_tick": record.last_tick,
        "globals": [value_data(each) for each in record.globals],
        "members": {each.name: [value_data(value) for value in each.members] for each in record.objects},
        "script_tokens": list(record.script_tokens),
        "tokens": [_token_data(each) for each in record.tokens],
    }


def _token_data(token: TokenRecord) -> dict[str, Any]:
    return {
        **token._asdict(),
        "object": value_data(token.object),
        "duration": value_data(token.duration),
        "start": value_data(token.start),
        "end": value_data(token.end),
        "arguments": [value_data(each) for each in token.arguments],
        "runs": [_run_data(run) for run in token.runs],
    }


def _run_data(run: BodyRun) -> dict[str, Any]:
    return {
        "rule": run.rule,
        "locals": [value_data(each) for each in run.locals],
        "children": list(run.children),
        "guards": [
            {
                "branch": guard.branch,
                "is_decided": guard.is_decided,
                "run": None if guard.run is None else _run_data(guard.run),
            }
            for guard in run.guards
        ],
    }


def read_record(data: Any, bases: dict[str, ReactorRecord], programs: dict[str, Program]) -> MissionRecord:
    """The record that `record_data` wrote; `bases` are the reactors' models as loaded, `programs` compiled."""
    reactors = []
    for each in _list(data, "reactors", "the record"):
        name = _field(each, "reactor", str, "a reactor")
        if name not in bases:
            raise DocumentError(f"the mission has no reactor `{name}`")
        reactors.append(read_plan(each, bases[name], programs[name]))
    return MissionRecord(tuple(reactors))


def read_plan(data: Any, base: ReactorRecord, program: Program) -> ReactorRecord:
    """A plan over a model: tokens, and what else the document says; the rest is as in `base`, the loaded model."""
    worlds = list(base.globals)
    given = data.get("globals", {})
    names = [name for name, _ in program.globals]
    if isinstance(given, list):
        worlds = [read_value(each, "a global variable") for each in given]
        if len(worlds) != len(names):
            raise DocumentError(f"the model has {len(names)} global variables, not {len(worlds)}")
    else:
        for name, value in given.items():
            if name not in names:
                raise DocumentError(f"the model has no global variable `{name}`")
            worlds[names.index(name)] = read_value(value, f"`{name}`")
    members = data.get("members", {})
    things = tuple(
        each._replace(members=tuple(read_value(value, f"a member of `{each.name}`") for value in members[each.name]))
        if each.name in members
        else each
        for each in base.objects
    )
    tokens = tuple(_read_token(each, number, program) for number, each in enumerate(_list(data, "tokens", "the plan")))
    if len({token.key for token in tokens}) < len(tokens):
        raise DocumentError("two tokens have the same `key`")
    ends = [int(token.end) for token in tokens if isinstance(token.end, int)]
    last = data.get("last_tick", max(ends, default=0))
    if not isinstance(last, int):
        raise DocumentError("`last_tick` is a whole number")
    script = tuple(data.get("script_tokens", ()))
    return ReactorRecord(str(data.get("reactor", base.reactor)), last, tuple(worlds), things, script, tokens)


def _read_token(data: Any, number: int, program: Program) -> TokenRecord:
    key = data.get("key", number) if isinstance(data, dict) else number
    where = f"token {key}"
    predicate = _field(data, "predicate", str, where)
    code = next((each for each in program.predicates if each.name == predicate), None)
    if code is None:
        raise DocumentError(f"{where}: the model has no predicate `{predicate}`")
    start = read_value(data.get("start", ANY), f"{where}: start")
    end = read_value(data.get("end", ANY), f"{where}: end")
    length: Value = end - start if isinstance(start, int) and isinstance(end, int) else ValueRange(0, inf)
    duration = read_value(data["duration"], f"{where}: duration") if "duration" in data else length
    given = data.get("arguments", {})
    arguments: list[Value] = [ValueRange(-inf, inf)] * len(code.parameters)
    names = [parameter.name for parameter in code.parameters]
    if isinstance(given, list):
        given = dict(zip(names, given, strict=False))
    for name, value in given.items():
        if name not in names:
            raise DocumentError(f"{where}: `{predicate}` has no parameter `{name}`")
        arguments[names.index(name)] = read_value(value, f"{where}: `{name}`")
    state = data.get("state", "active")
    if state not in STATES:
        raise DocumentError(f"{where}: `state` is one of {', '.join(STATES)}")
    return TokenRecord(
        key,
        predicate,
        read_value(_field(data, "object", (str, dict), where), f"{where}: object"),
        state,
        duration,
        start,
        end,
        tuple(arguments),
        data.get("merged_into", NOBODY),
        data.get("origin", "own"),
        data.get("fate", "end"),
        data.get("tick", 0),
        tuple(_read_run(each, where, len(program.rules)) for each in data.get("runs", ())),
    )


def _read_run(data: Any, where: str, rules: int) -> BodyRun:
    number = _field(data, "rule", int, where)
    if not 0 <= number < rules:
        raise DocumentError(f"{where}: the model has no rule {number}")
    guards = []
    for guard in data.get("guards", ()):
        if guard.get("branch") not in BRANCHES:
            raise DocumentError(f"{where}: `branch` is one of {', '.join(BRANCHES)}")
        run = None if guard.get("run") is None else _read_run(guard["run"], where, rules)
        guards.append(GuardRun(guard["branch"], bool(guard.get("is_decided", True)), run))
    named = tuple(read_value(each, f"{where}: a local") for each in data.get("locals", ()))
    return BodyRun(number, named, tuple(data.get("children", ())), tuple(guards))


def _field(data: Any, name: str, kind: Any, where: str) -> Any:
    if not isinstance(data, dict) or not isinstance(data.get(name), kind):
        raise DocumentError(f"{where} lacks `{name}`")
    return data[name]


def _list(data: Any, name: str, where: str) -> list[Any]:
    found: list[Any] = _field(data, name, list, where)
    return found


# ---- traces ----


def plan_of_trace(lines: list[str], timelines: tuple[str, ...], base: ReactorRecord, program: Program) -> ReactorRecord:
    """What a trace tells of some timelines: each observation holds until the next of its timeline."""
    events = [_event(text, number) for number, text in enumerate(lines, 1) if text.strip()]
    last = max((event["tick"] for event in events), default=0)
    classes = {each.name: each.class_name for each in base.objects}
    tokens: list[TokenRecord] = []
    for timeline in timelines:
        seen = {event["tick"]: event for event in events if _is_observation(event, timeline)}
        ticks = sorted(seen)
        for tick, following in zip(ticks, [*ticks[1:], None], strict=True):
            event = seen[tick]
            end = {"between": [last + 1, None]} if following is None else following
            written = {name: _argument(value) for name, value in event.get("arguments", {}).items()}
            data = {"predicate": f"{classes[timeline]}.{event['predicate']}", "object": timeline, "start": tick}
            data |= {"end": end, "origin": "observation", "tick": last}
            known = next((each for each in program.predicates if each.name == data["predicate"]), None)
            names = [parameter.name for parameter in known.parameters] if known is not None else []
            data["arguments"] = {name: value for name, value in written.items() if name in names}
            tokens.append(_read_token(data, len(tokens), program))
    return base._replace(last_tick=last, script_tokens=(), tokens=tuple(tokens))


def _event(text: str, number: int) -> dict[str, Any]:
    try:
        event = json.loads(text)
    except json.JSONDecodeError as problem:
        raise DocumentError(f"line {number} is no JSON: {problem}") from None
    if not isinstance(event, dict) or not isinstance(event.get("tick"), int):
        raise DocumentError(f"line {number} has no `tick`")
    return event


def _is_observation(event: dict[str, Any], timeline: str) -> bool:
    return event.get("kind") == "observation" and event.get("timeline") == timeline


def _argument(value: Any) -> Any:
    """An argument of a trace: a value, `[lower, upper]` of numbers, or a list of names."""
    if not isinstance(value, list):
        return value
    is_range = len(value) == 2 and all(isinstance(each, (int, float)) or each is None for each in value)
    return {"between": value} if is_range else {"one_of": value}
