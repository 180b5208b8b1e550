"""A search without an end costs one mission its time, says where it was, and does not cost the whole batch."""

from itertools import combinations, count
from pathlib import Path

import pytest

from nddlc.main import run
from runtime.executive.configuration import GoalConfiguration
from runtime.limits import TIME_LIMIT, OutOfTimeError
from tests.executive.flying import flown, planner
from tests.executive.variations.form import RESOURCES

pytestmark = pytest.mark.once

HOLES = 10
BIRDS = "abcdefghijk"
RULE = " ".join(
    [f"1 <= {bird}; {bird} <= {HOLES};" for bird in BIRDS]
    + [f"{one} != {other};" for one, other in combinations(BIRDS, 2)]
)
MODEL = f"""
class Job extends AgentTimeline {{
    predicate Free {{ }} predicate Fill {{ {" ".join(f"int {bird};" for bird in BIRDS)} }}
    Job(Mode m) {{ super(m, "Free"); }}
}}
Job::Fill {{ {RULE} }}
Job job = new Job(Internal);
close();
"""
MISSION = """
[mission]
name = "endless"
final_tick = 60
[[reactor]]
name = "planner"
model = "planner.nddl"
lookahead = 60
internal = ["job"]
[[goal]]
timeline = "job"
predicate = "Fill"
start = [5, 20]
mandatory = true
[check]
missions = 40
time_limit = 2
"""


def test_a_batch_ends_where_no_mission_does_and_names_what_stands_in_the_way(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Eleven birds and ten holes, no two in one: whoever tries one after the other tries for days."""
    (tmp_path / "planner.nddl").write_text(f'#include "TREX.nddl"\n{MODEL}')
    (tmp_path / "mission.toml").write_text(MISSION)
    monkeypatch.chdir(tmp_path)
    assert run(["check", "--workers", "1"]) == 2
    told = capsys.readouterr().out
    assert "4 missions of 40 (none came to its end in time), 0 failed, 4 not flown to the end in time" in told
    assert "missions that took too long, counted nowhere: 4" in told and "and 1 more, see the report" in told
    assert "took longer than 2 s: `planner` found no end of its search at tick 0; `" in told
    assert " more stand in the way in " in told and "(planner.nddl:7)" in told
    assert "help: with `max_steps`" in told
    assert run(["run"]) == 2
    assert "nddlc: took longer than 2 s: `planner` found no end of its search at tick 0; `" in capsys.readouterr().err
    limit = MISSION.replace('internal = ["job"]', 'internal = ["job"]\nmax_steps = 300')
    limit = limit.replace("time_limit = 2", "time_limit = 300")
    (tmp_path / "mission.toml").write_text(limit)
    assert run(["check", "--workers", "1", "--missions", "2", "--flights", "0"]) == 1
    assert "F10" in capsys.readouterr().out


def test_a_failure_is_named_however_slow_the_machine_is() -> None:
    """On a busy machine the time to look for what stands in the way was over before the first failure."""
    slow, goal = count(0.0, 60.0), GoalConfiguration("job", "Fill", 0, True, (5.0, 20.0))
    with (
        pytest.raises(OutOfTimeError, match=r"`.* <= .`.* more stand in the way in \d of its first \d failures"),
        TIME_LIMIT.lasting(100.0, lambda: next(slow)),
    ):
        flown(planner("planner", MODEL, "job"), until=60, goals=(goal,))


def test_a_place_that_no_token_has_left_is_a_failure_with_its_lines() -> None:
    """Eleven turns of five ticks in 52, one at a time: no choice fails, since what cannot hold is never chosen."""
    turns = " ".join(f"contains(Arm.Turn {bird}); {bird}.n == {n};" for n, bird in enumerate(BIRDS))
    model = f"""
class Arm extends AgentTimeline {{
    predicate Rest {{ }} predicate Turn {{ int n; }}
    Arm(Mode m) {{ super(m, "Rest"); }}
}}
class Job extends AgentTimeline {{ predicate Free {{ }} predicate Fill {{ }} Job(Mode m) {{ super(m, "Free"); }} }}
Reusable hand = new Reusable(1.0, 0.0);
Job::Fill {{ {turns} duration <= 52; }}
Arm::Turn {{ duration == 5; equals(hand.uses u); u.quantity == 1.0; }}
Job job = new Job(Internal);
Arm arm = new Arm(Internal);
close();
"""
    slow, goal = count(0.0, 0.01), GoalConfiguration("job", "Fill", 0, True, (5.0, 20.0))
    with (
        pytest.raises(OutOfTimeError, match=r"`.*` \(planner.nddl:\d+\).* in the way in \d+ of its first \d+ failures"),
        TIME_LIMIT.lasting(100.0, lambda: next(slow)),
    ):
        flown(planner("planner", model, "job arm"), until=80, goals=(goal,), solver=RESOURCES)


def test_no_search_is_blamed_for_time_that_something_else_took() -> None:
    """The present had its plan when time was over: it was said to have found no end."""
    model = MODEL[: MODEL.index("Job::Fill")] + "Job job = new Job(Internal);\nclose();\n"
    hours = count(0.0, 60.0)
    with (
        pytest.raises(OutOfTimeError, match="took longer than 1 s: nobody was in the middle of a search at tick 0"),
        TIME_LIMIT.lasting(1.0, lambda: next(hours)),
    ):
        flown(planner("planner", model, "job"), until=60)
