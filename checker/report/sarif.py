"""Findings in, SARIF 2.1.0 out: one result per fault, at its culprit, for code hosts that annotate lines."""

from typing import Any

from checker.conditions.rendering import condition_claim
from checker.counterfactual.rendering import cause_text
from checker.excerpts import Excerpts
from checker.findings import Fault, Findings
from checker.oracle import CODE_NAMES
from checker.rendering import failure_text
from checker.report.sentences import explained_by, missions, percent
from nddl_lang.text.sarif import sarif_log, uri_of
from runtime.executive.outcome import SourcePlace


def sarif_report(findings: Findings, excerpts: Excerpts) -> str:
    """The faults as SARIF text; a fault without a line points at the mission file."""
    codes = dict.fromkeys(fault.bucket.code for fault in findings.faults)
    rules = [{"id": code, "shortDescription": {"text": CODE_NAMES.get(code, code)}} for code in codes]
    return sarif_log(rules, [_result(fault, findings, excerpts) for fault in findings.faults])


def _result(fault: Fault, findings: Findings, excerpts: Excerpts) -> dict[str, Any]:
    bucket = fault.bucket
    why = failure_text(bucket.judgement, bucket.open_goals, bucket.refusal)
    parts = [f"{missions(len(bucket.missions))} ({percent(bucket.share)}) fail here: {why}."]
    parts += [f"Cause: {cause_text(fault.causes)}."] if fault.causes.is_sought else []
    parts += [f"Fails {condition_claim(fault.condition)}."] if fault.condition is not None else []
    parts.append(f"Explained by {explained_by(findings, bucket.example, '`')}.")
    where = next(iter(fault.places), SourcePlace(findings.mission.source.name, 1, 1, ""))
    return {
        "ruleId": bucket.code,
        "level": "error",
        "message": {"text": " ".join(parts)},
        "locations": [_location(where, excerpts)],
        "relatedLocations": [_location(place, excerpts) for place in fault.places[1:]],
    }


def _location(place: SourcePlace, excerpts: Excerpts) -> dict[str, Any]:
    region = {"startLine": place.line, "startColumn": place.column}
    return {"physicalLocation": {"artifactLocation": {"uri": uri_of(excerpts.file(place))}, "region": region}}
