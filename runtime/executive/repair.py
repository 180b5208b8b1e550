"""Repair a plan that no longer agrees with the world: undo what has not begun, and if need be forget the past."""

from runtime.executive.past import Past
from runtime.executive.timelines import NOTHING, Goal, TimelineState
from runtime.executive.view import SPAN_CLOCK
from runtime.executive.workbench import Workbench


def relax(
    bench: Workbench, timelines: list[TimelineState], goals: list[Goal], past: Past, tick: int, *, forget: bool
) -> bool:
    """Take back all decisions about tokens that have not begun before `tick`; goals become open again (T-REX 1.9).

    What holds now is fact, observed or not, and stays. With `forget`, what is over is dropped, with what follows from
    it alone; that it has happened is kept, for rules that look back, and what it gave to reservoirs or took from them.
    Goals that are too late are removed. False if even that is inconsistent.
    """
    bench.recorder.cut()
    seen = hold_present(bench, timelines)
    if forget:
        present = {token for line in timelines for token in (line.current, seen.get(line.name, NOTHING))}
        happened, uses = past.outlines(tick), past.uses(tick)
        over = [token for token in bench.all_tokens() if bench.is_over(token, tick) and not bench.is_kept(token)]
        forgotten = [token for token in over if token not in present]
        # What asked for these may have been archived.
        met = [line.current for line in timelines if not line.is_internal and line.current != NOTHING]
        met = [token for token in met if token not in seen.values()]
        forgotten += [token for token in met if bench.is_nobodys(token)]
        for token in forgotten:
            bench.recorder.detach(token)
        bench.remove(forgotten)
        for token in met:  # what runs and asked for these finds what was observed anew
            if not bench.is_freed(token):
                bench.cancel(token)
    bench.forget_orders()
    for token in bench.all_tokens():
        if not bench.is_freed(token) and bench.is_waiting(token, tick):
            bench.cancel(token)
    if forget and not past.put_back_uses(uses):
        return False
    stand(bench, timelines, seen, is_every=forget)
    late = []
    for goal in goals:
        if bench.is_alive(goal.token, goal.token_key) and bench.is_waiting(goal.token, tick):
            if bench.upper(bench.start(goal.token)) < tick:
                late.append(goal.token)
            elif not bench.at_least(bench.start(goal.token), tick, SPAN_CLOCK, goal.token):
                late.append(goal.token)
                bench.remove([goal.token])
    if late:
        bench.remove([token for token in late if not bench.is_freed(token)])
        stand(bench, timelines, seen)
    if not bench.is_consistent():
        return False
    if forget:
        past.keep(happened)
    return bench.is_consistent()


def hold_present(bench: Workbench, timelines: list[TimelineState]) -> dict[str, int]:
    """See to it that what has been published or observed stays, whatever is taken back; the observations by timeline.

    A token may have begun before the one that asked for it.
    """
    for line in timelines:
        if line.is_internal and line.current != NOTHING:
            bench.detach(line.current)
    return {line.name: bench.fact_of(line.current) for line in timelines if not line.is_internal}


def stand(bench: Workbench, timelines: list[TimelineState], seen: dict[str, int], *, is_every: bool = False) -> None:
    """Let observations stand by themselves where what was planned for them is gone (`is_every`: all of them)."""
    for line in timelines:
        if line.is_internal or line.current == NOTHING or line.current == seen[line.name]:
            continue
        if is_every or bench.stands_for(seen[line.name]) != line.current:
            line.current = seen[line.name]
            bench.stand_alone(line.current, line.object_id)
