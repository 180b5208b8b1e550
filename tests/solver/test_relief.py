"""Levels are judged when nothing open may mend them; a verdict says no more than the search knows."""

import json
from pathlib import Path
from typing import Any

import pytest

from nddlc.main import run

HEAD = "Reservoir tank = new Reservoir({}, 0.0, 100.0);\nclass Rover extends Timeline {{ {} }}\n"
TAKE = "Rover::Take { ends(tank.consume c); c.quantity == 60.0; }\n"
GIVE = "Rover::Give { ends(tank.produce p); p.quantity == 60.0; }\n"
AFTER = "Rover r = new Rover();\nclose();\n"
TWO = "goal(r.Take a);\ngoal(r.Take b);\na.start = [0 300]; a.end = [0 400];\nb.start = [450 900]; b.end = [450 950];\n"
BOTH = "predicate Take { } predicate Give { }"


def planned(folder: Path, text: str, capsys: pytest.CaptureFixture[str], *options: str) -> dict[str, Any]:
    path = folder / "model.nddl"
    path.write_text(text, encoding="utf-8")
    code = run(["plan", "--json", *options, str(path)])
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return dict(found["solve"]) | {"code": code, "consistent": found["consistent"]}


CHAIN = HEAD.format("100.0", BOTH) + TAKE.replace("}", "meets(Give g); }") + GIVE + AFTER + TWO
RULES = {
    "a token that a rule asks for": CHAIN,
    "another goal": HEAD.format("100.0", BOTH)
    + TAKE
    + GIVE
    + AFTER
    + TWO
    + "goal(r.Give k);\nk.start = [0 440];\nk.end = [0 440];\n",
    "a chain of rules": HEAD.format("100.0", BOTH + " predicate Link { }")
    + TAKE.replace("}", "meets(Link l); }")
    + "Rover::Link { meets(Give g); }\n"
    + GIVE
    + AFTER
    + TWO,
    "a guard that waits": HEAD.format("100.0", "predicate Take { bool more; } predicate Give { }")
    + TAKE.replace("}", "if (more == true) { meets(Give g); } }")
    + GIVE
    + AFTER
    + TWO,
    "what takes from a full tank": HEAD.format("50.0", BOTH)
    + GIVE.replace("}", "met_by(Take t); leq(0, t.start); }")
    + TAKE.replace("60.0", "[0.0 50.0]")
    + AFTER
    + TWO.replace("Take", "Give").replace("[0 300]", "[10 300]"),
}


