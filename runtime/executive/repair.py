"""Repair a plan that no longer agrees with the world: undo what has not begun, and if need be forget the past."""

from runtime.executive.timelines import NOTHING, Goal, TimelineState
from runtime.executive.view import SPAN_CLOCK
from runtime.executive.workbench import Workbench


def relax(bench: Workbench, timelines: list[TimelineState], goals: list[Goal], tick: int, *, forget: bool) -> bool:
    """Take back all decisions about tokens that have not begun before `tick`; goals become open again (T-REX 1.9).

    With `forget`, what is over is dropped too, and the present values of the reactor's own timelines; what others
    published stays. Goals that are too late are removed. False if even that is inconsistent.
    """
    seen = {line.name: bench.fact_of(line.current) for line in timelines if not line.is_internal}
    if forget:
        present = set(seen.values())
        bench.remove([token for token in bench.all_tokens() if bench.is_over(token, tick) and token not in present])
    for token in bench.all_tokens():
        if not bench.is_freed(token) and bench.is_waiting(token, tick):
            bench.cancel(token)
    if forget:
        for line in timelines:
            if line.is_internal and line.current != NOTHING:
                bench.remove([line.current])
                line.current = NOTHING
        for line in timelines:
            if not line.is_internal and line.current != NOTHING:
                # Whatever was planned for it is gone: the observation stands by itself again.
                line.current = seen[line.name]
                bench.stand_alone(line.current, line.object_id)
    for goal in goals:
        if bench.is_alive(goal.token, goal.token_key) and bench.is_waiting(goal.token, tick):
            if not bench.at_least(bench.start(goal.token), tick, SPAN_CLOCK, goal.token):
                bench.remove([goal.token])
    return bench.is_consistent()
