"""Violation of a resource as a constraint: it fails, and can check itself again on other bounds for explanations."""

from collections.abc import Callable, Iterator
from math import inf
from typing import Any

from runtime.constraints.domains.bitset import has_value
from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import KIND_FLOAT
from runtime.constraints.propagators.external import External, argument, refuse
from runtime.plan.resources.profile import Profile
from runtime.plan.tags import AS_IT_IS, LIMITS, TOO_HIGH, TOO_LOW, TOO_TIGHT

_Step = tuple[int, float, float]  # set_capacity: from when on, between what


class Violation(External):
    """Arguments: the limits of a resource, then holder, quantity, start, end and duration (if any) of each use.

    `read` are the bounds (`v * 4 + side`) that make it certain, each with what would be `enough`; `uses` the rows that
    count; `edges` the order between them that does. `helper` is the sign of what would help if it were there, or 0.
    """

    def __init__(
        self, resource: int, wrong: int, at: int, amount: float, steps: list[tuple[int, float, float]]
    ) -> None:
        self.resource = resource
        self.wrong = wrong
        self.at = at
        self.amount = amount
        self.steps = steps
        self.limits: list[int] = []  # which limits of the row are among the arguments
        self.signs: list[int] = []  # -1 consumes, 1 produces; doubled where the use has an end, tripled with a duration
        self.read: list[int] = []
        self.enough: list[int] = []
        self.uses: list[int] = []
        self.tokens: list[int] = []  # or, of a timeline, the tokens
        self.edges: list[int] = []
        self.helper = 0
        self.until = at  # where the window ends that is too tight, and what must lie in it in part:
        self.parts: list[tuple[int, int, int, float]] = []  # start, end, least duration, least quantity
        self.limit_steps: list[_Step] = []  # set_limit: from when on, between what
        self.room = 0.0  # what there is of it, at once
        self.limit = 0.0  # the level that it falls short of, or exceeds
        self.charged: list[tuple[int, float]] = []  # tokens that use it there, and how much for certain
        self.table: Callable[[Any], Any] | None = None
        self.judge: Callable[[Any, Any], Any] | None = None

    def share(self, low: int, high: int, length: int) -> int:
        """How much time lies in the window of a use that may last from `low` to `high`."""
        return max(0, min(length, self.until - self.at, low + length - self.at, self.until - high + length))

    def note(self, key: int) -> None:
        """A bound counts as it is."""
        self.note_enough(key, AS_IT_IS)

    def note_enough(self, key: int, enough: int) -> None:
        """A bound counts that is as tight as `enough`."""
        self.read.append(key)
        self.enough.append(enough)

    def by_order(self, is_low: bool, at: int, table: Callable[[Any], Any], judge: Callable[[Any, Any], Any]) -> None:
        """Say that the order of uses makes it certain, which `judge` finds again from a new table of uses."""
        self.wrong = TOO_LOW if is_low else TOO_HIGH
        self.at = at
        self.table = table
        self.judge = judge

    def _uses_of(self, s: Store, c: int) -> Iterator[tuple[int, list[int]]]:
        """The sign of each use, and its variables."""
        position = len(self.limits)
        for sign in self.signs:
            yield sign, [argument(s, c, position + k) for k in range(2 + abs(sign))]
            position += 2 + abs(sign)

    def propagate(self, s: Store, c: int) -> bool:
        """Refuse if the level is certainly out of bounds."""
        if self.table is not None and self.judge is not None:
            return not self._is_out_by_order(s, c) or refuse(s, c)
        profile = Profile()
        bounds = [(0.0, 0.0), (-inf, -inf), (inf, inf), (inf, inf), (inf, inf), (inf, inf), (inf, inf)]
        for position, k in enumerate(self.limits):
            v = argument(s, c, position)
            bounds[k] = (s.flo[v], s.fhi[v])
        initial, minimum, maximum, rate, total, production_rate, production_total = bounds
        profile.set_limits(initial[0], initial[1], minimum[0], maximum[1])
        profile.limit_steps = self.limit_steps
        profile.set_flows(rate[1], total[1], production_rate[1], production_total[1])
        for sign, parts in self._uses_of(s, c):
            holder, quantity, start = parts[:3]
            end = parts[3] if len(parts) > 3 else start
            is_there = s.lb[holder] == self.resource == s.ub[holder]
            helps = sign > 0 if self.wrong == TOO_LOW else sign < 0 and self.wrong == TOO_HIGH
            if s.kind[quantity] != KIND_FLOAT or not (is_there or (helps and has_value(s, holder, self.resource))):
                continue
            i = profile.add(-1, -1 if sign < 0 else 1, len(parts) == 3)
            profile.start_low[i], profile.start_high[i] = s.lb[start], s.ub[start]
            profile.end_low[i], profile.end_high[i] = s.lb[end], s.ub[end]
            profile.least[i], profile.most[i] = s.flo[quantity], s.fhi[quantity]
            profile.length[i] = max(0, s.lb[end] - s.ub[start], s.lb[parts[4]] if len(parts) > 4 else 0)
        low, high = initial
        for at, lower, upper in self.steps:
            profile.add_step(at, low - upper, high - lower)
            low, high = lower, upper
        found = profile.overload() if self.wrong == TOO_TIGHT else profile.violation()
        return refuse(s, c) if found == self.wrong else True  # another one may be of what is not known here

    def _is_out_by_order(self, s: Store, c: int) -> bool:
        """Whether the order of the uses in `s` makes certain that the level is out of bounds."""
        assert self.table is not None and self.judge is not None
        table = self.table(s)
        limits = [-1] * LIMITS
        for position, k in enumerate(self.limits):
            limits[k] = argument(s, c, position)
        table.add_resource(self.resource, limits, -1)
        for at, lower, upper in self.steps:
            table.set_capacity(self.resource, at, lower, upper)
        for sign, parts in self._uses_of(s, c):
            holder, helps = parts[0], (sign > 0) == (self.wrong == TOO_LOW)
            if helps and s.lb[holder] != s.ub[holder] and has_value(s, holder, self.resource):
                return False  # it may help
            end = parts[3] if len(parts) > 3 else -1
            table.add_use(-1, 1 if sign > 0 else -1, holder, parts[1], parts[2], end, -1, 1)
        table.is_quiet()
        envelope = self.judge(s, table)
        return bool(envelope.find_certain(self.resource)) and bool(envelope.is_low == 0) == (self.wrong == TOO_LOW)
