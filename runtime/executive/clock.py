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
    engine, clock, found = bench.engine, bench.database.plan.globals[number], inf
    readers = engine.constraints_of(clock)
    tested = {engine.arguments(c)[0] for c in readers if engine.op[c] in (OP_TEST_LEQ, OP_TEST_LT)}
    for c in readers:
        result, *compared = engine.arguments(c)
        if result not in tested:
            return tick + 1
        if engine.op[c] == OP_WATCH or (engine.is_singleton(result) and engine.lower(result) == 1.0):
            continue  # a guard waits for the test, which says all there is to say
        for v in compared:
            if v != clock:
                found = min(found, max(engine.upper(v), tick + 1))
    return found
