# cython: boundscheck=False
"""Walk over the log of a determined reactor: keys, ends and origins of its tokens, and of the children of their rules.

Keys are given as the general engine gives them: in the order of time, the tokens of a tick before their children.
"""

from array import array
from typing import Any

import numpy as np

from runtime.determined.log import Log
from runtime.determined.tags import (
    FAR,
    IS_FOLLOWING,
    IS_MERGED,
    IS_PREVIOUS,
    NONE,
    OF_FACT,
    OF_NOBODY,
    OF_OBSERVATION,
    OF_REQUEST,
    OF_RULE,
    ROW,
    SHOWN,
    WISHED,
)


def room_for(count: int, kind: type = np.int64) -> "memoryview[Any]":
    """Room for `count` numbers, whatever they are: each is still to be written."""
    return np.empty(count + 1, kind).data


class BlockTokens:
    """The tokens that blocks know, in arrays: how each is found, on which timeline, and in which context.

    `first` has the number of the first token of each block, and in the end their count; `context` the same of contexts.
    """

    def __init__(self) -> None:
        self.first = array("q", [0, 0])  # there is no block 0
        self.how = array("q")
        self.line = array("q")
        self.predicate = array("q")
        self.context = array("q", [0])
        self.indices = array("q")  # among the values that the block shows
        self.truths = array("q")


class TokenWalk:
    """What the log says of each row: `count` of them are walked over."""

    def __init__(self, log: Log, tokens: BlockTokens, lines: int, count: int) -> None:
        self.log = log
        self.count = count
        self.first = self._filled(tokens.first)
        self.how = self._filled(tokens.how)
        self.line = self._filled(tokens.line)
        self.predicate = self._filled(tokens.predicate)
        self.context = self._filled(tokens.context)
        self.indices = self._filled(tokens.indices)
        self.truths = self._filled(tokens.truths)
        self.is_fact = array("q", bytes(8 * lines))
        self.is_used = array("q", bytes(8 * lines))
        self.keys = room_for(count)
        self.ends = room_for(count)
        self.origins = room_for(count)
        self.children = room_for(count)  # where the tokens of the block of a row begin; NONE if another began it
        self.child_keys = room_for(0)
        self.child_rows = room_for(0)
        self.merged = room_for(0)  # key, number among the tokens of blocks, row of the other
        self.merged_count = 0
        self.current = array("q", [NONE]) * lines
        self.before = array("q", [NONE]) * lines
        self.awaited = array("q", [NONE]) * lines  # the key of what is to follow
        self.follower = array("q", [NONE]) * lines  # its predicate
        self.next_key = 0

    def _filled(self, numbers: "array[int]") -> "array[int]":
        """The same numbers, for blocks may be added later; an array without any cannot be looked at."""
        return array("q", numbers or [0])

    def run(self) -> int:
        """Walk over all rows."""
        room = 0
        for row in range(self.count):
            block = self.log.rows[ROW * row + 3]
            self.children[row] = room if block >= 0 else NONE
            if block >= 0:
                block &= WISHED - 1
                room += self.first[block + 1] - self.first[block]
        self.child_keys = room_for(room)
        self.child_rows = room_for(room)
        self.child_keys[room] = self.child_rows[room] = NONE
        self.merged = room_for(3 * room)
        row = 0
        while row < self.count:
            tick = self.log.rows[ROW * row]
            last = row
            while last < self.count and self.log.rows[ROW * last] == tick:
                self.begin(last, tick)
                last += 1
            for k in range(row, last):
                if self.children[k] >= 0:
                    self.carry_out(k)
            row = last
        return 0

    def begin(self, row: int, tick: int) -> int:
        """A token starts."""
        at = ROW * row
        line = self.log.rows[at + 1]
        block = self.log.rows[at + 3]
        origin = OF_NOBODY
        if block < 0:
            origin = OF_RULE
        elif block & WISHED:
            origin = OF_OBSERVATION if self.is_used[line] else OF_REQUEST
            if tick == 0 and self.is_fact[line]:
                origin = OF_FACT
        key = self.next_key
        self.next_key += 1
        if origin == OF_NOBODY and self.awaited[line] >= 0 and self.follower[line] == self.log.rows[at + 2]:
            key = self.awaited[line]
            self.awaited[line] = NONE
            origin = OF_RULE
        if self.current[line] >= 0:
            self.ends[self.current[line]] = tick
            self.before[line] = self.current[line]
        self.current[line] = row
        self.ends[row] = FAR
        self.keys[row] = key
        self.origins[row] = origin
        return 0

    def carry_out(self, row: int) -> int:
        """The children of a block."""
        block = self.log.rows[ROW * row + 3] & (WISHED - 1)
        shown = self.log.rows[ROW * row + SHOWN]
        first = self.first[block]
        for t in range(first, self.first[block + 1]):
            holds = True
            for c in range(self.context[t], self.context[t + 1]):
                if (self.log.values[shown + self.indices[c]] != 0.0) != (self.truths[c] != 0):
                    holds = False
                    break
            into = self.children[row] + t - first
            self.child_keys[into] = self.child_rows[into] = NONE
            if not holds:
                continue
            line = self.line[t]
            if self.how[t] == IS_MERGED or self.how[t] == IS_PREVIOUS:
                self.child_keys[into] = self.next_key
                self.merge(t, self.current[line] if self.how[t] == IS_MERGED else self.before[line])
                self.next_key += 1
            elif self.how[t] == IS_FOLLOWING:
                self.child_keys[into] = self.next_key
                self.awaited[line] = self.next_key
                self.follower[line] = self.predicate[t]
                self.next_key += 1
            else:
                self.child_keys[into] = self.keys[self.current[line]]
                self.child_rows[into] = self.current[line]
        return 0

    def merge(self, token: int, row: int) -> int:
        """Note a child that is merged into the token of a row."""
        at = 3 * self.merged_count
        self.merged[at] = self.next_key
        self.merged[at + 1] = token
        self.merged[at + 2] = row
        self.merged_count += 1
        return 0
