# cython: boundscheck=False
"""Columns of all tokens that a walk has found, in the order of their keys: times, states, parents by merging.

An entry is a row of the log, then what was merged, then what is awaited on a timeline; an index is a place in the
order of keys.
"""

from array import array

import numpy as np

from runtime.determined.tags import FAR, KIND, LINE, NONE, OF_RULE, ROW, VALUES
from runtime.determined.token_walk import TokenWalk, room_for

_INFINITE = float("inf")
_ACTIVE, _MERGED, _INACTIVE = 0, 1, 2  # states


class WalkColumns:
    """What `TokenTimes` has, one array each."""

    def __init__(self, walk: TokenWalk) -> None:
        lines = len(walk.awaited)
        self.walk = walk
        self.lines = lines
        entries = walk.count + walk.merged_count + lines
        self.index_of = room_for(entries)
        self.order = room_for(entries)  # the entry of each index
        self.keys = room_for(entries)
        self.by_key = array("q", [NONE]) * (walk.next_key + 1)  # entries
        self.count = self.arrange()
        self.least = array("q", [FAR]) * lines  # bounds of the ends of what holds, by timeline
        self.most = array("q", [FAR]) * lines

    def arrange(self) -> int:
        """Number all tokens in the order of their keys; how many they are."""
        walk = self.walk
        for row in range(walk.count):
            self.by_key[walk.keys[row]] = row
        entry = walk.count
        for k in range(walk.merged_count):
            self.by_key[walk.merged[3 * k]] = entry
            entry += 1
        for line in range(self.lines):
            if walk.awaited[line] >= 0:
                self.by_key[walk.awaited[line]] = entry + line
        count = 0
        for key in range(walk.next_key):
            entry = self.by_key[key]
            if entry >= 0:
                self.index_of[entry] = count
                self.order[count] = entry
                self.keys[count] = key
                count += 1
        return count

    def fill(self, tick: int) -> int:
        """Tell of each token what the log says; `tick` is the last that was carried out."""
        walk = self.walk
        self.predicates = room_for(self.count)
        self.objects = room_for(self.count)
        self.states = room_for(self.count, np.int8)
        self.starts = room_for(self.count)
        self.ends = room_for(self.count)
        self.latest = room_for(self.count, np.float64)
        self.merged_into = room_for(self.count)
        self.origins = room_for(self.count)
        self.is_over = room_for(self.count, np.int8)
        self.ticks = room_for(self.count)
        self.values = room_for(self.count)
        begun = walk.count + walk.merged_count
        for index in range(self.count):
            entry = self.order[index]
            if entry >= begun:
                self.tell_awaited(index, entry - begun, tick)
                continue
            row = entry
            if entry >= walk.count:  # what it has is, as a rule, what the token has that it is merged into
                at = 3 * (entry - walk.count)
                row = walk.merged[at + 2]
                self.states[index] = _MERGED
                self.origins[index] = OF_RULE
                self.predicates[index] = walk.predicate[walk.merged[at + 1]]
                self.merged_into[index] = walk.keys[row]
            else:
                self.states[index] = _ACTIVE
                self.merged_into[index] = NONE
                self.predicates[index] = walk.log.rows[ROW * row + KIND]
                self.origins[index] = walk.origins[row]
            self.objects[index] = walk.log.rows[ROW * row + LINE]
            self.starts[index] = walk.log.rows[ROW * row]
            self.values[index] = walk.log.rows[ROW * row + VALUES]
            end = walk.ends[row]
            if end < FAR:
                self.is_over[index] = 1
                self.ends[index] = self.ticks[index] = end
                self.latest[index] = end
            else:
                self.is_over[index] = 0
                self.ticks[index] = tick
                self.tell_bounds(index, walk.log.rows[ROW * row + LINE])
        return 0

    def tell_bounds(self, index: int, line: int) -> int:
        """Tell when a token may end that holds when the mission ends."""
        self.ends[index] = self.least[line]
        self.latest[index] = self.most[line]
        if self.most[line] >= FAR:
            self.latest[index] = _INFINITE
        return 0

    def tell_awaited(self, index: int, line: int, tick: int) -> int:
        """Tell of a token that was still to follow when the mission ended."""
        self.predicates[index] = self.walk.follower[line]
        self.objects[index] = line
        self.states[index] = _INACTIVE
        self.is_over[index] = 0
        self.ticks[index] = tick
        self.origins[index] = OF_RULE
        self.merged_into[index] = self.values[index] = NONE
        self.starts[index] = self.ends[index] = tick + 1
        self.latest[index] = _INFINITE
        return 0
