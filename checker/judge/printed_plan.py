"""What `nddlc plan --json` prints, or another planner in the form of the conformance suite; the plan document out."""

import json
import re
from math import inf
from typing import Any

from checker.judge.written_values import DocumentError
from compiler.program import Program
from runtime.executive.record import ReactorRecord

_DOMAIN = re.compile(r"(?P<values>\[.*\]|\{.*\}) (?P<type>\S+)(?: open)?", re.DOTALL)
_ANY = {"between": [None, None]}


def is_printed(data: dict[str, Any]) -> bool:
    """Whether a document is what a planner printed: the model, and what became of it."""
    return "model" not in data and isinstance(data.get("file"), str) and "solve" in data


def plan_document(data: dict[str, Any], program: Program, base: ReactorRecord) -> dict[str, Any]:
    """The printed plan in the form of docs/validate.md; `base` is the model as loaded.

    Raises DocumentError where no plan was found, or where it is not of the form.
    """
    solved = data["solve"]
    if not isinstance(solved, dict) or solved.get("result") != "plan":
        result = (
            f"it says `{solved['result']}`" if isinstance(solved, dict) and "result" in solved else "none was sought"
        )
        raise DocumentError(f"there is no plan in it: {result}", "`nddlc plan --explain` says why there is none")
    tokens, domains = data.get("tokens"), data.get("domains")
    if not isinstance(tokens, list) or not all(isinstance(each, dict) for each in tokens):
        raise DocumentError("`tokens` is no list of tokens")
    if not isinstance(domains, dict):
        raise DocumentError("`domains` is no object")
    keys = {each.get("id"): number for number, each in enumerate(tokens)}
    extents = {each.get("id"): each for each in tokens if "object" in each}
    members = {}
    for thing in base.objects:
        owner = next(each for each in program.classes if each.name == thing.class_name)
        texts = [domains.get(f"{thing.name}.{member.name}") for member in owner.members]
        if texts and None not in texts:
            members[thing.name] = [_value(text) for text in texts]
    return {
        "tokens": [_token(each, keys, extents) for each in tokens],
        "globals": {name: _value(domains[name]) for name, _ in program.globals if name in domains},
        "members": members,
    }


def _token(data: dict[str, Any], keys: dict[Any, int], extents: dict[Any, dict[str, Any]]) -> dict[str, Any]:
    """One token; a merged one lies where the token does that it is merged into."""
    seen = {data.get("id")}
    own = data
    while "object" not in own and own.get("merged_into") in keys and own["merged_into"] not in seen:
        seen.add(own["merged_into"])
        own = extents.get(own["merged_into"], own)
    found: dict[str, Any] = {
        "key": keys[data.get("id")],
        "predicate": data.get("predicate"),
        "state": str(data.get("state")).lower(),
        "arguments": {name: _value(text) for name, text in own.get("params", {}).items()},
    }
    if "object" in own:
        found["object"] = _value(own["object"])
    found |= {name: _time(own[name]) for name in ("start", "duration", "end") if name in own}
    if data.get("merged_into") is not None:
        if data["merged_into"] not in keys:
            raise DocumentError(f"`{data.get('id')}` is merged into a token that is not there")
        found["merged_into"] = keys[data["merged_into"]]
    return found


def _time(bounds: Any) -> Any:
    if not isinstance(bounds, list) or len(bounds) != 2:
        raise DocumentError(f"{json.dumps(bounds)} is no interval of times")
    return _between(*(float(bound) if isinstance(bound, (int, float, str)) else inf for bound in bounds), is_whole=True)


def _between(lower: float, upper: float, *, is_whole: bool) -> Any:
    low, high = (None if abs(bound) == inf else int(bound) if is_whole else bound for bound in (lower, upper))
    return low if low == high and low is not None else {"between": [low, high]}


def _value(text: Any) -> Any:
    """A domain in the notation of the conformance suite (`{a, b} T`, `[1, 3] int`) as a value of a document."""
    match = _DOMAIN.fullmatch(text) if isinstance(text, str) else None
    if match is None:
        raise DocumentError(f"{json.dumps(text)} is no domain", "as in `{red} Color` or `[1, 3] int`")
    type_, inner = match["type"], match["values"][1:-1]
    try:
        if match["values"][0] == "[":
            lower, upper = map(float, inner.split(","))
            return _between(lower, upper, is_whole=type_ == "int")
        if type_ == "string":
            values = json.loads(f"[{inner}]")
        else:
            values = [_scalar(each.strip(), type_) for each in inner.split(",") if each.strip()]
    except ValueError:
        raise DocumentError(f"`{text}` is no domain") from None
    if not values:
        raise DocumentError(f"`{text}` is empty: nothing can be judged")
    return values[0] if len(values) == 1 else {"one_of": values}


def _scalar(text: str, type_: str) -> Any:
    match type_:
        case "int" | "float":
            number = float(text)
            return (
                ("inf" if number > 0 else "-inf") if abs(number) == inf else int(number) if type_ == "int" else number
            )
        case "bool":
            return text == "true"
        case _:
            return text
