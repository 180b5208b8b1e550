"""SVG picture of a plan, and HTML page that holds it: no scripts, nothing from outside."""

from collections.abc import Callable, Iterator, Sequence
from html import escape
from math import inf

from runtime.plan.readout.level_profile import LevelProfile
from runtime.view.axis import whole_ticks
from runtime.view.drawing import Bar, Drawing, lanes, level_text
from runtime.view.plan_text import HEAD as COLUMNS
from runtime.view.plan_text import VARIABLES, PlanReport, token_cells
from runtime.view.table import shortened

_NARROW, _WIDE = 900, 12000  # pixels for the time that is drawn
_ROOMY = 60  # pixels that a token is given where that is possible
_LINE = 26
_TALL = 56  # the height of a level's row
_HEAD = 30
_NAMED = 32  # pixels in which a name can be read
_LETTER = 7  # pixels, as wide as most are
_MOST_TICKS = 12  # where the picture is narrow
_LONGEST = 32  # letters of an object's name
_PALETTE = ("#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377", "#997700", "#555555")
_LIGHT = {"#ee6677", "#ccbb44", "#66ccee"}  # dark letters are read better on these
_STYLE = (
    "text{font:12px sans-serif;fill:#222}.t{font-size:11px}.w{fill:#fff}.a{stroke:#ccc}.r{stroke:#eee}"
    ".m{stroke:#222}.l{fill:#4477aa;fill-opacity:.25;stroke:#4477aa}.s{font-size:10px}"
    ".b{stroke:#cc3311;stroke-dasharray:5 3}"
    "@media(prefers-color-scheme:dark){text{fill:#ddd}.k{fill:#222}.a{stroke:#444}.r{stroke:#333}.m{stroke:#ddd}}"
)
_LOOK = (
    ":root{color-scheme:light dark}body{font:14px sans-serif;margin:2em}.p{overflow-x:auto}"
    "pre{white-space:pre-wrap;overflow-wrap:anywhere}"
    "table{border-collapse:collapse;margin-top:1em}"
    "td,th{padding:2px 10px;text-align:left;white-space:nowrap;border-bottom:1px solid #8884;max-width:40em;"
    "overflow:hidden;text-overflow:ellipsis}p{color:#777}"
)


def svg(drawn: Drawing) -> str:
    """The plan as one SVG element; where a token may hold, but need not, its bar is pale, with a dashed outline."""
    margin = 20 + _LETTER * max([min(len(row), _LONGEST) for row in drawn.rows], default=0)
    most = max([len(own) for own in drawn.bars.values()], default=0)
    width = min(max(_NARROW, _ROOMY * most), _WIDE)
    scale = width / (drawn.last - drawn.first)
    names = dict.fromkeys(bar.predicate for row in drawn.rows for bar in drawn.bars.get(row, ()))
    colours = {name: _PALETTE[n % len(_PALETTE)] for n, name in enumerate(names)}
    body: list[str] = []
    y = _HEAD
    for row in drawn.rows:
        caption = f"<title>{escape(row)}</title>" if len(row) > _LONGEST else ""
        body.append(f'<text x="4" y="{y + 17}">{escape(shortened(row, _LONGEST))}{caption}</text>')
        if row in drawn.profiles:
            body += _level(row, drawn.profiles[row], drawn, margin, y, scale)
            y += _TALL
        else:
            own = lanes(drawn.bars[row])
            for lane in own:
                for bar in lane:
                    body += _bar(bar, lambda moment: margin + (moment - drawn.first) * scale, y, colours)
                y += _LINE
            y += 0 if own else _LINE
        body.append(f'<line class="r" x1="0" y1="{y}" x2="{margin + width + 20}" y2="{y}"/>')
    axis: list[str] = []
    apart = (drawn.last - drawn.first) * _NARROW / width * max(1.0, len(str(drawn.last)) / 7) / _MOST_TICKS
    for moment in whole_ticks(drawn.first, drawn.last, apart):
        x = margin + (moment - drawn.first) * scale
        axis.append(f'<line class="a" x1="{x:.1f}" y1="{_HEAD - 8}" x2="{x:.1f}" y2="{y}"/>')
        axis.append(f'<text x="{x:.1f}" y="{_HEAD - 12}" text-anchor="middle">{moment}</text>')
    size = f'width="{margin + width + 30}" height="{y + 10}"'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} role="img" aria-label="plan">'
        f"<style>{_STYLE}</style>{''.join(axis)}{''.join(body)}</svg>\n"
    )


