"""Make the nodes of expressions; hold what the makers of all nodes share.

A maker takes the builder and the parts of one grammar alternative: the index of a lexeme, a node, or a list of them.
"""

from collections.abc import Callable, Iterable
from typing import Any

from nddl_lang.syntax.codes import (
    DIVISION,
    EXPRESSION_VALUE,
    GLUED_SIGN,
    MISPLACED_METHOD,
    MISPLACED_NEW,
    MISPLACED_VALUE,
    NO_ARGUMENT,
    UNARY_OPERATOR,
    VARIABLE_BOUND,
)
from nddl_lang.syntax.lexemes import INFINITY, integer, real
from nddl_lang.syntax.nodes import (
    BinaryExpr,
    BoolLiteral,
    CallExpr,
    Expr,
    FloatLiteral,
    Identifier,
    IntervalExpr,
    IntLiteral,
    NewExpr,
    PathExpr,
    SetExpr,
    StringLiteral,
    UnaryExpr,
)
from nddl_lang.syntax.piece import Piece
from nddl_lang.text.diagnostic import Code, Edit, Fix
from nddl_lang.text.source import Span

_LIBRARIES = ("math", "np", "numpy", "std")


class Builder:
    """The piece whose nodes are made, and values that may stand in few places only and wait for one of those."""

    __slots__ = ("anchor", "ends", "is_strict", "kinds", "methods", "piece", "starts", "texts", "waiting")

    def __init__(self, piece: Piece, is_strict: bool) -> None:
        self.piece = piece
        self.is_strict = is_strict
        self.anchor = piece.anchor
        self.kinds = piece.kinds
        self.starts = piece.starts
        self.ends = piece.ends
        self.texts = piece.texts
        self.waiting: dict[Expr, None] = {}
        self.methods: dict[CallExpr, tuple[PathExpr, Identifier]] = {}

    def own(self) -> None:
        """From now on the lexemes may be changed: the piece keeps what was written."""
        self.kinds = self.kinds.copy()
        self.starts = self.starts.copy()
        self.ends = self.ends.copy()
        self.texts = self.texts.copy()

    def remove(self, first: int, last: int) -> None:
        """Take out the lexemes from `first` to before `last`."""
        for column in (self.kinds, self.texts, self.starts, self.ends):
            del column[first:last]

    def insert(self, index: int, kind: str) -> None:
        """Put a lexeme that was not written before the lexeme `index`."""
        at = self.ends[index - 1] if index else 0
        self.kinds.insert(index, kind)
        self.texts.insert(index, "")
        self.starts.insert(index, at)
        self.ends.insert(index, at)

    def report(self, code: Code, span: Span, **values: Any) -> None:
        """Add a complaint about `span`."""
        self.piece.diagnostics.append(code.at(span, **values))

    def name(self, index: int) -> Identifier:
        """The lexeme `index` as a name."""
        return Identifier(self.texts[index], Span(self.anchor, self.starts[index], self.ends[index]))

    def at(self, index: int) -> Span:
        """The place of the lexeme `index`."""
        return Span(self.anchor, self.starts[index], self.ends[index])

    def span(self, first: Any, last: Any) -> Span:
        """From the part `first` to the part `last` of an alternative."""
        start = self.starts[first] if type(first) is int else first.span.start
        end = self.ends[last] if type(last) is int else last.span.end
        return Span(self.anchor, start, end)


# Makes the value of one alternative of the grammar from those of its parts.
Maker = Callable[[Builder, list[Any]], Any]


def _is_plain(value: Expr) -> bool:
    """Whether `value` is a value in nddl3: a literal, a domain or a path, without parentheses."""
    match value:
        case IntervalExpr() | SetExpr():
            return value.span.text[:1] != "("
        case IntLiteral() | FloatLiteral() | BoolLiteral() | StringLiteral() | PathExpr():
            return value.span.text[:1] != "("
        case _:
            return False


def plain_values(b: Builder, values: Iterable[Expr], code: Code, **words: str) -> None:
    """Report by `code` each of `values` that is no plain value, where nddl3 wants one."""
    if b.is_strict:
        for value in values:
            if not _is_plain(value) and type(value) is not NewExpr:
                # The wider complaint says it all.
                for narrower in (GLUED_SIGN, UNARY_OPERATOR, DIVISION):
                    b.piece.forget(narrower, value.span)
                if isinstance(value, BinaryExpr | UnaryExpr | CallExpr):
                    help_text = "declare a variable, state what it equals, and write the variable here"
                else:
                    help_text = "leave out the parentheses"
                b.report(code, value.span, **words, help=help_text)


