"""What editors ask about mission files: completion, hover, and the way into the model."""

import re
from collections.abc import Iterator
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
from lsp.solver_names import models_of_solver, named_in_solver, solver_values
from lsp.toml_kinds import TomlKind, choices_of, described, kind_of, root_schema, schema_of, variants
from lsp.uris import uri_of
from nddl_lang.lint.pages import PAGES
from nddl_lang.mission_suffixes import MISSION_HEAD
from nddl_lang.semantics.natives import SELF_ACTIVATING, TIMELINE
from nddl_lang.semantics.schema import Class, EnumValue, GlobalReference, Kind, Predicate, Variable
from nddl_lang.text.source import Span
from nddl_lang.text.toml_places import HEADER
from runtime.solver.configuration.words import HANDLERS
from runtime.solver.tags import MANAGER_NAMES

_TIMELINES = ("internal", "external", "early", "late", "observe", "timeline")
_FIGURES = ("path", "during", "phases", "targets")  # timelines
_GIVEN = (("goal",), ("property",))  # tables of tokens with arguments
_OBJECTS = {**dict.fromkeys(_TIMELINES, (TIMELINE,)), "resource": tuple(sorted(SELF_ACTIVATING))}  # by key: of a class
_CODED = re.compile(r"^[ \t]*code[ \t]*=", re.MULTILINE)  # a reactor in Python, of which nothing is proved
_COMPONENT = re.compile(r"""^[ \t]*component[ \t]*=[ \t]*["']([^"'\n]*)["']""", re.MULTILINE)
# Commands of the server.
CHECK = "nddl.check"
EXPLAIN = "nddl.explain"
CERTIFY = "nddl.certify"
_SOLVERS = (".toml", ".xml")
_Thing = Variable | EnumValue | Predicate | Class


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
            case Class():
                parts = describer.class_(thing)
        return Hover(MarkupContent(MarkupKind.Markdown, "\n\n".join(part for part in parts if part)), shown)
    kind = kind_of(mission.path, mission.text)
    text = _page(place.word) if kind is TomlKind.SETTINGS else None
    text = text or described(kind, (*place.table, place.key or place.word) if place.word or place.key else place.table)
    return Hover(MarkupContent(MarkupKind.Markdown, text), shown) if text else None


def _page(code: str) -> str | None:
    """What a code of a lint means."""
    page = PAGES.get(code)
    return f"`{code}`: {page.what}" if page is not None else None


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
    found = MISSION_HEAD.search(mission.text)
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
    is_solver = kind_of(mission.path, mission.text) is TomlKind.SOLVER
    for path in models_of_solver(mission) if is_solver else mission.models:
        if (snapshot := documents.model(path)) is not None:
            yield snapshot


def named(documents: Documents, mission: OpenMission, place: MissionPlace) -> Iterator[tuple[Snapshot, _Thing]]:
    """What the word at a place names in the models."""
    is_solver = kind_of(mission.path, mission.text) is TomlKind.SOLVER
    for snapshot in _snapshots(documents, mission):
        schema = snapshot.analysis.schema
        thing: _Thing | None = None
        if is_solver:
            thing = named_in_solver(schema, place, *_class_and_predicate(mission, place))
        elif place.is_value and (place.key in _OBJECTS or (place.table == ("figures",) and place.key in _FIGURES)):
            thing = schema.globals.get(place.word)
        elif place.table == ("figures",) and place.is_value and place.key in ("samples", "feature"):
            thing = _figured(mission, snapshot, place)
        elif place.is_value and place.key == "predicate":
            thing = _predicate(snapshot, _sibling(mission, place, "timeline"), place.word)
        elif place.table[:1] in _GIVEN and (place.table[-1] == "parameters" or place.key == "where"):
            thing = _given(mission, snapshot, place)
        elif (place.table[:1] == ("parameters",) and not place.is_value and len(place.table) == 1) or (
            place.table[:1] == ("joint",) and place.is_value and place.key == "parameters"
        ):
            thing = schema.globals.get(place.word) or schema.enum_values.get(place.word)
        if thing is not None:
            yield snapshot, thing


def _given(mission: OpenMission, snapshot: Snapshot, place: MissionPlace) -> _Thing | None:
    """A parameter of the predicate at hand, or what it is given: an object or a value of an enum."""
    schema = snapshot.analysis.schema
    timeline, predicate = (_sibling(mission, place, key) for key in ("timeline", "predicate"))
    wanted = _predicate(snapshot, timeline, predicate)
    parameters = {each.name: each for each in wanted.parameters} if wanted is not None else {}
    if place.key == "where":
        return parameters.get(place.word) or schema.enum_values.get(place.word) or schema.globals.get(place.word)
    parameter = parameters.get(str(place.key) if place.is_value else place.word)
    if parameter is None or not place.is_value:
        return parameter
    match parameter.type.kind:
        case Kind.ENUM:
            return schema.enum_values.get(place.word, parameter)
        case Kind.OBJECT:
            return schema.globals.get(place.word, parameter)
        case _:
            return parameter


def _figured(mission: OpenMission, snapshot: Snapshot, place: MissionPlace) -> _Thing | None:
    """What one half of `gulper.Firing` names."""
    before = mission.text[: place.begin]
    if not before.endswith("."):
        return snapshot.analysis.schema.globals.get(place.word)
    timeline = re.split(r"[\"']", before[:-1])[-1]
    return _predicate(snapshot, timeline, place.word) if place.key == "samples" else None


