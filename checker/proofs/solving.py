"""One constraint solved for one argument: the value that the others determine, as an expression of z3."""

from collections.abc import Sequence
from fractions import Fraction

import z3

from checker.judge.functions import COMPUTED, result_index
from checker.proofs.claims import Number, claim_of
from checker.proofs.operands import rational


def solved(name: str, index: int, numbers: Sequence[Number], unknown: Number) -> Number | None:
    """What argument `index` of the constraint is, where the others are known; `unknown` is its variable."""
    others = [each for k, each in enumerate(numbers) if k != index]
    if name in ("eq", "concurrent"):
        return _as(others[0], unknown)
    if name.startswith(("test", "cond")):
        return _tested(name, numbers, index)
    found = _inverse(name, index, numbers)
    if found is None and name in COMPUTED and index == result_index(name, len(numbers)):
        found = _function(name, others)
    return None if found is None else _as(found, unknown)


def fraction(number: Number) -> Fraction | None:
    """The value of a number without variables."""
    found = simplified(number)
    if isinstance(found, z3.IntNumRef):
        return Fraction(found.as_long())
    if isinstance(found, z3.RatNumRef):
        exact: Fraction = found.as_fraction()
        return exact
    return None


def simplified(number: Number) -> Number:
    """The same number, simpler."""
    return number if isinstance(number, z3.IntNumRef | z3.RatNumRef) else z3.simplify(number)


def _as(value: Number, like: Number) -> Number | None:
    """A number of the type of another; a whole number is equal to a real only where that is whole."""
    if z3.is_int(like) and z3.is_real(value):
        known = fraction(value)
        if known is not None:
            return z3.IntVal(known.numerator) if known.denominator == 1 else None
        return z3.ToInt(value) if value.decl().kind() == z3.Z3_OP_TO_REAL else None
    return z3.ToReal(value) if z3.is_real(like) and z3.is_int(value) else value


def _tested(name: str, numbers: Sequence[Number], index: int) -> Number | None:
    if index != 0:
        return None
    truth = z3.Int("truth")
    claim = claim_of(name, [truth, *numbers[1:]])
    if claim is None:
        return None
    holds = z3.substitute(claim, (truth, z3.IntVal(1)))
    return z3.If(holds, z3.IntVal(1), z3.IntVal(0))


def _inverse(name: str, index: int, numbers: Sequence[Number]) -> Number | None:
    match name, index:
        case "addEq", 0:
            return numbers[2] - numbers[1]
        case "addEq", 1:
            return numbers[2] - numbers[0]
        case "temporalDistance", 2:
            return numbers[0] + numbers[1]
        case "temporalDistance", 1:
            return numbers[2] - numbers[0]
        case "temporalDistance", 0:
            return numbers[2] - numbers[1]
        case "mulEq", 0 | 1:
            return _quotient(numbers[2], numbers[1 - index])
        case "divEq", 2:
            return _quotient(numbers[0], numbers[1])
        case "divEq", 0:
            return numbers[1] * numbers[2]
        case "neg", 0:
            return -numbers[1]
        case "eqSum", _ if index > 0:
            rest = [each for k, each in enumerate(numbers) if k not in (0, index)]
            return numbers[0] - sum(rest[1:], start=rest[0])
        case _:
            return None


def _quotient(a: Number, b: Number) -> Number | None:
    divisor = fraction(b)
    if divisor == 0:
        return None
    real = z3.ToReal(a) if z3.is_int(a) else a
    if divisor is not None:
        return real / rational(divisor)
    return real / (z3.ToReal(b) if z3.is_int(b) else b)


def _function(name: str, inputs: Sequence[Number]) -> Number | None:
    """The value of a function: by the judge's own arithmetic where all inputs are known, else as an expression."""
    match name:
        case "addEq" | "eqSum":
            return sum(inputs[1:], start=inputs[0])
        case "mulEq" | "eqProduct":
            result = inputs[0]
            for each in inputs[1:]:
                result = result * each
            return result
        case "neg":
            return -inputs[0]
        case "absVal" | "abs" | "absf":
            return z3.If(inputs[0] >= 0, inputs[0], -inputs[0])
        case "floor" | "floorf":
            return inputs[0] if z3.is_int(inputs[0]) else z3.ToInt(inputs[0])
        case "ceil" | "ceilf":
            return inputs[0] if z3.is_int(inputs[0]) else -z3.ToInt(-inputs[0])
        case "eqMaximum" | "allMax" | "maxf":
            return _extreme(inputs, greatest=True)
        case "eqMinimum" | "allMin" | "minf":
            return _extreme(inputs, greatest=False)
        case _:
            return _known(name, inputs)


def _extreme(inputs: Sequence[Number], *, greatest: bool) -> Number:
    found = inputs[0]
    for each in inputs[1:]:
        found = z3.If(each >= found if greatest else each <= found, each, found)
    return found


def _known(name: str, inputs: Sequence[Number]) -> Number | None:
    known = [fraction(each) for each in inputs]
    if any(each is None for each in known):
        return None
    try:
        value = COMPUTED[name][1](*[float(each) for each in known if each is not None])
        return rational(value) if value == value else None
    except (ValueError, OverflowError):
        return None
