"""Statements in; out: what two lines say of the same, each in the place of the other.

Two lines may have changed places: the rows of a table that objects are, or what the branches of a condition set.
"""

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import Any

from nddl_lang.syntax.nodes import (
    BinaryExpr,
    ExprConstraint,
    FloatLiteral,
    IfStatement,
    IntLiteral,
    NewExpr,
    PathExpr,
    VariableDecl,
)
from nddl_lang.text.source import Span

Rows = dict[Any, list[tuple[Span, str, bool]]]  # what may be written where, and whether that is told by the text

_LEAST_ROWS = 3
_NUMBERS = (IntLiteral, FloatLiteral)


def swapped_rows(statements: Sequence[Any]) -> Rows:
    """By its statement: what an object is made of in place of what the next one of its class is made of.

    Exchanged are all arguments but the first, which tells who it is, or the numbers among them; and whether the numbers
    of all objects grow then from one to the next, as they do not before.
    """
    rows: dict[tuple[str, int], list[tuple[Any, NewExpr]]] = {}
    for statement in statements:
        made = _made(statement)
        if made is not None:
            key = (made.class_name.name, len(made.arguments))
            rows.setdefault(key, []).append((statement, made))
    found: Rows = {}
    for group in rows.values():
        table = [_numbers(made) for _, made in group]
        for at, ((statement, one), (_, other)) in enumerate(pairwise(group)):
            if one.span.source is not other.span.source or len(one.arguments) < 2:
                continue
            last = len(one.arguments) - 1
            numbers = next((k for k in range(1, last + 1) if not isinstance(one.arguments[k], _NUMBERS)), last + 1)
            for end in dict.fromkeys((numbers - 1, last)):
                first, second = _stretch(one, end), _stretch(other, end)
                if end > 0 and first.text != second.text:
                    changed = list(table)
                    changed[at] = table[at][:1] + table[at + 1][1:]
                    changed[at + 1] = table[at + 1][:1] + table[at][1:]
                    is_put_in_order = _grows(changed) and not _grows(table)
                    found.setdefault(statement, []).append((*_swapped(first, second), is_put_in_order))
    return found


def swapped_branches(condition: IfStatement) -> Rows:
    """By its statement: what one branch says that a variable is in place of what the other branch says.

    Where the branches say nothing else, their condition would be mistaken.
    """
    found: Rows = {}
    branches = condition.then, condition.otherwise or ()
    there = {name: said for name, said, _ in _set(branches[1])}
    for name, said, statement in _set(branches[0]) if min(map(len, branches)) > 1 else ():
        if name in there and said.text != there[name].text:
            found[statement] = [(*_swapped(said, there[name]), False)]
    return found


def swapped_parts(old: str, new: str) -> tuple[str, str]:
    """The two stretches of a text that have changed places."""
    size = len(old)
    for first in range(1, size):
        for second in range(1, size - first) if new.endswith(old[:first]) else ():
            if new[:second] == old[size - second :] and new[second : size - first] == old[first : size - second]:
                return old[:first], new[:second]
    raise AssertionError("nothing has changed places")


def _made(statement: Any) -> NewExpr | None:
    if isinstance(statement, VariableDecl) and len(statement.declarators) == 1:
        value = statement.declarators[0].initialiser
        return value if isinstance(value, NewExpr) else None
    return None


def _numbers(made: NewExpr) -> tuple[float, ...]:
    return tuple(one.value for one in made.arguments if isinstance(one, IntLiteral | FloatLiteral))


def _grows(table: Sequence[tuple[float, ...]]) -> bool:
    """Whether each number is greater in each row than in the one before, of three rows at least."""
    is_told = len(table) >= _LEAST_ROWS and len(set(map(len, table))) == 1
    pairs = (pair for before, after in pairwise(table) for pair in zip(before, after, strict=True))
    return is_told and all(one < other for one, other in pairs)


def _stretch(made: NewExpr, last: int) -> Span:
    return made.arguments[1].span.to(made.arguments[last].span)


def _set(branch: Iterable[Any]) -> Iterator[tuple[str, Span, Any]]:
    for statement in branch:
        match statement:
            case ExprConstraint(expression=BinaryExpr(op="==", left=PathExpr(span=left), right=right)):
                yield left.text, right.span, statement
            case _:
                pass


def _swapped(first: Span, second: Span) -> tuple[Span, str]:
    """Two stretches of a text, the first before the second, each in the place of the other."""
    between = first.source.text[first.finish : second.begin]
    whole = Span(first.anchor, first.start, second.finish - first.anchor.offset)
    return whole, second.text + between + first.text
