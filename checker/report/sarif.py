"""Findings in, SARIF 2.1.0 out: a result per fault and per group of regression cases, at the line to blame."""

from collections import Counter
from collections.abc import Sequence
from typing import Any

from checker.conditions.rendering import condition_claim
from checker.counterfactual.rendering import cause_text
from checker.excerpts import Excerpts
from checker.findings import Fault, Findings
from checker.oracle import CODE_NAMES, Verdict
from checker.rendering import failure_text
from checker.report.cases import FailingCases, failing_cases
from checker.report.sentences import decision, explained_by, missions, percent
from nddl_lang.text.sarif import sarif_log, uri_of
from runtime.executive.outcome import SourcePlace


def sarif_report(findings: Findings, excerpts: Excerpts) -> str:
    """Faults, regression cases that fail and errors as SARIF text; what has no line points at the mission file."""
    results = [_of_fault(fault, findings, excerpts) for fault in findings.faults]
    results += [_of_cases(one, findings, excerpts) for one in failing_cases(findings)]
    results += _of_errors(findings, excerpts)
    codes = dict.fromkeys(result["ruleId"] for result in results)
    return sarif_log(
        [{"id": code, "shortDescription": {"text": CODE_NAMES.get(code, code)}} for code in codes], results
    )


def _of_fault(fault: Fault, findings: Findings, excerpts: Excerpts) -> dict[str, Any]:
    bucket = fault.bucket
    why = failure_text(bucket.judgement, bucket.open_goals, bucket.refusal)
    parts = [f"{missions(len(bucket.missions))} ({percent(bucket.share)}) fail here: {why}."]
    parts += [f"Cause: {cause_text(fault.causes)}."] if fault.causes.is_sought else []
    parts += [f"Fails {condition_claim(fault.condition)}."] if fault.condition is not None else []
    parts.append(f"Explained by {explained_by(findings, bucket.example, '`')}.")
    return _result(bucket.code, "error", " ".join(parts), fault.places, findings, excerpts)


def _of_cases(one: FailingCases, findings: Findings, excerpts: Excerpts) -> dict[str, Any]:
    level = "error" if one.must_pass else "warning"
    return _result(one.code, level, f"{one.title}. {one.text}.", one.places, findings, excerpts)


def _of_errors(findings: Findings, excerpts: Excerpts) -> list[dict[str, Any]]:
    """Missions that could not be flown, those together of which the same was said."""
    alike = Counter((one.judgement.code or Verdict.ERROR.value, failure_text(one.judgement)) for one in findings.errors)
    if findings.is_unknown and not alike:
        text = f"{decision(findings)}.".capitalize()
        return [_result(Verdict.ERROR.value, "error", text, (), findings, excerpts)]
    return [
        _result(code, "error", f"{missions(count)} could not be flown: {why}.", (), findings, excerpts)
        for (code, why), count in alike.items()
    ]


def _result(
    code: str, level: str, text: str, places: Sequence[SourcePlace], findings: Findings, excerpts: Excerpts
) -> dict[str, Any]:
    where = places[0] if places else SourcePlace(findings.mission.source.name, 1, 1, "")
    return {
        "ruleId": code,
        "level": level,
        "message": {"text": text},
        "locations": [_location(where, excerpts)],
        "relatedLocations": [_location(place, excerpts) for place in places[1:]],
    }


def _location(place: SourcePlace, excerpts: Excerpts) -> dict[str, Any]:
    region = {"startLine": place.line, "startColumn": place.column}
    return {"physicalLocation": {"artifactLocation": {"uri": uri_of(excerpts.file(place))}, "region": region}}
