"""Constraints in Python as claims of z3: what is wrong with the values that it proposes is learnt by calling them.

Nothing is known of such a constraint but what it answers. So z3 proposes values that satisfy all else; the constraint
is called on them. What it refuses is widened as far as it refuses all of it, by calls, and told to z3 as a lemma, until
z3 finds no values any more, or some that the constraint takes too. That propagation loses no solution, as
docs/constraints.md asks of it, is believed.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import inf
from typing import Protocol

import z3

from checker.proofs.claims import Claim, Number
from checker.proofs.operands import Symbols, rational
from runtime.constraints.domains.tags import (
    FLOAT_TOLERANCE,
    KIND_BOOL,
    KIND_FLOAT,
    KIND_INT,
    KIND_OBJECT,
    KIND_STRING,
    KIND_SYMBOL,
)
from runtime.constraints.engine import Engine
from runtime.plan.readout.names import VariableName
from runtime.plan.readout.statements import Argument
from runtime.user.constraint import Constraint
from runtime.user.fault import UserCodeError
from runtime.user.written import Written

_MOST_LEMMAS = 60  # for one conflict, all questions about what can be left out included
_MOST_CALLS = 2000
_FARTHEST = 2.0**40
_NARROW = 1e-7  # half the width of a float's single value
_KINDS = {"int": KIND_INT, "float": KIND_FLOAT, "bool": KIND_BOOL, "object": KIND_OBJECT, "string": KIND_STRING}
_NUMBERS = (KIND_INT, KIND_FLOAT, KIND_BOOL)

_Range = tuple[float, float]


class Decider(Protocol):
    """What is asked of z3, or of `Asking`."""

    def check(self, *assumptions: Claim) -> "z3.CheckSatResult":
        """Whether all that was added, and the assumptions, can hold together."""

    def unsat_core(self) -> Sequence[Claim]:
        """Assumptions that cannot, after an answer of no."""


@dataclass(frozen=True, slots=True)
class Called:
    """A constraint in Python that z3 was told about by calls: where it is written, how often it was called.

    `refused` are values that z3 proposed and it refused, as texts.
    """

    name: str
    file: str
    line: int
    calls: int
    refused: tuple[str, ...] = ()


class Opaque:
    """One call of a constraint in Python, with its arguments as numbers of z3."""

    def __init__(
        self,
        constraint: Constraint,
        mark: Claim,
        arguments: Sequence[Argument],
        numbers: Sequence[Number],
        names: Symbols,
    ) -> None:
        self.mark = mark
        self.arguments = arguments
        self.numbers = numbers
        self.kinds = [_kind_of(one) for one in arguments]
        self.names = names
        self.written = Written(constraint, self)
        self.target = -1
        self.calls = 0
        self.refused: tuple[str, ...] = ()

    @property
    def called(self) -> Called:
        """What was asked of it."""
        file, line = self.written.source
        return Called(self.written.name, file, line, self.calls, self.refused)

    # ---- Words ----

    def text(self, kind: int, number: int) -> str:
        """The name that has a number."""
        return self.names.text(number) or f"another name ({number})"

    def number(self, kind: int, text: str) -> int | None:
        """The number of a name."""
        return self.names.number(text)

    def source_place(self, span: int) -> str | None:
        """Nowhere: it is called once more, for z3."""
        return None

    # ---- asking ----

    def given(self, model: "z3.ModelRef") -> list[Claim]:
        """That what determines the last target of a lemma is as z3 has proposed."""
        given = [one for k, one in enumerate(self.numbers) if k != self.target]
        return [one == model.eval(one, model_completion=True) for one in given]

    def takes(self, model: "z3.ModelRef") -> bool:
        """Whether the constraint takes what z3 proposes; raises UserCodeError."""
        return self._narrowed([self._single(k, value) for k, value in enumerate(self._values(model))]) is not None

    def _values(self, model: "z3.ModelRef") -> list[Fraction]:
        return [_value(model.eval(one, model_completion=True)) for one in self.numbers]

    def lemma(self, model: "z3.ModelRef") -> Claim | None:
        """What z3 did not know and its values contradict; None where the constraint takes them.

        Raises UserCodeError.
        """
        values = self._values(model)
        box = [self._single(k, value) for k, value in enumerate(values)]
        if self._narrowed(box) is not None:
            return None
        if not self.refused:
            self.refused = tuple(self._shown(k, value) for k, value in enumerate(values))
        target = -1
        for k in range(len(box)):
            if self.kinds[k] not in _NUMBERS:
                continue
            wide = [*box[:k], self._all(k), *box[k + 1 :]]
            left = self._narrowed(wide)
            if left is None or (target >= 0 and _misses(values[target], left[target])):
                box = wide
            elif target < 0 and _misses(values[k], left[k]):
                target, box = k, wide
        for k in range(len(box)):
            if k != target and self.kinds[k] in _NUMBERS and box[k] != self._all(k):
                box = self._widened(box, k, target, values)
        self.target = target
        return self._claim(box, target)

    def _single(self, k: int, value: Fraction) -> _Range:
        width = _NARROW * max(1.0, abs(float(value))) if self.kinds[k] == KIND_FLOAT else 0.0
        return float(value) - width, float(value) + width

    def _all(self, k: int) -> _Range:
        return (0.0, 1.0) if self.kinds[k] == KIND_BOOL else (-inf, inf)

    def _narrowed(self, box: Sequence[_Range]) -> list[_Range] | None:
        """What the constraint leaves of some ranges; None: nothing."""
        self.calls += 1
        engine = Engine()
        variables = []
        for kind, (low, high) in zip(self.kinds, box, strict=True):
            if kind in _NUMBERS:
                variables.append(engine.new_interval(kind, low, high, -1, -1))
            else:
                variables.append(engine.new_values(kind, [low], -1, -1))
        engine.post_external(self.written, variables, -1, -1)
        if not engine.propagate():
            return None
        return [(engine.lower(v), engine.upper(v)) for v in variables]

    def _is_refused(self, box: Sequence[_Range], target: int, values: Sequence[Fraction]) -> bool:
        left = self._narrowed(box)
        return left is None or (target >= 0 and _misses(values[target], left[target]))

    def _widened(self, box: list[_Range], k: int, target: int, values: Sequence[Fraction]) -> list[_Range]:
        """Widen one range to both sides, as far as all of it is refused: at once, else by doubling and halving."""
        for side in (0, 1):
            sign = 1.0 if side else -1.0
            known, step, is_out = 0.0, inf, False
            while self.calls < _MOST_CALLS:
                tried = box[k][side] + sign * (step if step == inf else known + step)
                wide = (box[k][0], tried) if side else (tried, box[k][1])
                if self._is_refused([*box[:k], wide, *box[k + 1 :]], target, values):
                    if step == inf:
                        known = inf
                        break
                    known += step
                    step *= 0.5 if is_out else 2.0
                else:
                    is_out = step != inf
                    step = 1.0 if step == inf else step * 0.5
                if step > _FARTHEST or step < (1.0 if self.kinds[k] == KIND_INT else FLOAT_TOLERANCE):
                    break
            end = box[k][side] + sign * known
            box[k] = (box[k][0], end) if side else (end, box[k][1])
        return box

    def _claim(self, box: Sequence[_Range], target: int) -> Claim:
        """Of values in the other ranges, what is left for the target; without one, that there are none such."""
        inside = [self._within(k, each, 0.0) for k, each in enumerate(box) if k != target]
        left = self._narrowed(box)
        if left is None or target < 0:
            return z3.Not(z3.And(*inside))
        spare = _spare(left[target]) if self.kinds[target] == KIND_FLOAT else 0.0
        return z3.Implies(z3.And(*inside), self._within(target, left[target], spare))

    def _within(self, k: int, given: _Range, spare: float) -> Claim:
        low, high = given
        number = self.numbers[k]
        parts = [] if low == -inf else [number >= rational(Fraction(low) - Fraction(spare))]
        parts += [] if high == inf else [number <= rational(Fraction(high) + Fraction(spare))]
        return z3.And(*parts)

    def _shown(self, k: int, value: Fraction) -> str:
        named = self.arguments[k]
        text = f"{float(value):.12g}" if self.kinds[k] in _NUMBERS else self.text(self.kinds[k], int(value))
        return f"{named} = {text}" if isinstance(named, VariableName) else text


class Asking:
    """A solver that calls constraints in Python on the values that it finds."""

    def __init__(self, solver: "z3.Solver", opaque: Sequence[Opaque]) -> None:
        self.solver = solver
        self.opaque = opaque
        self.lemmas = 0
        self.has_failed = False

    def check(self, *assumptions: Claim) -> "z3.CheckSatResult":
        """Whether all can hold together; unknown after too many lemmas, or where a constraint raises an exception."""
        marks = {each.get_id() for each in assumptions}
        asked = [each for each in self.opaque if each.mark.get_id() in marks]
        while True:
            answer = self.solver.check(*assumptions)
            if answer != z3.sat or not asked:
                return answer
            if self.lemmas >= _MOST_LEMMAS or self.has_failed:
                return z3.unknown
            model = self.solver.model()
            try:
                found = [(each, each.lemma(model)) for each in asked]
                for each, lemma in found:
                    if lemma is not None:
                        self.solver.add(z3.Implies(each.mark, lemma))
                        self.lemmas += 1
                if all(lemma is None for _, lemma in found) or self._holds_near(model, asked, assumptions):
                    return z3.sat
            except UserCodeError:
                self.has_failed = True
                return z3.unknown

    def _holds_near(self, model: "z3.ModelRef", asked: Sequence[Opaque], assumptions: Sequence[Claim]) -> bool:
        """Whether all can hold with what functions are given as proposed; else z3 would propose this without end."""
        self.solver.push()
        for each in asked:
            self.solver.add(*each.given(model))
        is_found = self.solver.check(*assumptions) == z3.sat
        other = self.solver.model() if is_found else None
        self.solver.pop()
        return other is not None and all(each.takes(other) for each in asked)

    def unsat_core(self) -> Sequence[Claim]:
        """Assumptions that contradict each other, after an answer of no."""
        core: Sequence[Claim] = self.solver.unsat_core()
        return core


def _kind_of(argument: Argument) -> int:
    if isinstance(argument, VariableName):
        return _KINDS.get(argument.kind, KIND_SYMBOL)
    return KIND_FLOAT if isinstance(argument, float) else KIND_INT if isinstance(argument, int) else KIND_SYMBOL


def _value(found: Number) -> Fraction:
    if z3.is_algebraic_value(found):
        found = found.approx(20)
    if z3.is_int_value(found):
        return Fraction(found.as_long())
    exact: Fraction = found.as_fraction()
    return exact


def _misses(value: Fraction, left: _Range) -> bool:
    """Whether a value is not in what is left, by more than what counts as equal."""
    low, high = left
    return float(value) < low - _spare(left) or float(value) > high + _spare(left)


def _spare(left: _Range) -> float:
    """Half of what a single value is wide."""
    return 0.5 * _NARROW * max([1.0, *(abs(each) for each in left if abs(each) < inf)])
