"""The cells of a study in, Figure 12 of the founding paper out: as text, as data, as a picture, as a page."""

from collections.abc import Sequence
from html import escape
from importlib.resources import files
from typing import Any

from checker.report.sentences import percent
from checker.sampling.rendering import number
from checker.study.cells import StudyCell, StudyFinding, findings_of
from checker.study.reading import StudyFile
from nddl_lang.text.values import json_text

_PANELS = (("(a) drawn once per mission", "inter"), ("(b) redrawn every few ticks", "intra"))
_COLOURS = {"uniform": "f3", "normal": "f1"}
_LEFT, _TOP, _HEIGHT, _BAR, _GAP = 58.0, 34.0, 200.0, 18.0, 20.0
_FOOT = 60.0  # below a panel: names and counts
_STYLE = """<style>
svg { background: #fff; } text { font: 11.5px system-ui, "DejaVu Sans", sans-serif; fill: #555; }
text.name { fill: #111; font-size: 12.5px; } .f3 { fill: #0f8b8d; } .f1 { fill: #d9822b; } .f2 { fill: #7a4fd0; }
.grid { stroke: #bbb; stroke-dasharray: 2 4; } .whisker { stroke: #111; stroke-width: 1.2; }
.wanted { fill: #fff; stroke: #111; } .sample { fill: #c02f37; stroke: #fff; }
</style>"""


def study_text(study: StudyFile, cells: Sequence[StudyCell]) -> str:
    """The table of rates with their intervals, and what finds each variant."""
    level = number(study.confidence * 100.0)
    lines = [f"{study.name}: % of missions that failed, with exact {level} % intervals; seed {study.seed}", ""]
    width = max([8, *(len(one.variant.name) for one in cells)])
    lines.append("  " + " " * width + "".join(f"{sampling:>27}" for sampling in study.samplings))
    for variant in study.variants:
        row = [next((c for c in cells if (c.variant, c.sampling) == (variant, s)), None) for s in study.samplings]
        lines.append(f"  {variant.name:<{width}}" + "".join(f"{_entry(cell, study):>27}" for cell in row))
    lines += [f"  {'':<{width}}  * outside of the expected rate ± {percent(study.corridor)}", ""]
    lines += [f"  {_finding_text(one)}" for one in findings_of(cells)]
    contained = [one for one in cells if one.beyond is not None and one.failures]
    for one in contained:
        lines.append(
            f"  {one.variant.name}, {one.sampling}: of {one.apart} missions that pass with {one.variant.beyond}, "
            f"{one.beyond} fail: {percent(one.own_rate)}"
        )
    errors = sum(one.errors for one in cells)
    missing = sum(max(0, one.planned - one.missions - one.errors) for one in cells)
    lines.append(f"  {sum(one.missions for one in cells)} missions, {errors} errors, {missing} not flown yet")
    return "\n".join(lines) + "\n"


def _entry(cell: StudyCell | None, study: StudyFile) -> str:
    if cell is None or not cell.missions:
        return "-"
    lower, upper = cell.interval(study.confidence)
    mark = "*" if cell.is_expected(study.corridor) is False else " "
    span = f"[{number(round(100 * lower, 1))}, {number(round(100 * upper, 1))}]"
    return f"{number(round(100 * cell.rate, 1))} {span} n={cell.missions}{mark}"


def _finding_text(finding: StudyFinding) -> str:
    """Which sampling finds a variant."""
    head = f"{finding.variant.name} ({finding.variant.title or 'no mistake'}): "
    if not finding.finds:
        return head + "no mission failed"
    found = ", ".join(f"{one.sampling} {percent(one.rate)}" for one in finding.finds)
    text = head + (f"found by {found}" if finding.variant.edits else f"missions fail under {found}")
    if finding.worse:
        worse = ", ".join(one.sampling for one in finding.worse)
        text += f"; {finding.finds[0].sampling} finds it more often than {worse}"
    missed = ", ".join(one.sampling for one in finding.missed)
    return text + (f"; not by {missed}" if missed else "")


