"""Show a stretch of text with its line numbers and carets under it."""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from unicodedata import category, east_asian_width

from nddl_lang.text.source import Source, Span

_TAB = 4
# A line longer than this is shown around the stretch only.
_LONGEST = 140
# And of a line no more is looked at than three such stretches.
_ENORMOUS = 10_000
# A stretch of more lines than this is shown by its first and last ones.
_MOST_LINES = 6
_EDGE = 2


def _width(letter: str) -> int:
    """How many columns of a terminal `letter` takes."""
    if letter.isascii():
        return 1
    if category(letter) in ("Mn", "Me", "Cf"):
        return 0
    return 2 if east_asian_width(letter) in ("W", "F") else 1


def _shown(line: str) -> tuple[str, Sequence[int]]:
    """`line` as it can be printed, and the column at which each character, and the end, stands."""
    if line.isascii() and line.isprintable():
        return line, range(len(line) + 1)
    letters: list[str] = []
    columns: list[int] = []
    column = 0
    for letter in line:
        columns.append(column)
        if letter == "\t":
            advance = _TAB - column % _TAB
            letters.append(" " * advance)
        elif letter.isprintable() or _width(letter) == 0:
            advance = _width(letter)
            letters.append(letter if letter.isprintable() else "")
        else:
            advance = 1
            letters.append("\N{REPLACEMENT CHARACTER}")
        column += advance
    columns.append(column)
    return "".join(letters), columns


@lru_cache(maxsize=8)  # many findings may stand in one long line
def _shown_line(source: Source, number: int, skipped: int = 0) -> tuple[str, Sequence[int]]:
    """A stretch of a line of a source as it can be printed, and the column of each of its characters."""
    start = source.line_starts[number - 1] + skipped
    end = source.line_end(number)
    return _shown(source.text[start : min(end, start + 3 * _ENORMOUS)].removesuffix("\r"))


def _bounds(span: Span) -> tuple[tuple[int, int], tuple[int, int]]:
    """Line and column where `span` begins and where it ends, the end not included but in the line of the last one."""
    source = span.source
    first = source.locate(span.begin)
    if span.finish <= span.begin:
        return first, first
    line, column = source.locate(span.finish - 1)
    return first, (line, column + 1)


def excerpt(span: Span, mark: str = "^") -> Iterator[tuple[int | None, str, str]]:
    """The lines that show `span`: a number or None, the text, and the carets under it (empty: none)."""
    (first, start), (last, end) = _bounds(span)
    if first == last:
        yield _single(span.source, first, start, end, mark)
        return
    numbers = list(range(first, last + 1))
    if len(numbers) > _MOST_LINES:
        numbers = [*numbers[:_EDGE], 0, *numbers[-_EDGE:]]
    for number in numbers:
        if number == 0:
            yield None, "...", ""
            continue
        text, columns = _shown_line(span.source, number)
        if number == first:
            left = min(_LONGEST, columns[min(start - 1, len(columns) - 1)])
            yield number, "  " + _cropped(text), " " + "_" * (left + 1) + mark
        elif number == last:
            right = min(_LONGEST, columns[min(end - 1, len(columns) - 1)])
            yield number, "| " + _cropped(text), "|" + "_" * max(1, right) + mark
        else:
            yield number, "| " + _cropped(text), ""


def _single(source: Source, number: int, start: int, end: int, mark: str) -> tuple[int, str, str]:
    skipped = max(0, (start - 1) // _ENORMOUS - 1) * _ENORMOUS
    text, columns = _shown_line(source, number, skipped)
    start, end = start - skipped, end - skipped
    left = columns[min(start - 1, len(columns) - 1)]
    right = columns[min(end - 1, len(columns) - 1)]
    size = max(1, right - left)
    if len(text) > _LONGEST:
        cut = max(0, left - _LONGEST // 2)
        text = ("..." if cut else "") + text[cut : cut + _LONGEST] + ("..." if cut + _LONGEST < len(text) else "")
        left += (3 if cut else 0) - cut
        size = max(1, min(size, len(text) - left))
    return number, text, " " * left + mark * size


def around(line: str, at: int) -> str:
    """`line` as it can be printed; of a long one the stretch around the character `at`."""
    if len(line) <= _LONGEST:
        return _shown(line)[0]
    cut = max(0, at - _LONGEST // 2)
    rest = "..." if cut + _LONGEST < len(line) else ""
    return f"{'...' if cut else ''}{_shown(line[cut : cut + _LONGEST])[0]}{rest}"


def _cropped(text: str) -> str:
    return text if len(text) <= _LONGEST else text[:_LONGEST] + "..."
