# cython: boundscheck=False
"""Row evaluator of the judge: straight code over the columns of a record, a block of rows at a time.

It knows no engine and no plan: `checker.judge.row_steps` writes the code, in numbers of `operations`. A row in which
something does not plainly hold, or is not known, fails; others look at it. A value is a number; names are numbers of
texts. What is not known is NaN, and no operation holds of it.
"""

import math
import sys

from runtime.rows.block import RowBlock
from runtime.rows.operations import BLOCK, STRIDE

_EXACT = 2.0**53
_LARGEST = sys.float_info.max
_NAN = float("nan")


class RowEvaluator(RowBlock):
    """Evaluates code over a group of tokens.

    Each operation goes over rows that stand side by side: all of a block, in a branch those on end that took it. An
    operation that judges counts first in how many of them something is amiss, which mostly is none.
    """

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
                self.put(i, self.rows[begin + i])
            self.span(0, 0, many)
            self.evaluate(0, self.length, begin, 0, many, 0)
            for i in range(many):
                if not self.fails[i]:
                    self.holds[begin + i] = 1
                    self.judged += self.now_judged[i]
                    self.open += self.now_open[i]
                    found += 1
            begin += BLOCK
        return found

    def evaluate(self, at: int, until: int, begin: int, first: int, last: int, depth: int) -> int:
        """Evaluate a part of the code in some rows of a block."""
        while at < until:
            op = self.code[at]
            if op < 7:
                self.read(at, begin, first, last)
            elif op == 7:  # CHILD: token, place of its key, table of predicates
                self.find_children(at, begin, first, last)
            elif op == 8:  # RELATED
                self.relate(at, first, last)
            elif op == 9:  # GUARD: condition, place, where OTHERWISE stands
                at = self.branch(at, begin, first, last, depth)
            elif op < 30:
                self.check(at, first, last)
            elif op < 50:
                self.compute(at, first, last)
            else:
                self.compare(at, first, last)
            at += STRIDE
        return 0

    def branch(self, at: int, begin: int, first: int, last: int, depth: int) -> int:
        """Evaluate the branches of a guard, each in the rows that took it, as many on end; where the guard ends."""
        otherwise = self.code[at + 3]
        end: int = self.code[otherwise + 2]
        base = BLOCK * depth
        self.part(at, begin, first, last, base)
        i = first
        while i < last:
            side = self.sides[base + i]
            j = i + 1
            while j < last and self.sides[base + j] == side:
                j += 1
            if side == 1:
                self.evaluate(at + STRIDE, otherwise, begin, i, j, depth + 1)
            elif side == 2:
                self.evaluate(otherwise + STRIDE, end, begin, i, j, depth + 1)
            i = j
        return end

    def part(self, at: int, begin: int, first: int, last: int, base: int) -> int:
        """Part the rows in which a guard was true (1) from the others (2); rows that have failed are in neither."""
        condition, offset = BLOCK * self.code[at + 1], self.code[at + 2]
        for i in range(first, last):
            self.sides[base + i] = 0
            place = self.shown[begin + i] + offset
            if place < 0 or place >= self.store_count:
                self.fails[i] = 1
            if self.fails[i]:
                continue
            x = self.cells[condition + i]
            self.now_judged[i] += 1
            if self.store[place] != 0.0:  # NaN is true, as it is for who reads the register
                if x != x or x == 0.0:
                    self.fails[i] = 1
                self.sides[base + i] = 1
            else:
                if x != 0.0:
                    self.fails[i] = 1
                self.sides[base + i] = 2
        return 0

    def read(self, at: int, begin: int, first: int, last: int) -> int:
        """Read values of a record into a register, or count."""
        op, more = self.code[at], self.code[at + 4]
        out, a, b = BLOCK * self.code[at + 1], BLOCK * self.code[at + 2], self.code[at + 3]
        if op == 0:  # PARAMETER of a token: token, number, kind
            token = self.code[at + 2]
            if self.least[token] >= 0 and self.most[token] + b < self.store_count:
                for i in range(first, last):
                    self.cells[out + i] = self.store[self.argument[a + i] + b]
            else:
                for i in range(first, last):
                    place = self.argument[a + i]
                    x = self.store[place + b] if place >= 0 and place + b < self.store_count else _NAN
                    self.cells[out + i] = x
            if more:
                self.translate(out, first, last, more)
        elif op == 1:  # LOCAL: place, kind
            a = self.code[at + 2]
            for i in range(first, last):
                place = self.shown[begin + i] + a
                x = self.store[place] if place >= 0 and place < self.store_count else _NAN
                self.cells[out + i] = x
            if b:
                self.translate(out, first, last, b)
        elif op == 2 and b:  # TIME: token, whether it is the end
            for i in range(first, last):
                x = float(self.ends[self.token_stands[a + i]])
                self.cells[out + i] = x
                self.fails[i] |= x != self.latest[self.token_stands[a + i]]
        elif op == 2:
            for i in range(first, last):
                self.cells[out + i] = float(self.starts[self.token_stands[a + i]])
                self.fails[i] |= not self.begun[self.token_stands[a + i]]
        elif op == 3:  # OBJECT of a token
            for i in range(first, last):
                self.cells[out + i] = self.object_texts[self.objects[self.token_stands[a + i]]]
        elif op == 4:  # DRAWN: number of the draw
            place = self.code[at + 2] * self.count + begin
            for i in range(first, last):
                self.cells[out + i] = self.drawn[place + i]
        elif op == 5:  # COUNT
            for i in range(first, last):
                self.now_judged[i] += self.code[at + 2]
        else:  # COUNT_NEAR: whether only the same is equal, and two values
            b = BLOCK * b
            for i in range(first, last):
                x, y = self.cells[a + i], self.cells[b + i]
                if x != x or y != y:
                    self.fails[i] = 1
                elif x == y or (not out and self.is_near(x, y)):
                    self.now_judged[i] += 1
        return 0

    def translate(self, out: int, first: int, last: int, kind: int) -> int:
        """Values that were read, as the record has them: 1 a whole number, 2 a truth value, 3 a name."""
        if kind == 1:
            for i in range(first, last):
                x = self.cells[out + i]
                if x >= -_EXACT and x <= _EXACT:
                    k = int(x)
                    self.cells[out + i] = float(k)
                elif x - x != 0.0:  # beyond that range all are whole numbers
                    self.cells[out + i] = _NAN
        elif kind == 2:
            for i in range(first, last):
                x = self.cells[out + i]
                self.cells[out + i] = x if x == 0.0 or x != x else 1.0
        else:
            for i in range(first, last):
                x = self.cells[out + i]
                if x >= 0.0 and x < self.symbol_count:
                    k = int(x)
                    self.cells[out + i] = self.texts[k]
                else:
                    self.cells[out + i] = _NAN
        return 0

    def check(self, at: int, first: int, last: int) -> int:
        """Let the rows fail in which something does not plainly hold."""
        op, more = self.code[at], self.code[at + 4]
        a, b = BLOCK * self.code[at + 2], BLOCK * self.code[at + 3]
        amiss = 0
        if op == 15 or op == 16:  # SAME, NEAR: mostly the very same numbers
            for i in range(first, last):
                amiss += self.cells[a + i] != self.cells[b + i]
            if amiss:
                for i in range(first, last):
                    x, y = self.cells[a + i], self.cells[b + i]
                    self.fails[i] |= x != y and (op == 15 or not self.is_near(x, y))
        elif op == 12:  # ALLOWED: value, table
            b = self.code[at + 3]
            for i in range(first, last):
                x = self.cells[a + i]
                if x == x:
                    k = int(x)
                    self.fails[i] |= not self.tables[b + k]
                else:
                    self.fails[i] = 1
        elif op == 13:  # WITHIN: value, first of two bounds
            for i in range(first, last):
                x = self.cells[a + i]
                self.fails[i] |= not (self.cells[b] <= x and x <= self.cells[b + BLOCK])
        elif op == 14:  # AMONG: value, first, count of values
            for i in range(first, last):
                k = 0
                while k < more and self.cells[b + BLOCK * k] != self.cells[a + i]:
                    k += 1
                self.fails[i] |= k == more
        elif op == 17:  # OTHER: not the same
            for i in range(first, last):
                self.fails[i] |= not (self.cells[a + i] < self.cells[b + i] or self.cells[a + i] > self.cells[b + i])
        elif op == 18:  # APART: not near
            for i in range(first, last):
                x, y = self.cells[a + i], self.cells[b + i]
                self.fails[i] |= x != x or y != y or self.is_near(x, y)
        elif op == 19:  # AT_MOST
            for i in range(first, last):
                self.fails[i] |= not self.cells[a + i] <= self.cells[b + i]
        elif op == 20:  # BELOW
            for i in range(first, last):
                self.fails[i] |= not self.cells[a + i] < self.cells[b + i]
        else:  # ALIKE: two truth values
            for i in range(first, last):
                x, y = self.cells[a + i], self.cells[b + i]
                self.fails[i] |= x != x or y != y or (x != 0.0) != (y != 0.0)
        return 0

    def compute(self, at: int, first: int, last: int) -> int:
        """Compute the value of a function; a row fails where it has none, or a whole number is not exact."""
        op, more = self.code[at], self.code[at + 4]
        out, a, b = BLOCK * self.code[at + 1], BLOCK * self.code[at + 2], BLOCK * self.code[at + 3]
        if op == 30:  # ADD
            for i in range(first, last):
                self.cells[out + i] = self.cells[a + i] + self.cells[b + i]
        elif op == 31:  # SUBTRACT
            for i in range(first, last):
                self.cells[out + i] = self.cells[a + i] - self.cells[b + i]
        elif op == 32:  # MULTIPLY
            for i in range(first, last):
                self.cells[out + i] = self.cells[a + i] * self.cells[b + i]
        elif op == 40 or op == 41:  # FLOOR, CEILING: whether a real that is near to a whole number is left open
            for i in range(first, last):
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
            for i in range(first, last):
                x, y = self.cells[c + i] - self.cells[a + i], self.cells[d + i] - self.cells[b + i]
                self.cells[out + i] = math.sqrt(x * x + y * y)
            more = 0
        elif op == 43:  # TOWARDS
            return self.point(at, first, last)
        else:
            for i in range(first, last):
                self.cells[out + i] = self.value(op, self.cells[a + i], self.cells[b + i])
        most = _EXACT if more and op < 40 else _LARGEST  # of a whole number, of a real
        amiss = 0
        for i in range(first, last):
            amiss += not math.fabs(self.cells[out + i]) <= most
        if amiss:
            for i in range(first, last):
                self.fails[i] |= not math.fabs(self.cells[out + i]) <= most
        return 0

    def value(self, op: int, x: float, y: float) -> float:
        """The value of a function of which there are few; NaN where it has none."""
        if x != x or y != y:
            return _NAN
        if op == 33:  # LEAST
            return x if x < y else y
        if op == 34:  # GREATEST
            return x if x > y else y
        if op == 35:  # NEGATIVE
            return -x
        if op == 36:  # SIZE
            return math.fabs(x)
        if op == 37:  # ROOT
            return math.sqrt(x if x > 0.0 else 0.0) if x > -1e-4 else _NAN
        if op == 38:  # REST
            return math.fmod(x, y) if y != 0.0 and x - x == 0.0 else _NAN
        return (x - y) * (x - y)  # SQUARE of the difference

    def compare(self, at: int, first: int, last: int) -> int:
        """Compute a truth value; a row fails where it is not known, or would be another within the tolerance."""
        op, more = self.code[at], self.code[at + 4]
        out, a, b = BLOCK * self.code[at + 1], BLOCK * self.code[at + 2], BLOCK * self.code[at + 3]
        for i in range(first, last):
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
        return 0

    def point(self, at: int, first: int, last: int) -> int:
        """Let the rows fail in which (ux, uy) is not plainly the unit vector from one point to another."""
        one, two, three = BLOCK * self.code[at + 1], BLOCK * self.code[at + 2], BLOCK * self.code[at + 3]
        four, five, six = BLOCK * self.code[at + 4], BLOCK * self.code[at + 5], BLOCK * self.code[at + 6]
        for i in range(first, last):
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
