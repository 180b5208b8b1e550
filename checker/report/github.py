"""Findings in, workflow commands of GitHub Actions out: each fault and each lost goal becomes a mark at its line."""

from checker.conditions.rendering import condition_claim
from checker.counterfactual.rendering import cause_text
from checker.excerpts import Excerpts
from checker.findings import Findings
from checker.rendering import failure_text
from checker.report.cases import failing_cases
from checker.report.losses import damage_words, goal_text, repair_text
from checker.report.sentences import case_lines, decision, explained_by, fault_title, headline, repaired_line
from nddl_lang.text.github import command_line
from runtime.executive.outcome import SourcePlace

_MOST_MARKS = 10  # of each command GitHub shows no more


def github_report(findings: Findings, excerpts: Excerpts) -> str:
    """Errors for faults and regression cases, warnings for goals given up, notices for repairs and for the whole."""
    rate = findings.rate
    lines = []
    for index, fault in enumerate(findings.faults[:_MOST_MARKS]):
        bucket = fault.bucket
        text = [failure_text(bucket.judgement, bucket.open_goals, bucket.refusal)]
        text += [f"cause: {cause_text(fault.causes)}"] if fault.causes.is_sought else []
        text += [f"fails {condition_claim(fault.condition)}"] if fault.condition is not None else []
        text.append(explained_by(findings, bucket.example))
        where = next(iter(fault.places), SourcePlace(findings.mission.source.name, 1, 1, ""))
        command = "error" if rate.exceeds else "warning"
        lines.append(command_line(command, _place(where, fault_title(findings, index), excerpts), "\n".join(text)))
    for error in findings.errors[:_MOST_MARKS]:
        where = SourcePlace(findings.mission.source.name, 1, 1, "")
        title = f"mission {error.number} (seed {error.seed}) could not be flown"
        lines.append(command_line("error", _place(where, title, excerpts), failure_text(error.judgement)))
    for failing in failing_cases(findings)[:_MOST_MARKS]:
        where = next(iter(failing.places), SourcePlace(findings.mission.source.name, 1, 1, ""))
        command = "error" if failing.must_pass else "warning"
        lines.append(command_line(command, _place(where, failing.title, excerpts), failing.text))
    for goal in [one for one in findings.tally.goals if one.given_up][:_MOST_MARKS]:
        lines.append(command_line("warning", _place(goal.place, "goal given up", excerpts), goal_text(goal, excerpts)))
    for repair in [one for one in findings.tally.repairs if one.place is not None][:_MOST_MARKS]:
        assert repair.place is not None
        text_of = repair_text(repair, excerpts)
        lines.append(command_line("notice", _place(repair.place, "plan repaired", excerpts), text_of))
    cases = case_lines(findings)
    cost = damage_words(findings.tally)
    whole = [
        decision(findings),
        *cases,
        *([f"cost: {cost}"] if cost else []),
        *([line] if (line := repaired_line(findings)) else []),
        f"run {findings.run_id}, seed {findings.seed}",
    ]
    lines.append(
        command_line("error" if findings.is_unknown else "notice", {"title": headline(findings)}, "\n".join(whole))
    )
    return "\n".join(lines) + "\n"


def _place(place: SourcePlace, title: str, excerpts: Excerpts) -> dict[str, str | int]:
    return {"file": excerpts.file(place), "line": place.line, "col": place.column, "title": title}
