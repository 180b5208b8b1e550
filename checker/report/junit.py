"""Findings in, a JUnit file out, for CI systems that show one test case per mission and regression case."""

from xml.etree import ElementTree

from checker.batch.result import MissionResult
from checker.conditions.rendering import condition_claim
from checker.excerpts import Excerpts
from checker.findings import Fault, Findings
from checker.oracle import Verdict
from checker.rendering import failure_text
from checker.report.sentences import case_name, decision, explained_by
from nddl_lang.text.junit import junit_text, printable


def junit_report(findings: Findings, excerpts: Excerpts) -> str:
    """A test case per mission and per regression case; durations are left out, so that equal runs give equal files."""
    name = findings.agent.name
    suites = ElementTree.Element("testsuites")
    suite = ElementTree.SubElement(suites, "testsuite", {"name": name})
    for flown in findings.cases:
        case = _test(suite, f"{name}: regression cases", f"{case_name(flown)} (seed {flown.result.seed})")
        if not flown.passes:
            was = [f"it was kept for {flown.case.was}"] if flown.case.was else []
            _fail(case, flown.result, was)
    faults = {mission: fault for fault in findings.faults for mission in fault.bucket.missions}
    for result in findings.results:
        case = _test(suite, name, f"mission {result.number} (seed {result.seed})")
        if result.verdict is Verdict.FAIL:
            _fail(case, result, _known_of(faults[result.number], result.number, findings, excerpts))
        elif result.verdict is Verdict.ERROR:
            _fail(case, result, [])
    if findings.is_unknown and not findings.errors:
        case = _test(suite, name, "all missions")
        ElementTree.SubElement(case, "error", {"message": printable(decision(findings))})
    counts = {"tests": "testcase", "failures": "testcase/failure", "errors": "testcase/error"}
    totals = {key: str(len(suite.findall(tag))) for key, tag in counts.items()}
    suite.attrib.update(totals)
    suites.attrib.update(totals)
    return junit_text(suites)


def _test(suite: ElementTree.Element, group: str, name: str) -> ElementTree.Element:
    return ElementTree.SubElement(suite, "testcase", {"classname": printable(group), "name": printable(name)})


def _fail(case: ElementTree.Element, result: MissionResult, known: list[str]) -> None:
    """Say why a mission did not pass, with what is known of it."""
    why = failure_text(result.judgement, result.open_goals)
    if result.verdict is Verdict.ERROR:
        ElementTree.SubElement(case, "error", {"message": printable(why)})
        return
    code = result.judgement.code
    failure = ElementTree.SubElement(case, "failure", {"type": code, "message": printable(f"{code}: {why}")})
    failure.text = printable("\n".join(known))


def _known_of(fault: Fault, mission: int, findings: Findings, excerpts: Excerpts) -> list[str]:
    lines = [f"{excerpts.path(place)}: {excerpts.line(place).strip()}" for place in fault.places[:1]]
    lines += [f"fails {condition_claim(fault.condition)}"] if fault.condition is not None else []
    return [*lines, explained_by(findings, mission)]
