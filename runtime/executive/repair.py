"""Repair a plan that no longer agrees with the world: undo what has not begun, and if need be forget the past."""

from runtime.executive.timelines import NOTHING, Goal, TimelineState
from runtime.executive.workbench import SPAN_CLOCK, Workbench


def relax(bench: Workbench, timelines: list[TimelineState], goals: list[Goal], tick: int, *, forget: bool) -> bool:
    """Take back all decisions about tokens that have not begun before `tick`; goals become open again (T-REX 1.9).

    With `forget`, what is over is dropped too, and the present values of the reactor's own timelines; what others
    published stays. Goals that are too late are removed. False if even that is inconsistent.
    """
    for token in bench.all_tokens():
        if bench.is_freed(token):
            continue
        if bench.is_over(token, tick) and forget:
            if not bench.is_observed(token):
                bench.remove([token])
        elif bench.is_waiting(token, tick):
            bench.cancel(token)
    if forget:
        for line in timelines:
            if line.current != NOTHING and line.is_internal:
                bench.remove([line.current])
                line.current = NOTHING
            elif line.current != NOTHING and not bench.is_fact(line.current):
                # A planned token that an observation had met: the observation stands by itself again.
                line.current = bench.separate(line.current, line.object_id)
    for goal in goals:
        if bench.is_alive(goal.token, goal.token_key) and bench.is_waiting(goal.token, tick):
            if not bench.at_least(bench.start(goal.token), tick, SPAN_CLOCK, goal.token):
                bench.remove([goal.token])
    return bench.is_consistent()
