# cython: boundscheck=False
"""Register machine: ticks go in, tokens that start come out; no plan database, no propagation.

At a tick the machine finds what must end (its latest end is now, or something that was asked for may start) and runs
the block of what starts in its place, timelines in causal order. It stops at whatever the code does not foresee: a
value that is not known, a constraint that does not hold, bounds without a value. What it has written by then is void;
who runs it goes back to a snapshot, or hands over to the general engine. The operations are those of
`compiler.determined.code`, by numbers of which the C compiler makes a jump table.
"""

import math
from array import array

from runtime.determined.log import Log
from runtime.determined.present import Present
from runtime.determined.tags import (
    CHANGES,
    DUE,
    ENDING,
    FOLLOWER,
    LEAST,
    MOST,
    NONE,
    OWNER,
    PREDICATE,
    ROW,
    RUNS_ON,
    STOPS,
    WISH,
    WISH_END_FROM,
    WISH_END_UNTIL,
    WISH_FROM,
    WISH_LEAST,
    WISH_MOST,
    WISHED,
)

_NAN, _TOLERANCE = float("nan"), 1e-5  # the tolerance is that of the engine's floats
_LARGEST = 2.0**51  # what is larger counts as infinite


class Machine:
    """A reactor's code, registers and timelines."""

    def __init__(self, lines: int, world: object) -> None:
        self.lines = lines
        self.world = world  # draws the sampled parameters
        self.present = Present(lines)
        self.log = Log(lines)
        self.registers = array("d", [0.0])
        self.kept = array("d", [0.0])
        self.current = array("q", bytes(8 * lines))  # banks of registers
        self.following = array("q", bytes(8 * lines))
        self.incoming = array("q", bytes(8 * lines))
        self.wished = array("q", bytes(8 * lines))
        self.previous = array("q", bytes(8 * lines))
        self.remembers = array("q", bytes(8 * lines))
        self.starts = array("q", bytes(8 * lines))
        self.is_trial = False  # is a start tried out, when nothing else is about to end
        self.is_planned = False  # what starts was asked for or followed, it is not the default
        self.width = array("q", bytes(8 * lines))
        self.default_block = array("q", bytes(8 * lines))
        self.order = array("q", [NONE])
        self.code = array("i", bytes(4 * 8))
        self.block_start = array("q", [0])
        self.block_predicate = array("q", [NONE])
        self.block_mask = array("q", [0])
        self.sample_value = array("d", [0.0])
        self.sample_until = array("q", [NONE])
        self.kept_value = array("d", [0.0])
        self.kept_until = array("q", [NONE])
        self.root_row = 0
        self.shows = False  # whether the values of rules are logged too, for the record
        self.shown = array("q", [0])  # registers, block after block
        self.shown_first = array("q", [0])
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
        present = self.present
        if not present.begin_tick(tick):
            return False
        # What follows goes aside before the blocks of this tick say what follows next.
        for i in range(n):
            if present.state[FOLLOWER * n + i] >= 0 and present.state[ENDING * n + present.state[OWNER * n + i]]:
                present.state[DUE * n + i] = present.state[FOLLOWER * n + i]
                present.state[FOLLOWER * n + i] = NONE
                if present.state[OWNER * n + i] != i:
                    first = self.following[i]
                    into = self.incoming[i]
                    for j in range(self.width[i]):
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
            i = self.order[k]
            if i < 0:
                break
            if present.changed >> i & 1 or (
                present.state[PREDICATE * n + i] >= 0 and not present.state[ENDING * n + i]
            ):
                continue  # it has started already, or what holds goes on
            if not self.start_block(i, tick):
                return False
        return present.end_tick(tick)

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
        can = self.start_block(i, tick) and present.has_length(i)
        self.is_trial = False
        return can

    def start_block(self, i: int, tick: int) -> bool:
        """Start what takes the place of what has ended on a timeline."""
        n = self.lines
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
                block = self.default_block[i]
                self.is_planned = False
        if block <= 0:
            return False
        self.start(i, self.block_predicate[block])
        mask = self.block_mask[block]
        is_own = present.state[DUE * n + i] >= 0 and present.state[OWNER * n + i] == i
        first = self.following[i] if is_own else self.wished[i] if is_wish else self.incoming[i]
        into = self.current[i]
        r = self.registers
        for j in range(self.width[i]):
            if mask >> j & 1:
                r[into + j] = r[first + j]
        if is_wish:
            present.state[LEAST * n + i] = max(
                tick + present.state[WISH_LEAST * n + i], present.state[WISH_END_FROM * n + i], tick + 1
            )
            present.state[MOST * n + i] = min(
                tick + present.state[WISH_MOST * n + i], present.state[WISH_END_UNTIL * n + i]
            )
        log = self.log
        self.root_row = log.note(tick, i, self.block_predicate[block], block | WISHED if is_wish else block)
        if not self.carry_out(self.block_start[block]):
            return False
        for row in range(self.root_row, log.row_count):
            line = log.rows[ROW * row + 1]
            if not log.put(row, r, self.current[line], self.width[line]):
                return False
        if self.shows:
            log.show(self.root_row, r, self.shown, self.shown_first[block], self.shown_first[block + 1])
        return True

    def start(self, i: int, predicate: int) -> int:
        """Make a token of `predicate` the current one of a timeline; nothing is known of it but its start."""
        self.present.start(i, predicate)
        self.registers[self.starts[i]] = self.present.now
        first = self.current[i]
        r = self.registers
        if self.remembers[i]:
            into = self.previous[i]
            for j in range(self.width[i]):
                r[into + j] = r[first + j]
        for j in range(self.width[i]):
            r[first + j] = _NAN
        return 0

    def carry_out(self, at: int) -> bool:
        """Run the code from an instruction to its end; false if it stops before."""
        code = self.code
        r = self.registers
        while True:
            op = code[at]
            out = code[at + 1]
            a = code[at + 2]
            b = code[at + 3]
            at += 8
            if op == 0:  # HALT
                return True
            if op == 1:  # COPY
                r[out] = r[a]
            elif op == 2:  # ADD
                r[out] = r[a] + r[b]
            elif op == 3:  # SUB
                r[out] = r[a] - r[b]
            elif op == 4:  # MUL
                r[out] = r[a] * r[b]
            elif op == 5:  # DIV
                if r[b] == 0.0:
                    return False
                r[out] = r[a] / r[b]
            elif op == 6:  # NEG
                r[out] = -r[a]
            elif op == 7:  # ABS
                r[out] = abs(r[a])
            elif op == 8:  # MIN
                r[out] = r[a] if r[a] <= r[b] else r[b]
            elif op == 9:  # MAX
                r[out] = r[a] if r[a] >= r[b] else r[b]
            elif op == 10:  # SQRT
                if r[a] < 0.0:
                    return False
                r[out] = math.sqrt(r[a])
            elif op == 11:  # FLOOR
                if not -_LARGEST < r[a] < _LARGEST:
                    return False
                r[out] = math.floor(r[a] + _TOLERANCE)
            elif op == 12:  # CEIL
                if not -_LARGEST < r[a] < _LARGEST:
                    return False
                r[out] = math.ceil(r[a] - _TOLERANCE)
            elif op == 13:  # MOD
                if r[b] == 0.0 or not -_LARGEST < r[a] < _LARGEST:
                    return False
                r[out] = math.fmod(r[a], r[b])
            elif op == 14:  # WHOLE
                if not -_LARGEST < r[a] < _LARGEST:
                    return False
                r[out] = math.ceil(r[a] - _TOLERANCE)
                if r[out] != math.floor(r[a] + _TOLERANCE):
                    return False
            elif op == 15:  # LEQ
                r[out] = 1.0 if r[a] <= r[b] + _TOLERANCE else 0.0
            elif op == 16:  # LESS
                r[out] = 1.0 if r[a] + _TOLERANCE <= r[b] else 0.0
            elif op == 17:  # EQUAL
                r[out] = 1.0 if r[a] <= r[b] + _TOLERANCE and r[b] <= r[a] + _TOLERANCE else 0.0
            elif op == 18:  # SAME
                r[out] = 1.0 if r[a] == r[b] else 0.0
            elif op == 19:  # NOT
                r[out] = 1.0 if r[a] == 0.0 else 0.0
            elif op == 20:  # AND
                r[out] = 1.0 if r[a] != 0.0 and r[b] != 0.0 else 0.0
            elif op == 21:  # OR
                r[out] = 1.0 if r[a] != 0.0 or r[b] != 0.0 else 0.0
            elif op == 22:  # DISTANCE
                x = r[a] - r[code[at - 4]]
                y = r[b] - r[code[at - 3]]
                r[out] = math.sqrt(x * x + y * y)
            elif op == 23:  # TOWARDS
                x = r[code[at - 3]] - r[b]
                y = r[code[at - 2]] - r[code[at - 4]]
                z = math.sqrt(x * x + y * y)
                r[out] = x / z if z > 0.0 else x
                r[a] = y / z if z > 0.0 else y
            elif op == 24:  # TRAVEL
                x = r[code[at - 4]] - r[a]
                y = r[code[at - 3]] - r[b]
                z = r[code[at - 2]]
                if z <= 0.0:
                    return False
                z = math.sqrt(x * x + y * y) / z - 1e-9
                if not z < _LARGEST:
                    return False
                r[out] = max(1.0, math.ceil(z))
            elif op == 25:  # UNIFY
                if r[out] != r[out]:
                    r[out] = r[a]
                elif r[out] != r[a]:
                    return False
            elif op == 26:  # NEED
                if not -_LARGEST < r[out] < _LARGEST:
                    return False
            elif op == 27:  # HOLD
                if r[out] == 0.0:
                    return False
            elif op == 28:  # CLEAR
                for j in range(a):
                    r[out + j] = _NAN
            elif op == 29:  # WHEN_FALSE
                if r[out] == 0.0:
                    at = 8 * a
            elif op == 30:  # WHEN_TRUE
                if r[out] != 0.0:
                    at = 8 * a
            elif op == 31:  # DRAW
                if self.sample_until[a] <= self.present.now:
                    if not self.world.draw(self, a, self.present.now):  # type: ignore[attr-defined]
                        return False
                    self.log.note_draw(self.present.now, a)
                r[out] = self.sample_value[a]
            else:
                if not self.arrange(op, out, a, b, at):
                    return False

    def arrange(self, op: int, line: int, a: int, b: int, at: int) -> bool:
        """Operations on timelines; false where they are not possible."""
        n = self.lines
        present = self.present
        if op == 32:  # BEGIN
            if present.changed >> line & 1 or present.state[DUE * n + line] >= 0:
                return False
            if (
                present.state[PREDICATE * n + line] >= 0
                and not present.state[ENDING * n + line]
                and not present.end_with(line)
            ):
                return False
            self.start(line, a)
            self.log.note(present.now, line, a, -1 - self.root_row)
            return True
        if op == 33:  # MERGE
            holds = self.is_trial or present.changed >> line & 1 or not present.state[ENDING * n + line]
            return bool(holds and present.state[PREDICATE * n + line] == a)
        if op == 34:  # PREVIOUS
            return bool(present.state[present.before + line] == a)
        if op == 35:  # FOLLOW
            block = self.code[at - 2]
            if present.state[FOLLOWER * n + line] >= 0 or block <= 0:
                return False
            if present.state[DUE * n + line] >= 0 and not present.changed >> line & 1:
                return False  # what is due there has not been taken yet
            present.follow(line, a, block)
            return True
        if op == 39:  # TIE
            present.tie(line, a)
            return True
        if op == 40:  # WITHIN
            return present.put_within(line, a)
        if op == 41:  # MEMBER
            for j in range(b):  # noqa: SIM110 (a generator cannot be compiled here)
                if self.registers[a + j] == self.registers[line]:
                    return True
            return False
        if op == 42:  # ORDER
            return bool(self.registers[line] <= self.registers[a])
        if op == 43:  # PLANNED
            return self.is_planned
        value = self.registers[a]
        if not -_LARGEST < value < _LARGEST or value != math.floor(value):
            return False
        bound = int(value)
        present.bound(line, bound, op != 38, op != 37)  # LAST_EXACTLY, LAST_LEAST, LAST_MOST
        return True