def study_data(study: StudyFile, cells: Sequence[StudyCell]) -> str:
    """The study as JSON text."""
    data: dict[str, Any] = {
        "format": "nddlc-study/1",
        "name": study.name,
        "seed": study.seed,
        "confidence": study.confidence,
        "corridor": study.corridor,
        "cells": [
            {
                "variant": one.variant.name,
                "title": one.variant.title,
                "sampling": one.sampling,
                "planned": one.planned,
                "missions": one.missions,
                "failures": one.failures,
                "errors": one.errors,
                "rate": round(one.rate, 9),
                "interval": list(one.interval(study.confidence)),
                "expected": one.variant.expected.get(one.sampling),
                "is_expected": one.is_expected(study.corridor),
                "codes": dict(one.codes),
                "beyond": one.beyond,
                "apart": one.apart,
                "failed_seeds": [seed for seed, fails in one.failed if fails],
            }
            for one in cells
        ],
        "found_by": {finding.variant.name: [one.sampling for one in finding.finds] for finding in findings_of(cells)},
    }
    return json_text(data) + "\n"


def study_svg(study: StudyFile, cells: Sequence[StudyCell]) -> str:
    """Figure 12 as a file of its own, which any viewer of pictures shows."""
    return _figure(study, cells, 'xmlns="http://www.w3.org/2000/svg" ', _STYLE)


def _figure(study: StudyFile, cells: Sequence[StudyCell], names: str = "", style: str = "") -> str:
    """Figure 12: bars with intervals and expected rates, a panel per mode, a pair of bars per variant."""
    panels = [one for one in _PANELS if any(sampling.endswith(one[1]) for sampling in study.samplings)]
    shapes = list(dict.fromkeys(sampling.split()[0] for sampling in study.samplings))
    group = _BAR * len(shapes) + _GAP
    width = _LEFT + group * len(study.variants) + 20.0
    height = len(panels) * (_HEIGHT + _TOP + _FOOT) + 24.0
    parts = [
        f'<svg {names}viewBox="0 0 {width:.0f} {height:.0f}" role="img" '
        f'aria-label="failed missions by sampling">{style}'
    ]
    for index, (caption, mode) in enumerate(panels):
        top = index * (_HEIGHT + _TOP + _FOOT) + _TOP
        parts.append(f'<text class="name" x="{_LEFT:.0f}" y="{top - 14:.0f}">{escape(caption)}</text>')
        for tick in range(0, 101, 20):
            y = top + _HEIGHT * (1 - tick / 100)
            parts.append(f'<line class="grid" x1="{_LEFT:.0f}" x2="{width - 10:.0f}" y1="{y:.1f}" y2="{y:.1f}"/>')
            parts.append(f'<text class="tick" x="{_LEFT - 6:.0f}" y="{y + 4:.1f}" text-anchor="end">{tick} %</text>')
        for at, variant in enumerate(study.variants):
            left = _LEFT + at * group + _GAP / 2
            middle = left + _BAR * len(shapes) / 2
            parts.append(
                f'<text class="tick" x="{middle:.1f}" y="{top + _HEIGHT + 17:.1f}" text-anchor="middle">'
                f"{escape(variant.name)}</text>"
            )
            counts = [one.missions for one in cells if one.variant.name == variant.name and one.sampling.endswith(mode)]
            parts.append(
                f'<text class="tick" x="{middle:.1f}" y="{top + _HEIGHT + 32:.1f}" text-anchor="middle">'
                f"{_count_text(counts)}</text>"
            )
            for place, shape in enumerate(shapes):
                wanted = (variant.name, f"{shape} {mode}")
                cell = next((one for one in cells if (one.variant.name, one.sampling) == wanted), None)
                if cell is not None and cell.missions:
                    parts += _bar(cell, study, left + place * _BAR, top, _COLOURS.get(shape, "f2"))
    y = height - 8.0
    for place, shape in enumerate(shapes):
        x = _LEFT + place * 110.0
        parts.append(f'<rect class="{_COLOURS.get(shape, "f2")}" x="{x:.0f}" y="{y - 10:.0f}" width="12" height="12"/>')
        parts.append(f'<text class="name" x="{x + 18:.0f}" y="{y:.0f}">{shape}</text>')
    if any(one.variant.expected.get(one.sampling) is not None for one in cells):
        x = _LEFT + len(shapes) * 110.0
        points = f"{x + 6:.0f},{y - 9:.0f} {x + 10:.0f},{y - 4:.0f} {x + 6:.0f},{y + 1:.0f} {x + 2:.0f},{y - 4:.0f}"
        parts.append(f'<polygon class="wanted" points="{points}"/>')
        parts.append(f'<text class="name" x="{x + 18:.0f}" y="{y:.0f}">expected</text>')
    return "\n".join([*parts, "</svg>"]) + "\n"


