"""The stack of decisions, as rows of numbers: the flaw, the resolver it is at, the way back, the conflict set."""

from array import array
from collections.abc import Sequence

from runtime.constraints.domains.arrays import lengthen
from runtime.solver.flaws.agenda import Agenda
from runtime.solver.tags import EVERYTHING, NONE


class Decisions:
    """Row 0 is the oldest decision. `depth` rows are in force; row `depth` may be the active one."""

    def __init__(self) -> None:
        room = 64
        self.depth = 0
        # The flaw. Of a resource: when it might be exceeded, and whether the level is too low then.
        self.kind = array("q", [0]) * room
        self.manager = array("q", [0]) * room
        self.item = array("q", [0]) * room
        self.handler = array("q", [0]) * room
        self.instant = array("q", [0]) * room
        self.is_low = array("q", [0]) * room
        # The resolver: how many were tried, the phase of an open condition, and where in its list the next one begins.
        self.tries = array("q", [0]) * room
        self.phase = array("q", [0]) * room
        self.cursor = array("q", [0]) * room
        self.lists: dict[int, Sequence[float]] = {}
        # The way back.
        self.mark = array("q", [0]) * room
        self.rows_seen = array("q", [0]) * room
        self.engine_seen = array("q", [0]) * room
        self.dropped = array("q", [0]) * room
        self.dynamic = array("q", [0]) * room
        # Insertions on timelines, or pairs of timepoints, to choose from: a pool, each decision has a stretch of it.
        self.pool_first = array("q", [0]) * room
        self.pool_count = array("q", [0]) * room
        self.pool_used = 0
        self.pool_object = array("q", [0]) * room
        self.pool_before = array("q", [0]) * room
        self.pool_after = array("q", [0]) * room
        # The conflict set: per decision a list of earlier ones.
        self.reasons = array("q", [NONE]) * room
        self.is_local = array("q", [0]) * room  # whether they hold only where decisions were made in this order
        self.reason_used = 0
        self.reason_free = NONE
        self.reason_level = array("q", [0]) * room
        self.reason_next = array("q", [NONE]) * room

    def open(self, agenda: Agenda, mark: int) -> int:
        """Make row `depth` an untried decision about the flaw that the agenda has found; its number."""
        d = self.depth
        if d == len(self.kind):
            lengthen(
                self,
                "kind manager item handler instant is_low tries phase cursor mark rows_seen engine_seen dropped "
                "dynamic pool_first pool_count is_local",
                "reasons",
            )
        self.kind[d] = agenda.found_kind
        self.manager[d] = agenda.found_manager
        self.item[d] = agenda.found_item
        self.handler[d] = agenda.found_handler
        self.instant[d] = agenda.found_at
        self.is_low[d] = agenda.found_low
        self.tries[d] = 0
        self.phase[d] = 0
        self.cursor[d] = NONE
        self.mark[d] = mark
        self.rows_seen[d] = agenda.rows_seen
        self.engine_seen[d] = agenda.engine_seen
        self.dropped[d] = agenda.dropped_count
        self.dynamic[d] = agenda.dynamic_count
        self.pool_first[d] = self.pool_used
        self.pool_count[d] = NONE
        self.reasons[d] = NONE
        self.is_local[d] = 0
        return d

    def close(self, d: int) -> None:
        """Give back what row `d`, the last one, holds in the pools."""
        self.pool_used = self.pool_first[d]
        self.drop_reasons(d)
        if len(self.lists):
            self.lists.pop(d, None)

    def clear(self) -> None:
        """Forget all decisions."""
        self.depth = 0
        self.pool_used = 0
        self.reason_used = 0
        self.reason_free = NONE

    # ---- resolvers ----

    def choose(self, d: int, cursor: int) -> None:
        """Note that the resolver at `cursor` is tried."""
        self.cursor[d] = cursor
        self.tries[d] += 1

    def next_phase(self, d: int) -> None:
        """Go on to the next phase of an open condition."""
        self.phase[d] += 1
        self.cursor[d] = NONE

    def begin_pool(self, d: int) -> None:
        """Begin an empty stretch of the pool for row `d`, the last one."""
        self.pool_used = self.pool_first[d]
        self.pool_count[d] = 0

    def drop_pool(self, d: int) -> None:
        """Give the stretch of row `d` back."""
        self.pool_used = self.pool_first[d]
        self.pool_count[d] = NONE

    def reverse_pool(self, first: int, end: int) -> None:
        """Reverse the order of the pool from index `first` to before `end`."""
        last = end - 1
        while first < last:
            self.pool_object[first], self.pool_object[last] = self.pool_object[last], self.pool_object[first]
            self.pool_before[first], self.pool_before[last] = self.pool_before[last], self.pool_before[first]
            self.pool_after[first], self.pool_after[last] = self.pool_after[last], self.pool_after[first]
            first += 1
            last -= 1

    def add_to_pool(self, d: int, o: int, before: int, after: int) -> None:
        """Add an insertion on object `o` between two tokens, or a precedence between two timepoints."""
        at = self.pool_used
        if at == len(self.pool_object):
            lengthen(self, "pool_object pool_before pool_after")
        self.pool_object[at] = o
        self.pool_before[at] = before
        self.pool_after[at] = after
        self.pool_used = at + 1
        self.pool_count[d] += 1

    # ---- conflict sets ----

    def add_reason(self, d: int, level: int) -> None:
        """Add a level to the conflict set of row `d`."""
        reason = self.reason_free
        if reason >= 0:
            self.reason_free = self.reason_next[reason]
        else:
            if self.reason_used == len(self.reason_level):
                lengthen(self, "reason_level", "reason_next")
            reason = self.reason_used
            self.reason_used += 1
        self.reason_level[reason] = level
        self.reason_next[reason] = self.reasons[d]
        self.reasons[d] = reason

    def drop_reasons(self, d: int) -> None:
        """Empty the conflict set of row `d`."""
        reason = self.reasons[d]
        while reason >= 0:
            after = self.reason_next[reason]
            self.reason_next[reason] = self.reason_free
            self.reason_free = reason
            reason = after
        self.reasons[d] = NONE

    def rest_on_everything(self, d: int) -> None:
        """Make all earlier decisions the conflict set of row `d`: the conflict has no simpler reason."""
        self.reasons[d] = EVERYTHING
