"""Hold the stack of decisions as rows of numbers: what each mends, which choice it is at, and how to go back."""

from array import array
from collections.abc import Sequence

from runtime.solver.tags import NONE
from runtime.solver.widening import widened


class Decisions:
    """Row 0 is the oldest decision. `depth` rows have been executed; row `depth` may be the active one."""

    def __init__(self) -> None:
        room = 64
        self.room = room
        self.depth = 0
        self.kind = array("q", [0]) * room
        self.manager = array("q", [0]) * room
        self.item = array("q", [0]) * room
        self.handler = array("q", [0]) * room
        # The choice: how many were tried, the phase of an open condition, and two numbers that each kind uses its way.
        self.tries = array("q", [0]) * room
        self.phase = array("q", [0]) * room
        self.cursor = array("q", [0]) * room
        self.other = array("q", [0]) * room
        self.lists: dict[int, Sequence[float]] = {}
        # The way back.
        self.mark = array("q", [0]) * room
        self.rows_seen = array("q", [0]) * room
        self.engine_seen = array("q", [0]) * room
        self.dropped = array("q", [0]) * room
        self.loose = array("q", [0]) * room
        # Places on timelines and pairs of uses that threats choose from: a pool, each decision has a stretch of it.
        self.pool_first = array("q", [0]) * room
        self.pool_count = array("q", [0]) * room
        self.pool_used = 0
        self.pool_object = array("q", [0]) * room
        self.pool_before = array("q", [0]) * room
        self.pool_after = array("q", [0]) * room
        # Why choices failed: per decision a list of earlier ones.
        self.reasons = array("q", [NONE]) * room
        self.is_local = array("q", [0]) * room  # whether they hold only where decisions were made in this order
        self.reason_used = 0
        self.reason_free = NONE
        self.reason_level = array("q", [0]) * room
        self.reason_next = array("q", [NONE]) * room

    def open(self, kind: int, manager: int, item: int, handler: int) -> int:
        """Make row `depth` an untried decision; its number."""
        d = self.depth
        if d == self.room:
            self.grow()
        self.kind[d] = kind
        self.manager[d] = manager
        self.item[d] = item
        self.handler[d] = handler
        self.tries[d] = 0
        self.phase[d] = 0
        self.cursor[d] = NONE
        self.other[d] = NONE
        self.pool_first[d] = self.pool_used
        self.pool_count[d] = NONE
        self.reasons[d] = NONE
        self.is_local[d] = 0
        return d

    def close(self, d: int) -> int:
        """Give back what row `d`, the last one, holds in the pools."""
        self.pool_used = self.pool_first[d]
        self.drop_reasons(d)
        if len(self.lists):
            self.lists.pop(d, None)
        return 0

    def clear(self) -> None:
        """Forget all decisions."""
        self.depth = 0
        self.pool_used = 0
        self.reason_used = 0
        self.reason_free = NONE

    def grow(self) -> int:
        """Double the rows."""
        room = 2 * self.room
        self.kind = widened(self.kind, room, 0)
        self.manager = widened(self.manager, room, 0)
        self.item = widened(self.item, room, 0)
        self.handler = widened(self.handler, room, 0)
        self.tries = widened(self.tries, room, 0)
        self.phase = widened(self.phase, room, 0)
        self.cursor = widened(self.cursor, room, 0)
        self.other = widened(self.other, room, 0)
        self.mark = widened(self.mark, room, 0)
        self.rows_seen = widened(self.rows_seen, room, 0)
        self.engine_seen = widened(self.engine_seen, room, 0)
        self.dropped = widened(self.dropped, room, 0)
        self.loose = widened(self.loose, room, 0)
        self.pool_first = widened(self.pool_first, room, 0)
        self.pool_count = widened(self.pool_count, room, 0)
        self.reasons = widened(self.reasons, room, NONE)
        self.is_local = widened(self.is_local, room, 0)
        self.room = room
        return 0

    def add_reason(self, d: int, level: int) -> int:
        """Put a level on the list of row `d`."""
        reason = self.reason_free
        if reason >= 0:
            self.reason_free = self.reason_next[reason]
        else:
            if self.reason_used == len(self.reason_level):
                self.reason_level = widened(self.reason_level, 2 * self.reason_used, 0)
                self.reason_next = widened(self.reason_next, 2 * self.reason_used, NONE)
            reason = self.reason_used
            self.reason_used += 1
        self.reason_level[reason] = level
        self.reason_next[reason] = self.reasons[d]
        self.reasons[d] = reason
        return 0

    def drop_reasons(self, d: int) -> int:
        """Give the list of row `d` back."""
        reason = self.reasons[d]
        while reason >= 0:
            after = self.reason_next[reason]
            self.reason_next[reason] = self.reason_free
            self.reason_free = reason
            reason = after
        self.reasons[d] = NONE
        return 0

    def add_to_pool(self, d: int, o: int, before: int, after: int) -> int:
        """Give row `d` one more thing to choose from."""
        at = self.pool_used
        if at == len(self.pool_object):
            self.pool_object = widened(self.pool_object, 2 * at, 0)
            self.pool_before = widened(self.pool_before, 2 * at, 0)
            self.pool_after = widened(self.pool_after, 2 * at, 0)
        self.pool_object[at] = o
        self.pool_before[at] = before
        self.pool_after[at] = after
        self.pool_used = at + 1
        self.pool_count[d] += 1
        return 0
