"""Cut a text into top-level pieces, and each piece into lexemes.

Reading a piece depends on nothing before it, so the incremental parser can start at any piece.
"""

import re
from itertools import islice

from nddl_lang.syntax.braces import (
    ELSE_AHEAD,
    close_body,
    close_branch,
    end_of_strays,
    first_outside,
    give_back,
    is_surplus,
    lacks_brace,
    leave_out,
    leave_out_doubled,
    open_branch,
    open_head,
    put_in,
    watch_opening,
)
from nddl_lang.syntax.brackets import DEPTH_LIMIT, STEPS, Brackets
from nddl_lang.syntax.codes import (
    BYTE_ORDER_MARK,
    COMMENT_AT_END,
    INCLUDE_BLANK,
    MISSPELT,
    TOO_DEEP,
    UNCLOSED_COMMENT,
    UNDECODABLE,
)
from nddl_lang.syntax.lexemes import (
    LONGEST_INDENT,
    misspelt_include,
    read_directive,
    read_number,
    read_other,
    read_quoted,
    read_string,
    report_glued_sign,
    string_end,
)
from nddl_lang.syntax.piece import Piece
from nddl_lang.syntax.separators import INSTEAD, meant_sign
from nddl_lang.syntax.words import KINDS
from nddl_lang.text.diagnostic import Edit, Fix
from nddl_lang.text.source import Anchor, Source

_WORD, _NUMBER, _COMMENT, _OPEN_COMMENT, _PUNCTUATION, _STRING, _QUOTED, _DIRECTIVE = range(1, 9)
_MASTER = re.compile(
    r"""[ \t\r\n\f]*+(?:
      ([A-Za-z_$][A-Za-z0-9_$]*+)
    | ((?:[+-]?[0-9]|\.[0-9])(?:[eE][+-][0-9]|[A-Za-z0-9_$.])*+
      |-inff?(?![A-Za-z0-9_$])
      |\+[ \t\r\n\f]*inff?(?![A-Za-z0-9_$]))
    | (//[^\n]*+|/\*.*?\*/)
    | (/\*)
    | (\#include(?![A-Za-z0-9_$])|::|==|!=|<=|>=|&&|\|\||[;{}()\[\],.=<>+\-*/!:])
    | ("[^"\\]*+(?:\\.[^"\\]*+)*+")
    | ('[^'\n]*+'|[“”„«‘][^\n"“”„«»‘’]*+[”“»’])
    | (\#[^\n]*+)
    | (["']|[^A-Za-z0-9_$ \t\r\n\f;{}()\[\],.=<>+\-*/!:"'\#]++)
    )""",
    re.VERBOSE | re.DOTALL,
)

# After one of these an operand has ended, so a sign that follows is an operator.
_OPERANDS = frozenset(("IDENT", "INT", "FLOAT", "STRING", "BOOL", "this", ")", "]"))
# At the start of a line these begin a top-level statement, whatever is still open.
_TOP_LEVEL = frozenset(("class", "enum", "typedef", "GOAL"))
_MEMBERS = frozenset(("predicate", "action"))
_WATCHED_WORDS = _TOP_LEVEL | _MEMBERS | {"if", "else", "FORMER", "super"}
_BRACKETS = frozenset("{}()[];")
_WATCHED_SIGNS = _BRACKETS | {"::", ":", "#include"}
_AFTER_HEAD = (["{"], ["="], ["-"], [":"])  # of a rule, where no statement begins
_BEYOND = 1 << 62


