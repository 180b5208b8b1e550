"""When "now" can decide anything: in a plan that reads AGENT_CLOCK, and as tokens come into the planning window."""

from math import inf

from compiler.program import FIRST_PARAMETER, START
from runtime.constraints.propagators.opcodes import OP_TEST_LEQ, OP_TEST_LT, OP_WATCH
from runtime.executive.view import PlanView
from runtime.plan.tags import FREED, HOLDS_VARIABLES, INFINITY, LIST_OPEN, LIST_THREAT, LISTS, ROLE_LOCAL


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


def next_within(view: PlanView, tick: int, reach: int, is_any: bool) -> int:
    """The first tick after `tick` whose window, `reach` ticks long, has in it a token that is not in it at `tick`.

    What has its place, and of which nothing is left to decide, does not count, unless `is_any`.
    """
    rows, earliest = view.rows, view.engine.lb
    last, found = tick + reach, INFINITY
    for t in range(rows.token_count):
        if rows.status[t] == FREED:
            continue
        start = earliest[rows.var0[t] + START]
        if not last < start < found:
            continue
        is_placed = rows.link_head[LISTS * t + LIST_OPEN] < 0 and rows.link_head[LISTS * t + LIST_THREAT] < 0
        if is_any or not is_placed or _has_choice(view, t):
            found = start
    return found - reach


def _has_choice(view: PlanView, t: int) -> bool:
    """Whether a parameter of a token, or a local variable of its rules, is left to the solver to decide."""
    rows, plan = view.rows, view.plan
    for v in range(rows.var0[t] + FIRST_PARAMETER, rows.var0[t] + rows.width[t]):
        if _is_choice(view, v):
            return True
    s = rows.scopes[t]
    while s >= 0:
        h = rows.scope_holds[s]
        while h >= 0:
            v = rows.hold_id[h]
            if rows.hold_kind[h] == HOLDS_VARIABLES and plan.variable_role[v] == ROLE_LOCAL and _is_choice(view, v):
                return True
            h = rows.hold_next[h]
        s = rows.scope_next[s]
    return False


def _is_choice(view: PlanView, v: int) -> bool:
    """Whether a variable has several values, or a guard waits for the only one to be decided."""
    if view.engine.is_decided(v) or not view.engine.is_finite(v):
        return False
    return bool(view.plan.variable_guards[v] > 0 or not view.engine.is_singleton(v))
