"""Where a reactor is not determined, the choice is named with its line."""

import pytest

from compiler.determined.analysis import DeterminismAnalysis, analyse
from compiler.determined.code import Line
from compiler.determined.pages import DETERMINED_PAGES
from compiler.determined.reasons import ChoiceReason, FreeChoice
from compiler.lower import compile_model
from nddl_lang.analysis import analyse_text
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.text.page import RulePage

HEAD = '#include "TREX.nddl"\n'
ARM = """class Arm extends AgentTimeline { predicate Rest { } predicate Act { int n; float w; }
  Arm(Mode m) { super(m, "Rest"); } }
class Eye extends AgentTimeline { predicate Off { } predicate Sees { int n; } Eye(Mode m) { super(m, "Off"); } }
float DRAW = [0.0 1.0];
"""
LINES = (Line("arm", "Arm", "Rest", "own"), Line("eye", "Eye", "Off", "own"))


def looked_at(rule: str, lines: tuple[Line, ...] = LINES, lookahead: int = 1) -> DeterminismAnalysis:
    """What is found out about a rule of `Arm::Act`."""
    text = f"{HEAD}{ARM}Arm::Act {{\n{rule}\n}}\nArm arm = new Arm(Internal);\nEye eye = new Eye(Internal);\nclose();\n"
    analysis = analyse_text("arm", text, Dialect.NDDLC)
    assert not analysis.has_errors
    return analyse(compile_model(analysis), lines, lookahead)


@pytest.mark.parametrize(
    "rule",
    [
        "duration == n;",
        "duration == n + 3;",
        "end <= start + n;",
        "equals(Eye.Sees e); e.n == n;",
        "meets(Eye.Sees e); e.n == n;",
        "contained_by(Eye.Sees e); duration == e.n;",
        "float d; d == sampledParameter(DRAW); int t; t == ceil(d * w); duration == t;",
        "if (n == 3) { duration == 2; } else { duration == 4; }",
        "met_by(object.Rest r);",
        "duration == sampledParameter(DRAW);",
        "int k; k == n + 1; duration == k; meets(Eye.Sees e); e.n == n; e.duration == k + 3;",
        "meets(object.Rest r); r.duration == sampledParameter(DRAW);",
        "bool late; late == (w > 2.0); if (late) { meets(Eye.Off o); }",
    ],
)
def test_a_function_of_what_is_known_is_determined(rule: str) -> None:
    assert looked_at(rule).reasons == ()


@pytest.mark.parametrize(
    ("rule", "choice", "line"),
    [
        ("contains(Eye.Sees e);", FreeChoice.OPEN_TIMES, 7),
        ("any(Eye.Sees e);", FreeChoice.OPEN_TIMES, 7),
        ("int k;\nn < k;", FreeChoice.OPEN_VALUE, 8),
        ("bool b;", FreeChoice.OPEN_VALUE, 7),
        ("int k; k == n;\nif (start <= AGENT_CLOCK) { duration == k; }", FreeChoice.CLOCK, 8),
        ("float s;\nsinf(s, w);", FreeChoice.FUNCTION, 8),
        ("int k;\nk == duration + 1;\nk > 3;", FreeChoice.OPEN_VALUE, 8),
    ],
)
def test_a_choice_is_named_with_its_line(rule: str, choice: FreeChoice, line: int) -> None:
    (reason,) = looked_at(rule).reasons
    assert reason.choice is choice
    assert reason.span is not None and reason.span.line == line


def test_each_choice_has_advice() -> None:
    for choice in FreeChoice:
        assert ChoiceReason(choice, "x", None).advice


def test_two_timelines_of_one_class_are_a_choice() -> None:
    lines = (*LINES, Line("other", "Eye", "Off", "own"))
    (reason,) = looked_at("equals(Eye.Sees e);", lines).reasons
    assert reason.choice is FreeChoice.SEVERAL_OBJECTS


def test_who_asks_others_plans() -> None:
    (reason,) = looked_at("equals(Eye.Sees e);", (LINES[0], Line("eye", "Eye", "Off", "used"))).reasons
    assert reason.choice is FreeChoice.ASKED_OF_OTHERS


def test_who_looks_ahead_plans() -> None:
    (reason,) = looked_at("duration == n;", lookahead=10).reasons
    assert reason.choice is FreeChoice.LOOKAHEAD


@pytest.mark.parametrize("page", DETERMINED_PAGES, ids=lambda page: page.code.id)
def test_the_models_of_a_page_are_bad_and_good(page: RulePage) -> None:
    lines = (Line("arm", "Arm", "Rest", "own"),)
    found = []
    for text in (page.bad, page.good):
        analysis = analyse_text("model", text, Dialect.NDDLC)
        assert not analysis.has_errors
        found.append(analyse(compile_model(analysis), lines, 1).is_determined)
    assert found == [False, True]
