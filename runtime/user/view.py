"""What a modeler's constraint sees of its arguments while it runs: bounds and values to read, and ways to narrow them.

Numbers are floats or ints, truth values bools; enum values, objects and texts are their names as strings. Every
narrowing is recorded as caused by the constraint, with the line of the model that posted it.
"""

import math
from collections.abc import Iterable
from typing import Protocol, cast

from runtime.constraints.domains.base_domain import is_growing
from runtime.constraints.domains.tags import (
    FLOAT_TOLERANCE,
    HALF_INF,
    KIND_BOOL,
    KIND_FLOAT,
    KIND_INT,
)
from runtime.constraints.engine import Engine
from runtime.constraints.propagators.external import at_least, at_most, never, refuse

Value = float | int | bool | str
MOST_LISTED = 4096
NUMBERS = (KIND_FLOAT, KIND_INT, KIND_BOOL)


class Words(Protocol):
    """What turns numbers of the engine into names of the model, and back."""

    def text(self, kind: int, number: int) -> str:
        """The name of a value that is no number."""

    def number(self, kind: int, text: str) -> int | None:
        """The number of a name; None if nothing of that kind has it."""

    def source_place(self, span: int) -> str | None:
        """File and line of a stretch of the model; None where there is no model."""


class _Gone:
    """Stands for the engine once `propagate` has returned."""

    def __getattr__(self, name: str) -> object:
        raise RuntimeError(
            "a view is of no use after `propagate` has returned; remember nothing from one call to the next"
        )


_GONE = _Gone()


