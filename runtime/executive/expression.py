"""Arithmetic over parameters: the text of a dependent parameter in, a function of other parameters' values out.

The text is read by Python's parser and walked here; nothing but numbers, names, arithmetic, comparisons, a choice
(`a if c else b`) and a few functions is taken. All operations are fixed by IEEE 754 to the last bit.
"""

import ast
import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache

from runtime.constraints.domains.tags import HALF_INF

_LONGEST = 1000  # characters
_DEEPEST = 40
_FUNCTIONS: Mapping[str, tuple[int, int, Callable[..., float]]] = {  # least and most arguments
    "abs": (1, 1, abs),
    "min": (2, 9, min),
    "max": (2, 9, max),
    "floor": (1, 1, lambda value: float(math.floor(value))),
    "ceil": (1, 1, lambda value: float(math.ceil(value))),
    "sqrt": (1, 1, math.sqrt),
}
_BINARY: Mapping[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: lambda one, other: one + other,
    ast.Sub: lambda one, other: one - other,
    ast.Mult: lambda one, other: one * other,
    ast.Div: lambda one, other: one / other,
}
_COMPARISONS: Mapping[type[ast.cmpop], Callable[[float, float], bool]] = {
    ast.Lt: lambda one, other: one < other,
    ast.LtE: lambda one, other: one <= other,
    ast.Gt: lambda one, other: one > other,
    ast.GtE: lambda one, other: one >= other,
    ast.Eq: lambda one, other: one == other,
    ast.NotEq: lambda one, other: one != other,
}


_OTHER_SIGNS = (  # of other languages, by how they are read here
    (r"\s*&&?\s*", " and "),
    (r"\s*\|\|?\s*", " or "),
    (r"!(?!=)\s*", "not "),
    (r"=<", "<="),
    (r"=>", ">="),
    (r"<>", "!="),
    (r"(?<![<>=!])=(?!=)", "=="),
    (r"\bAND\b", "and"),
    (r"\bOR\b", "or"),
    (r"\bNOT\b", "not"),
)


class ExpressionError(Exception):
    """A text that is no expression, or values for which it has none; the message says why.

    `meant` is an expression that says the same in signs that are known here, "" if none does.
    """

    def __init__(self, message: str, meant: str = "") -> None:
        super().__init__(message)
        self.meant = meant


@dataclass(frozen=True, slots=True)
class Expression:
    """An expression and the parameters that it reads, in the order of their first use."""

    root: ast.expr
    names: tuple[str, ...]

    def value(self, values: Mapping[str, float]) -> float:
        """The value for given values of its parameters; raises ExpressionError where there is none."""
        try:
            found = _evaluate(self.root, values)
        except (ZeroDivisionError, ValueError, OverflowError) as problem:
            given = ", ".join(f"{name} = {values[name]:g}" for name in self.names)
            raise ExpressionError(f"it has no value for {given}: {problem}") from problem
        if not abs(found) < HALF_INF:
            raise ExpressionError("its value is not finite, or 2^51 or more in size, which cannot be held")
        return found

    def limit(self, values: Mapping[str, float]) -> float:
        """The value where some may be infinite; NaN where there is none."""
        try:
            return _evaluate(self.root, values)
        except (ZeroDivisionError, ValueError, OverflowError):
            return math.nan


@lru_cache(maxsize=256)
def parse_expression(text: str) -> Expression:
    """Read a text; raises ExpressionError where it is none."""
    if len(text) > _LONGEST:
        raise ExpressionError(f"it is longer than {_LONGEST} characters")
    try:
        return _read(text)
    except ExpressionError as problem:
        raise ExpressionError(str(problem), _meant(text)) from None


def _read(text: str) -> Expression:
    try:
        root = ast.parse(text.strip(), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise ExpressionError("this is no arithmetic") from None
    names: dict[str, None] = {}
    _look_through(root, names, 0)
    return Expression(root, tuple(names))


def _meant(text: str) -> str:
    """The text with signs of other languages as they are written here; "" where that is no expression either."""
    found = text
    for sign, ours in _OTHER_SIGNS:
        found = re.sub(sign, ours, found)
    try:
        return found if _read(found).names else ""
    except ExpressionError:
        return ""


def _look_through(node: ast.AST, names: dict[str, None], depth: int) -> None:
    """Refuse all that is not known, and note the names."""
    if depth > _DEEPEST:
        raise ExpressionError("it is nested too deep")
    inner: list[ast.expr]
    match node:
        case ast.Constant(value=int() | float() as value) if not isinstance(value, bool) and abs(value) < 1e300:
            inner = []
        case ast.Name(id=name):
            names.setdefault(name)
            inner = []
        case ast.UnaryOp(op=ast.USub() | ast.UAdd() | ast.Not(), operand=operand):
            inner = [operand]
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _BINARY:
            inner = [left, right]
        case ast.Compare(left=left, ops=ops, comparators=others) if all(type(op) in _COMPARISONS for op in ops):
            inner = [left, *others]
        case ast.BoolOp(values=values):
            inner = values
        case ast.IfExp(test=test, body=body, orelse=other):
            inner = [test, body, other]
        case ast.Call(func=ast.Name(id=name), args=args, keywords=[]) if name in _FUNCTIONS:
            least, most, _ = _FUNCTIONS[name]
            if not least <= len(args) <= most:
                raise ExpressionError(f"`{name}` takes {least} to {most} arguments")
            inner = args
        case ast.Call(func=ast.Name(id=name)):
            raise ExpressionError(f"there is no function `{name}`; there are {', '.join(_FUNCTIONS)}")
        case _:
            raise ExpressionError(f"`{ast.unparse(node)}` is no arithmetic")
    for each in inner:
        _look_through(each, names, depth + 1)


def _evaluate(node: ast.expr, values: Mapping[str, float]) -> float:
    match node:
        case ast.Constant(value=value):
            assert isinstance(value, int | float)
            return float(value)
        case ast.Name(id=name):
            return values[name]
        case ast.UnaryOp(op=op, operand=operand):
            found = _evaluate(operand, values)
            return float(not found) if isinstance(op, ast.Not) else -found if isinstance(op, ast.USub) else found
        case ast.BinOp(left=left, op=operator, right=right):
            return _BINARY[type(operator)](_evaluate(left, values), _evaluate(right, values))
        case ast.Compare(left=left, ops=ops, comparators=others):
            terms = [_evaluate(each, values) for each in (left, *others)]
            return float(
                all(_COMPARISONS[type(op)](one, other) for op, one, other in zip(ops, terms, terms[1:], strict=False))
            )
        case ast.BoolOp(op=junction, values=terms_of):
            truths = [bool(_evaluate(each, values)) for each in terms_of]
            return float(all(truths) if isinstance(junction, ast.And) else any(truths))
        case ast.IfExp(test=test, body=body, orelse=other):
            return _evaluate(body if _evaluate(test, values) else other, values)
        case ast.Call(func=ast.Name(id=name), args=args):
            return float(_FUNCTIONS[name][2](*(_evaluate(each, values) for each in args)))
        case _:
            raise AssertionError(node)
