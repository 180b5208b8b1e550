"""Keep the parse of a text that is being edited, parsing again only the top-level statements that changed."""

from bisect import bisect_left
from collections.abc import Callable

from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.parser import MOST_LEXEMES, Parse, collect, parse_block, understand
from nddl_lang.syntax.piece import Piece
from nddl_lang.syntax.placement import TOP, BlockGrammar
from nddl_lang.syntax.scan import Scanner
from nddl_lang.text.source import Source


class Incremental:
    """One text under edit. The nodes of statements that an edit leaves alone stay the same objects.

    A piece is kept when its text is the same and nothing changed within its reach; after the edit, reading stops as
    soon as it comes to a place where a piece began before, in text that is the same to the end.
    """

    def __init__(
        self, name: str, dialect: Dialect = Dialect.NDDLC, block: BlockGrammar = TOP, most: int = MOST_LEXEMES
    ) -> None:
        self._name = name
        self._dialect = dialect
        self._block = block
        self._most = most
        self._text = ""
        self._pieces: tuple[Piece, ...] = ()

    def update(self, text: str) -> Parse:
        """The parse of `text`, which takes the place of the text before."""
        source = Source(self._name, text)
        old = self._pieces
        prefix, suffix = common_ends(self._text, text)
        shift = len(text) - len(self._text)
        size = 0
        starts = [piece.anchor.offset for piece in old]

        kept = 0
        while kept < len(old) and starts[kept] + old[kept].reach <= prefix:
            size += old[kept].size
            kept += 1
        pieces = list(old[:kept])
        at = pieces[-1].anchor.offset + pieces[-1].length if pieces else 0

        changed = bisect_left(starts, len(self._text) - suffix, kept)
        replaced = {piece.text: piece for piece in old[kept:changed] if not piece.diagnostics}
        scanner = Scanner(source, self._dialect is Dialect.NDDL3)
        rest = len(old)
        while at < len(text):
            if at >= len(text) - suffix:
                before = bisect_left(starts, at - shift, kept)
                # A byte order mark counts only at the very beginning.
                if before < len(old) and starts[before] == at - shift and (at == 0) == (at == shift):
                    rest = before
                    break
            piece = scanner.read(at, self._most - size)
            size += piece.size
            if size > self._most:
                return self._again(source)
            same = replaced.pop(text[at : at + piece.length], None)
            if same is not None and same.kinds == piece.kinds and not piece.mends and not piece.diagnostics:
                piece = self._moved(same, source, at, piece.reach)
            else:
                understand(piece, self._dialect, self._block)
            pieces.append(piece)
            at += piece.length

        if size + sum(piece.size for piece in old[rest:]) > self._most:
            return self._again(source)
        for piece in pieces[:kept]:
            piece.anchor.source = source
        for piece in old[rest:]:
            piece.anchor.source = source
            piece.anchor.offset += shift
        self._text = text
        self._pieces = (*pieces, *old[rest:])
        return collect(source, self._dialect, self._pieces)

    def _again(self, source: Source) -> Parse:
        """The parse of a text that is too large, of which nothing is kept."""
        self._text, self._pieces = "", ()
        return parse_block(source, self._dialect, self._block, self._most)

    @staticmethod
    def _moved(piece: Piece, source: Source, offset: int, reach: int) -> Piece:
        """`piece`, which stands at `offset` now."""
        piece.anchor.source = source
        piece.anchor.offset = offset
        piece.reach = reach
        return piece


def common_ends(old: str, new: str) -> tuple[int, int]:
    """How many characters both texts share at their beginning and, not counting those, at their end."""
    shorter = min(len(old), len(new))
    prefix = _longest(shorter, lambda count: old.startswith(new[:count]))
    most = shorter - prefix
    suffix = _longest(most, lambda count: old.endswith(new[len(new) - count :]))
    return prefix, suffix


def _longest(most: int, holds: Callable[[int], bool]) -> int:
    """The largest count up to `most` for which `holds`, which holds for all smaller ones too."""
    least = 0
    while least < most:
        middle = (least + most + 1) // 2
        if holds(middle):
            least = middle
        else:
            most = middle - 1
    return least
