"""What holds a planned token back: an end on another reactor's timeline that is still to be observed."""

from compiler.program import END, START
from runtime.constraints.domains.tags import SUPPORT_EDGE, SUPPORT_RESTRICTION
from runtime.executive.view import SPAN_CLOCK, SPAN_EXECUTIVE
from runtime.executive.workbench import Workbench
from runtime.plan.tags import FLAG_ACTION, FLAG_CONDITION, FLAG_EFFECT, INFINITY, NONE, ROLE_TOKEN


def is_blocked(bench: Workbench, t: int, current: int, tick: int) -> bool:
    """Whether `t` cannot begin before an end that is still to be observed, or its earliest start is only "not yet".

    `current`, the token that holds on the timeline of `t` now, does not block (NONE: it does): it ends when `t`
    begins. Nor does what this reactor may end itself, nor an end that `t` cannot wait for, as it must begin with it.
    """
    ends, start = _awaited_ends(bench, t, current, tick), bench.start(t)
    while ends and is_tied(bench, ends[len(ends) - 1], start):
        ends.pop()
    return len(ends) > 0 or _is_held_back(bench, t, current, tick)


def follows_late(bench: Workbench, t: int, tick: int) -> float:
    """The first tick at which `t` follows nothing that this reactor has not yet begun, or ended, as late as it may.

    An owner that begins `t` before that breaks the plan. What must begin when that does, at the latest, cannot wait.
    `INFINITY` if time alone does not bring it about; an end comes nearer to its latest by no more than one tick a tick.
    """
    engine, start, free, ends = bench.engine, bench.start(t), float(tick), 0
    _gather_followed(bench, t, tick, True)
    for i in range(1, bench.met.count):
        v = bench.met.items[i]
        if _begins_late(bench, v, t) and engine.upper(v) < engine.upper(start) and not _may_follow(bench, v, start, 0):
            return INFINITY
        ends += _ends_late(bench, v, t)
    if ends:  # but for what ends as something else of its own begins
        _gather_followed(bench, t, tick, False)
        for i in range(1, bench.met.count):
            v = bench.met.items[i]
            if _ends_late(bench, v, t) and not _may_follow(bench, v, start, 0):
                free = max(free, tick + engine.upper(v) - engine.lower(v))
    return free


def hangs_on_action(bench: Workbench, t: int) -> bool:
    """Whether `t` is an action, or a condition or an effect of one, or follows from such a token.

    What stands between must not begin as late as it may: that would hold the action back as well.
    """
    while t >= 0:
        if bench.rows.flags[t] & (FLAG_ACTION | FLAG_CONDITION | FLAG_EFFECT):
            return True
        if bench.object_of(t) in bench.late_objects:
            return False
        t = bench.rows.parent[t]
    return False


def due_start(bench: Workbench, t: int, tick: int) -> float:
    """The start of `t` that counts for when its owner is to be asked: the earliest, or, where it may be late, another.

    That is the latest where it follows from a token of this reactor that begins as late as it may. What only follows
    what holds on its own timeline (`Open { meets(Closed c); }`) leaves that as long as it may go on: the latest start
    counts that delays nothing of what is wanted behind it.
    """
    start, wanted, by = bench.start(t), t, t
    if not hangs_on_action(bench, t):
        bench.met.empty(bench.rows.token_count)
        while (by := _wanted_by(bench, wanted)) < 0 and wanted >= 0:
            wanted = bench.following(wanted)
    if by < 0 or bench.waits_for_own(by, tick):
        return bench.upper(start)
    if wanted == t:
        return bench.lower(start)
    mark, begins = bench.mark(), bench.start(wanted)
    is_free = bench.at_most(begins, bench.lower(begins), SPAN_EXECUTIVE, wanted)
    found = bench.upper(start) if is_free else bench.lower(start)
    bench.rewind_to(mark)
    bench.release(mark)
    return found


