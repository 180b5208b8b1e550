"""Hold the candidates that a search may mend: heaps in EUROPA's order, and what left them and may come back.

A slot is a token or a variable seen by one manager: id times managers plus manager. Entries of heaps may be stale; the
key that a slot has now is in `token_key` or `variable_key`, NO_KEY if it is in no heap.
"""

from array import array

from runtime.constraints.domains.arrays import grown
from runtime.constraints.stn.distances import Distances
from runtime.constraints.stn.heap import Heap
from runtime.constraints.stn.reach import Reach
from runtime.plan.store.plan import Plan
from runtime.plan.tags import END, FLAG_GOAL, FREED, LIST_ORDER, LISTS, OBJECT, ROLE_TOKEN, START, UNDO_BRANCH, UNDO_INPUTS
from runtime.solver.configuration.handler_table import Treatments
from runtime.solver.flaws.custom import CustomManager
from runtime.solver.flaws.filters import Filters
from runtime.solver.flaws.guarding import guards_hold
from runtime.solver.flaws.restarts import Weights
from runtime.solver.flaws.supports import Supports
from runtime.solver.flaws.uses import Uses
from runtime.solver.tags import DROPPED_TOKEN, DROPPED_VARIABLE, NO_KEY, NONE, UNBOUND_VARIABLE
from runtime.solver.widening import widened

LATEST = 2**38  # starts beyond count as equal
YOUNGEST = 2**22  # and so do tokens


