# cython: boundscheck=False
"""Compact log of a determined reactor: tokens that started, with their parameters, and draws, oldest first."""

import weakref
from array import array
from typing import Any

import numpy as np
from numpy.typing import NDArray

from runtime.determined.tags import BLOCK, CAUSE, EVENT, FAR, KIND, LINE, ROW, SHOWN, VALUES

_MOST_KEPT = 3  # pieces of memory of each kind
_Array = NDArray[Any]


class _Stock:
    """Memory of logs that nobody looks at any more, for logs to come: fresh pages cost more than what is written there.

    Of each kind of numbers it keeps the largest few; a lease is a view whose last holder gives the memory back.
    """

    def __init__(self, kind: type) -> None:
        self.kind = kind
        self.owned: list[tuple[_Array, weakref.ref[_Array]]] = []  # the smallest first

    def room(self, least: int) -> "memoryview[Any]":
        """Room for `least` numbers or more, whatever they are."""
        idle = [k for k, (memory, lease) in enumerate(self.owned) if lease() is None and len(memory) >= least]
        memory = self.owned.pop(idle[len(idle) - 1])[0] if idle else np.empty(least, self.kind)
        lease = memory.view()
        self.owned.append((memory, weakref.ref(lease)))
        self.owned.sort(key=_size)
        del self.owned[:-_MOST_KEPT]
        return lease.data

    def more(self, old: "memoryview[Any]", used: int) -> "memoryview[Any]":
        """Room for twice as many numbers, with those of `old`, whose memory is not kept: it has proved too small."""
        room = self.room(2 * len(old))
        room[:used] = old[:used]
        outgrown = getattr(old, "base", old).obj  # compiled, an attribute gives a view of the view
        self.owned = [one for one in self.owned if one[1]() is not outgrown]
        return room


def _size(one: tuple[_Array, object]) -> int:
    return len(one[0])


_WHOLE, _REAL = _Stock(np.int64), _Stock(np.float64)


class Log:
    """Arrays that grow by doubling; `told` has the rows that are part of the trace, in the order of their events."""

    def __init__(self, lines: int) -> None:
        self.rows: memoryview[int] = _WHOLE.room(ROW * 256)
        self.values: memoryview[float] = _REAL.room(1024)
        self.draws = array("q", bytes(8 * 2 * 64))  # tick, parameter
        self.told: memoryview[int] = _WHOLE.room(256)
        self.latest = array("q", [-1]) * lines  # the latest event of each timeline
        self.order = array("q", bytes(8 * lines))  # own timelines, as they are told
        self.shown = 0  # how many of them
        self.row_count = 0
        self.row_capacity = len(self.rows) // ROW
        self.value_count = 0
        self.value_capacity = len(self.values)
        self.draw_count = 0
        self.draw_capacity = 64
        self.told_count = 0
        self.told_rows = 0  # how many rows have been told
        self.told_draws = 0

    def note(self, tick: int, line: int, predicate: int, block: int) -> int:
        """Add a token; its row."""
        if self.row_count == self.row_capacity:
            self.grow_rows()
        at = ROW * self.row_count
        self.rows[at] = tick
        self.rows[at + LINE] = line
        self.rows[at + KIND] = predicate
        self.rows[at + BLOCK] = block
        self.rows[at + VALUES] = -1
        self.rows[at + SHOWN] = 0
        self.row_count += 1
        return self.row_count - 1

    def room(self, count: int) -> int:
        """Room for `count` values; the index of the first."""
        while self.value_count + count > self.value_capacity:
            self.grow_values()
        self.value_count += count
        return self.value_count - count

    def note_draw(self, tick: int, parameter: int) -> int:
        """Add a draw."""
        if self.draw_count == self.draw_capacity:
            self.draws = array("q", bytes(self.draws) + bytes(8 * 2 * self.draw_capacity))
            self.draw_capacity *= 2
        self.draws[2 * self.draw_count] = tick
        self.draws[2 * self.draw_count + 1] = parameter
        self.draw_count += 1
        return 0

    def forget_from(self, tick: int) -> int:
        """Take back what happened at `tick` or later; what was told of it will come again."""
        while self.row_count and self.rows[ROW * (self.row_count - 1)] >= tick:
            self.row_count -= 1
            if self.rows[ROW * self.row_count + 4] >= 0:
                self.value_count = self.rows[ROW * self.row_count + 4]
        while self.draw_count and self.draws[2 * (self.draw_count - 1)] >= tick:
            self.draw_count -= 1
        self.told_draws = min(self.told_draws, self.draw_count)
        return 0

    def next_tick(self) -> int:
        """The tick of the first row that has not been told."""
        return self.rows[ROW * self.told_rows] if self.told_rows < self.row_count else FAR

    def next_change(self, watched: int) -> int:
        """The tick of the first row that has not been told and that is on one of the timelines `watched`."""
        for row in range(self.told_rows, self.row_count):
            if watched >> self.rows[ROW * row + 1] & 1:
                return self.rows[ROW * row]
        return FAR

    def tell(self, until: int, busy: int, event: int) -> int:
        """Number the tokens of whole ticks up to `until` as events, from `event` on; how many have been numbered.

        It stops before a tick with a draw, or with a token on a timeline of `busy`.
        """
        row = self.told_rows
        drawn = self.draws[2 * self.told_draws] if self.told_draws < self.draw_count else FAR
        first = event
        while row < self.row_count:
            tick = self.rows[ROW * row]
            if tick > until or tick >= drawn:
                break
            changed = 0
            last = row
            while last < self.row_count and self.rows[ROW * last] == tick:
                changed |= 1 << self.rows[ROW * last + 1]
                last += 1
            if changed & busy:
                break
            for k in range(self.shown):
                line = self.order[k]
                if changed >> line & 1:
                    self.tell_row(self.row_of(line, row), event, self.latest[line])
                    event += 1
            row = last
        self.told_rows = row
        return event - first

    def row_of(self, line: int, row: int) -> int:
        """The row of a timeline's token that started at the tick of `row`, the first of that tick."""
        while self.rows[ROW * row + 1] != line:
            row += 1
        return row

    def tell_row(self, row: int, event: int, cause: int) -> int:
        """Number one token."""
        if self.told_count == len(self.told):
            self.told = _WHOLE.more(self.told, self.told_count)
        self.told[self.told_count] = row
        self.told_count += 1
        self.rows[ROW * row + EVENT] = event
        self.rows[ROW * row + CAUSE] = cause
        self.latest[self.rows[ROW * row + 1]] = event
        return 0

    def row(self, row: int) -> tuple[int, ...]:
        """The columns of a row."""
        at = ROW * row
        return (
            self.rows[at],
            self.rows[at + LINE],
            self.rows[at + KIND],
            self.rows[at + BLOCK],
            self.rows[at + VALUES],
            self.rows[at + EVENT],
            self.rows[at + CAUSE],
        )

    def values_from(self, first: int, count: int) -> list[float]:
        """Parameters of a token."""
        return [self.values[first + k] for k in range(count)]

    def grow_rows(self) -> int:
        """Make room for twice as many tokens."""
        self.rows = _WHOLE.more(self.rows, ROW * self.row_capacity)
        self.row_capacity = len(self.rows) // ROW
        return 0

    def grow_values(self) -> int:
        """Make room for twice as many parameters."""
        self.values = _REAL.more(self.values, self.value_capacity)
        self.value_capacity = len(self.values)
        return 0
