"""When "now" can decide anything in a plan that reads AGENT_CLOCK."""

from math import inf

from runtime.constraints.propagators.opcodes import OP_TEST_LEQ, OP_TEST_LT, OP_WATCH
from runtime.executive.view import PlanView


def next_reading(bench: PlanView, tick: int) -> float:
    """The first tick after `tick` at which "now" may decide a constraint that reads AGENT_CLOCK; inf for never.

    The least value of AGENT_CLOCK is "now", its latest the final tick. So of a time that is compared with it, nothing
    is decided before "now" reaches the latest value of that time.
    """
    number = bench.globals.get("AGENT_CLOCK")
    if number is None:
        return inf
    engine, clock, found, tested = bench.engine, bench.plan.globals[number], inf, bench.met
    heads = (engine.watch_head[clock], engine.mute_head[clock])
    tested.empty(engine.variables)
    for slot in heads:
        while slot >= 0:
            c = engine.slot_constraint[slot]
            if engine.op[c] == OP_TEST_LEQ or engine.op[c] == OP_TEST_LT:
                tested.add(engine.slot_variable[engine.first[c]])
            slot = engine.slot_next[slot]
    for slot in heads:
        while slot >= 0:
            c = engine.slot_constraint[slot]
            slot = engine.slot_next[slot]
            first = engine.first[c]
            result = engine.slot_variable[first]
            if not tested.has(result):
                return tick + 1
            if engine.op[c] == OP_WATCH or (engine.is_singleton(result) and engine.lower(result) == 1.0):
                continue  # a guard waits for the test, which says all there is to say
            for k in range(first + 1, first + engine.arity[c]):
                if engine.slot_variable[k] != clock:
                    found = min(found, max(engine.upper(engine.slot_variable[k]), tick + 1))
    return found
