"""Give every expression its type; tell the user where operands do not go together."""

import re

from nddl_lang.semantics.arguments import check_count, check_types
from nddl_lang.semantics.codes import (
    ALWAYS_DIFFERENT,
    INCOMPARABLE,
    MIXED_ARITHMETIC,
    MIXED_SET,
    NO_ORDER,
    NOT_A_BOUND,
    NOT_A_CONDITION,
    NOT_A_NUMBER,
    NOT_IN_NDDL3,
    REVERSED_INTERVAL,
    SUM_OF_TIMES,
    UNKNOWN_FUNCTION,
)
from nddl_lang.semantics.constraints import Origin
from nddl_lang.semantics.functions import OTHER_FUNCTIONS, FunctionRow, ResultKind
from nddl_lang.semantics.literals import number
from nddl_lang.semantics.meant import (
    comparison_meant,
    is_token_in,
    member_meant,
    number_meant,
    other_parameters,
    parameter_meant,
    relation_meant,
    value_meant,
    variable_meant,
)
from nddl_lang.semantics.names import name_beside, resolve_value, suggest_name
from nddl_lang.semantics.natives import TIME_NAMES
from nddl_lang.semantics.sampled import sampled_parameter
from nddl_lang.semantics.schema import Kind, TokenVariableReference, Type
from nddl_lang.semantics.scope import Context, Scope
from nddl_lang.semantics.types import (
    BOOL,
    COUNTABLE,
    FLOAT,
    INT,
    NUMBERS,
    STRING,
    always_differ,
    comparable,
    object_type,
    phrase,
    plain,
    reference_type,
)
from nddl_lang.syntax.dialect import Dialect
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
from nddl_lang.text.diagnostic import Edit, Fix

NO_ENVIRONMENT = "give the value from outside: compare with a number, or with a global variable that the script assigns"

_CALLED = re.compile(r"`(\w+)\(")
_ORDERS = frozenset({"<", "<=", ">", ">="})
_EQUALITIES = frozenset({"==", "!="})
_LOGIC = frozenset({"&&", "||"})


def type_of(context: Context, scope: Scope, expression: Expr, compared: str | None = None) -> Type | None:
    """The type of `expression`, noted in the tables with those of its parts; None where a complaint was made."""
    # Chains such as a + b + c lean to the left, however long; they are walked, not recursed into.
    chain: list[BinaryExpr] = []
    while isinstance(expression, BinaryExpr):
        chain.append(expression)
        expression = expression.left
    compared = name_beside(chain[-1], chain[-1].right) if chain else compared
    type_ = _simple_type(context, scope, expression, compared)
    for binary in reversed(chain):
        right = type_of(context, scope, binary.right, name_beside(binary, binary.left))
        type_ = _binary_type(context, binary, type_, right)
        if type_ is not None:
            context.tables.types[binary] = type_
    return type_


def check_condition(context: Context, scope: Scope, expression: Expr) -> None:
    """Complain about an expression that has no truth value where one is needed."""
    type_ = type_of(context, scope, expression)
    if type_ is not None and type_.kind is not Kind.BOOL:
        complaint = NOT_A_CONDITION.at(expression.span, text=expression.span.text, found=phrase(type_))
        context.complain(complaint)


def check_guard(context: Context, scope: Scope, expression: Expr) -> None:
    """Like `check_condition`; the name of an object variable holds as a guard once the variable is decided."""
    type_ = type_of(context, scope, expression)
    is_object = isinstance(expression, PathExpr) and type_ is not None and type_.kind is Kind.OBJECT
    if type_ is not None and type_.kind is not Kind.BOOL and not is_object:
        complaint = NOT_A_CONDITION.at(expression.span, text=expression.span.text, found=phrase(type_))
        context.complain(complaint)


