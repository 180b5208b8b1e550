# cython: boundscheck=False
"""Register machine: ticks go in, tokens that start come out; no plan database, no propagation.

At a tick the machine finds what must end (its latest end is now, or something that was asked for may start) and runs
the block of what starts in its place, timelines in causal order. It stops at whatever the code does not foresee: a
value that is not known, a constraint that does not hold, bounds without a value. What it has written by then is void:
who runs it goes back to a snapshot, or hands over. Operations are numbered as in `compiler.determined.code`.
"""

import math
from array import array

from runtime.determined.log import Log
from runtime.determined.present import Present
from runtime.determined.tables import CodeTables
from runtime.determined.tags import (
    BEFORE,
    CHANGES,
    COARSE,
    DUE,
    ENDING,
    FOLLOWER,
    KIND,
    LINE,
    NONE,
    OWNER,
    PREDICATE,
    ROW,
    RUNS_ON,
    SHOWN,
    STOPS,
    VALUES,
    WISH,
    WISH_FROM,
    WISHED,
)
from runtime.determined.trial import can_follow, comes_between, fits_within, holds, leaves_next

_NAN, _TOLERANCE, _LARGEST = float("nan"), 1e-5, 2.0**51  # that of the engine's floats; what is larger is infinite


class Machine:
    """A reactor's code, registers and timelines."""

    def __init__(self, lines: int, tables: CodeTables, world: object) -> None:
        self.lines = lines
        self.tables = tables
        self.world = world  # draws the sampled parameters
        self.present = Present(lines)
        self.log = Log(lines)
        self.registers = array("d", [0.0])
        self.kept = array("d", [0.0])
        self.is_trial = False  # is a start tried out, when nothing else is about to end
        self.is_planned = False  # what starts was asked for or followed, it is not the default
        self.sample_value = array("d", [0.0])
        self.sample_until = array("q", [NONE])
        self.kept_value = array("d", [0.0])
        self.kept_until = array("q", [NONE])
        self.root_row = 0
        self.shows = False  # whether the values of rules are logged too, for the record
        self.why = RUNS_ON

    def keep(self) -> int:
        """Take a snapshot."""
        self.present.kept[:] = self.present.state
        self.kept[:] = self.registers
        self.kept_value[:] = self.sample_value
        self.kept_until[:] = self.sample_until
        return 0

    def go_back(self) -> int:
        """Return to the snapshot."""
        self.present.state[:] = self.present.kept
        self.registers[:] = self.kept
        self.sample_value[:] = self.kept_value
        self.sample_until[:] = self.kept_until
        return 0

    def run(self, tick: int, limit: int, watched: int) -> int:
        """Carry out the ticks after `tick`, up to `limit` or to the first at which a timeline in `watched` changes.

        The last tick that was carried out is returned; `why` tells what ended the run.
        """
        present = self.present
        present.steady = NONE
        while True:
            due = present.coming(tick)
            if due > limit:
                self.why = RUNS_ON
                return limit
            if not (self.start_all(due) if present.steps_alone(due) else self.tick(due)):
                self.why = STOPS
                self.log.forget_from(due)
                return due - 1
            tick = due
            if present.changed & watched:
                self.why = CHANGES
                return tick

    def tick(self, tick: int) -> bool:
        """Carry out one tick; false if the machine does not know how."""
        n = self.lines
        tables = self.tables
        present = self.present
        if not present.begin_tick(tick) or comes_between(present):
            return False
        # What follows goes aside before the blocks of this tick say what follows next.
        for i in range(n):
            if present.state[FOLLOWER * n + i] >= 0 and present.state[ENDING * n + present.state[OWNER * n + i]]:
                present.state[DUE * n + i] = present.state[FOLLOWER * n + i]
                present.state[FOLLOWER * n + i] = NONE
                if present.state[OWNER * n + i] != i:
                    first, into = tables.following[i], tables.incoming[i]
                    for j in range(tables.width[i]):
                        self.registers[into + j] = self.registers[first + j]
        return self.start_all(tick)

    def start_all(self, tick: int) -> bool:
        """Start what takes the place of all that ends; false if the machine does not know how."""
        n = self.lines
        present = self.present
        self.registers[0] = tick
        if present.steady >= 0:
            return self.start_block(present.steady, tick) and present.end_tick(tick)
        for k in range(n):
            i = self.tables.order[k]
            if i < 0:
                break
            if present.changed >> i & 1 or (
                present.state[PREDICATE * n + i] >= 0 and not present.state[ENDING * n + i]
            ):
                continue  # it has started already, or what holds goes on
            if not self.start_block(i, tick):
                return False
        return can_follow(present, self.tables) and present.end_tick(tick)

    def can_start(self, i: int, tick: int) -> bool:
        """Try out whether what was asked for on a timeline has consistent values; the caller goes back."""
        n = self.lines
        present = self.present
        present.now = tick
        present.changed = 0
        self.registers[0] = tick
        for j in range(n):
            present.state[ENDING * n + j] = 1
            present.state[DUE * n + j] = NONE
        present.state[WISH_FROM * n + i] = tick
        self.is_trial = True
        can = self.start_block(i, tick) and fits_within(present, i)
        self.is_trial = False
        return can

    def start_block(self, i: int, tick: int) -> bool:
        """Start what takes the place of what has ended on a timeline."""
        n = self.lines
        tables = self.tables
        present = self.present
        block = present.state[DUE * n + i]
        is_wish = False
        self.is_planned = True
        if block < 0:
            if present.state[WISH * n + i] >= 0 and present.state[WISH_FROM * n + i] <= tick:
                block = present.state[WISH * n + i]
                present.state[WISH * n + i] = NONE
                is_wish = True
            elif present.is_used[i]:
                return bool(present.state[PREDICATE * n + i] < 0)  # nobody has published anything yet
            else:
                block = tables.default_block[i]
                self.is_planned = False
        if block <= 0:
            return False
        self.start(i, tables.block_predicate[block])
        mask = tables.block_mask[block]
        is_own = present.state[DUE * n + i] >= 0 and present.state[OWNER * n + i] == i
        first = tables.following[i] if is_own else tables.wished[i] if is_wish else tables.incoming[i]
        into = tables.current[i]
        j = 0
        while mask:
            if mask & 1:
                self.registers[into + j] = self.registers[first + j]
            mask >>= 1
            j += 1
        predicate = tables.block_predicate[block]
        self.root_row = self.log.note(tick, i, predicate, block | WISHED if is_wish else block)
        is_done = self.carry_out(tables.block_start[block])
        if is_done and is_wish:
            present.begin_wish(i)
        return is_done and self.write_down(block)

    def write_down(self, block: int) -> bool:
        """Log the tokens that a block has begun, and what it shows; false if a parameter is too large, or missing."""
        tables = self.tables
        log = self.log
        is_sure = tables.block_sure[block]
        for row in range(self.root_row, log.row_count):
            first = tables.current[log.rows[ROW * row + LINE]]
            width = tables.size[log.rows[ROW * row + KIND]]
            into = log.room(width)
            log.rows[ROW * row + VALUES] = into
            for j in range(width):
                value = self.registers[first + j]
                if not abs(value) < COARSE and (is_sure or value == value):
                    return False
                log.values[into + j] = value
        if self.shows:
            first = tables.shown_first[block]
            width = tables.shown_first[block + 1] - first
            into = log.room(width)
            log.rows[ROW * self.root_row + SHOWN] = into
            for j in range(width):
                log.values[into + j] = self.registers[tables.shown[first + j]]
        return True

    def start(self, i: int, predicate: int) -> int:
        """Make a token of `predicate` the current one of a timeline; nothing is known of it but its start."""
        tables = self.tables
        self.present.start(i, predicate)
        self.registers[tables.starts[i]] = self.present.now
        first = tables.current[i]
        if tables.remembers[i]:
            for j in range(tables.width[i]):
                self.registers[tables.previous[i] + j] = self.registers[first + j]
        for j in range(first, first + tables.width[i]):
            self.registers[j] = _NAN
        return 0

    def carry_out(self, at: int) -> bool:
        """Run the code from an instruction to its end; false if it stops before."""
        n = self.lines
        tables = self.tables
        present = self.present
        while True:
            op = tables.code[at]
            out = tables.code[at + 1]
            a = tables.code[at + 2]
            b = tables.code[at + 3]
            at += 8
            if op == 0:  # HALT
                return True
            if op == 1:  # COPY
                self.registers[out] = self.registers[a]
            elif op == 2:  # ADD
                self.registers[out] = self.registers[a] + self.registers[b]
            elif op == 3:  # SUB
                self.registers[out] = self.registers[a] - self.registers[b]
            elif op == 4:  # MUL
                self.registers[out] = self.registers[a] * self.registers[b]
            elif op == 5:  # DIV
                if self.registers[b] == 0.0:
                    return False
                self.registers[out] = self.registers[a] / self.registers[b]
            elif op == 6:  # NEG
                self.registers[out] = -self.registers[a]
            elif op == 7:  # ABS
                self.registers[out] = abs(self.registers[a])
            elif op == 8:  # MIN
                self.registers[out] = self.registers[a] if self.registers[a] <= self.registers[b] else self.registers[b]
            elif op == 9:  # MAX
                self.registers[out] = self.registers[a] if self.registers[a] >= self.registers[b] else self.registers[b]
            elif op == 10:  # SQRT
                if self.registers[a] < 0.0:
                    return False
                self.registers[out] = math.sqrt(self.registers[a])
            elif op == 11:  # FLOOR
                if not -_LARGEST < self.registers[a] < _LARGEST:
                    return False
                self.registers[out] = math.floor(self.registers[a] + _TOLERANCE)
            elif op == 12:  # CEIL
                if not -_LARGEST < self.registers[a] < _LARGEST:
                    return False
                self.registers[out] = math.ceil(self.registers[a] - _TOLERANCE)
            elif op == 13:  # MOD
                if self.registers[b] == 0.0 or not -_LARGEST < self.registers[a] < _LARGEST:
                    return False
                self.registers[out] = math.fmod(self.registers[a], self.registers[b])
            elif op == 14:  # WHOLE
                if not -_LARGEST < self.registers[a] < _LARGEST:
                    return False
                self.registers[out] = math.ceil(self.registers[a] - _TOLERANCE)
                if self.registers[out] != math.floor(self.registers[a] + _TOLERANCE):
                    return False
            elif op == 15:  # LEQ
                self.registers[out] = 1.0 if self.registers[a] <= self.registers[b] + _TOLERANCE else 0.0
            elif op == 16:  # LESS
                self.registers[out] = 1.0 if self.registers[a] + _TOLERANCE <= self.registers[b] else 0.0
            elif op == 17:  # EQUAL
                x, y = self.registers[a], self.registers[b]
                self.registers[out] = 1.0 if x <= y + _TOLERANCE and y <= x + _TOLERANCE else 0.0
            elif op == 18:  # SAME
                self.registers[out] = 1.0 if self.registers[a] == self.registers[b] else 0.0
            elif op == 19:  # NOT
                self.registers[out] = 1.0 if self.registers[a] == 0.0 else 0.0
            elif op == 20:  # AND
                self.registers[out] = 1.0 if self.registers[a] != 0.0 and self.registers[b] != 0.0 else 0.0
            elif op == 21:  # OR
                self.registers[out] = 1.0 if self.registers[a] != 0.0 or self.registers[b] != 0.0 else 0.0
            elif op == 22:  # DISTANCE
                x = self.registers[a] - self.registers[tables.code[at - 4]]
                y = self.registers[b] - self.registers[tables.code[at - 3]]
                self.registers[out] = math.sqrt(x * x + y * y)
            elif op == 23:  # TOWARDS
                x = self.registers[tables.code[at - 3]] - self.registers[b]
                y = self.registers[tables.code[at - 2]] - self.registers[tables.code[at - 4]]
                z = math.sqrt(x * x + y * y)
                self.registers[out] = x / z if z > 0.0 else x
                self.registers[a] = y / z if z > 0.0 else y
            elif op == 24:  # TRAVEL
                x = self.registers[tables.code[at - 4]] - self.registers[a]
                y = self.registers[tables.code[at - 3]] - self.registers[b]
                z = self.registers[tables.code[at - 2]]
                if z <= 0.0:
                    return False
                z = math.sqrt(x * x + y * y) / z - 1e-9
                if not z < _LARGEST:
                    return False
                self.registers[out] = max(1.0, math.ceil(z))
            elif op == 25:  # UNIFY
                if self.registers[out] != self.registers[out]:
                    self.registers[out] = self.registers[a]
                elif self.registers[out] != self.registers[a]:
                    return False
            elif op == 26:  # NEED
                for j in range(out, out + a):
                    if not -_LARGEST < self.registers[j] < _LARGEST:
                        return False
            elif op == 27:  # HOLD
                if self.registers[out] == 0.0:
                    return False
            elif op == 28:  # CLEAR
                for j in range(out, out + a):
                    self.registers[j] = _NAN
            elif op == 29:  # WHEN_FALSE
                if self.registers[out] == 0.0:
                    at = 8 * a
            elif op == 30:  # WHEN_TRUE
                if self.registers[out] != 0.0:
                    at = 8 * a
            elif op == 31:  # DRAW
                is_old = self.sample_until[a] <= present.now
                if is_old and not self.world.draw(self, a, present.now):  # type: ignore[attr-defined]
                    return False
                self.registers[out] = self.sample_value[a]
            elif op == 32:  # MOVE
                for j in range(b):
                    self.registers[out + j] = self.registers[a + j]
            elif op == 33:  # MUL_ADD
                z = self.registers[a] * self.registers[b]
                self.registers[out] = z + self.registers[tables.code[at - 4]]
            elif op == 34:  # UNLESS_SAME
                self.registers[out] = 1.0 if self.registers[a] == self.registers[b] else 0.0
                if self.registers[a] != self.registers[b]:
                    at = 8 * tables.code[at - 4]
            elif op == 35:  # BEGIN
                if present.changed >> out & 1 or present.state[DUE * n + out] >= 0:
                    return False
                if present.state[PREDICATE * n + out] >= 0 and not present.state[ENDING * n + out]:
                    if not present.end_with(out) or leaves_next(present):
                        return False
                self.start(out, a)
                self.log.note(present.now, out, a, -1 - self.root_row)
            elif op == 36:  # MERGE
                if not holds(present, tables, out, a, self.is_trial):
                    return False
            elif op == 37:  # PREVIOUS
                if present.state[BEFORE * n + out] != a:
                    return False
            elif op == 38:  # FOLLOW
                j = tables.code[at - 2]
                if present.state[FOLLOWER * n + out] >= 0 or j <= 0:
                    return False
                if present.state[DUE * n + out] >= 0 and not present.changed >> out & 1:
                    return False  # what is due there has not been taken yet
                present.follow(out, a, j)
            elif op in (39, 40, 41):  # LAST_EXACTLY, LAST_LEAST, LAST_MOST
                z = self.registers[a]
                if not -_LARGEST < z < _LARGEST or z != math.floor(z):
                    return False
                present.bound(out, int(z), op != 41, op != 40)
            elif op == 42:  # TIE
                present.tie(out, a)
            elif op == 43:  # WITHIN
                if not present.put_within(out, a):
                    return False
            elif op == 44:  # MEMBER
                j = 0
                while j < b and self.registers[a + j] != self.registers[out]:
                    j += 1
                if j == b:
                    return False
            elif op == 45:  # ORDER
                if not self.registers[out] <= self.registers[a]:
                    return False
            elif op == 46:  # PLANNED
                if not self.is_planned:
                    return False
            elif op == 47:  # COPIES
                self.registers[out] = self.registers[a]
                self.registers[b] = self.registers[tables.code[at - 4]]
                self.registers[tables.code[at - 3]] = self.registers[tables.code[at - 2]]
