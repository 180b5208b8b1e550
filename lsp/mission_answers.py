"""What editors ask about mission files: completion, hover, and the way into the model."""

import json
import re
from collections.abc import Iterator
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

from lsprotocol.types import (
    CodeLens,
    Command,
    CompletionItem,
    CompletionItemKind,
    Hover,
    Location,
    MarkupContent,
    MarkupKind,
    Range,
)

from lsp.describe import Describer, parameter_text
from lsp.diagnostics import Conversion
from lsp.documents import Documents
from lsp.hover import link
from lsp.mission_texts import FILE_KEYS, MissionPlace, OpenMission, place_at
from lsp.project import Snapshot
from lsp.roots import models_below
from lsp.uris import uri_of
from nddl_lang.semantics.natives import SELF_ACTIVATING, TIMELINE
from nddl_lang.semantics.schema import EnumValue, GlobalReference, Kind, Predicate, Variable
from nddl_lang.text.source import Span

_TIMELINES = ("internal", "external", "early", "late", "observe", "timeline")
_FIGURES = ("path", "during", "phases", "targets")  # timelines
_GIVEN = (("goal", "parameters"), ("property", "parameters"))  # tables of arguments
_OBJECTS = {**dict.fromkeys(_TIMELINES, (TIMELINE,)), "resource": tuple(sorted(SELF_ACTIVATING))}  # by key: of a class
_CODED = re.compile(r"^[ \t]*code[ \t]*=", re.MULTILINE)  # a reactor in Python, of which nothing is proved
_HEAD = re.compile(r"^[ \t]*\[mission\]", re.MULTILINE)
# Commands of the server.
CHECK = "nddl.check"
EXPLAIN = "nddl.explain"
CERTIFY = "nddl.certify"
_SOLVERS = (".toml", ".xml")
_Thing = Variable | EnumValue | Predicate


def mission_completions(documents: Documents, mission: OpenMission, offset: int) -> list[CompletionItem]:
    """What may stand at `offset`: tables, keys, and for values names of files and of the models."""
    place = place_at(mission.text, offset)
    if place.is_value:
        items = _values(documents, mission, place)
    elif mission.text[mission.text.rfind("\n", 0, offset) + 1 : offset].lstrip().startswith("["):
        items = _tables(documents, mission, place)
    else:
        items = _keys(documents, mission, place)
    found: dict[str, CompletionItem] = {}
    for item in items:
        found.setdefault(item.label, item)
    return list(found.values())


def mission_hover(documents: Documents, mission: OpenMission, offset: int, conversion: Conversion) -> Hover | None:
    """What a key means, or what a value names in the model."""
    place = place_at(mission.text, offset)
    shown = mission.lines.range(place.begin, place.finish)
    for snapshot, thing in named(documents, mission, place):
        describer = Describer(snapshot.analysis, lambda span: link(conversion, span))
        match thing:
            case Variable():
                parts = describer.variable(thing)
            case EnumValue():
                parts = describer.enum_value(thing)
            case Predicate():
                parts = describer.predicate(thing)
        return Hover(MarkupContent(MarkupKind.Markdown, "\n\n".join(part for part in parts if part)), shown)
    described = _described((*place.table, place.key or place.word) if place.word or place.key else place.table)
    return Hover(MarkupContent(MarkupKind.Markdown, described), shown) if described else None


def mission_definition(
    documents: Documents, mission: OpenMission, offset: int, conversion: Conversion
) -> Location | None:
    """Where in the models, or in which file, what a value names is."""
    place = place_at(mission.text, offset)
    if place.is_value and place.key in FILE_KEYS:
        path = mission.file_named(place.word)
        start = mission.lines.range(0, 0).start
        return Location(uri_of(path), Range(start, start)) if path is not None else None
    for snapshot, thing in named(documents, mission, place):
        span = declared_at(snapshot, thing)
        if span is not None:
            return conversion.location(span)
    return None


