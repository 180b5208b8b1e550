"""What has happened counts for properties though a repair has forgotten it, or a recall cut it off."""

from pathlib import Path

import pytest

from nddlc.main import run

TYPES = """#include "TREX.nddl"
class Dev extends AgentTimeline {
    predicate Off { }
    predicate Warm { }
    predicate On { int n; }
    Dev(Mode m) { super(m, "Off"); }
}
"""
PLANNER = """#include "types.nddl"
class Task extends AgentTimeline { predicate Idle { } predicate Do { int n; } Task(Mode m) { super(m, "Idle"); } }
class Pair extends AgentTimeline { predicate Rest { } predicate Both { } Pair(Mode m) { super(m, "Rest"); } }
Task task = new Task(Internal);
Pair pair = new Pair(Internal);
Dev dev = new Dev(External);
Dev pump = new Dev(External);
Task::Do { contains(dev.On x); x.n == n; x.end == end; }
Pair::Both { contains(pump.Warm w); contains(dev.On x); x.n == 9; x.end == end; }
close();
"""
SIMULATOR = """#include "types.nddl"
Dev::Warm { duration == 20; }
Dev::On { duration == 10; }
Dev dev = new Dev(Internal);
Dev pump = new Dev(Internal);
close();
"""
# `Both` cannot contain what lasts longer than it: what is past, `Do` from 5 to 15, is forgotten at tick 30.
MISSION = """[mission]
name = "pair"
final_tick = 80
[[reactor]]
name = "planner"
model = "planner.nddl"
latency = 1
lookahead = 100
internal = ["task", "pair"]
external = ["dev", "pump"]
[[reactor]]
name = "simulator"
model = "simulator.nddl"
latency = 0
lookahead = 1
internal = ["dev", "pump"]
[[goal]]
timeline = "task"
predicate = "Do"
mandatory = true
start = [5, 8]
parameters = { n = 1 }
[[goal]]
timeline = "pair"
predicate = "Both"
mandatory = true
start = [20, 25]
[[property]]
name = "promise"
"""
DO = 'timeline = "task"\npredicate = "Do"\n'


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (f'kind = "reached"\n{DO}by = 40\nparameters = {{ n = 1 }}\n', ""),
        (f'kind = "reached"\n{DO}by = 14\n', "is violated at tick 14"),
        (f'kind = "reached"\n{DO}by = 40\nparameters = {{ n = 2 }}\n', "is violated at tick 40"),
        (f'kind = "never"\n{DO}', "is violated at tick 5"),
        (f'kind = "never"\n{DO}from = 15\n', ""),
        (f'kind = "never"\n{DO}parameters = {{ n = 2 }}\n', ""),
        (f'kind = "always"\n{DO}where = "duration <= 8"\n', "is violated at tick 5"),
        (f'kind = "always"\n{DO}where = "duration <= 10 and end == 15"\n', ""),
        (f'kind = "within"\n{DO}ticks = 3\n[property.then]\ntimeline = "dev"\npredicate = "On"\n', ""),
        (f'kind = "within"\n{DO}ticks = 9\n[property.then]\ntimeline = "pair"\npredicate = "Both"\n', "at tick 5"),
    ],
)
def test_what_a_repair_forgot_has_happened(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], words: str, told: str
) -> None:
    for name, text in (("types", TYPES), ("planner", PLANNER), ("simulator", SIMULATOR)):
        (tmp_path / f"{name}.nddl").write_text(text)
    (tmp_path / "mission.toml").write_text(MISSION + words)
    assert run(["run", str(tmp_path / "mission.toml")]) == (1 if told else 0)
    shown = capsys.readouterr().out
    assert "repairs 2" in shown
    assert ("is violated" in shown) == bool(told)
    assert told in shown
