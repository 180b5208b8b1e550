"""Search for a plan: one decision per step, going back when there is no choice left."""

from collections.abc import Callable

from runtime.plan.database import PlanDatabase
from runtime.plan.lifecycle import fire
from runtime.plan.store.marks import commit, mark, release, rewind
from runtime.plan.tags import REJECTED
from runtime.solver.configuration.configuration import Configuration, with_resources
from runtime.solver.configuration.handler_matching import Matching
from runtime.solver.configuration.handler_table import Treatments
from runtime.solver.configuration.vocabulary import Texts, grounded
from runtime.solver.flaws.agenda import Queues
from runtime.solver.flaws.agenda_updates import catch_up, fill, note_levels
from runtime.solver.flaws.custom import CustomManager
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.flaws.filters import Filters, Scope
from runtime.solver.flaws.selection import select
from runtime.solver.flaws.supports import Supports
from runtime.solver.flaws.uses import Uses
from runtime.solver.learning.conflict_analysis import Blame
from runtime.solver.learning.dead_end import complete
from runtime.solver.learning.disjunctive import Crowds
from runtime.solver.learning.failure_log import Account
from runtime.solver.learning.nogoods import Nogoods
from runtime.solver.learning.order_invariance import has_loops, is_any_order_right
from runtime.solver.resolvers.choices import mend
from runtime.solver.resolvers.resource_resolvers import is_mended
from runtime.solver.tags import (
    APPLIED,
    EVERYTHING,
    EXHAUSTED,
    FAILED,
    MOVED,
    NO_CHOICE,
    OPEN_CONDITION,
    PLAN,
    RESOURCE_THREAT,
    TIMEOUT,
    UNBOUND_VARIABLE,
)

NO_LIMIT = 2**62


