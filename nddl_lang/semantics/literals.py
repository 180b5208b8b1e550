"""Read the numbers that an expression writes out."""

import re

from nddl_lang.semantics.schema import INFINITY, Kind, Type
from nddl_lang.syntax.nodes import BinaryExpr, Expr, FloatLiteral, IntLiteral, StringLiteral, UnaryExpr
from nddl_lang.text.diagnostic import Edit, Fix

_QUOTED = {Kind.INT: re.compile(r"[-+]?\d+"), Kind.FLOAT: re.compile(r"[-+]?\d+(?:\.\d+)?")}


def number(expression: Expr) -> float | int | None:
    """The number that is written out: a literal, or arithmetic over such; None for anything else."""
    chain: list[BinaryExpr] = []
    while isinstance(expression, BinaryExpr):
        chain.append(expression)
        expression = expression.left
    result = _signed_number(expression)
    for binary in reversed(chain):
        operand = number(binary.right) if result is not None else None
        result = _folded(binary.op, result, operand) if result is not None and operand is not None else None
    return result


def _signed_number(expression: Expr) -> float | int | None:
    sign = 1
    while isinstance(expression, UnaryExpr) and expression.op == "-":
        expression, sign = expression.operand, -sign
    if isinstance(expression, IntLiteral | FloatLiteral):
        return expression.value * sign
    inner = number(expression) if isinstance(expression, BinaryExpr) else None
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


def number_meant(side: Expr, other: Type) -> tuple[Fix, ...]:
    """A number in quotes without them, where it is compared with a number."""
    pattern = _QUOTED.get(other.kind)
    if not isinstance(side, StringLiteral) or pattern is None or pattern.fullmatch(side.value) is None:
        return ()
    return (Fix(f"write `{side.value}`", (Edit(side.span, side.value),), safe=False),)


def is_infinite(expression: Expr) -> bool:
    """Whether the expression writes an infinity, which fits ints and floats alike."""
    value = number(expression)
    return value is not None and abs(value) >= INFINITY
