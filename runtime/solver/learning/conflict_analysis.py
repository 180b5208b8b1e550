"""Conflict analysis: the decisions that a conflict rests on, for backjumping to the latest of them.

Decision `d` is level d + 1; level 0 is what held before the search. A failed resolver adds to the conflict set of its
decision the levels of all edges, constraints and restrictions that its conflict was derived from, and of what let the
guards fire that posted them. When no resolver is left, what pruned the others (dead_end.py) completes the conflict set
(conflict-directed backjumping, Prosser 1993). More levels than needed do no harm: the search then jumps less far back.
So the walk asks for all sides of a domain without values and of the arguments of a constraint that cannot hold, and
follows a negative cycle by the bounds of its last edge; explanations (explain.py) read less there.
"""

from runtime.constraints.domains.arrays import blank, grow_rows
from runtime.constraints.domains.tags import (
    CONFLICT_DOMAIN,
    FLOAT_TOLERANCE,
    SIDE_HOLES,
    SIDE_LOWER,
    SIDE_UPPER,
    SUPPORT_CONSTRAINT,
    SUPPORT_EDGE,
)
from runtime.constraints.explanation.support_walk import SupportWalk
from runtime.constraints.propagators.opcodes import OP_EXTERNAL
from runtime.plan.resources.violation import Violation
from runtime.plan.rules.guards import deciders
from runtime.plan.tags import (
    ACTIVE,
    AS_IT_IS,
    END,
    HEAD_OPEN,
    LIST_OPEN,
    LIST_ORDER,
    LISTS,
    OBJECT,
    RESOURCE_CONSUMES,
    RESOURCE_PRODUCES,
    START,
)
from runtime.solver.flaws.agenda import Agenda
from runtime.solver.flaws.decisions import Decisions
from runtime.solver.tags import EVERYTHING, NONE, NOW, OPEN_CONDITION, UNBOUND_VARIABLE