class Queues:
    """The heaps, the loose slots that are looked at in every step, the parked ones, and the levels of everything."""

    def __init__(
        self,
        plan: Plan,
        treatments: Treatments,
        filters: Filters,
        supports: Supports,
        exact: bool,
        in_order: bool,
    ) -> None:
        self.plan = plan
        self.rows = plan.rows
        self.engine = plan.engine
        self.treatments = treatments
        self.filters = filters
        self.supports = supports
        self.exact = exact  # make EUROPA's steps
        self.distances = Distances(plan.engine, exact)
        self.from_start = Reach(plan.engine, exact)
        self.to_start = Reach(plan.engine, exact)
        self.from_end = Reach(plan.engine, exact)
        self.to_end = Reach(plan.engine, exact)
        self.uses = Uses(plan, self.distances, array("q", [0]))
        self.takers = Heap()
        self.weights = Weights(plan.engine)
        self.has_custom = False
        self.custom = CustomManager()
        self.found_at = 0
        self.found_low = 0
        self.earliest = False  # goals come before what else is open, in the order of their starts
        self.probing = False  # a choice is looked for, but not carried out
        self.managers = max(treatments.managers, 1)
        self.heaps = [Heap() for _ in range(treatments.heaps)]
        self.effects = [Heap() for _ in range(treatments.managers)]
        self.sorted_by_size = array("q", [0] * max(treatments.heaps, 1))
        for manager in range(treatments.managers):
            if treatments.manager_kind[manager] == UNBOUND_VARIABLE:
                first = treatments.manager_heap[manager]
                for heap in range(first, first + treatments.manager_heaps[manager]):
                    self.sorted_by_size[heap] = 1 if not in_order or treatments.heap_priority[heap] != 0.0 else 0
        self.sequence = array("q", [0]) * 64
        self.range_object = NONE  # whose sequence is known to coincide with the token that is looked around from
        self.range_first = self.range_end = 0  # between these places only
        self.level = 0
        self.found_manager = NONE
        self.found_kind = NONE
        self.found_item = NONE
        self.found_handler = NONE
        self.found_priority = 0.0
        self.make_tables()

    def make_tables(self) -> None:
        """Make the tables, empty."""
        self.token_room = 64
        self.variable_room = 256
        self.edge_room = 256
        self.constraint_room = 256
        self.restriction_room = 256
        self.token_row = array("q", [NONE]) * (64 * self.managers)
        self.token_key = array("q", [NO_KEY]) * (64 * self.managers)
        self.token_parked = array("q", [0]) * 64
        self.token_waiting = array("q", [NONE]) * 64
        self.token_level = array("q", [0]) * 64
        self.active_level = array("q", [0]) * 64
        self.order_level = array("q", [0]) * 64
        self.place_of = array("q", [0]) * 64
        self.variable_row = array("q", [NONE]) * (256 * self.managers)
        self.variable_key = array("q", [NO_KEY]) * (256 * self.managers)
        self.variable_parked = array("q", [0]) * 256
        self.stirs = array("b", [0]) * 256  # by variable: a change may concern what is, or was, queued or parked
        self.variable_level = array("q", [0]) * 256
        self.waits_for = array("q", [NONE]) * 256
        self.waiting_next = array("q", [NONE]) * 256
        self.waiting_before = array("q", [NONE]) * 256
        self.edge_level = array("q", [0]) * 256
        self.constraint_level = array("q", [0]) * 256
        self.restriction_level = array("q", [0]) * 256
        self.loose_count = 0
        self.loose_slot = array("q", [0]) * 64
        self.loose_is_variable = array("q", [0]) * 64
        self.dropped_count = 0
        self.dropped_slot = array("q", [0]) * 256
        self.dropped_what = array("q", [0]) * 256
        self.rows_seen = 0
        self.engine_seen = 0
        self.fired_scope = array("q", [NONE]) * 64  # guards that fired, by level: those of a level end at `fired_end`
        self.fired_end = array("q", [0]) * 64
        self.waiting_guards = array("q", [0]) * 64  # by level: how many have not fired

    def reserve(self) -> int:
        """Make the tables as long as those of the plan and the engine."""
        if self.token_room < self.rows.token_capacity:
            room = self.rows.token_capacity
            self.token_row = widened(self.token_row, room * self.managers, NONE)
            self.token_key = widened(self.token_key, room * self.managers, NO_KEY)
            self.token_parked = widened(self.token_parked, room, 0)
            self.token_waiting = widened(self.token_waiting, room, NONE)
            self.token_level = widened(self.token_level, room, 0)
            self.active_level = widened(self.active_level, room, 0)
            self.order_level = widened(self.order_level, room, 0)
            self.place_of = widened(self.place_of, room, 0)
            self.token_room = room
        if self.variable_room < len(self.engine.kind):
            room = len(self.engine.kind)
            self.variable_row = widened(self.variable_row, room * self.managers, NONE)
            self.variable_key = widened(self.variable_key, room * self.managers, NO_KEY)
            self.variable_parked = widened(self.variable_parked, room, 0)
            self.stirs = grown(self.stirs, "b", room, 0)
            self.variable_level = widened(self.variable_level, room, 0)
            self.waits_for = widened(self.waits_for, room, NONE)
            self.waiting_next = widened(self.waiting_next, room, NONE)
            self.waiting_before = widened(self.waiting_before, room, NONE)
            self.variable_room = room
        if self.edge_room < len(self.engine.edge_weight):
            self.edge_room = len(self.engine.edge_weight)
            self.edge_level = widened(self.edge_level, self.edge_room, 0)
        if self.constraint_room < len(self.engine.op):
            self.constraint_room = len(self.engine.op)
            self.constraint_level = widened(self.constraint_level, self.constraint_room, 0)
        if self.restriction_room < len(self.engine.restriction_span):
            self.restriction_room = len(self.engine.restriction_span)
            self.restriction_level = widened(self.restriction_level, self.restriction_room, 0)
        return 0

    def note_fired(self, level: int) -> int:
        """Read which guards have fired since the last time, and put them down for a level above 0."""
        if level >= len(self.fired_end):
            self.fired_end = widened(self.fired_end, 2 * level, 0)
            self.waiting_guards = widened(self.waiting_guards, 2 * level, 0)
        count = self.fired_end[level - 1]
        waiting = self.waiting_guards[level - 1]
        for at in range(self.rows_seen, self.rows.trail_length):
            if self.rows.trail_code[at] == UNDO_BRANCH:
                if count == len(self.fired_scope):
                    self.fired_scope = widened(self.fired_scope, 2 * count, NONE)
                self.fired_scope[count] = self.rows.trail_index[at]
                count += 1
                waiting -= 1
            elif self.rows.trail_code[at] == UNDO_INPUTS:
                waiting += 1
        self.fired_end[level] = count
        self.waiting_guards[level] = waiting
        return 0

    def is_decided(self, v: int) -> bool:
        """Whether a variable is decided.

        In a rule EUROPA only equates the object of a new token with the one that the rule names: unless its class has
        a single object, it still is to be decided, in a step with one choice. Elsewhere it counts as given.
        """
        if not self.engine.is_decided(v):
            return False
        if not self.exact or self.engine.decided[v] or self.plan.variable_role[v] != ROLE_TOKEN:
            return True
        t = self.plan.variable_owner[v]
        if self.rows.master[t] < 0 or v - self.rows.var0[t] != OBJECT:
            return True
        objects = self.plan.class_prototype[self.plan.predicate_class[self.rows.predicate[t]]]
        if self.engine.is_open[objects]:
            listed = self.engine.base_values(objects)
            return listed is not None and len(listed) == 1
        return self.engine.is_decided(objects)

    def handler_now(self, row: int, t: int) -> int:
        """The handler of a row that applies now, the most specific one whose guards hold.

        `t` is the token that the flaw belongs to (NONE: to nobody).
        """
        at = self.treatments.first_handler[row]
        last = at + self.treatments.handler_count[row] - 1
        while at < last and not guards_hold(self.filters, self.treatments.handler_of[at], t):
            at += 1
        return self.treatments.handler_of[at]

    def take_sequence(self, o: int) -> int:
        """Put the tokens of a timeline into `sequence`; how many there are."""
        count = 0
        t = self.rows.head_first[self.plan.object_head[o]]
        while t >= 0:
            if count == len(self.sequence):
                self.sequence = widened(self.sequence, 2 * count, 0)
            self.sequence[count] = t
            count += 1
            t = self.rows.link_after[LISTS * t + LIST_ORDER]
        return count

    def look_around(self, t: int) -> int:
        """Have `from_start`, `to_start` and so on answer for the times of token `t`, until the plan changes."""
        v = self.rows.var0[t]
        self.from_start.begin(v + START, True)
        self.to_start.begin(v + START, False)
        self.from_end.begin(v + END, True)
        self.to_end.begin(v + END, False)
        self.range_object = NONE
        return 0

    def clear(self) -> None:
        """Forget all candidates."""
        for heap in self.heaps:
            heap.clear()
        for heap in self.effects:
            heap.clear()
        self.make_tables()
        self.reserve()

    # ---- into the queues ----

    def offer_token(self, slot: int) -> int:
        """Put the slot of a token where its row says, unless it is there."""
        if self.token_key[slot] != NO_KEY:
            return 0
        heap = self.treatments.heap_of[self.token_row[slot]]
        if heap < 0:
            self.token_key[slot] = 0
            return self.add_loose(slot, 0)
        key = self.rows.key[slot // self.managers]
        if self.treatments.heap_priority[heap] != 0.0:
            key = -key
        if self.earliest and self.rows.flags[slot // self.managers] & FLAG_GOAL:
            key = self.earliness(slot // self.managers)
        self.token_key[slot] = key
        queue = self.heaps[heap]
        queue.push(key, 0, slot)
        return 0

    def earliness(self, t: int) -> int:
        """What puts goals before other tokens: the earliest start first, of equal ones the oldest."""
        start = min(max(self.engine.lb[self.rows.var0[t] + START], 0), LATEST)
        return start * YOUNGEST + min(self.rows.key[t], YOUNGEST - 1) - LATEST * YOUNGEST - YOUNGEST

    def offer_effect(self, slot: int) -> int:
        """Put an effect of an action among those that are settled before anything else."""
        t = slot // self.managers
        queue = self.effects[slot % self.managers]
        queue.push(self.rows.key[t], 0, slot)
        return 0

    def offer_variable(self, slot: int) -> int:
        """Put the slot of a variable where its row says, unless it is there and as near to the front as it may be."""
        heap = self.treatments.heap_of[self.variable_row[slot]]
        v = slot // self.managers
        self.stirs[v] = 1
        if heap < 0:
            if self.variable_key[slot] == NO_KEY:
                self.variable_key[slot] = 0
                self.add_loose(slot, 1)
            return 0
        key = self.rank(v) if self.sorted_by_size[heap] else 0
        if self.variable_key[slot] == NO_KEY or key < self.variable_key[slot]:
            self.variable_key[slot] = key
            queue = self.heaps[heap]
            queue.push(key, v, slot)
        return 0

    def rank(self, v: int) -> int:
        """What sorts variables of equal priority: smaller first."""
        return self.weights.rank(v, self.filters.size(v))

    def resize(self, v: int) -> int:
        """Move a variable whose domain has become smaller to the front."""
        for slot in range(v * self.managers, v * self.managers + self.managers):
            if self.variable_key[slot] != NO_KEY:
                heap = self.treatments.heap_of[self.variable_row[slot]]
                if heap >= 0 and self.sorted_by_size[heap]:
                    self.offer_variable(slot)
        return 0

    def add_loose(self, slot: int, is_variable: int) -> int:
        """Have a slot looked at in every step."""
        if self.loose_count == len(self.loose_slot):
            self.loose_slot = widened(self.loose_slot, 2 * self.loose_count, 0)
            self.loose_is_variable = widened(self.loose_is_variable, 2 * self.loose_count, 0)
        self.loose_slot[self.loose_count] = slot
        self.loose_is_variable[self.loose_count] = is_variable
        self.loose_count += 1
        return 0

    # ---- out of the queues, and back ----

    def drop(self, slot: int, what: int) -> int:
        """Note that a slot left its heap, so that going back puts it in again."""
        if what == DROPPED_VARIABLE:
            self.variable_key[slot] = NO_KEY
        elif what == DROPPED_TOKEN:
            self.token_key[slot] = NO_KEY
        if self.dropped_count == len(self.dropped_slot):
            self.dropped_slot = widened(self.dropped_slot, 2 * self.dropped_count, 0)
            self.dropped_what = widened(self.dropped_what, 2 * self.dropped_count, 0)
        self.dropped_slot[self.dropped_count] = slot
        self.dropped_what[self.dropped_count] = what
        self.dropped_count += 1
        return 0

    def park_token(self, slot: int) -> int:
        """Keep a token back until its times change."""
        self.drop(slot, DROPPED_TOKEN)
        self.token_parked[slot // self.managers] = 1
        self.stir_times(slot // self.managers)
        return 0

    def park_variable(self, slot: int, t: int) -> int:
        """Keep a variable back until its domain changes, or the times of token `t` (NONE: no token)."""
        self.drop(slot, DROPPED_VARIABLE)
        v = slot // self.managers
        self.variable_parked[v] = 1
        if t >= 0 and self.waits_for[v] != t:
            self.forget_waiting(v)
            self.waits_for[v] = t
            self.stir_times(t)
            first = self.token_waiting[t]
            self.waiting_next[v] = first
            self.waiting_before[v] = NONE
            if first >= 0:
                self.waiting_before[first] = v
            self.token_waiting[t] = v
        return 0

    def stir_times(self, t: int) -> int:
        """Have changes of a token's times seen."""
        self.stirs[self.rows.var0[t] + START] = 1
        self.stirs[self.rows.var0[t] + END] = 1
        return 0

    def forget_waiting(self, v: int) -> int:
        """Take a variable off the list of the token that it waits for."""
        t = self.waits_for[v]
        if t >= 0:
            before = self.waiting_before[v]
            after = self.waiting_next[v]
            if before >= 0:
                self.waiting_next[before] = after
            else:
                self.token_waiting[t] = after
            if after >= 0:
                self.waiting_before[after] = before
            self.waits_for[v] = NONE
        return 0

    def unpark_token(self, t: int) -> int:
        """Have a token looked at again."""
        self.token_parked[t] = 0
        for slot in range(t * self.managers, t * self.managers + self.managers):
            if self.token_row[slot] >= 0:
                self.offer_token(slot)
        return 0

    def unpark_variable(self, v: int) -> int:
        """Have a variable looked at again."""
        self.variable_parked[v] = 0
        for slot in range(v * self.managers, v * self.managers + self.managers):
            if self.variable_row[slot] >= 0:
                self.offer_variable(slot)
        return 0

    def go_back(self, dropped: int, loose: int, rows_seen: int, engine_seen: int) -> int:
        """Put back what left since then; the plan and the engine have gone back already."""
        for at in range(loose, self.loose_count):
            if self.loose_is_variable[at]:
                self.variable_key[self.loose_slot[at]] = NO_KEY
            else:
                self.token_key[self.loose_slot[at]] = NO_KEY
        self.loose_count = loose
        at = self.dropped_count
        while at > dropped:
            at -= 1
            slot = self.dropped_slot[at]
            what = self.dropped_what[at]
            if what == DROPPED_VARIABLE:
                if self.variable_row[slot] >= 0 and self.engine.kind[slot // self.managers] >= 0:
                    self.offer_variable(slot)
            elif self.rows.status[slot // self.managers] != FREED:
                if what == DROPPED_TOKEN:
                    self.offer_token(slot)
                else:
                    self.offer_effect(slot)
        self.dropped_count = dropped
        self.rows_seen = rows_seen
        self.engine_seen = engine_seen
        return 0
