"""Parts of expressions are the judge's own: what it cannot tell of them is no fault of whoever executed the line."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from checker.judge.judge import judge_mission
from checker.judge.rendering import disagreement_text
from checker.mission import read_mission
from checker.models import load_models
from nddlc.validate import command
from runtime.executive.mission import record_mission
from tests.programs import programs_of

ROAD = """#include "TREX.nddl"
int PAUSE = 10;
class Truck extends AgentTimeline {
    predicate Parked { }
    predicate Drive { float metres; }
    predicate Turn { }
    Truck(Mode m) { super(m, "Parked"); }
}
class Run extends AgentTimeline {
    predicate None { }
    predicate Clear { }
    Run(Mode m) { super(m, "None"); }
}
"""
DRIVER = """
Reservoir tank = new Reservoir(1.0, 0.0, 5.0);
Run run = new Run(Internal);
Truck truck = new Truck(External);
close();
"""
WORLD = """#include "road.nddl"
Truck::Drive { %s }
Truck::Turn { duration == 36; }
Truck truck = new Truck(Internal);
close();
"""
MISSION = """[mission]
name = "turn"
final_tick = 300
[[reactor]]
name = "driver"
model = "driver.nddl"
latency = 1
lookahead = 300
internal = ["run"]
external = ["truck"]
[[reactor]]
name = "world"
model = "world.nddl"
latency = 0
lookahead = 1
internal = ["truck"]
[[goal]]
timeline = "run"
predicate = "Clear"
start = [10, 40]
"""


def written(folder: Path, clear: str, drive: str) -> Path:
    """A mission whose driver's rule for `Clear` and whose truck's rule for `Drive` have these bodies."""
    (folder / "road.nddl").write_text(ROAD, encoding="utf-8")
    rule = f'#include "road.nddl"\n#include "Resources.nddl"\nRun::Clear {{ {clear} }}\n'
    (folder / "driver.nddl").write_text(rule + DRIVER, encoding="utf-8")
    (folder / "world.nddl").write_text(WORLD % drive, encoding="utf-8")
    (folder / "mission.toml").write_text(MISSION, encoding="utf-8")
    return folder / "mission.toml"


def alarms(path: Path) -> tuple[list[str], set[str]]:
    """What the judge says of a mission, and the fates of its tokens."""
    mission, _ = read_mission(path)
    assert mission is not None
    agent = load_models(mission).agent
    programs = programs_of(agent)
    outcome, record = record_mission(agent, programs, 0)
    report = judge_mission(agent, programs.programs, outcome, record, programs.constraints)
    fates = {each.fate for reactor in record.reactors for each in reactor.tokens}
    return [disagreement_text(one) for one in report.disagreements], fates


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
def test_an_argument_that_nobody_gave_may_stay_open_below_a_function(body: str, tmp_path: Path) -> None:
    found, _ = alarms(written(tmp_path, "contains(Truck.Drive out); out.end == end;", OPEN + body))
    assert found == []


def test_a_sum_with_what_a_repair_has_forgotten_binds_nobody(tmp_path: Path) -> None:
    clear = "contains(Truck.Drive out); contains(Truck.Turn turn); out before turn;"
    more = "turn.start <= out.end + PAUSE; turn.duration <= 25; turn.end == end;"
    found, fates = alarms(written(tmp_path, f"{clear} {more}", "duration == 40;"))
    assert found == []
    assert "cut" in fates


def test_a_record_with_endless_limits_is_written_and_read(tmp_path: Path) -> None:
    path, record = written(tmp_path, "contains(Truck.Drive out);", "duration == 40;"), tmp_path / "record.json"
    done = CliRunner().invoke(command, [str(path), "--record", str(record)], standalone_mode=False)
    assert (done.exception, done.return_value) == (None, 0)
    (driver, _) = json.loads(record.read_text(encoding="utf-8"))["reactors"]
    assert "inf" in driver["members"]["tank"]
    again = CliRunner().invoke(command, [str(record), "--mission", str(path)], standalone_mode=False)
    assert (again.exception, again.return_value) == (None, 0)
    assert again.output == done.output
