"""Compact log of a determined reactor: tokens that started, with their parameters, and draws, oldest first."""

from array import array

from runtime.determined.tags import ROW


class Log:
    """Arrays that grow by doubling."""

    def __init__(self) -> None:
        self.rows = array("q", bytes(8 * ROW * 256))
        self.values = array("d", bytes(8 * 1024))
        self.draws = array("q", bytes(8 * 2 * 64))  # tick, parameter
        self.row_count = 0
        self.row_capacity = 256
        self.value_count = 0
        self.value_capacity = 1024
        self.draw_count = 0
        self.draw_capacity = 64

    def note(self, tick: int, line: int, predicate: int, block: int) -> int:
        """Add a token; its row."""
        if self.row_count == self.row_capacity:
            self.grow_rows()
        at = ROW * self.row_count
        self.rows[at] = tick
        self.rows[at + 1] = line
        self.rows[at + 2] = predicate
        self.rows[at + 3] = block
        self.rows[at + 4] = -1
        self.row_count += 1
        return self.row_count - 1

    def take(self, row: int, width: int) -> int:
        """Make room for the parameters of a token; where they go."""
        while self.value_count + width > self.value_capacity:
            self.grow_values()
        at = self.value_count
        self.rows[ROW * row + 4] = at
        self.value_count = at + width
        return at

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
        """Take back what happened at `tick` or later."""
        while self.row_count and self.rows[ROW * (self.row_count - 1)] >= tick:
            self.row_count -= 1
            if self.rows[ROW * self.row_count + 4] >= 0:
                self.value_count = self.rows[ROW * self.row_count + 4]
        while self.draw_count and self.draws[2 * (self.draw_count - 1)] >= tick:
            self.draw_count -= 1
        return 0

    def grow_rows(self) -> int:
        """Make room for twice as many tokens."""
        more = array("q", bytes(8 * ROW * 2 * self.row_capacity))
        more[: ROW * self.row_capacity] = array("q", bytes(self.rows))
        self.rows = more
        self.row_capacity *= 2
        return 0

    def grow_values(self) -> int:
        """Make room for twice as many parameters."""
        more = array("d", bytes(8 * 2 * self.value_capacity))
        more[: self.value_capacity] = array("d", bytes(self.values))
        self.values = more
        self.value_capacity *= 2
        return 0
