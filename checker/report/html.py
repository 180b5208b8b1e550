"""Findings in, one self-contained HTML page out: no external resource, light and dark."""

import re
from collections.abc import Sequence
from html import escape
from importlib.resources import files
from itertools import groupby

from checker.batch.result import MissionResult
from checker.conditions.rendering import condition_evidence, condition_text, when_text
from checker.counterfactual.rendering import cause_text
from checker.drawn import Drawn
from checker.excerpts import Excerpts
from checker.findings import Fault, Findings
from checker.limits import Limit
from checker.losses import amount
from checker.oracle import CODE_NAMES, Verdict
from checker.rendering import beside, confirmation_text, failure_text, lines_text, step_text
from checker.report.losses import damage_words, goal_line, goal_text, repair_text, request_line, unmet_text
from checker.report.paths import plan_figure, section_figure, space_figure
from checker.report.sentences import (
    case_lines,
    cut_line,
    decision,
    errors_title,
    explained_by,
    missions,
    observed_share,
    percent,
    rate_line,
    repaired_line,
    sensitivity_line,
    stop_line,
    verdict_word,
)
from checker.report.svg import Dot, rate_plot, scatter_plot, strip_plot
from checker.report.timelines import Pair, pair_plot
from checker.sampling.rendering import describe, number
from checker.steps import Step, StepKind
from checker.story import Story
from checker.tally import Tally
from runtime.executive.configuration import ParameterConfiguration
from runtime.executive.distributions import DISTRIBUTIONS
from runtime.executive.outcome import SourcePlace

_MOST_ROWS = 1000
_MOST_LOSSES = 40
_MOST_LINES = 3  # of one rule in a row; more are folded
_COLOURS = 6


def html_report(
    findings: Findings,
    excerpts: Excerpts,
    stories: Sequence[Story | None],
    pairs: Sequence[Pair | None] = (),
    drawn: Drawn | None = None,
) -> str:
    """The page; `stories` and `pairs` have the story of each fault's example, and a passing mission beside it."""
    style = files("checker.report").joinpath("page.css").read_text(encoding="utf-8")
    script = files("checker.report").joinpath("page.js").read_text(encoding="utf-8")
    name = escape(findings.agent.name)
    parts = [
        "<!doctype html>",
        '<html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>{name}: {verdict_word(findings)}</title>",
        f"<style>\n{style}</style></head><body><main>",
        *_head(findings),
        *_losses(findings.tally, excerpts),
        *_faults(findings, excerpts, stories, pairs),
        *_paths(drawn),
        *_parameters(findings),
        *_table(findings),
        f"<footer>nddlc, run {findings.run_id}, seed {findings.seed}. The same run gives the same page.</footer>",
        f"<script>\n{script}</script></main></body></html>",
    ]
    return "\n".join(parts) + "\n"


def _words(text: str) -> str:
    """A sentence, with what stands in backquotes as code."""
    return re.sub(r"`([^`]*)`", r"<code>\1</code>", escape(text))


def _head(findings: Findings) -> list[str]:
    rate = findings.rate
    word = verdict_word(findings)
    lost = f"; cost: {words}" if (words := damage_words(findings.tally)) else ""
    flown = str(len(findings.results)) if not findings.is_interrupted else f"{len(findings.results)}/{findings.planned}"
    tiles = [(flown, "missions flown"), (str(rate.failures), "failed"), (observed_share(rate), "failure rate")]
    tiles.append((percent(rate.limit), "accepted"))
    if findings.errors:
        tiles.append((str(len(findings.errors)), errors_title(findings)))
    further = (cut_line(findings), stop_line(findings), *case_lines(findings), sensitivity_line(findings))
    return [
        f'<span class="verdict {word}">{word}</span>',
        f"<h1>{escape(findings.agent.name)}</h1>",
        f'<p class="soft">{escape(decision(findings))}{escape(lost)}</p>',
        *([f'<p class="soft">{_words(line)}.</p>'] if (line := repaired_line(findings)) else []),
        '<div class="tiles">',
        *(f'<div class="tile"><b>{value}</b><span>{caption}</span></div>' for value, caption in tiles),
        "</div>",
        *([rate_plot(rate)] if rate.counted else []),
        f'<p class="soft">{escape(rate_line(rate))}</p>',
        *(f'<p class="soft">{escape(line)}</p>' for line in further if line),
    ]


