"""A line that is missing in one branch is told by what the other branch sets; lines at odds by what z3 needs."""

from pathlib import Path
from typing import Any

import pytest

from checker.counterfactual.branches import uneven_branches
from checker.counterfactual.dependence import Dependence
from checker.counterfactual.smallness import cost_of
from checker.counterfactual.usage import usage_of
from checker.mutation.edits import sites_of
from checker.mutation.kinds import EditKind
from checker.mutation.variant import load_graph
from compiler.lower import compile_model
from nddl_lang.analysis import analyse_file
from tests.checker.checked import faults_of

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
enum Load { light, heavy }
class Rope { float length; float strength; }
class Crane extends AgentTimeline {
  predicate Idle { }
  predicate Lift { Load load; }
  predicate Lower { Load load; int slack; }
  Crane(Mode m) { super(m, "Idle"); }
}
int SWING = [2 6];
int HEAVY_TIME = 40;
int LIGHT_TIME = 20;
Crane::Lift {
  meets(object.Lower lower);
  lower.load == load;
  if (load == Load.heavy) {
    lower.slack == 8;
    duration == HEAVY_TIME;
  } else {
    lower.slack == 2;
    duration == LIGHT_TIME;
  }
}
Crane::Lower {
  int swing;
  swing == sampledParameter(SWING);
  slack < 12;
  duration == 10 + slack + swing;
}
Crane crane = new Crane(Internal);
close();
"""
MISSION = """[mission]
name = "crane"
final_tick = 200
[[reactor]]
name = "sim"
model = "crane.nddl"
latency = 0
lookahead = 1
internal = ["crane"]
[[goal]]
timeline = "crane"
predicate = "Lift"
mandatory = true
start = 10
[goal.parameters]
load = "light"
[[property]]
name = "put down in time"
kind = "reached"
timeline = "crane"
predicate = "Lower"
by = 100
[check]
missions = 6
"""


LIGHT_TIME = "    duration == LIGHT_TIME;\n"


def causes(folder: Path, capsys: pytest.CaptureFixture[str], model: str) -> list[dict[str, Any]]:
    """The ranked causes of the first fault; none where all missions pass."""
    faults = faults_of(folder, capsys, {"crane.nddl": model, "mission.toml": MISSION})
    found: list[dict[str, Any]] = faults[0]["causes"]["ranked"] if faults else []
    return found


def test_a_line_of_a_branch_leads_to_its_condition(tmp_path: Path) -> None:
    (tmp_path / "crane.nddl").write_text(MODEL)
    analysis = analyse_file(tmp_path / "crane.nddl")
    sites = sites_of(load_graph(tmp_path / "crane.nddl", ()))
    graph = Dependence([compile_model(analysis)], sites)
    (number,) = (number for number, site in enumerate(sites) if site.text == "duration == HEAVY_TIME;")
    assert [sites[one].text for one in graph.conditions(number)] == ["load == Load.heavy"]


def test_the_model_is_right_as_it_stands(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert causes(tmp_path, capsys, MODEL) == []


@pytest.mark.parametrize(
    "line", ["    duration == LIGHT_TIME;\n", "    lower.slack == 2;\n    duration == LIGHT_TIME;\n"]
)
def test_a_branch_that_lacks_what_the_other_sets_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], line: str
) -> None:
    found = causes(tmp_path, capsys, MODEL.replace(line, ""))
    told = [one["text"] for one in found[:3] if one["claim"] == "uneven branches"]
    assert told == ["load == Load.heavy"]


def test_a_condition_without_else_is_not_uneven(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model = MODEL.replace(MODEL[MODEL.index("  } else {") : MODEL.index("}\nCrane::Lower")], "  }\n  duration >= 1;\n")
    found = causes(tmp_path, capsys, model)
    assert found
    assert all(one["claim"] != "uneven branches" for one in found)


@pytest.mark.parametrize(("line", "told"), [("rest == 3;", ["rest"]), ("lower.slack == 3;", []), ("rest <= 3;", [])])
def test_a_condition_without_else_leaves_a_variable_of_the_rule_open(
    tmp_path: Path, line: str, told: list[str]
) -> None:
    rule = f"  int rest;\n  if (load == Load.heavy) {{\n    {line}\n  }}\n  duration == rest;\n"
    assert uneven_in(tmp_path, rule) == told


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("end <= 150;", []),
        ("lower.end >= HEAVY_TIME;", []),
        ("150 > start;", []),
        ("start == 150;", ["start"]),
        ("duration <= 15;", ["duration"]),
        ("lower.slack <= 2;", ["lower.slack"]),
    ],
)
def test_a_deadline_on_one_branch_is_nothing_that_the_other_lacks(tmp_path: Path, line: str, told: list[str]) -> None:
    assert [one for one in uneven(tmp_path, line, "object == object;") if one != "object"] == told


def test_what_both_branches_hold_to_one_time_is_said_in_both(tmp_path: Path) -> None:
    assert uneven(tmp_path, "meets(object.Idle rest); rest.start == end;", "lower.start == end;") == []
    assert uneven(tmp_path, "lower.end == HEAVY_TIME;", "lower.start == end;") == ["lower.end", "lower.start"]


def test_a_variable_that_a_branch_declares_is_its_own(tmp_path: Path) -> None:
    assert uneven(tmp_path, "float rest; rest == 3.0; duration == ceil(rest);", "duration == 4;") == []


@pytest.mark.parametrize(("sign", "told"), [(">=", []), ("==", ["rope.length"])])
def test_what_a_chosen_object_must_be_like_is_no_value_that_the_other_branch_lacks(
    tmp_path: Path, sign: str, told: list[str]
) -> None:
    rule = f"""  Rope rope;
  rope.strength >= 2.0;
  if (load == Load.heavy) {{
    duration == 40;
    rope.length {sign} 9.0;
  }} else {{
    duration == 20;
  }}