def _simple_type(context: Context, scope: Scope, expression: Expr, compared: str | None) -> Type | None:
    type_: Type | None
    if isinstance(expression, PathExpr):
        reference = resolve_value(context, scope, expression, compared)
        type_ = reference_type(reference, scope.own_class) if reference is not None else None
    elif isinstance(expression, IntLiteral):
        type_ = INT
    elif isinstance(expression, FloatLiteral):
        type_ = FLOAT
    elif isinstance(expression, BoolLiteral):
        type_ = BOOL
    elif isinstance(expression, StringLiteral):
        type_ = STRING
    elif isinstance(expression, CallExpr):
        type_ = _call_type(context, scope, expression)
    elif isinstance(expression, IntervalExpr):
        type_ = _interval_type(context, scope, expression)
    elif isinstance(expression, SetExpr):
        type_ = _set_type(context, scope, expression)
    elif isinstance(expression, UnaryExpr):
        type_ = _unary_type(context, scope, expression)
    else:
        assert isinstance(expression, NewExpr)
        known = context.symbols.find_class(expression.class_name.name) is not None
        type_ = object_type(expression.class_name.name) if known else None
    if type_ is not None:
        context.tables.types[expression] = type_
    return type_


def _binary_type(context: Context, binary: BinaryExpr, left: Type | None, right: Type | None) -> Type | None:
    op = binary.op
    if op in _EQUALITIES:
        _check_equality(context, binary, left, right)
        return BOOL
    if op in _ORDERS:
        for side, type_ in ((binary.left, left), (binary.right, right)):
            if type_ is not None and type_.kind not in COUNTABLE:
                if left is None and is_token_in(context, binary.left):
                    break  # told of the left side
                help_, fixes = relation_meant(context, binary)
                if help_ is None:
                    help_, fixes = member_meant(context, side, type_)
                fixes = fixes or (number_meant(side, FLOAT) if isinstance(side, StringLiteral) else ())
                help_ = help_ or (f"{fixes[0].title}, without quotes" if fixes else None)
                text, found = side.span.text, phrase(type_)
                context.complain(NO_ORDER.at(side.span, op=op, text=text, found=found, help=help_, fixes=fixes))
                break
        return BOOL
    if op in _LOGIC:
        for side, type_ in ((binary.left, left), (binary.right, right)):
            if type_ is not None and type_.kind is not Kind.BOOL:
                help_, fixes = comparison_meant(binary, side)
                text = side.span.text
                complaint = NOT_A_CONDITION.at(side.span, text=text, found=phrase(type_), help=help_, fixes=fixes)
                context.complain(complaint)
        return BOOL
    return _arithmetic_type(context, binary, left, right)


def _check_equality(context: Context, binary: BinaryExpr, left: Type | None, right: Type | None) -> None:
    if left is None or right is None:
        return
    if not comparable(left, right, context.symbols.is_subclass):
        differing = binary.op == "!=" and always_differ(left, right)
        helps: list[str] = []
        fixes: list[Fix] = []
        for side, type_, other in ((binary.left, left, right), (binary.right, right, left)):
            help_, owned = member_meant(context, side, type_, other)
            helps += () if help_ is None else (help_,)
            fixes += (*owned, *parameter_meant(context, side, other))
            fixes += (*number_meant(side, other), *value_meant(context, side, other))
        context.complain(
            (ALWAYS_DIFFERENT if differing else INCOMPARABLE).at(
                binary.span,
                help=helps[0] if helps else None,
                fixes=tuple(fixes) or other_parameters(context, binary, left, right),
                left=binary.left.span.text,
                one=phrase(left),
                right=binary.right.span.text,
                other=phrase(right),
            )
        )
    for total, time in ((binary.left, binary.right), (binary.right, binary.left)):
        if _is_time(context, time) and _is_sum_of_times(context, total):
            context.complain(SUM_OF_TIMES.at(total.span, help="add a duration or a distance to a time instead"))


def _is_time(context: Context, expression: Expr) -> bool:
    reference = context.tables.references.get(expression)
    return isinstance(reference, TokenVariableReference) and reference.name in TIME_NAMES


def _is_sum_of_times(context: Context, expression: Expr) -> bool:
    if not isinstance(expression, BinaryExpr) or expression.op != "+":
        return False
    return _is_time(context, expression.left) and _is_time(context, expression.right)


