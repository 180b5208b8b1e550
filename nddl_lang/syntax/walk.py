"""Walk over a syntax tree and compare two of them, without recursion."""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any

_CONTENT: dict[type, tuple[str, ...]] = {}


def _content(kind: Any) -> tuple[str, ...]:
    """The fields of a node class besides its place."""
    found = _CONTENT.get(kind)
    if found is None:
        found = _CONTENT[kind] = tuple(one.name for one in fields(kind) if one.name not in ("span", "op_span"))
    return found


def children(node: Any) -> Iterator[Any]:
    """The nodes right below `node`, in written order."""
    for name in _content(type(node)):
        value = getattr(node, name)
        if type(value) is tuple:
            yield from value
        elif is_dataclass(value):
            yield value


def descendants(node: Any) -> Iterator[Any]:
    """`node` and all nodes below it, each before those below it."""
    pending = [node]
    while pending:
        node = pending.pop()
        yield node
        pending += reversed(list(children(node)))


def is_deeper(nodes: tuple[Any, ...], limit: int) -> bool:
    """Whether the trees below `nodes` have more than `limit` levels."""
    level = list(nodes)
    for _ in range(limit):
        if not level:
            return False
        level = [child for node in level for child in children(node)]
    return bool(level)


def same_tree(left: Any, right: Any) -> bool:
    """Whether both trees say the same; places do not count."""
    pending = [(left, right)]
    while pending:
        one, other = pending.pop()
        if type(one) is not type(other):
            return False
        if type(one) is tuple:
            if len(one) != len(other):
                return False
            pending += zip(one, other, strict=True)
        elif is_dataclass(one):
            pending += ((getattr(one, name), getattr(other, name)) for name in _content(type(one)))
        elif one != other:
            return False
    return True
