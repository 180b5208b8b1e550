"""The kinds of TOML that nddlc reads: a file in; its kind, and what the schema says of a path of keys, out."""

import json
from enum import Enum
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

from nddl_lang.lint.configuration import NAME, PROJECT
from runtime.solver.configuration.read_toml import is_solver_toml

_SOLVER = "solver"  # in the name of a file
_SECTION = ("tool", "nddlc")  # of pyproject.toml


class TomlKind(Enum):
    """What a file is, and the schema of it."""

    MISSION = "mission_schema.json"
    SOLVER = "solver_schema.json"
    SETTINGS = "settings_schema.json"


def kind_of(path: Path, text: str) -> TomlKind:
    """What a file is by its name and by the tables in it."""
    if path.name in (NAME, PROJECT):
        return TomlKind.SETTINGS
    is_solver = _SOLVER in path.name.lower() or is_solver_toml(text)
    return TomlKind.SOLVER if is_solver else TomlKind.MISSION


@cache
def root_schema(kind: TomlKind) -> Any:
    """The schema of a whole file."""
    return json.loads(files("checker").joinpath(kind.value).read_text(encoding="utf-8"))


def variants(schema: Any) -> list[Any]:
    """The schema itself, or those that it is one of."""
    schema = schema.get("items", schema)
    return list(schema.get("oneOf", (schema,)))


def schema_of(kind: TomlKind, path: tuple[str, ...]) -> Any:
    """The schema of a table or key; empty where there is none."""
    schema = root_schema(kind)
    if kind is TomlKind.SETTINGS and path[:2] == _SECTION:
        path = path[2:]
    for name in path:
        found: Any = {}
        for variant in variants(schema):
            more = variant.get("additionalProperties")
            found = found or variant.get("properties", {}).get(name) or (more if isinstance(more, dict) else {})
        schema = found
    return schema


def choices_of(kind: TomlKind, path: tuple[str, ...]) -> list[str]:
    """The words that may be the value of a key, or stand in its list."""
    schema = schema_of(kind, path)
    return [str(word) for word in schema.get("enum") or schema.get("items", {}).get("enum", ())]


def described(kind: TomlKind, path: tuple[str, ...]) -> str | None:
    """What a table or key means, and its default."""
    schema = schema_of(kind, path)
    text = schema.get("description") if isinstance(schema, dict) else None
    if text is None:
        return None
    default = f" (default: `{json.dumps(schema['default'])}`)" if "default" in schema else ""
    return f"`{'.'.join(path)}`: {text}{default}"
