"""Diagnostics in, a JUnit file out, for CI systems that show one test case per file."""

from collections.abc import Iterable, Sequence
from xml.etree import ElementTree

from nddl_lang.text.diagnostic import Diagnostic, Severity
from nddl_lang.text.render import render


def junit_of(files: Sequence[str], diagnostics: Iterable[Diagnostic], limit: Severity) -> str:
    """One test case per file, which fails by each finding that weighs `limit` or more; others are its output."""
    order = list(Severity)
    found: dict[str, list[Diagnostic]] = {name: [] for name in files}
    for each in diagnostics:
        found.setdefault(each.span.source.name, []).append(each)
    suite = ElementTree.Element("testsuite", {"name": "nddlc lint"})
    failures = 0
    for name, findings in found.items():
        case = ElementTree.SubElement(suite, "testcase", {"classname": "nddlc lint", "name": printable(name)})
        failing = [each for each in findings if order.index(each.severity) <= order.index(limit)]
        if failing:
            failures += 1
            first = failing[0]
            message = f"{first.code.id}: {first.message}"
            failure = ElementTree.SubElement(case, "failure", {"type": first.code.id, "message": printable(message)})
            failure.text = printable("\n".join(render(each) for each in failing))
        if rest := [each for each in findings if each not in failing]:
            output = ElementTree.SubElement(case, "system-out")
            output.text = printable("\n".join(render(each) for each in rest))
    counts = {"tests": str(len(found)), "failures": str(failures), "errors": "0"}
    suite.attrib.update(counts)
    suites = ElementTree.Element("testsuites", counts)
    suites.append(suite)
    return junit_text(suites)


def junit_text(suites: ElementTree.Element) -> str:
    """The text of a JUnit file."""
    ElementTree.indent(suites)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ElementTree.tostring(suites, encoding="unicode") + "\n"


def printable(text: str) -> str:
    """`text` without the characters that XML cannot hold."""
    return "".join(
        letter if letter.isprintable() or letter in "\n\t" else "\N{REPLACEMENT CHARACTER}" for letter in text
    )
