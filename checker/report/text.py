"""Findings in, the summary that a terminal or a CI log shows out: some 25 lines."""

from checker.conditions.rendering import condition_lines
from checker.counterfactual.rendering import cause_text
from checker.excerpts import Excerpts
from checker.explain import excerpt_lines
from checker.findings import Fault, Findings
from checker.oracle import OUT_OF_TIME
from checker.rendering import breaking_text, confirmation_text, failure_text
from checker.report.losses import damage_words, loss_lines
from checker.report.sentences import (
    case_lines,
    cut_line,
    decision,
    errors_title,
    explained_by,
    fault_title,
    headline,
    rate_line,
    repaired_line,
    sensitivity_line,
    stop_line,
)
from checker.sampling.rendering import describe
from nddl_lang.text.printable import counted
from runtime.executive.outcome import SourcePlace

_MOST_FAULTS = 5
_MOST_ERRORS = 3


def text_report(findings: Findings, excerpts: Excerpts) -> str:
    """The summary: what was flown, what it means, each fault with line, condition and the command that explains it."""
    lost = damage_words(findings.tally)
    lines = [f"{headline(findings)} (run {findings.run_id}, seed {findings.seed})", f"  {decision(findings)}"]
    if lost:
        lines.append(f"  cost: {lost}")
    lines.append(f"  {rate_line(findings.rate)}")
    lines += [
        f"  {line}"
        for line in (
            repaired_line(findings),
            cut_line(findings),
            stop_line(findings),
            *case_lines(findings),
            sensitivity_line(findings),
        )
        if line
    ]
    lines += [f"  {line}" for line in loss_lines(findings.tally, excerpts)]
    lines += [f"  {parameter.name}: {describe(parameter)}" for parameter in findings.agent.parameters]
    for index, fault in enumerate(findings.faults[:_MOST_FAULTS]):
        bucket = fault.bucket
        lines += [
            "",
            f"{index + 1}. {fault_title(findings, index)}",
            f"   {failure_text(bucket.judgement, bucket.open_goals, bucket.refusal)}",
        ]
        lines += [f"   cause: {cause_text(fault.causes)}"] if fault.causes.is_sought else []
        for number, place in enumerate(fault.places):
            about = _role(place, fault)
            lines += excerpt_lines(place, excerpts, marked=number == 0, indent="   ", about=about)
        if fault.condition is not None:
            lines += condition_lines(fault.condition, "   ")
        elif fault.is_tested:
            lines.append("   no condition on the parameters tells these missions well enough from others")
        if fault.confirmation is not None:
            lines.append(f"   z3 {confirmation_text(fault.confirmation, fault.condition)}")
        lines.append(f"   why: {explained_by(findings, bucket.example)}")
    if len(findings.faults) > _MOST_FAULTS:
        more = len(findings.faults) - _MOST_FAULTS
        lines += ["", f"{counted(more, 'more kind')} of failure {'is' if more == 1 else 'are'} in the report"]
    if findings.errors:
        lines += ["", f"{errors_title(findings)}, counted nowhere: {len(findings.errors)}"]
        for error in findings.errors[:_MOST_ERRORS]:
            lines.append(f"   mission {error.number} (seed {error.seed}): {failure_text(error.judgement)}")
        if len(findings.errors) > _MOST_ERRORS:
            lines.append(f"   and {len(findings.errors) - _MOST_ERRORS} more, see the report")
        if any(error.judgement.code == OUT_OF_TIME for error in findings.errors):
            lines.append(
                "   help: with `max_steps` a reactor flies on after so many decisions a tick; failures are explained"
            )
    return "\n".join(lines) + "\n"


def _role(place: SourcePlace, fault: Fault) -> str:
    """What a place is where it is not the likeliest cause itself."""
    if fault.causes.first is not None and place == fault.places[0]:
        return ""
    culprit = fault.bucket.culprit
    return breaking_text(culprit.element) if place == culprit.place else "where its limit is set"
