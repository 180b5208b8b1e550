"""Agenda: candidate flaws in heaps by priority and EUROPA's order, kept incrementally, with an undo log.

A slot is a token or a variable seen by one manager: id times managers plus manager. Entries of heaps may be stale; the
key that a slot has now is in `token_key` or `variable_key`, NO_KEY if it is in no heap.
"""

from array import array

from runtime.constraints.domains.arrays import blank, grow_rows, lengthen
from runtime.constraints.domains.base_domain import is_base_single
from runtime.constraints.domains.narrow import is_single
from runtime.constraints.domains.sparse_set import SparseSet
from runtime.constraints.stn.distances import Distances
from runtime.constraints.stn.heap import Heap
from runtime.plan.store.plan import Plan
from runtime.plan.tags import END, FLAG_GOAL, FREED, OBJECT, ROLE_TOKEN, START, UNDO_BRANCH, UNDO_INPUTS
from runtime.solver.configuration.handler_table import HandlerTable
from runtime.solver.flaws.filters import Filters
from runtime.solver.flaws.guarding import guards_hold
from runtime.solver.flaws.relief import Relief
from runtime.solver.flaws.restarts import Restarts
from runtime.solver.flaws.sequence import TimelineSequence
from runtime.solver.flaws.supports import Supports
from runtime.solver.flaws.uses import Uses
from runtime.solver.tags import DROPPED_TOKEN, DROPPED_VARIABLE, NO_KEY, NONE, UNBOUND_VARIABLE

_LATEST = 2**38  # starts beyond count as equal
_YOUNGEST = 2**22  # and so do tokens


