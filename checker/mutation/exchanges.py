"""A call or an expression in; out: which of its arguments or operands may be in each other's place, or too many."""

from collections.abc import Iterator

from nddl_lang.semantics.constraints import ConstraintRow
from nddl_lang.syntax.nodes import BinaryExpr, Expr, FloatLiteral, Identifier, IntLiteral, PathExpr
from nddl_lang.syntax.walk import descendants
from nddl_lang.text.source import Span

_COMMUTING = ("addEq", "mulEq", "multEq", "eqSum", "eqProduct", "eqMinimum", "eqMaximum", "maxf", "minf")
_OTHER_OPERATORS = {"+": "/", "-": "*/", "*": "-/", "/": "*-+"}  # beside those that mutants have
_SINGLE = (PathExpr, IntLiteral, FloatLiteral)
_ORDERS = ("<=", "<", ">=", ">")
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


def turned(node: BinaryExpr) -> Iterator[tuple[Span, str]]:
    """The limit by which one token begins after the end of another one, each in the place of the other."""
    if node.op not in _ORDERS:
        return
    sides = [node.left, node.right] if node.op.startswith("<") else [node.right, node.left]
    ends, starts = (_moments(side, name) for side, name in zip(sides, ("end", "start"), strict=True))
    if len(ends) == len(starts) == 1 and ends[0].parts[0].name != starts[0].parts[0].name:
        yield exchanged(*(each.parts[0] for each in sorted((*ends, *starts), key=lambda one: one.span.begin)))


def _moments(side: Expr, name: str) -> list[PathExpr]:
    """The starts, or ends, of tokens in an expression."""
    paths = [one for one in descendants(side) if isinstance(one, PathExpr) and len(one.parts) == 2]
    return [one for one in paths if one.parts[1].name == name]


def shortened(node: BinaryExpr) -> Iterator[tuple[Span, str]]:
    """A sum, difference, product or quotient without one of its operands: a name or number, or a product in a sum."""
    if node.op not in _OTHER_OPERATORS:
        return
    for left_out, kept in ((node.right, node.left), (node.left, node.right)):
        is_term = node.op in "+-" and isinstance(left_out, BinaryExpr) and left_out.op in "*/"
        if (is_term or isinstance(left_out, _SINGLE)) and (kept is node.left or node.op in ("+", "*")):
            yield node.span, kept.span.text


def recast(node: BinaryExpr) -> Iterator[tuple[Span, str]]:
    """Another operator, and two that follow each other each in the other's place: `a * b - c` for `a - b * c`.

    Of a product also the one divided by the other: the factor belongs on the other side of the equation.
    """
    if node.op == "*" and isinstance(node.left, _SINGLE) and isinstance(node.right, _SINGLE):
        yield node.span, f"{node.right.span.text} / {node.left.span.text}"
    yield from ((node.op_span, other) for other in _OTHER_OPERATORS.get(node.op, ""))
    for inner in (node.left, node.right) if node.op in _OTHER_OPERATORS else ():
        if isinstance(inner, BinaryExpr) and inner.op in _OTHER_OPERATORS and inner.op != node.op:
            first, last = sorted((inner.op_span, node.op_span), key=lambda one: one.begin)
            between = first.source.text[first.finish : last.begin]
            if between.count("(") == between.count(")"):
                yield first.to(last), last.text + between + first.text


def exchanged_numbers(first: Expr, second: Expr) -> tuple[Span, str]:
    """Two arguments of an object, exchanged: an int and a whole float take the form of their new places."""
    match first, second:
        case (IntLiteral(value=one), FloatLiteral(value=other)) if other.is_integer():
            texts = repr(float(one)), str(int(other))
        case (FloatLiteral(value=one), IntLiteral(value=other)) if one.is_integer():
            texts = str(int(one)), repr(float(other))
        case _:
            return exchanged(first, second)
    return _in_places(first, second, texts)


def exchanged(first: Expr | Identifier, second: Expr | Identifier) -> tuple[Span, str]:
    """Two expressions, the first before the second, each in the place of the other."""
    return _in_places(first, second, (first.span.text, second.span.text))


def _in_places(first: Expr | Identifier, second: Expr | Identifier, texts: tuple[str, str]) -> tuple[Span, str]:
    """Two expressions, the first before the second, with the `texts` of them each in the place of the other."""
    between = first.span.source.text[first.span.finish : second.span.begin]
    return first.span.to(second.span), texts[1] + between + texts[0]
