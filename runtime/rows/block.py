# cython: boundscheck=False
"""Tokens of a block of rows: read from the columns of a record, found by their keys, related in time."""

import math

import numpy as np

from runtime.rows.operations import BLOCK, MOST_GUARDS, MOST_TOKENS

_NAN = float("nan")


class RowBlock:
    """Columns of all tokens, of the group that is looked at, and the cells and counts of a block of rows."""

    def __init__(self) -> None:
        nothing, numbers = np.zeros(1, np.int64), np.zeros(1)
        bits = np.zeros(1, np.uint8)
        # Of all tokens.
        self.store = numbers
        self.store_count = 0
        self.starts, self.ends, self.latest = nothing, nothing, numbers
        self.begun, self.planned = bits, bits
        self.standing, self.predicates, self.objects, self.values = nothing, nothing, nothing, nothing
        self.row_of = nothing  # by key
        self.key_count = 0
        self.texts, self.object_texts = numbers, numbers  # numbers of texts, by those of names in the record
        self.symbol_count = 0
        # Of the code.
        self.code = nothing
        self.length = 0
        self.cells = numbers  # BLOCK numbers each
        self.tables = bits  # whether something is allowed: by table, by the number of a text or a predicate
        # Of the group.
        self.rows, self.shown, self.first, self.child_keys = nothing, nothing, nothing, nothing
        self.child_count = 0
        self.count = 0
        self.drawn = numbers
        self.holds = bits
        # Of a block: the rows of its tokens, of what stands for them, and where their arguments are; what was counted;
        # the rows that failed (whole words: stores of bytes would make C read all addresses again); sides of guards.
        self.token_rows = np.zeros(MOST_TOKENS * BLOCK, np.int64)
        self.token_stands = np.zeros(MOST_TOKENS * BLOCK, np.int64)
        self.argument = np.zeros(MOST_TOKENS * BLOCK, np.int64)
        self.least, self.most = np.zeros(MOST_TOKENS, np.int64), np.zeros(MOST_TOKENS, np.int64)  # of `argument`
        self.now_judged, self.now_open = np.zeros(BLOCK, np.int64), np.zeros(BLOCK, np.int64)
        self.fails = np.zeros(BLOCK, np.int64)
        self.sides = np.zeros((MOST_GUARDS + 1) * BLOCK, np.int64)
        self.judged = 0
        self.open = 0

    def put(self, at: int, row: int) -> int:
        """Note the row of a token."""
        stands = self.standing[row]
        self.token_rows[at] = row
        self.token_stands[at] = stands
        self.argument[at] = self.values[stands]
        return 0

    def span(self, token: int, first: int, last: int) -> int:
        """Note between which places the arguments of a token begin, in some rows: none is looked at one by one then."""
        least = most = self.argument[BLOCK * token + first]
        for i in range(BLOCK * token + first + 1, BLOCK * token + last):
            place = self.argument[i]
            if place < least:
                least = place
            if place > most:
                most = place
        self.least[token], self.most[token] = least, most
        return 0

    def is_near(self, x: float, y: float) -> bool:
        """Whether two reals are equal within the judge's tolerance."""
        if x == y:
            return True
        gap = math.fabs(x - y)
        if gap <= 1e-5:
            return True
        margin = 1e-5 + 1e-9 * max(math.fabs(x), math.fabs(y))
        return gap <= margin and margin - margin == 0.0

    def relate(self, at: int, first: int, last: int) -> int:
        """Judge `lower <= second - first <= upper` of two times; where one is open, whether it can hold."""
        lower, upper = self.cells[BLOCK * self.code[at + 5]], self.cells[BLOCK * self.code[at + 6]]
        a, b = BLOCK * self.code[at + 1], BLOCK * self.code[at + 2]
        is_end_a, is_end_b = self.code[at + 3], self.code[at + 4]
        for i in range(first, last):
            one, other = self.token_stands[a + i], self.token_stands[b + i]
            if is_end_a:
                least_a, most_a = float(self.ends[one]), self.latest[one]
            else:
                least_a = float(self.starts[one])
                most_a = least_a if self.begun[one] else math.inf
            if is_end_b:
                least_b, most_b = float(self.ends[other]), self.latest[other]
            else:
                least_b = float(self.starts[other])
                most_b = least_b if self.begun[other] else math.inf
            if least_a == most_a and least_b == most_b:
                self.now_judged[i] += 1
                if not (lower <= least_b - least_a and least_b - least_a <= upper):
                    self.fails[i] = 1
                continue
            self.now_open[i] += 1
            if not (least_b - most_a <= upper and lower <= most_b - least_a):
                self.fails[i] = 1
            elif lower == upper and (least_a == most_a or least_b == most_b):
                # Where one determines the other, a target that is in the plan must have been fixed.
                if self.planned[self.token_rows[BLOCK * self.code[at + 7] + i]]:
                    self.fails[i] = 1
        return 0

    def find_children(self, at: int, begin: int, first: int, last: int) -> int:
        """Find the token of a child by its key; a row fails where it is none that the rule asks for."""
        out, table, offset = BLOCK * self.code[at + 1], self.code[at + 3], self.code[at + 2]
        for i in range(first, last):
            row = -1
            place = self.first[begin + i] + offset
            if place >= 0 and place < self.child_count:
                key = self.child_keys[place]
                if key >= 0 and key < self.key_count:
                    row = self.row_of[key]
            if row < 0:
                self.fails[i] = 1
                row = 0
            elif (
                not self.planned[row]
                or not self.tables[table + self.predicates[row]]
                or not self.tables[table + self.predicates[self.standing[row]]]
            ):
                self.fails[i] = 1
            self.put(out + i, row)
        return self.span(self.code[at + 1], first, last)
