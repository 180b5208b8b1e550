"""A structure in, its times and values as functions of the sampled values out: what the executive makes of a draw.

A line that is an equation gives a value. Where no equation does, the executive has decided, and the flight shows how:
a token lasts as long as the line lets it that was used up, it starts as long after what it waited for as it did in the
flight (the time to ask for it), or when the mission file says so. Whether these decisions hold for other values, too,
is not assumed: every demand is a condition on the sampled values in the end.
"""

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, field
from math import floor

import z3

from checker.proofs.claims import Claim, Number
from checker.proofs.demands import Demand
from checker.proofs.operands import name_of, rational, variables_of
from checker.proofs.solving import fraction, simplified, solved
from checker.proofs.structure import Structure

_EQUALITIES = ("eq", "concurrent")


@dataclass(frozen=True, eq=False, slots=True)
class Requirement:
    """A demand as a claim about sampled values alone (and constants that are free)."""

    demand: Demand
    claim: Claim


@dataclass(frozen=True, eq=False, slots=True)
class Dated:
    """A structure whose variables are known; `open` counts demands on what the flight did not decide."""

    conditions: tuple[Requirement, ...]
    open: int
    lags: int  # times that follow something as they did in the flight
    known: Mapping[str, Number] = field(default_factory=dict)  # variables over sampled values
    flown: frozenset[str] = frozenset()  # those of them that rest on what the executive decided in the flight


def dated(structure: Structure, freed: frozenset[str] = frozenset()) -> Dated:
    """The conditions of a structure; lines that set a variable in `freed` are left out, it stays free."""
    return _Dating(structure, freed).run()


