"""Find where the lines of a statement begin, from its lexemes alone."""

from nddl_lang.formatter.spacing import has_blank
from nddl_lang.syntax.piece import Piece

WIDTH = 100
INDENT = 4

_OPENERS = frozenset(("(", "[", "{", "SET"))
_CLOSERS = frozenset((")", "]", "}"))


class Layout:
    """The lines of one piece that has no mistakes.

    `levels` maps each lexeme that begins a line to how deep the line is indented; `dropped` are the lexemes that
    say nothing: a `;` by itself. A statement with a block that was written on one line stays on one line if it fits.
    """

    def __init__(self, piece: Piece) -> None:
        self._piece = piece
        self._kinds = piece.kinds
        self._text = piece.text
        self._brackets = _innermost(piece.kinds)
        self._commented = _commented(piece)
        self.levels: dict[int, int] = {}
        self.dropped: set[int] = set()
        self._statements(0, 0)

    def word(self, index: int) -> str:
        """The lexeme `index` with the blank before it, if it does not begin a line."""
        text = self._piece.texts[index]
        if self._kinds[index] in ("INT", "FLOAT"):
            text = "".join(text.split())
        if index == 0 or not has_blank(self._kinds, index, self._brackets[index]):
            return text
        return " " + text

    # ---- statements ----

    def _statements(self, index: int, level: int) -> int:
        """Lay out statements one below the other, to the end of the piece or the next `}`."""
        kinds = self._kinds
        while index < len(kinds) and kinds[index] != "}":
            if kinds[index] == ";" and index not in self._commented:
                self.dropped.add(index)
                index += 1
            else:
                self.levels[index] = level
                index = self._statement(index, level)
        return index

    def _statement(self, first: int, level: int) -> int:
        """Lay out the statement that begins at `first`; returns the lexeme after it."""
        end = self._lines(first, level)
        if self._stays_on_one_line(first, end, level):
            for index in range(first + 1, end):
                self.levels.pop(index, None)
        return end

    def _lines(self, index: int, level: int) -> int:
        kinds = self._kinds
        while kinds[index] == "if":
            index = self._body(self._closing(index + 1) + 1, level)
            if index == len(kinds) or kinds[index] != "else":
                return index
            if kinds[index - 1] != "}" or index in self._commented:
                self.levels[index] = level
            index += 1
            if kinds[index] != "if":
                return self._body(index, level)
        if kinds[index] == "foreach":
            return self._body(self._closing(index + 1) + 1, level)
        if kinds[index] == "#include":
            return index + 2
        if kinds[index + 1 : index + 2] == ["::"]:
            return self._body(index + 3, level)
        is_enum = kinds[index] == "enum"
        while kinds[index] != ";":
            if kinds[index] == "{":
                return self._names(index, level) if is_enum else self._block(index, level)
            index += 1
        return index + 1

    def _body(self, index: int, level: int) -> int:
        """Lay out a block, or a single statement one level deeper."""
        if self._kinds[index] == "{":
            return self._block(index, level)
        self.levels[index] = level + 1
        return self._statement(index, level + 1)

    def _block(self, index: int, level: int) -> int:
        end = self._statements(index + 1, level + 1)
        if end in self._commented or any(inner in self.levels for inner in range(index + 1, end)):
            self.levels[end] = level
        return end + 1

    def _names(self, index: int, level: int) -> int:
        """Lay out the values of an enum, one below the other."""
        kinds = self._kinds
        while kinds[index] != "}":
            index += 1
            self.levels[index] = level + 1
            index += 1
        self.levels[index] = level
        return index + 1

    # ---- questions ----

    def _closing(self, index: int) -> int:
        """The `)` that closes the `(` at `index`."""
        depth = 0
        while True:
            if self._kinds[index] == "(":
                depth += 1
            elif self._kinds[index] == ")":
                depth -= 1
                if depth == 0:
                    return index
            index += 1

    def _stays_on_one_line(self, first: int, end: int, level: int) -> bool:
        inner = range(first + 1, end)
        if "\n" in self._text[self._piece.starts[first] : self._piece.ends[end - 1]]:
            return False
        if any(index in self._commented for index in inner):
            return False
        kept = [self.word(index) for index in range(first, end) if index not in self.dropped]
        return level * INDENT + len("".join(kept).strip()) <= WIDTH


def _innermost(kinds: list[str]) -> list[str | None]:
    """For each lexeme the innermost bracket that is open before it."""
    stack: list[str] = []
    found: list[str | None] = []
    for kind in kinds:
        found.append(stack[-1] if stack else None)
        if kind in _OPENERS:
            stack.append(kind)
        elif kind in _CLOSERS and stack:
            stack.pop()
    return found


def _commented(piece: Piece) -> set[int]:
    """The lexemes right before which comments stand."""
    found: set[int] = set()
    index = 0
    for start, _ in piece.comments:
        while index < len(piece.starts) and piece.starts[index] < start:
            index += 1
        found.add(index)
    return found
