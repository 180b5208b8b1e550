"""Rename: a place and a name in; the edits that give what is named there that name, in all models, out.

The edits are tried before they are offered: the models are analysed as they would read, and every name must still lead
to the declaration that it led to. So no name is captured by another, hides another, or takes a name that is taken.
"""

import re
from collections import Counter
from dataclasses import dataclass

from lsprotocol.types import PrepareRenamePlaceholder

from lsp.documents import Documents
from lsp.occurrences import Occurrence, Role, Symbol, SymbolType
from lsp.open_text import DocumentContext
from lsp.project import Project, Snapshot
from lsp.references import Everywhere, Place, everywhere, occurrence_at, symbol_declared_at
from lsp.uris import key_of
from nddl_lang.syntax.includes import LIBRARY
from nddl_lang.syntax.words import RESERVED
from nddl_lang.text.diagnostic import Diagnostic, Severity

_NAME = re.compile(r"[A-Za-z_$][A-Za-z0-9_$]*")
_FIXED = (SymbolType.RELATION, SymbolType.CALLABLE)
# The codes of errors of each kind, and for each name in each file the number of the first name that means the same.
_Shape = tuple[Counter[str], tuple[tuple[str, tuple[int, ...]], ...]]


class RenameError(Exception):
    """Why something cannot have a name, in words for the user."""


@dataclass(frozen=True, slots=True)
class TextChange:
    """New text for a stretch of a file."""

    place: Place
    text: str


def prepare_rename(documents: Documents, view: DocumentContext, offset: int) -> PrepareRenamePlaceholder | None:
    """The name at `offset`, if it can have another."""
    here = occurrence_at(view, offset)
    if here is None:
        return None
    assert_renamable(documents, view.snapshot, here.symbol)
    place = view.document.lines.range(here.span.begin, here.span.finish)
    return PrepareRenamePlaceholder(place, here.span.text)


def assert_renamable(documents: Documents, snapshot: Snapshot, symbol: Symbol) -> None:
    """Raise RenameError if a symbol cannot have another name."""
    _assert_renamable(snapshot, symbol.type, everywhere(documents, snapshot, symbol).found)


def rename(documents: Documents, snapshot: Snapshot, symbol: Symbol, found: Everywhere, name: str) -> list[TextChange]:
    """The changes that call a symbol `name` at all its occurrences; raises RenameError where that cannot be."""
    if not _NAME.fullmatch(name):
        raise RenameError(f"`{name}` is no name: letters, digits, `_` and `$`, the first one no digit")
    if name in RESERVED:
        raise RenameError(f"`{name}` is a word of the language")
    _assert_renamable(snapshot, symbol.type, found.found)
    if name == symbol.name:
        return []
    for project in found.projects:
        _try(documents, project, [place for place in found.found if place[0] in project.snapshot.parses], name)
    return [TextChange(place, name) for place in found.found]


def _assert_renamable(snapshot: Snapshot, type_: SymbolType, found: dict[Place, Occurrence]) -> None:
    declared = [place for place, each in found.items() if each.role is Role.DECLARES]
    if type_ in _FIXED or not declared:
        raise RenameError("this name belongs to the language")
    library = key_of(LIBRARY)
    if any(key.startswith(library) for key, _, _ in declared):
        raise RenameError("this is declared in the library, which comes with nddlc")
    for place in declared:
        symbol = symbol_declared_at(snapshot, place)
        owner = snapshot.analysis.schema.classes.get(str(symbol.owner)) if symbol is not None else None
        if type_ is SymbolType.PREDICATE and owner is not None and owner.is_native:
            raise RenameError(f"this predicate belongs to `{owner.name}`, which the language brings along")


def _try(documents: Documents, project: Project, places: list[Place], name: str) -> None:
    """Raise RenameError if `name` at these places changes what the model means."""
    before = _shape(project.snapshot)
    texts = {key: parse.source.text for key, parse in project.snapshot.parses.items()}
    for key, begin, finish in sorted(places, reverse=True):
        texts[key] = texts[key][:begin] + name + texts[key][finish:]
    after, first = documents.trial(project, texts, lambda snapshot: (_shape(snapshot), _first_error(snapshot)))
    if after[0] != before[0] and first is not None and after[0] - before[0]:
        raise RenameError(f"with that name, {first.message}")
    if after != before:
        raise RenameError(f"something else is called `{name}` where one of the two is used")


def _shape(snapshot: Snapshot) -> _Shape:
    errors = Counter(each.code.id for each in snapshot.analysis.diagnostics if each.severity is Severity.ERROR)
    by_file: dict[str, list[tuple[int, object]]] = {key: [] for key in snapshot.parses}
    keys = snapshot.keys
    for symbol, occurrences in snapshot.names.all.items():
        for each in occurrences:
            by_file[keys[each.span.source]].append((each.span.begin, symbol))
    numbers: dict[object, int] = {}
    files = []
    for key, named in by_file.items():
        named.sort(key=lambda each: each[0])
        files.append((key, tuple(numbers.setdefault(symbol, len(numbers)) for _, symbol in named)))
    return errors, tuple(files)


def _first_error(snapshot: Snapshot) -> Diagnostic | None:
    return next((each for each in snapshot.analysis.diagnostics if each.severity is Severity.ERROR), None)
