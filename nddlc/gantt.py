"""Draw a plan in characters: a row per object, time from left to right, each token as early as it can be."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

Facts = dict[str, Any]
WIDEST = 100  # columns of the drawing
MARGIN = 20  # columns between numbers on the scale


@dataclass(frozen=True, slots=True)
class Bar:
    """A token as it is drawn: from its earliest start to its earliest end, and whether these may move."""

    row: str
    label: str
    predicate: str
    start: int
    end: int
    is_open: bool  # it may last beyond the last moment that anything is drawn at
    is_fixed: bool
    tip: str


def bars(facts: Facts, horizon: tuple[int, int]) -> tuple[list[str], list[Bar], int, int]:
    """Rows in the order of the objects, the bars on them, and the first and last moment to draw."""
    tokens = [token for token in facts["tokens"] if token["state"] == "ACTIVE"]
    known = [bound for token in tokens for key in ("start", "end") for bound in token[key] if isinstance(bound, int)]
    first = min([*(known or [horizon[0]]), horizon[0]]) if horizon[0] > -(10**9) else min(known or [0])
    earliest = [token["end"][0] for token in tokens if isinstance(token["end"][0], int)]
    last = max([*earliest, *(token["start"][0] for token in tokens if isinstance(token["start"][0], int)), first + 1])
    found = []
    for token in tokens:
        start = token["start"][0] if isinstance(token["start"][0], int) else first
        end = token["end"][0] if isinstance(token["end"][0], int) else start
        is_open = token["end"][1] == "+inf"
        is_fixed = token["start"][0] == token["start"][1] and token["end"][0] == token["end"][1]
        row = token["object"].rpartition("}")[0].lstrip("{") or token["object"]
        parameters = ", ".join(f"{name}={short(text)}" for name, text in token["params"].items())
        tip = f"{token['id']}: {token['predicate']}({parameters}) start {span(token['start'])} end {span(token['end'])}"
        found.append(Bar(row, token["id"], token["predicate"].rpartition(".")[2], start, end, is_open, is_fixed, tip))
    found.sort(key=lambda bar: (bar.start, bar.end))
    listed = [row for row in facts["order"] if any(bar.row == row for bar in found)]
    rows = list(dict.fromkeys([*listed, *sorted({bar.row for bar in found})]))
    return rows, found, first, last


def lanes(own: Sequence[Bar]) -> list[list[Bar]]:
    """Bars of one row that overlap, one below the other."""
    found: list[list[Bar]] = []
    for bar in own:
        for lane in found:
            if lane[-1].end <= bar.start and lane[-1].start < bar.start:
                lane.append(bar)
                break
        else:
            found.append([bar])
    return found


def chart(facts: Facts, horizon: tuple[int, int], width: int) -> Iterator[str]:
    """The lines of the drawing; `=` a token, `>` one that may last longer, `|` where one begins."""
    rows, found, first, last = bars(facts, horizon)
    if not found:
        return
    margin = min(max(len(row) for row in rows), 30) + 2
    columns = max(min(width - margin, WIDEST), 20)
    scale = min((columns - 1) / (last - first), 4.0)
    columns = min(columns, int((last - first) * scale) + 2)
    for row in rows:
        for number, lane in enumerate(lanes([bar for bar in found if bar.row == row])):
            line = [" "] * columns
            for bar in lane:
                draw(line, bar, int((bar.start - first) * scale), int((bar.end - first) * scale))
            head = row if number == 0 else ""
            yield f"{head[: margin - 2]:<{margin}}{''.join(line)}".rstrip()
    yield " " * margin + "".join(ruler(first, last, scale, columns)).rstrip()


def draw(line: list[str], bar: Bar, start: int, end: int) -> None:
    """Put one bar into a line, with as much of its name as there is room for."""
    stop = min(max(end, start + 1), len(line))
    text = "|" + (bar.predicate + "=" * len(line))[: stop - start - 1]
    for offset, sign in enumerate(text[: stop - start]):
        line[start + offset] = sign
    if bar.is_open and stop < len(line):
        line[stop] = ">"


def ruler(first: int, last: int, scale: float, columns: int) -> list[str]:
    """Numbers under the drawing."""
    line = [" "] * (columns + 12)
    step = max(1, round(MARGIN / scale))
    magnitude = 10 ** (len(str(step)) - 1)
    step = -(-step // magnitude) * magnitude
    moment = -(-first // step) * step
    while moment <= last:
        at = int((moment - first) * scale)
        for offset, sign in enumerate(str(moment)):
            if at + offset < len(line):
                line[at + offset] = sign
        moment += step
    return line


def short(domain: str) -> str:
    """A domain without its type, and a single value without braces."""
    text = domain.rsplit(" ", 2)[0] if domain.endswith(" open") else domain.rpartition(" ")[0]
    is_single = text.startswith("{") and "," not in text
    return text[1:-1] if is_single else text


def span(pair: Sequence[object]) -> str:
    """A time: one number, or two bounds."""
    lower, upper = pair
    return str(lower) if lower == upper else f"[{lower}, {upper}]"