def _losses(tally: Tally, excerpts: Excerpts) -> list[str]:
    """What the missions cost, passed or not."""
    rows = [("given up", goal_text(one, excerpts)) for one in tally.goals if one.given_up]
    rows += [("repaired", repair_text(one, excerpts)) for one in tally.repairs]
    rows += [("undelivered", unmet_text(one)) for one in tally.undelivered]
    rows += [("request given up", unmet_text(one)) for one in tally.given_up]
    parts = ["<h2>What it cost</h2>", f"<p>{_words(goal_line(tally))}.<br>{_words(request_line(tally))}.</p>"]
    if rows:
        parts.append('<ul class="evidence">')
        parts += [f"<li><b>{what}</b>: {_words(text)}</li>" for what, text in rows[:_MOST_LOSSES]]
        parts.append("</ul>")
    if len(rows) > _MOST_LOSSES:
        parts.append(f'<p class="soft">{len(rows) - _MOST_LOSSES} more are in the JSON report.</p>')
    return parts


def _faults(
    findings: Findings, excerpts: Excerpts, stories: Sequence[Story | None], pairs: Sequence[Pair | None]
) -> list[str]:
    if not findings.faults:
        return []
    parts = ["<h2>What fails</h2>"]
    for index, (fault, story) in enumerate(zip(findings.faults, stories, strict=True)):
        pair = pairs[index] if index < len(pairs) else None
        parts += _fault(index, fault, findings, excerpts, story, pair)
    return parts


def _fault(
    index: int, fault: Fault, findings: Findings, excerpts: Excerpts, story: Story | None, pair: Pair | None
) -> list[str]:
    bucket = fault.bucket
    first, last = bucket.first_tick, bucket.last_tick
    when = f"at tick {first}" if first == last else f"at ticks {first} to {last}"
    meaning = escape(CODE_NAMES.get(bucket.code, "unknown"))
    why = _words(failure_text(bucket.judgement, bucket.open_goals, bucket.refusal))
    parts = [
        f'<section class="card fault" style="--colour: var(--f{index % _COLOURS})">',
        f"<h3>{missions(len(bucket.missions))} ({percent(bucket.share)}): {why}</h3>",
        f'<p class="soft">{bucket.code}, {meaning}; {escape(bucket.reactor)} gives up {when}</p>',
    ]
    if fault.causes.is_sought:
        parts.append(f"<p>cause: {_words(cause_text(fault.causes))}</p>")
    places = fault.places
    if places:
        parts.append("<pre>" + "\n".join(_excerpt(place, excerpts, marked=True) for place in places) + "</pre>")
    if fault.condition is not None:
        when = when_text(fault.condition)
        text = escape(condition_text(fault.condition))
        evidence = escape(condition_evidence(fault.condition))
        parts.append(f'<p class="when">fails {when} <b>{text}</b></p><p class="soft">{evidence}.</p>')
    if fault.confirmation is not None:
        parts.append(f'<p class="soft">z3 {escape(confirmation_text(fault.confirmation, fault.condition))}.</p>')
    if story is not None and pair is not None:
        parts.append(pair_plot(pair, story))
        parts.append('<p class="soft">Numbers are steps of the chain below; dashed lines their ticks.</p>')
    if story is not None:
        parts.append(f"<details open><summary>Mission {story.number}, from the draw to the abort</summary>")
        parts.append('<ol class="chain">')
        first = 1
        for _, alike in groupby(story.steps, lambda step: (step.kind, step.kind is StepKind.LINE and step.subject)):
            run = list(alike)
            if len(run) > _MOST_LINES and run[0].kind is StepKind.LINE:
                parts.append(_run(first, run, excerpts))
            else:
                parts += [_step(step, story, excerpts) for step in run]
            first += len(run)
        parts.append("</ol></details>")
    parts.append(f"<p><code>{escape(explained_by(findings, bucket.example))}</code></p></section>")
    return parts


