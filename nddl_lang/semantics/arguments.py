"""Check the arguments of a call against its signature: how many, and of what type."""

from collections.abc import Iterable, Sequence

from nddl_lang.semantics.codes import ARGUMENTS_DIFFER, WRONG_ARGUMENT, WRONG_COUNT
from nddl_lang.semantics.names import suggest_name
from nddl_lang.semantics.schema import Kind, Reference, TokenReference, Type
from nddl_lang.semantics.scope import Context
from nddl_lang.semantics.signature import Argument, ArgumentKind, Signature
from nddl_lang.semantics.types import COUNTABLE, always_differ, comparable, phrase
from nddl_lang.syntax.nodes import Expr, PathExpr
from nddl_lang.text.diagnostic import Fix, Note
from nddl_lang.text.source import Span

_RESOURCE_CLASS = "CBReusable"


def check_count(context: Context, name: str, signature: Signature, found: int, span: Span, meaning: str) -> bool:
    """Complain where the number of arguments is wrong; whether it is right."""
    if signature.accepts(found):
        return True
    note = Note(f"`{name}({signature.text})`: {meaning}")
    context.complain(WRONG_COUNT.at(span, notes=(note,), name=name, expected=signature.count_text, found=found))
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
                complain_argument(context, name, argument, expression, phrase(type_))
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


def complain_argument(
    context: Context,
    name: str,
    argument: Argument,
    expression: Expr,
    found: str,
    meant: Iterable[str] = (),
    fixes: tuple[Fix, ...] = (),
) -> None:
    """Say that an argument is of the wrong kind; one of the names in `meant` may be what was meant."""
    text = expression.span.text
    complaint = WRONG_ARGUMENT.at(
        expression.span,
        name=name,
        expected=argument.kind.value,
        text=text,
        found=found,
        help=fixes[0].title if fixes else None,
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
