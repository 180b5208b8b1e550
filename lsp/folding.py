"""Folding and selection ranges: a text in; the stretches that belong together out."""

from bisect import bisect_right
from collections.abc import Iterator, Sequence

from lsprotocol.types import FoldingRange, FoldingRangeKind, Position, SelectionRange

from lsp.meaning import around_at, piece_at
from lsp.positions import Lines
from nddl_lang.syntax.nodes import Include
from nddl_lang.syntax.parser import Parse

_OPENING = {"{": "}", "(": ")"}
_REGION, _REGION_END = "#region", "#endregion"


def folding_ranges(parse: Parse, lines: Lines) -> list[FoldingRange]:
    """Blocks in braces and parentheses, comments, runs of includes, and regions that comments mark."""
    found: dict[tuple[int, int], FoldingRange] = {}
    for begin, finish, kind in (*_blocks(parse), *_comments(parse, lines), *_includes(parse)):
        start, end = lines.position(begin).line, lines.position(finish).line
        if kind is None:
            end -= 1  # the closing brace stays in sight
        if end > start:
            found.setdefault((start, end), FoldingRange(start, end, kind=kind))
    return [found[place] for place in sorted(found)]


_Stretch = tuple[int, int, FoldingRangeKind | None]


def _blocks(parse: Parse) -> Iterator[_Stretch]:
    for piece in parse.pieces:
        base = piece.anchor.offset
        pending: list[tuple[str, int]] = []
        for text, start in zip(piece.texts, piece.starts, strict=True):
            if text in _OPENING:
                pending.append((_OPENING[text], start))
            elif pending and text == pending[-1][0]:
                yield pending.pop()[1] + base, start + base, None


def _comments(parse: Parse, lines: Lines) -> Iterator[_Stretch]:
    """Comments of several lines, those that follow each other line by line together, and marked regions."""
    text = parse.source.text
    run: tuple[int, int] | None = None
    regions: list[int] = []
    for piece in parse.pieces:
        for start, end in piece.comments:
            begin, finish = start + piece.anchor.offset, end + piece.anchor.offset
            words = text[begin:finish].lstrip("/* \t")
            if words.startswith(_REGION_END) and regions:
                yield regions.pop(), finish, FoldingRangeKind.Region
            elif words.startswith(_REGION):
                regions.append(begin)
            if run is not None and text[run[1] : begin].isspace() and text.count("\n", run[1], begin) == 1:
                run = run[0], finish
                continue
            if run is not None:
                yield (*run, FoldingRangeKind.Comment)
            is_alone = not text[lines.starts[lines.position(begin).line] : begin].strip()
            run = (begin, finish) if is_alone else None
    if run is not None:
        yield (*run, FoldingRangeKind.Comment)


def _includes(parse: Parse) -> Iterator[_Stretch]:
    run: list[int] = []
    for statement in parse.module.statements:
        if isinstance(statement, Include):
            run = [run[0] if run else statement.span.begin, statement.span.finish]
        else:
            if run:
                yield run[0], run[1], FoldingRangeKind.Imports
            run = []
    if run:
        yield run[0], run[1], FoldingRangeKind.Imports


def selection_ranges(parse: Parse, lines: Lines, positions: Sequence[Position]) -> list[SelectionRange]:
    """For each place what to select next, and next after that: word, node, statement, block, text."""
    return [_selection(parse, lines, lines.offset(position)) for position in positions]


def _selection(parse: Parse, lines: Lines, offset: int) -> SelectionRange:
    whole = SelectionRange(lines.range(0, len(lines.text)))
    piece = piece_at(parse, offset)
    if piece is None:
        return whole
    stretches = [(0, len(lines.text))]
    stretches += [(node.span.begin, node.span.finish) for node in reversed(around_at(piece, offset))]
    at = offset - piece.anchor.offset
    index = bisect_right(piece.starts, at) - 1
    if index >= 0 and at <= piece.ends[index]:
        stretches.append((piece.starts[index] + piece.anchor.offset, piece.ends[index] + piece.anchor.offset))
    for begin, finish in sorted(
        (
            (begin + 1, finish)
            for begin, finish, kind in _blocks_of(parse, piece.anchor.offset)
            if kind is None and begin < offset <= finish
        ),
        key=lambda each: each[0] - each[1],
    ):
        stretches.append((begin, finish))
    stretches.sort(key=lambda each: each[0] - each[1])
    chain = whole
    last = stretches[0]
    for begin, finish in stretches[1:]:
        if (begin, finish) != last and last[0] <= begin <= offset <= finish <= last[1]:
            chain = SelectionRange(lines.range(begin, finish), chain)
            last = begin, finish
    return chain


def _blocks_of(parse: Parse, anchor: int) -> Iterator[_Stretch]:
    end = next((piece.anchor.offset for piece in parse.pieces if piece.anchor.offset > anchor), len(parse.source.text))
    yield from (each for each in _blocks(parse) if anchor <= each[0] < end)
