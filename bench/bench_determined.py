"""Measure determined reactors: a tick of a vehicle's simulator as register code, and the same in the general engine.

python bench/bench_determined.py            the figures
python bench/bench_determined.py --json     one object

The simulator makes one token a tick, with some forty constraints: steering, drift, a running mean of the current, a
hidden error, depth in five kinds of legs.
"""

import argparse
import json
import time
from typing import NoReturn

from runtime.build_form import build_form
from compiler.lower import compile_model
from nddl_lang.analysis import analyse_text
from nddl_lang.syntax.dialect import Dialect
from runtime.determined.reactor import DeterminedReactor
from runtime.executive.configuration import AgentConfiguration, ParameterConfiguration, ReactorConfiguration
from runtime.executive.draws import World
from runtime.executive.mission import MissionPrograms, register_program, run_mission
from runtime.executive.trace import Trace
from runtime.solver.configuration.configuration import default_configuration

TICKS, GENERAL_TICKS = 30_000, 400
MICRO = 1e6
MODEL = """
#include "TREX.nddl"
enum Kind { Drift, Line, Wave, Rise, Fix }
float REACH = 15.0; float CLIMB = 0.35;
float EAST_DRIFT = [-0.6 0.6]; float NORTH_DRIFT = [-0.6 0.6]; float EAST_ERROR = [-0.9 0.9];
float NORTH_ERROR = [-0.9 0.9];
class Order extends AgentTimeline {
  predicate Stop { }
  predicate Do { Kind kind; float tx; float ty; float top; float bottom; float speed; int need; }
  Order(Mode m) { super(m, "Stop"); }
}
class Target extends AgentTimeline {
  predicate Is { Kind kind; float tx; float ty; float top; float bottom; float speed; int need; }
  Target(Mode m) { super(m, "Is"); }
}
class Seen extends AgentTimeline {
  predicate At { float x; float y; float z; float cx; float cy; }
  Seen(Mode m) { super(m, "At"); }
}
class Body extends AgentTimeline {
  predicate Tick {
    Kind kind; float x; float y; float z; float ex; float ey; bool down; int wait; float cx; float cy; float age;
    float x1; float y1; float z1; float ex1; float ey1; bool down1; int wait1; float cx1; float cy1; float age1;
    bool done;
  }
  Body(Mode m) { super(m, "Tick"); }
}
Order::Stop {
  equals(Target.Is t); t.kind == Drift; t.speed == 0.0; t.need == 0;
  t.tx == 0.0; t.ty == 0.0; t.top == 0.0; t.bottom == 0.0;
}
Order::Do {
  equals(Target.Is t); t.kind == kind; t.speed == speed; t.need == need;
  t.tx == tx; t.ty == ty; t.top == top; t.bottom == bottom;
}
Body::Tick {
  duration == 1;
  contained_by(Target.Is t); equals(Seen.At s); meets(object.Tick n);
  kind == t.kind;
  n.x == x1; n.y == y1; n.z == z1; n.ex == ex1; n.ey == ey1; n.down == down1; n.wait == wait1;
  n.cx == cx1; n.cy == cy1; n.age == age1;
  s.x == x; s.y == y; s.z == z; s.cx == cx; s.cy == cy;
  float ux; float uy; float nx; float ny; float px; float py;
  towards(ux, uy, x, y, t.tx, t.ty);
  nx == sampledParameter(EAST_DRIFT); ny == sampledParameter(NORTH_DRIFT);
  px == x + (ux * t.speed + nx) * TICK_DURATION;
  py == y + (uy * t.speed + ny) * TICK_DURATION;
  cx1 == cx + (nx - cx) * 0.02; cy1 == cy + (ny - cy) * 0.02;
  float rx; float ry; float qx; float qy; float late;
  rx == sampledParameter(EAST_ERROR); ry == sampledParameter(NORTH_ERROR);
  qx == ex + rx * TICK_DURATION; qy == ey + ry * TICK_DURATION; late == age + TICK_DURATION;
  float far; bool near;
  calcDistance(far, px, py, t.tx, t.ty); near == (far <= REACH);
  if (kind == Drift) { done == false; wait1 == 0; z1 == z; down1 == true;
                       x1 == px; y1 == py; ex1 == qx; ey1 == qy; age1 == late; }
  if (kind == Line)  { done == near; wait1 == 0; z1 == t.top; down1 == true;
                       x1 == px; y1 == py; ex1 == qx; ey1 == qy; age1 == late; }
  if (kind == Wave)  {
    done == near; wait1 == 0; x1 == px; y1 == py; ex1 == qx; ey1 == qy; age1 == late;
    if (down == true)  { z1 == min(z + CLIMB * TICK_DURATION, t.bottom); down1 == (z1 < t.bottom); }
    if (down == false) { z1 == max(z - CLIMB * TICK_DURATION, t.top); down1 == (z1 <= t.top); }
  }
  if (kind == Rise)  { wait1 == 0; down1 == true; z1 == max(z - CLIMB * TICK_DURATION, 0.0); done == (z1 <= 0.0);
                       x1 == px; y1 == py; ex1 == qx; ey1 == qy; age1 == late; }
  if (kind == Fix)   {
    z1 == 0.0; down1 == true; wait1 == wait + 1; done == (t.need <= wait1);
    if (done == false) { x1 == px; y1 == py; ex1 == qx; ey1 == qy; age1 == late; }
    if (done == true)  { x1 == px + qx; y1 == py + qy; ex1 == 0.0; ey1 == 0.0; age1 == 0.0; }
  }
  if (done == true) { t.end == end; }
}
Order order = new Order(Internal); Target target = new Target(Private);
Body body = new Body(Private); Seen seen = new Seen(Internal);
close();
fact(body.Tick b); b.start == 0; eq(b.x, 0.0); eq(b.y, 0.0); eq(b.z, 0.0); eq(b.ex, 0.0); eq(b.ey, 0.0);
b.down == true; b.wait == 0; eq(b.cx, 0.0); eq(b.cy, 0.0); eq(b.age, 0.0);
"""
DRAWN = ("EAST_DRIFT", "NORTH_DRIFT", "EAST_ERROR", "NORTH_ERROR")


