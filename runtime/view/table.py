"""Tables of text: rows in, lines of aligned columns out, no wider than the terminal."""

from collections.abc import Iterable, Iterator

_LEAST = 6  # characters of a cell that are shown in any case


def table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]], room: int | None = None) -> Iterator[str]:
    """Rows under a head, in columns as wide as they need to be, or as `room` lets them be: the widest give way."""
    lines = [head, *rows]
    widths = [max(len(line[column]) for line in lines) for column in range(len(head))]
    least = [min(width, _LEAST) for width in widths]
    while room is not None and sum(widths) + 2 * (len(head) - 1) > room and widths != least:
        widest = max(range(len(head)), key=lambda column: widths[column] - least[column])
        widths[widest] -= 1
    for number, line in enumerate(lines):
        cells = (shortened(cell, width).ljust(width) for cell, width in zip(line, widths, strict=True))
        yield "  ".join(cells).rstrip()
        if number == 0:
            yield "  ".join("-" * width for width in widths)


def shortened(text: str, width: int) -> str:
    """A text that is no longer than `width`; what is missing is in the middle, since names differ at their ends."""
    if len(text) <= width:
        return text
    behind = (width - 1) // 2
    return f"{text[: width - 1 - behind]}…{text[len(text) - behind :]}"
