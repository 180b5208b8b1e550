"""Draw a plan in characters: a row per object, time from left to right, each token as early as it can be."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from nddlc.levels import Run, level_text

Facts = dict[str, Any]
WIDEST = 160  # columns of the drawing
LEAST = 16
MARGIN = 20  # columns between numbers on the scale
MOST_IDLE = 10  # timelines without tokens that are shown
FAR = 10**9  # a horizon beyond is not drawn to its ends
SEVERAL = "#"


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


@dataclass(frozen=True, slots=True)
class Drawing:
    """What there is to draw, and between which moments; of a resource its level, of other objects their tokens."""

    rows: tuple[str, ...]
    bars: Mapping[str, tuple[Bar, ...]]
    runs: Mapping[str, Run]
    first: int
    last: int

    def __bool__(self) -> bool:
        return any(self.bars.values()) or any(len(run.steps) > 1 for run in self.runs.values())


def drawing(facts: Facts, horizon: tuple[int, int], runs: Mapping[str, Run]) -> Drawing:
    """Rows in the order of the objects: timelines, even idle ones; what else has tokens; resources in use."""
    tokens = [token for token in facts["tokens"] if token["state"] == "ACTIVE"]
    known = [bound for token in tokens for key in ("start", "end") for bound in token[key] if isinstance(bound, int)]
    first = min([*(known or [horizon[0]]), horizon[0]]) if horizon[0] > -FAR else min(known or [0])
    if known and min(known) - horizon[0] > 2 * (max(known) - min(known)):
        first = min(known)  # far from where the horizon begins
    earliest = [token[key][0] for token in tokens for key in ("start", "end") if isinstance(token[key][0], int)]
    last = max([*earliest, first + 1])
    found: dict[str, list[Bar]] = {name: [] for name in facts["order"]}
    for token in tokens:
        bar = _bar(token, first)
        found.setdefault(bar.row, []).append(bar)
    idle = [name for name, own in found.items() if not own]
    if len(idle) > MOST_IDLE:
        found = {name: own for name, own in found.items() if own}
    used = {name: run for name, run in runs.items() if len(run.steps) > 1 or found.get(name)}
    bars = {
        name: tuple(sorted(own, key=lambda bar: (bar.start, bar.end)))
        for name, own in found.items()
        if name not in runs
    }
    others = sorted(name for name in bars if name not in facts["order"])
    return Drawing((*(name for name in facts["order"] if name in bars), *others, *used), bars, used, first, last)


def _bar(token: Facts, first: int) -> Bar:
    start = token["start"][0] if isinstance(token["start"][0], int) else first
    end = token["end"][0] if isinstance(token["end"][0], int) else start
    is_open = token["end"][1] == "+inf"
    is_fixed = token["start"][0] == token["start"][1] and token["end"][0] == token["end"][1]
    row = token["object"].rpartition("}")[0].lstrip("{") or token["object"]
    parameters = ", ".join(f"{name}={short(text)}" for name, text in token["params"].items())
    tip = f"{token['id']}: {token['predicate']}({parameters}) start {span(token['start'])} end {span(token['end'])}"
    return Bar(row, token["id"], token["predicate"].rpartition(".")[2], start, end, is_open, is_fixed, tip)


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


def chart(drawn: Drawing, width: int) -> Iterator[str]:
    """The lines of the drawing, none of them longer than `width` where that is at all possible."""
    if not drawn:
        return
    first, last = drawn.first, drawn.last
    margin = min(max(len(row) for row in drawn.rows), 30, max(width // 3, 4)) + 2
    columns = max(min(width - margin, WIDEST), LEAST)
    scale = min((columns - 1) / (last - first), 4.0)
    columns = min(columns, int((last - first) * scale) + 2)
    signs: set[str] = set()
    for row in drawn.rows:
        if row in drawn.runs:
            lines = [_level_line(drawn.runs[row], columns, first, scale)]
        else:
            lines = [_lane_line(lane, columns, first, scale) for lane in lanes(drawn.bars[row])] or [""]
        for number, line in enumerate(lines):
            head = shortened(row, margin - 2) if number == 0 else ""
            signs.update(line)
            yield f"{head:<{margin}}{line}".rstrip()
    yield " " * margin + "".join(ruler(first, last, scale, columns)).rstrip()
    yield from _legend(drawn, signs, width)


def _legend(drawn: Drawing, signs: set[str], width: int) -> Iterator[str]:
    """What needs to be said of what is drawn."""
    said = []
    if not all(bar.is_fixed for own in drawn.bars.values() for bar in own):
        said.append("each token as early as it can be")
    if ">" in signs:
        said.append("`>` may last longer")
    if drawn.runs:
        said.append("`-` level of a resource")
    if SEVERAL in signs:
        said.append(f"`{SEVERAL}` several tokens")
    line = ""
    for each in said:
        if line and len(line) + len(each) + 2 > width:
            yield f"{line};"
            line = each
        else:
            line = f"{line}; {each}" if line else each
    if line:
        yield line


def _lane_line(lane: list[Bar], columns: int, first: int, scale: float) -> str:
    line = [" "] * columns
    begun: set[int] = set()
    for bar in lane:
        start = int((bar.start - first) * scale)
        _draw(line, start, int((bar.end - first) * scale), bar.predicate, "=")
        if start in begun:
            line[start] = SEVERAL
        begun.add(start)
        if bar.is_open and (stop := max(int((bar.end - first) * scale), start + 1)) < len(line):
            line[stop] = ">"
    return "".join(line)


def _level_line(run: Run, columns: int, first: int, scale: float) -> str:
    line = [" "] * columns
    ends = [int((step[0] - first) * scale) for step in run.steps[1:]]
    for (at, low, high), end in zip(run.steps, [*ends, columns], strict=True):
        _draw(line, max(int((at - first) * scale), 0), end, level_text(low, high), "-", is_whole=True)
    return "".join(line)


def _draw(line: list[str], start: int, end: int, name: str, fill: str, *, is_whole: bool = False) -> None:
    """Put one bar into a line, with as much of its name as there is room for; or all or nothing of it."""
    stop = min(max(end, start + 1), len(line))
    room = stop - start - 1
    text = "|" + ("" if is_whole and len(name) > room else name[:room]).ljust(room, fill)
    line[start:stop] = text[: stop - start]


def ruler(first: int, last: int, scale: float, columns: int) -> list[str]:
    """Numbers under the drawing."""
    line = [" "] * (columns + 2)
    step = max(1, round(max(MARGIN, len(str(last)) + 2) / scale))
    magnitude = 10 ** (len(str(step)) - 1)
    step = -(-step // magnitude) * magnitude
    moment = -(-first // step) * step
    while moment <= last:
        at = int((moment - first) * scale)
        text = str(moment)
        if at + len(text) <= len(line):
            line[at : at + len(text)] = text
        moment += step
    return line


def short(domain: str) -> str:
    """A domain without its type, and a single value without braces."""
    text = domain.rsplit(" ", 2)[0] if domain.endswith(" open") else domain.rpartition(" ")[0]
    is_single = text.startswith("{") and "," not in text
    return text[1:-1] if is_single else text


def shortened(text: str, width: int) -> str:
    """A text that is no longer than `width`; what is missing is in the middle, since names differ at their ends."""
    if len(text) <= width:
        return text
    behind = (width - 1) // 2
    return f"{text[: width - 1 - behind]}…{text[len(text) - behind :]}"


def span(pair: Sequence[object]) -> str:
    """A time: one number, or two bounds."""
    lower, upper = pair
    return str(lower) if lower == upper else f"[{lower}, {upper}]"
