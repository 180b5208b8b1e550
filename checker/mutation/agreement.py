"""Both sides of `==` in; out: what else may be named where they are not of one type, as the other side's type asks.

`late == seats` holds a truth value to a number, and `ferment.end == wort` a moment to litres: no comparison of the two
can be meant. What a rule computes for itself may be a span of time; what a token's parameter measures hardly is. A
number may be a moment: what else may be named beside one is offered all the same.
"""

from collections.abc import Iterator, Mapping
from typing import Any

from checker.mutation.scope import LineScope
from nddl_lang.syntax.nodes import BinaryExpr, BoolLiteral, PathExpr
from nddl_lang.text.source import Span

_NUMBERS = ("int", "float")
_MOMENTS, _SPAN = ("start", "end"), "duration"
_MOMENT = "moment"
_TRUTH, _TRUTHS = "bool", ("true", "false")
_EVENT_TIME = "time"  # of what changes a resource


class Agreement:
    """The types of what may be named; `constants` are the global variables of the model with theirs."""

    def __init__(self, constants: Mapping[str, str]) -> None:
        self._constants = constants

    def kind_of(self, text: str, names: LineScope) -> str:
        """The type of a variable, constant or time as it is written; empty where it is none of these."""
        label, _, last = text.rpartition(".")
        if text in _TRUTHS:
            return _TRUTH
        if _is_event_time(text, names):
            return _MOMENT
        if label in ("", *names.tokens) and not names.type_of(tuple(text.split("."))):
            if last in _MOMENTS:
                return _MOMENT
            if last == _SPAN:
                return _SPAN
        return names.type_of(tuple(text.split("."))) or self._constants.get(text, "")

    def wanted(self, node: Any, names: LineScope) -> Iterator[tuple[Span, str]]:
        """Each side of `==` with the type that the other side asks of it, where the two disagree."""
        if not (isinstance(node, BinaryExpr) and node.op == "=="):
            return
        left, right = (self.kind_of(side.span.text, names) for side in (node.left, node.right))
        if left and right and left != right:
            yield node.left.span, right
            yield node.right.span, left

    def others(self, node: Any, names: LineScope) -> Iterator[tuple[Span, str]]:
        """What may be named on one side of `==` in place of what cannot be compared with the other.

        A parameter of a token that is held to a duration is to be said, so the duration is what is mistaken.
        """
        wanted = dict(self.wanted(node, names))
        is_apart = self.is_apart(node, names)
        for span, kind in wanted.items():
            other = next(one for one in wanted if one is not span)
            kinds = {kind, wanted[other]}
            is_said = kinds == {_SPAN, "int"} and "." in other.text
            is_doubtful = kinds == {_MOMENT, "int"} if kind == _MOMENT else is_said
            if kind != _SPAN and (is_apart or is_doubtful):
                yield from ((span, name) for name in self._named(kind, names) if name != other.text)

    def is_apart(self, node: Any, names: LineScope) -> bool:
        """Whether two names stand on both sides of `==` that can hardly be compared."""
        sides = (node.left, node.right) if isinstance(node, BinaryExpr) else ()
        if not sides or not all(isinstance(side, PathExpr | BoolLiteral) for side in sides):
            return False
        wanted = [(span.text, self.kind_of(span.text, names)) for span, _ in self.wanted(node, names)]
        is_event = any(_is_event_time(text, names) for text, _ in wanted)  # it comes when a token begins or ends
        return bool(wanted) and (is_event or _is_apart(*wanted[0], *wanted[1]))

    def _named(self, kind: str, names: LineScope) -> Iterator[str]:
        if kind == _MOMENT:
            labels = ("", *(label for label, shape in names.tokens.items() if not shape.is_event))
            yield from (f"{label}.{word}" if label else word for word in _MOMENTS for label in labels)
        else:
            yield from (name for name in names.alike(kind) if names.type_of(tuple(name.split("."))) == kind)


def _is_event_time(text: str, names: LineScope) -> bool:
    """Whether a path is the time at which something changes a resource."""
    label, _, last = text.rpartition(".")
    return label in names.tokens and names.tokens[label].is_event and last == _EVENT_TIME


def _is_apart(one: str, kind: str, other: str, other_kind: str) -> bool:
    """Whether two names, each with its type, can hardly be compared."""
    kinds = {kind, other_kind}
    if kinds == set(_NUMBERS) or kinds == {_SPAN, "int"}:
        return False
    if kinds == {_SPAN, "float"}:  # what a rule computes may be a span
        return "." in (one if kind == "float" else other)
    return kinds not in ({_MOMENT, "int"}, {_MOMENT, _SPAN})  # which time of a token is meant is asked elsewhere
