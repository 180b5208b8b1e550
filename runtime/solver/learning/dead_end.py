"""Dead ends: why no resolver is left. What pruned the resolvers never tried completes the conflict set."""

from math import inf

from runtime.constraints.domains.tags import FLOAT_TOLERANCE, SIDE_LOWER, SIDE_UPPER
from runtime.constraints.propagators.logic import may_be_equal
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
from runtime.solver.learning.conflict_analysis import ConflictAnalysis
from runtime.solver.tags import (
    EVERYTHING,
    FILTER_GUARD,
    FILTER_HORIZON,
    FILTER_HORIZON_VARIABLE,
    FILTER_NOT_ASSIGNED,
    FILTER_NOT_GUARD,
    FILTER_PARENT_NOT_ASSIGNED,
    HANDLER_HSTS,
    NOW,
    OPEN_CONDITION,
    POLICY_PARTIAL,
    PRECEDES_ONLY,
    RESOURCE_THREAT,
    THREAT,
    UNBOUND_VARIABLE,
)

_MOST_SEEDS = 8


def explain_dead_end(analysis: ConflictAnalysis, d: int) -> int:
    """Add the decisions that pruned resolvers of decision `d`, and those that brought its flaw, to its conflict set."""
    agenda = analysis.agenda
    stack = analysis.stack
    item = stack.item[d]
    kind = stack.kind[d]
    if stack.reasons[d] == EVERYTHING:
        return 0
    if agenda.plan.loops_read_choices or stack.handler[d] < 0 or agenda.table.handler_most[stack.handler[d]] != 0:
        stack.rest_on_everything(d)
        return 0
    analysis.begin()
    is_known = False
    if kind == UNBOUND_VARIABLE:
        is_known = _explain_variable(analysis, d, item)
    elif kind == OPEN_CONDITION:
        is_known = _explain_scope(analysis, agenda.token_row[item * agenda.managers + stack.manager[d]], item)
        _explain_merging(analysis, d, item)
    elif kind == THREAT:
        is_known = _explain_scope(analysis, agenda.token_row[item * agenda.managers + stack.manager[d]], item)
        _explain_insertions(analysis, item)
    elif kind == RESOURCE_THREAT:
        is_known = _explain_resource(analysis, d, item)
    if not is_known:
        stack.rest_on_everything(d)
        return 0
    analysis.walk()
    analysis.keep(d)
    return 0


def _explain_variable(analysis: ConflictAnalysis, d: int, v: int) -> bool:
    """Why a variable has no other values, and is a flaw; False if that has no simple reason."""
    agenda = analysis.agenda
    analysis.meet(agenda.variable_level[v])
    t = agenda.filters.token_of(v)
    if t >= 0:
        analysis.meet(agenda.active_level[t])
    analysis.ask_domain(v)
    return _explain_scope(analysis, agenda.variable_row[v * agenda.managers + analysis.stack.manager[d]], t)


def _explain_scope(analysis: ConflictAnalysis, row: int, t: int) -> bool:
    """Why no filter excludes the flaw of token `t` (NONE: of no token); False if one may later.

    Most filters stop excluding a flaw once bounds are tight enough, for good: these bounds are the reason.
    """
    agenda = analysis.agenda
    table = agenda.table
    if table.handler_count[row] != 1:
        return False
    if agenda.filters.has_scope and t >= 0:
        _explain_times(analysis, t)
    first = table.filter_first[row]
    for f in range(first, first + table.filter_count[row]):
        code = table.filter_code[f]
        if code == FILTER_GUARD or code == FILTER_NOT_GUARD:
            return False
        if (code == FILTER_HORIZON or code == FILTER_HORIZON_VARIABLE) and t >= 0:
            if table.filter_policy[f] == POLICY_PARTIAL:
                analysis.ask_enough(agenda.rows.var0[t] + END, SIDE_LOWER, agenda.filters.lower + 1)
                analysis.ask_enough(agenda.rows.var0[t] + START, SIDE_UPPER, agenda.filters.upper - 1)
            elif _may_leave(analysis, t):
                return False
            else:
                _explain_times(analysis, t)
        if code == FILTER_NOT_ASSIGNED and t >= 0:
            _explain_assigned(analysis, t)
        if code == FILTER_PARENT_NOT_ASSIGNED and t >= 0 and agenda.rows.parent[t] >= 0:
            _explain_assigned(analysis, agenda.rows.parent[t])
    return True


