"""Search for a plan: one decision per step; backjumping when no resolver is left."""

from collections.abc import Callable

from runtime.constraints.convergence import converge
from runtime.constraints.domains.tags import KIND_FLOAT
from runtime.plan.database import PlanDatabase
from runtime.plan.lifecycle import fire
from runtime.plan.store.marks import commit, mark, release, rewind
from runtime.plan.tokens.retraction import withdraw_refusals
from runtime.solver.configuration.configuration import Configuration, with_resources
from runtime.solver.configuration.handler_matching import HandlerMatching
from runtime.solver.configuration.handler_table import HandlerTable
from runtime.solver.flaws.agenda import Agenda
from runtime.solver.flaws.agenda_updates import note_levels, rebuild, reopen, update
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.flaws.filters import Filters, PlanningScope
from runtime.solver.flaws.relief import Relief
from runtime.solver.flaws.resource_selection import is_resource_managed
from runtime.solver.flaws.selection import select
from runtime.solver.flaws.supports import Supports
from runtime.solver.learning.conflict_analysis import ConflictAnalysis
from runtime.solver.learning.dead_end import explain_dead_end
from runtime.solver.learning.disjunctive import Disjunctive
from runtime.solver.learning.failure_log import FailureLog
from runtime.solver.learning.nogoods import Nogoods
from runtime.solver.learning.order_invariance import has_loops, is_order_invariant
from runtime.solver.resolvers.choices import mend
from runtime.solver.tags import (
    ACTIVATE_ONLY,
    APPLIED,
    EVERYTHING,
    EXHAUSTED,
    FAILED,
    HANDLER_LISTED,
    MERGE_ONLY,
    MOVED,
    NO_CHOICE,
    OPEN_CONDITION,
    PLAN,
    TIMEOUT,
    UNBOUND_VARIABLE,
)

_NO_LIMIT = 2**62


