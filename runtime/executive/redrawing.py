"""Draw anew for what begins at another tick than it was planned for; in a simulator no draw rules out what waits.

What holds for a token is drawn at the tick at which it begins (T-REX 3.4), so a draw of an earlier tick decides neither
whether a command is taken in nor what else finds room behind it. That of the first tick at which it can begin decides.
"""

from runtime.executive.draws import Draws
from runtime.executive.goals import Goals
from runtime.executive.repair import hold_present, stand
from runtime.executive.story import conflict_of
from runtime.executive.timelines import NOTHING
from runtime.executive.workbench import Workbench


def draw_anew(bench: Workbench, draws: Draws, goals: Goals, tick: int) -> bool:
    """Draw again for tokens that do not begin at the tick they were drawn for; false on conflict."""
    holds = True
    for token in draws.outdated(bench, tick):
        if not bench.is_active(token):
            continue  # it has made way
        holds = _renew(bench, draws, goals, token)
        if not holds and draws.is_reactive:
            holds = _begin_first(bench, draws, goals, token, tick) or _settle(bench, draws, goals, token, tick)
        if not holds:
            break
    draws.begins = {}
    return holds


def _renew(bench: Workbench, draws: Draws, goals: Goals, token: int) -> bool:
    """Let the rules of a token fire anew; what they asked for and has begun before it goes on, and they find it."""
    draws.undrawn.pop(token, None)  # a guard may have to be decided before they draw
    if not any(_asked_for(bench, line.current, token) for line in goals.timelines):
        return bench.renew(token)
    seen = hold_present(bench, goals.timelines)
    holds = bench.renew(token)
    stand(bench, goals.timelines, seen)
    return holds


def _asked_for(bench: Workbench, t: int, token: int) -> bool:
    """Whether the rules of `token`, or of what they asked for, asked for `t`."""
    while t != NOTHING and (t := bench.parent(t)) >= 0:
        if t == token:
            return True
    return False


def _begin_first(bench: Workbench, draws: Draws, goals: Goals, token: int, tick: int) -> bool:
    """Let what else was asked for and waits make way for a token that may begin now; it is planned again."""
    own = bench.root(token)
    for goal in goals.live():
        other = goal.token
        if other != own and bench.is_alive(other, goal.token_key) and bench.is_waiting(other, tick):
            bench.cancel(other)
    return _renew(bench, draws, goals, token)


def _settle(bench: Workbench, draws: Draws, goals: Goals, token: int, tick: int) -> bool:
    """Let wait what cannot begin now whatever is drawn; where only the draw is in the way, give up its goal."""
    conflict = conflict_of(bench)
    draws.is_put_off = True
    holds = _renew(bench, draws, goals, token)
    draws.is_put_off = False
    if holds and bench.lower(bench.start(token)) > tick:
        return True
    return goals.reject(bench.root(token), tick, conflict)


def leave_open(bench: Workbench, draws: Draws, goals: Goals, tick: int) -> bool:
    """Whether to plan again with nothing drawn for what begins after `tick`; it is drawn for as it begins."""
    if draws.is_put_off or not draws.is_reactive or not draws.open:
        return False
    draws.is_put_off = True
    for token in draws.waiting(bench, tick):
        _renew(bench, draws, goals, token)
    for token in goals.missed():
        goals.rejections.pop(token, None)
        bench.cancel(token)
    return True