def _may_leave(analysis: ConflictAnalysis, t: int) -> bool:
    """Whether the times of `t` may still leave the horizon."""
    lb = analysis.engine.lb
    ub = analysis.engine.ub
    filters = analysis.agenda.filters
    start = analysis.agenda.rows.var0[t] + START
    end = analysis.agenda.rows.var0[t] + END
    return lb[start] < filters.lower or ub[start] > filters.upper or lb[end] < filters.lower or ub[end] > filters.upper


def _explain_times(analysis: ConflictAnalysis, t: int) -> None:
    """Ask for both bounds of the times of a token."""
    analysis.ask_domain(analysis.agenda.rows.var0[t] + START)
    analysis.ask_domain(analysis.agenda.rows.var0[t] + END)


def _explain_assigned(analysis: ConflictAnalysis, t: int) -> None:
    """Why a token is active, on a known object, and ordered there."""
    analysis.meet(analysis.agenda.active_level[t])
    analysis.meet(analysis.agenda.order_level[t])
    analysis.ask_domain(analysis.agenda.rows.var0[t] + OBJECT)


def _explain_merging(analysis: ConflictAnalysis, d: int, t: int) -> None:
    """Why a token has no other merge candidates: its domains and theirs, and tokens that might have been."""
    agenda = analysis.agenda
    rows = agenda.rows
    analysis.meet(agenda.token_level[t])
    analysis.ask_domain(rows.var0[t] + STATE)
    predicate = rows.predicate[t]
    candidate = first_active(agenda.plan, predicate)
    while candidate >= 0:
        analysis.meet(agenda.active_level[candidate])
        _explain_difference(analysis, rows.var0[t], rows.var0[candidate], rows.width[t])
        candidate = next_active(agenda.plan, candidate, predicate)
    analysis.explain_absence(d, predicate)
    handler = agenda.table.handler_code[analysis.stack.handler[d]]
    if handler == HANDLER_HSTS and agenda.plan.predicate_timeline[predicate]:
        _explain_insertions(analysis, t)


def _explain_difference(analysis: ConflictAnalysis, mine: int, theirs: int, width: int) -> int:
    """Why two tokens are incompatible, if they are: variables without a common value, times that differ."""
    for k in range(OBJECT, width):
        if not may_be_equal(analysis.engine, mine + k, theirs + k):
            analysis.ask_domain(mine + k)
            analysis.ask_domain(theirs + k)
            return 0
    for k in range(START, END + 1):
        if analysis.explain_edge(mine + k, theirs + k, 0) or analysis.explain_edge(theirs + k, mine + k, 0):
            return 0
    return 0


def _explain_insertions(analysis: ConflictAnalysis, t: int) -> None:
    """Why a token has no other insertions: its objects, the tokens ordered there, and the gaps that are too short."""
    agenda = analysis.agenda
    v = agenda.rows.var0[t] + OBJECT
    analysis.meet(agenda.active_level[t])
    analysis.ask_domain(v)
    for o in range(analysis.engine.lb[v], analysis.engine.ub[v] + 1):
        if agenda.plan.object_timeline[o] and analysis.agenda.engine.contains(v, o):
            other = agenda.rows.head_first[agenda.plan.object_head[o]]
            while other >= 0:
                analysis.meet(agenda.order_level[other])
                after = agenda.rows.link_after[LISTS * other + LIST_ORDER]
                _explain_insertion(analysis, t, other, after)
                other = after