class Solver:
    """The search. With `europa` it makes EUROPA's steps one for one; else it backjumps."""

    def __init__(
        self, database: PlanDatabase, configuration: Configuration, lower: int, upper: int, europa: bool
    ) -> None:
        self.database = database
        self.plan = database.plan
        self.engine = database.plan.engine
        self.europa = europa
        self.engine.holes = not europa  # EUROPA keeps an int that is an interval without holes
        has_resources = any(self.plan.resources.is_resource)
        if has_resources:
            configuration = with_resources(configuration)
        matching = HandlerMatching(configuration, database.program)
        table = HandlerTable(matching, database)
        self.filters = Filters(self.plan, table, lower, upper)
        program = database.program
        supports = Supports(program, europa)
        in_order = europa or has_loops(program)
        self.may_restart = not europa and is_order_invariant(program, self.plan, table, supports)
        self.agenda = Agenda(self.plan, table, self.filters, supports, europa, in_order)
        relief = None if europa or not has_resources else Relief(self.plan, supports)
        self.relief = relief if relief is not None and relief.is_possible else None
        self.agenda.relief = self.relief
        self.stack = Decisions()
        self.analysis = ConflictAnalysis(self.agenda, self.stack)
        self.disjunctive = Disjunctive(self.agenda)
        self.nogoods = Nogoods(program, self.agenda, self.stack)
        self.steps = 0
        self.failures = 0
        self.steps_floor = 0
        self.depth_floor = 0
        self.max_steps = _NO_LIMIT
        self.max_depth = _NO_LIMIT
        self.has_active = False
        self.is_exhausted = False
        self.is_started = False
        self.checks_overload = False  # energetic and disjunctive overload checks are on
        self.is_partial = europa  # some resolver was never tried, so that to fail proves nothing
        self.is_dead_end = False  # no resolver of the decision that failed last can help
        self.failure_log: FailureLog | None = None  # for explanations: what was tried in vain

    @property
    def depth(self) -> int:
        """How many decisions are in force."""
        return self.stack.depth

    def set_scope(self, scope: PlanningScope | None) -> None:
        """Mend only what `scope` admits; call `refresh` when its answers have changed."""
        self.filters.has_scope = scope is not None
        if scope is not None:
            self.filters.scope = scope

    def refresh(self) -> None:
        """Start from the plan as it is, after a change from outside; no decision may be on the stack."""
        assert self.stack.depth == 0
        self.is_started = True
        self.has_active = False
        self.checks_overload = False
        for o in range(self.plan.object_count):
            self.plan.resources.set_energetic(o, False)
        if self.failure_log is not None:
            self.check_overload()  # an overload needs no further reasons
        self.nogoods.clear()
        self.agenda.restarts.clear()
        if self.relief is not None:
            withdraw_refusals(self.plan)
            self.plan.resources.relief = self.relief
        self.is_exhausted = not fire(self.plan)
        self.plan.resources.relief = None
        if self.is_exhausted and self.failure_log is not None:
            self.failure_log.note_contradiction()
        rebuild(self.agenda)

    def resume(self) -> None:
        """Look again at what was out of scope: the plan is as `refresh` found it, and no decision was made since."""
        assert self.stack.depth == 0 and self.relief is None and self.failure_log is None
        self.is_started = True
        reopen(self.agenda)

    def keep(self) -> None:
        """Commit all decisions: the stack is empty, and nothing of it can be undone."""
        self.stack.clear()
        self.has_active = False
        self.plan.resources.postponed.clear()
        self.is_started = False  # the next step, if there is one, refreshes
        commit(self.plan)

    def undo_all(self) -> None:
        """Undo all decisions."""
        if self.has_active:
            self._undo(self.stack.depth)
        while self.stack.depth > 0:
            self._undo(self.stack.depth - 1)
        self.is_exhausted = False

    def solve(self, max_steps: int, max_depth: int, is_late: Callable[[], bool] | None = None) -> int:
        """Step until there is a plan, none, or no more time; `is_late` is asked every fourth step."""
        self.steps_floor = self.steps
        self.depth_floor = self.stack.depth
        self.max_steps = max_steps
        self.max_depth = max_depth
        outcome = MOVED
        count = 0
        while outcome == MOVED or outcome == FAILED:
            outcome = self.step()
            count += 1
            if count & 3 == 0 and is_late is not None and is_late():
                return TIMEOUT
        return outcome

    def has_flaw(self) -> bool:
        """Whether there is something to decide, before anything is done about it."""
        if not self.is_started:
            self.refresh()
        return bool(self.is_exhausted or self.has_active or self._selects(self.stack.depth))

    def _selects(self, d: int) -> bool:
        """Select the flaw for decision `d`; False: there is none."""
        if self.relief is not None:
            self.relief.waiting = self.agenda.waiting_guards[d]
        return select(self.agenda)

    def step(self) -> int:
        """Make one decision, or try one resolver in vain."""
        if not self.is_started:
            self.refresh()
        if self.relief is None:
            return self._step()
        # Only a search may postpone: whoever else changes the plan judges it as it is.
        self.plan.resources.relief = self.relief
        outcome = self._step()
        self.plan.resources.relief = None
        return outcome

    def _step(self) -> int:
        """Make one decision, or try one resolver in vain, with the judgement of levels postponed or not."""
        stack = self.stack
        agenda = self.agenda
        while not self.is_exhausted:
            if agenda.restarts.failures >= agenda.restarts.limit:
                self.restart()
            d = stack.depth
            if not self.has_active:
                if d == 0:
                    agenda.dropped_count = 0  # nothing is undone behind the first decision
                if not self._selects(d):
                    if self._holds():
                        return PLAN
                    return FAILED if d > 0 else EXHAUSTED
                stack.open(agenda, mark(self.plan))
                self.has_active = True
            agenda.probing = (
                self.steps - self.steps_floor >= self.max_steps or stack.depth - self.depth_floor > self.max_depth
            )
            outcome = NO_CHOICE
            most = agenda.table.handler_most[stack.handler[d]] if stack.handler[d] >= 0 else 0
            if most == 0 or stack.tries[d] < most:
                outcome = mend(agenda, stack, d)
            if outcome == NO_CHOICE:
                self.is_partial = self.is_partial or self._left_some(d, most)
                self._backjump(d, False)
                continue
            if agenda.probing:
                return TIMEOUT
            self.steps += 1
            if outcome == APPLIED:
                if self.failure_log is not None:
                    self.failure_log.note_rejection(d)
                update(agenda, d + 1)
                stack.depth = d + 1
                self.has_active = False
                if self.nogoods.is_recording and self._is_nogood(d):
                    return FAILED
                if self.checks_overload and not self.disjunctive.fit():
                    self.fail(d)
                    self._retry(d)
                    if self.is_dead_end:
                        self._backjump(d, True)
                    return FAILED
                return MOVED
            if not self.europa:
                note_levels(agenda, d + 1)
            self.fail(d)
            rewind(self.plan, stack.mark[d])
            self.check_overload()
            if self.is_dead_end:
                self._backjump(d, True)
            return FAILED
        return EXHAUSTED

    def _holds(self) -> bool:
        """Whether what was postponed or slowed down holds now that all else is done; if not, a decision is undone."""
        is_postponed = self.relief is not None and len(self.plan.resources.postponed) > 0
        if not is_postponed and not self.engine.creeping:
            return True
        self.plan.resources.relief = None
        number = mark(self.plan)
        holds = (not is_postponed or fire(self.plan)) and converge(self.engine)
        d = self.stack.depth
        if not holds and d > 0:
            self.failures += 1
            if self.failure_log is not None:
                self.failure_log.note_failure(d - 1)
            self.stack.rest_on_everything(d - 1)
        if not holds and d == 0 and self.failure_log is not None:
            self.failure_log.note_contradiction()
        release(self.plan, number)
        self.plan.resources.relief = self.relief
        if not holds and d > 0:
            self._retry(d - 1)
        self.is_exhausted = not holds and d == 0
        return holds

    def fail(self, d: int) -> None:
        """Conflict analysis of the resolver of decision `d` that has just failed."""
        self.failures += 1
        self.is_dead_end = False
        if self.failure_log is not None:
            self.failure_log.note_failure(d)
        if not self.europa:
            self.is_dead_end = self.analysis.learn(d)
            if self.may_restart and self._is_reordered(d):
                self.agenda.restarts.note_failure()

    def _is_nogood(self, d: int) -> bool:
        """Whether the resolver just chosen at `d` completes a nogood; then it is undone."""
        levels = self.nogoods.refuted(d)
        if levels is None:
            return False
        stack = self.stack
        if stack.reasons[d] != EVERYTHING:
            self.analysis.begin()
            for level in levels:
                self.analysis.meet(level)
            self.analysis.keep(d)
        self.failures += 1
        self._retry(d)
        return True

    def _is_reordered(self, d: int) -> bool:
        """Whether decision `d` may come at another time in another run, so that its failures count for a restart.

        A failure log is of one run.
        """
        agenda = self.agenda
        if self.stack.kind[d] != UNBOUND_VARIABLE or self.failure_log is not None:
            return False
        heap = agenda.table.heap_of[agenda.variable_row[self.stack.item[d] * agenda.managers + self.stack.manager[d]]]
        return heap >= 0 and agenda.sorted_by_size[heap] != 0

    def restart(self) -> None:
        """Restart from the root; nogoods stay, and in every second run dom/wdeg orders the variables."""
        self.undo_all()
        self.agenda.restarts.restart()
        rebuild(self.agenda)

    def check_overload(self) -> None:
        """Turn the overload checks on: worth their time where resolvers fail."""
        if not self.europa and not self.checks_overload:
            self.checks_overload = True
            for o in range(self.plan.object_count):
                self.plan.resources.set_energetic(o, is_resource_managed(self.agenda, o))

    def _left_some(self, d: int, most: int) -> bool:
        """Whether decision `d` has resolvers that were not tried: values of a float, or those that a handler omits."""
        stack = self.stack
        if most > 0 and stack.tries[d] >= most:
            return True
        if stack.kind[d] == UNBOUND_VARIABLE:
            is_float = self.engine.kind[stack.item[d]] == KIND_FLOAT
            return is_float or self.agenda.table.handler_code[stack.handler[d]] == HANDLER_LISTED
        if stack.kind[d] == OPEN_CONDITION:
            return self.agenda.table.handler_choice[stack.handler[d]] in (MERGE_ONLY, ACTIVATE_ONLY)
        return False

    def _undo(self, d: int) -> None:
        """Undo decision `d` and drop it."""
        stack = self.stack
        release(self.plan, stack.mark[d])
        self.agenda.backtrack(stack.dropped[d], stack.dynamic[d], stack.rows_seen[d], stack.engine_seen[d])
        stack.close(d)
        stack.depth = d
        self.has_active = False

    def _backjump(self, d: int, is_explained: bool) -> int:
        """Drop a decision without resolvers, and go back to the latest one in its conflict set."""
        target = d - 1
        self.check_overload()
        if not self.europa:
            if not is_explained:
                explain_dead_end(self.analysis, d)
            target = self.analysis.target(d)
            if self.failure_log is None:  # which is told why each resolver fails
                self.nogoods.start()
                self.nogoods.record(d)
        if self.failure_log is not None:
            self.failure_log.note_dead_end(d, target)
        self._undo(d)
        while self.stack.depth > target + 1:
            self._undo(self.stack.depth - 1)
        if target < 0:
            self.is_exhausted = True
            return 0
        self._retry(target)
        return 0

    def _retry(self, d: int) -> None:
        """Undo what decision `d` has chosen, for its next resolver."""
        stack = self.stack
        rewind(self.plan, stack.mark[d])
        self.agenda.backtrack(stack.dropped[d], stack.dynamic[d], stack.rows_seen[d], stack.engine_seen[d])
        stack.depth = d
        self.has_active = True
