"""Plans and records as JSON, in the form that docs/validate.md describes; records that the judge reads out."""

import json
from collections.abc import Iterable
from math import inf, isfinite
from typing import Any

from checker.judge.values import ends_of
from checker.judge.written_values import TICK, DocumentError, TypedValues, unknown
from compiler.program import PredicateCode, Program, TypeCode
from nddl_lang.text.values import json_value
from runtime.executive.record import (
    NOBODY,
    BodyRun,
    GuardRun,
    MissionRecord,
    ObjectRecord,
    ReactorRecord,
    TokenRecord,
    Value,
    ValueRange,
)

_STATES = ("active", "merged", "inactive", "rejected")
_ORIGINS = ("own", "rule", "request", "observation", "goal", "fact")
_FATES = ("end", "over", "cut")
_BRANCHES = ("waiting", "then", "else")
_ANY = {"between": [None, None]}
_PLAN_KEYS = ("model", "reactor", "last_tick", "globals", "members", "tokens", "script_tokens")
_LOCAL = TypeCode("symbol", "symbol", None)  # any value will do


def read_json(text: str, where: str = "it") -> Any:
    """A document out of its text."""
    try:
        return json_value(text, _refuse)
    except json.JSONDecodeError as problem:
        raise DocumentError(
            f"{where} is no JSON: {problem.msg.lower()} at line {problem.lineno}, column {problem.colno}"
        ) from None


def _refuse(name: str) -> None:
    raise DocumentError(f"`{name}` is no number of JSON", 'leave out what is open, or write {"between": [0, null]}')


def read_record(data: Any, bases: dict[str, ReactorRecord], programs: dict[str, Program]) -> MissionRecord:
    """The record that `record_data` wrote; `bases` are the reactors' models as loaded, `programs` compiled."""
    _check_keys(data, ("mission", "seed", "reactors"), "the record")
    reactors = []
    for each in _list(data, "reactors", "the record"):
        name = _field(each, "reactor", "a name", "a reactor")
        if name not in bases:
            raise unknown(f"the mission has no reactor `{name}`", name, bases)
        reactors.append(read_plan(each, bases[name], programs[name]))
    return MissionRecord(tuple(reactors))


def read_plan(data: Any, base: ReactorRecord, program: Program) -> ReactorRecord:
    """A plan over a model: tokens, and what else the document says; the rest is as in `base`, the loaded model."""
    _check_keys(data, _PLAN_KEYS, "the plan")
    types = TypedValues(program, base.objects)
    worlds = _globals(data.get("globals", {}), base, program, types)
    things = _members(data.get("members", {}), base, program, types)
    tokens = tuple(
        read_token(each, number, program, types) for number, each in enumerate(_list(data, "tokens", "the plan"))
    )
    keys: set[int] = set()
    for token in tokens:
        if token.key in keys:
            raise DocumentError(f"two tokens have the key {token.key}", "without `key` it is the place in the list")
        keys.add(token.key)
    for token in tokens:
        if token.merged_into != NOBODY and token.merged_into not in keys:
            raise DocumentError(f"token {token.key}: `merged_into`: there is no token {token.merged_into}")
        if token.state == "merged" and token.merged_into == NOBODY:
            raise DocumentError(f"token {token.key} is merged, but lacks `merged_into`")
    last = data.get("last_tick", max(map(_latest, tokens), default=0))
    if not _is_whole(last):
        raise DocumentError(f"`last_tick` is a whole number, not {json.dumps(last)}")
    script = _whole_numbers(data, "script_tokens", "the plan")
    return ReactorRecord(str(data.get("reactor", base.reactor)), last, worlds, things, script, tokens)


def _latest(token: TokenRecord) -> int:
    """The last tick at which a token may end, or begin, as far as that is bounded."""
    bounds = [bound for value in (token.start, token.end) for bound in ends_of(value)]
    return int(max((bound for bound in bounds if isfinite(bound)), default=0))