def _wanted_by(bench: Workbench, t: int) -> int:
    """The token by which `t`, or what follows and asked for it, is asked for from outside of its timeline; or NONE."""
    if t < 0:
        return NONE
    rows, o, followed = bench.rows, bench.object_of(t), bench.met
    i = followed.count
    followed.add(t)
    while i < followed.count:
        one = other = followed.items[i]
        while other >= 0:
            parent = rows.parent[other]
            asking = parent if parent < 0 else bench.stands_for(parent)
            if asking < 0 or bench.object_of(asking) != o:
                return other
            if bench.lower(bench.start(asking)) > bench.lower(bench.start(one)):
                followed.add(asking)
            other = rows.merged[one] if other == one else rows.merged_next[other]
        i += 1
    return NONE


def free_at(bench: Workbench, t: int, current: int, tick: int) -> float:
    """The first tick at which nothing holds `t` back, if nothing happens until then; `INFINITY` if time frees it never.

    The end that it waits for comes nearer to the latest start of `t` by no more than one tick a tick; where both are
    the same, `t` cannot wait for it any more.
    """
    engine, start, free = bench.engine, bench.start(t), float(tick)
    for v in _awaited_ends(bench, t, current, tick):
        if not is_tied(bench, v, start):
            free = max(free, tick + engine.upper(start) - engine.lower(v))
    return INFINITY if _is_held_back(bench, t, current, tick) else free


def keeps_next(bench: Workbench, t: int) -> bool:
    """Whether what comes next waits for the end of `t`, which was asked for, or has gone on when that could not wait.

    What holds there by default ends when something else begins, also where it was asked for itself.
    """
    rows, other = bench.rows, bench.rows.merged[t]
    is_asked = rows.key[t] in bench.asked or bench.lasting.get(bench.object_of(t), NONE) == rows.key[t]
    while other >= 0 and not is_asked:  # after a repair what was asked for is found in what its owner has begun
        is_asked = rows.key[other] in bench.asked
        other = rows.merged_next[other]
    if not is_asked:
        return False
    return not bench.is_met_by(bench.predicate_of(t), bench.defaults.get(bench.object_of(t), NONE))


def is_tied(bench: Workbench, end: int, start: int) -> bool:
    """Whether the plan has something start no later than the very tick of an end that it follows."""
    engine = bench.engine
    if engine.lower(start) != engine.lower(end) or engine.upper(start) != engine.upper(end):
        return False
    return not _may_follow(bench, start, end, 1)


def begin_together(bench: Workbench, t: int, other: int) -> bool:
    """Whether the plan has two tokens begin at one tick, which is still open."""
    engine, start, then = bench.engine, bench.start(t), bench.start(other)
    if engine.lower(start) == engine.upper(start) or engine.lower(start) != engine.lower(then):
        return False
    return engine.upper(start) == engine.upper(then) and _is_same(bench, start, then)


def _awaited_ends(bench: Workbench, t: int, current: int, tick: int) -> list[int]:
    """The ends of tokens of other reactors after which edges demand that `t` begins."""
    _gather_followed(bench, t, tick, True)
    ends = []
    for i in range(1, bench.met.count):
        v = bench.met.items[i]
        if _is_awaited(bench, v, t, current, tick) and not _ends_with(bench, v, t):
            ends.append(v)
    return ends


def _gather_followed(bench: Workbench, t: int, tick: int, is_far: bool) -> None:
    """Gather the start of `t`, and behind it what edges demand that it follows and may still be to come.

    If that is not to be far, nothing beyond what this reactor begins.
    """
    engine, met = bench.engine, bench.met
    met.empty(engine.variables)
    met.add(bench.start(t))
    i = 0
    while i < met.count:
        e = engine.out_head[met.items[i]]
        while e >= 0:
            v = engine.edge_target[e]
            if engine.edge_weight[e] <= 0 and not met.has(v) and engine.upper(v) > tick:
                if is_far or not _is_own(bench, v, START):
                    met.add(v)
            e = engine.out_next[e]
        i += 1


