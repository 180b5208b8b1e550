"""Disjunctive overload check: the tokens of one timeline need more time than a window has.

Tokens count that are ordered there, or must be: active on that timeline and no other, and excluded by no horizon
filter, now or later. Windows run from an earliest start to a latest end.
"""

from runtime.constraints.domains.arrays import blank, lengthen
from runtime.constraints.domains.tags import HALF_INF, KIND_FLOAT, SIDE_LOWER
from runtime.plan.resources.violation import Violation
from runtime.plan.tags import (
    DURATION,
    END,
    HEAD_THREAT,
    INITIAL,
    LIST_ORDER,
    LIST_THREAT,
    LISTS,
    MINIMUM,
    OBJECT,
    START,
    TOO_TIGHT,
)
from runtime.solver.flaws.agenda import Agenda
from runtime.solver.tags import FILTER_HORIZON, NONE, POLICY_PARTIAL, THREAT

_PRIME = 1_000_000_007
_MOST_STARTS = 64  # with more tokens only windows from the earliest start are looked at


class Disjunctive:
    """The tokens of one timeline at a time, by latest end, over arrays that are used again."""

    def __init__(self, agenda: Agenda) -> None:
        self.agenda = agenda
        self.rows = agenda.rows
        self.engine = agenda.engine
        self.one = NONE
        self.zero = NONE
        self.count = 0
        self.token = blank(64)
        self.start = blank(64)
        self.end = blank(64)
        self.length = blank(64)
        self.known = blank(64)  # by object: hash of the tokens that were checked last
        self.stamp = 0
        self.stamped = blank(64)
        self.found_start = 0
        self.found_end = 0

    def fit(self) -> bool:
        """Whether no window of any timeline is overloaded; else the engine has a conflict."""
        agenda = self.agenda
        if agenda.filters.has_scope:
            return True  # tokens may enter and leave a scope
        if len(self.known) < agenda.plan.object_count:
            lengthen(self, "known stamped", need=agenda.plan.object_count)
        self.stamp += 1
        t = self.rows.head_first[HEAD_THREAT]
        while t >= 0:
            o = self.engine.lb[self.rows.var0[t] + OBJECT]
            if self._must_be_ordered_on(t, o) and self.stamped[o] != self.stamp:
                self.stamped[o] = self.stamp
                if not self._fit_on(o):
                    return False
            t = self.rows.link_after[LISTS * t + LIST_THREAT]
        return True

    def _must_be_ordered_on(self, t: int, o: int) -> bool:
        """Whether an active, unordered token must be ordered on timeline `o`."""
        return (
            self.engine.ub[self.rows.var0[t] + OBJECT] == o
            and self.agenda.plan.object_timeline[o] != 0
            and self._must_be_ordered(t)
        )

    def _must_be_ordered(self, t: int) -> bool:
        """Whether a manager orders token `t`, and no filter excludes it, now or later."""
        agenda = self.agenda
        table = agenda.table
        for manager in range(agenda.managers):
            row = agenda.token_row[t * agenda.managers + manager]
            if table.manager_kind[manager] != THREAT or row < 0 or table.heap_of[row] < 0:
                continue
            is_plain = not agenda.filters.keeps_token(row, t)
            first = table.filter_first[row]
            for f in range(first, first + table.filter_count[row]):
                if table.filter_code[f] != FILTER_HORIZON or table.filter_policy[f] != POLICY_PARTIAL:
                    is_plain = False
            if is_plain:
                return True
        return False

    def _fit_on(self, o: int) -> bool:
        """Whether no window of timeline `o` is overloaded."""
        self.count = 0
        t = self.rows.head_first[self.agenda.plan.object_head[o]]
        while t >= 0:
            if self.agenda.order_level[t] == 0 or self._must_be_ordered(t):
                self._add(t)
            t = self.rows.link_after[LISTS * t + LIST_ORDER]
        t = self.rows.head_first[HEAD_THREAT]
        while t >= 0:
            if self.engine.lb[self.rows.var0[t] + OBJECT] == o and self._must_be_ordered_on(t, o):
                self._add(t)
            t = self.rows.link_after[LISTS * t + LIST_THREAT]
        times = self._hash()
        if times == self.known[o]:
            return True
        if self._find_window():
            return self._refuse(o)
        self.known[o] = times
        return True

    def _add(self, t: int) -> None:
        """Insert a token by latest end."""
        if self.count == len(self.token):
            lengthen(self, "token start end length")
        engine = self.engine
        first = self.rows.var0[t]
        start = engine.lb[first + START]
        end = engine.ub[first + END]
        at = self.count
        self.count = at + 1
        while at > 0 and self.end[at - 1] > end:
            self.token[at] = self.token[at - 1]
            self.start[at] = self.start[at - 1]
            self.end[at] = self.end[at - 1]
            self.length[at] = self.length[at - 1]
            at -= 1
        self.token[at] = t
        self.start[at] = start
        self.end[at] = end
        self.length[at] = max(0, engine.lb[first + DURATION])

    def _hash(self) -> int:
        """Hash of the times of the tokens, in order."""
        total = 1
        for k in range(self.count):
            total = (total * 31 + self.start[k]) % _PRIME
            total = (total * 31 + self.end[k]) % _PRIME
            total = (total * 31 + self.length[k]) % _PRIME
        return total

    def _find_window(self) -> bool:
        """Whether some window is overloaded; the worst one is noted."""
        first = HALF_INF
        for k in range(self.count):
            first = min(first, self.start[k])
        most = 0
        for i in range(self.count):
            start = self.start[i]
            if start <= -HALF_INF or (self.count > _MOST_STARTS and start > first):
                continue
            needed = 0
            for k in range(self.count):
                end = self.end[k]
                if self.start[k] < start:
                    continue
                needed += self.length[k]
                if end < HALF_INF and needed - (end - start) > most:
                    most = needed - (end - start)
                    self.found_start = start
                    self.found_end = end
        return most > 0

    def _refuse(self, o: int) -> bool:
        """Post a constraint on the tokens in the window that fails for the same reason, for its explanation."""
        engine = self.engine
        if self.one < 0:
            self.one = engine.new_constant(KIND_FLOAT, 1.0, 1.0)
            self.zero = engine.new_constant(KIND_FLOAT, 0.0, 0.0)
        violation = Violation(o, TOO_TIGHT, self.found_start, 0.0, [])
        violation.until = self.found_end
        violation.room = 1.0
        violation.limits = [INITIAL, MINIMUM]
        variables = [self.one, self.zero]
        inside = [
            k
            for k in range(self.count)
            if self.start[k] >= self.found_start and self.end[k] <= self.found_end and self.length[k] > 0
        ]
        inside.sort(key=self.length.__getitem__)
        spare = sum([self.length[k] for k in inside]) - (self.found_end - self.found_start)
        for k in inside:
            if self.length[k] < spare:  # it is overloaded without it
                spare -= self.length[k]
                continue
            t = self.token[k]
            v = self.rows.var0[t]
            violation.tokens.append(t)
            violation.charged.append((t, float(self.length[k])))
            violation.signs.append(-3)
            violation.note(4 * (v + DURATION) + SIDE_LOWER)
            variables += [v + OBJECT, self.one, v + START, v + END, v + DURATION]
        violation.amount = float(spare)
        engine.post_external(violation, variables, NONE, violation.tokens[0])
        return engine.propagate()
