"""Turn types and literal values of the schema into those of the program, folding arithmetic on the way."""

from collections.abc import Mapping
from typing import assert_never

from compiler.program import DomainConstant, TypeCode
from nddl_lang.semantics.schema import (
    INFINITY,
    Domain,
    EnumValue,
    Interval,
    Kind,
    Reference,
    Type,
    Values,
)
from nddl_lang.syntax.nodes import (
    BinaryExpr,
    BoolLiteral,
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

_TOKEN_STATES = "TokenStates"  # the enum behind the built-in variable `state`
TRUE = DomainConstant("bool", "bool", None, (True,))
FALSE = DomainConstant("bool", "bool", None, (False,))


def type_code(type_: Type) -> TypeCode:
    """`type_` as the program writes it."""
    kind, name = type_.kind.value, type_.base
    if name == _TOKEN_STATES:
        kind, name = "symbol", "symbol"
    code = TypeCode(kind, name, None)
    if type_.restriction is None:
        return code
    return TypeCode(kind, name, _of_domain(type_.restriction, code))


def basic(kind: Kind) -> TypeCode:
    """The unrestricted type of a basic kind."""
    return TypeCode(kind.value, kind.value, None)


def interval(lower: int, upper: int) -> DomainConstant:
    """All integers from `lower` to `upper`."""
    return DomainConstant("int", "int", (lower, upper), None)


def converted(domain: DomainConstant, code: TypeCode) -> DomainConstant:
    """`domain` as a set of values of the type `code`: 2 becomes 2.0 for a float, 1 true for a bool."""
    if domain.kind == code.kind or code.kind not in ("int", "float", "bool"):
        return DomainConstant(code.kind, code.type_name, domain.interval, domain.values)
    values = None if domain.values is None else tuple(_value(value, code.kind) for value in domain.values)
    bounds = None
    if domain.interval is not None:
        lower, upper = domain.interval
        if code.kind == "bool":
            values = tuple(truth for truth in (False, True) if lower <= truth <= upper)
        else:
            bounds = (_limit(lower, code.kind, upwards=True), _limit(upper, code.kind, upwards=False))
    return DomainConstant(code.kind, code.type_name, bounds, values)


def constant(expr: Expr, references: Mapping[object, Reference]) -> DomainConstant | None:
    """The domain that `expr` denotes if it holds nothing but literals; None where a variable is involved."""
    match expr:
        case IntLiteral(value=number):
            return DomainConstant("int", "int", None, (number,))
        case FloatLiteral(value=real):
            return DomainConstant("float", "float", None, (real,))
        case BoolLiteral(value=truth):
            return TRUE if truth else FALSE
        case StringLiteral(value=text):
            return DomainConstant("string", "string", None, (text,))
        case PathExpr():
            reference = references.get(expr)
            return enum_value(reference) if isinstance(reference, EnumValue) else None
        case IntervalExpr(lower=lower, upper=upper):
            return _interval(constant(lower, references), constant(upper, references))
        case SetExpr(items=items):
            return _set([constant(item, references) for item in items])
        case UnaryExpr(op=op, operand=operand):
            return _unary(op, constant(operand, references))
        case BinaryExpr(op=op, left=left, right=right):
            return _binary(op, constant(left, references), constant(right, references))
        case NewExpr() | CallExpr():
            return None
        case _:
            assert_never(expr)


def single(domain: DomainConstant | None) -> float | int | bool | str | None:
    """The only value of `domain`, if it has just one."""
    if domain is None or domain.values is None or len(domain.values) != 1:
        return None
    return domain.values[0]


def _of_domain(domain: Domain, code: TypeCode) -> DomainConstant:
    match domain:
        case Interval(lower=lower, upper=upper):
            kind = "float" if isinstance(lower, float) or isinstance(upper, float) else "int"
            single_value = (lower,) if lower == upper else None
            return converted(DomainConstant(kind, kind, None if single_value else (lower, upper), single_value), code)
        case Values(items=items):
            kind = "float" if any(isinstance(item, float) for item in items) else "int"
            if not all(isinstance(item, int | float) and not isinstance(item, bool) for item in items):
                kind = code.kind
            return converted(DomainConstant(kind, code.type_name, None, items), code)
        case _:
            assert_never(domain)


def enum_value(value: EnumValue) -> DomainConstant:
    """The value of an enum, or one of the states of a token."""
    if value.enum == _TOKEN_STATES:
        return DomainConstant("symbol", "symbol", None, (value.value,))
    return DomainConstant("enum", value.enum, None, (value.value,))


def _interval(lower: DomainConstant | None, upper: DomainConstant | None) -> DomainConstant | None:
    low, high = single(lower), single(upper)
    if not isinstance(low, int | float) or not isinstance(high, int | float):
        return None
    kind = "float" if isinstance(low, float) or isinstance(high, float) else "int"
    if low == high:
        return DomainConstant(kind, kind, None, (_number(low, kind),))
    return converted(DomainConstant(kind, kind, (_number(low, kind), _number(high, kind)), None), basic(Kind(kind)))


def _set(items: list[DomainConstant | None]) -> DomainConstant | None:
    values: list[float | int | bool | str] = []
    kinds: list[tuple[str, str]] = []
    for item in items:
        if item is None or item.values is None:
            return None
        kinds.append((item.kind, item.type_name))
        values += item.values
    kind, name = ("float", "float") if ("float", "float") in kinds else kinds[0]
    if kind in ("int", "float"):
        values = [_value(value, kind) for value in values]
    return DomainConstant(kind, name, None, tuple(dict.fromkeys(values)))


def _unary(op: str, operand: DomainConstant | None) -> DomainConstant | None:
    value = single(operand)
    if operand is None or value is None:
        return None
    if op == "!" and operand.kind == "bool":
        return FALSE if value else TRUE
    if op == "-" and operand.kind in ("int", "float") and not isinstance(value, str):
        return DomainConstant(operand.kind, operand.kind, None, (-value,))
    return None


def _binary(op: str, left: DomainConstant | None, right: DomainConstant | None) -> DomainConstant | None:
    a, b = single(left), single(right)
    numeric = ("int", "float")
    if left is None or right is None or left.kind not in numeric or right.kind not in numeric:
        return None
    if a is None or b is None or isinstance(a, str) or isinstance(b, str):
        return None
    kind = "float" if "float" in (left.kind, right.kind) else "int"
    result: float | int
    match op:
        case "+":
            result = a + b
        case "-":
            result = a - b
        case "*":
            result = a * b
        case "/" if b != 0 and (kind == "float" or a % b == 0):
            result = a / b if kind == "float" else int(a) // int(b)
        case _:
            return None
    result = _number(max(-INFINITY, min(result, INFINITY)), kind)
    return DomainConstant(kind, kind, None, (result,))


def _value(value: float | int | bool | str, kind: str) -> float | int | bool | str:
    """`value` as one of the kind, where it can be one."""
    if isinstance(value, str):
        return value
    return bool(value) if kind == "bool" else _number(value, kind)


def _number(value: float | int, kind: str) -> float | int:
    if kind == "float":
        return float(value)
    return int(value) if kind == "int" and value == int(value) else value


def _limit(value: float | int, kind: str, *, upwards: bool) -> float | int:
    """The bound next to `value` that the kind can hold, rounded into the interval."""
    if kind == "float":
        return float(value)
    whole = int(value)
    if whole == value:
        return whole
    return whole + (1 if upwards and value > 0 else 0) - (1 if not upwards and value < 0 else 0)
