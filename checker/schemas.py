"""JSON schemas of what nddlc reads and prints: a name in, a schema that stands alone out."""

import json
from collections.abc import Iterator, Mapping
from importlib.resources import files
from typing import Any

_PRINTED = "output_schema.json"
_WHOLE = {"mission": "mission_schema.json", "study-file": "study_schema.json"}
_PARTS = {
    "report": "report",
    "lint": "findings",
    "explain": "explanation",
    "trace": "event",
    "mutate": "mutants",
    "compare": "comparison",
    "study": "study",
    "certify": "certificate",
    "controllability": "controllability",
    "shrink": "shrunk",
    "store": "damage",
    "validate": "judgement",
    "record": "record",
    "load": "loaded",
    "plan": "planned",
}
SCHEMAS = (*_WHOLE, *_PARTS)


def schema(name: str) -> dict[str, Any]:
    """The schema of a kind of document, with the definitions that it needs and no others."""
    if name in _WHOLE:
        return _read(_WHOLE[name])
    everything = _read(_PRINTED)
    definitions: dict[str, Any] = everything["$defs"]
    wanted, waiting = set[str](), [_PARTS[name]]
    while waiting:
        one = waiting.pop()
        if one not in wanted:
            wanted.add(one)
            waiting.extend(_named_in(definitions[one]))
    needed = {key: each for key, each in definitions.items() if key in wanted}
    top = definitions[_PARTS[name]]
    reference = f"#/$defs/{_PARTS[name]}"
    return {"$schema": everything["$schema"], "title": top["description"], "$ref": reference, "$defs": needed}


def _named_in(node: Any) -> Iterator[str]:
    """The definitions that a schema refers to."""
    if isinstance(node, Mapping):
        for key, inner in node.items():
            if key == "$ref":
                yield inner.removeprefix("#/$defs/")
            else:
                yield from _named_in(inner)
    elif isinstance(node, list):
        for inner in node:
            yield from _named_in(inner)


def _read(file: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(files("checker").joinpath(file).read_text(encoding="utf-8"))
    return found
