"""Uses of resources: rows of a table, and the check that posts a violation where a resource is certainly exceeded.

A use is charged from `start` to `end` (Reusable, Unary, CBReusable), or once at `start` (`produce`, `consume`). Bounds
are compared with those of the last check, so that going back in time needs no notice.
"""

from math import inf
from operator import itemgetter

from runtime.constraints.domains.arrays import blank, grow_rows, lengthen
from runtime.constraints.domains.tags import SIDE_LOWER, SIDE_UPPER
from runtime.constraints.engine import Engine
from runtime.plan.resources.profile import Profile
from runtime.plan.resources.protocols import OpenRelief, UseOrder
from runtime.plan.resources.violation import Violation
from runtime.plan.tags import (
    INITIAL,
    LIMITS,
    MAXIMUM,
    MINIMUM,
    NONE,
    PRODUCTION_RATE,
    PRODUCTION_TOTAL,
    RATE,
    TOO_HIGH,
    TOO_LOW,
    TOO_TIGHT,
    TOTAL,
)

_ROOM = 32


class Resources:
    """Uses `u` as rows of numbers; resources are named by their object."""

    def __init__(self, engine: Engine) -> None:
        self.engine = engine
        self.profile = Profile()
        self.count = 0
        self.free: list[int] = []
        self.token = blank(_ROOM)
        self.sign = blank(_ROOM)
        self.holder = blank(_ROOM)
        self.quantity = blank(_ROOM)
        self.start = blank(_ROOM)
        self.end = blank(_ROOM)
        self.duration = blank(_ROOM)
        self.on = blank(_ROOM)
        self.start_low = blank(_ROOM)
        self.start_high = blank(_ROOM)
        self.end_low = blank(_ROOM)
        self.end_high = blank(_ROOM)
        self.least = blank(_ROOM, "d")
        self.most = blank(_ROOM, "d")
        # Resources: the variables of their limits, and whether one of their uses has changed.
        self.is_resource = blank(_ROOM)
        self.is_energetic = blank(_ROOM)  # also refuse what cannot fit into a window
        self.profile_choice = blank(_ROOM)  # the variable that chooses how levels are computed
        self.grounded_text = NONE
        self.changed = blank(_ROOM)
        self.limits = blank(_ROOM * LIMITS)
        self.steps: dict[int, list[tuple[int, float, float]]] = {}  # set_capacity: from when on, between what
        self.limit_steps: dict[int, list[tuple[int, float, float]]] = {}  # set_limit: the same of the level
        self.pending = 0
        self.refusals: list[int] = []
        # A search may postpone the judgement of a level while there may be relief; it is then repeated at each check.
        self.relief: OpenRelief | None = None
        self.postponed: list[int] = []

    # ---- resources and uses ----

    def add_resource(self, o: int, limits: list[int], profile_choice: int) -> None:
        """Make object `o` a resource with the variables of its limits (NONE: not limited)."""
        if o >= len(self.is_resource):
            lengthen(self, "is_resource is_energetic profile_choice changed", need=o + 1)
            grow_rows(self, "limits", len(self.is_resource) * LIMITS)
        self.is_resource[o] = 1
        self.profile_choice[o] = profile_choice
        for k in range(LIMITS):
            self.limits[o * LIMITS + k] = limits[k]

    def is_grounded(self, o: int) -> bool:
        """Whether levels are those of the earliest schedule: the resource asks for a "GroundedProfile"."""
        v = self.profile_choice[o]
        return v >= 0 and self.engine.lb[v] == self.grounded_text and self.engine.ub[v] == self.grounded_text

    def add_use(
        self, token: int, sign: int, holder: int, quantity: int, start: int, end: int, duration: int, level: int
    ) -> int:
        """Charge a resource from now on; what has no end (NONE) changes the level for good. The number of the use.

        `duration` is the variable between start and end, NONE where there is none.
        """
        if self.free and level == 0:
            u = self.free.pop()
        else:
            if self.count == len(self.token):
                lengthen(self, "token sign holder quantity start end duration on least most")
                grow_rows(self, "start_low start_high end_low end_high", len(self.token))
            u = self.count
            self.count += 1
        self.token[u] = token
        self.sign[u] = sign
        self.holder[u] = holder
        self.quantity[u] = quantity
        self.start[u] = start
        self.end[u] = end
        self.duration[u] = duration
        self.on[u] = NONE
        return u

    def remove_use(self, u: int) -> None:
        """Forget a use (level 0)."""
        if self.on[u] >= 0:
            self.changed[self.on[u]] = 1
            self.pending = 1
        self.sign[u] = 0
        self.free.append(u)

    def remove_token(self, t: int) -> None:
        """Forget the use that is token `t` (level 0)."""
        for u in range(self.count):
            if self.sign[u] and self.token[u] == t:
                self.remove_use(u)

    def truncate(self, count: int) -> None:
        """Forget the uses that a search has added."""
        self.count = count

    def set_capacity(self, o: int, start: int, lower: float, upper: float) -> None:
        """Change the capacity from a time on."""
        self.steps.setdefault(o, []).append((start, lower, upper))
        self.changed[o] = 1
        self.pending = 1

    def set_limit(self, o: int, start: int, lower: float, upper: float) -> None:
        """Change the bounds of the level from a time on; those of one time keep the order of the script."""
        self.limit_steps[o] = sorted([*self.limit_steps.get(o, ()), (start, lower, upper)], key=itemgetter(0))
        self.changed[o] = 1
        self.pending = 1

    # ---- checking ----

    def is_quiet(self) -> bool:
        """Whether no use has changed since the last check."""
        engine = self.engine
        for u in range(self.count):
            if not self.sign[u]:
                continue
            holder = self.holder[u]
            o = engine.lb[holder] if engine.lb[holder] == engine.ub[holder] else NONE
            start = self.start[u]
            end = self.end[u]
            q = self.quantity[u]
            if (
                o != self.on[u]
                or engine.lb[start] != self.start_low[u]
                or engine.ub[start] != self.start_high[u]
                or engine.flo[q] != self.least[u]
                or engine.fhi[q] != self.most[u]
                or (end >= 0 and (engine.lb[end] != self.end_low[u] or engine.ub[end] != self.end_high[u]))
            ):
                if self.on[u] >= 0:
                    self.changed[self.on[u]] = 1
                self.on[u] = o
                self.start_low[u] = engine.lb[start]
                self.start_high[u] = engine.ub[start]
                if end >= 0:
                    self.end_low[u] = engine.lb[end]
                    self.end_high[u] = engine.ub[end]
                self.least[u] = engine.flo[q]
                self.most[u] = engine.fhi[q]
                if o >= 0 and self.is_resource[o]:
                    self.changed[o] = 1
                    self.pending = 1
        return not self.pending

    def check(self, envelope: "UseOrder", level: int) -> bool:
        """Refuse what certainly exceeds a resource; False if something does."""
        self.pending = 0
        for o in range(len(self.is_resource)):
            if self.changed[o] and self.is_resource[o]:
                self.changed[o] = 0
                self.fill(self.profile, o)
                by_order = False
                if not self.profile.violation():
                    by_order = o not in self.limit_steps and self.profile.flows_both_ways() and envelope.find_certain(o)
                    is_tight = not by_order and self.is_energetic[o] != 0 and o not in self.steps
                    is_tight = is_tight and o not in self.limit_steps
                    is_tight = is_tight and self.profile.overload() != 0
                    if not by_order and not is_tight:
                        continue
                if self.relief is not None and self._may_wait(o, 1 - envelope.is_low if by_order else NONE):
                    continue
                self.changed[o] = 1
                return self.refuse(o, level, envelope if by_order else None)
        return True

    def _may_wait(self, o: int, is_low: int) -> bool:
        """Whether the level of `o` is judged later, as something may relieve it; `is_low` NONE: the profile tells."""
        wrong = self.profile.wrong
        if is_low == NONE and wrong != TOO_LOW and wrong != TOO_HIGH:
            return False
        is_low = (1 if wrong == TOO_LOW else 0) if is_low == NONE else is_low
        assert self.relief is not None
        if not self.relief.may_come(o, 1 if is_low else -1):
            return False
        if o not in self.postponed:
            self.postponed.append(o)
        return True

    def resume(self) -> None:
        """Judge again what was postponed."""
        for o in self.postponed:
            self.changed[o] = 1
        self.pending = 1

    def take_refusals(self) -> list[int]:
        """Give up the constraints that refused at level 0, as the reason may go."""
        taken = self.refusals
        self.refusals = []
        if taken:
            self.pending = 1
        return taken

    def fill(self, profile: Profile, o: int) -> None:
        """Put the uses and limits of a resource into `profile`."""
        at = o * LIMITS
        low = self.lower(at + INITIAL, 0.0)
        high = self.upper(at + INITIAL, 0.0)
        profile.set_limits(low, high, self.lower(at + MINIMUM, -inf), self.upper(at + MAXIMUM, inf))
        profile.limit_steps = self.limit_steps.get(o, [])
        profile.rate = self.upper(at + RATE, inf)
        profile.total = self.upper(at + TOTAL, inf)
        profile.production_rate = self.upper(at + PRODUCTION_RATE, inf)
        profile.production_total = self.upper(at + PRODUCTION_TOTAL, inf)
        for u in range(self.count):
            if self.sign[u] and self.on[u] == o:
                i = profile.add(u, self.sign[u], self.end[u] < 0)
                profile.start_low[i] = self.start_low[u]
                profile.start_high[i] = self.start_high[u]
                profile.end_low[i] = self.end_low[u]
                profile.end_high[i] = self.end_high[u]
                profile.least[i] = self.least[u]
                profile.most[i] = self.most[u]
                if self.end[u] >= 0:
                    profile.length[i] = max(0, self.end_low[u] - self.start_high[u])
                if self.duration[u] >= 0:
                    profile.length[i] = max(profile.length[i], self.engine.lb[self.duration[u]])
        for start, lower, upper in self.steps.get(o, ()):
            profile.add_step(start, low - upper, high - lower)
            low, high = lower, upper

    def lower(self, row: int, otherwise: float) -> float:
        """The lower bound of a limit."""
        return otherwise if self.limits[row] < 0 else self.engine.flo[self.limits[row]]

    def upper(self, row: int, otherwise: float) -> float:
        """The upper bound of a limit."""
        return otherwise if self.limits[row] < 0 else self.engine.fhi[self.limits[row]]

    def set_energetic(self, o: int, is_energetic: bool) -> None:
        """Have resource `o` refuse what cannot fit into a window, or no longer."""
        if o < len(self.is_resource) and self.is_energetic[o] != is_energetic:
            self.is_energetic[o] = is_energetic
            self.changed[o] = 1
            self.pending = 1

    def refuse(self, o: int, level: int, envelope: "UseOrder | None") -> bool:
        """Post a constraint on the uses that exceed a resource: it finds the same, so that the engine can explain it.

        With an envelope the order of uses made it certain.
        """
        profile = self.profile
        violation = Violation(o, profile.wrong, profile.at, profile.amount, list(self.steps.get(o, ())))
        violation.limit_steps = self.limit_steps.get(o, [])
        violation.room = profile.initial_high - profile.minimum
        violation.limit = profile.maximum if profile.wrong == TOO_HIGH else profile.minimum
        if envelope is not None:
            violation.limit = profile.minimum if envelope.is_low == 0 else profile.maximum
            violation.by_order(envelope.is_low == 0, envelope.at, Resources, type(envelope))
            bounds: list[int] = []
            envelope.note_orders(violation.edges, bounds)
            for key in bounds:
                violation.note(key)
        variables: list[int] = []
        for k in range(LIMITS):
            if self.limits[o * LIMITS + k] >= 0:
                violation.limits.append(k)
                variables.append(self.limits[o * LIMITS + k])
        for v in variables:
            violation.note(4 * v + SIDE_LOWER)
            violation.note(4 * v + SIDE_UPPER)
        span_owner = NONE
        for i in range(profile.count):
            u = profile.use[i]
            if u >= 0 and self._note_read(violation, i, u, envelope is not None):
                violation.uses.append(u)
                sign = self.sign[u] * (1 if self.end[u] < 0 else 2 if self.duration[u] < 0 else 3)
                violation.signs.append(sign)
                variables += [self.holder[u], self.quantity[u], self.start[u]]
                if self.end[u] >= 0:
                    variables.append(self.end[u])
                    if self.duration[u] >= 0:
                        variables.append(self.duration[u])
                span_owner = self.token[u]
        c = self.engine.post_external(violation, variables, NONE, span_owner)
        if level == 0:
            self.refusals.append(c)
        return self.engine.propagate()

    def _note_read(self, violation: Violation, i: int, u: int, by_order: bool) -> bool:
        """Note which bounds of use `u`, row `i` of the profile, count for a violation; False if none does."""
        profile = self.profile
        start = 4 * self.start[u]
        end = 4 * self.end[u]
        quantity = 4 * self.quantity[u]
        t = violation.at
        if violation.wrong == TOO_TIGHT:
            share = profile.share(i, profile.at, profile.until)
            if share == 0:
                return False
            violation.charged.append((self.token[u], profile.least[i] * share))
            violation.until = profile.until
            violation.note(quantity + SIDE_LOWER)
            if self.duration[u] >= 0:
                violation.note(4 * self.duration[u] + SIDE_LOWER)
                violation.parts.append((self.start[u], self.end[u], profile.length[i], profile.least[i]))
            else:
                for side in (SIDE_LOWER, SIDE_UPPER):
                    violation.note(start + side)
                    violation.note(end + side)
        elif violation.wrong == TOO_LOW or violation.wrong == TOO_HIGH:
            harms = -1 if violation.wrong == TOO_LOW else 1
            if self.end[u] < 0:
                violation.helper = -harms
            if self.sign[u] == harms:
                is_certain = profile.start_high[i] <= t and (self.end[u] < 0 or profile.end_low[i] > t)
                if is_certain:
                    violation.note_enough(start + SIDE_UPPER, t)
                    if self.end[u] >= 0:
                        violation.note_enough(end + SIDE_LOWER, t + 1)
                elif not by_order:
                    return False
                violation.charged.append((self.token[u], profile.least[i]))
                violation.note(quantity + SIDE_LOWER)
            elif profile.start_low[i] > t:
                violation.note_enough(start + SIDE_LOWER, t + 1)
            elif self.end[u] >= 0 and profile.end_high[i] <= t:
                violation.note_enough(end + SIDE_UPPER, t)
            else:
                violation.note(quantity + SIDE_UPPER)
        else:
            violation.charged.append((self.token[u], profile.least[i]))
            for key in (start, end, quantity):
                if key >= 0:
                    violation.note(key + SIDE_LOWER)
                    violation.note(key + SIDE_UPPER)
        return True
