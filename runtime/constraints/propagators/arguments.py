"""Arguments of one constraint as intervals, by index: what relations read and narrow."""

import math
from math import inf

from runtime.constraints.domains.narrow import high, low
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import FLOAT_TOLERANCE, KIND_FLOAT
from runtime.constraints.propagators.external import argument, at_least, at_most, never, refuse
from runtime.constraints.propagators.intervals import Interval

_MOST_TURNS = 3


def tolerant(x: Interval) -> Interval:
    """Widen by the tolerance of values."""
    return x[0] - FLOAT_TOLERANCE, x[1] + FLOAT_TOLERANCE


class Arguments:
    """The arguments of constraint `c`; whatever narrows them returns false on a conflict."""

    def __init__(self, s: Store, c: int) -> None:
        self.s = s
        self.c = c

    def bounds(self, k: int) -> Interval:
        """Give the bounds of an argument."""
        v = argument(self.s, self.c, k)
        return low(self.s, v), high(self.s, v)

    def is_whole(self, k: int) -> bool:
        """Tell whether an argument takes whole numbers only."""
        return bool(self.s.kind[argument(self.s, self.c, k)] != KIND_FLOAT)

    def keep(self, k: int, lo: float, hi: float) -> bool:
        """Narrow an argument to an interval, give or take the tolerance."""
        v = argument(self.s, self.c, k)
        return at_least(self.s, self.c, v, lo - FLOAT_TOLERANCE) and at_most(self.s, self.c, v, hi + FLOAT_TOLERANCE)

    def keep_away(self, k: int, least: float) -> bool:
        """Narrow an argument to what is at least so far from 0, where its sign is known."""
        lo, hi = self.bounds(k)
        if lo > -least and not self.keep(k, least, inf):
            return False
        return hi >= least or self.keep(k, -inf, -least)

    def refuse(self) -> bool:
        """Say that it cannot hold; always false."""
        return refuse(self.s, self.c)

    def keep_off_zero(self, k: int) -> bool:
        """Take 0 from an argument."""
        if self.is_whole(k):
            return never(self.s, self.c, argument(self.s, self.c, k), 0)
        return self.bounds(k) != (0.0, 0.0) or self.refuse()

    def keep_in_turns(self, k: int, arcs: list[Interval]) -> bool:
        """Narrow an argument in degrees to some arcs, give or take whole turns."""
        if self.is_whole(k):
            arcs = [(math.ceil(lo), math.floor(hi)) for lo, hi in arcs if math.ceil(lo) <= math.floor(hi)]
        if not arcs:
            return self.refuse()
        lo, hi = self.bounds(k)
        if not hi - lo < 360.0 * _MOST_TURNS:
            return True
        first, last = math.floor(lo / 360.0) - 2, math.ceil(hi / 360.0) + 2
        moved = [(a + 360.0 * n, b + 360.0 * n) for a, b in arcs for n in range(first, last + 1)]
        met = [(a, b) for a, b in moved if a <= hi + FLOAT_TOLERANCE and b >= lo - FLOAT_TOLERANCE]
        return self.keep(k, min(a for a, _ in met), max(b for _, b in met)) if met else self.refuse()

    def keep_whole(self, k: int) -> bool:
        """Narrow an argument whose values are whole numbers, whatever its kind."""
        lo, hi = self.bounds(k)
        if lo > -inf and not self.keep(k, math.ceil(lo - FLOAT_TOLERANCE), inf):
            return False
        return hi == inf or self.keep(k, -inf, math.floor(hi + FLOAT_TOLERANCE))
