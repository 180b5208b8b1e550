"""List the pairs of uses that EUROPA would order at an instant, in its order and with the filters of a handler."""

from runtime.solver.flaws.agenda import Queues
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.tags import NONE

Pair = tuple[int, int]  # indices of timepoints: the first is to come before the second


def sorted_pairs(q: Queues, stack: Decisions, d: int) -> int:
    """Put all pairs into the pool of decision `d`; whether they can be ordered is asked when their turn comes."""
    uses = q.uses
    engine = q.engine
    at = stack.other[d]
    uses.gather(stack.item[d])
    points = range(uses.count)
    here = [engine.lb[uses.point[k]] <= at <= engine.ub[uses.point[k]] for k in points]
    handler = q.treatments.matching.handlers[stack.handler[d]]
    found = [
        (i, j)
        for i in points
        for j in points
        if i != j and (here[i] or here[j]) and is_kept(q, stack, d, i, j, handler.keep) and may_meet(q, i, j)
    ]
    found.sort(key=lambda pair: rank(q, pair, handler.order))
    for i, j in found:
        stack.add_to_pool(d, NONE, uses.point[i], uses.point[j])
    return 0


def may_meet(q: Queues, i: int, j: int) -> bool:
    """Whether two timepoints have a time in common."""
    engine, point = q.engine, q.uses.point
    return engine.lb[point[i]] <= engine.ub[point[j]] and engine.lb[point[j]] <= engine.ub[point[i]]


def is_kept(q: Queues, stack: Decisions, d: int, i: int, j: int, keep: str) -> bool:
    """Whether a pair passes the handler's filter: its second part takes by then, its first gives later."""
    uses, engine = q.uses, q.engine
    at, taker = stack.other[d], 1 if stack.phase[d] else 0
    if keep in ("successor", "both") and (uses.takes[j] != taker or engine.lb[uses.point[j]] > at):
        return False
    return not (keep in ("predecessorNot", "both") and (uses.takes[i] == taker or engine.ub[uses.point[i]] <= at))


def rank(q: Queues, pair: Pair, order: tuple[str, ...]) -> tuple[int, ...]:
    """What sorts pairs: smaller first; what the order leaves open is settled by the ids of the timepoints."""
    engine, point = q.engine, q.uses.point
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
