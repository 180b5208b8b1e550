"""Hold every variable's domain in arrays, with the trail that undoes changes and the queues that they wake."""

from array import array
from typing import Any

from runtime.constraints.domains.arrays import grow_ring, grow_rows, lengthen, next_log_room
from runtime.constraints.domains.sparse_set import SparseSet
from runtime.constraints.domains.tags import (
    CONFLICT_DOMAIN,
    EVENT_DECIDED,
    PRIORITY_CHEAP,
    PRIORITY_WATCH,
    TRAIL_DECIDED,
    TRAIL_LOWER,
    TRAIL_REAL_LOWER,
    TRAIL_REAL_UPPER,
    TRAIL_UPPER,
)
from runtime.limits import LimitError

_FIRST_ROOM = 128


class Store:
    """Rows of arrays named by ids: variables, watches, trail, queues; the engine is a store that can reason.

    A domain is the whole numbers (or reals) between two bounds, less the holes in the variable's bit set, if it has
    one. Each bound and each hole names its support. `when` numbers order all changes of bounds and holes in time.
    """

    def __init__(self) -> None:
        room = _FIRST_ROOM
        # Variables.
        self.variables = 0
        self.kind = array("b", [0]) * room
        self.lb = array("q", [0]) * room
        self.ub = array("q", [0]) * room
        self.flo = array("d", [0.0]) * room
        self.fhi = array("d", [0.0]) * room
        self.lower_support = array("i", [-1]) * room
        self.upper_support = array("i", [-1]) * room
        self.lower_when = array("q", [-1]) * room
        self.upper_when = array("q", [-1]) * room
        self.word = array("i", [-1]) * room
        self.words_of = array("i", [0]) * room
        self.bit_base = array("q", [0]) * room
        self.table = array("i", [-1]) * room
        self.table_length = array("i", [0]) * room
        self.hole_head = array("i", [-1]) * room
        self.is_open = array("b", [0]) * room
        self.decided = array("b", [0]) * room
        self.constant = array("b", [0]) * room
        self.restriction_head = array("i", [-1]) * room
        self.watch_head = array("i", [-1]) * room
        self.mute_head = array("i", [-1]) * room
        self.out_head = array("i", [-1]) * room
        self.in_head = array("i", [-1]) * room
        self.queued = array("b", [0]) * room
        # Consecutive variables are blocks, freed and used again together.
        self.block_first = array("i", [0]) * room
        self.block_size = array("i", [0]) * room
        self.block_left = array("i", [0]) * room
        self.block_next = array("i", [-1]) * room
        self.block_free = array("i", [-1]) * 65
        self.reserved_next = 0
        self.reserved_end = 0
        # Words of bit sets, tables of the values that sparse and real sets have, and the log of holes.
        self.bits = array("Q", [0]) * room
        self.bits_used = 0
        self.table_values = array("d", [0.0]) * room
        self.table_used = 0
        self.word_free = array("i", [-1]) * 65
        self.table_free = array("i", [-1]) * 65
        self.hole_word = array("i", [0]) * room
        self.hole_mask = array("Q", [0]) * room
        self.hole_support = array("i", [-1]) * room
        self.hole_when = array("q", [-1]) * room
        self.hole_next = array("i", [-1]) * room
        self.hole_free = -1
        self.holes_used = 0
        # The trail.
        self.trail_size = 0
        self.trail_room = room
        self.trail_most = 2**62
        self.trail_base = 0
        self.trail_key = array("i", [0]) * room
        self.trail_value = array("q", [0]) * room
        self.trail_support = array("i", [0]) * room
        self.trail_when = array("q", [0]) * room
        self.real_bounds = array("d", [0.0]) * room  # those of floats; the trail has their indices
        self.real_bounds_used = 0
        self.entailed_count = 0
        self.marks = 0
        # Watches: who wakes when a variable changes. A constraint's watches are consecutive, as are its arguments.
        self.slot_variable = array("i", [-1]) * room
        self.slot_constraint = array("i", [-1]) * room
        self.slot_mask = array("b", [0]) * room
        self.slot_next = array("i", [-1]) * room
        self.slot_prev = array("i", [-1]) * room
        self.slot_key = array("q", [0]) * room
        self.slots_used = 0
        # Edges: `target - source <= weight`, in the lists of both ends; some carry out a constraint, their link.
        self.edges_used = 0
        self.edge_free = -1
        self.edge_source = array("i", [-1]) * room
        self.edge_target = array("i", [-1]) * room
        self.edge_weight = array("q", [0]) * room
        self.out_next = array("i", [-1]) * room
        self.out_prev = array("i", [-1]) * room
        self.in_next = array("i", [-1]) * room
        self.in_prev = array("i", [-1]) * room
        self.edge_span = array("i", [-1]) * room
        self.edge_owner = array("i", [-1]) * room
        self.edge_link = array("i", [-1]) * room
        # Constraints; `first` is the first slot, `link_a` and `link_b` the edges that carry it out.
        self.constraints_used = 0
        self.constraint_free = -1
        self.op = array("i", [-1]) * room
        self.mode = array("b", [0]) * room
        self.first = array("i", [0]) * room
        self.arity = array("i", [0]) * room
        self.span = array("i", [-1]) * room
        self.owner = array("i", [-1]) * room
        self.link_a = array("i", [-1]) * room
        self.link_b = array("i", [-1]) * room
        self.drawn = array("q", [0]) * room  # the number that `rand` drew
        self.entailed = array("b", [0]) * room
        self.run_count = array("i", [0]) * room
        self.run_epoch = array("q", [0]) * room
        self.epoch = 1
        self.constraint_next = array("i", [-1]) * room
        self.slot_free = array("i", [-1]) * 65
        # Restrictions of base domains and decisions: each variable's list, the newest first.
        self.restrictions_used = 0
        self.restriction_free = -1
        self.restriction_variable = array("i", [-1]) * room
        self.restriction_lo = array("d", [0.0]) * room
        self.restriction_hi = array("d", [0.0]) * room
        self.restriction_next = array("i", [-1]) * room
        self.restriction_span = array("i", [-1]) * room
        self.restriction_owner = array("i", [-1]) * room
        self.restriction_flags = array("b", [0]) * room
        self.restriction_values: dict[int, list[float]] = {}
        self.holes = True
        # What some operations read beside their arguments.
        self.externals: dict[int, Any] = {}
        self.object_parent: dict[int, int] = {}
        self.tick_seconds = 1.0
        self.tick_epoch = 0.0
        self.seed = 0
        # Edges that could not be followed because the store was, or became, inconsistent.
        self.suspects: list[int] = []
        # Work space of explanations and retraction: bounds by key `v * 4 + side`.
        self.reasons = array("q", [0]) * room
        self.reason_count = 0
        self.visit = array("q", [0]) * (4 * room)
        self.visits_begun = 0
        self.relaxed = array("b", [0]) * room
        self.cone = array("q", [0]) * room
        self.cone_count = 0
        self.doomed, self.gone = SparseSet(64), SparseSet(64)  # constraints and edges that a retraction removes
        self.support_stack = array("q", [0]) * room
        self.supported = array("q", [0]) * room  # by a row of the look-up that runs: 32 values to a cell
        # Queues: bounds whose edges must be visited, variables whose bounds may stand in a hole, constraints to run.
        self.edge_queue = array("i", [0]) * (4 * room)
        self.edge_mask = 4 * room - 1
        self.edge_first = 0
        self.edge_last = 0
        self.hull_queue = array("i", [0]) * (2 * room)
        self.hull_mask = 2 * room - 1
        self.hull_first = 0
        self.hull_last = 0
        self.cheap_queue = array("i", [0]) * (2 * room)
        self.cheap_mask = 2 * room - 1
        self.cheap_first = 0
        self.cheap_last = 0
        self.dear_queue = array("i", [0]) * (2 * room)
        self.dear_mask = 2 * room - 1
        self.dear_first = 0
        self.dear_last = 0
        self.scheduled = array("b", [0]) * room
        self.priority = array("b", [0]) * room
        self.idempotent = array("b", [0]) * room  # whether one run leaves a constraint nothing more to narrow
        self.woken = array("i", [0]) * room
        self.woken_count = 0
        self.running = -1
        self.coarse = False
        self.relational = False  # functions narrow intervals at once, instead of waiting for known arguments
        # The conflict, and what was counted.
        self.consistent = True
        self.conflict_kind = 0
        self.conflict_variable = -1
        self.conflict_side = 0
        self.conflict_support = -1
        self.conflict_edge = -1
        self.updates = 0
        self.visits = 0
        self.runs = 0

    # -------------------------------------------------------------------------------------------------- growth

    def grow_variables(self) -> None:
        """Lengthen the rows of variables."""
        lengthen(
            self,
            "kind lb ub flo fhi words_of bit_base table_length is_open decided constant queued relaxed block_first "
            "block_size block_left",
            "lower_support upper_support lower_when upper_when word table hole_head restriction_head watch_head "
            "mute_head out_head in_head block_next",
        )
        room = len(self.kind)
        grow_rows(self, "visit", 4 * room)
        grow_ring(self, "edge", 4 * room)
        grow_ring(self, "hull", 2 * room)

    def grow_constraints(self) -> None:
        """Lengthen the rows of constraints, and both queues of them."""
        lengthen(
            self,
            "mode first arity drawn entailed run_count run_epoch scheduled priority idempotent woken",
            "op span owner link_a link_b constraint_next",
        )
        grow_ring(self, "cheap", 2 * len(self.op))
        grow_ring(self, "dear", 2 * len(self.op))

    def grow_trail(self) -> None:
        """Make the trail longer; `LimitError` beyond `trail_most`."""
        if len(self.trail_key) == self.trail_room:
            room = next_log_room(self.trail_room)
            if room > self.trail_most:
                raise LimitError(f"more than {self.trail_room} changes of its plan are in force at once")
            grow_rows(self, "trail_key trail_value trail_support trail_when", room)
        self.trail_room = len(self.trail_key)

    # --------------------------------------------------------------------------------------------- saving, waking

    def save_real(self, x: float) -> int:
        """Keep a float's bound for the way back; give its index."""
        i = self.real_bounds_used
        if i == len(self.real_bounds):
            grow_rows(self, "real_bounds", 2 * i)
        self.real_bounds[i] = x
        self.real_bounds_used = i + 1
        return i

    def save(self, name: int, code: int, value: int, support: int) -> None:
        """Push a structural change: enough to undo it."""
        i = self.trail_size
        if i == self.trail_room:
            self.grow_trail()
        self.trail_key[i] = name * 16 + code
        self.trail_value[i] = value
        self.trail_support[i] = support
        self.trail_when[i] = -1
        self.trail_size = i + 1

    def write_lower(self, v: int, x: int, support: int) -> None:
        """Store a lower bound that is known to be tighter, its support and the way back; wake nobody."""
        i = self.trail_size
        if i == self.trail_room:
            self.grow_trail()
        self.trail_key[i] = v * 16 + TRAIL_LOWER
        self.trail_value[i] = self.lb[v]
        self.trail_support[i] = self.lower_support[v]
        self.trail_when[i] = self.lower_when[v]
        self.trail_size = i + 1
        self.lb[v] = x
        self.lower_support[v] = support
        self.lower_when[v] = self.trail_base + i
        self.updates += 1

    def write_upper(self, v: int, x: int, support: int) -> None:
        """Store an upper bound that is known to be tighter, its support and the way back; wake nobody."""
        i = self.trail_size
        if i == self.trail_room:
            self.grow_trail()
        self.trail_key[i] = v * 16 + TRAIL_UPPER
        self.trail_value[i] = self.ub[v]
        self.trail_support[i] = self.upper_support[v]
        self.trail_when[i] = self.upper_when[v]
        self.trail_size = i + 1
        self.ub[v] = x
        self.upper_support[v] = support
        self.upper_when[v] = self.trail_base + i
        self.updates += 1

    def write_real_lower(self, v: int, x: float, support: int) -> None:
        """Store a float's lower bound, its support and the way back; wake nobody."""
        i = self.trail_size
        if i == self.trail_room:
            self.grow_trail()
        self.trail_key[i] = v * 16 + TRAIL_REAL_LOWER
        self.trail_value[i] = self.save_real(self.flo[v])
        self.trail_support[i] = self.lower_support[v]
        self.trail_when[i] = self.lower_when[v]
        self.trail_size = i + 1
        self.flo[v] = x
        self.lower_support[v] = support
        self.lower_when[v] = self.trail_base + i
        self.updates += 1

    def write_real_upper(self, v: int, x: float, support: int) -> None:
        """Store a float's upper bound, its support and the way back; wake nobody."""
        i = self.trail_size
        if i == self.trail_room:
            self.grow_trail()
        self.trail_key[i] = v * 16 + TRAIL_REAL_UPPER
        self.trail_value[i] = self.save_real(self.fhi[v])
        self.trail_support[i] = self.upper_support[v]
        self.trail_when[i] = self.upper_when[v]
        self.trail_size = i + 1
        self.fhi[v] = x
        self.upper_support[v] = support
        self.upper_when[v] = self.trail_base + i
        self.updates += 1

    def note_conflict(self, kind: int, v: int, side: int, support: int) -> None:
        """Record a conflict."""
        self.consistent = False
        self.conflict_kind = kind
        self.conflict_variable = v
        self.conflict_side = side
        self.conflict_support = support

    def fail(self, v: int, side: int, support: int) -> bool:
        """Record that `support` leaves no value on that side of `v`; always false."""
        self.note_conflict(CONFLICT_DOMAIN, v, side, support)
        return False

    def wake(self, v: int, event: int) -> None:
        """Schedule the constraints that watch for this event of `v`."""
        slot = self.watch_head[v]
        while slot >= 0:
            if self.slot_mask[slot] & event:
                self.schedule(self.slot_constraint[slot])
            slot = self.slot_next[slot]

    def schedule(self, constraint: int) -> None:
        """Put a constraint into its queue, unless it is there or is the one that runs."""
        if not self.scheduled[constraint] and constraint != self.running:
            self.scheduled[constraint] = 1
            if self.priority[constraint] == PRIORITY_CHEAP:
                self.cheap_queue[self.cheap_last] = constraint
                self.cheap_last = (self.cheap_last + 1) & self.cheap_mask
            elif self.priority[constraint] == PRIORITY_WATCH:
                self.woken[self.woken_count] = constraint
                self.woken_count += 1
            else:
                self.dear_queue[self.dear_last] = constraint
                self.dear_last = (self.dear_last + 1) & self.dear_mask

    def queue_edges(self, v: int, side: int) -> None:
        """Have the edges of `v` visited that pass on this bound (0 lower, 1 upper)."""
        if (self.in_head[v] if side == 0 else self.out_head[v]) >= 0 and not self.queued[v] & (1 << side):
            self.queued[v] |= 1 << side
            self.edge_queue[self.edge_last] = 2 * v + side
            self.edge_last = (self.edge_last + 1) & self.edge_mask

    def queue_hull(self, v: int) -> None:
        """Have the bounds of `v` rounded to values that are in its bit set."""
        if not self.queued[v] & 4:
            self.queued[v] |= 4
            self.hull_queue[self.hull_last] = v
            self.hull_last = (self.hull_last + 1) & self.hull_mask

    def clear_woken(self) -> None:
        """Let the watches in `woken` be woken again."""
        for i in range(self.woken_count):
            self.scheduled[self.woken[i]] = 0
        self.woken_count = 0

    def set_decided(self, v: int, flag: int) -> None:
        """Mark `v` as specified, or no longer; watches see it."""
        if self.decided[v] != flag:
            self.save(v, TRAIL_DECIDED, self.decided[v], 0)
            self.decided[v] = flag
            self.wake(v, EVENT_DECIDED)
