"""The body of a rule in; out: what a line sets that another one sets already, and what may be meant in its place.

Who copies a line and forgets to change its name sets one variable twice and another one never: the same parameter of
another token, or what the other branch of the condition sets. Who writes a condition for what a line says forgets it.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from nddl_lang.syntax.nodes import BinaryExpr, ExprConstraint, Foreach, IfStatement, PathExpr, Relation
from nddl_lang.text.source import Span

_Way = tuple[tuple[int, bool], ...]  # conditions, each with its branch


@dataclass(frozen=True, slots=True)
class _Setting:
    """A line that says what a variable is, and the branches that it stands in."""

    name: str
    span: Span
    line: Span
    way: _Way

    def goes_with(self, other: "_Setting") -> bool:
        """Whether both may hold at once."""
        ways = dict(self.way)
        return all(ways.get(number, branch) == branch for number, branch in other.way)


def said_before(body: Iterable[Any]) -> Iterator[Span]:
    """Each line that says what a variable is though each branch of a condition says it."""
    settings = list(_settings(body, ()))
    for one in settings:
        inner = [
            other.way[len(one.way)]
            for other in settings
            if other.name == one.name and len(other.way) > len(one.way) and other.way[: len(one.way)] == one.way
        ]
        if any((number, not branch) in inner for number, branch in inner):
            yield one.line


def copied_names(body: Iterable[Any]) -> Iterator[tuple[Span, str]]:
    """Each name that is set before with one that would be set then and is not: people copy downwards."""
    settings, labels = list(_settings(body, ())), set(_labels(body))
    for one in settings:
        with_it = [other for other in settings if other is not one and one.goes_with(other)]
        if all(other.name != one.name or other.span.begin > one.span.begin for other in with_it):
            continue
        label, _, parameter = one.name.partition(".")
        said = {other.name for other in with_it}
        against = {other.name for other in settings if not one.goes_with(other)}
        others = {f"{other}.{parameter}" for other in labels if parameter and label in labels} | against
        for name in sorted(others - said - {one.name}):
            is_free = name in against or all(other.name != name for other in settings)
            if is_free and not (one.name in against and name not in against):
                yield one.span, name


def _settings(body: Iterable[Any], way: _Way) -> Iterator[_Setting]:
    for statement in body:
        match statement:
            case ExprConstraint(expression=BinaryExpr(op="==", left=PathExpr(parts=parts, span=span)), span=line):
                yield _Setting(".".join(part.name for part in parts), span, line, way)
            case IfStatement(then=then, otherwise=otherwise):
                yield from _settings(then, (*way, (id(statement), True)))
                yield from _settings(otherwise or (), (*way, (id(statement), False)))
            case Foreach(body=inner):
                yield from _settings(inner, way)
            case _:
                pass


def _labels(body: Iterable[Any]) -> Iterator[str]:
    """The names of the tokens that a rule asks for."""
    for statement in body:
        match statement:
            case Relation(created=created):
                yield from (one.name.name for one in created if one.name is not None)
            case IfStatement(then=then, otherwise=otherwise):
                yield from _labels((*then, *(otherwise or ())))
            case Foreach(body=inner):
                yield from _labels(inner)
            case _:
                pass