def pass_on(b: Builder, v: list[Any]) -> Any:
    return v[0]


# ---- lists ----


def no_statements(b: Builder, v: list[Any]) -> list[Any]:
    return []


def first_of_list(b: Builder, v: list[Any]) -> list[Any]:
    return v


def next_of_list(b: Builder, v: list[Any]) -> list[Any]:
    v[0].append(v[1])
    return v[0]  # type: ignore[no-any-return]


def next_after_comma(b: Builder, v: list[Any]) -> list[Any]:
    v[0].append(v[2])
    return v[0]  # type: ignore[no-any-return]


# ---- names and paths ----


def identifier(b: Builder, v: list[Any]) -> Identifier:
    return b.name(v[0])


def first_name(b: Builder, v: list[Any]) -> list[Identifier]:
    return [b.name(v[0])]


def next_name(b: Builder, v: list[Any]) -> list[Identifier]:
    v[0].append(b.name(v[2]))
    return v[0]  # type: ignore[no-any-return]


def bare_path(b: Builder, v: list[Any]) -> PathExpr:
    name = b.name(v[0])
    return PathExpr((name,), name.span)


def dotted_path(b: Builder, v: list[Any]) -> PathExpr:
    return _path(b, v[0])


def first_part(b: Builder, v: list[Any]) -> list[int]:
    return v


def next_part(b: Builder, v: list[Any]) -> list[int]:
    v[0].append(v[2])
    return v[0]  # type: ignore[no-any-return]


def _path(b: Builder, parts: list[int]) -> PathExpr:
    return PathExpr(tuple(map(b.name, parts)), b.span(parts[0], parts[-1]))


# ---- literals and domains ----


def integer_literal(b: Builder, v: list[Any]) -> IntLiteral:
    return IntLiteral(integer(b.texts[v[0]]), b.at(v[0]))


def real_literal(b: Builder, v: list[Any]) -> FloatLiteral:
    return FloatLiteral(real(b.texts[v[0]]), b.at(v[0]))


def string_literal(b: Builder, v: list[Any]) -> StringLiteral:
    text = b.texts[v[0]]
    closed = len(text) > 1 and text[-1] == text[0]
    return StringLiteral(text[1:-1] if closed else text[1:], b.at(v[0]))


def boolean(b: Builder, v: list[Any]) -> BoolLiteral:
    return BoolLiteral(b.texts[v[0]] == "true", b.at(v[0]))


def interval(b: Builder, v: list[Any]) -> IntervalExpr:
    lower, upper = v[1], v[-2]
    for bound in (lower, upper):
        if isinstance(bound, IntLiteral | FloatLiteral):
            continue
        if isinstance(bound, BoolLiteral | StringLiteral | SetExpr | IntervalExpr):
            b.report(MISPLACED_VALUE, bound.span, what=_describe(bound), where="as a bound", help="write a number")
        elif b.is_strict:
            b.piece.forget(UNARY_OPERATOR, bound.span)
            b.report(VARIABLE_BOUND, bound.span, help="state the bounds as constraints: `a >= low; a <= high;`")
            if bound is lower:
                lower = IntLiteral(-INFINITY, bound.span)
            else:
                upper = IntLiteral(INFINITY, bound.span)
    return IntervalExpr(lower, upper, b.span(v[0], v[-1]))


def set_literal(b: Builder, v: list[Any]) -> SetExpr:
    for item in v[1]:
        if isinstance(item, IntervalExpr | SetExpr):
            b.report(MISPLACED_VALUE, item.span, what=_describe(item), where="in a set", help="write single values")
    items = [item for item in v[1] if not isinstance(item, IntervalExpr | SetExpr)]
    plain_values(b, items, EXPRESSION_VALUE, where="an item of a set")
    return SetExpr(tuple(v[1]), b.span(v[0], v[2]))


def _describe(value: Expr) -> str:
    """What kind of value `value` is, with an article."""
    match value:
        case IntLiteral() | FloatLiteral():
            return "a number"
        case BoolLiteral():
            return "a truth value"
        case StringLiteral():
            return "a string"
        case IntervalExpr():
            return "an interval"
        case SetExpr():
            return "a set"
        case PathExpr():
            return "a name"
        case NewExpr():
            return "a new object"
        case CallExpr():
            return "a call"
        case BinaryExpr() | UnaryExpr():
            return "an expression"


