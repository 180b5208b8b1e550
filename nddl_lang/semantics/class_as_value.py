"""A path that begins with a class where a value is needed in; the complaint, with what was meant, out."""

from collections.abc import Iterator, Sequence

from nddl_lang.semantics.codes import CLASS_AS_VALUE
from nddl_lang.semantics.owned_names import is_of, labels_of, only_one
from nddl_lang.semantics.scope import Context, Scope
from nddl_lang.syntax.nodes import Identifier
from nddl_lang.text.diagnostic import Edit, Fix
from nddl_lang.text.source import Span


def complain_class(context: Context, scope: Scope, parts: Sequence[Identifier]) -> None:
    """Say that a class stands where a value is needed.

    Its name may differ from a variable's in a capital only, or what follows it be a value of an enum or a predicate of
    which there is a token here.
    """
    head, last = parts[0], parts[-1]
    if len(parts) > 2 and (written := [*_of_tokens(context, scope, parts)]):
        at = head.span.to(last.span)
        named = " or ".join(f"`{each}`" for each in written)
        help_ = f"a token of `{head.name}.{parts[1].name}` is known by its name: {named}"
        context.complain(CLASS_AS_VALUE.at(head.span, help=help_, fixes=only_one(at, written), name=head.name))
        return
    if len(parts) > 2 and (asked := scope.unnamed(parts[1].name)) is not None:
        after = Span(asked.span.anchor, asked.span.end, asked.span.end)
        word = f"{parts[1].name[:1].lower()}{parts[1].name[1:]}"
        help_ = f"give the token a name: `{asked.span.text} {word}`, and write `{word}.{last.name}`"
        edits = (Edit(after, f" {word}"), Edit(head.span.to(parts[1].span), word))
        fix = Fix(f"name the token `{word}`", edits, safe=False)
        context.complain(CLASS_AS_VALUE.at(head.span, help=help_, fixes=(fix,), name=head.name))
        return
    at = head.span
    values = [*scope.visible(), *context.symbols.names("global")]
    meant: str | None = next(
        (each for each in values if each.casefold() == head.name.casefold() and each != head.name), None
    )
    if len(parts) > 1 and (value := context.symbols.find_value(last.name)) is not None:
        meant, at = f"{value.enum}.{value.value}", head.span.to(last.span)
    fixes = (Fix(f"write `{meant}`", (Edit(at, meant),), safe=False),) if meant is not None else ()
    advice = f"did you mean `{meant}`?" if meant is not None else None
    context.complain(CLASS_AS_VALUE.at(head.span, help=advice, fixes=fixes, name=head.name))


def _of_tokens(context: Context, scope: Scope, parts: Sequence[Identifier]) -> Iterator[str]:
    """What `Class.predicate.x` is called of the tokens of that predicate that a block sees."""
    owner, predicate = parts[0].name, parts[1].name
    rest = ".".join(part.name for part in parts[2:])
    yield from (f"{label.name}.{rest}" for label in labels_of(context, scope, owner, predicate))
    if scope.own is not None and is_of(context, scope.own.predicate, owner, predicate):
        yield rest
