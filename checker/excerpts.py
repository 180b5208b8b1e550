"""A place of a model in, the path and the line of text out that a reader wants to see."""

from dataclasses import dataclass, field
from pathlib import Path

from nddl_lang.text.read import read_text
from runtime.executive.outcome import SourcePlace


@dataclass(slots=True)
class Excerpts:
    """The texts of a mission's models; places name files relative to `root`."""

    root: Path
    _lines: dict[str, list[str]] = field(default_factory=dict)

    def path(self, place: SourcePlace) -> str:
        """`file:line`, with the file as the user would name it."""
        return f"{self.file(place)}:{place.line}"

    def file(self, place: SourcePlace) -> str:
        """The file as the user would name it."""
        path = self.root / place.file
        return path.as_posix() if path.exists() else place.file

    def line(self, place: SourcePlace) -> str:
        """The whole line at a place, as it stands there now if that is still the line that was run."""
        if place.file not in self._lines:
            text = read_text(self.root / place.file)
            self._lines[place.file] = text.splitlines() if text is not None else []
        lines = self._lines[place.file]
        first = place.text.strip().split("\n")[0].strip()
        if 0 < place.line <= len(lines) and first in lines[place.line - 1]:
            return lines[place.line - 1].rstrip()
        return first