def _bar(bar: Bar, across: Callable[[int], float], y: int, colours: dict[str, str]) -> Iterator[str]:
    """One token: full where it holds in any case, paler where it does if it is early, palest where it may.

    For the pointer all that is known of it.
    """
    x, colour = across(bar.start), colours[bar.predicate]
    wide = max(across(bar.end) - x, 3.0)
    begin, end = max(across(bar.sure[0]), x), min(max(across(bar.sure[1]), x + 3.0), x + wide)
    is_full = bar.is_fixed or bar.is_early
    shape = f'y="{y + 3}" height="{_LINE - 6}" rx="3" fill="{colour}"'
    yield f"<g><title>{escape(bar.tip)}</title>"
    if is_full:
        yield f'<rect x="{x:.1f}" width="{wide:.1f}" {shape}/>'
    else:
        yield f'<rect x="{x:.1f}" width="{wide:.1f}" {shape} fill-opacity="0.2"/>'
        yield f'<rect x="{x:.1f}" width="{end - x:.1f}" {shape} fill-opacity="0.35"/>'
        if end > begin:
            yield f'<rect x="{begin:.1f}" width="{end - begin:.1f}" {shape}/>'
    if not bar.is_fixed:
        yield f'<rect class="m" x="{x:.1f}" width="{wide:.1f}" {shape.replace(colour, "none")} stroke-dasharray="3 2"/>'
    if bar.is_open:
        yield f'<path class="m" fill="none" d="M{x + wide + 2:.1f} {y + 9}l5 4l-5 4"/>'
    is_on_full = is_full or end - begin >= _NAMED
    if is_on_full:
        x, wide = (x, wide) if is_full else (begin, end - begin)
    elif end > begin and begin - x < _NAMED:
        x, wide = end, x + wide - end
    elif end > begin:
        wide = begin - x
    yield from _name(bar.predicate, x, wide, y, ("t k" if colour in _LIGHT else "t w") if is_on_full else "t")
    yield "</g>"


def _name(name: str, x: float, wide: float, y: int, letters: str) -> Iterator[str]:
    """As much of a name as there is room for."""
    room = int((wide - 6) / 6.5)
    if room >= 2:
        shown = name if len(name) <= room else name[: room - 1] + "…"
        yield f'<text class="{letters}" x="{x + 4:.1f}" y="{y + 17}">{escape(shown)}</text>'


def _level(name: str, profile: LevelProfile, drawn: Drawing, margin: int, y: int, scale: float) -> Iterator[str]:
    """The level of a resource as a band, with its limits, and for the pointer each step."""
    limits = [each for each in (profile.lower, profile.upper) if abs(each) < inf]
    seen = [*limits, *(level for step in profile.steps for level in step[1:] if abs(level) < inf)]
    low, high = min(seen, default=0.0), max(seen, default=1.0)
    tall = (_TALL - 14) / ((high - low) or 1.0)

    def height(level: float) -> float:
        return y + _TALL - 7 - (min(max(level, low), high) - low) * tall

    def across(at: int) -> float:
        return margin + (max(at, drawn.first) - drawn.first) * scale

    right = across(drawn.last)
    ends = [across(step[0]) for step in profile.steps[1:]] + [right]
    for (at, least, most), end in zip(profile.steps, ends, strict=True):
        x, top, foot = across(at), height(most), height(low)
        text = f"{name}: {level_text(least, most)} from {at}"
        yield f"<g><title>{escape(text)}</title>"
        size = f'width="{max(end - x, 1.0):.1f}" height="{foot - top + 0.5:.1f}"'
        yield f'<rect class="l" x="{x:.1f}" y="{top:.1f}" {size}/>'
        if least != most:
            yield f'<line class="m" x1="{x:.1f}" y1="{height(least):.1f}" x2="{end:.1f}" y2="{height(least):.1f}"/>'
        if end - x > _LETTER * len(level_text(least, most)):
            base = top - 3 if top > y + 16 else top + 10
            yield f'<text class="s" x="{x + 3:.1f}" y="{base:.1f}">{level_text(least, most)}</text>'
        yield "</g>"
    for limit in dict.fromkeys(limits):
        line = height(limit)
        yield f'<line class="b" x1="{margin}" y1="{line:.1f}" x2="{right:.1f}" y2="{line:.1f}"/>'
        yield f'<text class="s" x="{right + 3:.1f}" y="{line + 3:.1f}">{level_text(limit, limit)}</text>'


def page(report: PlanReport, drawn: Drawing, title: str, said: Sequence[str]) -> str:
    """The plan as an HTML page: what is `said` of it, the picture, tables of its tokens and of the values found."""
    picture = _wide("timelines", svg(drawn)) if drawn and not report.is_exhausted else ""
    tables = _table(COLUMNS, [token_cells(token) for token in report.shown]) + _table(VARIABLES, report.values)
    hidden = f"<p>{escape(hidden)}</p>" if (hidden := report.hidden_text()) else ""
    return (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{escape(title)}</title>'
        f"<style>{_LOOK}</style></head><body><h1>{escape(title)}</h1><pre>{escape(chr(10).join(said))}</pre>"
        f"{picture}{tables}{hidden}</body></html>\n"
    )


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Rows under a head; nothing where there are none."""
    if not rows:
        return ""
    names = "".join(f'<th scope="col">{name}</th>' for name in head)
    lines = [
        "<tr>" + "".join(f'<td title="{escape(cell)}">{escape(cell)}</td>' for cell in row) + "</tr>" for row in rows
    ]
    return _wide(f"{head[0]}s", f"<table><tr>{names}</tr>{''.join(lines)}</table>")


def _wide(name: str, part: str) -> str:
    """What is scrolled on a narrow screen: with the pointer, and with the keyboard."""
    return f'<div class="p" role="region" aria-label="{name}" tabindex="0">{part}</div>'