@dataclass(eq=False, slots=True)
class _Dating:
    structure: Structure
    freed: frozenset[str]
    known: dict[str, Number] = field(default_factory=dict)
    touching: dict[str, list[Demand]] = field(default_factory=dict)
    waiting: deque[Demand] = field(default_factory=deque)
    names: dict[Demand, tuple[str, ...]] = field(default_factory=dict)  # of the variables, empty for other numbers
    sources: set[Demand] = field(default_factory=set)  # equations that gave a value
    divisors: list[tuple[Demand, Number]] = field(default_factory=list)
    limits: dict[str, tuple[str, str, list[Demand]]] = field(default_factory=dict)  # of ends that a line sets
    lags: int = 0
    flown: set[str] = field(default_factory=set)

    def run(self) -> Dated:
        known = {id(variable): name for name, variable in self.structure.variables.items()}
        for demand in self.structure.demands:
            self.names[demand] = tuple(known.get(id(each)) or name_of(each) for each in demand.numbers)
            for name in self.names[demand]:
                if name:
                    self.touching.setdefault(name, []).append(demand)
        for start, end, length in self.structure.times:
            found = [
                each for each in self.touching.get(length, ()) if each.name == "leq" and self.names[each][0] == length
            ]
            if end and found:
                self.limits[end] = (start, length, found)
        for name in self.freed:
            self._know(name, self.structure.variables[name])
        self.waiting.extend(self.structure.demands)
        self._propagate()
        self._use_up()
        waiting = [
            (value, rank, name)
            for start, end, _ in self.structure.times
            for rank, name in ((0, start), (1, end))
            if isinstance(value := self.structure.values.get(name), int)
        ]
        while waiting := [each for each in waiting if each[2] not in self.known]:
            _, rank, name = min(waiting, key=lambda each: (each[0], self._rank(each[2], each[1]), each[2]))
            self._decide(name, is_end=bool(rank))
            self._propagate()
            self._use_up()
        for name, variable in self.structure.variables.items():
            if name not in self.known and (value := self._constant(name, variable)) is not None:
                self.flown.add(name)
                self._know(name, value)
                self._propagate()
        return self._conditions()

    # ---- equations ----

    def _know(self, name: str, value: Number) -> None:
        self.known[name] = simplified(value)
        self.waiting.extend(self.touching.get(name, ()))

    def _propagate(self) -> None:
        while self.waiting:
            demand = self.waiting.popleft()
            if not demand.name or demand.name == "gap" or self._sets_freed(demand):
                continue
            names = self.names[demand]
            unknown = [k for k, name in enumerate(names) if name and not self._is_known(name)]
            if len(unknown) != 1 or names.count(names[unknown[0]]) > 1:
                continue
            index = unknown[0]
            numbers = [self._value(name, each) for name, each in zip(names, demand.numbers, strict=True)]
            value = solved(demand.name, index, numbers, demand.numbers[index])
            if value is not None:
                self.sources.add(demand)
                if demand.name == "mulEq" and index < 2:
                    self.divisors.append((demand, numbers[1 - index]))
                if not self.flown.isdisjoint(names):
                    self.flown.add(names[index])
                self._know(names[index], value)

    def _is_known(self, name: str) -> bool:
        return name in self.known or name.startswith("sampled ")

    def _sets_freed(self, demand: Demand) -> bool:
        return bool(self.freed) and demand.token == "" and any(name in self.freed for name in self.names[demand])

    def _value(self, name: str, number: Number) -> Number:
        """A number with what is known in place of its variable."""
        return self.known.get(name, number)

    # ---- decisions ----

    def _rank(self, name: str, rank: int) -> int:
        """What is decided first at one tick: goals, then starts of which all is known, then the rest."""
        if self.structure.earliest.get(name) == self.structure.values[name]:
            return 0
        before = (
            self.names[each][0]
            for each in self.touching.get(name, ())
            if each.name == "gap" and each.numbers[2] is not None
        )
        return 3 if rank else 1 if all(not each or each == name or self._is_known(each) for each in before) else 2

    def _use_up(self) -> None:
        """Tokens that have begun last as long as a line lets them."""
        is_new = True
        while is_new:
            is_new = False
            for end in self.limits:
                if end not in self.known and (found := self._longest(end)) is not None:
                    self.flown.add(end)  # that the line was used up
                    self._know(end, found)
                    self._propagate()
                    is_new = True

    def _decide(self, name: str, *, is_end: bool) -> None:
        variable = self.structure.variables[name]
        found = None if is_end else self._earliest(name)
        if found is None:
            found = self._latest_event(name)
        if found is None:
            found = z3.IntVal(int(self._flown(name)))
        else:
            self.lags += 1
        assert z3.is_int(variable)
        self.flown.add(name)
        self._know(name, found)

    def _flown(self, name: str) -> float:
        value = self.structure.values[name]
        assert isinstance(value, int | float)
        return value

    def _longest(self, name: str) -> Number | None:
        """The end that a used-up limit of the duration gives."""
        start, length, limits = self.limits[name]
        if start not in self.known:
            return None
        for demand in limits:
            second = self.names[demand][1]
            if second and not self._is_known(second):
                continue
            most = self._value(second, demand.numbers[1])
            flown = self._at_flight(second, demand.numbers[1])
            if flown is not None and floor(flown) == self._flown(length):
                return self.known[start] + (most if z3.is_int(most) else z3.ToInt(most))
        return None

    def _earliest(self, name: str) -> Number | None:
        """The start that follows what it waited for, or what the mission file says."""
        flown = int(self._flown(name))
        if self.structure.earliest.get(name) == flown:
            return z3.IntVal(flown)
        best: tuple[int, Number] | None = None
        for demand in self.touching.get(name, ()):
            first, second = self.names[demand][:2] if demand.name == "gap" else ("", "")
            if second != name or demand.numbers[2] is None or (first and not self._is_known(first)):
                continue
            before = self._value(first, demand.numbers[0])
            at = self._at_flight(first, demand.numbers[0])
            if at is None:
                continue
            least = int(at) + demand.numbers[2].as_long()
            if least <= flown and (best is None or least >= best[0]):
                best = (least, before + demand.numbers[2])
        return None if best is None else best[1] + (flown - best[0])

    def _latest_event(self, name: str) -> Number | None:
        """The last thing that had happened by then, and as long after it as in the flight."""
        flown = int(self._flown(name))
        best: tuple[int, str] | None = None
        for start, end, _ in self.structure.times:
            for each in (start, end):
                value = self.structure.values.get(each)
                if (
                    each in self.known
                    and isinstance(value, int)
                    and value <= flown
                    and (best is None or value > best[0])
                ):
                    best = (value, each)
        return None if best is None else self.known[best[1]] + (flown - best[0])

    def _at_flight(self, name: str, number: Number) -> float | None:
        """What a number was in the flight."""
        if z3.is_int_value(number):
            return float(number.as_long())
        if z3.is_rational_value(number):
            return float(number.as_fraction())
        value = self.structure.values.get(name)
        if value is None and name in self.known:
            return self._evaluated(self.known[name])
        return float(value) if isinstance(value, int | float) else None

    def _evaluated(self, expression: Number) -> float | None:
        """An expression over sampled values, at those of the flight."""
        pairs = []
        for each in variables_of(expression):
            value = self.structure.values.get(name_of(each))
            if not isinstance(value, int | float):
                return None
            pairs.append((each, rational(value) if z3.is_real(each) else z3.IntVal(int(value))))
        found = z3.simplify(z3.substitute(expression, *pairs))
        if z3.is_int_value(found):
            return float(found.as_long())
        return float(found.as_fraction()) if z3.is_rational_value(found) else None

    def _constant(self, name: str, variable: Number) -> Number | None:
        """The value of the flight, for what nothing sets."""
        value = self.structure.values.get(name)
        if not isinstance(value, int | float):
            return None
        return z3.IntVal(int(value)) if z3.is_int(variable) else rational(value)

    # ---- conditions ----

    def _is_free(self, name: str) -> bool:
        return name.startswith("sampled ") or name in self.freed

    def _conditions(self) -> Dated:
        found: list[Requirement] = []
        left = 0
        for demand in self.structure.demands:
            if demand in self.sources or self._sets_freed(demand):
                continue
            named = [name for name in self.names[demand] if name]
            pairs = [
                (each, self.known[name])
                for name, each in zip(self.names[demand], demand.numbers, strict=True)
                if name in self.known
            ]
            if not demand.name:
                named = [name_of(each) for each in variables_of(demand.claim)]
            if any(not self._is_known(name) for name in named):
                left += 1
                continue
            if demand.name in _EQUALITIES and len(pairs) == 2 and pairs[0][1].eq(pairs[1][1]):
                continue
            claim = z3.simplify(z3.substitute(demand.claim, *pairs))
            if not z3.is_true(claim):
                found.append(Requirement(demand, claim))
        found += [
            Requirement(demand, divisor != 0) for demand, divisor in self.divisors if fraction(divisor) is None
        ]  # what is divided by may be 0 elsewhere
        return Dated(tuple(found), left, self.lags, self.known, frozenset(self.flown))
