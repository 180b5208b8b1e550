"""A variable and what it may be in; items that draw it, equate it, or hold it within a domain out."""

from collections.abc import Callable, Iterator

from compiler.determined import code
from compiler.determined.code import RegisterLayout
from compiler.determined.items import Context, Item
from compiler.determined.model import values_of
from compiler.determined.operations import Cell, Way, computed, equal_ways
from compiler.program import DomainConstant
from nddl_lang.text.source import Span


def equation(layout: RegisterLayout, a: Cell, b: Cell, context: Context, span: Span, name: str) -> Item:
    """Two values that are one: either tells the other."""
    return Item(context, span, name, (a.register, b.register), tuple(equal_ways(layout, a, b)))


def drawn(layout: RegisterLayout, target: Cell, number: int, context: Context, span: Span) -> Iterator[Item]:
    """A draw of the parameter `number`; into an int, where it is whole."""
    raw = target if target.is_real else Cell(layout.take(1), "float")
    way = Way((raw.register,), (), ((code.DRAW, raw.register, number),))
    yield Item(context, span, span.text, (raw.register,), (way,))
    if not target.is_real:
        way = computed(layout, code.COPY, target, (raw,))
        yield Item(context, span, span.text, (target.register, raw.register), (way,))


def within(
    layout: RegisterLayout,
    constant: Callable[[float], int],
    cell: Cell,
    domain: DomainConstant,
    context: Context,
    span: Span,
    name: str,
) -> Iterator[Item]:
    """A value within a domain; `constant` gives the register of a number."""
    allowed = values_of(domain, layout)
    if allowed is not None and len(allowed) == 1:
        yield equation(layout, cell, Cell(constant(allowed[0]), cell.kind), context, span, name)
    elif allowed is not None:
        first = layout.take(len(allowed))
        for k, value in enumerate(allowed):
            layout.presets[first + k] = value
        yield Item(context, span, name, (cell.register,), (), ((code.MEMBER, cell.register, first, len(allowed)),))
    elif domain.interval is not None:
        for bound, is_lower in zip(domain.interval, (True, False), strict=True):
            if abs(bound) < code.LARGEST:
                edge = constant(float(bound))
                pair = (edge, cell.register) if is_lower else (cell.register, edge)
                # A float beyond its bound by less than the tolerance would be moved: that is not for us.
                yield Item(context, span, name, (cell.register,), (), ((code.ORDER, *pair),))
