"""A constraint that refuses a resource certainly exceeded: it finds the excess again from the bounds it stands on."""

from math import inf

from runtime.constraints.codes import KIND_FLOAT
from runtime.constraints.external import External, argument, refuse
from runtime.constraints.store import Store
from runtime.plan.levels import Levels

Step = tuple[int, float, float]  # set_capacity: from when on, between what


class Excess(External):
    """The limits of a resource first, then holder, quantity, start and end (if any) of each use, are its arguments."""

    def __init__(
        self, resource: int, wrong: int, at: int, amount: float, steps: list[tuple[int, float, float]]
    ) -> None:
        self.resource = resource
        self.wrong = wrong
        self.at = at
        self.amount = amount
        self.steps = steps
        self.limits: list[int] = []  # which limits of the row are among the arguments
        self.signs: list[int] = []  # -1 consumes, 1 produces; doubled where the use has an end

    def propagate(self, s: Store, c: int) -> bool:
        """Refuse if the level is certainly out of bounds."""
        levels = Levels()
        place = 0
        bounds = [(0.0, 0.0), (-inf, -inf), (inf, inf), (inf, inf), (inf, inf), (inf, inf), (inf, inf)]
        for k in self.limits:
            v = argument(s, c, place)
            bounds[k] = (s.flo[v], s.fhi[v])
            place += 1
        initial, minimum, maximum, rate, total, production_rate, production_total = bounds
        levels.set_limits(initial[0], initial[1], minimum[0], maximum[1])
        levels.set_flows(rate[1], total[1], production_rate[1], production_total[1])
        for sign in self.signs:
            holder, quantity, start = (argument(s, c, place + k) for k in range(3))
            place += 3
            has_end = sign in (-2, 2)
            end = argument(s, c, place) if has_end else start
            place += has_end
            if s.lb[holder] != self.resource or s.ub[holder] != self.resource or s.kind[quantity] != KIND_FLOAT:
                continue
            i = levels.add(-1, -1 if sign < 0 else 1, not has_end)
            levels.start_low[i], levels.start_high[i] = s.lb[start], s.ub[start]
            levels.end_low[i], levels.end_high[i] = s.lb[end], s.ub[end]
            levels.least[i], levels.most[i] = s.flo[quantity], s.fhi[quantity]
        low, high = initial
        for at, lower, upper in self.steps:
            levels.add_step(at, low - upper, high - lower)
            low, high = lower, upper
        return refuse(s, c) if levels.violation() else True
