"""Let a reactor's solver plan ahead, or resolve the flaws of the present, each within its window of time."""

from collections.abc import Callable

from nddl_lang.text.source import Span
from runtime.executive.outcome import Conflict, Deadlock, Reason, ReasonKind
from runtime.executive.planning_table import LeftOut, plans_ahead, within_window
from runtime.executive.story import SearchLog, conflict_of
from runtime.executive.view import SPAN_CLOCK
from runtime.executive.workbench import Workbench
from runtime.limits import TIME_LIMIT, LimitError
from runtime.plan.tags import (
    FLAG_NATIVE,
    FLAG_REJECTABLE,
    HEAD_OPEN,
    INACTIVE,
    INFINITY,
    LIST_OPEN,
    LIST_ORDER,
    LIST_THREAT,
    LISTS,
    NONE,
    ROLE_LOCAL,
    ROLE_TOKEN,
)
from runtime.solver.configuration.configuration import Configuration, default_configuration
from runtime.solver.flaws.filters import PlanningScope
from runtime.solver.search import Solver
from runtime.solver.tags import EXHAUSTED, PLAN

_NO_LIMIT = 2**62
_NEVER = -1
_MOST_STEPS = 1_000_000  # decisions about one present that the engine makes, if nobody sets a limit
_DEEPEST = 20_000  # decisions in force at once in one episode, if nobody sets a limit
_MOST_CHANGES = 2**24  # of the plan that can be undone: half a gigabyte; missions of 30,000 ticks have some 2**12
_MOST_EXPLAINED = 2_000  # decisions of a search that is repeated to find out why it failed
_EXPLAINING = 2.0  # seconds for one that had no end

# How an episode of planning stands: a decision was made, nothing is left to do, there is no plan, or what ran out.
EPISODE_MOVED, EPISODE_DONE, EPISODE_EXHAUSTED, EPISODE_TOO_DEEP, _EPISODE_OUT_OF_STEPS = range(5)


