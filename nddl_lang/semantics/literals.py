"""Read the numbers that an expression writes out."""

from collections.abc import Callable
from math import ceil, floor, isfinite

from nddl_lang.semantics.schema import INFINITY
from nddl_lang.syntax.nodes import BinaryExpr, Expr, FloatLiteral, IntLiteral, PathExpr, UnaryExpr
from nddl_lang.text.diagnostic import Edit, Fix
from nddl_lang.text.source import Span

ValueOf = Callable[[PathExpr], float | int | None]


def number(expression: Expr, value_of: ValueOf | None = None) -> float | int | None:
    """The number that is written out: a literal, or arithmetic over such; None for anything else.

    `value_of` gives the numbers of names that stand for one; without it no name does.
    """
    chain: list[BinaryExpr] = []
    while isinstance(expression, BinaryExpr):
        chain.append(expression)
        expression = expression.left
    result = _signed_number(expression, value_of)
    for binary in reversed(chain):
        operand = number(binary.right, value_of) if result is not None else None
        result = _folded(binary.op, result, operand) if result is not None and operand is not None else None
    return result


def _signed_number(expression: Expr, value_of: ValueOf | None) -> float | int | None:
    sign = 1
    while isinstance(expression, UnaryExpr) and expression.op == "-":
        expression, sign = expression.operand, -sign
    if isinstance(expression, IntLiteral | FloatLiteral):
        return expression.value * sign
    inner = None
    if isinstance(expression, BinaryExpr):
        inner = number(expression, value_of)
    elif isinstance(expression, PathExpr) and value_of is not None:
        inner = value_of(expression)
    return None if inner is None else inner * sign


def _folded(op: str, left: float | int, right: float | int) -> float | int | None:
    match op:
        case "+":
            return left + right
        case "-":
            return left - right
        case "*":
            return left * right
        case "/" if right != 0:
            return left / right
        case _:
            return None


def is_infinite(expression: Expr) -> bool:
    """Whether the expression writes an infinity, which fits ints and floats alike."""
    value = number(expression)
    return value is not None and abs(value) >= INFINITY


def is_fraction(value: object) -> bool:
    """Whether a value is a number, and not a whole one."""
    return isinstance(value, float) and isfinite(value) and not value.is_integer()


def whole_beside(value: float | int | None, span: Span) -> tuple[Fix, ...]:
    """The fixes that write the whole number below or above a fraction at `span`; none for a whole number."""
    if value is None or not is_fraction(value):
        return ()
    near = (str(floor(value)), str(ceil(value)))
    return tuple(Fix(f"write `{each}`", (Edit(span, each),), safe=False, is_choice=True) for each in near)