def _globals(given: Any, base: ReactorRecord, program: Program, types: TypedValues) -> tuple[Value, ...]:
    """The global variables: all as a list, or some by name."""
    declared = dict(program.globals)
    if isinstance(given, list):
        if len(given) != len(declared):
            raise DocumentError(f"the model has {len(declared)} global variables, not {len(given)}")
        pairs = zip(given, program.globals, strict=True)
        return tuple([types.read(each, type_, f"the global variable `{name}`") for each, (name, type_) in pairs])
    found = dict(zip(declared, base.globals, strict=True))
    for name, value in _object(given, "`globals`").items():
        if name not in declared:
            raise unknown(f"the model has no global variable `{name}`", name, declared)
        found[name] = types.read(value, declared[name], f"the global variable `{name}`")
    return tuple(found.values())


def _members(given: Any, base: ReactorRecord, program: Program, types: TypedValues) -> tuple[ObjectRecord, ...]:
    """The objects, with the members that the document gives some of them."""
    classes = {each.name: each for each in program.classes}
    changed = {}
    known = {each.name: each for each in base.objects}
    for name, values in _object(given, "`members`").items():
        if name not in known:
            raise unknown(f"the model has no object `{name}`", name, known)
        members = classes[known[name].class_name].members
        if not isinstance(values, list) or len(values) != len(members):
            names = ", ".join(f"`{each.name}`" for each in members)
            raise DocumentError(f"`members` of `{name}`: a list of {len(members)} values is wanted", names or None)
        pairs = zip(values, members, strict=True)
        read = [types.read(value, each.type, f"`{each.name}` of `{name}`") for value, each in pairs]
        changed[name] = known[name]._replace(members=tuple(read))
    return tuple([changed.get(each.name, each) for each in base.objects])


def read_token(data: Any, number: int, program: Program, types: TypedValues) -> TokenRecord:
    """One token; its key is its place in the list where it has no other."""
    key = data.get("key", number) if isinstance(data, dict) else number
    where = f"token {key}"
    _check_keys(data, TokenRecord._fields, where)
    if not _is_whole(key):
        raise DocumentError(f"{where}: `key` is a whole number")
    code = _predicate(_field(data, "predicate", "a name", where), program, where)
    where = f"{where} ({code.name})"
    start, end = (types.read(data.get(each, _ANY), TICK, f"{where}: `{each}`") for each in ("start", "end"))
    if isinstance(start, int) and isinstance(end, int) and end < start:
        raise DocumentError(f"{where} ends at {end}, before it starts at {start}", "are the two swapped?")
    length: Value = end - start if isinstance(start, int) and isinstance(end, int) else ValueRange(0, inf)
    duration = types.read(data["duration"], TICK, f"{where}: `duration`") if "duration" in data else length
    if "object" not in data:
        raise DocumentError(f"{where} lacks `object`", f"the name of an object of the class `{code.class_name}`")
    thing = types.read(data["object"], TypeCode("object", code.class_name, None), f"{where}: `object`")
    code = _own(code, thing, program, types)
    return TokenRecord(
        key,
        code.name,
        thing,
        _one_of(data, "state", _STATES, where),
        duration,
        start,
        end,
        _arguments(data.get("arguments", {}), code, types, where),
        _whole(data, "merged_into", NOBODY, where),
        _one_of(data, "origin", _ORIGINS, where),
        _one_of(data, "fate", _FATES, where),
        _whole(data, "tick", 0, where),
        tuple(_read_run(each, where, program, types) for each in _optional_list(data, "runs", where)),
    )


def _predicate(name: str, program: Program, where: str) -> PredicateCode:
    known = {each.name: each for each in program.predicates}
    if name in known:
        return known[name]
    same = [each for each in known if each.rpartition(".")[2] == name]
    if same:
        raise DocumentError(f"{where}: `predicate` lacks its class", f"write `{'` or `'.join(same)}`")
    raise unknown(f"{where}: the model has no predicate `{name}`", name, known)


def _own(code: PredicateCode, thing: Value, program: Program, types: TypedValues) -> PredicateCode:
    """The predicate of a resource's own class, where that of the built-in class is named: the events are the same."""
    own = f"{types.objects.get(str(thing), '')}.{code.name.rpartition('.')[2]}"
    return next((each for each in program.predicates if each.name == own), code) if code.span is None else code