def _arithmetic_type(context: Context, binary: BinaryExpr, left: Type | None, right: Type | None) -> Type | None:
    for side, type_ in ((binary.left, left), (binary.right, right)):
        if type_ is not None and type_.kind not in NUMBERS:
            help_, fixes = member_meant(context, side, type_)
            complaint = NOT_A_NUMBER.at(
                side.span,
                op=binary.op,
                text=side.span.text,
                found=phrase(type_),
                help=help_,
                fixes=fixes,
            )
            context.complain(complaint)
            return None
    if left is None or right is None:
        return None
    if left.kind is not right.kind and context.dialect is Dialect.NDDL3:
        context.complain(
            MIXED_ARITHMETIC.at(
                binary.span,
                help="copy the int into a float variable with `eq` first",
                left=binary.left.span.text,
                one=phrase(left),
                right=binary.right.span.text,
                other=phrase(right),
            )
        )
        return FLOAT
    return INT if left.kind is Kind.INT and right.kind is Kind.INT and binary.op != "/" else FLOAT


def _unary_type(context: Context, scope: Scope, unary: UnaryExpr) -> Type | None:
    # A run of signs such as - - - x is walked, not recursed into.
    run = [unary]
    while isinstance(run[-1].operand, UnaryExpr):
        run.append(run[-1].operand)
    type_ = type_of(context, scope, run[-1].operand)
    for sign in reversed(run):
        type_ = _signed_type(context, sign, type_)
        if type_ is not None:
            context.tables.types[sign] = type_
    return type_


def _signed_type(context: Context, unary: UnaryExpr, operand: Type | None) -> Type | None:
    if unary.op == "!":
        if operand is not None and operand.kind is not Kind.BOOL:
            text = unary.operand.span.text
            context.complain(NOT_A_CONDITION.at(unary.operand.span, text=text, found=phrase(operand)))
        return BOOL
    if operand is None:
        return None
    if operand.kind not in NUMBERS:
        text, (help_, fixes) = unary.operand.span.text, member_meant(context, unary.operand, operand)
        complaint = NOT_A_NUMBER.at(
            unary.operand.span, op=unary.op, text=text, found=phrase(operand), help=help_, fixes=fixes
        )
        context.complain(complaint)
        return None
    return plain(operand)


def _interval_type(context: Context, scope: Scope, interval: IntervalExpr) -> Type | None:
    kinds: list[Kind] = []
    for bound in (interval.lower, interval.upper):
        type_ = type_of(context, scope, bound)
        if type_ is None:
            continue
        if isinstance(bound, StringLiteral | BoolLiteral) or (number(bound) is None and _is_strict(context)):
            pass  # The parser has complained.
        elif number(bound) is None:
            advice = "compare with it instead, as in `x <= limit`, of two times `b.start <= a.end + limit`"
            help_ = advice if type_.kind in NUMBERS else None
            context.complain(NOT_A_BOUND.at(bound.span, help=help_, text=bound.span.text))
        else:
            kinds.append(type_.kind)
    lower, upper = number(interval.lower), number(interval.upper)
    if lower is not None and upper is not None and lower > upper:
        first, second = interval.lower.span.text, interval.upper.span.text
        is_apart = interval.lower.span.finish < interval.upper.span.begin and second[1:2] != " "
        is_dash = second[:1] == "-" and not is_apart and 0.0 <= lower < -upper
        swap = f"[{first} {second[1:].strip()}]" if is_dash else f"[{second} {first}]"
        fix = Fix(f"write `{swap}`", (Edit(interval.span, swap),), safe=False)
        help_ = f"between the bounds stands no `-`: write `{swap}`" if is_dash else None
        context.complain(REVERSED_INTERVAL.at(interval.span, help=help_, fixes=(fix,), lower=first, upper=second))
        return None
    if len(kinds) < 2:
        return None
    return FLOAT if Kind.FLOAT in kinds else INT


def _is_strict(context: Context) -> bool:
    return context.dialect is Dialect.NDDL3