def _explain_insertion(analysis: ConflictAnalysis, t: int, other: int, after: int) -> None:
    """Why a token fits neither before another one, nor behind it, nor between it and the next (NONE: none)."""
    var0 = analysis.agenda.rows.var0
    lb = analysis.engine.lb
    ub = analysis.engine.ub
    analysis.explain_edge(var0[other] + START, var0[t] + END, 0)
    analysis.explain_edge(var0[t] + START, var0[other] + END, 0)
    if after >= 0 and ub[var0[after] + START] - lb[var0[other] + END] < lb[var0[t] + DURATION]:
        analysis.ask(var0[other] + END, SIDE_LOWER, NOW)
        analysis.ask(var0[after] + START, SIDE_UPPER, NOW)
        analysis.ask(var0[t] + DURATION, SIDE_LOWER, NOW)


def _explain_resource(analysis: ConflictAnalysis, d: int, o: int) -> bool:
    """Why no precedence mends a flaw of resource `o`; False if that has no simple reason.

    The takers by then exceed the resource unless one of them follows one of the givers, and each such precedence is
    impossible. Judged by the certain part of the quantities.
    """
    agenda = analysis.agenda
    stack = analysis.stack
    engine = analysis.engine
    uses = agenda.plan.resources
    handler = stack.handler[d]
    if agenda.exact or not agenda.table.pairs_by_default[handler] or uses.steps.get(o):
        return False
    if agenda.table.handler_constraint[handler] != PRECEDES_ONLY:
        return False
    uses.is_quiet()
    at = stack.instant[d]
    sign = -1 if stack.is_low[d] else 1
    latest = engine.lb if uses.is_grounded(o) else engine.ub
    takers: list[int] = []
    givers: list[int] = []  # points
    owners: list[int] = []  # the uses they belong to
    at_first = o * LIMITS + INITIAL
    level = uses.upper(at_first, 0.0) if sign < 0 else uses.lower(at_first, 0.0)
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
                analysis.explain_use(u, d)
                analysis.ask(uses.quantity[u], SIDE_UPPER, NOW)
    side = MINIMUM if sign < 0 else MAXIMUM
    limit = uses.lower(o * LIMITS + side, -inf) if sign < 0 else uses.upper(o * LIMITS + side, inf)
    charged = [u for u in takers if not _is_behind(analysis, uses.start[u], u, givers, owners)] if lasts else []
    for k in range(0 if lasts else min(len(takers), _MOST_SEEDS)):
        charged = _unordered(analysis, takers, takers[k])
        if limit - level + sum([uses.least[u] for u in charged]) > FLOAT_TOLERANCE:
            break
    for u in charged:
        level += uses.sign[u] * uses.least[u]
        analysis.explain_use(u, d)
        analysis.ask(uses.quantity[u], SIDE_LOWER, NOW)
    if (limit - level if sign < 0 else level - limit) <= FLOAT_TOLERANCE:
        return False
    for which in (INITIAL, side):
        v = uses.limits[o * LIMITS + which]
        if v >= 0:
            analysis.ask_domain(v)
    for k in range(len(givers)):
        if owners[k] in takers and owners[k] not in charged:
            continue
        for u in charged:
            if owners[k] != u:
                analysis.explain_edge(uses.start[u], givers[k], 0)
    return not lasts or analysis.explain_helpers(o, -sign, d)


def _unordered(analysis: ConflictAnalysis, takers: list[int], first: int) -> list[int]:
    """Uses with an end, `first` among them, of which none is known to come after another."""
    uses = analysis.agenda.plan.resources
    found = [first]
    for u in takers:
        if u != first:
            ends = [uses.end[w] for w in found]
            is_free = not _is_behind(analysis, uses.start[u], u, ends, found)
            for w in found:
                is_free = is_free and not _is_behind(analysis, uses.start[w], w, [uses.end[u]], [u])
            if is_free:
                found.append(u)
    return found


def _is_behind(analysis: ConflictAnalysis, point: int, u: int, givers: list[int], owners: list[int]) -> bool:
    """Whether the start of use `u` is known to come after one of the givers of others."""
    engine = analysis.engine
    for k in range(len(givers)):
        v = givers[k]
        if owners[k] != u and (engine.ub[v] <= engine.lb[point] or not analysis.agenda.distances.admits(v, point, -1)):
            return True
    return False