class _Window(PlanningScope):
    """Tokens that can start by `end` and end at `tick` or later (T-REX 1.7); for the present, those that hold now.

    What is on a timeline that the model ignores is in no scope.
    What is over and still undecided is in scope of both: it must be found among what has happened. What was over before
    the mission asks for nothing before it: of that time nothing is known, and who asks on would find no end.
    Who looks one tick ahead plans what was asked for and what others are to do, no more: what else its own timelines
    begin to hold is decided when the time comes, by what holds then.
    """

    def __init__(self, bench: Workbench, left_out: LeftOut) -> None:
        self.bench = bench
        self.tick = 0
        self.end = 0
        self.final = 0
        self.is_present = False
        self.is_reactive = False
        self.observed: set[int] = set()  # timelines of others of whom nothing is asked
        self.left_open: list[int] = []  # arguments of what is to be observed there, of any value so far
        # What was put before something that waited, with from when on that could begin; and what shall not be any more.
        self.overtaken: dict[tuple[int, int], tuple[int, int, float]] = {}
        self.behind: set[tuple[int, int]] = set()
        self.undrawn: dict[int, int] = {}  # the keys of tokens, by number, for which nothing is drawn yet
        self.left_out = left_out
        self.ignored = {o for o in range(len(bench.database.objects.names)) if bench.mode(o) == "Ignore"}

    def admits_token(self, t: int) -> bool:
        """Whether flaws of `t` are to be mended now."""
        return self._is_in_scope(t) and (self.is_present or self.left_out.is_empty or not self.left_out.has(t))

    def _is_in_scope(self, t: int) -> bool:
        """Whether `t`, and its variables, belong to what is to be mended now."""
        bench = self.bench
        start = bench.start(t)
        if self.ignored and bench.object_of(t) in self.ignored:
            return False
        if bench.upper(bench.end(t)) <= self.tick:
            return self._is_left_over(t)
        if self.is_present:
            if self.tick == self.final and bench.lower(start) == self.tick and self._waits_for_others(t):
                return False  # what can begin at the end at the earliest is not begun
            return bench.upper(start) <= self.tick < bench.upper(bench.end(t))
        if bench.rows.flags[t] & FLAG_NATIVE and bench.rows.status[t] == INACTIVE:
            return True  # a use that a repair has taken back counts whenever it is
        earliest = bench.lower(start)
        is_to_begin = self.is_reactive and bench.upper(start) > self.tick
        if is_to_begin and bench.is_internal(t) and (not bench.is_due_to_request(t) or self._waits_behind(t)):
            return False
        return earliest <= self.end and earliest < self.final

    def _waits_behind(self, t: int) -> bool:
        """Whether a command for which `t` is needed has no place yet, or has to wait for the end of what goes on there.

        What is needed with it is found when it begins: of what holds by then, nobody knows now.
        """
        return self._is_free_at(t) > self.end

    def _is_free_at(self, t: int) -> float:
        """The earliest end of what goes on where a command begins for which `t` is needed, inf without a place yet."""
        bench = self.bench
        first, before = bench.root(t), NONE
        if first == t or not bench.is_internal(first) or not bench.is_active(first):
            return -INFINITY
        if bench.rows.link_head[LISTS * first + LIST_ORDER] >= 0:
            before = bench.rows.link_before[LISTS * first + LIST_ORDER]
        elif bench.rows.link_head[LISTS * first + LIST_THREAT] >= 0:
            return INFINITY
        while before >= 0 and bench.root(before) == first:
            before = bench.rows.link_before[LISTS * before + LIST_ORDER]
        return bench.lower(bench.end(before)) if before >= 0 else -INFINITY

    def next_freed(self, tick: int, reach: int) -> float:
        """The first tick whose window, `reach` ticks long, has in it an end that something undecided waits behind."""
        found: float = INFINITY
        rows = self.bench.rows
        t = rows.head_first[HEAD_OPEN] if self.is_reactive else NONE
        while t >= 0:
            if self.bench.is_internal(t) and self.bench.is_due_to_request(t):
                free = self._is_free_at(t)
                if tick + reach < free < found:
                    found = free
            t = rows.link_after[LISTS * t + LIST_OPEN]
        return found - reach

    def _waits_for_others(self, t: int) -> bool:
        """Whether `t` is a goal, or on a timeline that others let begin what it holds."""
        return self.bench.is_goal(t) or self.bench.object_of(t) in self.bench.external_objects

    def may_begin(self, t: int) -> bool:
        """Whether `t` may begin now or later; what held on a shared timeline up to now is known."""
        bench = self.bench
        start = bench.start(t)
        if bench.upper(start) >= self.tick or bench.lower(start) < 0:
            return True  # of the time before the mission nothing is known
        o = bench.object_of(t)
        return o not in bench.internal_objects and o not in bench.external_objects

    def begins_in_time(self, t: int) -> bool:
        """Whether the rules of `t`, which have just fired, leave it a time to begin; if not, that is a conflict."""
        return self.may_begin(t) or self.bench.at_least(self.bench.start(t), self.tick, SPAN_CLOCK, t)

    def may_overtake(self, t: int, other: int) -> bool:
        """Whether `t` may be put before `other`, which was asked for sooner and waits for something else."""
        bench = self.bench
        key = (int(bench.rows.key[t]), int(bench.rows.key[other]))
        if key in self.behind:
            return False
        if key not in self.overtaken:
            self.overtaken[key] = (t, other, bench.lower(bench.start(other)))
        return True

    def has_delayed(self) -> bool:
        """Whether what was put before something that waited has to wait as long, itself; from then on it stays behind.

        That it waits for the same, a command tells only when it has its place.
        """
        bench = self.bench
        found = False
        for key, (t, other, begin) in self.overtaken.items():
            if key != (bench.rows.key[t], bench.rows.key[other]):
                continue
            if begin <= bench.lower(bench.start(t)) and begin < bench.lower(bench.start(other)):
                self.behind.add(key)
                found = True
        self.overtaken.clear()
        return found

    def _is_left_over(self, t: int) -> bool:
        """Whether `t` is undecided, and no goal, or active without a place in a sequence."""
        rows = self.bench.rows
        if rows.status[t] == INACTIVE:
            return not self.bench.is_goal(t) and not self._is_of_before(t)
        return bool(rows.link_head[LISTS * t + LIST_THREAT] >= 0)

    def _is_of_before(self, t: int) -> bool:
        """Whether `t`, and who asked for it, were over when the mission began."""
        bench = self.bench
        parent = bench.rows.parent[t]
        return parent >= 0 and bench.upper(bench.end(parent)) <= 0 and bench.upper(bench.end(t)) <= 0

    def admits_variable(self, v: int) -> bool:
        """Whether `v` is to be decided now: globals always, others with their token."""
        plan = self.bench.plan
        if plan.variable_role[v] in (ROLE_TOKEN, ROLE_LOCAL):
            t = int(plan.variable_owner[v])
            if (self.undrawn and self._awaits_draw(t)) or not self._is_in_scope(t):
                return False
            if self.observed and self.bench.object_of(t) in self.observed and self._is_free(v):
                self.left_open.append(v)
                return False
            return True
        return not self.is_present

    def _awaits_draw(self, t: int) -> bool:
        """Whether nothing is drawn yet for `t`, or, before it begins, for what one rule asked for together with it.

        Lines tie their variables together: what is decided of one may be what another is never drawn.
        """
        bench, rows = self.bench, self.bench.rows
        if self.undrawn.get(t) == rows.key[t]:
            return True
        if bench.lower(bench.start(t)) <= self.tick:
            return False
        root = bench.root(t)
        return any(rows.key[other] == key and bench.root(other) == root for other, key in self.undrawn.items())

    def _is_free(self, v: int) -> bool:
        """Whether no guard waits for a variable, and no constraint ties it to what is open: its values are alike."""
        engine = self.bench.engine
        if self.bench.plan.variable_guards[v] > 0 or engine.out_head[v] >= 0 or engine.in_head[v] >= 0:
            return False
        for c in engine.constraints_of(v):
            for other in engine.arguments(c):
                if other != v and not engine.is_singleton(other):
                    return False
        return True

    def is_any_bound(self) -> bool:
        """Whether a constraint has come to wait for an argument that was left to the world; forgets them."""
        found = len([v for v in self.left_open if not self._is_free(v)]) > 0
        self.left_open = []
        return found


