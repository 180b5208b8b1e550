"""Find which decisions a conflict rests on, so that the search goes back to the latest of them and no farther.

Decision `d` is level d + 1; level 0 is what held before the search. A failed choice adds to the decision's reasons the
levels of all edges, constraints and restrictions that its conflict was derived from, and of what let the guards fire
that posted them. When no choice is left, what took the other choices away (shortage.py) completes the reasons; the
latest of them is where another choice may help (conflict-directed backjumping, Prosser 1993). More levels than needed
do no harm: the search then goes back less far.
"""

from runtime.constraints.domains.tags import CONFLICT_DOMAIN, FLOAT_TOLERANCE, OP_EXTERNAL, SIDE_LOWER, SIDE_UPPER
from runtime.plan.resources.violation import Excess
from runtime.plan.tags import (
    ACTIVE,
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
from runtime.solver.learning.support_walk import Walk
from runtime.solver.tags import EVERYTHING, NONE, NOW, OPEN_CONDITION, UNBOUND_VARIABLE


class ConflictAnalysis(Walk):
    """The reasons of decisions, as levels."""

    # ---- failed choices ----

    def learn(self, d: int) -> bool:
        """Add to the reasons of decision `d` what the present conflict rests on.

        True if that is nothing of what was chosen just now: then these are all its reasons, and it has no choice left.
        """
        engine = self.engine
        support = engine.conflict_support
        if engine.consistent or support < 0 or self.agenda.plan.loops_read_choices:
            self.stack.reasons[d] = EVERYTHING
            return False
        self.begin()
        v = engine.conflict_variable
        side = engine.conflict_side
        if v >= 0:
            self.meet(self.level_of(support))
            self.ask_reasons(support, v, side, NOW)
            if engine.conflict_kind == CONFLICT_DOMAIN:
                self.ask_domain(v)
        elif engine.op[support >> 2] == OP_EXTERNAL and isinstance(engine.externals[support >> 2], Excess):
            if not self.blame_excess(support >> 2, d):
                self.stack.reasons[d] = EVERYTHING
                return False
        else:
            self.meet(self.level_of(support))
            first = engine.first[support >> 2]
            for k in range(first, first + engine.arity[support >> 2]):
                self.ask_domain(engine.slot_variable[k])
        self.walk()
        is_all = self.marked[d + 1] != self.stamp
        if is_all:
            self.stack.drop_reasons(d)
            self.stack.is_local[d] = 0
        if self.stack.reasons[d] != EVERYTHING:
            self.keep(d)
        return is_all

    def keep(self, d: int) -> int:
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
        return 0

    # ---- decisions without choices ----

    def target(self, d: int) -> int:
        """The decision to go back to when `d` has no choice left, -1 if there is none; it inherits the reasons."""
        stack = self.stack
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
            self.is_local = stack.is_local[d] != 0
            reason = stack.reasons[d]
            while reason >= 0:
                self.meet(stack.reason_level[reason])
                reason = stack.reason_next[reason]
            self.keep(heir)
        return heir

    def may_bring(self, d: int, predicate: int) -> bool:
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

    def blame_absence(self, d: int, predicate: int) -> int:
        """Note the decisions before `d` that might have brought a token of a predicate, and whether any still may."""
        agenda = self.agenda
        for other in range(d + 1):
            if self.may_bring(other, predicate):
                self.meet(other + 1)
                self.is_local = True
        t = agenda.rows.head_first[HEAD_OPEN]
        while t >= 0 and not self.is_local:
            self.is_local = agenda.supports.leads_to(agenda.rows.predicate[t], predicate)
            t = agenda.rows.link_after[LISTS * t + LIST_OPEN]
        if agenda.supports.is_guarded(predicate):
            self.is_local = True
        return 0

    def blame_use(self, u: int, d: int) -> int:
        """Why use `u` of a resource exists, and is on that resource."""
        agenda = self.agenda
        self.ask_domain(agenda.plan.resources.holder[u])
        t = agenda.plan.resources.token[u]
        if t >= 0:
            self.meet(agenda.token_level[t])
        while d >= 0 and agenda.plan.mark_uses[self.stack.mark[d]] > u:
            d -= 1
        self.meet(d + 1)
        return 0

    def blame_helpers(self, o: int, sign: int, d: int) -> bool:
        """Why nothing else gives to (takes from) resource `o` what would help; False if that has no simple reason."""
        agenda = self.agenda
        uses = agenda.plan.resources
        for u in range(uses.count):
            if uses.sign[u] == sign and uses.end[u] < 0 and uses.on[u] != o:
                if not self.engine.is_singleton(uses.holder[u]):
                    return False
                self.ask_domain(uses.holder[u])
        kind = RESOURCE_PRODUCES if sign > 0 else RESOURCE_CONSUMES
        for predicate in range(len(agenda.plan.predicate_resource)):
            if agenda.plan.predicate_resource[predicate] == kind:
                self.blame_absence(d, predicate)
        self.is_local = True  # in another order it may come before what it would have helped
        return True

    def blame_window(self, excess: Excess) -> int:
        """Why tokens lie in a window that is too narrow: the widest such, that of before the search if it will do."""
        var0 = self.agenda.rows.var0
        needed = int(excess.amount) + excess.until - excess.at
        start = excess.at
        end = excess.until
        for t in excess.tokens:
            start = min(start, self.first(var0[t] + START, SIDE_LOWER))
            end = max(end, self.first(var0[t] + END, SIDE_UPPER))
        if end - start >= needed:
            start = max(start, excess.until + 1 - needed)
            end = min(end, start + needed - 1)
        for t in excess.tokens:
            self.blame_crowd(t)
            self.ask_enough(var0[t] + START, SIDE_LOWER, start)
            self.ask_enough(var0[t] + END, SIDE_UPPER, end)
        return 0

    def blame_crowd(self, t: int) -> int:
        """Why token `t` is to be ordered on its timeline (disjunctive.py)."""
        agenda = self.agenda
        first = agenda.rows.var0[t]
        self.meet(agenda.active_level[t])
        self.ask_domain(first + OBJECT)
        if agenda.rows.link_head[LISTS * t + LIST_ORDER] < 0 or agenda.order_level[t] > 0:
            self.ask_enough(first + END, SIDE_LOWER, agenda.filters.lower + 1)
            self.ask_enough(first + START, SIDE_UPPER, agenda.filters.upper - 1)
        return 0

    def blame_excess(self, c: int, d: int) -> bool:
        """Why constraint `c` says that a resource is exceeded; False if that has no simple reason."""
        excess = self.engine.externals[c]
        for key, enough in zip(excess.read, excess.enough, strict=True):
            self.ask_enough(key >> 2, key & 3, enough)
        slack = excess.amount - FLOAT_TOLERANCE
        for start, end, length, least in excess.parts:
            share = excess.share(self.engine.lb[start], self.engine.ub[end], length)
            loss = least * (share - excess.share(self.first(start, SIDE_LOWER), self.first(end, SIDE_UPPER), length))
            if loss < slack:
                slack -= loss  # it is too tight also with the times that it had before the search
                continue
            self.ask(start, SIDE_LOWER, NOW)
            self.ask(end, SIDE_UPPER, NOW)
        for u in excess.uses:
            self.blame_use(u, d)
        if excess.tokens:
            self.blame_window(excess)
        for e in excess.edges:
            self.meet(self.agenda.edge_level[e])
            self.ask_weight(e)
        return excess.helper == 0 or self.blame_helpers(excess.resource, excess.helper, d)
