"""Levels of resources are judged at all times that were left open, not as if what they belong to had not happened."""

import pytest

from checker.judge.judge import judge_mission
from checker.judge.rendering import disagreement_text
from runtime.executive.configuration import GoalConfiguration
from runtime.executive.record import MissionRecord, ValueRange
from tests.executive.flying import flown, lines, planner, simulator

MODEL = """
Reservoir battery = new Reservoir(100.0, 20.0, 100.0);
class Work extends AgentTimeline {
  predicate Idle { } predicate Inspect { } predicate Load { } Work(Mode m) { super(m, "Idle"); }
}
Work::Inspect { duration == 5; any(Reservoir.consume use); start <= use.time; use.time <= end; use.quantity == 50.0; }
Work::Load { duration == 5; any(Reservoir.produce gain); gain.time == end; gain.quantity == 40.0; }
Work work = new Work(Internal); close();
"""
GOALS = (GoalConfiguration("work", "Inspect", start=(3, 3)), GoalConfiguration("work", "Load", start=(10, 10)))


@pytest.mark.parametrize(("gain", "found"), [(40.0, 0), (49.0, 0), (51.0, 1)])
def test_a_consumption_at_an_open_time_counts_when_it_must_be_over(gain: float, found: int) -> None:
    mission = flown(planner("planner", MODEL, "work"), until=30, goals=GOALS)
    assert mission.report.holds, [disagreement_text(one) for one in mission.report.disagreements]
    (reactor,) = mission.record.reactors
    tokens = tuple(
        one._replace(arguments=(gain,)) if one.predicate == "Reservoir.produce" else one for one in reactor.tokens
    )
    assert any(not isinstance(one.start, int) for one in tokens if one.predicate == "Reservoir.consume")
    record = MissionRecord((reactor._replace(tokens=tokens),))
    report = judge_mission(mission.agent, mission.programs, mission.outcome, record)
    assert sum(one.kind == "level" for one in report.disagreements) == found


HOSE = """
Reusable hose = new Reusable(2.0, 0.0);
class Work extends AgentTimeline {
  predicate Idle { } predicate Water { } predicate Wash { } Work(Mode m) { super(m, "Idle"); }
}
Work::Water { duration == 9; contains(hose.uses u); u.quantity == 2.0; u.start == start + 1; }
Work::Wash { duration == 4; equals(hose.uses u); u.quantity == 1.0; }
Work work = new Work(Internal); close();
"""
BOTH = (GoalConfiguration("work", "Water", start=(3, 3)), GoalConfiguration("work", "Wash", start=(20, 20)))


@pytest.mark.parametrize(("first", "found"), [(5, 0), (20, 0), (21, 1)])
def test_a_use_whose_end_was_left_open_counts_until_it_may_be_over(first: int, found: int) -> None:
    mission = flown(planner("planner", HOSE, "work"), until=30, goals=BOTH)
    assert mission.report.holds, [disagreement_text(one) for one in mission.report.disagreements]
    (reactor,) = mission.record.reactors
    uses = [one for one in reactor.tokens if one.predicate == "Reusable.uses"]
    assert [isinstance(one.end, int) for one in uses] == [False, True]
    late = uses[0]._replace(end=ValueRange(first, 40), duration=ValueRange(1, 40))
    tokens = tuple(late if one is uses[0] else one for one in reactor.tokens)
    record = MissionRecord((reactor._replace(tokens=tokens),))
    report = judge_mission(mission.agent, mission.programs, mission.outcome, record)
    assert sum(one.kind == "level" for one in report.disagreements) == found


