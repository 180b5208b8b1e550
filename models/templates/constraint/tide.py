"""High water: when there is enough water over the sill of the harbour."""

from math import ceil, floor, inf

from runtime.user.constraint import Constraint, View

FIRST, PERIOD, HALF = 200, 745, 60  # ticks: the first high water, from one to the next, and how long before and after


class HighWater(Constraint):
    """`time` is at most HALF from a high water."""

    name = "high_water"
    signature = "time:number"
    meaning = "at this time there is enough water over the sill"

    def propagate(self, view: View) -> bool:
        """Move each bound to the nearest high water inside."""
        low, high = view.lower(0), view.upper(0)
        if low > -inf:
            tide = FIRST + PERIOD * ceil((low - FIRST - HALF) / PERIOD)  # the first that is not over
            if not view.raise_to(0, tide - HALF):
                return False
        if high < inf:
            tide = FIRST + PERIOD * floor((high - FIRST + HALF) / PERIOD)  # the last that has begun
            return view.reduce_to(0, tide + HALF)
        return True


CONSTRAINTS = [HighWater()]
