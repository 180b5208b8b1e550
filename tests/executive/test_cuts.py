"""A goal that nothing has ended says which repair has cut it loose, and only if one has."""

from runtime.executive.configuration import GoalConfiguration
from tests.executive.flying import fly, open_goals, planner, simulator

CLASSES = """
class Lamp extends AgentTimeline { predicate Off { } predicate On { } Lamp(Mode m) { super(m, "Off"); } }
class Torch extends AgentTimeline { predicate Off { } predicate On { } Torch(Mode m) { super(m, "Off"); } }
class Reader extends AgentTimeline { predicate Idle { } predicate Read { } Reader(Mode m) { super(m, "Idle"); } }
class Guard extends AgentTimeline { predicate Idle { } predicate Watch { } Guard(Mode m) { super(m, "Idle"); } }
class Cook extends AgentTimeline { predicate Idle { } predicate Cook { } Cook(Mode m) { super(m, "Idle"); } }
"""
USERS = f"""
{CLASSES}
Reader::Read {{ contains(Lamp.On on); on.duration <= 8; on.end == end; }}
Guard::Watch {{ contains(Torch.On on); on.duration <= 16; on.end == end; }}
Lamp lamp = new Lamp(External); Torch torch = new Torch(External);
Reader reader = new Reader(Internal); Guard guard = new Guard(Internal); Cook cook = new Cook(Internal);
close();
"""
LIGHTS = f"""
{CLASSES}
Lamp::On {{ duration == 12; start <= 9; }}
Torch::On {{ duration == 20; start <= 9; }}
Lamp lamp = new Lamp(Internal); Torch torch = new Torch(Internal);
close();
"""
CUT = "it began, and a repair has cut it loose from what was to end it"


def test_each_goal_tells_the_repair_that_has_cut_it_loose_and_no_other() -> None:
    wanted = (("reader", "Read"), ("guard", "Watch"), ("cook", "Cook"))
    outcome = fly(
        planner("users", USERS, "reader guard cook", "lamp torch"),
        simulator("lights", LIGHTS, "lamp torch"),
        goals=tuple(GoalConfiguration(line, what, 0, True, (3, 3)) for line, what in wanted),
        until=40,
    )
    assert outcome.abort is None
    told = open_goals(outcome)
    assert [one.partition("#")[0] for one in told] == [f"Read: {CUT} (Lamp.On", f"Watch: {CUT} (Torch.On", "Cook"]
    assert [one.partition(" goes on at ")[2] for one in told[:2]] == [
        "tick 11, later than the plan allows)",
        "tick 19, later than the plan allows)",
    ]
