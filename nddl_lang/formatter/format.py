"""Format a text: comments and blank lines kept, the meaning unchanged, mistakes left as they are."""

import re
from dataclasses import dataclass

from nddl_lang.formatter.spacing import BLANKS
from nddl_lang.formatter.writer import Writer
from nddl_lang.syntax.codes import INTEGER_RANGE, UNKNOWN_ESCAPE
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.parser import MOST_ASKED_FOR, MOST_LEXEMES, Parse, parse
from nddl_lang.syntax.piece import Piece
from nddl_lang.syntax.walk import same_tree
from nddl_lang.text.diagnostic import Diagnostic, Severity
from nddl_lang.text.source import Source

# Not possessive: Python up to 3.11.2 reads on behind a comment without an end. Nothing follows, so nothing is retried.
_TRIVIA = re.compile(r"(?:[ \t\r\n\f]+|//[^\n]*|/\*.*?\*/)*", re.DOTALL)
# With these mistakes it is still clear what every lexeme means.
_HARMLESS = frozenset((INTEGER_RANGE.id, UNKNOWN_ESCAPE.id))


@dataclass(frozen=True, slots=True)
class Formatted:
    """A text in the style, and what is wrong with it: statements with mistakes stand there as they were written."""

    text: str
    diagnostics: tuple[Diagnostic, ...]


def format_text(text: str, dialect: Dialect = Dialect.NDDLC, name: str = "text", most: int = MOST_LEXEMES) -> Formatted:
    """`text` in the style."""
    return format_parse(parse(Source(name, text), dialect, most))


def format_parse(parsed: Parse) -> Formatted:
    """The text of `parsed` in the style; as it is where another layout would make more, or less, of its mistakes."""
    if not parsed.pieces:  # nothing of it was understood
        return Formatted(parsed.source.text, parsed.diagnostics)
    written = _written(parsed)
    if written != parsed.source.text and any(_leaves_doubt(diagnostic) for diagnostic in parsed.diagnostics):
        again = parse(Source(parsed.source.name, written), parsed.dialect, MOST_ASKED_FOR)
        if not same_tree(parsed.module, again.module) or _written(again) != written:
            written = parsed.source.text
    return Formatted(written, parsed.diagnostics)


def _written(parsed: Parse) -> str:
    text = parsed.source.text
    mark = "\ufeff" if text.startswith("\ufeff") else ""
    writer = Writer(text)
    for piece in parsed.pieces:
        if any(_leaves_doubt(diagnostic) for diagnostic in piece.diagnostics):
            _write_raw(writer, piece, text)
        elif piece.kinds:
            writer.write_statement(piece)
        else:
            offset = piece.anchor.offset
            writer.write_comments([(start + offset, end + offset) for start, end in piece.comments])
    line_end = "\r\n" if "\r\n" in text else "\n"
    written = writer.text(line_end)
    if not mark and written.startswith("\ufeff"):
        # It was an unknown character inside the text; at the beginning it would be a byte order mark.
        mark = line_end
    return mark + written


def _leaves_doubt(diagnostic: Diagnostic) -> bool:
    """Whether the statement with this mistake had better stay as it is."""
    code = diagnostic.code
    is_portable_only = "NDDL150" <= code.id < "NDDL170"
    return diagnostic.severity is Severity.ERROR and not is_portable_only and code.id not in _HARMLESS


def _write_raw(writer: Writer, piece: Piece, text: str) -> None:
    """Write `piece` as it is, but for the comments before it."""
    offset = piece.anchor.offset
    end = offset + piece.length
    first = offset + (1 if offset == 0 and text.startswith("\ufeff") else 0)
    trivia = _TRIVIA.match(text, first, end)
    assert trivia is not None
    start = trivia.end()
    comments = [(one + offset, other + offset) for one, other in piece.comments if one + offset < start]
    if start < end:
        writer.write_raw(start, offset + len(piece.text.rstrip(BLANKS)), comments)
    else:
        writer.write_comments(comments)