class Agenda:
    """The heaps, the dynamic slots that are looked at in every step, the deferred ones, and decision levels."""

    def __init__(
        self,
        plan: Plan,
        table: HandlerTable,
        filters: Filters,
        supports: Supports,
        exact: bool,
        in_order: bool,
    ) -> None:
        self.plan = plan
        self.rows = plan.rows
        self.engine = plan.engine
        self.table = table
        self.filters = filters
        self.supports = supports
        self.exact = exact  # makes EUROPA's steps
        self.distances = Distances(plan.engine, exact)
        self.uses = Uses(plan, self.distances)
        self.restarts = Restarts(plan.engine)
        self.found_at = self.found_low = 0
        self.earliest = False  # goals come before what else is open, in the order of their starts
        self.probing = False  # a resolver is looked for, but not carried out
        self.managers = max(table.managers, 1)
        self.heaps = [Heap() for _ in range(table.heaps)]
        self.effects = [Heap() for _ in range(table.managers)]
        self.sorted_by_size = array("q", [0] * max(table.heaps, 1))
        for manager in range(table.managers):
            if table.manager_kind[manager] == UNBOUND_VARIABLE:
                first = table.manager_heap[manager]
                for heap in range(first, first + table.manager_heaps[manager]):
                    self.sorted_by_size[heap] = 1 if not in_order or table.heap_priority[heap] != 0.0 else 0
        self.unbound_masks = array("q", [NONE]) * 64  # by kind of token: which of its variables are decided
        self.sequence = TimelineSequence(plan, exact)
        self.level = 0
        self.found_manager = self.found_kind = self.found_item = self.found_handler = NONE
        self.found_priority = 0.0
        self.token_row = array("q", [NONE]) * (64 * self.managers)
        self.token_key = array("q", [NO_KEY]) * (64 * self.managers)
        self.token_waiting = array("q", [NONE]) * 64
        self.token_deferred, self.token_level, self.active_level, self.order_level = [blank(64) for _ in range(4)]
        self.variable_row = array("q", [NONE]) * (256 * self.managers)
        self.variable_key = array("q", [NO_KEY]) * (256 * self.managers)
        self.variable_deferred, self.variable_level = blank(256), blank(256)
        self.watched = blank(256, "b")  # by variable: whether a change of its domain is looked at
        self.touched = SparseSet(256)  # variables of which the tables say anything but decision levels
        self.waits_for, self.waiting_next, self.waiting_before = [array("q", [NONE]) * 256 for _ in range(3)]
        self.edge_level, self.constraint_level, self.restriction_level = blank(256), blank(256), blank(256)
        self.dynamic_slot, self.dynamic_is_variable = blank(64), blank(64)
        self.dropped_slot, self.dropped_kind = blank(256), blank(256)
        self.dynamic_count = self.dropped_count = self.rows_seen = self.engine_seen = 0
        self.fired_scope = array("q", [NONE]) * 64  # guards that fired, by level: those of a level end at `fired_end`
        self.fired_end, self.waiting_guards = blank(64), blank(64)  # by level; and how many have not fired
        self.relief: Relief | None = None  # where open tokens may relieve a resource
        self.tokens_used = self.variables_used = self.edges_used = self.constraints_used = self.restrictions_used = 0

    def _empty_tables(self) -> None:
        """Empty the tables as far as they are in use; they stay as long as they are."""
        slots, used = self.tokens_used * self.managers, self.tokens_used
        _fill(self.token_row, NONE, slots)
        _fill(self.token_key, NO_KEY, slots)
        _fill(self.token_waiting, NONE, used)
        _fill(self.token_deferred, 0, used)
        for i in range(self.touched.count):
            v = self.touched.items[i]
            self.touched.marks[v] = 0
            for slot in range(v * self.managers, v * self.managers + self.managers):
                self.variable_row[slot] = NONE
                self.variable_key[slot] = NO_KEY
            self.waits_for[v] = NONE
            self.waiting_next[v] = NONE
            self.waiting_before[v] = NONE
            self.variable_deferred[v] = 0
            self.watched[v] = 0
        self.touched.count = 0
        if self.level > 0:
            self._forget_levels()
        self.waiting_guards[0] = 0
        self.dynamic_count = self.dropped_count = self.rows_seen = self.engine_seen = 0
        self.tokens_used = self.variables_used = self.edges_used = self.constraints_used = self.restrictions_used = 0

    def _forget_levels(self) -> None:
        """Forget the decision levels of everything; nothing has one before the first decision."""
        _fill(self.token_level, 0, self.tokens_used)
        _fill(self.active_level, 0, self.tokens_used)
        _fill(self.order_level, 0, self.tokens_used)
        _fill(self.variable_level, 0, self.variables_used)
        _fill(self.edge_level, 0, self.edges_used)
        _fill(self.constraint_level, 0, self.constraints_used)
        _fill(self.restriction_level, 0, self.restrictions_used)
        _fill(self.fired_scope, NONE, len(self.fired_scope))
        _fill(self.fired_end, 0, len(self.fired_end))
        _fill(self.waiting_guards, 0, len(self.waiting_guards))
        self.level = 0

    def reserve(self) -> None:
        """Make the tables as long as those of the plan and the engine, and note how far they come to be in use."""
        self.tokens_used = max(self.tokens_used, self.rows.token_count)
        self.variables_used = max(self.variables_used, self.engine.variables)
        self.edges_used = max(self.edges_used, self.engine.edges_used)
        self.constraints_used = max(self.constraints_used, self.engine.constraints_used)
        self.restrictions_used = max(self.restrictions_used, self.engine.restrictions_used)
        room = len(self.rows.status)
        if len(self.token_level) < room:
            grow_rows(self, "token_row", room * self.managers, NONE)
            grow_rows(self, "token_key", room * self.managers, NO_KEY)
            grow_rows(self, "token_waiting", room, NONE)
            grow_rows(self, "token_deferred token_level active_level order_level", room)
        room = len(self.engine.kind)
        if len(self.variable_level) < room:
            grow_rows(self, "variable_row", room * self.managers, NONE)
            grow_rows(self, "variable_key", room * self.managers, NO_KEY)
            grow_rows(self, "waits_for waiting_next waiting_before", room, NONE)
            grow_rows(self, "variable_deferred watched variable_level", room)
            grow_rows(self.touched, "marks", room)
        if len(self.edge_level) < len(self.engine.edge_weight):
            grow_rows(self, "edge_level", len(self.engine.edge_weight))
        if len(self.constraint_level) < len(self.engine.op):
            grow_rows(self, "constraint_level", len(self.engine.op))
        if len(self.restriction_level) < len(self.engine.restriction_span):
            grow_rows(self, "restriction_level", len(self.engine.restriction_span))

    def note_fired(self, level: int) -> None:
        """Note for a level above 0 the guards that have fired since the last time."""
        if level >= len(self.fired_end):
            lengthen(self, "fired_end waiting_guards", need=level + 1)
        count = self.fired_end[level - 1]
        waiting = self.waiting_guards[level - 1]
        for at in range(self.rows_seen, self.rows.trail_length):
            if self.rows.trail_code[at] == UNDO_BRANCH:
                if count == len(self.fired_scope):
                    grow_rows(self, "fired_scope", 2 * count, NONE)
                self.fired_scope[count] = self.rows.trail_index[at]
                count += 1
                waiting -= 1
            elif self.rows.trail_code[at] == UNDO_INPUTS:
                waiting += 1
        self.fired_end[level] = count
        self.waiting_guards[level] = waiting

    def is_decided(self, v: int) -> bool:
        """Whether a variable is decided.

        In a rule EUROPA only equates the object of a new token with the one that the rule names: unless its class has
        a single object, it still is to be decided, in a step with one choice. Elsewhere it counts as given.
        """
        if not self.engine.decided[v] and not (is_single(self.engine, v) and is_base_single(self.engine, v)):
            return False
        if not self.exact or self.engine.decided[v] or self.plan.variable_role[v] != ROLE_TOKEN:
            return True
        t = self.plan.variable_owner[v]
        if self.rows.parent[t] < 0 or v - self.rows.var0[t] != OBJECT:
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
        at = self.table.first_handler[row]
        last = at + self.table.handler_count[row] - 1
        while at < last and not guards_hold(self.filters, self.table.handler_of[at], t):
            at += 1
        return self.table.handler_of[at]

    def note_flaw(self, manager: int, item: int, handler: int, priority: float) -> None:
        """Note the best flaw so far."""
        self.found_manager = manager
        self.found_kind = self.table.manager_kind[manager]
        self.found_item = item
        self.found_handler = handler
        self.found_priority = priority

    def clear(self) -> None:
        """Forget all candidates."""
        for heap in self.heaps:
            heap.clear()
        for heap in self.effects:
            heap.clear()
        self._empty_tables()
        self.reserve()

    # ---- adding candidates ----

    def offer_token(self, slot: int) -> int:
        """Add the slot of a token to the heap that its row names, unless it is there."""
        if self.token_key[slot] != NO_KEY:
            return 0
        heap = self.table.heap_of[self.token_row[slot]]
        if heap < 0:
            self.token_key[slot] = 0
            self._add_dynamic(slot, 0)
            return 0
        key = self.rows.key[slot // self.managers]
        if self.table.heap_priority[heap] != 0.0:
            key = -key
        if self.earliest and self.rows.flags[slot // self.managers] & FLAG_GOAL:
            key = self.earliness(slot // self.managers)
        self.token_key[slot] = key
        target = self.heaps[heap]
        target.push(key, 0, slot)
        return 0

    def earliness(self, t: int) -> int:
        """What puts goals before other tokens: the earliest start first, of equal ones the oldest."""
        start = min(max(self.engine.lb[self.rows.var0[t] + START], 0), _LATEST)
        return start * _YOUNGEST + min(self.rows.key[t], _YOUNGEST - 1) - _LATEST * _YOUNGEST - _YOUNGEST

    def offer_effect(self, slot: int) -> None:
        """Add an effect of an action, which is selected before anything else."""
        t = slot // self.managers
        target = self.effects[slot % self.managers]
        target.push(self.rows.key[t], 0, slot)

    def offer_variable(self, slot: int) -> int:
        """Add the slot of a variable to the heap that its row names, unless it is there with its present key."""
        heap = self.table.heap_of[self.variable_row[slot]]
        v = slot // self.managers
        self.touched.add(v)
        self.watched[v] = 1
        if heap < 0:
            if self.variable_key[slot] == NO_KEY:
                self.variable_key[slot] = 0
                self._add_dynamic(slot, 1)
            return 0
        key = self.rank(v) if self.sorted_by_size[heap] else 0
        if self.variable_key[slot] == NO_KEY or key < self.variable_key[slot]:
            self.variable_key[slot] = key
            target = self.heaps[heap]
            target.push(key, v, slot)
        return 0

    def rank(self, v: int) -> int:
        """Heap key of a variable: domain size, or dom/wdeg."""
        return self.restarts.rank(v, self.filters.size(v))

    def resize(self, v: int) -> None:
        """Update the key of a variable whose domain was narrowed."""
        for slot in range(v * self.managers, v * self.managers + self.managers):
            if self.variable_key[slot] != NO_KEY:
                heap = self.table.heap_of[self.variable_row[slot]]
                if heap >= 0 and self.sorted_by_size[heap]:
                    self.offer_variable(slot)

    def _add_dynamic(self, slot: int, is_variable: int) -> None:
        """Add a dynamic slot, which is looked at in every step."""
        if self.dynamic_count == len(self.dynamic_slot):
            lengthen(self, "dynamic_slot dynamic_is_variable")
        self.dynamic_slot[self.dynamic_count] = slot
        self.dynamic_is_variable[self.dynamic_count] = is_variable
        self.dynamic_count += 1

    # ---- removing candidates, and undoing that ----

    def drop(self, slot: int, kind: int) -> None:
        """Log that a slot left its heap, so that backtracking adds it again."""
        if kind == DROPPED_VARIABLE:
            self.variable_key[slot] = NO_KEY
        elif kind == DROPPED_TOKEN:
            self.token_key[slot] = NO_KEY
        if self.dropped_count == len(self.dropped_slot):
            lengthen(self, "dropped_slot dropped_kind")
        self.dropped_slot[self.dropped_count] = slot
        self.dropped_kind[self.dropped_count] = kind
        self.dropped_count += 1

    def defer_token(self, slot: int) -> None:
        """Defer a token until its times change."""
        self.drop(slot, DROPPED_TOKEN)
        self.token_deferred[slot // self.managers] = 1
        self._watch_times(slot // self.managers)

    def defer_variable(self, slot: int, t: int) -> None:
        """Defer a variable until its domain changes, or the times of token `t` (NONE: no token)."""
        self.drop(slot, DROPPED_VARIABLE)
        v = slot // self.managers
        self.touched.add(v)
        self.variable_deferred[v] = 1
        if t >= 0 and self.waits_for[v] != t:
            self.forget_waiting(v)
            self.waits_for[v] = t
            self._watch_times(t)
            first = self.token_waiting[t]
            self.waiting_next[v] = first
            self.waiting_before[v] = NONE
            if first >= 0:
                self.waiting_before[first] = v
            self.token_waiting[t] = v

    def _watch_times(self, t: int) -> None:
        """Watch the times of a token."""
        self.touched.add(self.rows.var0[t] + START)
        self.touched.add(self.rows.var0[t] + END)
        self.watched[self.rows.var0[t] + START] = 1
        self.watched[self.rows.var0[t] + END] = 1

    def forget_waiting(self, v: int) -> None:
        """Take a variable off the watch list of the token that it waits for."""
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

    def resume_token(self, t: int) -> None:
        """End the deferral of a token."""
        self.token_deferred[t] = 0
        for slot in range(t * self.managers, t * self.managers + self.managers):
            if self.token_row[slot] >= 0:
                self.offer_token(slot)

    def resume_variable(self, v: int) -> None:
        """End the deferral of a variable."""
        self.variable_deferred[v] = 0
        for slot in range(v * self.managers, v * self.managers + self.managers):
            if self.variable_row[slot] >= 0:
                self.offer_variable(slot)

    def backtrack(self, dropped: int, dynamic: int, rows_seen: int, engine_seen: int) -> None:
        """Undo what changed since then; the plan and the engine are undone already."""
        for at in range(dynamic, self.dynamic_count):
            if self.dynamic_is_variable[at]:
                self.variable_key[self.dynamic_slot[at]] = NO_KEY
            else:
                self.token_key[self.dynamic_slot[at]] = NO_KEY
        self.dynamic_count = dynamic
        at = self.dropped_count
        while at > dropped:
            at -= 1
            slot = self.dropped_slot[at]
            kind = self.dropped_kind[at]
            if kind == DROPPED_VARIABLE:
                if self.variable_row[slot] >= 0 and self.engine.kind[slot // self.managers] >= 0:
                    self.offer_variable(slot)
            elif self.rows.status[slot // self.managers] != FREED:
                if kind == DROPPED_TOKEN:
                    self.offer_token(slot)
                else:
                    self.offer_effect(slot)
        self.dropped_count = dropped
        self.rows_seen = rows_seen
        self.engine_seen = engine_seen


def _fill(row: "array[int]", value: int, count: int) -> None:
    """Give the first numbers of a table a value."""
    for k in range(count):
        row[k] = value
