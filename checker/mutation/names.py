"""An expression or relation of a rule in; out: other names, values, times and tokens that may be meant in it."""

from collections.abc import Iterator
from typing import Any

from checker.mutation.agreement import Agreement
from checker.mutation.kinds import EditKind
from checker.mutation.scope import LineScope, Scopes
from nddl_lang.syntax.nodes import BinaryExpr, BoolLiteral, Identifier, PathExpr, Relation
from nddl_lang.text.source import Span

_POINTS = {"start": "end", "end": "start"}
_COMPARING = ("==", "!=", "<", "<=", ">", ">=")
_TRUTHS = ("true", "false")


def renamings(node: Any, names: LineScope, scopes: Scopes, types: Agreement) -> Iterator[tuple[EditKind, Span, str]]:
    """What else may be named in a rule; nothing outside of rules."""
    for kind, found in (
        (EditKind.VALUE, _other_values(node, names)),
        (EditKind.NAME, _other_names(node, names)),
        (EditKind.NAME, types.others(node, names)),
        (EditKind.POINT, _other_points(node, names)),
        (EditKind.TOKEN, _other_tokens(node, names)),
        (EditKind.PREDICATE, _other_predicates(node, names, scopes)),
    ):
        for span, new in found:
            yield kind, span, new


def _other_values(node: Any, names: LineScope) -> Iterator[tuple[Span, str]]:
    """Other values of the enumeration, or the other truth value."""
    match node:
        case PathExpr(parts=parts, span=span) if enum := names.enum_of(_written(parts)):
            yield from ((span, value) for value in names.enums[enum] if value != parts[-1].name)
        case BoolLiteral(value=value, span=span):
            yield span, _TRUTHS[value]
        case _:
            pass


def _other_names(node: Any, names: LineScope) -> Iterator[tuple[Span, str]]:
    """Other variables of the type, where a variable, a member, a constant or a value of an enumeration is written."""
    if not isinstance(node, PathExpr):
        return
    parts = _written(node.parts)
    if parts[0] in names.objects and names.owner and not names.is_local(parts[0]):
        yield from ((node.span, other) for other in names.beside(parts))
        return
    yield from ((node.span, other) for other in names.own_members(parts))
    kind = names.type_of(parts) or names.enum_of(parts) or ("float" if parts[0] in names.constants else "")
    if names.is_value(kind):
        is_constant = len(parts) == 1 and parts[0] in names.constants
        is_member = len(parts) > 1 and parts[0] in names.variables
        for other in names.alike(kind):
            if is_member and names.type_of(tuple(other.split("."))) != kind:
                continue  # what an object is made of is hardly mistaken for what is counted
            if other != ".".join(parts) and not (is_constant and other in names.constants):
                yield node.span, other


def _other_points(node: Any, names: LineScope) -> Iterator[tuple[Span, str]]:
    """The other end of a token."""
    match node:
        case PathExpr(parts=(*owner, Identifier(name=name)), span=span) if name in _POINTS and _is_token(owner, names):
            yield span, ".".join((*_written(owner), _POINTS[name]))
        case _:
            pass


def _other_tokens(node: Any, names: LineScope) -> Iterator[tuple[Span, str]]:
    """Another token of the rule, in a relation or before one of its times."""
    match node:
        case PathExpr(parts=(*owner, Identifier(name=name)), span=span) if name in _POINTS and _is_token(owner, names):
            for label in ("", *(label for label, kind in names.tokens.items() if not kind.is_event)):
                if label != ".".join(_written(owner)):
                    yield span, f"{label}.{name}" if label else name
        case Relation(origin=Identifier() as origin, existing=PathExpr(parts=(target,))):
            for label in names.tokens:
                if label not in (origin.name, target.name):
                    yield origin.span, label
                    yield target.span, label
        case _:
            pass


def _other_predicates(node: Any, names: LineScope, scopes: Scopes) -> Iterator[tuple[Span, str]]:
    """Other predicates of the class of a child, and those of other classes that its token is called by.

    `contains(Water.Give airing)` was copied from the line above it and meant `Vent.Airing`: of 796 tokens in right
    models 307 bear the name of their predicate, and 12 that of one of another class.
    """
    for child in node.created if isinstance(node, Relation) and names.owner else ():
        yield from ((child.path.parts[-1].span, other) for other in scopes.kind(names, child.path).others)
        if child.name is not None and len(child.path.parts) == 2:
            yield from (
                (child.path.span, other) for other in scopes.called(child.name.name, *_written(child.path.parts))
            )


def tautologies(node: Any) -> Iterator[tuple[Span, str]]:
    """What must not be written in a comparison: its other side."""
    if isinstance(node, BinaryExpr) and node.op in _COMPARING:
        yield node.left.span, node.right.span.text
        yield node.right.span, node.left.span.text


def _written(parts: Any) -> tuple[str, ...]:
    return tuple(part.name for part in parts)


def _is_token(owner: Any, names: LineScope) -> bool:
    return not owner or (len(owner) == 1 and owner[0].name in names.tokens)
