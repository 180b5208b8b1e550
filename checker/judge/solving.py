"""What a part of an expression is worth: the argument that a constraint determines, from the others."""

import math
from collections.abc import Callable

from checker.judge.functions import COMPUTED, has_open, reach, sum_of
from checker.judge.meanings import TESTS, negation
from checker.judge.values import is_open
from runtime.executive.record import Value, ValueRange

_ROUNDING = ("floor", "floorf", "ceil", "ceilf")
_ONE_TO_ONE = ("addEq", "eqSum", "neg", "expf", "logf", "deg_to_rad")


class PartRange(ValueRange):
    """What a part of an expression may be, whose own value does not tell those that it is computed from."""

    __slots__ = ()


def _evaluate(
    function: Callable[..., float], inputs: tuple[Value, ...], monotone: bool, one_to_one: bool = True
) -> Value:
    """The value of a function; an interval where an input is open, which `one_to_one` tells if it is the only one."""
    if not has_open(inputs):
        return function(*inputs)
    unfixed = [each for each in inputs if is_open(each)]
    kind = ValueRange if one_to_one and len(unfixed) == 1 and not isinstance(unfixed[0], PartRange) else PartRange
    if not monotone:
        return kind(-math.inf, math.inf)
    lowest, highest = reach(function, inputs)
    if lowest is None or highest is None:
        return kind(-math.inf, math.inf)
    return kind(lowest, highest)


def _rounded(function: Callable[..., float], x: Value) -> Value:
    """A whole number; an interval where the real is so near to one, but not it, that it may stand for both sides."""
    if isinstance(x, int) or (isinstance(x, float) and x.is_integer()):
        return int(x)
    lowest, highest = reach(function, (x,))
    if lowest is None or highest is None or lowest == highest:
        return _evaluate(function, (x,), True, one_to_one=False)
    return PartRange(lowest, highest)


def solver(name: str, index: int, count: int) -> Callable[..., Value] | None:
    """The function that gives argument `index` of constraint `name` from the other arguments; None if there is none."""
    if name in TESTS and index == 0:
        test = TESTS[name]
        return lambda *rest: _truth(test(*rest))
    if name in COMPUTED and index == (COMPUTED[name][0] if COMPUTED[name][0] == 0 else count - 1):
        _, function, monotone = COMPUTED[name]
        if name in _ROUNDING:
            return lambda x: _rounded(function, x)
        return lambda *rest: _evaluate(function, rest, monotone, name in _ONE_TO_ONE)
    match name, index:
        case "addEq", _:  # of sum and the other term
            return lambda other, total: _evaluate(lambda a, b: b - a, (other, total), True)
        case "divEq", 2:
            return lambda a, b: _evaluate(_divide, (a, b), False, one_to_one=False)
        case "neg", 0:
            return lambda x: _evaluate(lambda a: -a, (x,), True)
        case (("eq" | "concurrent"), _) if count == 2:
            return lambda x: x
        case "neq", 0:
            return lambda x: _truth(negation(x))
        case "temporalDistance", 1:
            return lambda earlier, later: _evaluate(lambda a, b: b - a, (earlier, later), True)
        case "temporalDistance", 2:
            return lambda earlier, gap: _evaluate(sum_of, (earlier, gap), True)
        case "temporalDistance", 0:
            return lambda gap, later: _evaluate(lambda a, b: b - a, (gap, later), True)
        case _:
            return None


def _truth(answer: bool | None) -> Value:
    return PartRange(0, 1) if answer is None else answer


def _divide(a: float, b: float) -> float:
    if not b:
        return math.nan
    if isinstance(a, int) and isinstance(b, int) and a % b == 0:
        return a // b
    return a / b
