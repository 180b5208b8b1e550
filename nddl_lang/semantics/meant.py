"""What was meant by an expression that does not fit: an expression in; help, and fixes to be looked at, out."""

import re
from collections.abc import Iterator

from nddl_lang.semantics.natives import builtin_type
from nddl_lang.semantics.owned_names import only_one
from nddl_lang.semantics.schema import Kind, MemberReference, TokenReference, TokenVariableReference, Type, Variable
from nddl_lang.semantics.scope import Context
from nddl_lang.semantics.types import NUMBERS, comparable, reference_type
from nddl_lang.syntax.nodes import BinaryExpr, CallExpr, Expr, PathExpr, StringLiteral, UnaryExpr
from nddl_lang.text.diagnostic import Edit, Fix
from nddl_lang.text.nearest import nearest

_MOST_MEMBERS = 4  # that a help lists
_COMPARISONS = ("==", "!=", "<", "<=", ">", ">=")
_QUOTED = {Kind.INT: re.compile(r"[-+]?\d+"), Kind.FLOAT: re.compile(r"[-+]?\d+(?:\.\d+)?")}


def relation_meant(context: Context, binary: BinaryExpr) -> tuple[str | None, tuple[Fix, ...]]:
    """How an order of two tokens is written; nothing where one is something else."""
    sides = (binary.left, binary.right)
    if not all(isinstance(context.tables.references.get(each), TokenReference) for each in sides):
        return None, ()
    relation = "before" if binary.op[0] == "<" else "after"
    written = f"{binary.left.span.text} {relation} {binary.right.span.text}"
    fix = Fix(f"write `{written}`", (Edit(binary.span, written),), safe=False)
    return f"one token after the other is a relation: `{written}`", (fix,)


def comparison_meant(binary: BinaryExpr, side: Expr) -> tuple[str | None, tuple[Fix, ...]]:
    """How `a == 1 || 2` is written, where `side` is the 2; nothing where the other side compares nothing."""
    other = binary.left
    while isinstance(other, BinaryExpr) and other.op == binary.op:
        other = other.right
    if side is binary.left or not isinstance(other, BinaryExpr) or other.op not in _COMPARISONS:
        return None, ()
    written = f"{other.left.span.text} {other.op} {side.span.text}"
    fix = Fix(f"write `{written}`", (Edit(side.span, written),), safe=False)
    return f"each comparison has a left side: `{written}`", (fix,)


def parameter_meant(context: Context, token: Expr, other: Type) -> tuple[Fix, ...]:
    """Where a token stands for its state: the one parameter of its predicate that may be equal to the other side."""
    reference = context.tables.references.get(token)
    if not isinstance(reference, TokenReference):
        return ()
    is_subclass = context.symbols.is_subclass
    parameters = reference.label.predicate.parameters
    names = [one.name for one in parameters if one.type is not None and comparable(one.type, other, is_subclass)]
    if len(names) != 1:
        return ()
    text = f"{token.span.text}.{names[0]}"
    return (Fix(f"write `{text}`", (Edit(token.span, text),), safe=False),)


def other_parameters(context: Context, binary: BinaryExpr, left: Type, right: Type) -> tuple[Fix, ...]:
    """Where one parameter or member stands for another: the one that fits, by its name too or as the only one."""
    named: list[tuple[Expr, str]] = []
    fitting: list[tuple[Expr, str]] = []
    for side, beside, wanted in ((binary.left, binary.right, right), (binary.right, binary.left, left)):
        if not isinstance(side, PathExpr):
            continue
        owner = ".".join(part.name for part in side.parts[:-1])
        last = beside.parts[-1].name if isinstance(beside, PathExpr) else ""
        for one in _siblings(context, side):
            text = f"{owner}.{one.name}" if owner else one.name
            if one.type is not None and _is_alike(one.type, wanted) and text != beside.span.text:
                (named if one.name == last else fitting).append((side, text))
    found = named or fitting
    return only_one(found[0][0].span, [text for _, text in found]) if found else ()


def _siblings(context: Context, side: PathExpr) -> Iterator[Variable]:
    """What the token or the object has, a variable of which a path names."""
    reference = context.tables.references.get(side)
    if isinstance(reference, TokenVariableReference):
        yield from reference.label.predicate.parameters
    elif isinstance(reference, MemberReference) and len(side.parts) > 1:
        owner = context.tables.references.get(side.parts[-2])
        type_ = reference_type(owner, None) if owner is not None else None
        for each in context.symbols.ancestry(type_.base) if type_ is not None else ():
            yield from each.members.values()