def _sibling(mission: OpenMission, place: MissionPlace, key: str) -> str:
    """The value of another key of the same table, or else of the nearest table around it."""
    text = mission.text
    begin = max(text.rfind("\n[[", 0, place.begin), 0)
    end = text.find("\n[[", place.begin)
    found: dict[tuple[str, ...], str] = {}
    table: tuple[str, ...] = ()
    for line in text[begin : end if end >= 0 else len(text)].splitlines():
        name, equals, value = line.partition("=")
        if (header := HEADER.match(line)) is not None:
            table = tuple(part.strip(" \t\"'") for part in header[2].split("."))
        elif equals and name.strip() == key:
            found.setdefault(table, value.strip().strip("\"'"))
    around = [place.table[:depth] for depth in range(len(place.table), -1, -1)]
    return next((found[each] for each in around if each in found), "")


def _class_and_predicate(mission: OpenMission, place: MissionPlace) -> tuple[str, str]:
    """What a table of a solver says of tokens, of the parent where the key at hand speaks of it."""
    before = "master_" if (place.key or "").startswith("master_") else ""
    return _sibling(mission, place, f"{before}class"), _sibling(mission, place, f"{before}predicate")


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
    kind = kind_of(mission.path, mission.text)
    for choice in _choices(mission, kind, place):
        yield CompletionItem(choice, kind=CompletionItemKind.EnumMember)
    if kind is TomlKind.SETTINGS:
        if place.key in ("select", "ignore"):
            yield from _codes()
        elif place.key == "include":
            yield from (CompletionItem(name, kind=CompletionItemKind.Folder) for name in _folders(folder))
        return
    if kind is TomlKind.SOLVER:
        for snapshot in _snapshots(documents, mission):
            yield from solver_values(snapshot.analysis.schema, place.key, *_class_and_predicate(mission, place))
        return
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
        elif place.table[:1] in _GIVEN and place.table[-1] == "parameters":
            yield from _arguments(mission, snapshot, place)


def _arguments(mission: OpenMission, snapshot: Snapshot, place: MissionPlace) -> Iterator[CompletionItem]:
    """The values that a parameter of the predicate at hand may have: of an enum, or objects of its class."""
    schema = snapshot.analysis.schema
    wanted = _predicate(snapshot, _sibling(mission, place, "timeline"), _sibling(mission, place, "predicate"))
    for type_ in [each.type for each in wanted.parameters if each.name == place.key] if wanted is not None else ():
        if type_.kind is Kind.ENUM and type_.base in schema.enums:
            for value in schema.enums[type_.base].values:
                yield CompletionItem(value, kind=CompletionItemKind.EnumMember, detail=type_.name)
        elif type_.kind is Kind.OBJECT:
            for variable in schema.globals.values():
                if variable.type.kind is Kind.OBJECT and schema.is_subclass(variable.type.base, type_.base):
                    yield CompletionItem(variable.name, kind=CompletionItemKind.Variable, detail=variable.type.name)


def _choices(mission: OpenMission, kind: TomlKind, place: MissionPlace) -> list[str]:
    """The words of the schema that may stand there; handlers only of the manager that they belong to."""
    words = choices_of(kind, (*place.table, place.key or ""))
    if (*place.table, place.key) != ("manager", "handler", "component"):
        return words
    header = mission.text.rfind("[[manager]]", 0, place.begin)
    manager = _COMPONENT.search(mission.text, max(header, 0), place.begin)
    mended = MANAGER_NAMES.index(manager[1]) if manager is not None and manager[1] in MANAGER_NAMES else None
    return [word for word in words if mended is None or HANDLERS[word][0] == mended]


def _codes() -> Iterator[CompletionItem]:
    for code, page in PAGES.items():
        yield CompletionItem(code, kind=CompletionItemKind.Constant, detail=page.what)


def _folders(folder: Path) -> list[str]:
    try:
        return sorted(path.name for path in folder.iterdir() if path.is_dir() and not path.name.startswith("."))
    except OSError:
        return []


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
        for name, schema in root_schema(kind_of(mission.path, mission.text))["properties"].items():
            yield CompletionItem(name, kind=CompletionItemKind.Module, detail=schema.get("description"))
    elif kind_of(mission.path, mission.text) is TomlKind.SOLVER:
        for variant in variants(schema_of(TomlKind.SOLVER, place.table)):
            for name in ("filter", "handler"):
                if name in variant.get("properties", {}):
                    yield CompletionItem(name, kind=CompletionItemKind.Module)


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
    kind = kind_of(mission.path, mission.text)
    if kind is TomlKind.SETTINGS and place.table[-1:] == ("severity",):
        yield from _codes()
        return
    if not place.table:
        for name, schema in root_schema(kind)["properties"].items():
            is_array = schema.get("type") == "array" and "properties" in schema.get("items", {})
            if is_array or schema.get("type") == "object":
                yield CompletionItem(f"[[{name}]]" if is_array else f"[{name}]", kind=CompletionItemKind.Module)
    for schema in variants(schema_of(kind, place.table)):
        for name, each in schema.get("properties", {}).items():
            yield CompletionItem(name, kind=CompletionItemKind.Property, detail=each.get("description"))
