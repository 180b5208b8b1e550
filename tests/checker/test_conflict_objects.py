"""Conflicts about members of objects: z3 is told what each side is."""

from pathlib import Path

import pytest

from checker.batch.result import MissionResult
from checker.batch.worker import fly_one
from checker.broken_plans import blamed
from checker.campaign import Campaign
from checker.mission import read_mission
from checker.models import load_models
from checker.pinned import pinned
from checker.proofs.claims import bounds_claim
from checker.proofs.conflict import Confirmation, Finding, confirm
from checker.proofs.operands import Symbols
from runtime.plan.readout.statements import Term

pytestmark = pytest.mark.once

MODEL = """#include "TREX.nddl"
enum Side {{ upper, lower }}
class Gate {{ Side side; float width; Gate(Side s, float w) {{ side = s; width = w; }} }}
class Plot {{ Side side; Plot(Side s) {{ side = s; }} }}
class Duty extends AgentTimeline {{
    predicate Idle {{ }}
    predicate Water {{ Plot plot; }}
    Duty(Mode m) {{ super(m, "Idle"); }}
}}
Duty::Water {{
    Gate gate;
    {rule}
    duration == 5;
}}
Gate north = new Gate(upper, 2.0);
Gate west = new Gate(lower, 1.2);
Gate east = new Gate(upper, 1.0);
Plot paddy = new Plot({side});
Duty duty = new Duty(Internal);
close();
"""
MISSION = """
[mission]
name = "ditch"
final_tick = 40
[[reactor]]
name = "warden"
model = "warden.nddl"
latency = 0
lookahead = 40
internal = ["duty"]
[[goal]]
timeline = "duty"
predicate = "Water"
mandatory = true
start = [5, 10]
[goal.parameters]
plot = "paddy"
[check]
missions = 1
"""


def failed_with(folder: Path, rule: str, side: str) -> tuple[Campaign, MissionResult]:
    """A mission that has no plan for its watering."""
    (folder / "warden.nddl").write_text(MODEL.format(rule=rule, side=side))
    (folder / "mission.toml").write_text(MISSION)
    mission, found = read_mission(folder / "mission.toml")
    assert mission is not None, found
    models = load_models(mission)
    assert not models.has_errors, models.diagnostics
    given = Campaign(mission, models, pinned(models))
    return given, given.judged(fly_one(given.load(models.agent), given.task(1), keep_trace=True))


def confirmation(folder: Path, rule: str, side: str = "upper") -> Confirmation:
    """z3's word on why no plan has such a watering."""
    given, failed = failed_with(folder, rule, side)
    conflict = blamed(failed).conflict
    assert conflict is not None
    return confirm(conflict, given._text())


def test_two_members_of_one_name_are_two_numbers(tmp_path: Path) -> None:
    """Both sides of `gate.side != plot.side` were taken for one of them, so that it could never hold."""
    found = confirmation(tmp_path, "gate.side != plot.side; gate.width >= 1.5;")
    assert found.finding is Finding.CONFIRMED and found.is_minimal
    assert len(found.core) >= 6  # the sides, the widths, and which gates there are


def test_one_member_may_be_equal_to_another(tmp_path: Path) -> None:
    found = confirmation(tmp_path, "gate.side == plot.side; gate.width >= 1.5;", side="lower")
    assert found.finding is Finding.CONFIRMED and len(found.core) >= 6


def test_a_number_of_a_constructor_is_told_with_the_line_that_made_the_object(tmp_path: Path) -> None:
    given, failed = failed_with(tmp_path, "gate.side != plot.side; gate.width >= 1.5;", "upper")
    steps = given.story(failed, None).steps
    made = {one.place.text: one.made.text for one in steps if one.place is not None and one.made is not None}
    assert made.keys() <= {"width = w;", "side = s;"} and made
    assert all(" = new " in text for text in made.values())


@pytest.mark.parametrize("bounds", [(float("inf"), float("inf")), (-float("inf"), -float("inf"))])
def test_z3_is_told_nothing_of_a_bound_without_end(bounds: tuple[float, float]) -> None:
    symbols = Symbols()
    claim = bounds_claim(Term("bounds", ("x", *bounds)), lambda _: symbols.variable("x", "float"))
    assert claim.num_args() == 0
