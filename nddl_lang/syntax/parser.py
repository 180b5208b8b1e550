"""Text in; its syntax tree and what is wrong with it out."""

from collections.abc import Iterator
from dataclasses import dataclass

from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.driver import parse_piece
from nddl_lang.syntax.nodes import BrokenStatement, Module, Statement
from nddl_lang.syntax.piece import Piece
from nddl_lang.syntax.placement import CLASS, TOP, BlockGrammar
from nddl_lang.syntax.scan import Scanner
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Source, Span


@dataclass(frozen=True, eq=False, slots=True)
class Parse:
    """One text and what was understood of it; the pieces tile the text, one for each top-level statement."""

    source: Source
    dialect: Dialect
    module: Module
    diagnostics: tuple[Diagnostic, ...]
    pieces: tuple[Piece, ...]

    @property
    def comments(self) -> Iterator[Span]:
        """The comments of the text, in order."""
        return (piece.span(start, end) for piece in self.pieces for start, end in piece.comments)


def parse(source: Source, dialect: Dialect = Dialect.NDDLC) -> Parse:
    """Understand `source`; whatever it holds, this returns."""
    return _parse(source, dialect, TOP)


def parse_members(source: Source, dialect: Dialect = Dialect.NDDLC) -> Parse:
    """Understand `source` as what is included between the members of a class."""
    return _parse(source, dialect, CLASS)


def _parse(source: Source, dialect: Dialect, block: BlockGrammar) -> Parse:
    scanner = Scanner(source, dialect is Dialect.NDDL3)
    pieces = []
    at = 0
    while at < len(source.text):
        piece = scanner.read(at)
        understand(piece, dialect, block)
        pieces.append(piece)
        at += piece.length
    return collect(source, dialect, tuple(pieces))


def understand(piece: Piece, dialect: Dialect, block: BlockGrammar = TOP) -> None:
    """Make the statements of a piece that has just been read."""
    if piece.is_too_deep:
        start, end = piece.starts[0], piece.ends[-1]
        piece.broken.append((start, end))
        piece.statements = (BrokenStatement(piece.span(start, end)),)
    elif piece.kinds:
        parse_piece(piece, block, dialect is Dialect.NDDL3)
    if len(piece.diagnostics) > 1:
        piece.diagnostics.sort(key=lambda diagnostic: diagnostic.span.start)


def collect(source: Source, dialect: Dialect, pieces: tuple[Piece, ...]) -> Parse:
    """What the pieces of one text hold together."""
    statements: list[Statement] = []
    diagnostics: list[Diagnostic] = []
    for piece in pieces:
        statements += piece.statements
        if piece.diagnostics:
            diagnostics += piece.diagnostics
    return Parse(source, dialect, Module(tuple(statements)), tuple(diagnostics), pieces)
