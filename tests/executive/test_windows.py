"""What the simulator was asked for waits for what it brings about itself, whichever of its timelines is named first."""

from itertools import permutations

import pytest

from runtime.executive.configuration import GoalConfiguration
from runtime.executive.outcome import EventKind
from tests.executive.flying import history, in_all_ways, simulator

DOCK = """
class Gate extends AgentTimeline { predicate Closed { } predicate Open { } Gate(Mode m) { super(m, "Closed"); } }
class Tide extends AgentTimeline { predicate Low { } predicate High { } Tide(Mode m) { super(m, "Low"); } }
class Boat extends AgentTimeline { predicate Moored { } predicate Pass { } Boat(Mode m) { super(m, "Moored"); } }
Boat::Pass { duration == 5; }
Gate gate = new Gate(Internal); Tide tide = new Tide(Internal); Boat boat = new Boat(Internal); close();
"""
TIDE = " Tide::Low { duration == 9; meets(object.High h); } Tide::High { duration == 4; meets(object.Low l); }"
GATE = " Gate::Closed { duration == 7; meets(object.Open o); } Gate::Open { duration == 8; meets(object.Closed c); }"
LIFT = f" Gate::Open {{ duration == 7; starts_during(Tide.High h); }}{TIDE}"
LONG = TIDE.replace("duration == 4", "duration == 10")
WORLDS = {  # and when the boat passes, asked for from tick 5 on
    "Boat::Pass { starts_during(Gate.Open o); }": 5,
    "Boat::Pass { starts_during(Gate.Open o); } Gate::Closed { duration >= 8; }": 8,
    f"Boat::Pass {{ starts_during(Gate.Open o); }}{LIFT}": 9,
    f"Boat::Pass {{ starts(Gate.Open o); }}{LIFT}": 9,
    f"Boat::Pass {{ contained_by(Gate.Open o); contained_by(Tide.High h); }}{GATE}{LONG}": 9,
    f"Boat::Pass {{ starts_during(Gate.Closed c); starts_during(Tide.High h); }}{GATE}{LONG}": 15,
    "Boat::Pass { contained_by(Gate.Open o); contained_by(Tide.High h); }": 5,
    "Boat::Pass { met_by(Moored m); starts_during(Gate.Open o); } Gate::Open { duration == 7; ends(Tide.High h); } "
    "Gate::Closed { duration == 11; }": 11,
}


@pytest.mark.parametrize("world", WORLDS)
def test_the_order_of_timelines_is_nothing_to_a_command_that_waits(world: str) -> None:
    goal = GoalConfiguration("boat", "Pass", 0, True, (5, 30))
    told = []
    for order in permutations(("gate", "tide", "boat")):
        dock = simulator("dock", DOCK.replace("Gate gate", f"{world} Gate gate"), " ".join(order))
        outcome = in_all_ways(dock, 40, (goal,), (), 1)
        told.append([history(outcome, line) for line in sorted(order)])
    assert told == told[:1] * 6
    assert [line for line in told[0][0] if "Pass" in line] == [f"{WORLDS[world]} Pass"]
    assert sum(event.kind is EventKind.ACHIEVED for event in outcome.events) == 1


@pytest.mark.parametrize("relation", ["contained_by", "starts_during"])
@pytest.mark.parametrize(
    "latency", [pytest.param(0, marks=pytest.mark.once), 1, pytest.param(3, marks=pytest.mark.once)]
)
@pytest.mark.parametrize("opened", [pytest.param(2, marks=pytest.mark.once), 9])
def test_a_command_ahead_of_time_is_judged_by_what_holds_when_it_may_begin(
    opened: int, latency: int, relation: str
) -> None:
    """What holds when it is asked for is over by then, or too short."""
    gate = f"Gate::Closed {{ duration == 3; meets(object.Open o); }} Gate::Open {{ duration == {opened};"
    world = f"Boat::Pass {{ {relation}(Gate.Open o); }} {gate} meets(object.Closed c); }} Gate gate"
    dock = simulator("dock", DOCK.replace("Gate gate", world), "gate tide boat", latency=latency)
    for tick in range(2, 15):
        for ahead in range(1, latency + 3):
            goal = GoalConfiguration("boat", "Pass", tick, False, (tick + ahead, tick + ahead + tick % 3))
            in_all_ways(dock, 30, (goal,), (), 1)