def _step(step: Step, story: Story, excerpts: Excerpts) -> str:
    when = f'<span class="soft">tick {step.tick}</span> ' if step.tick is not None else ""
    is_fault = step.kind in (StepKind.FAULT, StepKind.BROKEN)
    lines = [_excerpt(step.place, excerpts, marked=is_fault)] if step.place is not None else []
    for said, place, is_marked in beside(step):
        lines.append(f'<span class="soft">{_words(said)}:</span>\n{_excerpt(place, excerpts, marked=is_marked)}')
    source = "<pre>" + "\n".join(lines) + "</pre>" if lines else ""
    return f'<li class="{step.kind}"><span class="why">{when}{_words(step_text(step, story))}</span>{source}</li>'


def _run(first: int, steps: Sequence[Step], excerpts: Excerpts) -> str:
    """Many lines of one rule, folded; the steps after it keep their numbers."""
    lines = "\n".join(_excerpt(step.place, excerpts, marked=False) for step in steps if step.place is not None)
    text = f"{first}–{first + len(steps) - 1}. {_words(lines_text(str(steps[0].subject), len(steps)))}"
    folded = f"<details><summary>{text}</summary><pre>{lines}</pre></details>"
    return f'<li class="line" style="counter-increment: step {len(steps)}">{folded}</li>'


def _excerpt(place: SourcePlace, excerpts: Excerpts, *, marked: bool) -> str:
    line = excerpts.line(place).expandtabs(4)
    first = place.text.strip().split("\n")[0].strip()
    start = line.find(first) if first else -1
    text = escape(line)
    if marked and start >= 0:
        end = start + len(first)
        text = f"{escape(line[:start])}<mark>{escape(line[start:end])}</mark>{escape(line[end:])}"
    at = f'<span class="at" data-file="{escape(excerpts.file(place))}" data-line="{place.line}">'
    return f'{at}{escape(excerpts.path(place))}</span>\n<span class="no">{place.line} | </span>{text}'


def _paths(drawn: Drawn | None) -> list[str]:
    """Where the vehicle went, as the mission file asks for."""
    if drawn is None:
        return []
    parts = [
        "<h2>Where it went</h2>",
        '<p class="soft">From above: missions that pass in grey, failing ones in colour; the black (or white) line '
        "is the one with every parameter in the middle of its range.</p>",
    ]
    parts.append(_wide(plan_figure(drawn.paths)))
    for caption, track in drawn.closer:
        parts += [f"<h3>{escape(caption)}</h3>", _wide(space_figure(track)), _wide(section_figure(track, drawn.cell))]
    return parts


def _wide(figure: str) -> str:
    """A figure that is scrolled on a narrow screen rather than made too small to read."""
    return f'<div class="scroll figure" tabindex="0">{figure}</div>'


def _parameters(findings: Findings) -> list[str]:
    drawn = [one for one in findings.agent.parameters if not DISTRIBUTIONS[one.distribution].is_determined]
    if not drawn or not findings.results:
        return []
    by_name = {parameter.name: _dots(findings, parameter) for parameter in drawn}
    conditions = [fault.condition for fault in findings.faults if fault.condition is not None]
    parts = ["<h2>What was drawn</h2>", '<p class="soft">Grey dots are missions that passed.</p>']
    for parameter in drawn:
        edges = [one for each in conditions for one in each.single if one.feature.parameters == (parameter.name,)]
        unique = list(dict.fromkeys(edges))
        told = describe(parameter) + ("; the value when a mission ended" if parameter.mode == "intra" else "")
        parts.append(f'<h3>{escape(parameter.name)}</h3><p class="soft">{escape(told)}</p>')
        parts.append(strip_plot(parameter.name, by_name[parameter.name], (parameter.lower, parameter.upper), unique))
    first = [name for each in conditions for name in each.parameters]
    ranked = sorted(drawn, key=lambda one: (one.name not in first, first.index(one.name) if one.name in first else 0))
    if len(ranked) > 1:
        one, other = ranked[0], ranked[1]
        boxes = ((one.lower, one.upper), (other.lower, other.upper))
        parts.append(f"<h3>{escape(one.name)} against {escape(other.name)}</h3>")
        parts.append(scatter_plot((one.name, other.name), by_name[one.name], by_name[other.name], boxes))
    return parts