class ConflictAnalysis(SupportWalk):
    """The visitor that collects decision levels: `marked[level] == stamp` for those that were met."""

    def __init__(self, agenda: Agenda, stack: Decisions) -> None:
        super().__init__(agenda.engine)
        self.agenda = agenda
        self.stack = stack
        self.marked = blank(64)
        self.met = blank(64)
        self.met_count = 0
        self.opened = 0
        self.is_local = False  # what was met counts only as long as nothing else is decided before

    def begin(self) -> None:
        """Forget what was met; all that is older than the first decision needs no reason."""
        self.start()
        self.met_count = self.opened = 0
        self.is_local = False
        if len(self.marked) <= len(self.stack.kind):
            grow_rows(self, "marked met", len(self.stack.kind) + 1)
        self.origin = self.engine.trail_base + self.stack.engine_seen[0]

    def meet(self, level: int) -> None:
        """Note a level."""
        if level > 0 and self.marked[level] != self.stamp:
            self.marked[level] = self.stamp
            self.met[self.met_count] = level
            self.met_count += 1

    def visit(self, support: int, v: int, side: int, when: int) -> bool:
        """Note the level of a change; declarations are read no further."""
        self.meet(self._level_of(support))
        return when >= 0

    def visit_support(self, support: int) -> None:
        """Note the level of an edge, a constraint or a restriction."""
        self.meet(self._level_of(support))

    def ask_more(self) -> bool:
        """Ask why the guards held that fired at the levels met: what followed rests on all that decided them."""
        if self.opened == self.met_count:
            return False
        self.opened += 1
        self._ask_guards(self.met[self.opened - 1])
        return True

    def _level_of(self, support: int) -> int:
        """The decision that posted an edge, a constraint or a restriction."""
        kind = support & 3
        if kind == SUPPORT_EDGE:
            return self.agenda.edge_level[support >> 2]
        if kind == SUPPORT_CONSTRAINT:
            return self.agenda.constraint_level[support >> 2]
        return self.agenda.restriction_level[support >> 2]

    def ask_enough(self, v: int, side: int, enough: int) -> int:
        """Ask why a bound of `v`, no real, is as tight as `enough`: when that was reached first."""
        engine = self.engine
        if enough == AS_IT_IS:
            self.ask(v, side, NOW)
            return 0
        before = NOW
        when = engine.lower_when[v] if side == SIDE_LOWER else engine.upper_when[v]
        while when >= self.origin:
            at = when - engine.trail_base
            old = engine.trail_value[at]
            if (old < enough) if side == SIDE_LOWER else (old > enough):
                break
            before = when
            when = engine.trail_when[at]
        self.ask(v, side, before)
        return 0

    def base_bound(self, v: int, side: int) -> int:
        """A bound of `v`, no real, as it was before the search."""
        engine = self.engine
        when = engine.lower_when[v] if side == SIDE_LOWER else engine.upper_when[v]
        bound = engine.lb[v] if side == SIDE_LOWER else engine.ub[v]
        while when >= self.origin:
            bound = engine.trail_value[when - engine.trail_base]
            when = engine.trail_when[when - engine.trail_base]
        return bound

    def ask_domain(self, v: int) -> None:
        """Ask for all sides of a domain as it is now."""
        self.ask(v, SIDE_LOWER, NOW)
        self.ask(v, SIDE_UPPER, NOW)
        if self.engine.word[v] >= 0:
            self.ask(v, SIDE_HOLES, NOW)

    def _ask_guards(self, level: int) -> None:
        """Ask why the guards held that fired at a level: what followed rests on all that decided them."""
        agenda = self.agenda
        for k in range(agenda.fired_end[level - 1], agenda.fired_end[level]):
            s = agenda.fired_scope[k]
            t = agenda.rows.scope_token[s]
            if t >= 0:
                self.meet(agenda.active_level[t])
            while s >= 0:
                if agenda.rows.scope_watch[s] >= 0:
                    self._ask_arguments(agenda.rows.scope_watch[s])
                s = agenda.rows.scope_parent[s]

    def _ask_arguments(self, c: int) -> None:
        """Ask for the domains of all that decides a guard which waits with a constraint, and who decided it."""
        engine = self.engine
        for v in deciders(self.agenda.plan, c):
            self.ask_domain(v)
            r = engine.restriction_head[v]
            while r >= 0:
                self.meet(self.agenda.restriction_level[r])
                r = engine.restriction_next[r]

    def explain_edge(self, source: int, target: int, weight: int) -> bool:
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
            self._ask_path_edge(e)
            v = self.engine.edge_source[e]
        return True

    def _ask_path_edge(self, e: int) -> None:
        """Note an edge of a path with the constraint that it carries out, and ask for its weight."""
        self.ask_edge(e, NOW)
        c = self.engine.edge_link[e]
        if c >= 0:
            self.meet(self.agenda.constraint_level[c])

    # ---- failed choices ----

    def learn(self, d: int) -> bool:
        """Add to the reasons of decision `d` what the present conflict rests on.

        True if that is nothing of what was chosen just now: then these are all its reasons, and it has no choice left.
        """
        engine = self.engine
        support = engine.conflict_support
        if engine.consistent or support < 0 or self.agenda.plan.loops_read_choices:
            self.stack.rest_on_everything(d)
            return False
        self.begin()
        v = engine.conflict_variable
        side = engine.conflict_side
        if v >= 0:
            self.visit_support(support)
            self.ask_reasons(support, v, side, NOW)
            if engine.conflict_kind == CONFLICT_DOMAIN:
                self.ask_domain(v)
        elif engine.op[support >> 2] == OP_EXTERNAL and isinstance(engine.externals[support >> 2], Violation):
            if not self._explain_violation(support >> 2, d):
                self.stack.rest_on_everything(d)
                return False
        else:
            self.visit_support(support)
            first = engine.first[support >> 2]
            for k in range(first, first + engine.arity[support >> 2]):
                self.ask_domain(engine.slot_variable[k])
        self.walk()
        is_all = bool(self.marked[d + 1] != self.stamp)
        if is_all:
            self.stack.drop_reasons(d)
            self.stack.is_local[d] = 0
        if self.stack.reasons[d] != EVERYTHING:
            self.keep(d)
        return is_all

    def keep(self, d: int) -> None:
        """Add the levels met to the reasons of decision `d`: those before its own."""
        stack = self.stack
        if self.is_local:
            stack.is_local[d] = 1
        reason = stack.reasons[d]
        while reason >= 0:
            self.marked[stack.reason_level[reason]] = NONE
            reason = stack.reason_next[reason]
        for k in range(self.met_count):
            level = self.met[k]
            if level <= d and self.marked[level] == self.stamp:
                stack.add_reason(d, level)

    # ---- decisions without choices ----

    def target(self, d: int) -> int:
        """The decision to go back to when `d` has no choice left, -1 if there is none; it inherits the reasons."""
        stack = self.stack
        if stack.reasons[d] == EVERYTHING:
            if d > 0:
                stack.rest_on_everything(d - 1)
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
            self.is_local = stack.is_local[d] != 0
            reason = stack.reasons[d]
            while reason >= 0:
                self.meet(stack.reason_level[reason])
                reason = stack.reason_next[reason]
            self.keep(heir)
        return heir

    def _may_bring(self, d: int, predicate: int) -> bool:
        """Whether another choice of decision `d` might lead to an active token of a predicate.

        Guards wait for decided variables: one that is given a value may let them fire, and one that a merge decides.
        """
        agenda = self.agenda
        item = self.stack.item[d]
        kind = self.stack.kind[d]
        if kind == OPEN_CONDITION:
            mine = agenda.rows.predicate[item]
            is_new = agenda.rows.status[item] != ACTIVE or agenda.supports.first[mine + 1] > agenda.supports.first[mine]
            if is_new and agenda.supports.leads_to(mine, predicate):
                return True
            return agenda.waiting_guards[d] > 0 and agenda.supports.is_guarded(predicate)
        if kind == UNBOUND_VARIABLE:
            return agenda.plan.variable_guards[item] > 0 and agenda.supports.is_guarded(predicate)
        return False

    def explain_absence(self, d: int, predicate: int) -> None:
        """Note the decisions before `d` that might have brought a token of a predicate, and whether any still may."""
        agenda = self.agenda
        for other in range(d + 1):
            if self._may_bring(other, predicate):
                self.meet(other + 1)
                self.is_local = True
        t = agenda.rows.head_first[HEAD_OPEN]
        while t >= 0 and not self.is_local:
            self.is_local = agenda.supports.leads_to(agenda.rows.predicate[t], predicate)
            t = agenda.rows.link_after[LISTS * t + LIST_OPEN]
        if agenda.supports.is_guarded(predicate):
            self.is_local = True

    def explain_use(self, u: int, d: int) -> None:
        """Why use `u` of a resource exists, and is on that resource."""
        agenda = self.agenda
        self.ask_domain(agenda.plan.resources.holder[u])
        t = agenda.plan.resources.token[u]
        if t >= 0:
            self.meet(agenda.token_level[t])
        while d >= 0 and agenda.plan.mark_uses[self.stack.mark[d]] > u:
            d -= 1
        self.meet(d + 1)

    def explain_helpers(self, o: int, sign: int, d: int) -> bool:
        """Why nothing else gives to (takes from) resource `o` what would help; False if that has no simple reason."""
        agenda = self.agenda
        uses = agenda.plan.resources
        for u in range(uses.count):
            if uses.sign[u] == sign and uses.end[u] < 0 and uses.on[u] != o:
                if not self.agenda.engine.is_singleton(uses.holder[u]):
                    return False
                self.ask_domain(uses.holder[u])
        kind = RESOURCE_PRODUCES if sign > 0 else RESOURCE_CONSUMES
        for predicate in range(len(agenda.plan.predicate_resource)):
            if agenda.plan.predicate_resource[predicate] == kind:
                self.explain_absence(d, predicate)
        self.is_local = True  # in another order it may come before what it would have helped
        return True

    def _explain_window(self, violation: Violation) -> None:
        """Why tokens lie in a window that is too narrow: the widest such, that of before the search if it will do."""
        var0 = self.agenda.rows.var0
        needed = int(violation.amount) + violation.until - violation.at
        start = violation.at
        end = violation.until
        for t in violation.tokens:
            start = min(start, self.base_bound(var0[t] + START, SIDE_LOWER))
            end = max(end, self.base_bound(var0[t] + END, SIDE_UPPER))
        if end - start >= needed:
            start = max(start, violation.until + 1 - needed)
            end = min(end, start + needed - 1)
        for t in violation.tokens:
            self._explain_ordering(t)
            self.ask_enough(var0[t] + START, SIDE_LOWER, start)
            self.ask_enough(var0[t] + END, SIDE_UPPER, end)

    def _explain_ordering(self, t: int) -> None:
        """Why token `t` is to be ordered on its timeline (disjunctive.py)."""
        agenda = self.agenda
        first = agenda.rows.var0[t]
        self.meet(agenda.active_level[t])
        self.ask_domain(first + OBJECT)
        if agenda.rows.link_head[LISTS * t + LIST_ORDER] < 0 or agenda.order_level[t] > 0:
            self.ask_enough(first + END, SIDE_LOWER, agenda.filters.lower + 1)
            self.ask_enough(first + START, SIDE_UPPER, agenda.filters.upper - 1)

    def _explain_violation(self, c: int, d: int) -> bool:
        """Why constraint `c` says that a resource is exceeded; False if that has no simple reason."""
        violation = self.engine.externals[c]
        for key, enough in zip(violation.read, violation.enough, strict=True):
            self.ask_enough(key >> 2, key & 3, enough)
        slack = violation.amount - FLOAT_TOLERANCE
        for start, end, length, least in violation.parts:
            share = violation.share(self.engine.lb[start], self.engine.ub[end], length)
            loss = least * (
                share - violation.share(self.base_bound(start, SIDE_LOWER), self.base_bound(end, SIDE_UPPER), length)
            )
            if loss < slack:
                slack -= loss  # it is too tight also with the times that it had before the search
                continue
            self.ask(start, SIDE_LOWER, NOW)
            self.ask(end, SIDE_UPPER, NOW)
        for u in violation.uses:
            self.explain_use(u, d)
        if violation.tokens:
            self._explain_window(violation)
        for e in violation.edges:
            self._ask_path_edge(e)
        return violation.helper == 0 or self.explain_helpers(violation.resource, violation.helper, d)
