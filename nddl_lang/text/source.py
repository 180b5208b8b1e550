"""Hold one text and say where in it an offset stands."""

import re
from bisect import bisect_right
from dataclasses import dataclass, field

_LINE_END = re.compile("\n")


@dataclass(frozen=True, eq=False, slots=True)
class Source:
    """One text with the name it was read under; offsets count characters, lines and columns count from 1."""

    name: str
    text: str
    _starts: list[int] = field(init=False, repr=False, default_factory=list)

    @property
    def line_starts(self) -> list[int]:
        """Where each line begins; found when somebody asks first."""
        if not self._starts:
            self._starts.append(0)
            self._starts.extend(end.end() for end in _LINE_END.finditer(self.text))
        return self._starts

    def locate(self, offset: int) -> tuple[int, int]:
        """Line and column of `offset`, both from 1; an offset past the end stands at the end."""
        offset = max(0, min(offset, len(self.text)))
        line = bisect_right(self.line_starts, offset)
        return line, offset - self.line_starts[line - 1] + 1

    def line_end(self, number: int) -> int:
        """Where line `number` (from 1) ends: at its line feed, or with the text."""
        return self.line_starts[number] - 1 if number < len(self.line_starts) else len(self.text)

    def line(self, number: int) -> str:
        """The text of line `number` (from 1) without its line end."""
        return self.text[self.line_starts[number - 1] : self.line_end(number)].removesuffix("\r")


class Anchor:
    """Where a top-level statement stands now; only the incremental parser moves it."""

    __slots__ = ("offset", "source")

    def __init__(self, source: Source, offset: int = 0) -> None:
        self.source = source
        self.offset = offset


@dataclass(frozen=True, slots=True)
class Span:
    """A stretch of text, relative to its anchor, so that an edit elsewhere leaves every span right."""

    anchor: Anchor
    start: int
    end: int

    @property
    def source(self) -> Source:
        """The text that holds the stretch."""
        return self.anchor.source

    @property
    def begin(self) -> int:
        """Offset of the first character in the source."""
        return self.anchor.offset + self.start

    @property
    def finish(self) -> int:
        """Offset after the last character in the source."""
        return self.anchor.offset + self.end

    @property
    def line(self) -> int:
        """Line of the first character, from 1."""
        return self.source.locate(self.begin)[0]

    @property
    def column(self) -> int:
        """Column of the first character, from 1."""
        return self.source.locate(self.begin)[1]

    @property
    def text(self) -> str:
        """The characters themselves."""
        return self.source.text[self.begin : self.finish]

    def to(self, other: "Span") -> "Span":
        """The stretch from here to the end of `other`, which has the same anchor."""
        return Span(self.anchor, self.start, other.end)
