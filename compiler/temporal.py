"""Recognise comparisons that are distances between timepoints, so that the temporal network can hold them."""

from dataclasses import dataclass

from compiler.body import Body
from compiler.constants import interval, single
from compiler.program import END, START, Constant, Operand, Post, TokenVariable
from nddl_lang.semantics.schema import INFINITY, Kind, Reference, TokenVariableReference
from nddl_lang.syntax.nodes import BinaryExpr, Expr, PathExpr
from nddl_lang.text.source import Span


@dataclass(frozen=True, slots=True)
class _Difference:
    """`later - earlier + offset + sign * distance`, with a distance that is a variable or missing."""

    later: Expr
    earlier: Expr
    offset: int
    distance: Expr | None
    sign: int


def comparison(op: str, first: Operand, second: Operand) -> str:
    """The constraint for `first op second` over integers: a temporal one where a timepoint takes part."""
    temporal = _is_timepoint(first) or _is_timepoint(second)
    both = _is_timepoint(first) and _is_timepoint(second)
    match op:
        case "==":
            return "concurrent" if temporal else "eq"
        case "<=":
            return "precedes" if temporal else "leq"
        case "<":
            return "strictlyPrecedes" if both else "lt"
        case _:
            return "neq"


def difference(op: str, left: Expr, right: Expr, message: str | None, span: Span, body: Body) -> Post | None:
    """`left op right` as one `temporalDistance`, if it compares the difference of two timepoints with a distance."""
    if op == "!=":
        return None
    found = _difference(_terms(left, 1, body), _terms(right, -1, body), body)
    if found is None:
        return None
    later, earlier = _operand(found.later, body), _operand(found.earlier, body)
    if found.distance is not None:
        if op != "==" or found.offset != 0:
            return None
        between = body.read(_operand(found.distance, body))
        if found.sign > 0:  # later + distance == earlier
            later, earlier = earlier, later
        return Post("temporalDistance", (body.read(earlier), between, body.read(later)), message, span)
    if found.offset == 0:
        return None  # a plain comparison of the two
    gap = -found.offset
    match op:
        case "==":
            if gap < 0:
                later, earlier, gap = earlier, later, -gap
            bounds = (gap, gap)
        case "<=":
            bounds = (-INFINITY, gap)
        case _:
            bounds = (-INFINITY, gap - 1)
    domain = interval(*bounds)
    return Post("temporalDistance", (body.read(earlier), Constant(domain), body.read(later)), message, span)


def assignment(expr: BinaryExpr, target: Operand, message: str | None, body: Body) -> Post | None:
    """`target == end - start`: the target is the distance."""
    if expr.op != "-" or not (_is_time(expr.left, body) and _is_time(expr.right, body)):
        return None
    later, earlier = body.read(_operand(expr.left, body)), body.read(_operand(expr.right, body))
    return Post("temporalDistance", (earlier, target, later), message, expr.span)


def _is_timepoint(operand: Operand) -> bool:
    """Whether `operand` is the start or end of a token."""
    return isinstance(operand, TokenVariable) and operand.variable in (START, END)


def _is_time(expr: Expr, body: Body) -> bool:
    """Whether `expr` names the start, end or time of a token."""
    reference: Reference | None = body.model.tables.references.get(expr)
    return isinstance(reference, TokenVariableReference) and _is_timepoint(body.operand(reference))


def is_integer(expr: Expr, body: Body) -> bool:
    """Whether every value of `expr` is a whole number."""
    domain = body.model.constant(expr)
    return domain.kind == "int" if domain is not None else body.model.type_of(expr).kind is Kind.INT


def _terms(expr: Expr, sign: int, body: Body) -> list[tuple[int, Expr]] | None:
    """The summands of `expr`; None where it is no sum of whole numbers."""
    match expr:
        case BinaryExpr(op="+" | "-" as op, left=left, right=right) if body.model.constant(expr) is None:
            first = _terms(left, sign, body)
            second = _terms(right, sign if op == "+" else -sign, body)
            return None if first is None or second is None else first + second
        case PathExpr():
            return [(sign, expr)] if is_integer(expr, body) else None
        case _:
            domain = body.model.constant(expr)
            value = single(domain)
            return [(sign, expr)] if isinstance(value, int) and not isinstance(value, bool) else None


def _difference(
    left: list[tuple[int, Expr]] | None, right: list[tuple[int, Expr]] | None, body: Body
) -> _Difference | None:
    if left is None or right is None:
        return None
    plus: list[Expr] = []
    minus: list[Expr] = []
    others: list[tuple[int, Expr]] = []
    offset = 0
    for sign, expr in left + right:
        value = single(body.model.constant(expr))
        if isinstance(value, int):
            offset += sign * value
        elif _is_time(expr, body):
            (plus if sign > 0 else minus).append(expr)
        else:
            others.append((sign, expr))
    if len(plus) != 1 or len(minus) != 1 or len(others) > 1 or abs(offset) >= INFINITY:
        return None
    if not others:
        return _Difference(plus[0], minus[0], offset, None, 0)
    return _Difference(plus[0], minus[0], offset, others[0][1], others[0][0])


def _operand(expr: Expr, body: Body) -> Operand:
    return body.operand(body.model.tables.references[expr])
