"""Missions that the judge looks at in these tests: small models of every kind, each flown from a seed."""

from functools import lru_cache
from pathlib import Path

from checker.judge.judge import judge_mission
from checker.mission import read_mission
from checker.models import load_models
from runtime.executive.configuration import GoalConfiguration, ParameterConfiguration
from runtime.executive.mission import record_mission
from tests.executive.flying import Flown, flown, planner, simulator
from tests.programs import programs_of

INL = Path(__file__).resolve().parents[3] / "models/auv/inl/mission.toml"
GPS = Path(__file__).resolve().parents[3] / "models/gps/mission.toml"

# Two models share the oven and its meter.
HEATER = """
class Oven extends AgentTimeline {
  predicate Cold { }
  predicate Heat { int level; float warmth; }
  Oven(Mode m) { super(m, "Cold"); }
}
class Meter extends AgentTimeline {
  predicate Idle { }
  predicate Reading { float value; bool is_hot; }
  Meter(Mode m) { super(m, "Idle"); }
}
"""
WORLD = (
    HEATER
    + """
class Shelf { int height; Shelf(int h) { height = h; } }
enum Tone { low, high }
float GAIN = [0.5 1.5];
int LIMIT; LIMIT = 6;
Shelf s1 = new Shelf(1);
Shelf s2 = new Shelf(5);
Shelf shelves;
Reusable power = new Reusable(3.0, 0.0);
Oven::Heat {
  float gain; float span; int ticks; Shelf best; Tone tone;
  gain == sampledParameter(GAIN);
  warmth == gain * level + 0.25;
  span == warmth * 2.0;
  ticks == ceil(span);
  duration == ticks;
  best == s2;
  if (level >= 4) {
    tone == high;
    starts(Meter.Reading r);
    r.value == warmth;
    r.is_hot == true;
  } else {
    tone == low;
    if (level == 2) { starts(Meter.Reading r2); r2.value == 2.0; r2.is_hot == false; }
  }
  foreach (s in shelves) {
    int room;
    room == level + s.height;
    room <= 12;
  }
  level <= LIMIT || warmth < 1.0;
  equals(power.uses load);
  load.quantity == 1.0;
}
Meter::Reading { duration == 2; is_hot == (value > 3.0); }
Oven::Cold { duration >= 1; }
Oven oven = new Oven(Internal);
Meter meter = new Meter(Internal);
close();
"""
)
COOK = (
    HEATER
    + """
class Chef extends AgentTimeline {
  predicate Wait { }
  predicate Cook { int level; }
  predicate Serve { float warmth; }
  Chef(Mode m) { super(m, "Wait"); }
}
Chef::Cook {
  contains(Oven.Heat h);
  h.level == level;
  meets(object.Serve s);
  s.warmth == h.warmth;
  duration <= 30;
}
Chef::Serve { duration == 3; met_by(object.Cook c); }
Chef chef = new Chef(Internal);
Oven oven = new Oven(External);
Meter meter = new Meter(External);
close();
"""
)
COUNTER = """
class Walk extends AgentTimeline { predicate Step { int n; float x; } Walk(Mode m) { super(m, "Step"); } }
class Wind extends AgentTimeline { predicate Blows { float force; } Wind(Mode m) { super(m, "Blows"); } }
float GUST = [-1.0 1.0];
Walk::Step {
  duration == 3;
  contained_by(Wind.Blows w);
  float push; float drift;
  push == sampledParameter(GUST);
  drift == push * 0.5 + w.force;
  meets(object.Step next);
  next.n == n + 1;
  next.x == x + drift;
}
Walk walk = new Walk(Internal);
Wind wind = new Wind(Internal);
close();
fact(walk.Step s0); s0.start == 0; s0.n == 0; eq(s0.x, 0.0);
fact(wind.Blows w0); w0.start == 0; eq(w0.force, 0.125);
"""


def cooking(seed: int) -> Flown:
    """A planner over a simulator: guards, a loop, a resource, reals, booleans and draws."""
    goals = tuple(
        GoalConfiguration("chef", "Cook", start=(first, first + 8), parameters=(("level", level),))
        for first, level in ((3, 2), (30, 5), (60, 3))
    )
    gain = ParameterConfiguration("GAIN", 0.5, 1.5)
    return flown(
        planner("cook", COOK, "chef", "oven meter", latency=1, lookahead=100),
        simulator("world", WORLD, "oven meter"),
        until=100,
        goals=goals,
        parameters=(gain,),
        seed=seed,
    )


def walking(seed: int, until: int = 60, *, compiles: bool = True) -> Flown:
    """A simulator that makes a token every three ticks, with one that lasts as long as the mission."""
    return flown(simulator("walk", COUNTER, "walk wind"), until=until, seed=seed, compiles=compiles)


@lru_cache(maxsize=4)
def loaded(path: Path):  # type: ignore[no-untyped-def]
    mission, _ = read_mission(path)
    assert mission is not None
    agent = load_models(mission).agent
    return agent, programs_of(agent)


def surveying(seed: int) -> Flown:
    """The GPS mission."""
    agent, programs = loaded(GPS)
    outcome, record = record_mission(agent, programs, seed)
    return Flown(agent, programs.programs, outcome, record, judge_mission(agent, programs.programs, outcome, record))


MISSIONS = {"cooking": cooking, "walking": walking, "surveying": surveying}
