"""Parts of expressions are the judge's own: what it cannot tell of them is no fault of whoever executed the line."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from checker.judge.rendering import disagreement_text
from nddlc.validate import command
from runtime.executive.configuration import GoalConfiguration
from tests.executive.flying import Flown, flown, planner, simulator

BATTERY = Path(__file__).parents[3] / "models" / "templates" / "battery"
ROAD = """
int PAUSE = 10;
class Truck extends AgentTimeline {
    predicate Parked { } predicate Drive { float metres; } predicate Turn { } Truck(Mode m) { super(m, "Parked"); }
}
class Run extends AgentTimeline { predicate None { } predicate Clear { } Run(Mode m) { super(m, "None"); } }
"""


def driven(clear: str, drive: str) -> Flown:
    """A flight of a driver whose rule for `Clear`, and a truck whose rule for `Drive`, have these bodies."""
    driver = f"{ROAD} Run::Clear {{ {clear} }} Run run = new Run(Internal); Truck truck = new Truck(External); close();"
    rules = f"Truck::Drive {{ {drive} }} Truck::Turn {{ duration == 36; }}"
    world = f"{ROAD} {rules} Truck truck = new Truck(Internal); close();"
    goal = GoalConfiguration("run", "Clear", start=(10, 40))
    flyers = (planner("driver", driver, "run", "truck", latency=1, lookahead=300), simulator("world", world, "truck"))
    return flown(*flyers, until=300, goals=(goal,))


OPEN = "float time; metres >= 0.5; metres <= 960.0; duration >= 20; duration <= 30; "


@pytest.mark.parametrize(
    "body",
    [
        "mulEq(7.0, time, metres); duration == ceil(time) - 3;",
        "mulEq(7.0, time, metres); 2.0 * duration == 2.0 * floor(time) + 6.0;",
        "eq(duration + 1.0, sqrt(metres) + 1.0);",
        "duration == abs(ceil(metres)) + 3;",
        "duration == max(ceil(metres), 20) + 1;",
        "duration + 2.0 == metres * metres;",
        "duration + 1.0 == metres + time;",
    ],
)
def test_an_argument_that_nobody_gave_may_stay_open_below_a_function(body: str) -> None:
    flight = driven("contains(Truck.Drive out); out.end == end;", OPEN + body)
    assert [disagreement_text(one) for one in flight.report.disagreements] == []


def test_a_sum_with_what_a_repair_has_forgotten_binds_nobody() -> None:
    clear = "contains(Truck.Drive out); contains(Truck.Turn turn); out before turn;"
    more = "turn.start <= out.end + PAUSE; turn.duration <= 25; turn.end == end;"
    flight = driven(f"{clear} {more}", "duration == 40;")
    assert [disagreement_text(one) for one in flight.report.disagreements] == []
    assert any(each.fate == "cut" for reactor in flight.record.reactors for each in reactor.tokens)


def test_a_record_with_endless_limits_is_written_and_read(tmp_path: Path) -> None:
    mission, record = BATTERY / "mission.toml", tmp_path / "record.json"
    done = CliRunner().invoke(command, [str(mission), "--record", str(record)], standalone_mode=False)
    assert (done.exception, done.return_value) == (None, 0)
    members = [each["members"] for each in json.loads(record.read_text(encoding="utf-8"))["reactors"]]
    assert any("inf" in values for each in members for values in each.values())
    again = CliRunner().invoke(command, [str(record), "--mission", str(mission)], standalone_mode=False)
    assert (again.exception, again.return_value) == (None, 0)
    assert again.output == done.output
