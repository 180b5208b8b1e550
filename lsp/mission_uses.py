"""Names of models in mission files: a declaration in; the places of open and closed mission files that name it, out."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from lsprotocol.types import Location

from lsp.documents import Documents
from lsp.mission_answers import declared_at, named
from lsp.mission_texts import MissionTexts, OpenMission, place_at
from lsp.occurrences import Role, Symbol
from lsp.positions import Lines
from lsp.project import Snapshot
from lsp.references import Everywhere, Place, symbol_declared_at
from lsp.roots import files_below
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
    beside = dict.fromkeys(Path(project.key).parent for project in found.projects)
    for path in _candidates((*documents.folders, *beside)):
        if key_of(path) not in seen:
            seen.add(key_of(path))
            text = _read(path)
            if _REACTOR in text:
                yield OpenMission(uri_of(path), path, 0, Lines(text, documents.encoding))


def _candidates(folders: Iterable[Path]) -> Iterator[Path]:
    for folder in folders:
        yield from files_below(folder, ".toml")


def _read(path: Path) -> str:
    try:
        return (read_text(path) or "") if path.stat().st_size <= _LARGEST else ""
    except (OSError, ValueError):
        return ""
