"""Findings in, a JUnit file out, for CI systems that show one test case per mission."""

from xml.etree import ElementTree

from checker.conditions.rendering import condition_claim
from checker.excerpts import Excerpts
from checker.findings import Findings
from checker.oracle import Verdict
from checker.rendering import failure_text
from checker.report.sentences import explained_by
from nddl_lang.text.junit import junit_text, printable


def junit_report(findings: Findings, excerpts: Excerpts) -> str:
    """One suite with a test case per mission; durations are left out, so that equal runs give equal files."""
    name = findings.agent.name
    counts = {
        "tests": str(len(findings.results)),
        "failures": str(findings.count(Verdict.FAIL)),
        "errors": str(findings.count(Verdict.ERROR)),
    }
    suites = ElementTree.Element("testsuites", counts)
    suite = ElementTree.SubElement(suites, "testsuite", {"name": name, **counts})
    faults = {mission: fault for fault in findings.faults for mission in fault.bucket.missions}
    for result in findings.results:
        attributes = {"classname": name, "name": f"mission {result.number} (seed {result.seed})"}
        case = ElementTree.SubElement(suite, "testcase", attributes)
        if result.verdict is Verdict.ERROR:
            ElementTree.SubElement(case, "error", {"message": printable(result.judgement.message)})
        elif result.verdict is Verdict.FAIL:
            fault = faults[result.number]
            message = f"{result.judgement.code}: {failure_text(result.judgement, result.open_goals)}"
            failure = ElementTree.SubElement(
                case, "failure", {"type": result.judgement.code, "message": printable(message)}
            )
            lines = [f"fails {condition_claim(fault.condition)}"] if fault.condition is not None else []
            for place in fault.places[:1]:
                lines.insert(0, f"{excerpts.path(place)}: {excerpts.line(place).strip()}")
            lines.append(explained_by(findings, result.number))
            failure.text = printable("\n".join(lines))
    return junit_text(suites)
