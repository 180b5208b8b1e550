"""Walk back along the supports of bounds, and note the levels of the decisions that are met."""

from array import array

from runtime.constraints.domains.tags import SIDE_HOLES, SIDE_LOWER, SIDE_UPPER, SUPPORT_CONSTRAINT, SUPPORT_EDGE
from runtime.constraints.explanation.reasons import collect_reasons, collect_weight
from runtime.plan.rules.guards import deciders
from runtime.plan.tags import AS_IT_IS
from runtime.solver.flaws.agenda import Agenda
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.tags import NOW
from runtime.solver.widening import widened


class Walk:
    """Walks back along supports; `marked[level] == stamp` for the levels that were met."""

    def __init__(self, agenda: Agenda, stack: Decisions) -> None:
        self.agenda = agenda
        self.stack = stack
        self.engine = agenda.engine
        self.stamp = 0
        self.marked = array("q", [0]) * 64
        self.met = array("q", [0]) * 64
        self.met_count = 0
        self.seen = array("q", [0]) * 256
        self.work_key = array("q", [0]) * 256
        self.work_before = array("q", [0]) * 256
        self.work_count = 0
        self.origin = 0
        self.opened = 0
        self.is_local = False  # what was met counts only as long as nothing else is decided before

    def begin(self) -> int:
        """Forget what was met; all that is older than the first decision needs no reason."""
        self.stamp += 1
        self.met_count = self.opened = self.work_count = 0
        self.is_local = False
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

    def ask_enough(self, v: int, side: int, enough: int) -> int:
        """Ask why a bound of `v`, no real, is as tight as `enough`: when that was reached first."""
        engine = self.engine
        if enough == AS_IT_IS:
            return self.ask(v, side, NOW)
        before = NOW
        when = engine.lower_when[v] if side == SIDE_LOWER else engine.upper_when[v]
        while when >= self.origin:
            at = when - engine.trail_base
            old = engine.trail_value[at]
            if (old < enough) if side == SIDE_LOWER else (old > enough):
                break
            before = when
            when = engine.trail_when[at]
        return self.ask(v, side, before)

    def first(self, v: int, side: int) -> int:
        """A bound of `v`, no real, as it was before the search."""
        engine = self.engine
        when = engine.lower_when[v] if side == SIDE_LOWER else engine.upper_when[v]
        bound = engine.lb[v] if side == SIDE_LOWER else engine.ub[v]
        while when >= self.origin:
            bound = engine.trail_value[when - engine.trail_base]
            when = engine.trail_when[when - engine.trail_base]
        return bound

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
        while self.work_count or self.opened < self.met_count:
            if self.work_count == 0:
                self.opened += 1
                self.ask_guards(self.met[self.opened - 1])
                continue
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

    def ask_guards(self, level: int) -> int:
        """Ask why the guards held that fired at a level: what followed rests on all that decided them."""
        agenda = self.agenda
        for k in range(agenda.fired_end[level - 1], agenda.fired_end[level]):
            s = agenda.fired_scope[k]
            t = agenda.rows.scope_token[s]
            if t >= 0:
                self.meet(agenda.active_level[t])
            while s >= 0:
                if agenda.rows.scope_watch[s] >= 0:
                    self.ask_arguments(agenda.rows.scope_watch[s])
                s = agenda.rows.scope_parent[s]
        return 0

    def ask_arguments(self, c: int) -> int:
        """Ask for the domains of all that decides a guard which waits with a constraint, and who decided it."""
        engine = self.engine
        for v in deciders(self.agenda.plan, c):
            self.ask_domain(v)
            r = engine.restriction_head[v]
            while r >= 0:
                self.meet(self.agenda.restriction_level[r])
                r = engine.restriction_next[r]
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
            return self.agenda.edge_level[support >> 2]
        if kind == SUPPORT_CONSTRAINT:
            return self.agenda.constraint_level[support >> 2]
        return self.agenda.restriction_level[support >> 2]

    def blame_edge(self, source: int, target: int, weight: int) -> bool:
        """Why `target - source <= weight` is impossible, if it is: two bounds, or a path of edges."""
        distances = self.agenda.distances
        if distances.admits(source, target, weight):
            return False
        if distances.by_bounds:
            self.ask(target, SIDE_LOWER, NOW)
            self.ask(source, SIDE_UPPER, NOW)
            return True
        v = source
        while v != target:
            e = distances.via[v]
            self.meet(self.agenda.edge_level[e])
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
            self.meet(self.agenda.constraint_level[c])
        return 0
