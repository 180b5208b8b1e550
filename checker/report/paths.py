"""Paths of a vehicle in, figures out as SVG: from above, in three dimensions, as a section through the water."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from itertools import pairwise
from math import cos, radians, sin

import numpy as np

from checker.report.svg import Axis, svg, text
from checker.report.track import Track
from checker.sampling.rendering import number

_WIDTH = 760.0
_MOST_POINTS = 900  # of one path
_SHADES = 6  # of probability
_COLUMNS = 190  # of the section
_AZIMUTH, _ELEVATION = radians(-38.0), radians(32.0)
_RISE = 0.32  # height of the depth axis, as a share of the horizontal extent
_PHASE_COLOURS = 6


@dataclass(frozen=True, slots=True)
class DrawnPath:
    """A path with its caption and its kind, a class of the style sheet: standard, passed, or fault and its number."""

    track: Track
    caption: str
    kind: str


def plan_figure(paths: Sequence[DrawnPath]) -> str:
    """Paths from above, on one scale in both directions; the last one lies on top."""
    points = np.vstack([one.track.positions[:, :2] for one in paths])
    low, high = points.min(axis=0), points.max(axis=0)
    extent = np.maximum(high - low, 1e-6)
    left, right, top = 64.0, _WIDTH - 14.0, 12.0
    scale = min((right - left) / extent[0], 420.0 / extent[1])
    wide, tall = extent * scale
    height = top + tall + 46.0
    east = Axis(low[0], high[0], left, left + wide)
    north = Axis(low[1], high[1], top + tall, top)
    parts = [*_frame(east, north)]
    for one in paths:
        rows = _thinned(one.track)
        line = " ".join(f"{east.at(x):.1f},{north.at(y):.1f}" for x, y in one.track.positions[rows, :2])
        parts.append(
            f'<polyline class="path {one.kind}" points="{line}"><title>{escape(one.caption)}</title></polyline>'
        )
    parts.append(text("name", left + wide / 2.0, height - 6.0, "east (m)"))
    parts.append(text("name", 14.0, top + tall / 2.0, "north (m)", turned=True))
    return svg("paths from above", height, parts)


def space_figure(track: Track) -> str:
    """A path in three dimensions, coloured by the probability of the feature, with a mark where samples were taken."""
    low, high = track.positions.min(axis=0), track.positions.max(axis=0)
    reach = max(float((high - low)[:2].max()), 1e-6)
    stretch = _RISE * reach / max(float(high[2]), 1e-6)

    def flat(points: np.ndarray) -> np.ndarray:
        x, y, z = (points - [(low[0] + high[0]) / 2.0, (low[1] + high[1]) / 2.0, 0.0]).T
        across = x * cos(_AZIMUTH) - y * sin(_AZIMUTH)
        away = x * sin(_AZIMUTH) + y * cos(_AZIMUTH)
        return np.stack([across, -away * sin(_ELEVATION) + z * stretch * cos(_ELEVATION)], axis=1)

    floor = float(high[2])
    box = np.array([[x, y, z] for z in (0.0, floor) for x, y in _corners(low, high)])
    ends = flat(box)
    least, most = ends.min(axis=0), ends.max(axis=0)
    scale = (_WIDTH - 120.0) / max(float(most[0] - least[0]), 1e-6)
    height = float(most[1] - least[1]) * scale + 84.0

    def place(points: np.ndarray) -> np.ndarray:
        return np.asarray((flat(points) - least) * scale + [60.0, 24.0])

    corners = place(box)
    parts = [_polygon("water", corners[:4]), _polygon("floor", corners[4:])]
    parts += [_line("grid", corners[at], corners[at + 4]) for at in range(4)]
    rows = _thinned(track)
    shades = np.minimum((track.probabilities[rows] * _SHADES).astype(int), _SHADES - 1)
    flown = place(track.positions[rows])
    for begin, end in _runs(shades):
        line = " ".join(f"{x:.1f},{y:.1f}" for x, y in flown[begin : end + 1])
        parts.append(f'<polyline class="path p{shades[begin]}" points="{line}"/>')
    for at, tick in enumerate(track.samples, 1):
        spot = track.positions[int(np.abs(track.ticks - tick).argmin())]
        ((x, y),) = place(spot[None, :])
        title = f"S{at}: tick {tick}, depth {number(round(float(spot[2]), 1))} m"
        parts.append(f'<circle class="sample" cx="{x:.1f}" cy="{y:.1f}" r="5"><title>{title}</title></circle>')
        parts.append(text("label", float(x), float(y) - 9.0, f"S{at}"))
    for near, far, caption in (
        (4, 5, f"{_span_text(low[0], high[0])} east"),
        (5, 6, f"{_span_text(low[1], high[1])} north"),
    ):
        middle = (corners[near] + corners[far]) / 2.0
        parts.append(text("tick", float(middle[0]), float(middle[1]) + 16.0, caption))
    caption = f"{number(round(floor, 1))} m deep"
    parts.append(text("tick", float(corners[4][0]), float(corners[4][1]) + 16.0, caption, "start"))
    parts += _legend(height - 14.0) if track.probabilities.any() else ()
    return svg("the path in three dimensions", height, parts)


def section_figure(track: Track, cell: float) -> str:
    """Depth over time in cells of `cell` metres, with the phases below and what was asked for anew.

    Cells of which many share a pixel are drawn as one.
    """
    left, right, top, tall = 64.0, _WIDTH - 14.0, 34.0, 230.0
    begin = float(min(track.ticks[0], track.last_tick - 1))
    time = Axis(begin, float(track.last_tick), left, right)
    deepest = float(track.positions[:, 2].max())
    cell *= max(1, int(deepest / cell / tall))
    cells = max(1, int(np.ceil(deepest / cell - 1e-9)))
    depth = Axis(0.0, cells * cell, top, top + tall)
    parts = [*_cells(track, cell, cells, time, depth), *_frame(time, depth)]
    rows = _thinned(track)
    line = " ".join(
        f"{time.at(tick):.1f},{depth.at(z):.1f}"
        for tick, z in zip(track.ticks[rows], track.positions[rows, 2], strict=True)
    )
    parts.append(f'<polyline class="path thin" points="{line}"/>')
    for at, tick in enumerate(track.samples, 1):
        x, z = time.at(tick), track.positions[int(np.abs(track.ticks - tick).argmin()), 2]
        parts.append(f'<circle class="sample" cx="{x:.1f}" cy="{depth.at(z):.1f}" r="4"><title>S{at}</title></circle>')
        parts.append(text("label", x, depth.at(z) - 7.0, f"S{at}"))
    bottom = top + tall + 34.0
    parts += _phases(track, time, bottom)
    foot = bottom + (34.0 if track.phases else 4.0)
    parts += _targets(track, time, top, bottom + (18.0 if track.phases else -34.0))
    parts.append(text("name", (left + right) / 2.0, foot + 10.0, "tick"))
    parts.append(text("name", 14.0, top + tall / 2.0, "depth (m)", turned=True))
    if track.probabilities.any():
        foot += 26.0
        parts += _legend(foot + 4.0)
    return svg("depth over time, phases and targets", foot + 16.0, parts)


def _cells(track: Track, cell: float, cells: int, time: Axis, depth: Axis) -> Iterator[str]:
    """The cells that were visited, each with the mean probability held there."""
    width = (time.upper - time.lower) / _COLUMNS
    columns = np.clip(((track.ticks - time.lower) / width).astype(int), 0, _COLUMNS - 1)
    rows = np.clip((track.positions[:, 2] / cell - 1e-9).astype(int), 0, cells - 1)  # a cell has its lower end
    numbers = columns * cells + rows
    counts = np.bincount(numbers, minlength=_COLUMNS * cells)
    sums = np.bincount(numbers, weights=track.probabilities, minlength=_COLUMNS * cells)
    tall = depth.at(cell) - depth.at(0.0)
    across = time.at(time.lower + width) - time.at(time.lower)
    for spot in np.flatnonzero(counts):
        column, row = divmod(int(spot), cells)
        shade = min(int(sums[spot] / counts[spot] * _SHADES), _SHADES - 1)
        x, y = time.begin + column * across, depth.at(row * cell)
        yield f'<rect class="cell p{shade}" x="{x:.1f}" y="{y:.1f}" width="{across + 0.1:.1f}" height="{tall:.1f}"/>'


def _phases(track: Track, time: Axis, y: float) -> Iterator[str]:
    colours: dict[str, int] = {}
    for one in track.phases:
        colour = colours.setdefault(one.predicate, len(colours) % _PHASE_COLOURS)
        x, end = time.at(max(one.start, time.lower)), time.at(one.end)
        title = f"<title>{escape(one.predicate)}, {one.start} to {one.end}</title>"
        width = max(end - x - 0.6, 0.8)
        yield f'<rect class="bar b{colour}" x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="15">{title}</rect>'
        if end - x > 7.0 * len(one.predicate) + 6.0:
            yield text("bar", x + 4.0, y + 11.5, one.predicate, "start")


def _targets(track: Track, time: Axis, top: float, foot: float) -> Iterator[str]:
    """What was asked for anew and taken back; of one tick a line with all of it."""
    reached = -_WIDTH  # by the label before
    for tick in dict.fromkeys(tick for tick, _ in track.targets):
        words = ", ".join(dict.fromkeys(word for at, word in track.targets if at == tick))
        x = time.at(max(tick, time.lower))
        anchor = "end" if x > _WIDTH * 0.7 else "start"
        caption = f"{words} at {tick}"
        wide = 6.6 * len(caption)
        rise = 20.0 if (x if anchor == "start" else x - wide) < reached else 6.0
        reached = max(reached, x + wide if anchor == "start" else x)
        yield f'<line class="edge" x1="{x:.1f}" x2="{x:.1f}" y1="{top - rise - 8:.1f}" y2="{foot:.1f}"/>'
        yield text("label", x + (4.0 if anchor == "start" else -4.0), top - rise, caption, anchor)


def _legend(y: float) -> Iterator[str]:
    """The shades of probability."""
    yield text("tick", 64.0, y + 1.0, "p(feature) 0", "start")
    for shade in range(_SHADES):
        yield f'<rect class="cell p{shade}" x="{140 + 22 * shade}" y="{y - 9:.1f}" width="22" height="11"/>'
    yield text("tick", 146.0 + 22.0 * _SHADES, y + 1.0, "1", "start")


def _frame(across: Axis, up: Axis) -> Iterator[str]:
    """Axes with their ticks, and a grid."""
    floor, ceiling = max(up.begin, up.end), min(up.begin, up.end)
    for tick in across.ticks():
        x = across.at(tick)
        yield f'<line class="grid" x1="{x:.1f}" x2="{x:.1f}" y1="{ceiling:.1f}" y2="{floor:.1f}"/>'
        yield text("tick", min(x, _WIDTH - 2.0), floor + 17.0, number(tick), "end" if x > _WIDTH - 24.0 else "middle")
    for tick in up.ticks():
        y = up.at(tick)
        yield f'<line class="grid" x1="{across.begin:.1f}" x2="{across.end:.1f}" y1="{y:.1f}" y2="{y:.1f}"/>'
        yield text("tick", across.begin - 6.0, y + 4.0, number(tick), "end")


def _thinned(track: Track) -> np.ndarray:
    """The rows of a path that are drawn: an even selection, the last one and those with samples among it."""
    every = max(1, -(-len(track.ticks) // _MOST_POINTS))
    return np.unique(np.append(np.arange(0, len(track.ticks), every), len(track.ticks) - 1))


def _runs(shades: np.ndarray) -> Iterator[tuple[int, int]]:
    """The stretches of one shade; each ends where the next begins, so that the line has no gaps."""
    edges = [0, *(np.flatnonzero(np.diff(shades)) + 1), len(shades) - 1]
    for begin, end in pairwise(edges):
        if end > begin:
            yield int(begin), int(end)


def _corners(low: np.ndarray, high: np.ndarray) -> Iterator[tuple[float, float]]:
    yield from ((low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1]))


def _span_text(low: float, high: float) -> str:
    return f"{number(round(float(low)))} to {number(round(float(high)))} m"


def _polygon(kind: str, corners: np.ndarray) -> str:
    return f'<polygon class="{kind}" points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in corners)}"/>'


def _line(kind: str, one: np.ndarray, other: np.ndarray) -> str:
    return f'<line class="{kind}" x1="{one[0]:.1f}" y1="{one[1]:.1f}" x2="{other[0]:.1f}" y2="{other[1]:.1f}"/>'
