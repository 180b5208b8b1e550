"""Flaw filters tested at every step: horizon, scope, infinite domains, guards, unassigned tokens and parents."""

from runtime.constraints.domains.bitset import count_values
from runtime.constraints.domains.narrow import is_single
from runtime.constraints.domains.queries import has_finitely_many
from runtime.constraints.domains.tags import INF, KIND_FLOAT
from runtime.plan.store.plan import Plan
from runtime.plan.tags import ACTIVE, END, LIST_ORDER, LISTS, NONE, OBJECT, ROLE_LOCAL, ROLE_TOKEN, START
from runtime.solver.configuration.handler_table import HandlerTable
from runtime.solver.tags import (
    FILTER_GUARD,
    FILTER_HORIZON,
    FILTER_HORIZON_VARIABLE,
    FILTER_NOT_ASSIGNED,
    FILTER_NOT_GUARD,
    FILTER_NOT_SINGLETON,
    FILTER_PARENT_NOT_ASSIGNED,
    POLICY_PARTIAL,
    POLICY_POSSIBLE,
)


class PlanningScope:
    """The flaws in scope; a reactor replaces it by one that knows its window of time."""

    def admits_token(self, t: int) -> bool:
        """Whether flaws of token `t` are in scope; asked again when its times change."""
        return t >= 0

    def may_begin(self, t: int) -> bool:
        """Whether token `t` has not begun, as far as its times say: else none but facts may be put before it."""
        return t >= 0

    def begins_in_time(self, t: int) -> bool:
        """Whether the rules of token `t`, which have just fired, leave it a time to begin; else that is a conflict."""
        return t >= 0

    def may_overtake(self, t: int, other: int) -> bool:
        """Whether token `t` may be put before `other`, which was asked for sooner and waits for something else."""
        return t != other

    def admits_variable(self, v: int) -> bool:
        """Whether variable `v` may be decided; asked again when its domain or its token's times change."""
        return v >= 0


class Filters:
    """The horizon, the scope, and the tests."""

    def __init__(self, plan: Plan, table: HandlerTable, lower: int, upper: int) -> None:
        self.plan = plan
        self.rows = plan.rows
        self.engine = plan.engine
        self.table = table
        self.lower = lower
        self.upper = upper
        self.has_scope = False
        self.scope = PlanningScope()

    def keeps_token(self, row: int, t: int) -> bool:
        """Whether a filter of `row` keeps token `t` back."""
        if self.has_scope and not self.scope.admits_token(t):
            return True
        first = self.table.filter_first[row]
        for f in range(first, first + self.table.filter_count[row]):
            code = self.table.filter_code[f]
            if code == FILTER_HORIZON:
                if self._is_outside(t, self.table.filter_policy[f]):
                    return True
            elif code == FILTER_PARENT_NOT_ASSIGNED:
                parent = self.rows.parent[t]
                if parent >= 0 and not self._is_assigned(parent):
                    return True
        return False

    def keeps_variable(self, row: int, v: int) -> bool:
        """Whether variable `v` has no values to choose from, or a filter of `row` keeps it back."""
        if not has_finitely_many(self.engine, v):
            return True
        if self.has_scope and not self.scope.admits_variable(v):
            return True
        t = self.token_of(v)
        first = self.table.filter_first[row]
        for f in range(first, first + self.table.filter_count[row]):
            code = self.table.filter_code[f]
            if code == FILTER_HORIZON or code == FILTER_HORIZON_VARIABLE:
                if t >= 0 and self._is_outside(t, self.table.filter_policy[f]):
                    return True
            elif code == FILTER_NOT_SINGLETON:
                if not is_single(self.engine, v):
                    return True
            elif code == FILTER_GUARD:
                if self.plan.variable_guards[v] > 0:
                    return True
            elif code == FILTER_NOT_GUARD:
                if self.plan.variable_guards[v] == 0:
                    return True
            elif code == FILTER_NOT_ASSIGNED and t >= 0 and not self._is_assigned(t):
                return True
        return False

    def waits_for_times(self, row: int) -> bool:
        """Whether a filter of `row` reads the times of the token."""
        if self.has_scope:
            return True
        first = self.table.filter_first[row]
        for f in range(first, first + self.table.filter_count[row]):
            code = self.table.filter_code[f]
            if code == FILTER_HORIZON or code == FILTER_HORIZON_VARIABLE:
                return True
        return False

    def _is_outside(self, t: int, policy: int) -> bool:
        """Whether the times of `t` do not lie in the horizon, in the sense of `policy`."""
        start = self.rows.var0[t] + START
        end = self.rows.var0[t] + END
        engine = self.engine
        if policy == POLICY_PARTIAL:
            return engine.lb[end] <= self.lower or engine.ub[start] >= self.upper
        if policy == POLICY_POSSIBLE:
            return (
                engine.lb[start] > self.upper
                or engine.ub[start] < self.lower
                or engine.lb[end] > self.upper
                or engine.ub[end] < self.lower
            )
        return (
            engine.lb[start] < self.lower
            or engine.lb[start] > self.upper
            or engine.ub[end] < self.lower
            or engine.ub[end] > self.upper
        )

    def _is_assigned(self, t: int) -> bool:
        """Whether `t` is active, its object is known, and it is ordered there if that is a timeline."""
        if self.rows.status[t] != ACTIVE or not is_single(self.engine, self.rows.var0[t] + OBJECT):
            return False
        if not self.plan.predicate_timeline[self.rows.predicate[t]]:
            return True
        return self.rows.link_head[LISTS * t + LIST_ORDER] >= 0

    def token_of(self, v: int) -> int:
        """The token that a variable belongs to, also one of its rules; NONE for globals and members."""
        role = self.plan.variable_role[v]
        return self.plan.variable_owner[v] if role == ROLE_TOKEN or role == ROLE_LOCAL else NONE

    def size(self, v: int) -> int:
        """Number of values of a variable; INF if it is not finite."""
        if not has_finitely_many(self.engine, v):
            return INF
        if self.engine.kind[v] == KIND_FLOAT:
            return 1 if is_single(self.engine, v) else self.engine.table_length[v]
        return count_values(self.engine, v)
