"""Fit the words of one line into as many lines as they need."""

from nddl_lang.formatter.layout import INDENT, WIDTH
from nddl_lang.formatter.spacing import BLANKS

# A line that goes on is indented by two more levels, so that it cannot be taken for a new statement.
_CONTINUATION = 2 * INDENT
_CHANGES = {"(": 1, "[": 1, "SET": 1, "{": 1, ")": -1, "]": -1, "}": -1}


class LineWords:
    """The words of one line, in chunks between which a break may or must stand.

    `gap` is the stretch of text between them and what was written before.
    """

    def __init__(self, indent: int, first: str, gap: tuple[int, int], is_closing: bool) -> None:
        self.indent = indent
        self.gap = gap
        self.is_closing = is_closing
        self._chunks = [first]
        self._depths = [0]  # in how many brackets the break before each chunk would stand
        self._open = 0
        self._forced: set[int] = set()
        self._is_after_comment = False

    def add(self, word: str, may_break: bool, kind: str) -> None:
        """Add a word with the blank before it; brackets are told by their `kind`."""
        if len(self._chunks) in self._forced or may_break:
            self._begin_chunk(word.lstrip())
        elif self._is_after_comment:
            self._chunks[-1] += " " + word.lstrip()
        else:
            self._chunks[-1] += word
        self._is_after_comment = False
        self._open += _CHANGES.get(kind, 0)

    def _begin_chunk(self, text: str) -> None:
        self._chunks.append(text)
        self._depths.append(self._open)

    def add_comment(self, text: str, has_own_line: bool) -> None:
        """Add a comment in the middle of a statement."""
        text = text.rstrip(BLANKS)
        if len(self._chunks) in self._forced or (has_own_line and not is_inline(text)):
            self._forced.add(len(self._chunks))
            self._begin_chunk(text)
        else:
            self._chunks[-1] += (" " if is_inline(text) else "  ") + text
        if not is_inline(text):
            self._forced.add(len(self._chunks))
        self._is_after_comment = True

    def lines(self) -> list[str]:
        """The words in lines no longer than they may be, as far as there are places to break."""
        lines: list[str] = []
        begin = 0
        while begin < len(self._chunks):
            indent = " " * (self.indent + (_CONTINUATION if lines else 0))
            end = self._end_of_line(begin, len(indent))
            lines.append(indent + " ".join(self._chunks[begin:end]))
            begin = end
        return lines

    def _end_of_line(self, begin: int, indent: int) -> int:
        """The chunk that begins the line after the one that begins with the chunk `begin`.

        Of the breaks in the second half of the line it is the last of those that stand in the fewest brackets.
        """
        width = indent + len(self._chunks[begin])
        best: int | None = None
        end = begin + 1
        while end < len(self._chunks) and end not in self._forced:
            if width >= WIDTH // 2 and (best is None or self._depths[end] <= self._depths[best]):
                best = end
            width += 1 + len(self._chunks[end])
            if width > WIDTH:
                return end if best is None else best
            end += 1
        return end


def is_inline(comment: str) -> bool:
    """Whether more can follow `comment` in its line, and it does not span several."""
    return comment.startswith("/*") and "\n" not in comment
