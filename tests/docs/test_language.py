"""The language guide tells the truth: each of its examples is loaded, and refused where it says so."""

import re
from pathlib import Path

import pytest

import runtime.build_form
from compiler.lower import compile_model
from nddl_lang.analysis import analyse_text
from nddl_lang.syntax.words import RESERVED
from nddl_lang.text.diagnostic import Severity
from runtime.plan.database import PlanDatabase

GUIDE = Path(__file__).parents[2] / "docs" / "language.md"
EXAMPLES = re.findall(
    r"(?:^\*refused: (NDDL\d+)\*\n\n)?^```nddl\n(.*?)^```$", GUIDE.read_text(encoding="utf-8"), re.M | re.S
)


def errors_of(text: str) -> list[str]:
    """The codes that refuse a program, by its analysis or, if that finds nothing, by running it."""
    analysis = analyse_text("example.nddl", text)
    found = [one.code.id for one in analysis.diagnostics if one.severity is Severity.ERROR]
    if found:
        return found
    fault = PlanDatabase(compile_model(analysis)).run_script()
    return [] if fault is None else [fault.code.id]


@pytest.mark.parametrize(("code", "text"), EXAMPLES, ids=[str(number + 1) for number in range(len(EXAMPLES))])
def test_an_example_of_the_guide_is_as_it_says(code: str, text: str) -> None:
    assert errors_of(text) == ([code] if code else [])


@pytest.mark.parametrize("text", [text for code, text in EXAMPLES if not code])
def test_an_example_of_the_guide_is_consistent(text: str) -> None:
    database = PlanDatabase(compile_model(analyse_text("example.nddl", text)))
    database.run_script()
    assert database.is_consistent


def test_the_guide_has_an_example_of_each_relation_and_statement() -> None:
    assert len(EXAMPLES) >= 35


def test_the_guide_names_all_reserved_words() -> None:
    (part,) = re.findall(r"^## Names\n(.*?)^## ", GUIDE.read_text(encoding="utf-8"), re.M | re.S)
    assert set(re.findall(r"`(\w+)`", part)) == RESERVED