def mission(final_tick: int) -> tuple[AgentConfiguration, MissionPrograms]:
    """The simulator alone."""
    analysis = analyse_text("simulator", MODEL, Dialect.NDDLC)
    assert not analysis.has_errors
    reactor = ReactorConfiguration("simulator", "simulator", internal=("order", "target", "body", "seen"))
    parameters = tuple(ParameterConfiguration(name, -0.5, 0.5) for name in DRAWN)
    agent = AgentConfiguration("simulator", ".", final_tick, (reactor,), (), parameters)
    return agent, MissionPrograms((compile_model(analysis),), (default_configuration(),))


def compiled_tick() -> float:
    """Seconds of the processor for a tick of register code, the second time that the log is filled."""
    agent, programs = mission(TICKS)
    loaded = register_program(agent, programs, 0)
    assert loaded is not None
    best = 1.0
    for _ in range(5):
        trace = Trace()
        world = World(agent, 1, {}, trace)
        reactor = DeterminedReactor(agent.reactors[0], loaded, world.in_force, _nobody, TICKS, trace)
        machine = reactor.machine
        machine.run(-1, TICKS, 0)
        machine.log.forget_from(0)
        reactor._forget_ahead(-1)
        begin = time.process_time()
        reached = machine.run(-1, TICKS, 0)
        best = min(best, (time.process_time() - begin) / TICKS)
        assert reached == TICKS and machine.log.row_count > 2 * TICKS
    return best


def _nobody(trace: Trace) -> NoReturn:
    raise AssertionError("the machine does not stop")


def general_tick() -> float:
    """Seconds of the processor for a tick of the general engine."""
    agent, programs = mission(GENERAL_TICKS)
    begin = time.process_time()
    run_mission(agent, programs, 1, compiles=False)
    return (time.process_time() - begin) / GENERAL_TICKS


def whole_mission() -> float:
    """Seconds of the processor for a mission with its trace, per tick."""
    agent, programs = mission(TICKS)
    begin = time.process_time()
    run_mission(agent, programs, 1)
    return (time.process_time() - begin) / TICKS


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", action="store_true")
    asked = parser.parse_args()
    compiled, general, flown = compiled_tick(), general_tick(), whole_mission()
    figures = {
        "form": build_form(),
        "register_us": compiled * MICRO,
        "general_us": general * MICRO,
        "ratio": general / compiled,
        "mission_us": flown * MICRO,
    }
    if asked.json:
        print(json.dumps(figures))
        return
    print(f"register code, {figures['form']}: {compiled * MICRO:8.3f} us a tick (0.5 wanted)")
    print(f"general engine:          {general * MICRO:8.1f} us a tick (20 wanted)")
    print(f"ratio:                   {general / compiled:8.0f}")
    print(f"a mission, with trace:   {flown * MICRO:8.1f} us a tick")


if __name__ == "__main__":
    main()
