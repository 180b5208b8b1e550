"""Gantt chart in characters: a row per object, time from left to right, each token with the range of its times."""

from collections.abc import Iterator

from runtime.plan.readout.level_profile import LevelProfile
from runtime.view.axis import whole_ticks
from runtime.view.drawing import Bar, Drawing, lanes, level_text
from runtime.view.table import shortened

_WIDEST = 160  # columns of the drawing
_LEAST = 16
_MARGIN = 20  # columns between numbers on the scale
_SEVERAL = "#"
_MAYBE = "."


def chart(drawn: Drawing, width: int) -> Iterator[str]:
    """The lines of the drawing, none of them longer than `width` where that is at all possible."""
    if not drawn:
        return
    first, last = drawn.first, drawn.last
    margin = min(max(len(row) for row in drawn.rows), 30, max(width // 3, 4)) + 2
    columns = max(min(width - margin, _WIDEST), _LEAST)
    scale = min((columns - 1) / (last - first), 4.0)
    columns = min(columns, int((last - first) * scale) + 2)
    signs: set[str] = set()
    for row in drawn.rows:
        if row in drawn.profiles:
            lines = [_level_line(drawn.profiles[row], columns, first, scale)]
        else:
            lines = [_lane_line(lane, columns, first, scale) for lane in lanes(drawn.bars[row])] or [""]
        for number, line in enumerate(lines):
            head = shortened(row, margin - 2) if number == 0 else ""
            signs.update(line)
            yield f"{head:<{margin}}{line}".rstrip()
    yield " " * margin + _ruler(first, last, scale, columns)
    yield from _legend(drawn, signs, width)


def _legend(drawn: Drawing, signs: set[str], width: int) -> Iterator[str]:
    """What needs to be said of what is drawn."""
    said = []
    if not all(bar.is_fixed for own in drawn.bars.values() for bar in own):
        said.append("each token as early as it can be")
    if _MAYBE in signs:
        said.append(f"`{_MAYBE}` where it may be later")
    if ">" in signs:
        said.append("`>` may last longer")
    if drawn.profiles:
        said.append("`-` level of a resource")
    if _SEVERAL in signs:
        said.append(f"`{_SEVERAL}` several tokens")
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
        earliest, latest = (int((moment - first) * scale) for moment in (min(bar.sure[1], bar.end), bar.end))
        _draw(line, start, latest, bar.predicate, _MAYBE)
        for at in range(start, min(earliest, latest, len(line))):
            line[at] = "=" if line[at] == _MAYBE else line[at]
        if start in begun:
            line[start] = _SEVERAL
        begun.add(start)
        if bar.is_open and (stop := max(int((bar.end - first) * scale), start + 1)) < len(line):
            line[stop] = ">"
    return "".join(line)


def _level_line(profile: LevelProfile, columns: int, first: int, scale: float) -> str:
    line = [" "] * columns
    ends = [int((step[0] - first) * scale) for step in profile.steps[1:]]
    for (at, low, high), end in zip(profile.steps, [*ends, columns], strict=True):
        _draw(line, max(int((at - first) * scale), 0), end, level_text(low, high), "-", is_whole=True)
    return "".join(line)


def _draw(line: list[str], start: int, end: int, name: str, fill: str, *, is_whole: bool = False) -> None:
    """Put one bar into a line, with as much of its name as there is room for; or all or nothing of it."""
    stop = min(max(end, start + 1), len(line))
    room = stop - start - 1
    text = "|" + ("" if is_whole and len(name) > room else name[:room]).ljust(room, fill)
    line[start:stop] = text[: stop - start]


def _ruler(first: int, last: int, scale: float, columns: int) -> str:
    """Numbers under the drawing."""
    line = [" "] * (columns + 2)
    for moment in whole_ticks(first, last, max(_MARGIN, len(str(last)) + 2) / scale):
        at = int((moment - first) * scale)
        text = str(moment)
        if at + len(text) <= len(line):
            line[at : at + len(text)] = text
    return "".join(line).rstrip()