def _count_text(counts: Sequence[int]) -> str:
    """How many missions the bars of a pair rest on."""
    least, most = min(counts, default=0), max(counts, default=0)
    return f"n={least}" if least == most else f"n={least}-{most}"


def _bar(cell: StudyCell, study: StudyFile, x: float, top: float, colour: str) -> list[str]:
    lower, upper = cell.interval(study.confidence)
    rise = _HEIGHT * cell.rate
    middle = x + _BAR / 2
    ends = [top + _HEIGHT * (1 - share) for share in (lower, upper)]
    title = f"{cell.variant.name}, {cell.sampling}: {_entry(cell, study).strip()}"
    return [
        f'<rect class="{colour}" x="{x + 1:.1f}" y="{top + _HEIGHT - rise:.1f}" width="{_BAR - 2:.1f}" '
        f'height="{max(rise, 0.5):.1f}"><title>{escape(title)}</title></rect>',
        f'<line class="whisker" x1="{middle:.1f}" x2="{middle:.1f}" y1="{ends[0]:.1f}" y2="{ends[1]:.1f}"/>',
        *(
            f'<line class="whisker" x1="{middle - 4:.1f}" x2="{middle + 4:.1f}" y1="{end:.1f}" y2="{end:.1f}"/>'
            for end in ends
        ),
        *_expected_mark(cell, study, middle, top),
    ]


def _expected_mark(cell: StudyCell, study: StudyFile, middle: float, top: float) -> list[str]:
    """A diamond at the expected rate, red where the seen one is too far from it."""
    wanted = cell.variant.expected.get(cell.sampling)
    if wanted is None:
        return []
    y = top + _HEIGHT * (1 - wanted)
    kind = "sample" if cell.is_expected(study.corridor) is False else "wanted"
    points = f"{middle:.1f},{y - 5:.1f} {middle + 4:.1f},{y:.1f} {middle:.1f},{y + 5:.1f} {middle - 4:.1f},{y:.1f}"
    return [f'<polygon class="{kind}" points="{points}"><title>expected: {percent(wanted)}</title></polygon>']


def study_page(study: StudyFile, cells: Sequence[StudyCell]) -> str:
    """One self-contained page: picture, table, findings."""
    style = files("checker.report").joinpath("page.css").read_text(encoding="utf-8")
    head = "".join(f'<th class="n">{escape(one)}</th>' for one in study.samplings)
    rows = []
    for variant in study.variants:
        row = [next((c for c in cells if (c.variant, c.sampling) == (variant, s)), None) for s in study.samplings]
        columns = "".join(f'<td class="n">{escape(_entry(cell, study))}</td>' for cell in row)
        rows.append(f"<tr><td><b>{escape(variant.name)}</b> {escape(variant.title)}</td>{columns}</tr>")
    found = "".join(f"<li>{escape(_finding_text(one))}</li>" for one in findings_of(cells))
    name = escape(study.name)
    return (
        "\n".join(
            [
                '<!doctype html><html lang="en"><head><meta charset="utf-8">',
                '<meta name="viewport" content="width=device-width, initial-scale=1">',
                f"<title>{name}</title><style>\n{style}</style></head><body><main>",
                f"<h1>{name}</h1>",
                f'<p class="soft">% of missions that failed, with exact {number(study.confidence * 100)} % intervals; '
                "* lies outside of what is expected.</p>",
                '<div class="scroll figure">',
                _figure(study, cells),
                "</div>",
                f'<h2>What finds which mistake</h2><ul class="evidence">{found}</ul>',
                f'<div class="scroll"><table><thead><tr><th>variant</th>{head}</tr></thead><tbody>',
                *rows,
                f"</tbody></table></div><footer>nddlc, seed {study.seed}</footer></main></body></html>",
            ]
        )
        + "\n"
    )