class Scanner:
    """Reads pieces of one source; `is_strict` reports the lexemes that nddl3 does not accept."""

    def __init__(self, source: Source, is_strict: bool) -> None:
        self._source = source
        self._is_strict = is_strict
        self._has_undecodable = "\ufffd" in source.text

    def read(self, base: int, most: int) -> Piece:
        """The piece that begins at offset `base`; one whose size is above `most` is not read to its end.

        Its offsets are absolute until it is finished.
        """
        text = self._source.text
        piece = self._piece = Piece(Anchor(self._source, base))
        self._base = base
        self._brackets = Brackets()
        self._docs: list[str] = []
        self._has_if = False
        self._head = self._doubled = -1
        self._end = -1
        kinds, texts, starts, ends = piece.kinds, piece.texts, piece.starts, piece.ends
        at = base
        if base == 0 and text.startswith("\ufeff"):
            at = self._skip_byte_order_mark()
        while at >= 0:
            # A match adds one to the size, or two, or nothing.
            ahead = most + 1 - self._size()
            if ahead <= 0:
                break
            finish = -1
            for match in islice(_MASTER.finditer(text, at), ahead):
                group = match.lastindex or 0
                start, finish = match.span(group)
                word = match[group]
                if group == _WORD:
                    kind = KINDS.get(word) or "IDENT"
                    if kind in _WATCHED_WORDS:
                        kind = self._watch_word(kind, start, finish)
                elif group == _PUNCTUATION:
                    kind = word
                    if kind in _WATCHED_SIGNS:
                        kind = self._watch_sign(kind, start, finish)
                elif group == _COMMENT:
                    self._read_comment(word, start, finish)
                    continue
                else:
                    kind, start, end = self._read_rare(group, word, start, finish)
                    word = text[start:end]
                    if end != finish:
                        # What looked like one lexeme ends earlier: go on from there.
                        finish, at = end, ~end
                if kind:
                    if self._docs:
                        self._attach_docs(start)
                    kinds.append(kind)
                    texts.append(word)
                    starts.append(start)
                    ends.append(finish)
                if self._end >= 0:
                    at = -1
                    break
                if at < 0:
                    at = ~at
                    break
            else:
                at = finish
        if at < 0 and self._end < 0:
            self._give_back()
        self._finish()
        return piece

    def _size(self) -> int:
        piece = self._piece
        return len(piece.kinds) + len(piece.comments) + len(piece.diagnostics)

    # ---- the end of a piece ----

    def _finish(self) -> None:
        """Find where the piece ends and make its offsets relative to that place."""
        piece, base = self._piece, self._base
        if self._end < 0:
            self._end = len(self._source.text)
            piece.reach = _BEYOND
        if 0 < self._doubled < len(piece.kinds) and len(self._brackets.open) == 1:  # it may have been given back
            leave_out_doubled(piece, self._doubled, base)
        piece.length = self._end - base
        # What the next character is decides whether the last lexeme ends here.
        piece.reach = max(piece.reach - base, piece.length + 1)
        piece.comments = [(start - base, end - base) for start, end in piece.comments if start < self._end]
        piece.size = self._size()
        if base:
            piece.starts = [start - base for start in piece.starts]
            piece.ends = [end - base for end in piece.ends]

    def _cut(self, seen: int) -> str:
        """End the piece before the lexeme at hand, which ends at `seen`; no kind, so it is not taken in."""
        self._end = self._piece.ends[-1]
        self._piece.reach = max(self._piece.reach, seen + 1)
        self._give_back()
        return ""

    def _give_back(self) -> None:
        """End a piece whose block is never closed before what stands outside of it, to judge by the indentation."""
        at = first_outside(self._piece, self._indent) if self._brackets.open else -1
        if at >= 0:
            if self._end < 0:
                self._piece.reach = _BEYOND
            self._end = give_back(self._piece, at, self._base)

    def _begins_statement(self, start: int) -> bool:
        """Whether `start` is the first thing in its line and stands no deeper than the piece began."""
        return 0 <= self._indent(start) <= max(0, self._indent(self._piece.starts[0]))

    def _indent(self, start: int) -> int:
        """The number of blanks before `start` in its line; below 0 if more stands there, or another piece."""
        text = self._source.text
        line = text.rfind("\n", max(self._base, start - LONGEST_INDENT), start) + 1
        if (line == 0 and self._base > 0) or text[line:start].strip(" \t\r\f\ufeff"):
            return -1
        return start - line

    # ---- lexemes that matter for where a piece ends ----

    def _watch_word(self, kind: str, start: int, finish: int) -> str:
        if kind == "if":
            self._has_if = self._has_if or not self._brackets
        elif kind == "else":
            close_branch(self._piece, self._brackets, self._base, start)
        elif kind == "FORMER":
            self._piece.has_former_words = True
            return "IDENT"
        elif kind in _MEMBERS:
            self._watch_member(kind, start, len(self._piece.kinds))
            self._head = len(self._piece.kinds)
        elif kind == "super":
            if self._piece.kinds[-1:] == [")"]:
                put_in(self._piece, self._brackets, self._base, len(self._piece.kinds))
        elif self._piece.kinds and self._begins_statement(start):
            return self._cut(finish)
        elif kind == "typedef":
            self._brackets.in_typedef = True
        elif kind != "GOAL":
            self._head = len(self._piece.kinds)
        return kind

    def _watch_member(self, kind: str, start: int, at: int) -> None:
        """Where a member of a class begins, nothing else may be open but the class."""
        piece, brackets = self._piece, self._brackets
        if self._head >= 0:
            open_head(piece, brackets, self._base, self._head, kind)
            self._head = -1
        if len(brackets.open) > 1 and piece.kinds[0] == "class" and self._indent(start) >= 0:
            close_body(piece, brackets, self._base, at)

    def _watch_sign(self, kind: str, start: int, finish: int) -> str:
        piece = self._piece
        kinds = piece.kinds
        if self._head >= 0 and kind in _BRACKETS:
            open_head(piece, self._brackets, self._base, self._head, kind)
            self._head = -1
        if kind == "(" and len(self._brackets.open) > 1 and kinds[0] == "class" and piece.texts[-1] == piece.texts[1]:
            if self._indent(piece.starts[-1]) >= 0:
                close_body(piece, self._brackets, self._base, len(kinds) - 1)
        if kind == ":" or (kind in INSTEAD and self._brackets.innermost in INSTEAD[kind]):
            kind, is_read = meant_sign(kind, piece, self._brackets, self._source.text, self._base, start)
            if is_read:
                return kind
        if kind == "::":
            if len(kinds) > 1 and kinds[-1] == "IDENT" and self._begins_statement(piece.starts[-1]):
                for column in (kinds, piece.texts, piece.starts, piece.ends):
                    column.pop()
                return self._cut(finish)
        elif kind == "#include":
            return self._read_include(start, finish)
        elif self._brackets.closes_statement(kind, kinds[-1] if kinds and not self._is_head_of_rule() else None):
            if kinds[1:3] == ["::", "IDENT"] and self._lacks_brace(kind, start, finish):
                return kind
            if kind == "}" and kinds and self._is_surplus(start, finish):
                return ""
            self._end = finish
            if kind == "}" and not kinds:
                self._end, seen = end_of_strays(self._source.text, finish)
                piece.reach = max(piece.reach, seen + 1)
            if self._has_if:
                # The condition may have an `else` branch.
                ahead = ELSE_AHEAD.match(self._source.text, finish)
                assert ahead is not None
                is_open = self._source.text.startswith("/", ahead.end())  # a comment may come to end somewhere
                piece.reach = _BEYOND if is_open else max(piece.reach, ahead.end() + len("else") + 1)
                if ahead[1] is not None:
                    self._end = -1
        elif self._brackets.is_too_deep and not piece.is_too_deep:
            piece.is_too_deep = True
            piece.report(TOO_DEEP, start - self._base, finish - self._base, limit=DEPTH_LIMIT, help=STEPS)
        if kind != "{":
            return kind
        self._doubled = watch_opening(piece, self._base, self._doubled)
        return "SET" if self._brackets.innermost == "SET" else kind

    def _is_head_of_rule(self) -> bool:
        """Whether the next `{` opens the body of a rule, whatever stands between."""
        return not self._brackets.open and self._piece.kinds[1:3] == ["::", "IDENT"]

    def _is_surplus(self, start: int, finish: int) -> bool:
        """Whether the `}` at `start` closes the piece too early; then it is left out."""
        piece = self._piece
        indent = self._indent(piece.starts[0])
        is_alone = self._indent(start) >= 0
        if indent < 0 or not is_surplus(piece, self._source.text, finish, indent, is_alone=is_alone):
            return False
        leave_out(piece, self._brackets, start, self._base)
        return True

    def _lacks_brace(self, kind: str, start: int, finish: int) -> bool:
        """Whether a rule ends too early for want of a `{`, which is then put in."""
        piece, text, base = self._piece, self._source.text, self._base
        indent = self._indent(piece.starts[0])
        if piece.kinds[3:4] in _AFTER_HEAD:
            return kind == "}" and open_branch(piece, self._brackets, text, base, finish, self._indent(start), indent)
        if indent < 0 or piece.mends or not lacks_brace(piece, text, finish, indent):
            return False
        put_in(piece, self._brackets, base, 3)
        return True

    def _read_include(self, start: int, finish: int) -> str:
        """An include at the start of a line ends what stands before it; see `_read_rare` for its own end."""
        text, base, piece = self._source.text, self._base, self._piece
        if not self._brackets and piece.kinds and self._indent(start) >= 0:
            return self._cut(finish)
        if self._is_strict and text.startswith('"', finish):
            at = finish - base
            fix = Fix("put a blank before the path", (Edit(piece.span(at, at), " "),))
            piece.report(INCLUDE_BLANK, start - base, at, fixes=(fix,))
        return "#include"

    # ---- comments and rare lexemes ----

    def _skip_byte_order_mark(self) -> int:
        if self._is_strict:
            fix = Fix("remove the byte order mark", (Edit(self._piece.span(0, 1), ""),))
            self._piece.report(BYTE_ORDER_MARK, 0, 1, fixes=(fix,))
        return 1

    def _read_comment(self, word: str, start: int, finish: int) -> None:
        self._piece.comments.append((start, finish))
        if self._has_undecodable and "\ufffd" in word:
            self._report_undecodable(word, start)
        if word.startswith("///") and not word.startswith("////") and self._indent(start) >= 0:
            self._docs.append(word[3:].removeprefix(" ").rstrip())
        if self._is_strict and word[1] == "/" and finish == len(self._source.text):
            at = finish - self._base
            fix = Fix("end the last line", (Edit(self._piece.span(at, at), "\n"),))
            self._piece.report(COMMENT_AT_END, start - self._base, at, fixes=(fix,))

    def _attach_docs(self, start: int) -> None:
        """What stands in doc comments belongs to the lexeme after them."""
        self._piece.docs[start - self._base] = "\n".join(self._docs)
        self._docs.clear()

    def _read_rare(self, group: int, word: str, start: int, finish: int) -> tuple[str, int, int]:
        """Kind, start and end of a lexeme; no kind if it is not taken in."""
        piece, base, text = self._piece, self._base, self._source.text
        kind = ""
        if group == _NUMBER:
            if word[0] in "+-" and piece.kinds and piece.kinds[-1] in _OPERANDS and self._brackets.innermost != "[":
                if self._is_strict:
                    report_glued_sign(piece, start - base, word, piece.ends[-1] == start)
                piece.kinds.append(word[0])
                piece.texts.append(word[0])
                piece.starts.append(start)
                piece.ends.append(start + 1)
                word = word[1:].lstrip()
                start = finish - len(word)
            kind = read_number(piece, start - base, word, self._is_strict, is_bound=self._brackets.innermost == "[")
        elif group == _STRING or word == '"':
            kind = "STRING"
            is_path = piece.kinds[-1:] == ["#include"]
            end = string_end(text, start, finish if group == _STRING else len(text), is_path)
            if end != finish or word == '"':
                piece.reach = _BEYOND
            word, finish = text[start:end], end
            read_string(piece, start - base, word)
            if self._has_undecodable and "\ufffd" in word:
                self._report_undecodable(word, start)
            if piece.kinds == ["#include"]:
                self._end = end
        elif group == _QUOTED:
            kind = read_quoted(piece, start - base, word)
        elif group == _DIRECTIVE and (name := misspelt_include(word)):
            piece.reach = max(piece.reach, finish + 1)
            finish = start + len(name)
            kind = self._read_include(start, finish)
            if kind:
                fix = Fix("write `#include`", (Edit(piece.span(start - base, finish - base), "#include"),), safe=False)
                help_text = "did you mean `#include`?"
                piece.report(MISSPELT, start - base, finish - base, text=name, help=help_text, fixes=(fix,))
        elif group == _DIRECTIVE:
            read_directive(piece, start - base, word)
            if not piece.kinds:
                self._end = finish
        elif group == _OPEN_COMMENT:
            end = start + len("/*") - base
            piece.report(UNCLOSED_COMMENT, start - base, end, help="write `*/` where the comment ends")
            piece.comments.append((start, len(text)))
            piece.is_cut_short = True
            self._end, piece.reach = len(text), _BEYOND
        else:
            if word == "'":
                # Its partner may come to stand anywhere in the line.
                line_end = text.find("\n", finish)
                piece.reach = max(piece.reach, line_end + 1) if line_end >= 0 else _BEYOND
            kind = read_other(piece, start - base, word) or ""
        return kind, start, finish

    def _report_undecodable(self, word: str, start: int) -> None:
        at = start + word.index("\ufffd") - self._base
        self._piece.report(UNDECODABLE, at, at + 1, help="save the file as UTF-8")
