"""Names of models in mission files: a declaration in; the places of open and closed mission files that name it, out."""

import re
import stat
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from lsprotocol.types import Location

from lsp.documents import Documents
from lsp.mission_answers import declared_at, named
from lsp.mission_texts import MissionTexts, OpenMission, place_at
from lsp.occurrences import Role, Symbol
from lsp.positions import Encoding, Lines
from lsp.project import Snapshot
from lsp.references import Everywhere, Place, symbol_declared_at
from lsp.roots import files_below, folder_of
from lsp.uris import key_of, uri_of
from nddl_lang.text.read import read_text
from nddl_lang.text.source import Span

_LARGEST = 2**20  # bytes
_MOST_KEPT = 256
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


def mission_uses(documents: Documents, missions: MissionTexts, found: Everywhere, name: str) -> list[MissionUse]:
    """Where mission files name what `found` has all occurrences of, in the order of the files."""
    declared = {place for place, each in found.found.items() if each.role is Role.DECLARES}
    models = {project.key for project in found.projects}
    word = re.compile(rf"(?<![\w$]){re.escape(name)}(?![\w$])")
    uses = []
    for mission in _missions(documents, missions, found):
        if word.search(mission.text) is not None and not models.isdisjoint(map(key_of, mission.models)):
            for match in word.finditer(mission.text):
                place = place_at(mission.text, match.end())
                if (place.begin, place.finish) != match.span():
                    continue
                things = named(documents, mission, place)
                if any(_place(snapshot, declared_at(snapshot, thing)) in declared for snapshot, thing in things):
                    uses.append(MissionUse(mission.uri, mission.lines, *match.span()))
    return uses


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
    """The open mission files, then those of the workspace and beside the models."""
    seen = set()
    for mission in missions.all():
        seen.add(key_of(mission.path))
        yield mission
    beside = (folder for project in found.projects if (folder := folder_of(project.key)) is not None)
    for path in _candidates(dict.fromkeys((*documents.folders, *beside))):
        if key_of(path) not in seen:
            seen.add(key_of(path))
            closed = _closed(path, documents.encoding)
            if closed is not None:
                yield closed


def _candidates(folders: Iterable[Path]) -> Iterator[Path]:
    for folder in folders:
        yield from files_below(folder, ".toml")


def _closed(path: Path, encoding: Encoding) -> OpenMission | None:
    """The mission file at `path`; None where it is none, or cannot be read."""
    try:
        status = path.stat()
        is_small = stat.S_ISREG(status.st_mode) and status.st_size <= _LARGEST
        return _read(path, encoding, status.st_mtime_ns, status.st_size) if is_small else None
    except (OSError, ValueError):
        return None


@lru_cache(_MOST_KEPT)
def _read(path: Path, encoding: Encoding, changed: int, size: int) -> OpenMission | None:
    """The mission file as it was when it was `changed` last and had that `size`."""
    del changed, size
    text = read_text(path) or ""
    return OpenMission(uri_of(path), path, 0, Lines(text, encoding)) if _REACTOR in text else None
