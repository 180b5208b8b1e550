"""Offsets in a text in, the lines and units that an editor counts out; and back."""

from bisect import bisect_right
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from itertools import accumulate

from lsprotocol.types import Position, Range


class Encoding(Enum):
    """What an editor counts the characters of a line in; the value is the protocol's name."""

    UTF8 = "utf-8"
    UTF16 = "utf-16"
    UTF32 = "utf-32"


@dataclass(frozen=True, eq=False)
class Lines:
    """The lines of one text as the protocol cuts them: after CR LF, LF or CR, and nowhere else."""

    text: str
    encoding: Encoding

    @cached_property
    def starts(self) -> tuple[int, ...]:
        """Where each line begins."""
        text = self.text
        if "\r" in text:
            # A CR that an LF follows ends no line of its own; both have one length, so offsets stay right.
            text = text.replace("\r\n", " \n").replace("\r", "\n")
        lengths = [len(line) + 1 for line in text.split("\n")]
        return (0, *accumulate(lengths[:-1]))

    @cached_property
    def _is_plain(self) -> bool:
        return self.encoding is Encoding.UTF32 or self.text.isascii()

    def position(self, offset: int) -> Position:
        """The line and unit, both from 0, of the character at `offset`."""
        return Position(*self.place(offset))

    def place(self, offset: int) -> tuple[int, int]:
        """The same, where no editor needs to read it."""
        offset = max(0, min(offset, len(self.text)))
        line = bisect_right(self.starts, offset) - 1
        start = self.starts[line]
        return line, offset - start if self._is_plain else self._units(self.text[start:offset])

    def range(self, begin: int, finish: int) -> Range:
        """The stretch from `begin` to `finish`."""
        start = self.position(begin)
        if self._is_plain and begin <= finish < self._end_of(start.line) and begin >= 0:
            return Range(start, Position(start.line, start.character + finish - begin))
        return Range(start, self.position(finish))

    def _end_of(self, line: int) -> int:
        """Where the next line begins, or the text ends."""
        return self.starts[line + 1] if line + 1 < len(self.starts) else len(self.text)

    def offset(self, position: Position) -> int:
        """The offset that `position` stands for: past the end of a line, that end; inside a character, its begin."""
        if position.line < 0:
            return 0
        if position.line >= len(self.starts):
            return len(self.text)
        start = self.starts[position.line]
        end = self._end(position.line)
        if self._is_plain:
            return min(start + max(0, position.character), end)
        left = position.character
        for offset in range(start, end):
            left -= self._units(self.text[offset])
            if left < 0:
                return offset
        return end

    def _end(self, line: int) -> int:
        """Where the line ends, its line end not counted."""
        if line + 1 == len(self.starts):
            return len(self.text)
        end = self.starts[line + 1] - 1
        return end - 1 if self.text[end] == "\n" and end > self.starts[line] and self.text[end - 1] == "\r" else end

    def _units(self, text: str) -> int:
        if text.isascii() or self.encoding is Encoding.UTF32:
            return len(text)
        if self.encoding is Encoding.UTF8:
            return len(text.encode("utf-8", errors="surrogatepass"))
        return len(text) + sum(letter > "\uffff" for letter in text)


def replaced(lines: Lines, place: Range, text: str) -> str:
    """The text of `lines` with `text` in place of what stands at `place`."""
    begin, finish = sorted((lines.offset(place.start), lines.offset(place.end)))
    return lines.text[:begin] + text + lines.text[finish:]