def _dots(findings: Findings, parameter: ParameterConfiguration) -> list[Dot]:
    """The value of a parameter in force when each mission ended."""
    fault_of = _fault_numbers(findings)
    dots: list[Dot] = []
    for result in findings.results:
        draws = result.outcome.draws if result.outcome is not None else ()
        values = [draw.value for draw in draws if draw.parameter == parameter.name]
        if values:
            dots.append(Dot(result.number, values[-1], fault_of.get(result.number)))
    return dots


def _fault_numbers(findings: Findings) -> dict[int, int]:
    return {mission: index for index, fault in enumerate(findings.faults) for mission in fault.bucket.missions}


def _table(findings: Findings) -> list[str]:
    """The missions, failures first; sorted and filtered by a script, whole without it."""
    telling = [result for result in findings.results if result.verdict is not Verdict.PASS]
    passing = [result for result in findings.results if result.verdict is Verdict.PASS]
    names = [parameter.name for parameter in findings.agent.parameters]
    fault_of = _fault_numbers(findings)
    verdicts = dict.fromkeys(result.verdict.value for result in (*telling, *passing))
    choices = "".join(f'<option value="{one}">{one}</option>' for one in verdicts)
    captions = [("mission", "n"), ("verdict", ""), ("tick", "n"), *((name, "n") for name in names)]
    captions += [("goals lost", "n"), ("repairs", "n"), ("seed", "n"), ("reason", "")]
    heads = "".join(
        f'<th class="{kind}" scope="col"><button type="button">{escape(name)}</button></th>' for name, kind in captions
    )
    parts = [
        '<h2>Missions</h2><div class="missions"><div class="controls" hidden>'
        '<label>filter <input type="search" placeholder="F1, gps, 7234 ..."></label> '
        f'<label>verdict <select><option value="">all</option>{choices}</select></label> <output></output></div>'
        f'<div class="scroll" tabindex="0"><table><thead><tr>{heads}</tr></thead><tbody>'
    ]
    shown = [*telling[:_MOST_ROWS], *passing[:_MOST_ROWS]]
    parts += [_row(result, names, fault_of.get(result.number)) for result in shown]
    parts.append("</tbody></table></div></div>")
    if len(findings.results) > len(shown):
        parts.append(f'<p class="soft">{len(findings.results) - len(shown)} more are in the JSON report.</p>')
    return parts


def _row(result: MissionResult, names: Sequence[str], fault: int | None) -> str:
    last = {draw.parameter: draw.value for draw in (result.outcome.draws if result.outcome else ())}
    values = "".join(f'<td class="n">{number(last[name]) if name in last else ""}</td>' for name in names)
    colour = f' style="background: var(--f{fault % _COLOURS})"' if fault is not None else ""
    tick = result.outcome.last_tick if result.outcome is not None else ""
    word = f"{result.verdict.value} {result.judgement.code}".strip()
    return (
        f'<tr data-verdict="{result.verdict.value}"><td class="n">{result.number}</td>'
        f'<td class="v"><i class="chip"{colour}></i>{word}</td>'
        f'<td class="n">{tick}</td>{values}<td class="n">{amount(result.losses, Limit.REJECTED)}</td>'
        f'<td class="n">{result.losses.repaired}</td><td class="n">{result.seed}</td>'
        f"<td>{_words(failure_text(result.judgement, result.open_goals))}</td></tr>"
    )
