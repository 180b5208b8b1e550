"""Read the numbers that an expression writes out."""

from nddl_lang.semantics.schema import INFINITY
from nddl_lang.syntax.nodes import BinaryExpr, Expr, FloatLiteral, IntLiteral, UnaryExpr


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


def is_infinite(expression: Expr) -> bool:
    """Whether the expression writes an infinity, which fits ints and floats alike."""
    value = number(expression)
    return value is not None and abs(value) >= INFINITY
