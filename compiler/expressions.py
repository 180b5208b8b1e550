"""Lower expressions: `enforce` makes one hold, `value` names its result, `define` puts its result in a variable."""

from typing import assert_never

from compiler import constants, temporal
from compiler.body import Body
from compiler.program import Constant, Operand, Post, Sample, TypeCode, UnionOf
from compiler.sampling import note_use
from nddl_lang.semantics.functions import ResultKind
from nddl_lang.semantics.schema import Kind, Type
from nddl_lang.syntax.nodes import (
    BinaryExpr,
    BoolLiteral,
    CallConstraint,
    CallExpr,
    Expr,
    FloatLiteral,
    IntervalExpr,
    IntLiteral,
    NewExpr,
    PathExpr,
    SetExpr,
    StringLiteral,
    UnaryExpr,
)
from nddl_lang.text.source import Span

SAMPLED = "sampledParameter"
_COMPARISONS = ("==", "!=", "<", "<=", ">", ">=")
_OPPOSITE = {"==": "!=", "!=": "==", "<": ">=", "<=": ">", ">": "<=", ">=": "<"}
_BOOL = constants.basic(Kind.BOOL)


# ---- enforcing position ----


def enforce(expr: Expr, message: str | None, body: Body) -> None:
    """Post what makes `expr` true."""
    match expr:
        case BinaryExpr(op="&&", left=left, right=right):
            enforce(left, message, body)
            enforce(right, message, body)
        case BinaryExpr(op="||"):
            operands = tuple(value(side, body) for side in _alternatives(expr))
            body.emit(Post("or", operands, message, expr.span))
        case BinaryExpr(op=op, left=left, right=right) if op in _COMPARISONS:
            _compare(op, left, right, message, expr.span, body)
        case UnaryExpr(op="!", operand=BinaryExpr(op=op, left=left, right=right)) if op in _COMPARISONS:
            _compare(_OPPOSITE[op], left, right, message, expr.span, body)
        case UnaryExpr(op="!", operand=operand):
            body.emit(Post("eq", (value(operand, body), Constant(constants.FALSE)), message, expr.span))
        case _:
            body.emit(Post("eq", (value(expr, body), Constant(constants.TRUE)), message, expr.span))


def _alternatives(expr: Expr) -> list[Expr]:
    match expr:
        case BinaryExpr(op="||", left=left, right=right):
            return _alternatives(left) + _alternatives(right)
        case _:
            return [expr]


def _compare(op: str, left: Expr, right: Expr, message: str | None, span: Span, body: Body) -> None:
    if op in (">", ">="):
        op, left, right = op.replace(">", "<"), right, left
    if (post := temporal.difference(op, left, right, message, span, body)) is not None:
        body.emit(post)
        return
    if op == "==" and _sample(left, right, body):
        return
    if op == "==" and is_compound(left, body) and not is_compound(right, body):
        left, right = right, left
    if op == "==" and is_compound(right, body):
        target = value(left, body)
        if not _is_truth(right, body) or _is_truth_holder(left, body):
            define(right, target, message, body)
            return
        body.emit(Post("eq", (target, value(right, body)), message, span))
        return
    first, second = value(left, body), value(right, body)
    timed = temporal.is_integer(left, body) and temporal.is_integer(right, body)
    name = temporal.comparison(op, first, second) if timed else _PLAIN[op]
    body.emit(Post(name, (first, second), message, span))


_PLAIN = {"==": "eq", "!=": "neq", "<": "lt", "<=": "leq"}


def _sample(left: Expr, right: Expr, body: Body) -> bool:
    """`x == sampledParameter(P)`, either way round: the environment's value goes straight into a fitting `x`."""
    for target, call in ((left, right), (right, left)):
        if isinstance(target, PathExpr) and isinstance(call, CallExpr) and call.function.name == SAMPLED:
            mine, drawn = body.model.type_of(target), body.model.type_of(call)
            if mine.kind is drawn.kind and body.model.constant(target) is None:
                sample(value(target, body), call, body)
                return True
    return False


def sample(target: Operand, node: CallExpr | CallConstraint, body: Body) -> None:
    """Bind `target` to what the mission draws for the parameter that `node` names."""
    body.emit(Sample(target, note_use(node, body.model), node.span))


# ---- value position ----