class Solver:
    """The search. With `europa` it makes EUROPA's steps one for one; else it goes back as far as a conflict allows."""

    def __init__(
        self, database: PlanDatabase, configuration: Configuration, lower: int, upper: int, europa: bool
    ) -> None:
        self.database = database
        self.plan = database.plan
        self.engine = database.plan.engine
        self.europa = europa
        self.engine.holes = not europa  # EUROPA keeps an int that is an interval without holes
        if any(self.plan.resources.is_resource):
            configuration = with_resources(configuration)
        matching = Matching(configuration, database.program)
        treatments = Treatments(matching, Texts(database), len(database.program.predicates))
        self.filters = Filters(self.plan, treatments, lower, upper)
        program = database.program
        supports = Supports(program, europa)
        in_order = europa or has_loops(program)
        self.may_restart = not europa and is_any_order_right(program, self.plan, treatments, supports)
        self.queues = Queues(self.plan, treatments, self.filters, supports, europa, in_order)
        self.queues.uses = Uses(self.plan, self.queues.distances, grounded(database))
        self.stack = Decisions()
        self.blame = Blame(self.queues, self.stack)
        self.crowds = Crowds(self.queues)
        self.nogoods = Nogoods(program, self.queues, self.stack)
        self.steps = 0
        self.failures = 0
        self.steps_floor = 0
        self.depth_floor = 0
        self.max_steps = NO_LIMIT
        self.max_depth = NO_LIMIT
        self.has_active = False
        self.is_exhausted = False
        self.is_started = False
        self.is_close = False  # it looks whether uses, and tokens on timelines, fit at all
        self.is_hopeless = False  # no choice of the decision that failed last can help
        self.account: Account | None = None  # who is told of failures

    @property
    def depth(self) -> int:
        """How many decisions are in force."""
        return self.stack.depth

    def set_horizon(self, lower: int, upper: int) -> None:
        """Plan from `lower` to `upper`; call `refresh` if the search has begun."""
        self.filters.lower = lower
        self.filters.upper = upper

    def set_scope(self, scope: Scope | None) -> None:
        """Mend only what `scope` admits; call `refresh` when what it says has changed."""
        self.filters.has_scope = scope is not None
        if scope is not None:
            self.filters.scope = scope

    def set_custom(self, manager: CustomManager | None) -> None:
        """Mend the flaws of `manager` as well."""
        self.queues.has_custom = manager is not None
        if manager is not None:
            self.queues.custom = manager

    def refresh(self) -> None:
        """Look at the whole plan anew, because it was changed from outside; no decision may be on the stack."""
        assert self.stack.depth == 0
        self.is_started = True
        self.has_active = False
        self.is_close = False
        for o in range(self.plan.object_count):
            self.plan.resources.set_energetic(o, False)
        if self.account is not None:
            self.look_closer()  # what does not fit at all needs no further reasons
        self.nogoods.clear()
        self.queues.weights.clear()
        self.is_exhausted = not fire(self.plan)
        if self.is_exhausted and self.account is not None:
            self.account.contradicted()
        fill(self.queues)

    def keep(self) -> None:
        """Make all decisions final: the stack is empty, and nothing of it can be taken back."""
        self.stack.clear()
        self.has_active = False
        self.is_started = False  # the plan is looked at anew before the next step, if there is one
        commit(self.plan)

    def take_back(self) -> None:
        """Undo all decisions."""
        if self.has_active:
            self.leave(self.stack.depth)
        while self.stack.depth > 0:
            self.leave(self.stack.depth - 1)
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

    def step(self) -> int:
        """Make one decision, or try one choice in vain."""
        if not self.is_started:
            self.refresh()
        stack = self.stack
        q = self.queues
        while not self.is_exhausted:
            if q.weights.is_due():
                self.begin_anew()
            d = stack.depth
            if not self.has_active:
                if d == 0:
                    q.dropped_count = 0  # nothing is taken back behind the first decision
                if not select(q):
                    return PLAN
                self.enter()
            q.probing = (
                self.steps - self.steps_floor >= self.max_steps or stack.depth - self.depth_floor > self.max_depth
            )
            outcome = NO_CHOICE
            most = q.treatments.handler_most[stack.handler[d]] if stack.handler[d] >= 0 else 0
            if most == 0 or stack.tries[d] < most:
                outcome = mend(q, stack, d)
            if outcome == NO_CHOICE:
                self.give_up(d, False)
                continue
            if q.probing:
                return TIMEOUT
            self.steps += 1
            if outcome == APPLIED:
                if self.account is not None and is_rejection(q, stack, d):
                    self.account.rejected(d)
                catch_up(q, d + 1)
                stack.depth = d + 1
                self.has_active = False
                if self.nogoods.is_awake and self.is_known_in_vain(d):
                    return FAILED
                if self.is_close and not self.crowds.fit():
                    self.fail(d)
                    self.go_to(d)
                    if self.is_hopeless:
                        self.give_up(d, True)
                    return FAILED
                return MOVED
            if not self.europa:
                note_levels(q, d + 1)
            self.fail(d)
            rewind(self.plan, stack.mark[d])
            self.look_closer()
            if self.is_hopeless:
                self.give_up(d, True)
            return FAILED
        return EXHAUSTED

    def fail(self, d: int) -> int:
        """Learn from the conflict that the present choice of decision `d` has led to."""
        self.failures += 1
        self.is_hopeless = False
        if self.account is not None:
            self.account.failed(d)
        if not self.europa:
            self.is_hopeless = self.blame.learn(d)
            if self.may_restart and self.is_reordered(d):
                self.queues.weights.note_failure()
        return 0

    def is_known_in_vain(self, d: int) -> bool:
        """Whether a nogood says that the choice just made at `d` leads nowhere; then it is taken back."""
        levels = self.nogoods.refuted(d)
        if levels is None:
            return False
        stack = self.stack
        if stack.reasons[d] != EVERYTHING:
            self.blame.begin()
            for level in levels:
                self.blame.meet(level)
            self.blame.keep(d)
        self.failures += 1
        self.go_to(d)
        return True

    def is_reordered(self, d: int) -> bool:
        """Whether decision `d` may come at another time in another run, so that its failures count for a restart.

        An account wants to be told why each choice fails, and of one run.
        """
        q = self.queues
        if self.stack.kind[d] != UNBOUND_VARIABLE or q.has_custom or self.account is not None:
            return False
        heap = q.treatments.heap_of[q.variable_row[self.stack.item[d] * q.managers + self.stack.manager[d]]]
        return heap >= 0 and q.sorted_by_size[heap] != 0

    def begin_anew(self) -> int:
        """Go back to the root; nogoods stay, and in every second run variables that were in conflicts come first."""
        self.take_back()
        self.queues.weights.begin_anew()
        fill(self.queues)
        return 0

    def look_closer(self) -> int:
        """Check from now on whether uses fit at all where they must in the end: worth its time where choices fail."""
        if not self.europa and not self.is_close:
            self.is_close = True
            for o in range(self.plan.object_count):
                self.plan.resources.set_energetic(o, is_mended(self.queues, o))
        return 0

    def enter(self) -> int:
        """Begin a decision about the flaw that was found."""
        q = self.queues
        stack = self.stack
        d = stack.open(q.found_kind, q.found_manager, q.found_item, q.found_handler)
        if q.found_kind == RESOURCE_THREAT:
            stack.phase[d] = q.found_low
            stack.other[d] = q.found_at
        stack.mark[d] = mark(self.plan)
        stack.rows_seen[d] = q.rows_seen
        stack.engine_seen[d] = q.engine_seen
        stack.dropped[d] = q.dropped_count
        stack.loose[d] = q.loose_count
        self.has_active = True
        return d

    def leave(self, d: int) -> int:
        """Go back to where decision `d` was begun, and drop it."""
        stack = self.stack
        release(self.plan, stack.mark[d])
        self.queues.go_back(stack.dropped[d], stack.loose[d], stack.rows_seen[d], stack.engine_seen[d])
        stack.close(d)
        stack.depth = d
        self.has_active = False
        return 0

    def give_up(self, d: int, is_explained: bool) -> int:
        """Drop a decision without choices, and go back to the one that may be at fault."""
        target = d - 1
        self.look_closer()
        if not self.europa:
            if not is_explained:
                complete(self.blame, d)
            target = self.blame.target(d)
            if self.account is None:  # which wants to be told why each choice fails
                self.nogoods.wake()
                self.nogoods.record(d)
        if self.account is not None:
            self.account.given_up(d, target)
        self.leave(d)
        while self.stack.depth > target + 1:
            self.leave(self.stack.depth - 1)
        if target < 0:
            self.is_exhausted = True
            return 0
        self.go_to(target)
        return 0

    def go_to(self, d: int) -> int:
        """Go back to where decision `d` was begun, to make its next choice."""
        stack = self.stack
        rewind(self.plan, stack.mark[d])
        self.queues.go_back(stack.dropped[d], stack.loose[d], stack.rows_seen[d], stack.engine_seen[d])
        stack.depth = d
        self.has_active = True
        return 0


def is_rejection(q: Queues, stack: Decisions, d: int) -> bool:
    """Whether the present choice of decision `d` rejects a token."""
    return stack.kind[d] == OPEN_CONDITION and q.rows.status[stack.item[d]] == REJECTED
