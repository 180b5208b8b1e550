"""Names of models in mission files: a name in; all that missions know by it, in models and mission files, out."""

import re
import stat
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from lsprotocol.types import Location

from lsp.default_predicates import defaults_of
from lsp.documents import Documents
from lsp.mission_answers import declared_at, named
from lsp.mission_texts import MissionTexts, OpenMission, place_at
from lsp.occurrences import Occurrence, Role, Symbol
from lsp.positions import Encoding, Lines
from lsp.project import Project, Snapshot
from lsp.references import Everywhere, Place, everywhere, located, symbol_declared_at
from lsp.roots import MOST_FILES, files_below, folder_of
from lsp.uris import key_of, uri_of
from nddl_lang.text.read import read_text
from nddl_lang.text.source import Span

_LARGEST = 2**20  # bytes
_REACTOR = "[[reactor]]"


@dataclass(frozen=True, slots=True)
class MissionUse:
    """A stretch of a mission file that names something of a model."""

    uri: str
    lines: Lines
    begin: int
    finish: int

    @property
    def location(self) -> Location:
        """Where an editor shows it."""
        return Location(self.uri, self.lines.range(self.begin, self.finish))


def throughout(
    documents: Documents, missions: MissionTexts, snapshot: Snapshot, symbol: Symbol
) -> tuple[Everywhere, list[MissionUse]]:
    """All occurrences of a symbol in all models, and where mission files name it, in the order of the files.

    Reactors know timelines by name: what another model of the same mission declares by that name is the same thing.
    """
    found: dict[Place, Occurrence] = {}
    projects: dict[str, Project] = {}
    uses: dict[tuple[str, int], MissionUse] = {}
    pending = [(snapshot, symbol)]
    while pending:
        of, same = pending.pop()
        here = everywhere(documents, of, same)
        found |= here.found
        for project in here.projects:
            found |= located(project.snapshot, defaults_of(project.snapshot, same))
        projects |= {project.key: project for project in here.projects}
        declared = {place for place, each in here.found.items() if each.role is Role.DECLARES}
        for mission in _missions(documents, missions, here):
            alike = list(_dispatched(documents, mission, symbol.name))
            for use, things in _named_by(documents, mission, symbol.name):
                alike.append(things)
                if any(place in declared for _, place in things):
                    uses[use.uri, use.begin] = use
            for things in alike:
                if any(place in declared for _, place in things):
                    others = [(other, place) for other, place in things if place not in found]
                    called = [(other, symbol_declared_at(other, place)) for other, place in others]
                    pending += [(other, each) for other, each in called if each is not None]
    return Everywhere(dict(sorted(found.items())), tuple(projects.values())), list(uses.values())


_Declared = list[tuple[Snapshot, Place]]  # what is alike in several models, and where each declares it


def _named_by(documents: Documents, mission: OpenMission, name: str) -> Iterator[tuple[MissionUse, _Declared]]:
    """Where a mission file has a name, and what is called so in its models."""
    for match in re.finditer(rf"(?<![\w$]){re.escape(name)}(?![\w$])", mission.text):
        place = place_at(mission.text, match.end())
        if (place.begin, place.finish) == match.span():
            things = [(snapshot, declared_at(snapshot, thing)) for snapshot, thing in named(documents, mission, place)]
            yield MissionUse(mission.uri, mission.lines, *match.span()), _located(things)


def _dispatched(documents: Documents, mission: OpenMission, name: str) -> Iterator[_Declared]:
    """Predicates of that name, and parameters of predicates, on timelines that models of a mission share."""
    alike: dict[tuple[str, ...], list[tuple[Snapshot, Span | None]]] = {}
    for snapshot in filter(None, map(documents.model, mission.models)):
        schema = snapshot.analysis.schema
        for timeline, variable in schema.globals.items():
            owner = schema.classes.get(variable.type.base)
            for predicate in {**owner.inherited, **owner.predicates}.values() if owner is not None else ():
                if predicate.name == name:
                    alike.setdefault((timeline, name), []).append((snapshot, predicate.span))
                for parameter in predicate.parameters:
                    if parameter.name == name:
                        alike.setdefault((timeline, predicate.name, name), []).append((snapshot, parameter.span))
    yield from map(_located, alike.values())


def _located(things: Iterable[tuple[Snapshot, Span | None]]) -> _Declared:
    located = [(snapshot, _place(snapshot, span)) for snapshot, span in things]
    return [(snapshot, place) for snapshot, place in located if place is not None]


def symbol_named(documents: Documents, mission: OpenMission, offset: int) -> tuple[Snapshot, Symbol] | None:
    """What of a model is named at a place of a mission file, and that model."""
    for snapshot, thing in named(documents, mission, place_at(mission.text, offset)):
        place = _place(snapshot, declared_at(snapshot, thing))
        symbol = symbol_declared_at(snapshot, place) if place is not None else None
        if symbol is not None:
            return snapshot, symbol
    return None


def _place(snapshot: Snapshot, span: Span | None) -> Place | None:
    key = snapshot.keys.get(span.source) if span is not None else None
    return (key, span.begin, span.finish) if span is not None and key is not None else None


def _missions(documents: Documents, missions: MissionTexts, found: Everywhere) -> Iterator[OpenMission]:
    """The mission files that run a model of these: the open ones, then those of the workspace and beside the models."""
    keys = {project.key for project in found.projects}
    seen = set()
    for mission in missions.all():
        seen.add(key_of(mission.path))
        if not keys.isdisjoint(map(key_of, mission.models)):
            yield mission
    beside = (folder for project in found.projects if (folder := folder_of(project.key)) is not None)
    for path in _candidates(dict.fromkeys((*documents.folders, *beside))):
        if key_of(path) in seen:
            continue
        seen.add(key_of(path))
        runs_one = not keys.isdisjoint(map(key_of, _models_of(path)))
        if runs_one and (closed := _read(path, documents.encoding)) is not None:
            yield closed


def _candidates(folders: Iterable[Path]) -> Iterator[Path]:
    for folder in folders:
        yield from files_below(folder, ".toml")


def _models_of(path: Path) -> tuple[Path, ...]:
    """The models that the mission file at `path` runs; none of what is none, or cannot be read."""
    try:
        status = path.stat()
    except (OSError, ValueError):
        return ()
    is_small = stat.S_ISREG(status.st_mode) and status.st_size <= _LARGEST
    return _read_models(path, status.st_mtime_ns, status.st_size) if is_small else ()


@lru_cache(4 * MOST_FILES)
def _read_models(path: Path, changed: int, size: int) -> tuple[Path, ...]:
    """The same as it was when the file was `changed` last and had that `size`."""
    del changed, size
    mission = _read(path, Encoding.UTF32)
    return tuple(mission.models) if mission is not None and _REACTOR in mission.text else ()


def _read(path: Path, encoding: Encoding) -> OpenMission | None:
    try:
        return OpenMission(uri_of(path), path, 0, Lines(read_text(path) or "", encoding))
    except (OSError, ValueError):
        return None