def mission_lenses(mission: OpenMission) -> list[CodeLens]:
    """What can be done with a mission file: fly some of its missions, fly all, explain what failed last, certify it."""
    found = _HEAD.search(mission.text)
    if found is None:
        return []
    place = mission.lines.range(found.start(), found.end())
    uri = mission.uri
    offered: list[tuple[str, str, list[Any]]] = [
        ("run 100 missions", CHECK, [uri, 100]),
        ("run all missions", CHECK, [uri]),
        ("explain last failure", EXPLAIN, [uri]),
    ]
    if _CODED.search(mission.text) is None:
        offered.append(("certify", CERTIFY, [uri]))
    return [CodeLens(place, Command(title, command, arguments=arguments)) for title, command, arguments in offered]


def declared_at(snapshot: Snapshot, thing: _Thing) -> Span | None:
    """Where a model declares what a mission file names."""
    if isinstance(thing, EnumValue):
        enum = snapshot.analysis.schema.enums.get(thing.enum)
        node = enum.node if enum is not None else None
        return next((name.span for name in node.values if name.name == thing.value), None) if node else None
    return thing.span


# ---- names of the models ----


def _snapshots(documents: Documents, mission: OpenMission) -> Iterator[Snapshot]:
    for path in mission.models:
        if (snapshot := documents.model(path)) is not None:
            yield snapshot


def named(documents: Documents, mission: OpenMission, place: MissionPlace) -> Iterator[tuple[Snapshot, _Thing]]:
    """What the word at a place names in the models."""
    for snapshot in _snapshots(documents, mission):
        schema = snapshot.analysis.schema
        thing: _Thing | None = None
        if place.is_value and (place.key in _OBJECTS or (place.table == ("figures",) and place.key in _FIGURES)):
            thing = schema.globals.get(place.word)
        elif place.table == ("figures",) and place.is_value and place.key in ("samples", "feature"):
            thing = _figured(mission, snapshot, place)
        elif place.is_value and place.key == "predicate":
            thing = _predicate(snapshot, _sibling(mission, place, "timeline"), place.word)
        elif place.table[:2] in _GIVEN:
            name = place.key if place.is_value else place.word
            predicate = _predicate(
                snapshot, _sibling(mission, place, "timeline"), _sibling(mission, place, "predicate")
            )
            thing = next((each for each in predicate.parameters if each.name == name), None) if predicate else None
        elif (place.table[:1] == ("parameters",) and not place.is_value and len(place.table) == 1) or (
            place.table[:1] == ("joint",) and place.is_value and place.key == "parameters"
        ):
            thing = schema.globals.get(place.word) or schema.enum_values.get(place.word)
        if thing is not None:
            yield snapshot, thing


def _figured(mission: OpenMission, snapshot: Snapshot, place: MissionPlace) -> _Thing | None:
    """What one half of `gulper.Firing` names."""
    before = mission.text[: place.begin]
    if not before.endswith("."):
        return snapshot.analysis.schema.globals.get(place.word)
    timeline = re.split(r"[\"']", before[:-1])[-1]
    return _predicate(snapshot, timeline, place.word) if place.key == "samples" else None


def _sibling(mission: OpenMission, place: MissionPlace, key: str) -> str:
    """The value of another key of the same table, or of the goal that it is a part of."""
    text = mission.text
    begin = max(text.rfind("[[", 0, place.begin), 0)
    end = text.find("[[", place.begin)
    for line in text[begin : end if end >= 0 else len(text)].splitlines():
        name, equals, value = line.partition("=")
        if equals and name.strip() == key:
            return value.strip().strip("\"'")
    return ""


def _predicate(snapshot: Snapshot, timeline: str, name: str) -> Predicate | None:
    schema = snapshot.analysis.schema
    variable = schema.globals.get(timeline)
    return schema.find_predicate(variable.type.base, name) if variable is not None else None