"""
    assert uneven_in(tmp_path, rule) == told


def uneven(folder: Path, line: str, other: str) -> list[str]:
    """What one branch sets, with a line in the first and another one in the second."""
    return uneven_in(folder, f"  if (load == Load.heavy) {{\n    {line}\n  }} else {{\n    {other}\n  }}\n")


def uneven_in(folder: Path, rule: str) -> list[str]:
    """What one branch sets and the other does not, with other lines in place of those under the condition."""
    path = folder / "crane.nddl"
    path.write_text(MODEL.replace(MODEL[MODEL.index("  if (load") : MODEL.index("}\nCrane::Lower")], rule))
    graph = Dependence([compile_model(analyse_file(path))], sites_of(load_graph(path, ())))
    return [one.variable for one in uneven_branches(graph)]


def test_a_sign_between_the_same_words_is_meant_as_elsewhere(tmp_path: Path) -> None:
    text = """class T extends Timeline { predicate P { int n; } predicate Q { int n; } }
T::P { int a; a == n * (1 + n); duration == a; }
T::Q { int a; int b; a == n * (1 - n); b == n + 3; duration == a; }
"""
    (tmp_path / "m.nddl").write_text(text, encoding="utf-8")
    sites = sites_of(load_graph(tmp_path / "m.nddl", ()))
    costs = {
        (site.text, edit.old): cost_of(edit, site, usage_of(sites))
        for site in sites
        for edit in site.edits
        if edit.kind is EditKind.SIGN
    }
    wrong = costs["a == n * (1 - n);", "-"]
    assert wrong < costs["b == n + 3;", "+"]


def test_a_limit_belongs_to_lines_about_the_token_whose_name_it_bears(tmp_path: Path) -> None:
    text = """int LIFT_MAX = 40;
int GRACE = 5;
class T extends Timeline { predicate Lift { } predicate P { } }
T::P {
  contains(T.Lift up);
  contains(T.Lift down);
  up.duration <= LIFT_MAX;
  down.start <= up.end + GRACE;
  down.duration <= GRACE;
}
"""
    (tmp_path / "m.nddl").write_text(text, encoding="utf-8")
    sites = sites_of(load_graph(tmp_path / "m.nddl", ()))
    usage = usage_of(sites)
    gains = {
        site.text: usage.gain(edit, site)
        for site in sites
        for edit in site.edits
        if edit.kind is EditKind.LIMIT and (edit.old, edit.new) == ("GRACE", "LIFT_MAX")
    }
    assert gains["down.duration <= GRACE;"] > 0.0
