"""Findings in, the JSON report out: the same bytes for the same run, however many workers flew it.

No wall times, no machine names, keys in a fixed order, paths relative to the mission file. docs/report.md describes it.
"""

import math
from typing import Any

from checker.batch.result import MissionResult
from checker.conditions.rendering import condition_data
from checker.counterfactual.rendering import causes_data
from checker.coverage import Coverage
from checker.excerpts import Excerpts
from checker.explain import confirmation_data, place_data
from checker.findings import Fault, Findings
from checker.oracle import CODE_NAMES, Verdict
from checker.regression import FlownCase
from checker.rendering import failure_text
from checker.report.coverage import coverage_data
from checker.report.losses import mission_losses, tally_data
from checker.report.sentences import verdict_word
from checker.tally import Tally
from nddl_lang.text.values import json_text
from runtime.executive.configuration import ParameterConfiguration
from runtime.executive.rendering import element_text

_FORMAT = "nddlc-report/1"


def json_report(findings: Findings, excerpts: Excerpts, coverage: Coverage | None = None) -> str:
    """The report as JSON text."""
    data = _report_data(findings, excerpts)
    if coverage is not None:
        data["coverage"] = coverage_data(coverage)
    return json_text(data) + "\n"


def _report_data(findings: Findings, excerpts: Excerpts) -> dict[str, Any]:
    """The report as plain data."""
    rate, agent = findings.rate, findings.agent
    return {
        "format": _FORMAT,
        "run": findings.run_id,
        "name": agent.name,
        "seed": findings.seed,
        "planned": findings.planned,
        "verdict": verdict_word(findings),
        "counts": {verdict.value.lower(): findings.count(verdict) for verdict in Verdict},
        "rate": {
            "observed": rate.observed if rate.counted else None,
            "limit": rate.limit,
            "exceeds": rate.exceeds,
            "is_certain": rate.is_certain,
            "confidence": rate.confidence,
            "interval": None if rate.interval is None else list(rate.interval),
            "method": rate.method.value,
            "counted": rate.counted,
            "counted_failures": rate.counted_failures,
        },
        "ending": findings.ending.value,
        "sampling": {
            "sampler": findings.sampling.name,
            "rule": findings.sampling.rule or None,
            "shown": findings.sampling.shown,
        },
        "sensitivity": [
            {"parameter": one.parameter, "distance": one.distance, "interval": list(one.interval)}
            for one in findings.sensitivities
        ],
        "cases": [_case(one, findings.tally) for one in findings.cases],
        "losses": tally_data(findings.tally, excerpts),
        "limits": {limit.value: most for limit, most in findings.mission.check.limits},
        "parameters": [_parameter(parameter) for parameter in agent.parameters],
        "faults": [_fault(fault, excerpts) for fault in findings.faults],
        "missions": [_mission(result, findings.tally) for result in findings.results],
    }


def _parameter(parameter: ParameterConfiguration) -> dict[str, Any]:
    return {
        "name": parameter.name,
        "range": [parameter.lower, parameter.upper],
        "distribution": parameter.distribution,
        "mode": parameter.mode,
        "update": parameter.update if parameter.mode == "intra" else None,
        "clip": None if parameter.clip is None else [_finite(bound) for bound in parameter.clip],
        "kind": "int" if parameter.is_whole else "float",
        "values": list(parameter.values),
        "weights": list(parameter.weights),
    }


def _fault(fault: Fault, excerpts: Excerpts) -> dict[str, Any]:
    bucket, culprit = fault.bucket, fault.bucket.culprit
    return {
        "code": bucket.code,
        "meaning": CODE_NAMES.get(bucket.code),
        "reason": failure_text(bucket.judgement, bucket.open_goals, bucket.refusal),
        "reactor": bucket.reactor,
        "place": place_data(culprit.place, excerpts),
        "because": element_text(culprit.element) if culprit.element is not None else "",
        "limits": [place_data(limit, excerpts) for limit in culprit.limits],
        "count": len(bucket.missions),
        "share": bucket.share,
        "interval": None if fault.interval is None else list(fault.interval),
        "example": bucket.example,
        "missions": list(bucket.missions),
        "ticks": [bucket.first_tick, bucket.last_tick],
        "causes": causes_data(fault.causes),
        "condition": condition_data(fault.condition),
        "z3": confirmation_data(fault.confirmation),
    }


def _case(one: FlownCase, tally: Tally) -> dict[str, Any]:
    return {"name": one.case.name or None, "was": one.case.was, "passes": one.passes, **_mission(one.result, tally)}


def _mission(result: MissionResult, tally: Tally) -> dict[str, Any]:
    outcome = result.outcome
    return {
        "mission": result.number,
        "seed": result.seed,
        "role": result.point.role.value,
        "weight": result.point.weight,
        "verdict": result.verdict.value,
        "code": result.judgement.code,
        "reason": failure_text(result.judgement, result.open_goals),
        "last_tick": None if outcome is None else outcome.last_tick,
        "losses": None if outcome is None else mission_losses(result, tally),
        "properties": {
            one.name: {"kept": one.is_kept, "tick": one.tick, "margin": _finite(one.margin)}
            for one in (outcome.properties if outcome is not None else ())
        },
        "draws": []
        if outcome is None
        else [
            {"parameter": draw.parameter, "tick": draw.tick, "raw": draw.raw, "value": draw.value}
            for draw in outcome.draws
        ],
    }


def _finite(bound: float) -> float | str:
    """A bound as JSON can say it."""
    return bound if math.isfinite(bound) else ("inf" if bound > 0 else "-inf")