class View:
    """The arguments of one constraint, by their places from 0 on; of no use after `propagate` has returned.

    What narrows returns False when no value is left; then there is nothing more to do than to return False.
    """

    __slots__ = ("_c", "_engine", "_variables", "_words", "count")

    def __init__(self, engine: Engine, c: int, words: Words) -> None:
        self._engine = engine
        self._c = c
        self._words = words
        self._variables = engine.arguments(c)
        self.count = len(self._variables)  # how many arguments there are

    # ---- reading ----

    def lower(self, i: int) -> float:
        """The least value that a number may still have; -inf where there is no bound. True counts as 1."""
        return self._engine.lower(self._number(i))

    def upper(self, i: int) -> float:
        """The greatest value that a number may still have; inf where there is no bound."""
        return self._engine.upper(self._number(i))

    def is_whole(self, i: int) -> bool:
        """Whether an argument takes whole numbers only."""
        return bool(self._engine.kind[self._variable(i)] == KIND_INT)

    def is_single(self, i: int) -> bool:
        """Whether only one value is left (a float: an interval no wider than the tolerance)."""
        return bool(self._engine.is_singleton(self._variable(i)))

    def value(self, i: int) -> Value:
        """The only value that is left; ask `is_single` before."""
        v = self._variable(i)
        if not self.is_single(i):
            raise ValueError(f"argument {i} has several values yet; ask `is_single` first")
        engine = self._engine
        if engine.kind[v] == KIND_FLOAT:
            return engine.lower(v) + (engine.upper(v) - engine.lower(v)) * 0.5
        return self._told(v, int(engine.lb[v]))

    def values(self, i: int) -> list[Value] | None:
        """All values that are left, in a fixed order; None if they are infinitely or very many, or more may join."""
        v = self._variable(i)
        if self.is_single(i):
            return [self.value(i)]
        engine = self._engine
        if not engine.is_finite(v) or engine.size(v) > MOST_LISTED:
            return None
        found = engine.values_of(v)
        if engine.kind[v] == KIND_FLOAT:
            return [float(x) for x in found]
        return [self._told(v, int(x)) for x in found]

    def may_be(self, i: int, value: Value) -> bool:
        """Whether an argument may still have a value."""
        v = self._variable(i)
        number = self._coded(v, value)
        if number is None:
            return False
        return bool(is_growing(self._engine, v) or self._engine.contains(v, number))

    # ---- narrowing ----

    def raise_to(self, i: int, x: float) -> bool:
        """Let a number be at least `x`; for whole numbers `x` is rounded up."""
        return self._has_value(at_least(self._engine, self._c, self._number(i), _bound(x, math.inf)))

    def reduce_to(self, i: int, x: float) -> bool:
        """Let a number be at most `x`; for whole numbers `x` is rounded down."""
        return self._has_value(at_most(self._engine, self._c, self._number(i), _bound(x, -math.inf)))

    def fix(self, i: int, value: Value) -> bool:
        """Leave an argument one value."""
        v = self._variable(i)
        number = self._coded(v, value)
        if number is None:
            return self.fail()
        holds = at_least(self._engine, self._c, v, number) and at_most(self._engine, self._c, v, number)
        return self._has_value(holds)

    def remove(self, i: int, value: Value) -> bool:
        """Take one value away; from a float that goes only where nothing else was left."""
        v = self._variable(i)
        number = self._coded(v, value)
        if number is None:
            return True
        if self._engine.kind[v] != KIND_FLOAT:
            return self._has_value(number != int(number) or never(self._engine, self._c, v, int(number)))
        low, high = self._engine.lower(v), self._engine.upper(v)
        return low != high or low != number or self.fail()

    def keep(self, i: int, values: Iterable[Value]) -> bool:
        """Leave an argument only such values as are listed here (of floats: what lies between them)."""
        v = self._variable(i)
        kept = {number for number in (self._coded(v, value) for value in values) if number is not None}
        if not kept:
            return self.fail()
        if not self._has_value(at_least(self._engine, self._c, v, min(kept))):
            return False
        if not self._has_value(at_most(self._engine, self._c, v, max(kept))):
            return False
        engine = self._engine
        if engine.kind[v] != KIND_FLOAT and engine.is_finite(v) and engine.size(v) <= MOST_LISTED:
            for x in engine.values_of(v):
                if x not in kept and not never(engine, self._c, v, int(x)):
                    return False
        return True

    def fail(self) -> bool:
        """Say that the constraint cannot hold; always False."""
        return refuse(self._engine, self._c) if self._engine.consistent else False

    @property
    def has_failed(self) -> bool:
        """Whether no value was left somewhere; nothing can be narrowed any more."""
        return not self._engine.consistent

    # ---- inside ----

    def close(self) -> None:
        """Be of no use from now on: what a modeler keeps would speak of another moment, or of another plan."""
        self._engine = cast(Engine, _GONE)

    def _variable(self, i: int) -> int:
        if not 0 <= i < self.count:
            raise IndexError(f"there is no argument {i}; there are {self.count}, counted from 0")
        return self._variables[i]

    def _number(self, i: int) -> int:
        v = self._variable(i)
        if self._engine.kind[v] not in NUMBERS:
            raise TypeError(f"argument {i} is no number: it has no bounds, but `values`")
        return v

    def _has_value(self, holds: bool) -> bool:
        return bool(holds and self._engine.consistent)

    def _told(self, v: int, number: int) -> Value:
        kind = self._engine.kind[v]
        if kind == KIND_BOOL:
            return number != 0
        return number if kind == KIND_INT else self._words.text(kind, number)

    def _coded(self, v: int, value: Value) -> float | None:
        """A value as the engine keeps it; None if it can be no value of this argument."""
        kind = self._engine.kind[v]
        if isinstance(value, str):
            if kind in NUMBERS:
                raise TypeError(f"{value!r} is no number")
            return self._words.number(kind, value)
        if kind not in NUMBERS:
            raise TypeError(f"{value!r} is no name, and the values of this argument have names")
        number = float(value)
        if math.isnan(number):
            raise ValueError("nan is no value")
        if math.isinf(number) or abs(number) >= HALF_INF:
            return None
        if kind == KIND_FLOAT:
            return number
        whole = round(number)
        return whole if abs(number - whole) <= FLOAT_TOLERANCE else None


def _bound(x: float, impossible: float) -> float:
    number = float(x)
    if math.isnan(number):
        raise ValueError("nan is no bound")
    if number == impossible:
        raise ValueError(f"no number reaches {number}; say `fail()` where nothing fits")
    return number