@pytest.mark.parametrize(
    ("is_anew", "other", "found"), [(True, None, 0), (True, (10, 12), 1), (False, (10, 12), 0), (False, (5, 7), 1)]
)
def test_what_a_repair_plans_anew_is_no_second_use(is_anew: bool, other: tuple[int, int] | None, found: int) -> None:
    """A repair at tick 8 cuts off a use of all there is; if what uses it goes on, it is planned from its beginning."""
    mission = flown(planner("planner", HOSE, "work"), until=30, goals=BOTH)
    (reactor,) = mission.record.reactors
    water, wash = [one for one in reactor.tokens if one.predicate == "Reusable.uses"]
    newest = max(one.key for one in reactor.tokens)
    lasting = water._replace(start=4, end=13, duration=9)
    tokens = [one for one in reactor.tokens if one is not water]
    if other is not None and other[0] < 8:
        tokens.append(wash._replace(key=newest + 1, start=other[0], end=other[1], duration=2, fate="over"))
    tokens.append(lasting._replace(key=newest + 2, fate="cut", tick=8))
    if other is not None and other[0] >= 8:
        tokens.append(wash._replace(key=newest + 3, start=other[0], end=other[1], duration=2))
    if is_anew:
        tokens.append(lasting._replace(key=newest + 4))
    record = MissionRecord((reactor._replace(tokens=tuple(tokens)),))
    report = judge_mission(mission.agent, mission.programs, mission.outcome, record)
    assert sum(one.kind == "level" for one in report.disagreements) == found


def test_what_is_cut_off_twice_was_planned_anew_in_between() -> None:
    """Repairs at ticks 8 and 11 cut off the same use of all there is; what it shared with another was before."""
    mission = flown(planner("planner", HOSE, "work"), until=30, goals=BOTH)
    (reactor,) = mission.record.reactors
    water, wash = [one for one in reactor.tokens if one.predicate == "Reusable.uses"]
    newest = max(one.key for one in reactor.tokens)
    half = water._replace(arguments=(1.0,), start=4, end=13, duration=9)
    told = [(half, "cut", 8), (wash._replace(start=3, end=7, duration=4), "cut", 8)]
    told += [(half._replace(start=3), "cut", 11), (half, "over", 13)]
    tokens = [one for one in reactor.tokens if one.predicate != "Reusable.uses"]
    tokens += [one._replace(key=newest + 1 + at, fate=fate, tick=tick) for at, (one, fate, tick) in enumerate(told)]
    record = MissionRecord((reactor._replace(tokens=tuple(tokens)),))
    report = judge_mission(mission.agent, mission.programs, mission.outcome, record)
    assert not [disagreement_text(one) for one in report.disagreements if one.kind == "level"]


DEV = 'class Dev extends AgentTimeline { predicate Off { } predicate On { } Dev(Mode m) { super(m, "Off"); } }'
TASK = """
class Task extends AgentTimeline {
    predicate Idle { } predicate Prep { } predicate Do { } predicate Drink { }
    Task(Mode m) { super(m, "Idle"); }
}
Reservoir tank = new Reservoir(10.0, 1.0, 10.0);
Task::Prep { any(tank.consume u); u.quantity == 4.0; u.time == end; }
Task::Do { after(object.Prep p); contains(Dev.On x); x.end == end; x.duration <= 6; }
Task::Drink { any(tank.consume u); u.quantity == 6.0; u.time == start; }
Task task = new Task(Internal);
Task other = new Task(Internal);
Dev dev = new Dev(External);
close();
"""


def test_what_a_plan_took_for_something_of_before_the_mission_counts_until_a_repair_gives_that_up() -> None:
    world = simulator("sim", f"{DEV} Dev::On {{ duration == 10; }} Dev dev = new Dev(Internal); close();", "dev")
    goals = (
        GoalConfiguration("task", "Do", at=2, start=(3, 40)),
        GoalConfiguration("other", "Drink", at=16, start=(17, 17)),
    )
    flight = flown(planner("plan", DEV + TASK, "task other", "dev", latency=1), world, until=18, goals=goals)
    assert lines(flight.outcome, "relax")
    assert flight.outcome.abort is None
    assert flight.report.holds
    (level,) = flight.report.profiles
    assert [one for _, one in level.levels] == [6.0, 10.0, 4.0]
