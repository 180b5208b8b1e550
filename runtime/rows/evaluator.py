# cython: boundscheck=False
"""Row evaluator of the judge: straight code over the columns of a record, a block of rows at a time.

It knows no engine and no plan: `checker.judge.row_steps` writes the code, in numbers of `operations`. A row in which
something does not plainly hold, or is not known, fails; others look at it. A value is a number; names are numbers of
texts. What is not known is NaN, and no operation holds of it.
"""

import math

from runtime.rows.block import RowBlock
from runtime.rows.operations import BLOCK, STRIDE

_EXACT = 2.0**53
_NAN = float("nan")


class RowEvaluator(RowBlock):
    """Evaluates code over a group of tokens."""

    def run(self) -> int:
        """Evaluate all rows of the group; how many hold."""
        found = 0
        begin = 0
        while begin < self.count:
            many = min(BLOCK, self.count - begin)
            for i in range(many):
                self.now_judged[i] = 0
                self.now_open[i] = 0
                self.fails[i] = 0
                self.active[i] = i
                self.put(i, self.rows[begin + i])
            self.evaluate(begin, many)
            for i in range(many):
                if not self.fails[i]:
                    self.holds[begin + i] = 1
                    self.judged += self.now_judged[i]
                    self.open += self.now_open[i]
                    found += 1
            begin += BLOCK
        return found

    def part(self, at: int, begin: int, many: int, level: int) -> int:
        """Part the rows in which a guard was true from the others; rows that have failed are in neither."""
        yes, no = BLOCK * (level + 1), BLOCK * (level + 1)
        for j in range(many):
            i = self.active[BLOCK * level + j]
            place = self.shown[begin + i] + self.code[at + 2]
            if place < 0 or place >= self.store_count:
                self.fails[i] = 1
            if self.fails[i]:
                continue
            x = self.cells[BLOCK * self.code[at + 1] + i]
            self.now_judged[i] += 1
            if self.store[place] != 0.0:  # NaN is true, as it is for who reads the register
                if x != x or x == 0.0:
                    self.fails[i] = 1
                self.active[yes] = i
                yes += 1
            else:
                if x != 0.0:
                    self.fails[i] = 1
                self.others[no] = i
                no += 1
        self.active_count[level + 1] = yes - BLOCK * (level + 1)
        self.other_count[level + 1] = no - BLOCK * (level + 1)
        return 0

    def evaluate(self, begin: int, many: int) -> int:
        """Evaluate the code in a block of rows."""
        level, base, at = 0, 0, 0
        while at < self.length:
            op = self.code[at]
            out, a, b = BLOCK * self.code[at + 1], BLOCK * self.code[at + 2], BLOCK * self.code[at + 3]
            more = self.code[at + 4]
            if op == 7:  # CHILD: token, place of its key, table of predicates
                self.find_children(at, begin, many, base)
            elif op == 8:  # RELATED
                self.relate(at, many, base)
            elif op == 9:  # GUARD: condition, place, where OTHERWISE stands
                self.active_count[level] = many
                self.part(at, begin, many, level)
                level += 1
                base = BLOCK * level
                many = self.active_count[level]
                if not many:
                    at = self.code[at + 3]
                    continue
            elif op == 10:  # OTHERWISE: where the guard ends
                many = self.other_count[level]
                for j in range(many):
                    self.active[base + j] = self.others[base + j]
                if not many:
                    at = self.code[at + 2]
                    continue
            elif op == 11:  # END of a guard
                level -= 1
                base = BLOCK * level
                many = self.active_count[level]
            elif op < 7:
                self.read(at, begin, many, base)
            elif op < 30:
                self.check(at, many, base)
            elif op < 50:
                self.compute(at, many, base)
            else:
                for j in range(many):
                    i = self.active[base + j]
                    x, y = self.cells[a + i], self.cells[b + i]
                    z = _NAN
                    if x != x or y != y:
                        self.fails[i] = 1
                    elif op == 50:  # EQUAL
                        z = 1.0 if x == y or (not more and self.is_near(x, y)) else 0.0
                    elif op == 54:  # BOTH
                        z = 1.0 if x != 0.0 and y != 0.0 else 0.0
                    elif op == 55:  # EITHER
                        z = 1.0 if x != 0.0 or y != 0.0 else 0.0
                    elif op == 56:  # NEITHER: the negation, of one
                        z = 0.0 if x != 0.0 else 1.0
                    elif x == y:  # UNEQUAL, IS_AT_MOST, IS_BELOW
                        z = 1.0 if op == 52 else 0.0
                    elif not more and not (op == 52 and x < y) and self.is_near(x, y):
                        self.fails[i] = 1
                    else:
                        z = 1.0 if op == 51 or x < y else 0.0
                    self.cells[out + i] = z
            at += STRIDE
        return 0

    def read(self, at: int, begin: int, many: int, base: int) -> int:
        """Read values of a record into a register, or count."""
        op, more = self.code[at], self.code[at + 4]
        out, a, b = BLOCK * self.code[at + 1], BLOCK * self.code[at + 2], self.code[at + 3]
        if op == 0:  # PARAMETER of a token: token, number, kind
            for j in range(many):
                i = self.active[base + j]
                place = self.argument[a + i]
                x = _NAN
                if place >= 0 and place + b < self.store_count:
                    x = self.store[place + b]
                if x != x:
                    self.fails[i] = 1
                self.cells[out + i] = self.known(x, more) if more else x
        elif op == 1:  # LOCAL: place, kind
            a = self.code[at + 2]
            for j in range(many):
                i = self.active[base + j]
                place = self.shown[begin + i] + a
                x = _NAN
                if place >= 0 and place < self.store_count:
                    x = self.store[place]
                self.cells[out + i] = self.known(x, b) if b else x
        elif op == 2:  # TIME: token, whether it is the end
            for j in range(many):
                i = self.active[base + j]
                row = self.standing[self.token_rows[a + i]]
                if b:
                    self.cells[out + i] = float(self.ends[row])
                    if self.cells[out + i] != self.latest[row]:
                        self.fails[i] = 1
                else:
                    self.cells[out + i] = float(self.starts[row])
                    if not self.begun[row]:
                        self.fails[i] = 1
        elif op == 3:  # OBJECT of a token
            for j in range(many):
                i = self.active[base + j]
                self.cells[out + i] = self.object_texts[self.objects[self.standing[self.token_rows[a + i]]]]
        elif op == 4:  # DRAWN: number of the draw
            place = self.code[at + 2] * self.count + begin
            for j in range(many):
                i = self.active[base + j]
                self.cells[out + i] = self.drawn[place + i]
        elif op == 5:  # COUNT
            for j in range(many):
                self.now_judged[self.active[base + j]] += self.code[at + 2]
        else:  # COUNT_NEAR: whether only the same is equal, and two values
            b = BLOCK * b
            for j in range(many):
                i = self.active[base + j]
                x, y = self.cells[a + i], self.cells[b + i]
                if x != x or y != y:
                    self.fails[i] = 1
                elif x == y or (not out and self.is_near(x, y)):
                    self.now_judged[i] += 1
        return 0

    def check(self, at: int, many: int, base: int) -> int:
        """Let the rows fail in which something does not plainly hold."""
        op, more = self.code[at], self.code[at + 4]
        a, b = BLOCK * self.code[at + 2], BLOCK * self.code[at + 3]
        if op == 15:  # SAME
            for j in range(many):
                i = self.active[base + j]
                self.fails[i] |= self.cells[a + i] != self.cells[b + i]
        elif op == 16:  # NEAR
            for j in range(many):
                i = self.active[base + j]
                if self.cells[a + i] != self.cells[b + i] and not self.is_near(self.cells[a + i], self.cells[b + i]):
                    self.fails[i] = 1
        elif op == 12:  # ALLOWED: value, table
            b = self.code[at + 3]
            for j in range(many):
                i = self.active[base + j]
                if self.cells[a + i] != self.cells[a + i] or not self.tables[b + int(self.cells[a + i])]:
                    self.fails[i] = 1
        elif op == 13:  # WITHIN: value, first of two bounds
            for j in range(many):
                i = self.active[base + j]
                self.fails[i] |= not (self.cells[b] <= self.cells[a + i] and self.cells[a + i] <= self.cells[b + BLOCK])
        elif op == 14:  # AMONG: value, first, count of values
            for j in range(many):
                i = self.active[base + j]
                k = 0
                while k < more and self.cells[b + BLOCK * k] != self.cells[a + i]:
                    k += 1
                self.fails[i] |= k == more
        elif op == 17:  # OTHER: not the same
            for j in range(many):
                i = self.active[base + j]
                self.fails[i] |= not (self.cells[a + i] < self.cells[b + i] or self.cells[a + i] > self.cells[b + i])
        elif op == 18:  # APART: not near
            for j in range(many):
                i = self.active[base + j]
                x, y = self.cells[a + i], self.cells[b + i]
                self.fails[i] |= x != x or y != y or self.is_near(x, y)
        elif op == 19:  # AT_MOST
            for j in range(many):
                i = self.active[base + j]
                self.fails[i] |= not self.cells[a + i] <= self.cells[b + i]
        elif op == 20:  # BELOW
            for j in range(many):
                i = self.active[base + j]
                self.fails[i] |= not self.cells[a + i] < self.cells[b + i]
        else:  # ALIKE: two truth values
            for j in range(many):
                i = self.active[base + j]
                x, y = self.cells[a + i], self.cells[b + i]
                self.fails[i] |= x != x or y != y or (x != 0.0) != (y != 0.0)
        return 0

    def compute(self, at: int, many: int, base: int) -> int:
        """Compute the value of a function; a row fails where it has none, or a whole number is not exact."""
        op, more = self.code[at], self.code[at + 4]
        out, a, b = BLOCK * self.code[at + 1], BLOCK * self.code[at + 2], BLOCK * self.code[at + 3]
        if op == 30:  # ADD
            for j in range(many):
                i = self.active[base + j]
                self.cells[out + i] = self.cells[a + i] + self.cells[b + i]
        elif op == 31:  # SUBTRACT
            for j in range(many):
                i = self.active[base + j]
                self.cells[out + i] = self.cells[a + i] - self.cells[b + i]
        elif op == 32:  # MULTIPLY
            for j in range(many):
                i = self.active[base + j]
                self.cells[out + i] = self.cells[a + i] * self.cells[b + i]
        elif op == 40 or op == 41:  # FLOOR, CEILING: whether a real that is near to a whole number is left open
            for j in range(many):
                i = self.active[base + j]
                x = self.cells[a + i]
                if not math.fabs(x) <= _EXACT:
                    self.fails[i] = 1
                    x = 0.0
                y = math.floor(x + 0.5)
                if b and x != y and self.is_near(x, y):
                    self.fails[i] = 1
                self.cells[out + i] = float(math.floor(x) if op == 40 else math.ceil(x))
        elif op == 42:  # DISTANCE of (a, b) and the next two
            c, d = BLOCK * more, BLOCK * self.code[at + 5]
            for j in range(many):
                i = self.active[base + j]
                x, y = self.cells[c + i] - self.cells[a + i], self.cells[d + i] - self.cells[b + i]
                self.cells[out + i] = math.sqrt(x * x + y * y)
            more = 0
        elif op == 43:  # TOWARDS
            return self.point(at, many, base)
        else:
            for j in range(many):
                i = self.active[base + j]
                x, y = self.cells[a + i], self.cells[b + i]
                if x != x or y != y:
                    x = _NAN
                elif op == 33:  # LEAST
                    x = x if x < y else y
                elif op == 34:  # GREATEST
                    x = x if x > y else y
                elif op == 35:  # NEGATIVE
                    x = -x
                elif op == 36:  # SIZE
                    x = math.fabs(x)
                elif op == 37:  # ROOT
                    x = math.sqrt(x if x > 0.0 else 0.0) if x > -1e-4 else _NAN
                elif op == 38:  # REST
                    x = math.fmod(x, y) if y != 0.0 and x - x == 0.0 else _NAN
                else:  # SQUARE of the difference
                    x = (x - y) * (x - y)
                self.cells[out + i] = x
        if more and op < 40:  # a whole number
            for j in range(many):
                i = self.active[base + j]
                self.fails[i] |= not math.fabs(self.cells[out + i]) <= _EXACT
        else:
            for j in range(many):
                i = self.active[base + j]
                self.fails[i] |= self.cells[out + i] - self.cells[out + i] != 0.0
        return 0

    def point(self, at: int, many: int, base: int) -> int:
        """Let the rows fail in which (ux, uy) is not plainly the unit vector from one point to another."""
        one, two, three = BLOCK * self.code[at + 1], BLOCK * self.code[at + 2], BLOCK * self.code[at + 3]
        four, five, six = BLOCK * self.code[at + 4], BLOCK * self.code[at + 5], BLOCK * self.code[at + 6]
        for j in range(many):
            i = self.active[base + j]
            x, y = self.cells[three + i], self.cells[four + i]
            to_x, to_y = self.cells[five + i], self.cells[six + i]
            east, north = to_x - x, to_y - y
            way = math.sqrt(east * east + north * north)
            if not way > 0.0:
                self.fails[i] = 1
                continue
            size = max(max(math.fabs(x), math.fabs(y)), max(math.fabs(to_x), math.fabs(to_y)))
            turned = 4 * (1e-5 + 1e-9 * size) / way
            margin = 1e-5 + turned
            x, y = math.fabs(self.cells[one + i] - east / way), math.fabs(self.cells[two + i] - north / way)
            if not (turned < 1 and x <= margin and y <= margin):
                self.fails[i] = 1
        return 0
