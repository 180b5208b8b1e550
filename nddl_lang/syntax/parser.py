"""Text in; its syntax tree and what is wrong with it out."""

from collections.abc import Iterator
from dataclasses import dataclass

from nddl_lang.syntax.codes import TOO_LARGE
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.driver import parse_piece
from nddl_lang.syntax.nodes import BrokenStatement, ClassDecl, Include, Module, Statement
from nddl_lang.syntax.piece import Piece
from nddl_lang.syntax.placement import CLASS, TOP, BlockGrammar
from nddl_lang.syntax.scan import Scanner
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Anchor, Source, Span

# Lexemes and comments of a model: a hundred times those of the largest in public. A project may ask for more.
MOST_LEXEMES = 125_000
MOST_ASKED_FOR = 1_000_000


@dataclass(frozen=True, eq=False, slots=True)
class Parse:
    """One text and what was understood of it; the pieces tile the text, one for each top-level statement.

    Nothing is understood of a text whose `size` is above the limit: it has no pieces.
    """

    source: Source
    dialect: Dialect
    module: Module
    diagnostics: tuple[Diagnostic, ...]
    pieces: tuple[Piece, ...]
    size: int = 0
    has_includes: bool = False

    @property
    def comments(self) -> Iterator[Span]:
        """The comments of the text, in order."""
        return (piece.span(start, end) for piece in self.pieces for start, end in piece.comments)


def parse(source: Source, dialect: Dialect = Dialect.NDDLC, most: int = MOST_LEXEMES) -> Parse:
    """Understand `source`; whatever it holds, this returns."""
    return parse_block(source, dialect, TOP, most)


def parse_members(source: Source, dialect: Dialect = Dialect.NDDLC, most: int = MOST_LEXEMES) -> Parse:
    """Understand `source` as what is included between the members of a class."""
    return parse_block(source, dialect, CLASS, most)


def parse_block(source: Source, dialect: Dialect, block: BlockGrammar, most: int) -> Parse:
    """Understand `source` as what stands in a block, unless it is larger than `most`."""
    scanner = Scanner(source, dialect is Dialect.NDDL3)
    pieces = []
    at = size = 0
    while at < len(source.text):
        piece = scanner.read(at, most - size)
        size += piece.size
        if size > most:
            return _too_large(source, dialect, piece, size, most)
        understand(piece, dialect, block)
        pieces.append(piece)
        at += piece.length
    return collect(source, dialect, tuple(pieces))


def _too_large(source: Source, dialect: Dialect, piece: Piece, size: int, most: int) -> Parse:
    start = piece.anchor.offset + (piece.starts[0] if piece.starts else 0)
    place = Span(Anchor(source), start, min(start + 1, len(source.text)))
    return Parse(source, dialect, Module(()), (too_large(place, most),), (), size)


def too_large(place: Span, most: int) -> Diagnostic:
    """The complaint about a model of more than `most` lexemes, at the place that brings more."""
    help_ = f"`max-lexemes` in nddlc.toml allows up to {MOST_ASKED_FOR}" if most < MOST_ASKED_FOR else None
    return TOO_LARGE.at(place, help=help_, limit=most)


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
    size = 0
    for piece in pieces:
        size += piece.size
        statements += piece.statements
        if piece.diagnostics:
            diagnostics += piece.diagnostics
    return Parse(
        source,
        dialect,
        Module(tuple(statements)),
        tuple(diagnostics),
        pieces,
        size,
        any(map(includes_text, statements)),
    )


def includes_text(statement: Statement) -> bool:
    """Whether there is an include in the statement, or it is one."""
    if isinstance(statement, ClassDecl):
        return Include in map(type, statement.members or ())
    return isinstance(statement, Include)
