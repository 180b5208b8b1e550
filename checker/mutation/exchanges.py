"""A call or an expression in; out: which of its arguments or operands may be in each other's place, or too many."""

from collections.abc import Iterator

from nddl_lang.semantics.constraints import ConstraintRow
from nddl_lang.syntax.nodes import BinaryExpr, Expr, FloatLiteral, IntLiteral, PathExpr
from nddl_lang.text.source import Span

_COMMUTING = ("addEq", "mulEq", "multEq", "eqSum", "eqProduct", "eqMinimum", "eqMaximum", "maxf", "minf")
_FEW_ARGUMENTS = 3  # of a constraint whose result may be mistaken for an input


def exchangeable(row: ConstraintRow | None, count: int) -> Iterator[tuple[int, int]]:
    """Which arguments of a constraint may stand for each other: those of a sum say the same in any order."""
    result = row.result % count if row is not None and row.result is not None and count else None
    if row is None or row.name not in _COMMUTING:
        first = [number for number in range(count) if number != result][:2]
        yield from [(first[0], first[1])] if len(first) == 2 else []
    if result is not None and count <= _FEW_ARGUMENTS:
        yield from ((min(number, result), max(number, result)) for number in range(count) if number != result)


def misplaced(node: BinaryExpr) -> Iterator[tuple[Span, str]]:
    """Two operands, each in the place of the other: of a difference or quotient, or of a product and what is added."""
    if node.op == "-" or (node.op == "/" and not isinstance(node.right, IntLiteral | FloatLiteral)):
        yield exchanged(node.left, node.right)
    for one, other in ((node.left, node.right), (node.right, node.left)):
        if node.op in ("+", "-") and isinstance(one, BinaryExpr) and one.op == "*" and isinstance(other, PathExpr):
            for factor in (one.left, one.right):
                if isinstance(factor, PathExpr):
                    yield exchanged(*sorted((factor, other), key=lambda each: each.span.begin))


def shortened(node: BinaryExpr) -> Iterator[tuple[Span, str]]:
    """A sum, difference, product or quotient without one of its operands, where that is a name."""
    if node.op not in ("+", "-", "*", "/"):
        return
    for left_out, kept in ((node.right, node.left), (node.left, node.right)):
        if isinstance(left_out, PathExpr) and (kept is node.left or node.op in ("+", "*")):
            yield node.span, kept.span.text


def exchanged(first: Expr, second: Expr) -> tuple[Span, str]:
    """Two expressions, the first before the second, each in the place of the other."""
    between = first.span.source.text[first.span.finish : second.span.begin]
    return first.span.to(second.span), second.span.text + between + first.span.text
