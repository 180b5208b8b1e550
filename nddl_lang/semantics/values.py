"""Check that a value fits the variable that it is given to, and read the values that a text fixes."""

from nddl_lang.semantics import domains
from nddl_lang.semantics.codes import DOES_NOT_FIT, OUTSIDE_TYPE
from nddl_lang.semantics.expressions import type_of
from nddl_lang.semantics.literals import is_infinite, number, whole_beside
from nddl_lang.semantics.meant import member_meant
from nddl_lang.semantics.schema import (
    Domain,
    EnumValue,
    GlobalReference,
    Interval,
    Kind,
    MemberReference,
    Reference,
    TokenVariableReference,
    Type,
    Values,
)
from nddl_lang.semantics.scope import Context, Scope
from nddl_lang.semantics.types import fits, phrase
from nddl_lang.syntax.nodes import (
    BinaryExpr,
    BoolLiteral,
    Expr,
    FloatLiteral,
    IntervalExpr,
    IntLiteral,
    NewExpr,
    PathExpr,
    SetExpr,
    StringLiteral,
    UnaryExpr,
    VariableDecl,
)
from nddl_lang.text.diagnostic import Edit, Fix


def check_value(
    context: Context, scope: Scope, expression: Expr, target: Type, name: str, declared: VariableDecl | None = None
) -> Type | None:
    """Complain where `expression` cannot be the value of variable `name`; its type, None after a complaint.

    `declared`: the value stands in that declaration.
    """
    type_ = type_of(context, scope, expression)
    if type_ is None:
        return None
    if not _fits(context, expression, type_, target):
        _complain_misfit(context, expression, type_, target, name, declared)
        return None
    return type_ if check_restriction(context, expression, target, name) else None


def check_restriction(context: Context, expression: Expr, target: Type, name: str) -> bool:
    """Complain about values outside the domain of a typedef or of a native parameter; whether there are none."""
    allowed = target.restriction
    value = constant(context, expression) if allowed is not None else None
    if allowed is None or value is None:
        return True
    if isinstance(expression, SetExpr):
        outside = [item for item in expression.items if not check_restriction(context, item, target, name)]
        return not outside
    if domains.intersect(value, allowed, target.kind) is not None:
        return True
    label = name if target.name == target.base else target.name
    text = expression.span.text
    context.complain(OUTSIDE_TYPE.at(expression.span, text=text, type=label, domain=domains.text(allowed)))
    return False


def constant(context: Context, expression: Expr) -> Domain | None:
    """The values that a literal, a domain or a variable with a known base domain stands for, None where unknown."""
    match expression:
        case IntLiteral(value=value) | FloatLiteral(value=value):
            return Values((value,))
        case BoolLiteral(value=truth):
            return Values((truth,))
        case StringLiteral(value=characters):
            return Values((characters,))
        case UnaryExpr() | BinaryExpr():
            computed = number(expression)
            return None if computed is None else Values((computed,))
        case IntervalExpr(lower=lower, upper=upper):
            bounds = number(lower), number(upper)
            return None if bounds[0] is None or bounds[1] is None else Interval(bounds[0], bounds[1])
        case SetExpr(items=items):
            return _set_constant(context, items)
        case PathExpr():
            return _path_constant(context, expression)
        case _:
            return None


def _set_constant(context: Context, items: tuple[Expr, ...]) -> Domain | None:
    values: list[float | int | bool | str] = []
    for item in items:
        domain = constant(context, item)
        if not isinstance(domain, Values):
            return None
        values += domain.items
    return Values(tuple(values))


def _path_constant(context: Context, path: PathExpr) -> Domain | None:
    reference = context.tables.references.get(path)
    if isinstance(reference, EnumValue):
        return Values((reference.value,))
    key = domain_key(context, path)
    return context.symbols.base_domain(key) if key is not None else None


def domain_key(context: Context, path: PathExpr) -> str | None:
    """The name under which the symbol table keeps the base domain of a variable of the script, None for any other."""
    reference = context.tables.references.get(path)
    return reference_key(context, reference) if reference is not None else None


def reference_key(context: Context, reference: Reference) -> str | None:
    """The name under which the symbol table keeps the base domain of `reference`, None where it keeps none."""
    match reference:
        case GlobalReference(variable=variable):
            return variable.name
        case TokenVariableReference(label=label, name=name) if context.symbols.find_goal(label.name) is label:
            return f"{label.name}.{name}"
        case MemberReference(base=GlobalReference(variable=variable), members=members):
            return ".".join((variable.name, *(member.name for member in members)))
        case _:
            return None


def _fits(context: Context, expression: Expr, found: Type, target: Type) -> bool:
    if isinstance(expression, NewExpr):
        return target.kind is Kind.OBJECT and context.symbols.is_subclass(found.base, target.base)
    if fits(found, target, context.symbols.is_subclass):
        return True
    if target.kind is not Kind.INT or found.kind is not Kind.FLOAT:
        return False
    match expression:
        case IntervalExpr(lower=lower, upper=upper):
            return all(isinstance(bound, IntLiteral) or is_infinite(bound) for bound in (lower, upper))
        case _:
            return is_infinite(expression)


def _complain_misfit(
    context: Context, expression: Expr, found: Type, target: Type, name: str, declared: VariableDecl | None
) -> None:
    """Point at the first part of the value that does not fit, or at all of it."""
    part, part_type = expression, found
    parts: tuple[Expr, ...] = ()
    match expression:
        case SetExpr(items=items):
            parts = items
        case IntervalExpr(lower=lower, upper=upper):
            parts = (lower, upper)
    for candidate in parts:
        type_ = context.tables.types.get(candidate)
        if type_ is not None and not _fits(context, candidate, type_, target):
            part, part_type = candidate, type_
            break
    help_, fixes = member_meant(context, part, part_type, target)
    if help_ is None:
        help_, fixes = _mend(part, target, name, declared)
    context.complain(
        DOES_NOT_FIT.at(
            part.span,
            help=help_,
            fixes=fixes,
            text=part.span.text,
            found=phrase(part_type),
            name=name,
            wanted=phrase(target),
        )
    )


def _mend(value: Expr, target: Type, name: str, declared: VariableDecl | None) -> tuple[str | None, tuple[Fix, ...]]:
    """What helps where a value does not fit, in words and as fixes."""
    if target.kind is Kind.INT and (fixes := whole_beside(number(value), value.span)):
        if declared is not None and len(declared.declarators) == 1 and declared.type_name.span.text == "int":
            as_float = Fix(f"declare `{name}` as a `float`", (Edit(declared.type_name.span, "float"),), safe=False)
            fixes = (as_float, *fixes)
        return f"write a whole number, or declare `{name}` as a `float`", fixes
    text: str | None = None
    match value:
        case FloatLiteral(value=real) if target.kind is Kind.INT and real.is_integer():
            text = str(int(real))
        case IntLiteral(value=0 | 1 as truth) if target.kind is Kind.BOOL:
            text = "true" if truth else "false"
        case BoolLiteral(value=truth) if target.kind is Kind.INT:
            text = str(int(truth))
        case StringLiteral(value=characters) if target.kind is Kind.ENUM and characters.isidentifier():
            text = characters
    return None, () if text is None else (Fix(f"write `{text}`", (Edit(value.span, text),)),)
