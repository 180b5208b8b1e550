"""Precedences that EUROPA tries for a resource flaw, in its order and with the filters of a handler."""

from runtime.solver.flaws.agenda import Agenda
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.tags import NONE

_Pair = tuple[int, int]  # indices of timepoints, in the order to post


def sorted_pairs(agenda: Agenda, stack: Decisions, d: int) -> None:
    """List all pairs in the pool of decision `d`; whether they can be ordered is asked when their turn comes."""
    uses = agenda.uses
    engine = agenda.engine
    at = stack.instant[d]
    uses.gather(stack.item[d])
    points = range(uses.count)
    here = [engine.lb[uses.point[k]] <= at <= engine.ub[uses.point[k]] for k in points]
    handler = agenda.table.matching.handlers[stack.handler[d]]
    found = [
        (i, j)
        for i in points
        for j in points
        if i != j
        and (here[i] or here[j])
        and _is_kept(agenda, stack, d, i, j, handler.keep)
        and _may_meet(agenda, i, j)
    ]
    found.sort(key=lambda pair: _rank(agenda, pair, handler.order))
    for i, j in found:
        stack.add_to_pool(d, NONE, uses.point[i], uses.point[j])


def _may_meet(agenda: Agenda, i: int, j: int) -> bool:
    """Whether two timepoints have a time in common."""
    engine, point = agenda.engine, agenda.uses.point
    return engine.lb[point[i]] <= engine.ub[point[j]] and engine.lb[point[j]] <= engine.ub[point[i]]


def _is_kept(agenda: Agenda, stack: Decisions, d: int, i: int, j: int, keep: str) -> bool:
    """Whether a pair passes the handler's filter: its second part takes by then, its first gives later."""
    uses, engine = agenda.uses, agenda.engine
    at, taker = stack.instant[d], 1 if stack.is_low[d] else 0
    if keep in ("successor", "both") and (uses.takes[j] != taker or engine.lb[uses.point[j]] > at):
        return False
    return not (keep in ("predecessorNot", "both") and (uses.takes[i] == taker or engine.ub[uses.point[i]] <= at))


def _rank(agenda: Agenda, pair: _Pair, order: tuple[str, ...]) -> tuple[int, ...]:
    """Sort key of pairs; ties are broken by the ids of the timepoints."""
    engine, point = agenda.engine, agenda.uses.point
    ranks = []
    for name in order:
        if name == "leastImpact":
            a, b = point[pair[0]], point[pair[1]]
            ranks.append(max(engine.lb[a] - engine.lb[b], 0, engine.ub[a] - engine.ub[b]))
            continue
        v = point[pair[0] if name.endswith("Predecessor") else pair[1]]
        word = name.removesuffix("Predecessor").removesuffix("Successor")
        ranks.append(
            {
                "earliest": engine.lb[v],
                "latest": -engine.ub[v],
                "longest": engine.lb[v] - engine.ub[v],
                "shortest": engine.ub[v] - engine.lb[v],
                "ascendingKey": v,
                "descendingKey": -v,
            }[word]
        )
    return (*ranks, point[pair[0]], point[pair[1]])
