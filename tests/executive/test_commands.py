"""Reactors in Python that take commands: a vehicle whose physics is a program, under a planner."""

from pathlib import Path

import pytest

from checker.mission import read_mission
from checker.models import load_models
from checker.one_flight import FlightSettings, fly
from checker.pinned import pinned
from runtime.executive.mission import record_mission
from runtime.executive.outcome import EventKind, Outcome
from runtime.executive.rendering import trace_line
from tests.executive.flying import history, lines

pytestmark = pytest.mark.once

SHARED = """#include "TREX.nddl"
class Drive extends AgentTimeline {
    predicate Stopped { }
    predicate Go { float way; }
    Drive(Mode m) { super(m, "Stopped"); }
}
class Trip extends AgentTimeline {
    predicate Rest { }
    predicate Ride { float way; }
    Trip(Mode m) { super(m, "Rest"); }
}
"""
PLANNER = """#include "shared.nddl"
Trip::Ride { contains(Drive.Go go); go.way == way; go.end == end; duration <= LONGEST; meets(object.Rest rest); }
Trip trip = new Trip(Internal);
Drive drive = new Drive(External);
close();
"""
CODE = """
from runtime.user.reactor import Reactor

class Motor(Reactor):
    def __init__(self, settings):
        super().__init__(settings)
        self.left = None
        self.log = []

    def tick(self, now):
        if now.tick == 0:
            now.publish("drive", "Stopped")
        if self.left is not None:
            self.left -= self.settings["speed"]
            if self.left <= 0.0:
                now.publish("drive", "Stopped")
                self.left = None
            else:
                now.wake(now.tick + 1)
            return
        for command in now.commands:
            way = command.arguments["way"]
            if way > 100.0:
                now.decline(command.number, "too far")
            elif command.start[0] <= now.tick:
                self.left = way
                now.publish("drive", "Go", way=way)
                now.wake(now.tick + 1)
                break
"""
MISSION = """
[mission]
name = "trip"
final_tick = 60
[[reactor]]
name = "planner"
model = "planner.nddl"
latency = 1
lookahead = 60
internal = ["trip"]
external = ["drive"]
[[reactor]]
name = "motor"
code = "motor.py:Motor"
lookahead = {lookahead}
internal = ["drive"]
[reactor.settings]
speed = 2.5
"""
GOAL = """
[[goal]]
timeline = "{timeline}"
predicate = "{predicate}"
start = [{start}]
{more}
[goal.parameters]
way = {way}
"""


def flown(
    folder: Path, *goals: str, lookahead: int = 1, code: str = CODE, shared: str = SHARED, every_tick: bool = False
) -> Outcome:
    """A mission with these goals, flown twice: the second time the judge looks at it."""
    (folder / "shared.nddl").write_text(shared)
    (folder / "planner.nddl").write_text(PLANNER.replace("Trip::Ride", "int LONGEST = 20;\nTrip::Ride", 1))
    (folder / "motor.py").write_text(code)
    (folder / "mission.toml").write_text(MISSION.format(lookahead=lookahead) + "".join(goals))
    mission, found = read_mission(folder / "mission.toml")
    assert mission is not None, found
    models = load_models(mission)
    assert not models.has_errors, models.diagnostics
    load = pinned(models)
    outcome = record_mission(models.agent, load.programs_of(models.agent), 1, every_tick=every_tick)[0]
    judged = fly(mission, models, FlightSettings(1, {})).outcome
    assert [*map(trace_line, outcome.events)] == [*map(trace_line, judged.events)]
    return outcome


def ride(start: str, way: float, more: str = "mandatory = true") -> str:
    return GOAL.format(timeline="trip", predicate="Ride", start=start, way=way, more=more)


def drive(start: str, way: float, more: str = "") -> str:
    return GOAL.format(timeline="drive", predicate="Go", start=start, way=way, more=more)


@pytest.mark.parametrize("lookahead", [1, 10])
def test_a_planner_commands_a_vehicle_written_in_python(tmp_path: Path, lookahead: int) -> None:
    outcome = flown(tmp_path, ride("5, 8", 10.0), ride("20, 30", 25.0), lookahead=lookahead)
    assert history(outcome, "drive") == ["0 Stopped", "5 Go(way=10.0)", "9 Stopped", "20 Go(way=25.0)", "30 Stopped"]
    assert history(outcome, "trip") == ["0 Rest", "5 Ride(way=10.0)", "9 Rest", "20 Ride(way=25.0)", "30 Rest"]
    assert not outcome.open_goals and not lines(outcome, "relax")
    achieved = [event for event in outcome.events if event.kind is EventKind.ACHIEVED]
    assert [(one.reactor, one.tick) for one in achieved] == [
        ("motor", 9), ("planner", 9), ("motor", 30), ("planner", 30),
    ]  # fmt: skip