# ---- operators and calls ----


def binary(b: Builder, v: list[Any]) -> BinaryExpr:
    left, index, right = v
    op = b.kinds[index]  # a sign may be written otherwise, after a complaint
    if op == "/" and b.is_strict:
        b.report(DIVISION, b.at(index), help="multiply: `quotient * divisor == dividend`")
    return BinaryExpr(op, left, right, b.at(index), Span(b.anchor, left.span.start, right.span.end))


def unary(b: Builder, v: list[Any]) -> UnaryExpr:
    op = b.texts[v[0]]
    if b.is_strict:
        help_text = "write `0 - x`" if op == "-" else "compare with `false`: `x == false`"
        b.report(UNARY_OPERATOR, b.at(v[0]), text=op, help=help_text)
    return UnaryExpr(op, v[1], b.span(v[0], v[1]))


def parenthesised(b: Builder, v: list[Any]) -> Expr:
    # The node is new and nobody else's yet: its place comes to include the parentheses.
    value: Expr = v[1]
    object.__setattr__(value, "span", b.span(v[0], v[2]))
    return value


def new(b: Builder, v: list[Any]) -> NewExpr:
    arguments = v[3] if len(v) == 5 else []
    plain_values(b, arguments, EXPRESSION_VALUE, where="an argument")
    value = NewExpr(b.name(v[1]), tuple(arguments), b.span(v[0], v[-1]))
    b.waiting[value] = None
    return value


def call(b: Builder, v: list[Any]) -> CallExpr:
    if len(v) == 4:
        return CallExpr(b.name(v[0]), tuple(v[2]), b.span(v[0], v[3]))
    value = CallExpr(b.name(v[0]), (), b.span(v[0], v[2]))
    b.waiting[value] = None
    return value


def method_call(b: Builder, v: list[Any]) -> CallExpr:
    parts: list[int] = v[0]
    return _method_call(b, parts[:-1], parts[-1], v[2] if len(v) == 4 else [], v[-1])


def close_call(b: Builder, v: list[Any]) -> CallExpr:
    return _method_call(b, v[0], v[2], [], v[-1])


def _method_call(b: Builder, owner: list[int], name: int, arguments: list[Expr], last: int) -> CallExpr:
    method = b.name(name)
    value = CallExpr(method, tuple(arguments), b.span(owner[0], last))
    b.methods[value] = (_path(b, owner), method)
    b.waiting[value] = None
    return value


def refuse_waiting(b: Builder, span: Span | None = None) -> bool:
    """Report the values, inside `span` if given, that never came to a place where they may stand."""
    found = [value for value in b.waiting if span is None or span.start <= value.span.start < span.end]
    for value in found:
        del b.waiting[value]
        start = value.span.start
        if any(first <= start < end for first, end in b.piece.broken):
            continue
        if isinstance(value, NewExpr):
            help_text = "declare a variable for the object first, and write the variable here"
            b.report(MISPLACED_NEW, value.span, help=help_text)
        elif isinstance(value, CallExpr) and value in b.methods:
            name, owner = value.function.name, b.methods[value][0].span
            if owner.text.casefold() in _LIBRARIES:
                fix = Fix(f"write `{name}(...)`", (Edit(Span(b.anchor, owner.start, value.function.span.start), ""),))
                b.report(MISPLACED_METHOD, value.span, name=name, help="functions have no owner", fixes=(fix,))
            else:
                b.report(MISPLACED_METHOD, value.span, name=name, help="call it in a statement of its own")
        elif isinstance(value, CallExpr):
            _report_no_argument(b, value)
    return bool(found)


def _report_no_argument(b: Builder, call: CallExpr) -> None:
    """A call needs an argument; of what is written as classes are, it is said how objects are made."""
    name = call.function.name
    if not name[:1].isupper():
        b.report(NO_ARGUMENT, call.span, name=name)
        return
    if name.isupper() and len(name) > 1:
        plain = Fix(f"write `{name}`", (Edit(call.span, name),), safe=False)
        b.report(NO_ARGUMENT, call.span, help=f"a variable stands alone: `{name}`", fixes=(plain,), name=name)
        return
    written = f"new {call.span.text}"
    edit = Edit(Span(call.span.anchor, call.span.start, call.span.start), "new ")
    fix = Fix(f"write `{written}`", (edit,), safe=False)
    b.report(NO_ARGUMENT, call.span, help=f"an object is made by `{written}`", fixes=(fix,), name=name)
