"""Semantic tokens: a text in its model in; what each word of it is, as the protocol packs it, out."""

from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from lsprotocol.types import SemanticTokens, SemanticTokensDelta, SemanticTokensEdit, SemanticTokensLegend

from lsp.occurrences import Occurrence, Role, SymbolType, VariableKind
from lsp.open_text import DocumentContext
from lsp.positions import Encoding, Lines
from nddl_lang.syntax.piece import Piece
from nddl_lang.syntax.words import KINDS

_TYPES = (
    "class",
    "enum",
    "enumMember",
    "type",
    "method",
    "variable",
    "property",
    "parameter",
    "event",
    "function",
    "operator",
    "keyword",
    "number",
    "string",
    "comment",
)
_MODIFIERS = ("declaration", "modification", "defaultLibrary", "static")
LEGEND = SemanticTokensLegend(_TYPES, _MODIFIERS)
_NUMBER = {name: index for index, name in enumerate(_TYPES)}
_DECLARATION, _MODIFICATION, _DEFAULT_LIBRARY, _STATIC = (1 << index for index in range(len(_MODIFIERS)))

_OF_SYMBOL = {
    SymbolType.CLASS: "class",
    SymbolType.ENUM: "enum",
    SymbolType.ENUM_VALUE: "enumMember",
    SymbolType.TYPEDEF: "type",
    SymbolType.PREDICATE: "method",
    SymbolType.VARIABLE: "variable",
    SymbolType.TOKEN: "event",
    SymbolType.RELATION: "operator",
    SymbolType.CALLABLE: "function",
}
_OF_VARIABLE = {VariableKind.MEMBER: "property", VariableKind.PARAMETER: "parameter"}
_OF_LEXEME = {"INT": "number", "FLOAT": "number", "STRING": "string", "BASETYPE": "type", "RELATION": "operator"}
_TOKEN_WORDS = frozenset({"start", "end", "duration", "object", "state", "time"})

_BLOCKS = (4096, 256, 16, 1)

# Offset in the text, length, type and modifiers.
_Token = tuple[int, int, int, int]


@dataclass(frozen=True, eq=False, slots=True)
class _Packed:
    """The tokens of one top-level statement: five numbers each, the first one counted from the line of its begin.

    They stay right as long as the statement begins in the same column and its names mean the same.
    """

    column: int
    occurrences: list[Occurrence]
    data: list[int]
    last_line: int
    last_column: int


def tokens_between(view: DocumentContext, begin: int, finish: int) -> list[int]:
    """The packed tokens of the part of a text from `begin` to `finish`."""
    pieces = view.parse.pieces
    starts = [piece.anchor.offset for piece in pieces]
    first = max(0, bisect_right(starts, begin) - 1)
    tokens: list[_Token] = []
    for piece in pieces[first : bisect_left(starts, finish)]:
        tokens += _tokens(piece, view.snapshot.names.within(piece.anchor))
    within = [each for each in tokens if each[0] < finish and begin < each[0] + each[1]]
    return _pack(view.document.lines, within, 0)[0]


def _tokens(piece: Piece, occurrences: list[Occurrence]) -> Iterator[_Token]:
    base = piece.anchor.offset
    named = {each.span.start: each for each in occurrences}
    comments = [(start, end) for start, end in piece.comments]
    for kind, text, start, end in zip(piece.kinds, piece.texts, piece.starts, piece.ends, strict=True):
        while comments and comments[0][0] < start:
            begin, finish = comments.pop(0)
            yield begin + base, finish - begin, _NUMBER["comment"], 0
        here = named.get(start)
        if here is not None:
            yield start + base, end - start, *_of_occurrence(here)
        elif (name := _OF_LEXEME.get(kind)) is not None:
            yield start + base, end - start, _NUMBER[name], 0
        elif text in KINDS or text.startswith("#"):
            yield start + base, end - start, _NUMBER["keyword"], 0
        elif text in _TOKEN_WORDS:
            yield start + base, end - start, _NUMBER["property"], _DEFAULT_LIBRARY
    for begin, finish in comments:
        yield begin + base, finish - begin, _NUMBER["comment"], 0