def _set_type(context: Context, scope: Scope, values: SetExpr) -> Type | None:
    first: tuple[Expr, Type] | None = None
    result: Type | None = None
    for item in values.items:
        type_ = type_of(context, scope, item)
        if type_ is None:
            continue
        if first is None or result is None:
            first, result = (item, type_), plain(type_)
        elif type_.kind in NUMBERS and result.kind in NUMBERS:
            result = FLOAT if Kind.FLOAT in (type_.kind, result.kind) else INT
        elif type_.kind is not result.kind or not comparable(type_, result, context.symbols.is_subclass):
            context.complain(
                MIXED_SET.at(
                    item.span,
                    text=item.span.text,
                    found=phrase(type_),
                    first=first[0].span.text,
                    expected=phrase(first[1]),
                )
            )
            return None
        elif type_.kind is Kind.OBJECT and context.symbols.is_subclass(result.base, type_.base):
            result = plain(type_)
    return result


def _call_type(context: Context, scope: Scope, call: CallExpr) -> Type | None:
    name = call.function.name
    row = context.callables.functions.get(name)
    if row is None:
        for argument in call.arguments:
            type_of(context, scope, argument)
        if context.callables.has_gaps and name not in context.callables.constraints:
            return None
        spellings = (name, name[0].upper() + name[1:])
        if made := next((one for one in spellings if context.symbols.find_class(one) is not None), ""):
            at = call.function.span
            fix = Fix(f"write `new {made}`", (Edit(at, f"new {made}"),), False)
            help_ = f"`{made}` is a class: an object of it is made by `new {made}(...)`"
            context.symbols.put_faulty("new")
            context.complain(UNKNOWN_FUNCTION.at(at, help=help_, fixes=(fix,), name=name))
            return None
        meant, fixes = variable_meant(context, call)
        meant = meant or OTHER_FUNCTIONS.get(name)
        if meant is None and name in context.callables.constraints:
            meant = f"`{name}` is a constraint: write it as a statement, `{name}(...);`"
        named = _CALLED.findall(meant or "")
        if len(named) == 1 and named[0] in context.callables.functions:
            fixes = (Fix(f"write `{named[0]}`", (Edit(call.function.span, named[0]),), safe=False),)
        complaint = UNKNOWN_FUNCTION.at(call.function.span, help=meant, fixes=fixes, name=name)
        context.complain(suggest_name(complaint, call.function, context.callables.functions))
        return None
    _check_dialect(context, call, row)
    if row.result is ResultKind.SAMPLED:
        return _sampled_type(context, scope, call, row)
    types = [type_of(context, scope, argument) for argument in call.arguments]
    signature, count = row.signature, len(types)
    # EUROPA overlooks further arguments; only the dialect nddlc refuses them.
    is_overlooked = context.dialect is Dialect.NDDL3 and row.overlooks_rest and count > signature.minimum
    if is_overlooked or check_count(context, name, signature, count, call.span, row.meaning):
        check_types(context, name, signature, call.arguments, types)
    return _result_type(context, row, types)


def _check_dialect(context: Context, call: CallExpr, row: FunctionRow) -> None:
    """Complain about a function that only the dialect nddlc has."""
    if row.origin is Origin.NDDLC and context.dialect is Dialect.NDDL3:
        context.complain(NOT_IN_NDDL3.at(call.function.span, help=NO_ENVIRONMENT, name=row.name))


def _result_type(context: Context, row: FunctionRow, types: list[Type | None]) -> Type:
    match row.result:
        case ResultKind.BOOL:
            return BOOL
        case ResultKind.INT:
            return INT
        case ResultKind.WIDEST if context.dialect is Dialect.NDDLC:
            return INT if types and all(type_ is not None and type_.kind is Kind.INT for type_ in types) else FLOAT
        case _:
            return FLOAT


def _sampled_type(context: Context, scope: Scope, call: CallExpr, row: FunctionRow) -> Type:
    if check_count(context, row.name, row.signature, len(call.arguments), call.span, row.meaning):
        return sampled_parameter(context, scope, call, call.arguments[0], row)
    return FLOAT