def _arguments(given: Any, code: PredicateCode, types: TypedValues, where: str) -> tuple[Value, ...]:
    """The arguments: all as a list, or some by name; what is missing is open."""
    parameters = {each.name: each.type for each in code.parameters}
    if isinstance(given, list):
        if len(given) != len(parameters):
            raise DocumentError(f"{where}: `{code.name}` has {len(parameters)} parameters, not {len(given)}")
        given = dict(zip(parameters, given, strict=True))
    found: dict[str, Value] = dict.fromkeys(parameters, ValueRange(-inf, inf))
    for name, value in _object(given, f"{where}: `arguments`").items():
        if name not in parameters:
            raise unknown(f"{where}: `{code.name}` has no parameter `{name}`", name, parameters)
        found[name] = types.read(value, parameters[name], f"{where}: `{name}`")
    return tuple(found.values())


def _read_run(data: Any, where: str, program: Program, types: TypedValues) -> BodyRun:
    number: Any = _object(data, f"{where}: a run").get("rule")
    if not _is_whole(number) or not 0 <= number < len(program.rules):
        what = f"{where}: `rule` is a number from 0 to {len(program.rules) - 1}, not {json.dumps(number)}"
        raise DocumentError(what, "leave `runs` out, and they are found out")
    guards = []
    for guard in _optional_list(data, "guards", where):
        branch = _one_of(guard, "branch", _BRANCHES, f"{where}: a guard")
        run = None if guard.get("run") is None else _read_run(guard["run"], where, program, types)
        guards.append(GuardRun(branch, bool(guard.get("is_decided", True)), run))
    named = tuple(
        types.read(each, _LOCAL, f"{where}: a local variable") for each in _optional_list(data, "locals", where)
    )
    return BodyRun(number, named, _whole_numbers(data, "children", where), tuple(guards))


# ---- keys ----


def _check_keys(data: Any, known: Iterable[str], where: str) -> None:
    for name in _object(data, where):
        if name not in known:
            raise unknown(f"{where} has a key `{name}`, which says nothing", name, tuple(known))


def _object(data: Any, where: str) -> dict[str, Any]:
    if not isinstance(data, dict):
        raise DocumentError(f"{where} is no object of JSON, but {json.dumps(data)[:40]}")
    return data


def _field(data: dict[str, Any], name: str, what: str, where: str) -> str:
    if name not in _object(data, where):
        raise DocumentError(f"{where} lacks `{name}`")
    if not isinstance(data[name], str):
        raise DocumentError(f"{where}: `{name}` is {what}, not {json.dumps(data[name])}")
    return str(data[name])


def _list(data: Any, name: str, where: str) -> list[Any]:
    if name not in _object(data, where):
        raise DocumentError(f"{where} lacks `{name}`")
    if not isinstance(data[name], list):
        raise DocumentError(f"{where}: `{name}` is a list")
    found: list[Any] = data[name]
    return found


def _optional_list(data: dict[str, Any], name: str, where: str) -> list[Any]:
    return _list(data, name, where) if name in data else []


def _whole_numbers(data: dict[str, Any], name: str, where: str) -> tuple[int, ...]:
    numbers = _optional_list(data, name, where)
    if not all(map(_is_whole, numbers)):
        raise DocumentError(f"{where}: `{name}` is a list of whole numbers, not {json.dumps(numbers)[:40]}")
    return tuple(numbers)


def _one_of(data: Any, name: str, known: tuple[str, ...], where: str) -> str:
    """A word; the first one where it is missing."""
    word = _object(data, where).get(name, known[0])
    if word not in known:
        raise DocumentError(f"{where}: `{name}` is one of {', '.join(known)}, not {json.dumps(word)}")
    return str(word)


def _whole(data: dict[str, Any], name: str, otherwise: int, where: str) -> int:
    number = data.get(name, otherwise)
    if not _is_whole(number):
        raise DocumentError(f"{where}: `{name}` is a whole number, not {json.dumps(number)}")
    return int(number)


def _is_whole(data: Any) -> bool:
    return isinstance(data, int) and not isinstance(data, bool)
