"""Findings in, a page of Markdown out, for the summary of a CI job."""

from checker.conditions.rendering import condition_claim
from checker.counterfactual.rendering import cause_text
from checker.excerpts import Excerpts
from checker.findings import Fault, Findings
from checker.rendering import failure_text
from checker.report.losses import goal_line, goal_text, repair_text, request_line, unmet_text
from checker.report.sentences import (
    case_lines,
    cut_line,
    decision,
    errors_title,
    explained_by,
    fault_title,
    headline,
    observed_share,
    percent,
    rate_line,
    repaired_line,
    verdict_word,
)
from checker.sampling.rendering import describe

_MARKS = str.maketrans({**{mark: f"\\{mark}" for mark in "\\*_|[]#"}, "<": "&lt;", ">": "&gt;"})
_MOST_FAULTS = 20
_MOST_LINES = 20


def markdown_report(findings: Findings, excerpts: Excerpts) -> str:
    """Verdict, rate, faults with their lines, and what the missions cost."""
    rate = findings.rate
    lines = [f"## {_plain(findings.agent.name)}: {verdict_word(findings)}", "", _plain(headline(findings)) + ".", ""]
    lines += [f"**{_plain(decision(findings))}.** {_plain(rate_line(rate))}.", ""]
    lines += [f"{_plain(cut_line(findings))}.", ""] if findings.is_cut else []
    lines += ["| missions | failed | failure rate | accepted | errors |", "| ---: | ---: | ---: | ---: | ---: |"]
    lines.append(
        f"| {len(findings.results)} | {rate.failures} | {observed_share(rate)} | {percent(rate.limit)} "
        f"| {len(findings.errors)} |"
    )
    if cases := case_lines(findings):
        lines += ["", f"{_plain(cases[0])}.", "", *(f"* {_plain(line)}" for line in cases[1:])]
    for index, fault in enumerate(findings.faults[:_MOST_FAULTS]):
        lines += ["", f"### {_plain(fault_title(findings, index))}", "", *_fault(fault, findings, excerpts)]
    if len(findings.faults) > _MOST_FAULTS:
        lines += ["", f"{len(findings.faults) - _MOST_FAULTS} more kinds of failure are in the JSON report."]
    if findings.errors:
        lines += ["", f"### {errors_title(findings).capitalize()}", ""]
        for error in findings.errors[:_MOST_LINES]:
            lines.append(f"* mission {error.number} (seed {error.seed}): {_plain(failure_text(error.judgement))}")
    lines += ["", "### What it cost", "", *(f"* {_plain(line)}" for line in _costs(findings, excerpts))]
    lines += ["", "### What was drawn", ""]
    lines += [f"* `{one.name}`: {_plain(describe(one))}" for one in findings.agent.parameters]
    lines += ["", f"Run `{findings.run_id}`, seed {findings.seed}."]
    return "\n".join(lines) + "\n"


def _fault(fault: Fault, findings: Findings, excerpts: Excerpts) -> list[str]:
    bucket = fault.bucket
    lines = [_plain(failure_text(bucket.judgement, bucket.open_goals, bucket.refusal)) + "."]
    if fault.causes.is_sought:
        lines += ["", f"Cause: {_plain(cause_text(fault.causes))}."]
    places = fault.places
    if places:
        lines += ["", "```", *(f"{excerpts.path(place)}: {excerpts.line(place).strip()}" for place in places), "```"]
    if fault.condition is not None:
        lines += ["", f"Fails {_plain(condition_claim(fault.condition))}."]
    return [*lines, "", explained_by(findings, bucket.example, "`")]


def _costs(findings: Findings, excerpts: Excerpts) -> list[str]:
    tally = findings.tally
    lines = [f"given up: {goal_text(one, excerpts)}" for one in tally.goals if one.given_up]
    lines += [f"repaired: {repair_text(one, excerpts)}" for one in tally.repairs]
    lines += [f"undelivered: {unmet_text(one)}" for one in tally.undelivered]
    lines += [f"request given up: {unmet_text(one)}" for one in tally.given_up]
    more = [f"{len(lines) - _MOST_LINES} more are in the JSON report"] if len(lines) > _MOST_LINES else []
    repaired = [line] if (line := repaired_line(findings)) else []
    return [goal_line(tally), request_line(tally), *repaired, *lines[:_MOST_LINES], *more]


def _plain(text: str) -> str:
    """A sentence without line breaks; outside of backquotes marks of Markdown stand for themselves."""
    parts = " ".join(text.split()).split("`")
    if len(parts) % 2 == 0:  # an odd backquote marks nothing
        parts = ["'".join(parts)]
    return "`".join(part if number % 2 else part.translate(_MARKS) for number, part in enumerate(parts))
