"""Find which decisions a conflict rests on, so that the search goes back to the latest of them and no farther.

Decision `d` is level d + 1; level 0 is what held before the search. A failed choice adds to the decision's reasons the
levels of all edges, constraints and restrictions that its conflict was derived from. When no choice is left, what took
the other choices away completes the reasons; the latest of them is where another choice may help (conflict-directed
backjumping, Prosser 1993). More levels than needed do no harm: the search then goes back less far.
"""

from array import array

from runtime.constraints.codes import (
    CONFLICT_DOMAIN,
    SIDE_HOLES,
    SIDE_LOWER,
    SIDE_UPPER,
    SUPPORT_CONSTRAINT,
    SUPPORT_EDGE,
)
from runtime.constraints.reasons import collect_reasons, collect_weight
from runtime.plan.codes import (
    DURATION,
    END,
    LIST_ORDER,
    LISTS,
    OBJECT,
    ROLE_TOKEN,
    START,
    STATE,
)
from runtime.plan.kinds import first_active, next_active
from runtime.solver.codes import (
    EVERYTHING,
    NONE,
    OPEN_CONDITION,
    THREAT,
    UNBOUND_VARIABLE,
)
from runtime.solver.decisions import Decisions
from runtime.solver.queues import Queues
from runtime.solver.widening import widened

NOW = 2**62


