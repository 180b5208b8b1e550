"""Carry out the next choice of a decision; tell whether it holds, fails, or there is none left."""

from runtime.constraints.domains.bitset import next_value, previous_value
from runtime.constraints.domains.tags import KIND_FLOAT, NEVER
from runtime.plan.lifecycle import fire
from runtime.plan.tokens.timelines import order
from runtime.solver.flaws.agenda import Queues
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.resolvers.conditions import mend_open_condition
from runtime.solver.resolvers.insertions import fill_places, is_open_place
from runtime.solver.resolvers.preferences import listed_values, sort_places
from runtime.solver.resolvers.resource_resolvers import mend_instant
from runtime.solver.tags import (
    APPLIED,
    CUSTOM,
    FAILED_CHOICE,
    HANDLER_HSTS_THREAT,
    HANDLER_LISTED,
    HANDLER_MAX,
    HANDLER_RANDOM,
    NO_CHOICE,
    NONE,
    OPEN_CONDITION,
    SPREAD,
    THREAT,
    UNBOUND_VARIABLE,
)


def mend(q: Queues, stack: Decisions, d: int) -> int:
    """Carry out the next choice of decision `d`; the caller has set a mark, and goes back to it after a failure.

    With `q.exact` the choices are those that EUROPA offers, so that failures count as they do there.
    """
    kind = stack.kind[d]
    if kind == UNBOUND_VARIABLE:
        return mend_variable(q, stack, d)
    if kind == OPEN_CONDITION:
        return mend_open_condition(q, stack, d)
    if kind == THREAT:
        return mend_threat(q, stack, d)
    if kind == CUSTOM:
        return mend_custom(q, stack, d)
    return mend_instant(q, stack, d)


def mend_custom(q: Queues, stack: Decisions, d: int) -> int:
    """Have somebody else's manager carry out its next choice."""
    if q.probing:
        return APPLIED if q.custom.has_choice(stack.item[d], stack.tries[d]) else NO_CHOICE
    outcome = q.custom.attempt(stack.item[d], stack.tries[d])
    if outcome != NO_CHOICE:
        stack.tries[d] += 1
    return outcome


def mend_variable(q: Queues, stack: Decisions, d: int) -> int:
    """Give a variable its next value."""
    v = stack.item[d]
    handler = q.treatments.handler_code[stack.handler[d]]
    if handler == HANDLER_LISTED or q.engine.kind[v] == KIND_FLOAT:
        return mend_by_list(q, stack, d)
    if handler == HANDLER_RANDOM:
        x = random_value(q, stack, d)
    elif handler == HANDLER_MAX:
        x = value_below(q, v, q.engine.ub[v] if stack.tries[d] == 0 else stack.cursor[d] - 1)
    else:
        x = value_above(q, v, q.engine.lb[v] if stack.tries[d] == 0 else stack.cursor[d] + 1)
    if x == NEVER or x == -NEVER:
        return NO_CHOICE
    if q.probing:
        return APPLIED
    stack.cursor[d] = x
    stack.tries[d] += 1
    q.engine.decide(v, x, NONE, NONE)
    return APPLIED if fire(q.plan) else FAILED_CHOICE


def value_above(q: Queues, v: int, x: int) -> int:
    """The first value from `x` on; NEVER if there is none."""
    if x > q.engine.ub[v]:
        return NEVER
    return x if q.engine.word[v] < 0 else next_value(q.engine, v, x)


def value_below(q: Queues, v: int, x: int) -> int:
    """The last value up to `x`; -NEVER if there is none."""
    if x < q.engine.lb[v]:
        return -NEVER
    return x if q.engine.word[v] < 0 else previous_value(q.engine, v, x)


def random_value(q: Queues, stack: Decisions, d: int) -> int:
    """The next value in an order that the variable's number alone fixes: every step-th one, round and round."""
    v = stack.item[d]
    count = q.filters.size(v)
    if stack.tries[d] >= count:
        return NEVER
    step = count // 2 + 1
    while not are_coprime(step, count):
        step += 1
    place = (v * SPREAD + stack.tries[d] * step) % count
    x = value_above(q, v, q.engine.lb[v])
    if q.engine.word[v] < 0:
        return x + place
    while place > 0:
        x = value_above(q, v, x + 1)
        place -= 1
    return x


def are_coprime(a: int, b: int) -> bool:
    """Whether two numbers have no common divisor."""
    while b:
        rest = a % b
        a = b
        b = rest
    return a == 1


def mend_by_list(q: Queues, stack: Decisions, d: int) -> int:
    """Give a variable the next value of a list: what ValEnum names, or the values of a float."""
    v = stack.item[d]
    if stack.tries[d] == 0:
        stack.lists[d] = listed_values(q, v, stack.handler[d])
    values = stack.lists[d]
    if stack.tries[d] >= len(values):
        return NO_CHOICE
    if q.probing:
        return APPLIED
    x = values[stack.tries[d]]
    stack.tries[d] += 1
    q.engine.decide(v, x, NONE, NONE)
    return APPLIED if fire(q.plan) else FAILED_CHOICE


def mend_threat(q: Queues, stack: Decisions, d: int) -> int:
    """Put a token into its next place on a timeline; `cursor` is the last place looked at."""
    t = stack.item[d]
    if stack.pool_count[d] < 0:
        stack.pool_count[d] = 0
        fill_places(q, stack, d, t)
        if q.treatments.handler_code[stack.handler[d]] == HANDLER_HSTS_THREAT:
            sort_places(q, stack, d)
    place = stack.cursor[d] + 1
    while place < stack.pool_count[d]:
        at = stack.pool_first[d] + place
        before = stack.pool_before[at]
        after = stack.pool_after[at]
        if is_open_place(q, t, before, after):
            if q.probing:
                return APPLIED
            stack.cursor[d] = place
            stack.tries[d] += 1
            if not order(q.plan, stack.pool_object[at], before, after, NONE):
                return FAILED_CHOICE
            return APPLIED if fire(q.plan) else FAILED_CHOICE
        place += 1
    return NO_CHOICE
