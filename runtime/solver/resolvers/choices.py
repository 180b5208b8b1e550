"""Resolvers: carry out the next one of a decision; it holds, fails, or there is none left."""

from math import gcd

from runtime.constraints.domains.bitset import next_value, previous_value
from runtime.constraints.domains.tags import KIND_FLOAT, NEVER
from runtime.plan.lifecycle import fire
from runtime.plan.tokens.timelines import order
from runtime.solver.flaws.agenda import Agenda
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.resolvers.conditions import mend_open_condition
from runtime.solver.resolvers.insertions import is_open_insertion, list_insertions
from runtime.solver.resolvers.preferences import listed_values, sort_insertions
from runtime.solver.resolvers.resource_resolvers import mend_resource
from runtime.solver.tags import (
    APPLIED,
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


def mend(agenda: Agenda, stack: Decisions, d: int) -> int:
    """Carry out the next resolver of decision `d`; the caller has set a mark, and rewinds to it after a failure.

    With `agenda.exact` the resolvers are those that EUROPA offers, so that failures count as they do there.
    """
    kind = stack.kind[d]
    if kind == UNBOUND_VARIABLE:
        return _mend_variable(agenda, stack, d)
    if kind == OPEN_CONDITION:
        return mend_open_condition(agenda, stack, d)
    if kind == THREAT:
        return _mend_threat(agenda, stack, d)
    return mend_resource(agenda, stack, d)


def _mend_variable(agenda: Agenda, stack: Decisions, d: int) -> int:
    """Give a variable its next value."""
    v = stack.item[d]
    handler = agenda.table.handler_code[stack.handler[d]]
    if handler == HANDLER_LISTED or agenda.engine.kind[v] == KIND_FLOAT:
        return _mend_by_list(agenda, stack, d)
    if handler == HANDLER_RANDOM:
        x = _random_value(agenda, stack, d)
    elif handler == HANDLER_MAX:
        x = _value_below(agenda, v, agenda.engine.ub[v] if stack.tries[d] == 0 else stack.cursor[d] - 1)
    else:
        x = _value_above(agenda, v, agenda.engine.lb[v] if stack.tries[d] == 0 else stack.cursor[d] + 1)
    if x == NEVER or x == -NEVER:
        return NO_CHOICE
    if agenda.probing:
        return APPLIED
    stack.choose(d, x)
    agenda.engine.decide(v, x, NONE, NONE)
    return APPLIED if fire(agenda.plan) else FAILED_CHOICE


def _value_above(agenda: Agenda, v: int, x: int) -> int:
    """The first value from `x` on; NEVER if there is none."""
    if x > agenda.engine.ub[v]:
        return NEVER
    return x if agenda.engine.word[v] < 0 else next_value(agenda.engine, v, x)


def _value_below(agenda: Agenda, v: int, x: int) -> int:
    """The last value up to `x`; -NEVER if there is none."""
    if x < agenda.engine.lb[v]:
        return -NEVER
    return x if agenda.engine.word[v] < 0 else previous_value(agenda.engine, v, x)


def _random_value(agenda: Agenda, stack: Decisions, d: int) -> int:
    """The next value in an order that the variable's number alone fixes: every step-th one, round and round."""
    v = stack.item[d]
    count = agenda.filters.size(v)
    if stack.tries[d] >= count:
        return NEVER
    step = count // 2 + 1
    while gcd(step, count) > 1:
        step += 1
    index = (v * SPREAD + stack.tries[d] * step) % count
    x = _value_above(agenda, v, agenda.engine.lb[v])
    if agenda.engine.word[v] < 0:
        return x + index
    while index > 0:
        x = _value_above(agenda, v, x + 1)
        index -= 1
    return x


def _mend_by_list(agenda: Agenda, stack: Decisions, d: int) -> int:
    """Give a variable the next value of a list: what ValEnum names, or the values of a float."""
    v = stack.item[d]
    if stack.tries[d] == 0:
        stack.lists[d] = listed_values(agenda, v, stack.handler[d])
    values = stack.lists[d]
    if stack.tries[d] >= len(values):
        return NO_CHOICE
    if agenda.probing:
        return APPLIED
    stack.choose(d, stack.tries[d])
    agenda.engine.decide(v, values[stack.cursor[d]], NONE, NONE)
    return APPLIED if fire(agenda.plan) else FAILED_CHOICE


def _mend_threat(agenda: Agenda, stack: Decisions, d: int) -> int:
    """Order a token at its next insertion on a timeline; `cursor` is the last one tried."""
    t = stack.item[d]
    if stack.pool_count[d] < 0:
        list_insertions(agenda, stack, d, t)
        if agenda.table.handler_code[stack.handler[d]] == HANDLER_HSTS_THREAT:
            sort_insertions(agenda, stack, d)
    step = stack.cursor[d] + 1
    while step < stack.pool_count[d]:
        at = stack.pool_first[d] + step
        before = stack.pool_before[at]
        after = stack.pool_after[at]
        if is_open_insertion(agenda, t, before, after):
            if agenda.probing:
                return APPLIED
            stack.choose(d, step)
            if not order(agenda.plan, stack.pool_object[at], before, after, NONE):
                return FAILED_CHOICE
            return APPLIED if fire(agenda.plan) else FAILED_CHOICE
        step += 1
    return NO_CHOICE
