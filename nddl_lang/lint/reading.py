"""Expressions in, the values that they can have out, as far as the declarations alone tell."""

from nddl_lang.lint.part import Key, Part, parameter_of
from nddl_lang.semantics import domains
from nddl_lang.semantics.literals import number
from nddl_lang.semantics.natives import LEAST_DURATION
from nddl_lang.semantics.schema import (
    INFINITY,
    Domain,
    EnumValue,
    GlobalReference,
    Interval,
    Kind,
    LocalReference,
    Predicate,
    Reference,
    TokenVariableReference,
    Type,
    Values,
    Variable,
)
from nddl_lang.syntax.nodes import (
    Assignment,
    BoolLiteral,
    CallConstraint,
    Expr,
    ExprConstraint,
    IntervalExpr,
    PathExpr,
    SetExpr,
    StringLiteral,
    VariableDecl,
)

_BOOLEANS = Values((False, True))


def written(expression: Expr, kind: Kind) -> Domain | None:
    """The values that an expression of literals stands for; in an enum's variable names are its values."""
    if (value := number(expression)) is not None:
        return Values((value,))
    match expression:
        case BoolLiteral(value=truth):
            return Values((truth,))
        case StringLiteral(value=text):
            return Values((text,))
        case IntervalExpr(lower=lower, upper=upper):
            least, most = number(lower), number(upper)
            return None if least is None or most is None or least > most else Interval(least, most)
        case SetExpr(items=items):
            values: list[float | int | bool | str] = []
            for item in items:
                domain = written(item, kind)
                if not isinstance(domain, Values):
                    return None
                values += domain.items
            return Values(tuple(values))
        case _:
            return None


def declared(variable: Variable) -> Domain | None:
    """What the declaration of a variable leaves of its type; a superset of what it ever holds, None where unknown."""
    known = variable.type.restriction
    if known is None and variable.type.kind is Kind.BOOL:
        known = _BOOLEANS
    given = written(variable.initialiser, variable.type.kind) if variable.initialiser is not None else None
    if given is None or known is None:
        return given if known is None else known
    return domains.intersect(known, given, variable.type.kind) or known


def key_of(reference: Reference | None) -> Key | None:
    """What tells a variable from all others, for those that have a domain of their own."""
    match reference:
        case LocalReference(variable=variable) | GlobalReference(variable=variable):
            return variable, ""
        case TokenVariableReference(label=label, name=name):
            return label, name
        case _:
            return None


def domain_of(part: Part, expression: Expr) -> Domain | None:
    """The values that a literal, a domain or a variable can have, None where nothing is known."""
    reference = part.reference(expression) if isinstance(expression, PathExpr) else None
    match reference:
        case None:
            return None if isinstance(expression, PathExpr) else _written_in(part, expression)
        case EnumValue(value=value):
            return Values((value,))
        case LocalReference(variable=variable) | GlobalReference(variable=variable):
            return declared(variable)
        case TokenVariableReference(label=label, name=name, type=type_):
            return token_domain(label.predicate, name, type_)
        case _:
            return None


def _written_in(part: Part, expression: Expr) -> Domain | None:
    if isinstance(expression, SetExpr):
        values: list[float | int | bool | str] = []
        for item in expression.items:
            domain = domain_of(part, item)
            if not isinstance(domain, Values):
                return None
            values += domain.items
        return Values(tuple(values))
    return written(expression, Kind.INT)


def token_domain(predicate: Predicate, name: str, type_: Type) -> Domain | None:
    """What the declaration of a predicate leaves to a variable of its tokens."""
    if name in ("state", "object"):
        return None
    known: Domain | None = None
    if name == "duration" and not predicate.is_event:
        known = LEAST_DURATION
    elif (parameter := parameter_of(predicate, name)) is not None:
        known = declared(parameter)
    for given in _body_domains(predicate, name, type_.kind):
        known = given if known is None else domains.intersect(known, given, type_.kind) or known
    return known


def _body_domains(predicate: Predicate, name: str, kind: Kind) -> list[Domain]:
    """What assignments and plain comparisons in the bodies of a predicate say about one variable of its tokens."""
    found: list[Domain] = []
    for node in predicate.nodes:
        for statement in node.body:
            given: Domain | None = None
            match statement:
                case Assignment(target=target, value=value) if _is_bare(target, name):
                    given = written(value, kind)
                case CallConstraint(name=call, arguments=(PathExpr() as first, second)) if call.name == "eq":
                    given = written(second, kind) if _is_bare(first, name) else None
                case ExprConstraint(expression=expression):
                    given = _compared(expression, name)
                case VariableDecl():
                    pass
            if given is not None:
                found.append(given)
    return found


def _is_bare(path: Expr, name: str) -> bool:
    """Whether an expression is just this name."""
    return isinstance(path, PathExpr) and len(path.parts) == 1 and path.parts[0].name == name


def _compared(expression: Expr, name: str) -> Domain | None:
    """What `name op number` leaves to `name`."""
    op, left, right = (getattr(expression, each, None) for each in ("op", "left", "right"))
    if left is None or right is None or not _is_bare(left, name):
        return None
    if op == "==":
        return written(right, Kind.INT)
    value = number(right)
    return None if value is None else bounded(str(op), value)


def bounded(op: str, value: float | int) -> Interval | None:
    """The numbers x with `x op value`; a strict bound counts as one that is not."""
    match op:
        case "<" | "<=":
            return Interval(-INFINITY, value)
        case ">" | ">=":
            return Interval(value, INFINITY)
        case _:
            return None


def is_finite(type_: Type, domain: Domain | None) -> bool:
    """Whether a search can go through the values of a variable: such a variable is decided, others only propagated."""
    if type_.kind in (Kind.BOOL, Kind.ENUM, Kind.OBJECT):
        return True
    if isinstance(domain, Values):
        return True
    if isinstance(domain, Interval):
        return domain.lower == domain.upper or (
            type_.kind is Kind.INT and domain.lower > -INFINITY and domain.upper < INFINITY
        )
    return False
