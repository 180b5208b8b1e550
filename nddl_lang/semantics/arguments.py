"""Check the arguments of a call against its signature: how many, and of what type."""

from collections.abc import Callable, Iterable, Sequence
from itertools import permutations

from nddl_lang.semantics.codes import ARGUMENTS_DIFFER, WRONG_ARGUMENT, WRONG_COUNT
from nddl_lang.semantics.meant import member_meant
from nddl_lang.semantics.names import suggest_name
from nddl_lang.semantics.schema import Kind, Reference, TokenReference, Type
from nddl_lang.semantics.scope import Context
from nddl_lang.semantics.signature import Argument, ArgumentKind, Signature
from nddl_lang.semantics.types import COUNTABLE, always_differ, comparable, phrase
from nddl_lang.syntax.nodes import Expr, PathExpr
from nddl_lang.text.diagnostic import Edit, Fix, Note
from nddl_lang.text.source import Span

MOST_REORDERED = 5  # arguments whose orders are tried
_RESOURCE_CLASS = "CBReusable"
_ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth")


def ordinal(index: int) -> str:
    """The place of an argument in words, counted from 0: `first`."""
    return _ORDINALS[index] if index < len(_ORDINALS) else f"{index + 1}th"


def told_places(places: Sequence[int], texts: Sequence[str], what: str) -> str:
    """What is to be said of some arguments: `the second, `x`, is missing`."""
    named = " and ".join(f"the {ordinal(place)}, `{text}`," for place, text in zip(places, texts, strict=True))
    return f"{named} {'is' if len(places) == 1 else 'are'} {what}"


def reordered(arguments: Sequence[Expr], takes: Callable[[tuple[int, ...]], bool]) -> tuple[Fix, ...]:
    """The arguments in the one order that moves fewest of them, of those that are taken."""
    if not 2 <= len(arguments) <= MOST_REORDERED:
        return ()
    moved = {
        order: sum(place != at for place, at in enumerate(order))
        for order in permutations(range(len(arguments)))
        if takes(order)
    }
    orders = [order for order, moves in moved.items() if moves == min(moved.values())]
    if len(orders) != 1:
        return ()
    texts = [arguments[at].span.text for at in orders[0]]
    edits = tuple(
        Edit(argument.span, text) for argument, text in zip(arguments, texts, strict=True) if argument.span.text != text
    )
    return (Fix(f"write `{', '.join(texts)}`", edits, safe=False),)


def check_count(context: Context, name: str, signature: Signature, found: int, span: Span, meaning: str) -> bool:
    """Complain where the number of arguments is wrong; whether it is right."""
    if signature.accepts(found):
        return True
    note = Note(f"`{name}({signature.text})`: {meaning}")
    lacking = [*range(found, signature.minimum)]
    help_ = told_places(lacking, [each.name for each in signature.required[found:]], "missing") if lacking else None
    context.complain(
        WRONG_COUNT.at(span, notes=(note,), help=help_, name=name, expected=signature.count_text, found=found)
    )
    return False


def check_types(
    context: Context,
    name: str,
    signature: Signature,
    arguments: Sequence[Expr],
    types: Sequence[Type | None],
) -> None:
    """Complain about each argument of the wrong type; an unknown type is passed over."""
    like: tuple[Expr, Type] | None = None
    for index, (expression, type_) in enumerate(zip(arguments, types, strict=True)):
        argument = signature.argument(index)
        if type_ is None or argument is None:
            continue
        if argument.kind is not ArgumentKind.SAME:
            reference = context.tables.references.get(expression)
            if not _is_of_kind(context, argument, type_, reference):
                is_number = argument.kind in (ArgumentKind.NUMBER, ArgumentKind.TIME)
                help_, fixes = member_meant(context, expression, type_) if is_number else (None, ())
                if argument.kind is ArgumentKind.RESOURCE and context.symbols.is_subclass(type_.base, "Reusable"):
                    asked = f"contains({expression.span.text}.uses u); u.quantity == ...;"
                    help_ = f"a `Reusable` is used by a token: `{asked}`"
                fixes = fixes or _in_order(context, signature, arguments, types)
                complain_argument(context, name, argument, expression, phrase(type_), (), fixes, help_)
        elif like is None:
            like = (expression, type_)
        elif not comparable(like[1], type_, context.symbols.is_subclass):
            if name == "neq" and always_differ(like[1], type_):
                continue
            context.complain(
                ARGUMENTS_DIFFER.at(
                    expression.span,
                    name=name,
                    text=expression.span.text,
                    found=phrase(type_),
                    other=like[0].span.text,
                    expected=phrase(like[1]),
                )
            )


def _in_order(
    context: Context, signature: Signature, arguments: Sequence[Expr], types: Sequence[Type | None]
) -> tuple[Fix, ...]:
    """The arguments, of which one is of the wrong kind, in the only order in which none is."""
    places = [signature.argument(index) for index in range(len(arguments))]
    references = [context.tables.references.get(argument) for argument in arguments]

    def is_right(place: int, at: int) -> bool:
        argument, type_ = places[place], types[at]
        return argument is not None and type_ is not None and _is_of_kind(context, argument, type_, references[at])

    if None in types:
        return ()
    return reordered(arguments, lambda order: all(map(is_right, range(len(order)), order)))


def complain_argument(
    context: Context,
    name: str,
    argument: Argument,
    expression: Expr,
    found: str,
    meant: Iterable[str] = (),
    fixes: tuple[Fix, ...] = (),
    help_: str | None = None,
) -> None:
    """Say that an argument is of the wrong kind; one of the names in `meant` may be what was meant."""
    text = expression.span.text
    complaint = WRONG_ARGUMENT.at(
        expression.span,
        name=name,
        expected=argument.kind.value,
        text=text,
        found=found,
        help=help_ or (fixes[0].title if fixes else None),
        fixes=fixes,
    )
    if isinstance(expression, PathExpr) and len(expression.parts) == 1:
        complaint = suggest_name(complaint, expression.parts[0], meant)
    context.complain(complaint)


def _is_of_kind(context: Context, argument: Argument, type_: Type, reference: Reference | None) -> bool:
    match argument.kind:
        case ArgumentKind.NUMBER | ArgumentKind.TIME:
            return type_.kind in COUNTABLE
        case ArgumentKind.BOOL:
            return type_.kind is Kind.BOOL
        case ArgumentKind.STRING:
            return type_.kind is Kind.STRING
        case ArgumentKind.OBJECT:
            return type_.kind is Kind.OBJECT
        case ArgumentKind.TOKEN:
            return isinstance(reference, TokenReference)
        case ArgumentKind.RESOURCE:
            return type_.kind is Kind.OBJECT and context.symbols.is_subclass(type_.base, _RESOURCE_CLASS)
        case ArgumentKind.PARAMETER | ArgumentKind.ANY | ArgumentKind.SAME:
            return True
