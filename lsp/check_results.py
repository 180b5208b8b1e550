"""Results of the last `nddlc check`: its report in; a diagnostic at the line that gave way, with its chain, out.

A result counts as long as the texts of the model read as they did when the missions were flown. After that it is shown
as stale: at the line that it was about, where that still stands, with less weight.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lsprotocol.types import (
    Diagnostic,
    DiagnosticRelatedInformation,
    DiagnosticSeverity,
    DiagnosticTag,
    Location,
    Position,
    Range,
)

from lsp.documents import Documents
from lsp.uris import key_of
from nddl_lang.text.read import read_text
from nddl_lang.text.values import json_value

REPORT = Path("nddlc-report") / "report.json"
_FORMAT = "nddlc-report/1"
_NAME = r"""(?m)^[ \t]*name[ \t]*=[ \t]*["']{}["']"""
_SOURCE = "nddlc check"
_LARGEST = 64 * 2**20


@dataclass(frozen=True, slots=True)
class _Spot:
    """A line of a model, as it stood when the missions were flown."""

    key: str
    line: int
    text: str


@dataclass(frozen=True, slots=True)
class _Bucket:
    """Missions that failed for one reason."""

    spot: _Spot
    code: str
    message: str
    condition: str | None
    limits: tuple[_Spot, ...]


class CheckResults:
    """The buckets of each report, and the texts that it was made from."""

    def __init__(self, documents: Documents) -> None:
        self._documents = documents
        self._buckets: dict[str, tuple[_Bucket, ...]] = {}  # report -> what failed
        self._texts: dict[str, dict[str, str | None]] = {}  # report -> file -> its text at that time

    def load(self, report: Path, mission: Path) -> bool:
        """Take over the report on a mission; whether there is one that can be read."""
        try:
            if report.stat().st_size > _LARGEST:
                return False
            data = json_value(report.read_text(encoding="utf-8"))
            made = report.stat().st_mtime_ns
        except (OSError, ValueError):
            return False
        if not isinstance(data, dict) or data.get("format") != _FORMAT or not _is_about(data, mission):
            return False
        buckets = tuple(_buckets(data, mission.parent))
        key = key_of(report)
        texts: dict[str, str | None] = {}
        for file in {spot.key for bucket in buckets for spot in (bucket.spot, *bucket.limits)}:
            for project in self._documents.holders(file):
                texts |= {member: _text_before(self._documents, member, made) for member in project.members}
            texts.setdefault(file, _text_before(self._documents, file, made))
        self._buckets[key], self._texts[key] = buckets, texts
        return True

    def look(self, path: Path, folders: Iterable[Path]) -> bool:
        """Load reports, from the folder of `path` and those of the workspace, on a mission in the folder of `path`."""
        try:
            missions = sorted(path.parent.glob("*.toml"), key=lambda file: (file.name != "mission.toml", file))
        except OSError:
            return False
        # Missions of one name in one folder have their places relative to the same folder: the first stands for all.
        reports = dict.fromkeys(folder / REPORT for folder in (*folders, path.parent))
        found = [any(self.load(report, mission) for mission in missions) for report in reports if report.is_file()]
        return any(found)

    def diagnostics(self) -> dict[str, tuple[Diagnostic, ...]]:
        """What failed, by the URI of the file of the line that gave way."""
        found: dict[str, list[Diagnostic]] = {}
        for report, buckets in self._buckets.items():
            is_stale = self._is_stale(report)
            for bucket in buckets:
                place = self._location(bucket.spot)
                if place is not None:
                    found.setdefault(place.uri, []).append(self._shown(bucket, place.range, is_stale))
        return {uri: tuple(shown) for uri, shown in found.items()}

    def at(self, key: str, line: int) -> list[str]:
        """What is said of missions that failed at a line, from 0, of the file at `key`."""
        return [
            text
            for report, buckets in self._buckets.items()
            for bucket in buckets
            if bucket.spot.key == key and (place := self._location(bucket.spot)) is not None
            if place.range.start.line == line
            for text in _described(bucket, self._is_stale(report))
        ]

    def _is_stale(self, report: str) -> bool:
        return any(text is None or self._documents.text(key) != text for key, text in self._texts[report].items())

    def _location(self, spot: _Spot) -> Location | None:
        """Where the line stands now: where it stood, or where it is found elsewhere once."""
        text = self._documents.text(spot.key)
        if text is None:
            return None
        uri, _ = self._documents.lines_of(spot.key)
        lines = text.splitlines()
        number = spot.line - 1
        if not (0 <= number < len(lines) and spot.text in lines[number]):
            others = [index for index, line in enumerate(lines) if spot.text and spot.text in line]
            number = others[0] if len(others) == 1 else min(max(number, 0), max(0, len(lines) - 1))
        line = lines[number] if lines else ""
        start = len(line) - len(line.lstrip())
        return Location(uri, Range(Position(number, start), Position(number, max(start, len(line.rstrip())))))

    def _shown(self, bucket: _Bucket, place: Range, is_stale: bool) -> Diagnostic:
        related = [
            DiagnosticRelatedInformation(where, "a limit that took part")
            for spot in bucket.limits
            if (where := self._location(spot)) is not None
        ]
        return Diagnostic(
            place,
            "\n".join(_described(bucket, is_stale)),
            DiagnosticSeverity.Hint if is_stale else DiagnosticSeverity.Warning,
            bucket.code,
            source=_SOURCE,
            tags=[DiagnosticTag.Unnecessary] if is_stale else None,
            related_information=related or None,
        )


def _described(bucket: _Bucket, is_stale: bool) -> Iterator[str]:
    yield f"{bucket.message} (before the last change; check again)" if is_stale else bucket.message
    if bucket.condition is not None:
        yield f"fails when {bucket.condition}"


def _is_about(data: dict[str, Any], mission: Path) -> bool:
    """Whether a report is about a mission file, which bears the name that the report tells."""
    name = data.get("name")
    try:
        text = read_text(mission)
    except (OSError, ValueError):
        return False
    return isinstance(name, str) and text is not None and re.search(_NAME.format(re.escape(name)), text) is not None


def _text_before(documents: Documents, key: str, made: int) -> str | None:
    """The text of a file; None where it was changed after the report was made."""
    try:
        if Path(key).stat().st_mtime_ns > made:
            return None
    except OSError:
        return None
    return documents.text(key)


def _buckets(data: dict[str, Any], root: Path) -> Iterator[_Bucket]:
    flown = len(data.get("missions") or ()) or data.get("planned")
    for fault in data.get("faults") or ():
        spot = _spot(fault.get("place"), root)
        if spot is None:
            continue
        condition = fault.get("condition") or {}
        why = f": {fault['because']}" if fault.get("because") else ""
        yield _Bucket(
            spot,
            str(fault.get("code")),
            f"{fault.get('count')} of {flown} missions of `{data['name']}` fail here, {fault.get('meaning')}{why}",
            condition.get("text") and f"{condition['text']}{' (in part)' if condition.get('partial') else ''}",
            tuple(each for limit in fault.get("limits") or () if (each := _spot(limit, root)) is not None),
        )


def _spot(place: Any, root: Path) -> _Spot | None:
    if not isinstance(place, dict) or not isinstance(place.get("file"), str):
        return None
    return _Spot(key_of(root / place["file"]), int(place.get("line") or 1), str(place.get("text") or "").strip())