def _values(documents: Documents, mission: OpenMission, place: MissionPlace) -> Iterator[CompletionItem]:
    folder = mission.path.parent
    if place.key == "model":
        for path in models_below(folder):
            yield CompletionItem(path.relative_to(folder).as_posix(), kind=CompletionItemKind.File)
        return
    if place.key in ("solver", "batch", "modules", "code"):
        yield from (CompletionItem(name, kind=CompletionItemKind.File) for name in _files(folder, place.key))
        return
    for choice in _schema_of((*place.table, place.key or "")).get("enum", ()):
        yield CompletionItem(str(choice), kind=CompletionItemKind.EnumMember)
    for snapshot in _snapshots(documents, mission):
        schema = snapshot.analysis.schema
        if place.key in _OBJECTS:
            for variable in schema.globals.values():
                classes = _OBJECTS[place.key] if variable.type.kind is Kind.OBJECT else ()
                if any(schema.is_subclass(variable.type.base, one) for one in classes):
                    yield CompletionItem(variable.name, kind=CompletionItemKind.Variable, detail=variable.type.name)
        elif place.key == "predicate":
            variable_ = schema.globals.get(_sibling(mission, place, "timeline"))
            owner = schema.classes.get(variable_.type.base) if variable_ is not None else None
            for predicate in (*owner.predicates.values(), *owner.inherited.values()) if owner is not None else ():
                yield CompletionItem(predicate.name, kind=CompletionItemKind.Method, detail=predicate.full_name)


def _files(folder: Path, key: str) -> list[str]:
    wanted = {"solver": _SOLVERS, "batch": (".xml",)}.get(key, (".py",))
    try:
        return sorted(path.name for path in folder.iterdir() if path.suffix in wanted)
    except OSError:
        return []


def _tables(documents: Documents, mission: OpenMission, place: MissionPlace) -> Iterator[CompletionItem]:
    if place.table == ("parameters",):
        yield from _parameters(documents, mission)
    elif not place.table:
        for name, schema in _mission_schema()["properties"].items():
            yield CompletionItem(name, kind=CompletionItemKind.Module, detail=schema.get("description"))


def _parameters(documents: Documents, mission: OpenMission) -> Iterator[CompletionItem]:
    """What the models sample."""
    for snapshot in _snapshots(documents, mission):
        for reference in snapshot.analysis.tables.sampled.values():
            match reference:
                case GlobalReference(variable=variable):
                    yield CompletionItem(
                        variable.name, kind=CompletionItemKind.Variable, detail=parameter_text(variable)
                    )
                case EnumValue(value=value, enum=enum):
                    yield CompletionItem(value, kind=CompletionItemKind.EnumMember, detail=enum)
                case _:
                    pass


def _keys(documents: Documents, mission: OpenMission, place: MissionPlace) -> Iterator[CompletionItem]:
    if place.table[:2] == ("goal", "parameters"):
        for snapshot in _snapshots(documents, mission):
            predicate = _predicate(
                snapshot, _sibling(mission, place, "timeline"), _sibling(mission, place, "predicate")
            )
            for parameter in predicate.parameters if predicate is not None else ():
                yield CompletionItem(parameter.name, kind=CompletionItemKind.Field, detail=parameter_text(parameter))
        return
    if not place.table:
        yield from (
            CompletionItem(f"[{name}]", kind=CompletionItemKind.Module) for name in _mission_schema()["properties"]
        )
    for schema in _variants(_schema_of(place.table)):
        for name, each in schema.get("properties", {}).items():
            yield CompletionItem(name, kind=CompletionItemKind.Property, detail=each.get("description"))


# ---- the schema of mission files ----


@cache
def _mission_schema() -> Any:
    return json.loads(files("checker").joinpath("mission_schema.json").read_text(encoding="utf-8"))


def _variants(schema: Any) -> list[Any]:
    """The schema itself, or those that it is one of."""
    schema = schema.get("items", schema)
    return list(schema.get("oneOf", (schema,)))


def _schema_of(path: tuple[str, ...]) -> Any:
    """The schema of a table or key; empty where there is none."""
    schema = _mission_schema()
    for name in path:
        found: Any = {}
        for variant in _variants(schema):
            more = variant.get("additionalProperties")
            found = found or variant.get("properties", {}).get(name) or (more if isinstance(more, dict) else {})
        schema = found
    return schema


def _described(path: tuple[str, ...]) -> str | None:
    schema = _schema_of(path)
    text = schema.get("description") if isinstance(schema, dict) else None
    if text is None:
        return None
    default = f" (default: `{json.dumps(schema['default'])}`)" if "default" in schema else ""
    return f"`{'.'.join(path)}`: {text}{default}"