class Blame:
    """Walks back along supports; `marked[level] == stamp` for the levels that were met."""

    def __init__(self, queues: Queues, stack: Decisions) -> None:
        self.queues = queues
        self.stack = stack
        self.engine = queues.engine
        self.stamp = 0
        self.marked = array("q", [0]) * 64
        self.met = array("q", [0]) * 64
        self.met_count = 0
        self.seen = array("q", [0]) * 256
        self.work_key = array("q", [0]) * 256
        self.work_before = array("q", [0]) * 256
        self.work_count = 0
        self.origin = 0

    # ---- walking ----

    def begin(self) -> int:
        """Forget what was met; all that is older than the first decision needs no reason."""
        self.stamp += 1
        self.met_count = 0
        self.work_count = 0
        if len(self.marked) < self.stack.room + 1:
            self.marked = widened(self.marked, self.stack.room + 1, 0)
            self.met = widened(self.met, self.stack.room + 1, 0)
        if len(self.seen) < len(self.engine.trail_key):
            self.seen = widened(self.seen, len(self.engine.trail_key), 0)
        self.origin = self.engine.trail_base + self.stack.engine_seen[0]
        return 0

    def meet(self, level: int) -> int:
        """Note a level."""
        if level > 0 and self.marked[level] != self.stamp:
            self.marked[level] = self.stamp
            self.met[self.met_count] = level
            self.met_count += 1
        return 0

    def ask(self, v: int, side: int, before: int) -> int:
        """Put it on the list to find out why a side of `v` was as it was before some moment."""
        if self.work_count == len(self.work_key):
            self.work_key = widened(self.work_key, 2 * self.work_count, 0)
            self.work_before = widened(self.work_before, 2 * self.work_count, 0)
        self.work_key[self.work_count] = v * 4 + side
        self.work_before[self.work_count] = before
        self.work_count += 1
        return 0

    def ask_domain(self, v: int) -> int:
        """Ask for all sides of a domain as it is now."""
        self.ask(v, SIDE_LOWER, NOW)
        self.ask(v, SIDE_UPPER, NOW)
        if self.engine.word[v] >= 0:
            self.ask(v, SIDE_HOLES, NOW)
        return 0

    def walk(self) -> int:
        """Answer all that was asked, and what that asks in turn."""
        engine = self.engine
        while self.work_count:
            self.work_count -= 1
            key = self.work_key[self.work_count]
            before = self.work_before[self.work_count]
            v = key >> 2
            side = key & 3
            if engine.word[v] >= 0:  # a bound of a set is rounded to a value that is no hole
                hole = engine.hole_head[v]
                while hole >= 0:
                    if engine.hole_when[hole] < before:
                        self.expand(engine.hole_support[hole], v, SIDE_HOLES, engine.hole_when[hole])
                    hole = engine.hole_next[hole]
            if side == SIDE_HOLES:
                continue
            if side == SIDE_LOWER:
                when = engine.lower_when[v]
                support = engine.lower_support[v]
            else:
                when = engine.upper_when[v]
                support = engine.upper_support[v]
            while when >= before:
                at = when - engine.trail_base
                if at < 0:
                    break
                support = engine.trail_support[at]
                when = engine.trail_when[at]
            self.expand(support, v, side, when)
        return 0

    def expand(self, support: int, v: int, side: int, when: int) -> int:
        """Note the level of a support, and ask for the bounds that it read."""
        if when >= 0:
            if when < self.origin:
                return 0
            at = when - self.engine.trail_base
            if self.seen[at] == self.stamp:
                return 0
            self.seen[at] = self.stamp
        if support < 0:
            return 0
        self.meet(self.level_of(support))
        if when >= 0:
            self.ask_reasons(support, v, side, when)
        return 0

    def ask_reasons(self, support: int, v: int, side: int, when: int) -> int:
        """Ask for all bounds that a support read when it narrowed a side of `v`."""
        collect_reasons(self.engine, support, v, side)
        for k in range(self.engine.reason_count):
            self.ask(self.engine.reasons[k] >> 2, self.engine.reasons[k] & 3, when)
        return 0

    def level_of(self, support: int) -> int:
        """The decision that posted an edge, a constraint or a restriction."""
        kind = support & 3
        if kind == SUPPORT_EDGE:
            return self.queues.edge_level[support >> 2]
        if kind == SUPPORT_CONSTRAINT:
            return self.queues.constraint_level[support >> 2]
        return self.queues.restriction_level[support >> 2]

    # ---- failed choices ----

    def learn(self, d: int) -> int:
        """Add to the reasons of decision `d` what the present conflict rests on."""
        engine = self.engine
        if self.stack.reasons[d] == EVERYTHING:
            return 0
        support = engine.conflict_support
        if engine.consistent or support < 0:
            self.stack.reasons[d] = EVERYTHING
            return 0
        self.begin()
        v = engine.conflict_variable
        side = engine.conflict_side
        self.meet(self.level_of(support))
        if v >= 0:
            self.ask_reasons(support, v, side, NOW)
            if engine.conflict_kind == CONFLICT_DOMAIN:
                self.ask_domain(v)
        else:
            first = engine.first[support >> 2]
            for k in range(first, first + engine.arity[support >> 2]):
                self.ask_domain(engine.slot_variable[k])
        self.walk()
        self.keep(d)
        return 0

    def keep(self, d: int) -> int:
        """Add the levels met to the reasons of decision `d`: those before its own."""
        stack = self.stack
        reason = stack.reasons[d]
        while reason >= 0:
            self.marked[stack.reason_level[reason]] = NONE
            reason = stack.reason_next[reason]
        for k in range(self.met_count):
            level = self.met[k]
            if level <= d and self.marked[level] == self.stamp:
                stack.add_reason(d, level)
        return 0

    # ---- decisions without choices ----

    def target(self, d: int) -> int:
        """The decision to go back to when `d` has no choice left, -1 if there is none; it inherits the reasons."""
        stack = self.stack
        if stack.reasons[d] != EVERYTHING:
            self.complete(d)
        if stack.reasons[d] == EVERYTHING:
            if d > 0:
                stack.reasons[d - 1] = EVERYTHING
            return d - 1
        latest = 0
        reason = stack.reasons[d]
        while reason >= 0:
            latest = max(latest, stack.reason_level[reason])
            reason = stack.reason_next[reason]
        if latest == 0:
            return NONE
        heir = latest - 1
        if stack.reasons[heir] != EVERYTHING:
            self.begin()
            reason = stack.reasons[d]
            while reason >= 0:
                self.meet(stack.reason_level[reason])
                reason = stack.reason_next[reason]
            self.keep(heir)
        return heir

    def complete(self, d: int) -> int:
        """Add what took choices away from decision `d` before they were tried."""
        q = self.queues
        stack = self.stack
        item = stack.item[d]
        if stack.handler[d] < 0 or q.treatments.handler_most[stack.handler[d]] != 0:
            stack.reasons[d] = EVERYTHING
            return 0
        self.begin()
        kind = stack.kind[d]
        if kind == UNBOUND_VARIABLE:
            self.meet(q.variable_level[item])
            if q.plan.variable_role[item] == ROLE_TOKEN:
                self.meet(q.active_level[q.plan.variable_owner[item]])
            self.ask_domain(item)
        elif kind == OPEN_CONDITION:
            self.blame_partners(d, item)
        elif kind == THREAT:
            self.blame_neighbours(item)
        else:
            stack.reasons[d] = EVERYTHING
            return 0
        self.walk()
        self.keep(d)
        return 0

    def blame_partners(self, d: int, t: int) -> int:
        """Why a token had no more to merge with: what it and each candidate are, and who else might have come."""
        q = self.queues
        rows = q.rows
        self.meet(q.token_level[t])
        self.ask_domain(rows.var0[t] + STATE)
        predicate = rows.predicate[t]
        candidate = first_active(q.plan, predicate)
        while candidate >= 0:
            self.meet(q.active_level[candidate])
            self.blame_difference(rows.var0[t], rows.var0[candidate], rows.width[t])
            candidate = next_active(q.plan, candidate, predicate)
        for other in range(d):
            if self.may_bring(other, predicate):
                self.meet(other + 1)
        return 0

    def blame_difference(self, mine: int, theirs: int, width: int) -> int:
        """Why two tokens are incompatible, if they are: variables without a common value, times that differ."""
        for k in range(OBJECT, width):
            if not self.engine.intersects(mine + k, theirs + k):
                self.ask_domain(mine + k)
                self.ask_domain(theirs + k)
                return 0
        for k in range(START, END + 1):
            if self.blame_edge(mine + k, theirs + k, 0) or self.blame_edge(theirs + k, mine + k, 0):
                return 0
        return 0

    def blame_edge(self, source: int, target: int, weight: int) -> bool:
        """Why `target - source <= weight` is impossible, if it is: two bounds, or a path of edges."""
        distances = self.queues.distances
        if distances.admits(source, target, weight):
            return False
        if distances.by_bounds:
            self.ask(target, SIDE_LOWER, NOW)
            self.ask(source, SIDE_UPPER, NOW)
            return True
        v = source
        while v != target:
            e = distances.via[v]
            self.meet(self.queues.edge_level[e])
            self.ask_weight(e)
            v = self.engine.edge_source[e]
        return True

    def ask_weight(self, e: int) -> int:
        """Ask for the bound of the distance that the weight of an edge follows, if it does."""
        self.engine.reason_count = 0
        collect_weight(self.engine, e)
        for k in range(self.engine.reason_count):
            self.ask(self.engine.reasons[k] >> 2, self.engine.reasons[k] & 3, NOW)
        c = self.engine.edge_link[e]
        if c >= 0:
            self.meet(self.queues.constraint_level[c])
        return 0

    def may_bring(self, d: int, predicate: int) -> bool:
        """Whether another choice of decision `d` might lead to an active token of a predicate."""
        q = self.queues
        item = self.stack.item[d]
        kind = self.stack.kind[d]
        if kind == OPEN_CONDITION:
            return q.supports.leads_to(q.rows.predicate[item], predicate)
        if kind != UNBOUND_VARIABLE or q.plan.variable_guards[item] == 0:
            return False
        t = q.filters.token_of(item)
        return t < 0 or q.supports.leads_to(q.rows.predicate[t], predicate)

    def blame_neighbours(self, t: int) -> int:
        """Why a token had no more places: its objects, all who have a place there, and where it could not fit."""
        q = self.queues
        v = q.rows.var0[t] + OBJECT
        self.meet(q.active_level[t])
        self.ask_domain(v)
        for o in range(self.engine.lb[v], self.engine.ub[v] + 1):
            if q.plan.object_timeline[o] and self.engine.contains(v, o):
                other = q.rows.head_first[q.plan.object_head[o]]
                while other >= 0:
                    self.meet(q.order_level[other])
                    after = q.rows.link_after[LISTS * other + LIST_ORDER]
                    self.blame_times(t, other, after)
                    other = after
        return 0

    def blame_times(self, t: int, other: int, after: int) -> int:
        """Why a token fits neither before another one, nor behind it, nor between it and the one after (NONE: none)."""
        var0 = self.queues.rows.var0
        lb = self.engine.lb
        ub = self.engine.ub
        self.blame_edge(var0[other] + START, var0[t] + END, 0)
        self.blame_edge(var0[t] + START, var0[other] + END, 0)
        if after >= 0 and ub[var0[after] + START] - lb[var0[other] + END] < lb[var0[t] + DURATION]:
            self.ask(var0[other] + END, SIDE_LOWER, NOW)
            self.ask(var0[after] + START, SIDE_UPPER, NOW)
            self.ask(var0[t] + DURATION, SIDE_LOWER, NOW)
        return 0