def _is_held_back(bench: Workbench, t: int, current: int, tick: int) -> bool:
    """Whether the earliest start of `t` rests on another token that goes on, or has not begun, and only for now.

    `current` does not hold `t` back: it ends when `t` begins. Nor does what somebody asked for: it begins as soon as it
    may, so what it needs is asked for at once.
    """
    engine, plan = bench.engine, bench.plan
    v = bench.start(t)
    for _ in range(engine.edges_used):
        support = engine.lower_support[v]
        if support < 0 or support & 3 != SUPPORT_EDGE:
            break
        v = engine.edge_target[support >> 2]
    support = engine.lower_support[v]
    if support < 0 or support & 3 != SUPPORT_RESTRICTION or plan.variable_role[v] != ROLE_TOKEN:
        return False
    other = bench.stands_for(plan.variable_owner[v])
    if other in (bench.stands_for(t), current) or (plan.variable_name[v] == START and bench.is_requested(other)):
        return False
    return bool(engine.restriction_span[support >> 2] == SPAN_CLOCK) and engine.upper(v) > tick


def _begins_late(bench: Workbench, v: int, t: int) -> bool:
    """Whether `v` is the start of a token of this reactor, other than `t`, that nobody asked for."""
    if not _is_own(bench, v, START):
        return False
    other = bench.stands_for(bench.plan.variable_owner[v])
    return (
        other != bench.stands_for(t) and bench.object_of(other) in bench.late_objects and not bench.is_requested(other)
    )


def _ends_late(bench: Workbench, v: int, t: int) -> bool:
    """Whether `v` is the end of a token of this reactor, other than `t`, that may still last longer or less."""
    if not _is_own(bench, v, END):
        return False
    engine, other = bench.engine, bench.stands_for(bench.plan.variable_owner[v])
    length = bench.duration(other)
    is_open = engine.lower(v) < engine.upper(v) and engine.lower(length) < engine.upper(length)
    return bool(is_open and other != bench.stands_for(t))


def _is_own(bench: Workbench, v: int, name: int) -> bool:
    """Whether `v` is the start, or the end, of a token of this reactor."""
    plan = bench.plan
    if plan.variable_role[v] != ROLE_TOKEN or plan.variable_name[v] != name:
        return False
    return bench.object_of(bench.stands_for(plan.variable_owner[v])) in bench.internal_objects


def _is_awaited(bench: Workbench, v: int, t: int, current: int, tick: int) -> bool:
    """Whether `v` is the open end of a token on another reactor's timeline, other than what `t` replaces."""
    plan = bench.plan
    if plan.variable_role[v] != ROLE_TOKEN or plan.variable_name[v] != END or bench.engine.upper(v) <= tick:
        return False
    other = bench.stands_for(plan.variable_owner[v])
    return other not in (bench.stands_for(t), current) and bench.object_of(other) in bench.external_objects


def _ends_with(bench: Workbench, v: int, t: int) -> bool:
    """Whether `v` ends what keeps nothing waiting, when what is planned next there begins, at the very tick of `t`.

    What may begin before that is not helped by it: the world has to end what holds there.
    """
    ended = bench.stands_for(bench.plan.variable_owner[v])
    if (after := bench.following(ended)) < 0 or keeps_next(bench, ended):
        return False
    return _is_same(bench, bench.start(t), bench.start(after))


def _is_same(bench: Workbench, v: int, w: int) -> bool:
    """Whether the plan has two times at one tick."""
    return not _may_follow(bench, v, w, 1) and not _may_follow(bench, w, v, 1)


def _may_follow(bench: Workbench, v: int, w: int, by: int) -> bool:
    """Whether the plan lets `v` come after `w`, by so many ticks at least."""
    mark = bench.mark()
    holds = bench.engine.add_edge(v, w, -by, SPAN_EXECUTIVE, NONE)
    bench.release(mark)
    return bool(holds)
