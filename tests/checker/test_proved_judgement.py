"""z3's judgement: what the text of a model demands of the values of a record, asked of z3."""

import json
from pathlib import Path
from random import Random
from typing import Any

import pytest

from checker.judge.draws import Chance
from checker.proofs.judgement import ProvedJudgement, prove_record
from nddlc.main import run
from runtime.executive.configuration import GoalConfiguration
from tests.checker.judge.corruption import ALTERATIONS, again
from tests.checker.judge.missions import GPS, MISSIONS
from tests.executive.flying import Flown, flown, planner

pytestmark = pytest.mark.once

MODEL = """
enum Tone { low, high }
class Oven extends Timeline { predicate Heat { int level; float warmth; Tone tone; } }
class Table extends Timeline { predicate Served { float warmth; } }
Oven::Heat {
  duration >= 5;
  warmth == 20.0 + level * 10.5;
  if (level >= 4) { tone == high; } else { tone == low; }
  before [1 3] (Table.Served s);
  s.warmth <= warmth;
}
Oven oven = new Oven();
Table table = new Table();
close();
"""


def proved(mission: Flown) -> ProvedJudgement:
    chance = Chance(mission.agent, mission.programs, mission.outcome.seed, {})
    draws = {each.name: float(str(chance.draw(each.name, 0))) for each in mission.agent.parameters}
    return prove_record(mission.agent, mission.programs, mission.record, draws)


@pytest.mark.parametrize("name", MISSIONS)
def test_z3_agrees_that_right_missions_hold(name: str) -> None:
    for seed in (0, 1):
        found = proved(MISSIONS[name](seed))
        assert found.holds > 100 and not found.broken and not found.undecided


@pytest.mark.parametrize("name", MISSIONS)
def test_z3_objects_to_nothing_that_the_judge_accepts(name: str) -> None:
    mission = MISSIONS[name](0)
    both, judge_alone = 0, 0
    for alter in ALTERATIONS:
        for number in range(3):
            changed = alter(mission, Random(f"{name} {alter.__name__} {number}"))
            if changed is None:
                continue
            found, report = proved(changed), again(changed)
            assert not (found.broken and report.holds), (alter.__name__, number, found.broken)
            both += bool(found.broken)
            judge_alone += not report.holds and not found.broken
    # Missing tokens, other branches, and what was published are for the judge alone.
    assert both >= 12 and judge_alone <= 2 * both


def plan(folder: Path, **arguments: Any) -> str:
    """A plan for the oven, as a file beside its model."""
    (folder / "oven.nddl").write_text(MODEL, encoding="utf-8")
    given = {"level": 5, "warmth": 72.5, "tone": "high"} | arguments
    tokens = [
        {"predicate": "Oven.Heat", "object": "oven", "start": 0, "end": 10, "arguments": given},
        {"predicate": "Table.Served", "object": "table", "start": 12, "end": 20, "arguments": {"warmth": 60.0}},
    ]
    path = folder / "plan.json"
    path.write_text(json.dumps({"model": "oven.nddl", "tokens": tokens}), encoding="utf-8")
    return str(path)


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (
            {"warmth": 70.0},
            "`warmth == 20.0 + level * 10.5` cannot hold (Oven.Heat#0): plan:0.level = 5, ",
        ),
        ({"tone": "low"}, "`tone == high` cannot hold (Oven.Heat#0): plan:0.tone = low"),
        ({"level": 3, "warmth": 51.5, "tone": "low"}, "`s.warmth <= warmth` cannot hold (Oven.Heat#0)"),
        ({"warmth": {"between": [80, 90]}}, ""),
    ],
)
def test_z3_names_the_line_that_a_plan_breaks(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], arguments: dict[str, Any], line: str
) -> None:
    assert run(["validate", plan(tmp_path, **arguments), "--smt"]) == 1
    assert line in capsys.readouterr().out


def test_z3_proves_a_right_plan(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for arguments in ({}, {"warmth": {"between": [60, 90]}}, {"tone": {"one_of": ["low", "high"]}}):
        assert run(["validate", plan(tmp_path, **arguments), "--smt", "--format", "json"]) == 0
        found = json.loads(capsys.readouterr().out)["smt"]
        assert found["holds"] > 10 and found["broken"] == [] and found["untold"] == {}


def test_z3_judges_a_mission_file(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["validate", str(GPS), "--seed", "4", "--smt"]) == 0
    assert "demands of the model hold, 0 broken, 0 undecided" in capsys.readouterr().out


def test_a_goal_in_the_window_of_another_has_its_own_arguments() -> None:
    """A token that starts where two goals may was told to have the arguments of both."""
    model = """
    class Job extends AgentTimeline {
        predicate Rest { }
        predicate Make { int n; float w; }
        Job(Mode m) { super(m, "Rest"); }
    }
    Job::Make { duration == 5; }
    Job job = new Job(Internal);
    close();
    """
    goals = tuple(
        GoalConfiguration(
            "job", "Make", start=(2, 30), mandatory=True, parameters=(("n", n), ("w", (0.5 * n, 2.0 * n)))
        )
        for n in (1, 4)
    )
    mission = flown(planner("maker", model, "job"), until=40, goals=goals)
    found = proved(mission)
    assert found.holds > 10 and not found.broken and not found.undecided
