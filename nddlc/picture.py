"""Draw a plan as an SVG picture or as a page that holds it: no scripts, nothing from outside."""

from collections.abc import Sequence
from html import escape

from nddlc.gantt import Bar, Facts, bars, lanes
from nddlc.load import TOKEN_HEAD, token_row

WIDTH = 900
LINE = 26
HEAD = 30
PALETTE = ("#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377", "#997700", "#555555")
LIGHT = {"#ee6677", "#ccbb44", "#66ccee"}  # dark letters are read better on these
STYLE = "text{font:12px sans-serif;fill:#222}.t{font-size:11px}.w{fill:#fff}.a{stroke:#ccc}.r{stroke:#eee}"
LOOK = (
    "body{font:14px sans-serif;margin:2em}.p{overflow-x:auto}table{border-collapse:collapse;margin-top:1em}"
    "td,th{padding:2px 10px;text-align:left;white-space:nowrap;border-bottom:1px solid #ddd}"
)


def svg(facts: Facts, horizon: tuple[int, int]) -> str:
    """The plan as one SVG element; bars that may move have a dashed outline."""
    rows, found, first, last = bars(facts, horizon)
    margin = 20 + 7 * max([len(row) for row in rows], default=0)
    scale = WIDTH / (last - first)
    colours = {name: PALETTE[n % len(PALETTE)] for n, name in enumerate(dict.fromkeys(bar.predicate for bar in found))}
    body: list[str] = []
    y = HEAD
    for row in rows:
        body.append(f'<text x="4" y="{y + 17}">{escape(row)}</text>')
        for lane in lanes([bar for bar in found if bar.row == row]):
            for bar in lane:
                body += _bar(bar, margin + (bar.start - first) * scale, (bar.end - bar.start) * scale, y, colours)
            y += LINE
        body.append(f'<line class="r" x1="0" y1="{y}" x2="{margin + WIDTH + 20}" y2="{y}"/>')
    axis: list[str] = []
    step = _step(last - first)
    moment = -(-first // step) * step
    while moment <= last:
        x = margin + (moment - first) * scale
        axis.append(f'<line class="a" x1="{x:.1f}" y1="{HEAD - 8}" x2="{x:.1f}" y2="{y}"/>')
        axis.append(f'<text x="{x:.1f}" y="{HEAD - 12}" text-anchor="middle">{moment}</text>')
        moment += step
    size = f'width="{margin + WIDTH + 20}" height="{y + 10}"'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} role="img" aria-label="plan">'
        f"<style>{STYLE}</style>{''.join(axis)}{''.join(body)}</svg>\n"
    )


def _bar(bar: Bar, x: float, width: float, y: int, colours: dict[str, str]) -> list[str]:
    """One token: a box with its name and, for the pointer, all that is known of it."""
    wide = max(width, 3.0)
    outline = "" if bar.is_fixed else ' stroke="#222" stroke-dasharray="3 2"'
    box = f'<rect x="{x:.1f}" y="{y + 3}" width="{wide:.1f}" height="{LINE - 6}" rx="3" fill="{colours[bar.predicate]}"'
    parts = [f"<g><title>{escape(bar.tip)}</title>{box}{outline}/>"]
    room = int((wide - 6) / 6.5)
    if room >= 2:
        name = bar.predicate if len(bar.predicate) <= room else bar.predicate[: room - 1] + "…"
        letters = "t" if colours[bar.predicate] in LIGHT else "t w"
        parts.append(f'<text class="{letters}" x="{x + 4:.1f}" y="{y + 17}">{escape(name)}</text>')
    parts.append("</g>")
    return parts


def _step(length: int) -> int:
    """A round distance between two numbers on the axis: 1, 2 or 5 times a power of ten."""
    power = 1
    while True:
        for factor in (1, 2, 5):
            if length <= 12 * factor * power:
                return factor * power
        power *= 10


def page(facts: Facts, horizon: tuple[int, int], title: str, said: Sequence[str]) -> str:
    """The plan as an HTML page: the picture, a table of all tokens, and what else is `said` of it, line by line."""
    cells = [
        "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in token_row(token)) + "</tr>" for token in facts["tokens"]
    ]
    names = "".join(f"<th>{name}</th>" for name in TOKEN_HEAD)
    picture = f'<div class="p">{svg(facts, horizon)}</div>' if facts["solve"]["result"] == "plan" else ""
    return (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{escape(title)}</title>'
        f"<style>{LOOK}</style></head><body><h1>{escape(title)}</h1>{picture}"
        f'<div class="p"><table><tr>{names}</tr>{"".join(cells)}</table></div>'
        f"<pre>{escape(chr(10).join(said))}</pre></body></html>\n"
    )
