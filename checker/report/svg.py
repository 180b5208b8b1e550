"""Draws of passing and failing missions in, small pictures out, as SVG that takes its colours from the page."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape

from checker.conditions.condition import Literal
from checker.conditions.rendering import literal_text
from checker.rate import Rate
from checker.sampling.rendering import number
from runtime.view.axis import ticks

_WIDTH, _MARGIN = 760.0, 14.0
_GOLDEN = 0.6180339887498949  # multiples of it spread evenly, so that dots of near values do not hide each other
_MOST_DOTS = 1500
Box = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Dot:
    """A mission in a picture: its value, and the number of its fault (None: it passed)."""

    mission: int
    value: float
    fault: int | None


@dataclass(frozen=True, slots=True)
class Axis:
    """A stretch of numbers on a stretch of the picture."""

    lower: float
    upper: float
    begin: float
    end: float

    def at(self, value: float) -> float:
        """Where `value` stands."""
        width = self.upper - self.lower or 1.0
        return self.begin + (value - self.lower) / width * (self.end - self.begin)

    def ticks(self) -> list[float]:
        """Round numbers along the axis, about six."""
        return ticks(self.lower, self.upper, (self.upper - self.lower or 1.0) / 6.0)


def strip_plot(name: str, dots: Sequence[Dot], box: Box, edges: Sequence[Literal]) -> str:
    """One parameter along a line: missions as dots, failing ones coloured by fault, edges as dashed lines."""
    height, floor = 108.0, 76.0
    axis = _axis([dot.value for dot in dots], box)
    parts = [*_horizontal(axis, floor)]
    for literal in edges:
        x = axis.at(literal.edge)
        far = axis.end if literal.is_above else axis.begin
        left, width = min(x, far), abs(far - x)
        parts.append(f'<rect class="beyond" x="{left:.1f}" y="8" width="{width:.1f}" height="{floor - 8:.1f}"/>')
        parts.append(f'<line class="edge" x1="{x:.1f}" x2="{x:.1f}" y1="4" y2="{floor:.1f}"/>')
        anchor, shift = ("end", -5.0) if x > _WIDTH / 2 else ("start", 5.0)
        parts.append(text("label", x + shift, 15.0, literal_text(literal), anchor))
    for dot in _drawn(dots):
        y = 22.0 + (dot.mission * _GOLDEN) % 1.0 * (floor - 30.0)
        parts.append(_circle(dot, axis.at(dot.value), y, number(dot.value)))
    return svg(f"values of {name}", height, parts)


def scatter_plot(names: tuple[str, str], across: Sequence[Dot], up: Sequence[Dot], boxes: tuple[Box, Box]) -> str:
    """Two parameters against each other, one dot per mission that drew both."""
    height = 330.0
    axis = _axis([dot.value for dot in across], boxes[0], begin=58.0)
    flat = _axis([dot.value for dot in up], boxes[1])
    rise = Axis(flat.lower, flat.upper, height - 46.0, 12.0)
    parts = [*_horizontal(axis, height - 46.0)]
    for tick in rise.ticks():
        y = rise.at(tick)
        parts.append(f'<line class="grid" x1="{axis.begin:.1f}" x2="{axis.end:.1f}" y1="{y:.1f}" y2="{y:.1f}"/>')
        parts.append(text("tick", axis.begin - 6.0, y + 4.0, number(tick), "end"))
    values = {dot.mission: dot.value for dot in up}
    for dot in _drawn([dot for dot in across if dot.mission in values]):
        label = f"{number(dot.value)}, {number(values[dot.mission])}"
        parts.append(_circle(dot, axis.at(dot.value), rise.at(values[dot.mission]), label))
    parts.append(text("name", (axis.begin + axis.end) / 2.0, height - 6.0, names[0]))
    parts.append(text("name", 14.0, height / 2.0, names[1], turned=True))
    return svg(f"{names[0]} against {names[1]}", height, parts)


def rate_plot(rate: Rate) -> str:
    """The observed rate with its exact interval, and the limit."""
    interval = rate.interval or (rate.observed, rate.observed)
    top = max(interval[1], rate.limit) * 1.15 or 1.0
    axis = Axis(0.0, min(top, 1.0) * 100.0, _MARGIN, _WIDTH - _MARGIN)
    lower, upper, seen, limit = (axis.at(100.0 * share) for share in (*interval, rate.observed, rate.limit))
    word = "bad" if rate.exceeds else "good"
    anchor, shift = ("end", -5.0) if limit > _WIDTH / 2 else ("start", 5.0)
    parts = [
        *_horizontal(axis, 44.0, " %"),
        f'<line class="interval {word}" x1="{lower:.1f}" x2="{upper:.1f}" y1="28" y2="28"/>',
        f'<circle class="seen {word}" cx="{seen:.1f}" cy="28" r="6"/>',
        f'<line class="edge" x1="{limit:.1f}" x2="{limit:.1f}" y1="4" y2="44"/>',
        text("label", limit + shift, 13.0, "accepted", anchor),
    ]
    return svg("failure rate with its interval", 70.0, parts)


def _axis(values: Sequence[float], box: Box, begin: float = _MARGIN) -> Axis:
    lower, upper = min([box[0], *values]), max([box[1], *values])
    pad = (upper - lower) * 0.02 or 0.5
    return Axis(lower - pad, upper + pad, begin, _WIDTH - _MARGIN)


def _horizontal(axis: Axis, floor: float, unit: str = "") -> Iterator[str]:
    yield f'<line class="axis" x1="{axis.begin:.1f}" x2="{axis.end:.1f}" y1="{floor:.1f}" y2="{floor:.1f}"/>'
    for tick in axis.ticks():
        x = axis.at(tick)
        yield f'<line class="axis" x1="{x:.1f}" x2="{x:.1f}" y1="{floor:.1f}" y2="{floor + 4:.1f}"/>'
        anchor = "end" if x > _WIDTH - 24.0 else "start" if x < 16.0 else "middle"
        yield text("tick", min(x, _WIDTH - 2.0), floor + 18.0, f"{number(tick)}{unit}", anchor)


def _drawn(dots: Sequence[Dot]) -> list[Dot]:
    """The dots to draw, failing ones last and all of them; of very many passing ones an even selection."""
    passing = [dot for dot in dots if dot.fault is None]
    every = max(1, -(-len(passing) // _MOST_DOTS))
    return [*passing[::every], *(dot for dot in dots if dot.fault is not None)]


def _circle(dot: Dot, x: float, y: float, value: str) -> str:
    kind = "pass" if dot.fault is None else f"fault f{dot.fault % 6}"
    radius = 2.6 if dot.fault is None else 4.2
    title = f"<title>mission {dot.mission}: {value}</title>"
    return f'<circle class="dot {kind}" cx="{x:.1f}" cy="{y:.1f}" r="{radius}">{title}</circle>'


def text(kind: str, x: float, y: float, words: str, anchor: str = "middle", *, turned: bool = False) -> str:
    """Words at a point, in a class of the style sheet; turned, they are read from below."""
    turn = f' transform="rotate(-90 {x:.1f} {y:.1f})"' if turned else ""
    return f'<text class="{kind}" x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{turn}>{escape(words)}</text>'


def svg(caption: str, height: float, parts: Sequence[str]) -> str:
    """A picture of the usual width, of its parts."""
    head = f'<svg viewBox="0 0 {_WIDTH:.0f} {height:.0f}" role="img" aria-label="{escape(caption)}">'
    return "\n".join([head, *parts, "</svg>"])