def test_what_begins_points_at_the_request_behind_it(tmp_path: Path) -> None:
    outcome = flown(tmp_path, ride("5, 8", 10.0))
    begun = next(one for one in outcome.events if one.kind is EventKind.OBSERVATION and one.predicate == "Go")
    assert [outcome.events[cause].kind for cause in begun.causes] == [EventKind.REQUEST]


def test_what_the_code_does_not_do_is_told_to_its_sender(tmp_path: Path) -> None:
    outcome = flown(tmp_path, ride("5, 8", 200.0))
    refused = lines(outcome, "refuse")
    assert len(refused) == 1 and "its code does not do it: too far" in refused[0]
    assert outcome.abort is not None and outcome.abort.code == "F6"


def test_a_vehicle_that_is_too_slow_breaks_the_plan(tmp_path: Path) -> None:
    outcome = flown(tmp_path, ride("5, 8", 80.0))
    assert outcome.abort is not None and outcome.abort.code == "F1" and outcome.abort.tick == 25


@pytest.mark.parametrize(("more", "achieved"), [("", True), ("end = [0, 8]", False), ("duration = [5, 9]", False)])
def test_a_goal_for_the_vehicle_itself(tmp_path: Path, more: str, achieved: bool) -> None:
    outcome = flown(tmp_path, drive("5, 8", 10.0, f"mandatory = true\n{more}"))
    assert history(outcome, "drive") == ["0 Stopped", "5 Go(way=10.0)", "9 Stopped"]
    assert [goal.timeline for goal in outcome.open_goals] == ([] if achieved else ["drive"])


def test_what_cannot_begin_in_time_is_given_up(tmp_path: Path) -> None:
    outcome = flown(tmp_path, drive("5, 5", 50.0), drive("6, 7", 10.0, "mandatory = true"))
    assert [line for line in lines(outcome, "reject") if line.startswith("8 ")]
    assert [goal.timeline for goal in outcome.open_goals] == ["drive"]


def test_a_command_that_is_taken_back_does_not_begin(tmp_path: Path) -> None:
    outcome = flown(tmp_path, drive("5, 5", 20.0), drive("6, 30", 10.0, "recall = 8\nmandatory = true"))
    assert history(outcome, "drive") == ["0 Stopped", "5 Go(way=20.0)", "13 Stopped"]
    assert not outcome.open_goals


def test_who_looks_not_ahead_takes_no_commands(tmp_path: Path) -> None:
    outcome = flown(tmp_path, drive("5, 8", 10.0), lookahead=0)
    assert "its owner does not look ahead" in lines(outcome, "refuse")[0]


def test_nobody_declines_what_does_not_wait(tmp_path: Path) -> None:
    outcome = flown(tmp_path, code=CODE.replace("if now.tick == 0:", "if now.tick == 0:\n            now.decline(7)"))
    assert outcome.abort is not None and outcome.abort.code == "F9"
    assert "declines command 7" in outcome.abort.reason.message


def test_the_code_is_called_at_the_same_ticks_whether_or_not_the_agent_sleeps(tmp_path: Path) -> None:
    goals = (ride("5, 8", 10.0), ride("20, 30", 25.0), drive("40, 50", 200.0), drive("52, 53", 5.0))
    one, other = (flown(tmp_path, *goals, lookahead=10, every_tick=each) for each in (False, True))
    assert tuple(one.events) == tuple(other.events)


def test_a_real_number_is_no_whole_one(tmp_path: Path) -> None:
    whole = SHARED.replace("predicate Go { float way; }", "predicate Go { int way; }")
    code = CODE.replace('now.publish("drive", "Stopped")', 'now.publish("drive", "Go", way=1.5)', 1)
    outcome = flown(tmp_path, code=code, shared=whole)
    assert outcome.abort is not None and outcome.abort.code == "F9"
    assert "1.5, which is no int" in outcome.abort.reason.message
