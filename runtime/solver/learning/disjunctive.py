"""Refuse tokens of one timeline that cannot lie one after the other in the time there is for them.

What counts is who has a place there, and who must get one: active tokens on that timeline and no other, which the
horizon does not keep back, nor will. Checked is every window from an earliest start to a latest end.
"""

from array import array

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
from runtime.solver.flaws.agenda import Queues
from runtime.solver.tags import FILTER_HORIZON, NONE, POLICY_PARTIAL, THREAT
from runtime.solver.widening import widened

PRIME = 1_000_000_007
MOST_STARTS = 64  # with more tokens only windows from the earliest start are looked at


class Crowds:
    """The tokens of one timeline after another, by latest end, over arrays that are used again."""

    def __init__(self, queues: Queues) -> None:
        self.queues = queues
        self.rows = queues.rows
        self.engine = queues.engine
        self.one = NONE
        self.zero = NONE
        self.room = 64
        self.count = 0
        self.token = array("q", [0]) * 64
        self.start = array("q", [0]) * 64
        self.end = array("q", [0]) * 64
        self.length = array("q", [0]) * 64
        self.known = array("q", [0]) * 64  # by object: a sum over what was there when it was last looked at
        self.stamp = 0
        self.stamped = array("q", [0]) * 64
        self.found_start = 0
        self.found_end = 0

    def fit(self) -> bool:
        """Whether all fit, as far as windows tell; if not, the engine has a conflict."""
        q = self.queues
        if q.filters.has_scope:
            return True  # what a scope keeps back now it may admit later, and the other way round
        if len(self.known) < q.plan.object_count:
            self.known = widened(self.known, 2 * q.plan.object_count, 0)
            self.stamped = widened(self.stamped, 2 * q.plan.object_count, 0)
        self.stamp += 1
        t = self.rows.head_first[HEAD_THREAT]
        while t >= 0:
            o = self.engine.lb[self.rows.var0[t] + OBJECT]
            if self.is_waiting_for(t, o) and self.stamped[o] != self.stamp:
                self.stamped[o] = self.stamp
                if not self.fit_on(o):
                    return False
            t = self.rows.link_after[LISTS * t + LIST_THREAT]
        return True

    def is_waiting_for(self, t: int, o: int) -> bool:
        """Whether an active token without a place must get one on timeline `o`."""
        return (
            self.engine.ub[self.rows.var0[t] + OBJECT] == o
            and self.queues.plan.object_timeline[o] != 0
            and self.must_be_ordered(t)
        )

    def must_be_ordered(self, t: int) -> bool:
        """Whether a manager orders token `t`, and no filter keeps it back or can do so later."""
        q = self.queues
        treatments = q.treatments
        for manager in range(q.managers):
            row = q.token_row[t * q.managers + manager]
            if treatments.manager_kind[manager] != THREAT or row < 0 or treatments.heap_of[row] < 0:
                continue
            is_plain = not q.filters.keeps_token(row, t)
            first = treatments.filter_first[row]
            for f in range(first, first + treatments.filter_count[row]):
                if treatments.filter_code[f] != FILTER_HORIZON or treatments.filter_policy[f] != POLICY_PARTIAL:
                    is_plain = False
            if is_plain:
                return True
        return False

    def fit_on(self, o: int) -> bool:
        """Whether the tokens of timeline `o` fit."""
        self.count = 0
        t = self.rows.head_first[self.queues.plan.object_head[o]]
        while t >= 0:
            if self.queues.order_level[t] == 0 or self.must_be_ordered(t):
                self.add(t)
            t = self.rows.link_after[LISTS * t + LIST_ORDER]
        t = self.rows.head_first[HEAD_THREAT]
        while t >= 0:
            if self.engine.lb[self.rows.var0[t] + OBJECT] == o and self.is_waiting_for(t, o):
                self.add(t)
            t = self.rows.link_after[LISTS * t + LIST_THREAT]
        total = self.sum()
        if total == self.known[o]:
            return True
        if self.find_window():
            return self.refuse(o)
        self.known[o] = total
        return True

    def add(self, t: int) -> int:
        """Put a token where its latest end belongs."""
        if self.count == self.room:
            self.room *= 2
            self.token = widened(self.token, self.room, 0)
            self.start = widened(self.start, self.room, 0)
            self.end = widened(self.end, self.room, 0)
            self.length = widened(self.length, self.room, 0)
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
        return 0

    def sum(self) -> int:
        """A number that tells what is gathered from most else."""
        total = 1
        for k in range(self.count):
            total = (total * 31 + self.start[k]) % PRIME
            total = (total * 31 + self.end[k]) % PRIME
            total = (total * 31 + self.length[k]) % PRIME
        return total

    def find_window(self) -> bool:
        """Whether some window is too narrow for the tokens that must lie in it; the one that lacks most is found."""
        first = HALF_INF
        for k in range(self.count):
            first = min(first, self.start[k])
        most = 0
        for i in range(self.count):
            start = self.start[i]
            if start <= -HALF_INF or (self.count > MOST_STARTS and start > first):
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

    def refuse(self, o: int) -> bool:
        """Post a constraint on the tokens in the window that finds the same, so that the engine can explain it."""
        engine = self.engine
        if self.one < 0:
            self.one = engine.new_constant(KIND_FLOAT, 1.0, 1.0)
            self.zero = engine.new_constant(KIND_FLOAT, 0.0, 0.0)
        excess = Violation(o, TOO_TIGHT, self.found_start, 0.0, [])
        excess.until = self.found_end
        excess.room = 1.0
        excess.limits = [INITIAL, MINIMUM]
        variables = [self.one, self.zero]
        inside = [
            k
            for k in range(self.count)
            if self.start[k] >= self.found_start and self.end[k] <= self.found_end and self.length[k] > 0
        ]
        inside.sort(key=self.length.__getitem__)
        spare = sum([self.length[k] for k in inside]) - (self.found_end - self.found_start)
        for k in inside:
            if self.length[k] < spare:  # the longest ones are too long without it
                spare -= self.length[k]
                continue
            t = self.token[k]
            v = self.rows.var0[t]
            excess.tokens.append(t)
            excess.charged.append((t, float(self.length[k])))
            excess.signs.append(-3)
            excess.note(4 * (v + DURATION) + SIDE_LOWER)
            variables += [v + OBJECT, self.one, v + START, v + END, v + DURATION]
        excess.amount = float(spare)
        engine.post_external(excess, variables, NONE, excess.tokens[0])
        return engine.propagate()