def _of_occurrence(here: Occurrence) -> tuple[int, int]:
    name = _OF_SYMBOL[here.symbol.type]
    modifiers = 0
    if here.kind is not None:
        name = _OF_VARIABLE.get(here.kind, name)
        modifiers = _STATIC if here.kind is VariableKind.GLOBAL else 0
    if here.role is Role.DECLARES:
        modifiers |= _DECLARATION
    elif here.role is Role.WRITES:
        modifiers |= _MODIFICATION
    elif here.symbol.type in (SymbolType.RELATION, SymbolType.CALLABLE):
        modifiers |= _DEFAULT_LIBRARY
    return _NUMBER[name], modifiers


def _pack(lines: Lines, tokens: Iterable[_Token], line: int) -> tuple[list[int], int, int]:
    """Five numbers for each token: lines and units after the one before, length, type, modifiers.

    The first token is counted from the begin of `line`. Beside them line and column of the last one.
    """
    starts, text = lines.starts, lines.text
    is_plain = lines.encoding is Encoding.UTF32 or text.isascii()
    packed: list[int] = []
    last_line, last_column = line, 0
    for begin, length, type_, modifiers in tokens:
        finish = begin + length
        while begin < finish:
            while line + 1 < len(starts) and starts[line + 1] <= begin:
                line += 1
            # A token ends with its line: not every editor takes longer ones.
            end = min(finish, starts[line + 1] if line + 1 < len(starts) else finish)
            shown = text[begin:end].rstrip("\r\n")
            column = begin - starts[line] if is_plain else lines.position(begin).character
            units = len(shown) if is_plain else lines.position(begin + len(shown)).character - column
            if units:
                packed += (
                    line - last_line,
                    column - last_column if line == last_line else column,
                    units,
                    type_,
                    modifiers,
                )
                last_line, last_column = line, column
            begin = end
    return packed, last_line, last_column


class TokenMemory:
    """What was last said about each text, so that only what is new is said next time."""

    def __init__(self) -> None:
        self._count = 0
        self._told: dict[str, tuple[str, list[int]]] = {}
        self._known: dict[str, dict[Piece, _Packed]] = {}

    def full(self, view: DocumentContext) -> SemanticTokens:
        """All tokens, under a number of their own."""
        data = self._data(view)
        self._count += 1
        self._told[view.document.uri] = str(self._count), data
        return SemanticTokens(data, str(self._count))

    def _data(self, view: DocumentContext) -> list[int]:
        """The packed tokens of a text; only statements that changed are looked at."""
        before = self._known.get(view.document.uri, {})
        now: dict[Piece, _Packed] = {}
        lines = view.document.lines
        data: list[int] = []
        last_line = last_column = 0
        for piece in view.parse.pieces:
            line, column = lines.place(piece.anchor.offset)
            occurrences = view.snapshot.names.within(piece.anchor)
            packed = before.get(piece)
            if packed is None or packed.column != column or packed.occurrences != occurrences:
                tokens = _pack(lines, _tokens(piece, occurrences), line)
                packed = _Packed(column, occurrences, tokens[0], tokens[1] - line, tokens[2])
            now[piece] = packed
            if packed.data:
                at = len(data)
                data += packed.data
                down = line + packed.data[0] - last_line
                data[at] = down
                if down == 0:
                    data[at + 1] -= last_column
                last_line, last_column = line + packed.last_line, packed.last_column
        self._known[view.document.uri] = now
        return data

    def delta(self, view: DocumentContext, previous: str) -> SemanticTokens | SemanticTokensDelta:
        """The difference from what was said under the number `previous`, or all where that is not known any more."""
        known = self._told.get(view.document.uri)
        full = self.full(view)
        data = self._told[view.document.uri][1]
        if known is None or known[0] != previous:
            return full
        old = known[1]
        shorter = min(len(old), len(data))
        prefix = suffix = 0
        # Whole blocks first, then smaller ones: a text of 1000 lines has 40 000 numbers.
        for size in _BLOCKS:
            while prefix + size <= shorter and old[prefix : prefix + size] == data[prefix : prefix + size]:
                prefix += size
        for size in _BLOCKS:
            while prefix + suffix + size <= shorter and (
                old[len(old) - suffix - size : len(old) - suffix]
                == data[len(data) - suffix - size : len(data) - suffix]
            ):
                suffix += size
        if prefix == len(old) == len(data):
            return SemanticTokensDelta([], full.result_id)
        edit = SemanticTokensEdit(prefix, len(old) - prefix - suffix, data[prefix : len(data) - suffix])
        return SemanticTokensDelta([edit], full.result_id)

    def forget(self, uri: str) -> None:
        """Nothing more is asked about a text."""
        self._told.pop(uri, None)
        self._known.pop(uri, None)
