"""Say why a decision has no more choices: what took away those that were never tried completes its reasons."""

from runtime.constraints.domains.tags import FLOAT_TOLERANCE, SIDE_LOWER, SIDE_UPPER
from runtime.plan.tags import (
    DURATION,
    END,
    INITIAL,
    LIMITS,
    LIST_ORDER,
    LISTS,
    MAXIMUM,
    MINIMUM,
    OBJECT,
    START,
    STATE,
)
from runtime.plan.tokens.predicate_hierarchy import first_active, next_active
from runtime.solver.learning.conflict_analysis import Blame
from runtime.solver.tags import (
    EVERYTHING,
    FILTER_GUARD,
    FILTER_HORIZON,
    FILTER_HORIZON_VARIABLE,
    FILTER_MASTER_LOOSE,
    FILTER_NOT_GUARD,
    FILTER_TOKEN_LOOSE,
    HANDLER_HSTS,
    NOW,
    OPEN_CONDITION,
    POLICY_PARTIAL,
    PRECEDES_ONLY,
    RESOURCE_THREAT,
    THREAT,
    UNBOUND_VARIABLE,
)

MOST_SEEDS = 8


def complete(b: Blame, d: int) -> int:
    """Add what took choices away from decision `d` before they were tried, and why there is something to decide."""
    q = b.queues
    stack = b.stack
    item = stack.item[d]
    kind = stack.kind[d]
    if stack.reasons[d] == EVERYTHING:
        return 0
    if q.plan.loops_read_choices or stack.handler[d] < 0 or q.treatments.handler_most[stack.handler[d]] != 0:
        stack.reasons[d] = EVERYTHING
        return 0
    b.begin()
    is_known = False
    if kind == UNBOUND_VARIABLE:
        is_known = blame_variable(b, d, item)
    elif kind == OPEN_CONDITION:
        is_known = blame_scope(b, q.token_row[item * q.managers + stack.manager[d]], item)
        blame_partners(b, d, item)
    elif kind == THREAT:
        is_known = blame_scope(b, q.token_row[item * q.managers + stack.manager[d]], item)
        blame_neighbours(b, item)
    elif kind == RESOURCE_THREAT:
        is_known = blame_instant(b, d, item)
    if not is_known:
        stack.reasons[d] = EVERYTHING
        return 0
    b.walk()
    b.keep(d)
    return 0


def blame_variable(b: Blame, d: int, v: int) -> bool:
    """Why a variable has no more values, and is to be decided; False if that has no simple reason."""
    q = b.queues
    b.meet(q.variable_level[v])
    t = q.filters.token_of(v)
    if t >= 0:
        b.meet(q.active_level[t])
    b.ask_domain(v)
    return blame_scope(b, q.variable_row[v * q.managers + b.stack.manager[d]], t)


def blame_scope(b: Blame, row: int, t: int) -> bool:
    """Why no filter keeps back what is to be mended for token `t` (NONE: for nobody); False if one yet may.

    Most filters let go of what becomes more definite, and keep it no more after that: the bounds are the reason.
    """
    q = b.queues
    treatments = q.treatments
    if treatments.handler_count[row] != 1:
        return False
    if q.filters.has_scope and t >= 0:
        blame_all_times(b, t)
    first = treatments.filter_first[row]
    for f in range(first, first + treatments.filter_count[row]):
        code = treatments.filter_code[f]
        if code == FILTER_GUARD or code == FILTER_NOT_GUARD:
            return False
        if (code == FILTER_HORIZON or code == FILTER_HORIZON_VARIABLE) and t >= 0:
            if treatments.filter_policy[f] == POLICY_PARTIAL:
                b.ask_enough(q.rows.var0[t] + END, SIDE_LOWER, q.filters.lower + 1)
                b.ask_enough(q.rows.var0[t] + START, SIDE_UPPER, q.filters.upper - 1)
            elif may_leave(b, t):
                return False
            else:
                blame_all_times(b, t)
        if code == FILTER_TOKEN_LOOSE and t >= 0:
            blame_assigned(b, t)
        if code == FILTER_MASTER_LOOSE and t >= 0 and q.rows.parent[t] >= 0:
            blame_assigned(b, q.rows.parent[t])
    return True