@pytest.mark.parametrize("name", RULES)
def test_what_is_open_may_mend_a_level(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = planned(tmp_path, RULES[name], capsys)
    assert (found["result"], found["code"]) == ("plan", 0)


def test_europa_judges_at_once_and_the_verdict_says_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = planned(tmp_path, CHAIN, capsys, "--strategy", "europa")
    assert (found["result"], found["is_complete"], found["code"]) == ("exhausted", False, 1)
    run(["plan", "--strategy", "europa", str(tmp_path / "model.nddl")])
    told = capsys.readouterr().out
    assert "EUROPA's search finds no plan" in told and "no plan exists" not in told


@pytest.mark.parametrize(
    "more",
    [
        "",  # nothing gives
        "goal(r.Give k);\nk.start = [910 920];\n",  # too late
        "rejectable(r.Give k);\nk.start = [910 920];\n",
    ],
)
def test_what_cannot_be_mended_is_found_out(more: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = HEAD.format("100.0", BOTH) + TAKE + GIVE + AFTER + TWO.replace("[450 900]", "[450 800]") + more
    found = planned(tmp_path, text.replace("[450 950]", "[450 850]"), capsys)
    assert (found["result"], found["is_complete"], found["code"]) == ("exhausted", True, 1)


def test_what_lies_outside_the_horizon_mends_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    more = "goal(r.Give k);\nk.start = [0 440];\nk.end = [5000 6000];\n"
    text = HEAD.format("100.0", BOTH) + TAKE + GIVE + AFTER + TWO + more
    assert planned(tmp_path, text, capsys)["result"] == "exhausted"


def test_a_model_whose_facts_alone_exceed_a_level_may_have_a_plan(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = HEAD.format("0.0", BOTH) + GIVE + AFTER + "goal(r.Give k);\nk.start = [0 300]; k.end = [0 400];\n"
    text += "fact(tank.consume c);\nc.time == 500;\nc.quantity == 50.0;\n"
    found = planned(tmp_path, text, capsys)
    assert (found["result"], found["code"], found["consistent"]) == ("plan", 0, False)
    assert run(["load", str(tmp_path / "model.nddl")]) == 1
    assert "which tokens that are still open may mend" in capsys.readouterr().out
    found = planned(tmp_path, text.replace("goal(", "// goal(").replace("k.start", "// "), capsys)
    assert (found["result"], found["is_complete"]) == ("exhausted", True)
    assert run(["load", str(tmp_path / "model.nddl")]) == 1
    assert "no plan can satisfy this model" in capsys.readouterr().out


def test_a_configuration_that_omits_choices_proves_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = "class L extends Timeline { predicate P { } }\nL l = new L();\nclose();\n"
    text += "goal(l.P a);\na.start = [0 9];\na.end = [1 20];\n"
    solver = tmp_path / "solver.toml"
    solver.write_text(
        '[[manager]]\ncomponent = "OpenConditionManager"\n[[manager.handler]]\n'
        'component = "HSTSOpenConditionDecisionPoint"\nchoice = "mergeOnly"\n',
        encoding="utf-8",
    )
    found = planned(tmp_path, text, capsys, "--config", str(solver))
    assert (found["result"], found["is_complete"]) == ("exhausted", False)
    run(["plan", "--config", str(solver), str(tmp_path / "model.nddl")])
    assert "it does not try all there are" in capsys.readouterr().out


def test_a_goal_beyond_the_horizon_is_a_finding(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = "class L extends Timeline { predicate P { } }\nL l = new L();\nclose();\n"
    late = text + "goal(l.P a);\na.start = [900 1100];\n"
    found = planned(tmp_path, late, capsys)
    assert (found["result"], found["unplanned"], found["code"]) == ("plan", ["a"], 1)
    assert planned(tmp_path, late, capsys, "--allow-unplanned")["code"] == 0
    assert planned(tmp_path, late, capsys, "--horizon", "0", "inf")["code"] == 0
    assert planned(tmp_path, late.replace("goal(", "rejectable("), capsys)["code"] == 0
    capsys.readouterr()
    assert planned(tmp_path, text + "goal(l.P);\n", capsys)["code"] == 1


ROVERS = "Rover r = new Rover();\nRover other = new Rover();\nclose();\n"
TAKES = HEAD.format("10.0", BOTH) + TAKE.replace("60.0", "8.0") + GIVE.replace("60.0", "8.0") + ROVERS
TAKES += "goal(r.Take a);\ngoal(r.Take b);\na.end = [1 5];\nb.end = [20 20];\ngoal(other.Give f);\nf.end = LATE;\n"


def test_a_level_that_the_times_leave_open_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = planned(tmp_path, TAKES.replace("LATE", "[6 100]"), capsys)
    # 10 - 8 by tick 5, and from tick 20 on 8 less; what is given may come as late as 100.
    assert found["open_levels"] == [{"resource": "tank", "tick": 20, "minimum": 0.0, "level": -6.0}]
    run(["plan", str(tmp_path / "model.nddl")])
    told = capsys.readouterr().out
    assert "the level of tank may fall to -6 at tick 20 (limit 0)" in told and "but 1 resource may leave" in told
    assert planned(tmp_path, TAKES.replace("LATE", "[6 20]"), capsys)["open_levels"] == []
