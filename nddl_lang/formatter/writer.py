"""Write the lines of a text: statements, comments and the blank lines between them."""

from nddl_lang.formatter.layout import INDENT, WIDTH, Layout
from nddl_lang.formatter.spacing import BLANKS
from nddl_lang.formatter.words import LineWords, is_inline
from nddl_lang.syntax.piece import Piece

# After one of these a line that is too long may go on below.
_BREAK_AFTER = frozenset((",", "&&", "||"))

Comment = tuple[int, int]


class Writer:
    """Collects lines. Whatever is written last in a line may still be followed by a comment."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._at = 0  # where in the text the last thing written ended
        self._done: list[str] = []
        self._line: str | None = None  # the line at hand
        self._opens_block = True  # whether a blank line would stand at the beginning of a block
        self._short_indent = -1  # where the line at hand begins if another short statement may join it

    def text(self, line_end: str) -> str:
        """All that was written."""
        lines = self._done if self._line is None else [*self._done, self._line]
        return line_end.join([*lines, ""]) if lines else ""

    # ---- statements ----

    def write_statement(self, piece: Piece) -> None:
        """Write a piece without mistakes."""
        layout = Layout(piece)
        offset = piece.anchor.offset
        comments = [(start + offset, end + offset) for start, end in piece.comments]
        used = 0
        words: LineWords | None = None
        for index, start in enumerate(piece.starts):
            if index in layout.dropped:
                if self._text.count("\n", self._at, start + offset) < 2:
                    self._at = piece.ends[index] + offset
                continue
            first = used
            while used < len(comments) and comments[used][0] < start + offset:
                used += 1
            before = comments[first:used]
            word = layout.word(index)
            level = layout.levels.get(index)
            if words is None or level is not None:
                self._write_words(words)
                words = self._begin_words(before, start + offset, level or 0, piece.kinds[index] == "}", word.lstrip())
            else:
                for comment in before:
                    words.add_comment(self._text[slice(*comment)], "\n" in self._text[self._at : comment[0]])
                    self._at = comment[1]
                words.add(word, piece.kinds[index - 1] in _BREAK_AFTER, piece.kinds[index])
            self._at = piece.ends[index] + offset
        self._write_words(words)
        self.write_comments(comments[used:])

    def _begin_words(self, comments: list[Comment], start: int, level: int, is_closing: bool, first: str) -> LineWords:
        """Write `comments`, and begin the words of the line for what stands at `start`."""
        inner = (level + is_closing) * INDENT
        for number, comment in enumerate(comments):
            text = self._text[slice(*comment)].rstrip(BLANKS)
            is_last = number == len(comments) - 1
            if is_last and not is_closing and is_inline(text) and "\n" not in self._text[comment[1] : start]:
                return LineWords(level * INDENT, f"{text} {first}", (self._at, comment[0]), is_closing)
            self._write_comment(comment, text, inner)
        return LineWords(level * INDENT, first, (self._at, start), is_closing)

    def _write_words(self, words: LineWords | None) -> None:
        """Write a line of words; short statements that stood in one line stay together."""
        if words is None:
            return
        *lines, last = words.lines()
        is_short = not lines and last.endswith(";") and not words.is_closing
        gap_start, gap_end = words.gap
        if (
            is_short
            and self._line is not None
            and self._short_indent == words.indent
            and not self._text[gap_start:gap_end].strip(" \t\f")
            and len(self._line) + len(last) - words.indent < WIDTH
        ):
            self._line += " " + last.lstrip()
            return
        self._begin_line(gap_start, gap_end, words.is_closing)
        self._done += lines
        self._line = last
        self._opens_block = last.endswith("{")
        self._short_indent = words.indent if is_short else -1

    # ---- comments ----

    def write_comments(self, comments: list[Comment]) -> None:
        """Write comments that no statement follows."""
        for comment in comments:
            self._write_comment(comment, self._text[slice(*comment)].rstrip(BLANKS), 0)

    def _write_comment(self, comment: Comment, text: str, indent: int) -> None:
        """Write a comment after what stands in its line, or in a line of its own."""
        if self._line is not None and "\n" not in self._text[self._at : comment[0]]:
            self._line += "  " + text
        else:
            self._begin_line(self._at, comment[0], False)
            self._line = " " * indent + text
            self._opens_block = False
        self._short_indent = -1
        self._at = comment[1]

    # ---- what was not understood ----

    def write_raw(self, start: int, end: int, comments: list[Comment]) -> None:
        """Write what stands from `start` to `end` as it is, after `comments`."""
        self.write_comments(comments)
        line = self._text.rfind("\n", 0, start) + 1
        indent = self._text[line:start]
        self._begin_line(self._at, start, False)
        self._line = (indent if line >= self._at and not indent.strip(BLANKS) else "") + self._text[start:end]
        self._opens_block = False
        self._short_indent = -1
        self._at = end

    # ---- lines ----

    def _begin_line(self, gap_start: int, gap_end: int, is_closing: bool) -> None:
        """End the line at hand; keep one of the blank lines in the gap."""
        if self._line is not None:
            self._done.append(self._line)
            self._line = None
        if not self._opens_block and not is_closing and self._text.count("\n", gap_start, gap_end) > 1:
            self._done.append("")
        self._opens_block = False
