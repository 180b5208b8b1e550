"""References: a place in; all occurrences of what is named there, in every model that shares its declaration, out."""

from collections.abc import Iterable
from dataclasses import dataclass

from lsprotocol.types import DocumentHighlight, DocumentHighlightKind

from lsp.documents import Documents
from lsp.meaning import piece_at
from lsp.occurrences import Occurrence, Role, Symbol, symbol_of_class
from lsp.open_text import DocumentContext
from lsp.project import Project, Snapshot
from nddl_lang.semantics.schema import Class

# Where a name stands: the key of its file, and the offsets of its begin and end.
Place = tuple[str, int, int]


@dataclass(frozen=True, eq=False, slots=True)
class Everywhere:
    """The occurrences of one declaration in all models, by place; `projects` are those models."""

    found: dict[Place, Occurrence]
    projects: tuple[Project, ...]


def occurrence_at(view: DocumentContext, offset: int) -> Occurrence | None:
    """What is named at `offset`."""
    piece = piece_at(view.parse, offset)
    return view.snapshot.names.at(piece.anchor, offset) if piece is not None else None


def everywhere(documents: Documents, snapshot: Snapshot, symbol: Symbol) -> Everywhere:
    """All occurrences of `symbol`, which `snapshot` knows; also in closed models that include its declaration."""
    found = located(snapshot, snapshot.names.of(symbol))
    projects: dict[str, Project] = {}
    pending = [place for place, each in found.items() if each.role is Role.DECLARES]
    seen: set[Place] = set()
    while pending:
        place = pending.pop()
        if place in seen:
            continue
        seen.add(place)
        for project in documents.holders(place[0]):
            projects[project.key] = project
            same = symbol_declared_at(project.snapshot, place)
            if same is None:
                continue
            for other, each in located(project.snapshot, project.snapshot.names.of(same)).items():
                found.setdefault(other, each)
                if each.role is Role.DECLARES:
                    pending.append(other)
    return Everywhere(dict(sorted(found.items())), tuple(projects.values()))


def models_sharing(documents: Documents, snapshot: Snapshot, symbol: Symbol) -> list[Snapshot]:
    """The models that know what `snapshot` knows by a symbol, that one first."""
    others = (project.snapshot for project in everywhere(documents, snapshot, symbol).projects)
    return [snapshot, *(each for each in others if each is not snapshot)]


def extending(documents: Documents, snapshot: Snapshot, name: str) -> list[Class]:
    """The classes of all models that extend the class of that name, each once."""
    found: dict[Place, Class] = {}
    for each in models_sharing(documents, snapshot, symbol_of_class(name)):
        for owner in each.analysis.schema.classes.values():
            if owner.base == name and (span := owner.span) is not None and span.source in each.keys:
                found.setdefault((each.keys[span.source], span.begin, span.finish), owner)
    return list(found.values())


def symbol_declared_at(snapshot: Snapshot, place: Place) -> Symbol | None:
    """The symbol whose name stands at `place`."""
    key, begin, _ = place
    parse = snapshot.parses.get(key)
    piece = piece_at(parse, begin) if parse is not None else None
    here = snapshot.names.at(piece.anchor, begin) if piece is not None else None
    return here.symbol if here is not None else None


def located(snapshot: Snapshot, occurrences: Iterable[Occurrence]) -> dict[Place, Occurrence]:
    """Occurrences by place."""
    keys = snapshot.keys
    return {(keys[each.span.source], each.span.begin, each.span.finish): each for each in occurrences}


def highlights(view: DocumentContext, offset: int) -> list[DocumentHighlight]:
    """Where the same text names the same thing, with what it does there."""
    here = occurrence_at(view, offset)
    if here is None:
        return []
    lines = view.document.lines
    writes = (Role.DECLARES, Role.WRITES)
    return [
        DocumentHighlight(
            lines.range(each.span.begin, each.span.finish),
            DocumentHighlightKind.Write if each.role in writes else DocumentHighlightKind.Read,
        )
        for each in view.snapshot.names.of(here.symbol)
        if each.span.source is view.parse.source
    ]
