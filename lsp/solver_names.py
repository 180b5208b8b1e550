"""A solver's TOML that is open in; the models of the missions that use it, and what a value names there, out."""

import re
from collections.abc import Iterator
from pathlib import Path

from lsprotocol.types import CompletionItem, CompletionItemKind

from lsp.describe import parameter_text
from lsp.mission_texts import MissionPlace, OpenMission, models_in
from nddl_lang.semantics.natives import builtin_names
from nddl_lang.semantics.relations import RELATIONS
from nddl_lang.semantics.schema import Class, Predicate, Schema, Variable

_MOST_FILES = 50  # beside it, among which its missions are sought
_LARGEST = 1_000_000  # bytes of a mission file that is looked at
_SOLVER = re.compile(r"""^[ \t]*solver[ \t]*=[ \t]*["']([^"'\n]+)["']""", re.MULTILINE)
_CLASSES = ("class", "master_class")
_PREDICATES = ("predicate", "master_predicate")


def models_of_solver(solver: OpenMission) -> list[Path]:
    """The models of the mission files beside a solver's file that name it."""
    found: dict[Path, None] = {}
    try:
        beside = sorted(solver.path.parent.glob("*.toml"))[:_MOST_FILES]
        texts = [path.read_text(encoding="utf-8") for path in beside if _is_small(path) and path != solver.path]
    except (OSError, UnicodeDecodeError):
        return []
    for text in texts:
        if solver.path.name in (Path(name).name for name in _SOLVER.findall(text)):
            found.update(dict.fromkeys(solver.path.parent / name for name in models_in(text)))
    return list(found)


def _is_small(path: Path) -> bool:
    return path.is_file() and path.stat().st_size <= _LARGEST


def named_in_solver(
    schema: Schema, place: MissionPlace, class_name: str, predicate: str
) -> Class | Predicate | Variable | None:
    """What the word at a place names, beside the class and the predicate of the same table."""
    if not place.is_value:
        return None
    if place.key in _CLASSES:
        return schema.classes.get(place.word)
    if place.key in _PREDICATES:
        return next(_predicates(schema, class_name, place.word), None)
    if place.key == "variable":
        for each in _predicates(schema, class_name, predicate):
            for parameter in each.parameters:
                if parameter.name == place.word:
                    return parameter
    return None


def solver_values(schema: Schema, key: str | None, class_name: str, predicate: str) -> Iterator[CompletionItem]:
    """What a match key may be given."""
    if key in _CLASSES:
        for owner in schema.classes.values():
            if owner.predicates or owner.inherited:
                yield CompletionItem(owner.name, kind=CompletionItemKind.Class)
    elif key in _PREDICATES:
        for each in _predicates(schema, class_name, ""):
            name = each.name if class_name else each.full_name
            yield CompletionItem(name, kind=CompletionItemKind.Method, detail=each.full_name)
    elif key == "variable":
        for each in _predicates(schema, class_name, predicate):
            for parameter in each.parameters:
                yield CompletionItem(parameter.name, kind=CompletionItemKind.Variable, detail=parameter_text(parameter))
        yield from (CompletionItem(name, kind=CompletionItemKind.Field) for name in builtin_names(is_event=False))
    elif key == "master_relation":
        yield CompletionItem("none", kind=CompletionItemKind.Keyword)
        yield from (CompletionItem(name, kind=CompletionItemKind.Operator) for name in RELATIONS)


def _predicates(schema: Schema, class_name: str, name: str) -> Iterator[Predicate]:
    """The predicates of a class, of all where none is named, that have a name: any, alone, or with its class."""
    owner, _, last = name.rpartition(".")
    for each in schema.classes.values():
        if (class_name or owner) in ("", each.name):
            for predicate in (*each.predicates.values(), *each.inherited.values()):
                if not name or predicate.name == last:
                    yield predicate