class Planner:
    """The solver of one reactor; its decisions are made final at the end of each episode.

    Without `max_steps` and `max_depth` there is no limit that the model could be blamed for. Where the configuration
    leaves out every flaw nothing is planned, and what holds now is settled by the default one (T-REX 1).
    """

    def __init__(
        self,
        bench: Workbench,
        configuration: Configuration,
        final_tick: int,
        max_steps: int | None = None,
        max_depth: int | None = None,
    ) -> None:
        self.bench = bench
        self.plans_ahead = plans_ahead(configuration)
        if not self.plans_ahead:
            configuration = default_configuration()
        self.window = _Window(bench, LeftOut(bench, configuration))
        self.window.final = final_tick
        bench.engine.trail_most = _MOST_CHANGES
        table = within_window(configuration, any(bench.database.plan.resources.is_resource))
        self.solver = Solver(bench.database, table, 0, 1, False)
        self.solver.set_scope(self.window)
        self.solver.agenda.earliest = True
        self.max_steps = max_steps
        self.max_depth = max_depth
        self.deepest = _DEEPEST
        self.kept_depth = 0  # the decisions of this episode that were kept when the steps of a tick ran out
        self.is_fresh = True
        self.resolved = _NEVER  # the propagation after which the present had no flaws, without a decision
        self.missed: Callable[[], list[int]] = list  # the goals that are rejected and that nobody was told of
        self.rejections: dict[int, Deadlock] = {}  # why, by token

    def deliberate(self, tick: int, end: int) -> int:
        """Make one decision inside [tick, end]; how the episode stands now."""
        if not self.plans_ahead:
            return EPISODE_DONE
        self._begin(tick, end)
        outcome = self.solver.step()
        TIME_LIMIT.check(None if outcome == PLAN else self)
        if outcome == PLAN and self.window.overtaken and self.window.has_delayed():
            self.solver.undo_all()
            self.is_fresh = True
            return EPISODE_MOVED
        if outcome == PLAN and self.window.left_open and self.window.is_any_bound():
            self.pause()
            return EPISODE_MOVED
        if outcome == PLAN:
            self._explain_rejections()
            self.keep()
            self.kept_depth = 0
            return EPISODE_DONE
        is_deep = self.max_depth is not None and self.kept_depth + self.solver.depth > self.max_depth
        if outcome == EXHAUSTED or is_deep:
            self.solver.undo_all()
            self.kept_depth = 0
            self.is_fresh = True
            return EPISODE_EXHAUSTED if outcome == EXHAUSTED else EPISODE_TOO_DEEP
        if self.max_depth is None and self.solver.depth > self.deepest:
            raise LimitError(f"more than {self.deepest} decisions are in force at once")
        return EPISODE_MOVED

    def has_flaw(self, tick: int, end: int) -> bool:
        """Whether there is something to decide inside [tick, end]."""
        if not self.plans_ahead:
            return False
        self._begin(tick, end)
        return bool(self.solver.has_flaw())

    def _begin(self, tick: int, end: int) -> None:
        """Gather the flaws inside [tick, end], at the beginning of an episode."""
        if self.is_fresh:
            self.window.tick, self.window.end, self.window.is_present = tick, end, False
            self.window.left_open = []
            self.window.overtaken.clear()
            # If nothing was propagated since the present was found without flaws, it is the agenda that is wanted.
            if self.resolved == self.bench.engine.epoch:
                self.solver.resume()
            else:
                self.solver.refresh()
            self.resolved = _NEVER
            self.is_fresh = False

    def pause(self) -> None:
        """Make what has been decided final, in an episode that goes on when there are steps again."""
        if not self.is_fresh:
            self.kept_depth += self.solver.depth
            self.keep()

    def keep(self) -> None:
        """Make what has been decided final."""
        self.solver.keep()
        self.is_fresh = True

    def resolve_present(self, tick: int) -> int:
        """Mend all flaws of what holds at `tick`, or none; the decisions wait for `keep`. How that ended."""
        self.window.tick, self.window.end, self.window.is_present = tick, tick, True
        solver = self.solver
        solver.refresh()
        self.is_fresh = True
        steps = _MOST_STEPS if self.max_steps is None else self.max_steps
        depth = _MOST_STEPS if self.max_depth is None else self.max_depth
        made = solver.steps + solver.failures
        outcome = solver.solve(steps, depth, TIME_LIMIT.is_over)
        TIME_LIMIT.check(None if outcome == PLAN else self)
        solver.max_steps = solver.max_depth = _NO_LIMIT
        self.resolved = _NEVER
        is_deep = solver.depth > depth
        if outcome == PLAN and not is_deep:
            if solver.steps + solver.failures == made and solver.relief is None:
                self.resolved = self.bench.engine.epoch
            self._explain_rejections()
            return EPISODE_DONE
        solver.undo_all()
        if outcome == EXHAUSTED:
            return EPISODE_EXHAUSTED
        if (self.max_depth if is_deep else self.max_steps) is None:
            raise LimitError(f"more than {_MOST_STEPS} decisions about what holds at tick {tick}")
        return EPISODE_TOO_DEEP if is_deep else _EPISODE_OUT_OF_STEPS

    def deadlock(self) -> Deadlock | None:
        """Why the search that was exhausted found nothing: it is made again, with a log."""
        return self._logged().deadlock()

    def _logged(self) -> SearchLog:
        """Make the search of the window again from its start, with a log; all of it is undone."""
        solver = self.solver
        log = SearchLog(self.bench, solver)
        solver.failure_log = log.log
        solver.refresh()
        solver.solve(_MOST_EXPLAINED, _MOST_EXPLAINED, log.is_enough)
        solver.undo_all()
        solver.failure_log = None
        solver.max_steps = solver.max_depth = _NO_LIMIT
        self.is_fresh = True
        return log

    def _explain_rejections(self) -> None:
        """Find out why goals were rejected: the search is made with a log, then once more as it was."""
        missed = self.missed()
        if not missed:
            return
        self.solver.undo_all()
        log = self._logged()
        for token in missed:
            found = log.rejection(token)
            if found is not None:
                self.rejections[token] = found
        self.solver.refresh()
        outcome = self.solver.solve(_NO_LIMIT, _NO_LIMIT, TIME_LIMIT.is_over)
        TIME_LIMIT.check(None if outcome == PLAN else self)

    def most_blamed(self) -> tuple[Span | None, int, int, int]:
        """The line that stands in the way most often in the first decisions of the window, how many others do as often,
        in how many failures, and of how many."""
        self.solver.undo_all()
        with TIME_LIMIT.lasting(_EXPLAINING):
            return self._logged().most_blamed()

    def reason(self) -> tuple[Reason, Conflict | None]:
        """Why the search cannot go on: the first token that must hold and cannot, and what stands against it."""
        bench, rows = self.bench, self.bench.rows
        for t in bench.all_tokens():
            if rows.status[t] != INACTIVE or rows.flags[t] & FLAG_REJECTABLE or not self.window.admits_token(t):
                continue
            mark = bench.mark()
            conflict = None if bench.activate(t) else conflict_of(bench)
            bench.rewind_to(mark)
            bench.release(mark)
            return Reason(ReasonKind.NO_INSERTION, bench.name_of(t)), conflict
        return Reason(ReasonKind.NO_PLAN), None