def may_leave(b: Blame, t: int) -> bool:
    """Whether the times of `t` may still leave the horizon."""
    lb = b.engine.lb
    ub = b.engine.ub
    filters = b.queues.filters
    start = b.queues.rows.var0[t] + START
    end = b.queues.rows.var0[t] + END
    return lb[start] < filters.lower or ub[start] > filters.upper or lb[end] < filters.lower or ub[end] > filters.upper


def blame_all_times(b: Blame, t: int) -> int:
    """Ask for both bounds of the times of a token."""
    b.ask_domain(b.queues.rows.var0[t] + START)
    b.ask_domain(b.queues.rows.var0[t] + END)
    return 0


def blame_assigned(b: Blame, t: int) -> int:
    """Why a token is active, on a known object, and has its place there."""
    b.meet(b.queues.active_level[t])
    b.meet(b.queues.order_level[t])
    b.ask_domain(b.queues.rows.var0[t] + OBJECT)
    return 0


def blame_partners(b: Blame, d: int, t: int) -> int:
    """Why a token had no more to merge with: what it and each candidate are, and who else might have come."""
    q = b.queues
    rows = q.rows
    b.meet(q.token_level[t])
    b.ask_domain(rows.var0[t] + STATE)
    predicate = rows.predicate[t]
    candidate = first_active(q.plan, predicate)
    while candidate >= 0:
        b.meet(q.active_level[candidate])
        blame_difference(b, rows.var0[t], rows.var0[candidate], rows.width[t])
        candidate = next_active(q.plan, candidate, predicate)
    b.blame_absence(d, predicate)
    if q.treatments.handler_code[b.stack.handler[d]] == HANDLER_HSTS and q.plan.predicate_timeline[predicate]:
        blame_neighbours(b, t)
    return 0


def blame_difference(b: Blame, mine: int, theirs: int, width: int) -> int:
    """Why two tokens are incompatible, if they are: variables without a common value, times that differ."""
    for k in range(OBJECT, width):
        if not b.engine.intersects(mine + k, theirs + k):
            b.ask_domain(mine + k)
            b.ask_domain(theirs + k)
            return 0
    for k in range(START, END + 1):
        if b.blame_edge(mine + k, theirs + k, 0) or b.blame_edge(theirs + k, mine + k, 0):
            return 0
    return 0


def blame_neighbours(b: Blame, t: int) -> int:
    """Why a token had no more places: its objects, all who have a place there, and where it could not fit."""
    q = b.queues
    v = q.rows.var0[t] + OBJECT
    b.meet(q.active_level[t])
    b.ask_domain(v)
    for o in range(b.engine.lb[v], b.engine.ub[v] + 1):
        if q.plan.object_timeline[o] and b.engine.contains(v, o):
            other = q.rows.head_first[q.plan.object_head[o]]
            while other >= 0:
                b.meet(q.order_level[other])
                after = q.rows.link_after[LISTS * other + LIST_ORDER]
                blame_times(b, t, other, after)
                other = after
    return 0


def blame_times(b: Blame, t: int, other: int, after: int) -> int:
    """Why a token fits neither before another one, nor behind it, nor between it and the one after (NONE: none)."""
    var0 = b.queues.rows.var0
    lb = b.engine.lb
    ub = b.engine.ub
    b.blame_edge(var0[other] + START, var0[t] + END, 0)
    b.blame_edge(var0[t] + START, var0[other] + END, 0)
    if after >= 0 and ub[var0[after] + START] - lb[var0[other] + END] < lb[var0[t] + DURATION]:
        b.ask(var0[other] + END, SIDE_LOWER, NOW)
        b.ask(var0[after] + START, SIDE_UPPER, NOW)
        b.ask(var0[t] + DURATION, SIDE_LOWER, NOW)
    return 0


