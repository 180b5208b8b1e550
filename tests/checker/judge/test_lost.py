"""What a reactor that no repair could help holds of its last tick is not known, and no fault of the executive."""

from checker.judge.rendering import disagreement_text
from runtime.executive.configuration import GoalConfiguration
from runtime.executive.record import ValueRange
from tests.executive.flying import flown, planner, simulator

SHARED = """
class Cab extends AgentTimeline { predicate At { } predicate Move { } Cab(Mode m) { super(m, "At"); } }
class Doors extends AgentTimeline { predicate Shut { } predicate Open { } Doors(Mode m) { super(m, "Shut"); } }
class Ride extends AgentTimeline { predicate Wait { } predicate Fetch { } Ride(Mode m) { super(m, "Wait"); } }
"""
HOUSE = f"""{SHARED}
Cab::Move {{ duration == 6; meets(object.At a); }}
Doors::Open {{ duration == 4; }}
Cab cab = new Cab(Internal); Doors doors = new Doors(Internal); close();
"""
BOY = f"""{SHARED}
Ride::Fetch {{
  contains(Cab.Move m);
  contains(Doors.Open last);
  m before last;
  contains(Cab.At there);
  m meets there;
  last.end == end;
  duration <= 13;
}}
Ride ride = new Ride(Internal); Cab cab = new Cab(External); Doors doors = new Doors(External); close();
"""


def test_a_token_that_runs_as_its_reactor_is_lost_has_not_gone_on() -> None:
    mission = flown(
        planner("boy", BOY, "ride", "cab doors", latency=0, lookahead=40),
        simulator("house", HOUSE, "cab doors"),
        until=60,
        goals=(GoalConfiguration("ride", "Fetch", start=(3, 3), mandatory=True),),
    )
    assert mission.outcome.abort is not None and mission.outcome.abort.tick == 16
    (fetch,) = [one for one in mission.record.reactors[0].tokens if one.predicate == "Ride.Fetch"]
    assert isinstance(fetch.end, ValueRange) and fetch.end.lower <= 16
    assert [disagreement_text(one) for one in mission.report.disagreements] == []