def is_compound(expr: Expr, body: Body) -> bool:
    """Whether the value of `expr` is computed by a constraint."""
    match expr:
        case BinaryExpr() | UnaryExpr():
            return body.model.constant(expr) is None
        case CallExpr(function=function):
            return function.name != SAMPLED
        case _:
            return False


def _is_truth(expr: Expr, body: Body) -> bool:
    """Whether a constraint computes a truth value for `expr`."""
    match expr:
        case BinaryExpr(op=op):
            return op in _COMPARISONS or op in ("&&", "||")
        case UnaryExpr(op=op):
            return op == "!"
        case CallExpr(function=function):
            return body.model.callables.functions[function.name].result is ResultKind.BOOL
        case _:
            return False


def _is_truth_holder(expr: Expr, body: Body) -> bool:
    return _is_truth(expr, body) or body.model.type_of(expr).kind is Kind.BOOL


def value(expr: Expr, body: Body) -> Operand:
    """The operand that holds the value of `expr`, with the constraints that compute it posted before."""
    if (domain := body.model.constant(expr)) is not None:
        return body.read(Constant(domain))
    match expr:
        case PathExpr():
            return body.read(body.operand(body.model.tables.references[expr]))
        case SetExpr(items=items):
            return body.read(union(items, body))
        case CallExpr(function=function) if function.name == SAMPLED:
            drawn = body.implicit(constants.type_code(body.model.type_of(expr)), expr.span)
            sample(drawn, expr, body)
            return body.read(drawn)
        case BinaryExpr() | UnaryExpr() | CallExpr():
            result = body.implicit(_result_type(expr, body), expr.span)
            define(expr, result, None, body)
            return result
        case IntervalExpr() | NewExpr() | IntLiteral() | FloatLiteral() | BoolLiteral() | StringLiteral():
            raise AssertionError(f"no value can be lowered from {expr.span.text!r}")
        case _:
            assert_never(expr)


def union(items: tuple[Expr, ...], body: Body) -> UnionOf:
    """A set with names in it."""
    return UnionOf(tuple(value(item, body) for item in items))


def _result_type(expr: BinaryExpr | UnaryExpr | CallExpr, body: Body) -> TypeCode:
    """The type of an intermediate result; a typedef among the operands does not restrict it."""
    if _is_truth(expr, body):
        return _BOOL
    found: Type = body.model.type_of(expr)
    return TypeCode(found.kind.value, found.base, None)


def define(expr: Expr, target: Operand, message: str | None, body: Body) -> None:
    """Post what makes `target` equal to `expr`, which is compound."""
    span = expr.span
    match expr:
        case BinaryExpr(op=op, left=left, right=right):
            if (post := temporal.assignment(expr, target, message, body)) is not None:
                body.emit(post)
                return
            first, second = value(left, body), value(right, body)
            name, operands = _binary(op, first, second, target)
            body.emit(Post(name, operands, message, span))
        case UnaryExpr(op=op, operand=operand):
            body.emit(Post("neg" if op == "-" else "neq", (target, value(operand, body)), message, span))
        case CallExpr(function=function, arguments=arguments):
            callables = body.model.callables
            row = callables.constraints[callables.functions[function.name].constraint]
            operands = (target, *(value(argument, body) for argument in arguments))
            body.emit(Post(row.name, operands[: row.signature.maximum], message, span))
        case _:
            raise AssertionError(f"{span.text!r} is no compound expression")


def _binary(op: str, a: Operand, b: Operand, result: Operand) -> tuple[str, tuple[Operand, ...]]:
    """The constraint that computes `result` from `a op b`."""
    match op:
        case "+":
            return "addEq", (a, b, result)
        case "-":
            return "addEq", (result, b, a)
        case "*":
            return "mulEq", (a, b, result)
        case "/":
            return "divEq", (a, b, result)
        case "==":
            return "testEq", (result, a, b)
        case "!=":
            return "testNeq", (result, a, b)
        case "<":
            return "testLessThan", (result, a, b)
        case "<=":
            return "testLeq", (result, a, b)
        case ">":
            return "testLessThan", (result, b, a)
        case ">=":
            return "testLeq", (result, b, a)
        case "&&":
            return "testAnd", (result, a, b)
        case "||":
            return "testOr", (result, a, b)
        case _:
            raise AssertionError(f"no operator {op}")
