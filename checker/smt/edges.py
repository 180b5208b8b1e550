"""Free a sampled value in a conflict and find exactly between which values the conflict arises.

The conflict holds for the value drawn. The predicate "some value between the drawn one and x makes the terms hold" only
changes once as x moves away, so halving finds where; the simplest fraction in the last bracket is then proved by z3.
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

import z3

from checker.proofs.conflict import EFFORT
from checker.proofs.operands import rational
from checker.simplest import simplest_between
from checker.smt.terms import Terms
from runtime.executive.outcome import Conflict

_HALVINGS = 48
_NARROW = Fraction(1, 10**9)


@dataclass(frozen=True, slots=True)
class RangeEnd:
    """Where the conflict ends: beyond `value` it does not arise; `is_safe`: at `value` itself it does not either."""

    value: Fraction
    is_safe: bool
    is_proved: bool


@dataclass(frozen=True, slots=True)
class FailingRange:
    """The values of a parameter around the drawn one for which the conflict arises; None: as far as was searched."""

    parameter: str
    below: RangeEnd | None
    above: RangeEnd | None


def find_failing_range(
    conflict: Conflict, parameter: str, drawn: float, box: tuple[float, float]
) -> FailingRange | None:
    """Search `box` for the edges of the conflict; None where z3 cannot tell, or no term samples `parameter`."""
    words = Terms(conflict, frozenset((parameter,)))
    solver = z3.Solver()
    solver.set("rlimit", EFFORT)
    solver.add(*words.base())
    terms = [term for element in conflict.elements for term in element.terms]
    if not any(term.name == "sampledParameter" and term.arguments[1] == parameter for term in terms):
        return None
    solver.add(*[claim for claim in (words.encode(term) for term in terms) if claim is not None])
    search = _Search(solver, words.parameter(parameter), Fraction(drawn))
    if search.holds(lambda value: value == rational(search.start)) is not False:
        return None
    try:
        return FailingRange(parameter, search.edge(Fraction(box[0])), search.edge(Fraction(box[1])))
    except _UndecidedError:
        return None


class _UndecidedError(Exception):
    """z3 gave up."""


class _Search:
    def __init__(self, solver: "z3.Solver", value: "z3.ArithRef", start: Fraction) -> None:
        self.solver = solver
        self.value = value
        self.start = start

    def edge(self, far: Fraction) -> RangeEnd | None:
        """The first value on the way from the start to `far` at which the terms can hold."""
        if far == self.start or not self._reaches(far):
            return None
        closed, opened = self.start, far
        for _ in range(_HALVINGS):
            if abs(opened - closed) <= _NARROW:
                break
            middle = (closed + opened) / 2
            if self._reaches(middle):
                opened = middle
            else:
                closed = middle
        guess = simplest_between(min(closed, opened), max(closed, opened))
        at_guess = self._decided(lambda value: value == rational(guess))
        before_guess = self._decided(lambda value: self._between(value, guess, with_end=False))
        just_after = guess + (far - guess) / 2**60
        is_proved = not before_guess and (at_guess or self._reaches(just_after))
        return RangeEnd(guess, at_guess, is_proved) if is_proved else RangeEnd(opened, True, False)

    def _reaches(self, end: Fraction) -> bool:
        return self._decided(lambda value: self._between(value, end, with_end=True))

    def _between(self, value: "z3.ArithRef", end: Fraction, *, with_end: bool) -> "z3.BoolRef":
        start, stop = rational(self.start), rational(end)
        if end > self.start:
            return z3.And(value > start, value <= stop if with_end else value < stop)
        return z3.And(value < start, value >= stop if with_end else value > stop)

    def _decided(self, claim: "Callable[[z3.ArithRef], z3.BoolRef]") -> bool:
        answer = self.holds(claim)
        if answer is None:
            raise _UndecidedError
        return answer

    def holds(self, claim: "Callable[[z3.ArithRef], z3.BoolRef]") -> bool | None:
        """Whether the terms can hold where `claim` does; None where z3 gives up."""
        self.solver.push()
        self.solver.add(claim(self.value))
        answer = self.solver.check()
        self.solver.pop()
        return None if answer == z3.unknown else bool(answer == z3.sat)