def blame_instant(b: Blame, d: int, o: int) -> bool:
    """Why uses of resource `o` cannot be ordered so that an instant is mended; False if that has no simple reason.

    Together, takers by then exceed the resource unless one of them comes after one of the givers; of each such pair
    it is known why it cannot be. That is looked at again here, with what is certain of the quantities.
    """
    q = b.queues
    stack = b.stack
    engine = b.engine
    uses = q.plan.resources
    handler = stack.handler[d]
    if q.exact or not q.treatments.pairs_by_default[handler] or uses.steps.get(o):
        return False
    if q.treatments.handler_constraint[handler] != PRECEDES_ONLY:
        return False
    uses.is_quiet()
    at = stack.other[d]
    sign = -1 if stack.phase[d] else 1
    latest = engine.lb if q.uses.grounded[o] else engine.ub
    takers: list[int] = []
    givers: list[int] = []  # points
    owners: list[int] = []  # the uses they belong to
    level = q.uses.limit(o, INITIAL, 1 if sign < 0 else 0)
    lasts = False
    for u in range(uses.count):
        if uses.sign[u] == 0 or uses.on[u] != o:
            continue
        if uses.end[u] >= 0:
            if sign > 0:
                return False
            if engine.lb[uses.start[u]] <= at < latest[uses.end[u]]:
                takers.append(u)
                givers.append(uses.end[u])
                owners.append(u)
        else:
            lasts = True
            if uses.sign[u] == sign:
                if engine.lb[uses.start[u]] <= at:
                    takers.append(u)
            elif latest[uses.start[u]] > at:
                givers.append(uses.start[u])
                owners.append(u)
            else:
                level += uses.sign[u] * uses.most[u]
                b.blame_use(u, d)
                b.ask(uses.quantity[u], SIDE_UPPER, NOW)
    side = MINIMUM if sign < 0 else MAXIMUM
    limit = q.uses.limit(o, side, 0 if sign < 0 else 1)
    charged = [u for u in takers if not is_behind(b, uses.start[u], u, givers, owners)] if lasts else []
    for k in range(0 if lasts else min(len(takers), MOST_SEEDS)):
        charged = unordered(b, takers, takers[k])
        if limit - level + sum([uses.least[u] for u in charged]) > FLOAT_TOLERANCE:
            break
    for u in charged:
        level += uses.sign[u] * uses.least[u]
        b.blame_use(u, d)
        b.ask(uses.quantity[u], SIDE_LOWER, NOW)
    if (limit - level if sign < 0 else level - limit) <= FLOAT_TOLERANCE:
        return False
    for place in (INITIAL, side):
        v = uses.limits[o * LIMITS + place]
        if v >= 0:
            b.ask_domain(v)
    for k in range(len(givers)):
        if owners[k] in takers and owners[k] not in charged:
            continue
        for u in charged:
            if owners[k] != u:
                b.blame_edge(uses.start[u], givers[k], 0)
    return not lasts or b.blame_helpers(o, -sign, d)


def unordered(b: Blame, takers: list[int], first: int) -> list[int]:
    """Uses that hold a resource for a while, `first` among them, of which none is known to come after another."""
    uses = b.queues.plan.resources
    found = [first]
    for u in takers:
        if u != first:
            ends = [uses.end[w] for w in found]
            is_free = not is_behind(b, uses.start[u], u, ends, found)
            for w in found:
                is_free = is_free and not is_behind(b, uses.start[w], w, [uses.end[u]], [u])
            if is_free:
                found.append(u)
    return found


def is_behind(b: Blame, point: int, u: int, givers: list[int], owners: list[int]) -> bool:
    """Whether the start of use `u` is known to come after one of the givers of others."""
    engine = b.engine
    for k in range(len(givers)):
        v = givers[k]
        if owners[k] != u and (engine.ub[v] <= engine.lb[point] or not b.queues.distances.admits(v, point, -1)):
            return True
    return False
