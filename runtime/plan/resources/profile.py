"""Profile of a resource: bounds on its level over time, from uses that are certain and uses that are possible.

Only the bounds of times count here; `envelope` also knows the order of uses.
"""

from math import inf

from runtime.constraints.domains.arrays import blank, lengthen
from runtime.constraints.domains.tags import FLOAT_TOLERANCE, HALF_INF
from runtime.plan.tags import TOO_FAST, TOO_HIGH, TOO_LOW, TOO_MUCH, TOO_TIGHT

_ROOM = 16
_MOST_WINDOWS = 64  # above so many uses only windows from the earliest start on are looked at


class Profile:
    """Uses of one resource as rows, with their bounds at one moment, and the limits of its level.

    `sign` is -1 for what consumes, +1 for what produces. What is `lasting` has no end: an event of a reservoir. Of
    limits that are variables the value that helps the plan most is taken.
    """

    def __init__(self) -> None:
        self.count = 0
        self.use = blank(_ROOM)
        self.sign = blank(_ROOM)
        self.lasting = blank(_ROOM)
        self.start_low = blank(_ROOM)
        self.start_high = blank(_ROOM)
        self.end_low = blank(_ROOM)
        self.end_high = blank(_ROOM)
        self.length = blank(_ROOM)  # how long a use lasts at least
        self.least = blank(_ROOM, "d")
        self.most = blank(_ROOM, "d")
        self.set_limits(0.0, 0.0, -inf, inf)
        self.set_flows(inf, inf, inf, inf)
        self.wrong = 0
        self.at = 0
        self.until = 0
        self.amount = 0.0

    def set_limits(self, initial_low: float, initial_high: float, minimum: float, maximum: float) -> None:
        """Fix the first level and its bounds, and forget all uses."""
        self.count = 0
        self.initial_low = initial_low
        self.initial_high = initial_high
        self.minimum = minimum
        self.maximum = maximum
        self.limit_steps: list[tuple[int, float, float]] = []

    def set_flows(self, rate: float, total: float, production_rate: float, production_total: float) -> None:
        """Fix how much may be consumed and produced at one instant, and altogether."""
        self.rate = rate
        self.total = total
        self.production_rate = production_rate
        self.production_total = production_total

    def add(self, use: int, sign: int, lasting: int) -> int:
        """Take a row for a use; its bounds are for the caller to fill in."""
        i = self.count
        if i == len(self.use):
            lengthen(self, "use sign lasting start_low start_high end_low end_high length least most")
        self.count = i + 1
        self.use[i] = use
        self.sign[i] = sign
        self.lasting[i] = lasting
        self.length[i] = 0
        return i

    def add_step(self, start: int, least: float, most: float) -> None:
        """Take away between `least` and `most` of the level for good, at a fixed time (negative: add)."""
        sign = -1 if most > 0 else 1
        i = self.add(-1, sign, 1)
        self.start_low[i] = start
        self.start_high[i] = start
        self.least[i] = max(least, 0.0) if sign < 0 else max(-most, 0.0)
        self.most[i] = most if sign < 0 else -least

    # ---- the level at an instant ----

    def best_for_consumers(self, t: int) -> float:
        """The highest level that `t` may have: only certain consumption, all possible production."""
        level = self.initial_high
        for i in range(self.count):
            if self.sign[i] < 0:
                if self.start_high[i] <= t and (self.lasting[i] or self.end_low[i] > t):
                    level -= self.least[i]
            elif self.start_low[i] <= t:
                level += self.most[i]
        return level

    def worst_for_consumers(self, t: int) -> float:
        """The lowest level that `t` may have."""
        level = self.initial_low
        for i in range(self.count):
            if self.sign[i] < 0:
                if self.start_low[i] <= t and (self.lasting[i] or self.end_high[i] > t):
                    level -= self.most[i]
            elif self.start_high[i] <= t:
                level += self.least[i]
        return level

    def grounded(self, t: int) -> float:
        """The level at `t` if all happens as early as it can."""
        level = self.initial_low
        for i in range(self.count):
            if self.start_low[i] <= t and (self.lasting[i] or self.end_low[i] > t):
                level += self.sign[i] * self.most[i]
        return level

    def flows_both_ways(self) -> bool:
        """Whether something is produced and something consumed for good."""
        signs = 0
        for i in range(self.count):
            if self.lasting[i]:
                signs |= 1 if self.sign[i] < 0 else 2
        return signs == 3

    # ---- what is certainly wrong ----

    def violation(self) -> int:
        """The violation that is certain (0: none); `at` and `amount` tell when and by how much."""
        self.wrong = self._flow_violation()
        if self.wrong == 0:
            self.wrong = self._level_violation()
        return self.wrong

    def _level_violation(self) -> int:
        """Whether the level is certainly out of bounds somewhere."""
        if self.limit_steps:
            return self._violation_of_steps()
        least_consumed = 0.0
        least_produced = 0.0
        for i in range(self.count):
            if self.sign[i] < 0:
                least_consumed += self.least[i]
            else:
                least_produced += self.least[i]
        if self.initial_high - least_consumed < self.minimum - FLOAT_TOLERANCE:
            is_anywhere = self.initial_high < self.minimum - FLOAT_TOLERANCE  # not only where something is consumed
            for i in range(self.count):
                if self.sign[i] < 0 or is_anywhere:
                    self.at = self.start_high[i]
                    self.amount = self.minimum - self.best_for_consumers(self.at)
                    if self.amount > FLOAT_TOLERANCE:
                        return TOO_LOW
        if self.initial_low + least_produced > self.maximum + FLOAT_TOLERANCE:
            is_anywhere = self.initial_low > self.maximum + FLOAT_TOLERANCE
            for i in range(self.count):
                if self.sign[i] > 0 or is_anywhere:
                    self.at = self.start_high[i]
                    self.amount = self.worst_for_consumers(self.at) - self.maximum
                    if self.amount > FLOAT_TOLERANCE:
                        return TOO_HIGH
        return 0

    def _violation_of_steps(self) -> int:
        """Whether the level is certainly out of bounds somewhere, where the bounds change over time (`limit_steps`)."""
        steps = self.limit_steps
        instants = {step[0] for step in steps}
        for i in range(self.count):
            instants.add(self.start_high[i])
        first_minimum = self.minimum
        first_maximum = self.maximum
        for t in sorted(instants):
            self.at = t
            self.minimum = first_minimum
            self.maximum = first_maximum
            for start, minimum, maximum in steps:
                if start <= t:
                    self.minimum = minimum
                    self.maximum = maximum
            self.amount = self.minimum - self.best_for_consumers(t)
            if self.amount > FLOAT_TOLERANCE:
                return TOO_LOW
            self.amount = self.worst_for_consumers(t) - self.maximum
            if self.amount > FLOAT_TOLERANCE:
                return TOO_HIGH
        self.minimum = first_minimum
        self.maximum = first_maximum
        return 0

    def _flow_violation(self) -> int:
        """Whether what flows at one instant, or altogether, is certainly too much."""
        if min(self.rate, self.total, self.production_rate, self.production_total) == inf:
            return 0
        consumed = 0.0
        produced = 0.0
        for i in range(self.count):
            self.at = self.start_high[i]
            flow = max(self.least[i], self._together(i))
            if self.sign[i] < 0:
                consumed += self.least[i]
                self.amount = flow - self.rate
            else:
                produced += self.least[i]
                self.amount = flow - self.production_rate
            if self.amount > FLOAT_TOLERANCE:
                return TOO_FAST
        self.amount = max(consumed - self.total, produced - self.production_total)
        return TOO_MUCH if self.amount > FLOAT_TOLERANCE else 0

    def _together(self, i: int) -> float:
        """What certainly flows at the same instant as use `i`, with it."""
        if self.start_low[i] != self.start_high[i]:
            return 0.0
        flow = 0.0
        for j in range(self.count):
            same = self.start_low[j] == self.start_low[i] and self.start_high[j] == self.start_low[i]
            if same and self.sign[j] == self.sign[i]:
                flow += self.least[j]
        return flow

    # ---- what cannot fit ----

    def overload(self) -> int:
        """Overload check: whether some window cannot hold the energy (use times time) that must lie in it.

        Energetic reasoning (Baptiste, Le Pape, Nuijten 2001) over windows from an earliest start to a latest end;
        `at` and `until` tell which. Only for uses that give back; O(n^3), O(n^2) above MOST_WINDOWS uses.
        """
        room = self.initial_high - self.minimum
        if room == inf:
            return 0
        first = HALF_INF
        last = -HALF_INF
        for i in range(self.count):
            if self.lasting[i] or self.sign[i] > 0:
                return 0
            first = min(first, self.start_low[i])
            last = max(last, self.end_high[i])
        if self._is_overloaded(first, last, room):  # the widest window has the simplest reasons
            return TOO_TIGHT
        for i in range(self.count):
            start = self.start_low[i]
            if start <= -HALF_INF or (self.count > _MOST_WINDOWS and start > first):
                continue
            for j in range(self.count):
                end = self.end_high[j]
                if self._is_overloaded(start, end, room):
                    return TOO_TIGHT
            if self.count > _MOST_WINDOWS:
                break
        return 0

    def _is_overloaded(self, start: int, end: int, room: float) -> bool:
        """Whether more must lie in a window than it holds."""
        if start <= -HALF_INF or end >= HALF_INF or start >= end:
            return False
        amount = -room * (end - start)
        for k in range(self.count):
            if self.least[k] > 0.0:  # in a scratch engine it may be without a bound
                amount += self.least[k] * self.share(k, start, end)
        if amount <= FLOAT_TOLERANCE:
            return False
        self.at = start
        self.until = end
        self.wrong = TOO_TIGHT
        self.amount = amount
        return True

    def share(self, k: int, start: int, end: int) -> int:
        """How much time of use `k` lies in a window, however it is shifted."""
        early = self.start_low[k] + self.length[k] - start
        late = end - self.end_high[k] + self.length[k]
        return max(0, min(self.length[k], end - start, early, late))
