"""Fit the words of one line into as many lines as they need."""

from nddl_lang.formatter.layout import INDENT, WIDTH
from nddl_lang.formatter.spacing import BLANKS

# A line that goes on is indented by two more levels, so that it cannot be taken for a new statement.
_CONTINUATION = 2 * INDENT


class Words:
    """The words of one line, in chunks between which a break may or must stand.

    `gap` is the stretch of text between them and what was written before.
    """

    def __init__(self, indent: int, first: str, gap: tuple[int, int], is_closing: bool) -> None:
        self.indent = indent
        self.gap = gap
        self.is_closing = is_closing
        self._chunks = [first]
        self._forced: set[int] = set()
        self._is_after_comment = False

    def add(self, word: str, may_break: bool) -> None:
        """Add a word with the blank before it."""
        if len(self._chunks) in self._forced or may_break:
            self._chunks.append(word.lstrip())
        elif self._is_after_comment:
            self._chunks[-1] += " " + word.lstrip()
        else:
            self._chunks[-1] += word
        self._is_after_comment = False

    def add_comment(self, text: str, has_own_line: bool) -> None:
        """Add a comment in the middle of a statement."""
        text = text.rstrip(BLANKS)
        if len(self._chunks) in self._forced or (has_own_line and not is_inline(text)):
            self._forced.add(len(self._chunks))
            self._chunks.append(text)
        else:
            self._chunks[-1] += (" " if is_inline(text) else "  ") + text
        if not is_inline(text):
            self._forced.add(len(self._chunks))
        self._is_after_comment = True

    def lines(self) -> list[str]:
        """The words in lines no longer than they may be, as far as there are places to break."""
        lines = [" " * self.indent + self._chunks[0]]
        for number, chunk in enumerate(self._chunks[1:], 1):
            if number in self._forced or len(lines[-1]) + 1 + len(chunk) > WIDTH:
                lines.append(" " * (self.indent + _CONTINUATION) + chunk)
            else:
                lines[-1] += " " + chunk
        return lines


def is_inline(comment: str) -> bool:
    """Whether more can follow `comment` in its line, and it does not span several."""
    return comment.startswith("/*") and "\n" not in comment