def _is_alike(one: Type, other: Type) -> bool:
    return one.kind is other.kind and (one.base == other.base or one.kind in NUMBERS)


def member_meant(
    context: Context, side: Expr, type_: Type, other: Type | None = None
) -> tuple[str | None, tuple[Fix, ...]]:
    """Where an object or a token stands for a number, or an object for what may equal `other`: what it has that is so.

    Members of the very type come before those of the same kind, and these before what can be compared.
    """
    if other is None and isinstance(context.tables.references.get(side), TokenReference):
        return _times_of(side)
    if type_.kind is not Kind.OBJECT or not isinstance(side, PathExpr):
        return None, ()
    is_subclass = context.symbols.is_subclass
    members = [one for owner in context.symbols.ancestry(type_.base) for one in owner.members.values()]
    if other is None:
        found = [one for one in members if one.type.kind in NUMBERS]
    else:
        alike = [one for one in members if comparable(one.type, other, is_subclass)]
        found = (
            [one for one in alike if one.type == other]
            or [one for one in alike if one.type.kind is other.kind]
            or [one for one in alike if one.type.kind in NUMBERS]
        )
    texts = [f"{side.span.text}.{one.name}" for one in found[:_MOST_MEMBERS]]
    advice = f"did you mean {' or '.join(f'`{text}`' for text in texts)}?" if texts else None
    return advice, only_one(side.span, texts)


def number_meant(side: Expr, other: Type) -> tuple[Fix, ...]:
    """A number in quotes without them, where it is compared with a number."""
    pattern = _QUOTED.get(other.kind)
    if not isinstance(side, StringLiteral) or pattern is None or pattern.fullmatch(side.value) is None:
        return ()
    return (Fix(f"write `{side.value}`", (Edit(side.span, side.value),), safe=False),)


def value_meant(context: Context, side: Expr, other: Type) -> tuple[Fix, ...]:
    """A value of an enum in quotes, or an object, without them, where it is compared with that enum or class."""
    if not isinstance(side, StringLiteral):
        return ()
    symbols = context.symbols
    if (enum := symbols.find_enum(other.base)) is not None:
        value = side.value if side.value in enum.values else nearest(side.value, enum.values)
        text = f"{enum.name}.{value}" if value is not None else None
    else:
        named = symbols.find_global(side.value) if other.kind is Kind.OBJECT else None
        text = side.value if named is not None and comparable(named.type, other, symbols.is_subclass) else None
    if text is None:
        return ()
    return (Fix(f"write `{text}`", (Edit(side.span, text),), safe=False),)


def variable_meant(context: Context, call: CallExpr) -> tuple[str | None, tuple[Fix, ...]]:
    """How a variable of a token or object is written that is called like a function: `duration(a)`; else nothing."""
    argument = call.arguments[0] if len(call.arguments) == 1 else None
    reference = context.tables.references.get(argument) if argument is not None else None
    name = call.function.name
    if argument is None or reference is None:
        return None, ()
    if isinstance(reference, TokenReference):
        predicate = reference.label.predicate
        is_known = builtin_type(name, predicate) is not None or name in [each.name for each in predicate.parameters]
    else:
        type_ = context.tables.types.get(argument)
        is_object = type_ is not None and type_.kind is Kind.OBJECT
        is_known = type_ is not None and is_object and context.symbols.find_member(type_.base, name) is not None
    if not is_known:
        return None, ()
    text = f"{argument.span.text}.{name}"
    return f"write `{text}`", (Fix(f"write `{text}`", (Edit(call.span, text),), safe=False),)


def _times_of(side: Expr) -> tuple[str, tuple[Fix, ...]]:
    """The times that may be meant by a token where a number is wanted."""
    times = [f"{side.span.text}.{name}" for name in ("start", "end", "duration")]
    fixes = tuple(Fix(f"write `{each}`", (Edit(side.span, each),), safe=False, is_choice=True) for each in times)
    return f"`{side.span.text}` is a token: its times are `{times[0]}`, `{times[1]}` and `{times[2]}`", fixes


def is_token_in(context: Context, operand: Expr) -> bool:
    """Whether a sum or the like has a token as a part."""
    waiting = [operand]
    while waiting:
        part = waiting.pop()
        match part:
            case BinaryExpr(left=left, right=right):
                waiting += (left, right)
            case UnaryExpr(operand=inner):
                waiting.append(inner)
            case _ if isinstance(context.tables.references.get(part), TokenReference):
                return True
    return False
