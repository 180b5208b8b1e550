"""Tables of the plan: engine, rows, bytecode, predicates, objects, agenda of rules and guards."""

from typing import Protocol

from runtime.constraints.domains.arrays import blank, lengthen
from runtime.constraints.domains.sparse_set import SparseSet
from runtime.constraints.engine import Engine
from runtime.plan.resources.protocols import UseOrder
from runtime.plan.resources.resources import Resources
from runtime.plan.store.rows import Rows
from runtime.plan.tags import NONE


class _Services(Protocol):
    """What rules ask of the world outside the arrays."""

    def make_object(self, scope: int, number: int) -> int:
        """Carry out `new` number `number`; the variable that holds the object."""

    def draw(self, parameter: int, v: int) -> int:
        """A constant with the value that the environment draws for a parameter, of the kind of `v`; or NONE."""

    def note_homeless(self, t: int) -> None:
        """Take note of a token that no object can hold."""

    def note_loose_item(self, span: int) -> None:
        """Take note of a set in the script with an item whose value is not known."""

    def sample_range(self, parameter: int) -> int:
        """The prototype of the values that a parameter may have; or NONE."""

    def post_written(self, number: int, arguments: list[int], span: int, owner: int) -> int:
        """Post constraint `number` of those that the modeler wrote; its id."""

    def forget_objects(self, count: int) -> None:
        """Go back to where there were `count` objects."""

    def note_open(self, v: int, prototype: int) -> None:
        """Remember an open variable, to which later objects are added."""


class Plan:
    """The plan so far, as arrays; `PlanDatabase` is its face to the outside."""

    def __init__(self, engine: Engine) -> None:
        self.engine = engine
        self.rows = Rows()
        # Work space of retraction: scopes, variables and restrictions that go.
        self.doomed_scopes, self.gone_variables, self.gone_restrictions = SparseSet(64), SparseSet(64), SparseSet(64)
        # Bytecode.
        self.code = blank(1)
        self.block_start = blank(1)
        self.block_end = blank(1)
        self.field_kind = blank(1)
        self.field_value = blank(1)
        self.field_start = blank(1)
        self.field_length = blank(1)
        self.field_names = blank(1)
        # Predicates: their parameters' prototypes lie in `parameter_*` from `parameter_start` on.
        self.predicate_class = blank(1)
        self.predicate_flags = blank(1)
        self.predicate_timeline = blank(1)
        self.predicate_resource = blank(1)
        # Predicates of one name: what the class has under each name, the base class's, and the topmost.
        self.suffixes = 0
        self.predicate_suffix = blank(1)
        self.predicate_at = blank(1)
        self.predicate_parent = blank(1)
        self.predicate_root = blank(1)
        self.parameter_start = blank(1)
        self.parameter_count = blank(1)
        self.parameter_prototype = blank(1)
        self.parameter_copy_kind = blank(1)
        self.parameter_copy_value = blank(1)
        self.body_block = blank(1)
        self.body_slots = blank(1)
        self.body_tokens = blank(1)
        self.first_rule = blank(1)
        self.rule_number = blank(1)
        # Rules.
        self.rule_block = blank(1)
        self.rule_slots = blank(1)
        self.rule_tokens = blank(1)
        self.rule_declared = blank(1)
        self.rule_span = blank(1)
        # Relations: distances between times, five numbers each; what they say about durations.
        self.relation_start = blank(1)
        self.relation_distance = blank(1)
        self.relation_duration = blank(1)
        # Prototypes of the built-in variables of tokens, and of the object of each class.
        self.state_prototype = NONE
        self.rejectable_prototype = NONE
        self.native_prototype = NONE
        self.duration_prototype = NONE
        self.instant_prototype = NONE
        self.time_prototype = NONE
        self.class_prototype = blank(1)
        # Objects and their members.
        self.object_count = 0
        self.object_class = blank(64)
        self.object_var0 = blank(64)
        self.object_constant = blank(64)
        self.object_head = blank(64)
        self.object_timeline = blank(64)
        self.first_object_head = 0
        self.member_names = 0
        self.member_at = blank(1)
        self.member_prototype = blank(1)
        self.name_prototype = blank(1)  # for a member of no known object
        # Prototypes whose domain is an interval.
        self.twins: dict[int, tuple[int, int]] = {}  # of open prototypes: a closed constant, how many values it has
        self.form = blank(256)
        self.form_lower = blank(256, "d")
        self.form_upper = blank(256, "d")
        # Global variables, and what every engine variable is.
        self.globals = blank(1)
        self.clock = NONE  # the global that reads "now or later" during execution: a guard does not wait for its value
        # Whether a search has run a `foreach` over a domain that was narrowed: nobody noted by whom.
        self.loops_read_choices = False
        self.variable_role = blank(256)
        self.variable_owner = blank(256)
        self.variable_name = blank(256)
        self.variable_guards = blank(256)
        self.proxy_index = blank(256)
        self.proxy_member = blank(256)
        # Variables that guards wait for, in the order in which a search made them so.
        self.awaited_count = 0
        self.awaited = blank(64)
        # Constraints that wake guards.
        self.guard_of = blank(256)
        # What is to be run: bodies (a stack), guards (a queue).
        self.stack_length = 0
        self.stack_at = blank(64)
        self.stack_end = blank(64)
        self.stack_scope = blank(64)
        self.stack_slot = blank(64)
        self.stack_value = blank(64)
        self.queue_length = 0
        self.queue = blank(64)
        self.operands_used = 0
        self.operands = blank(64)
        self.mark_engine = blank(64)
        self.mark_rows = blank(64)
        self.mark_uses = blank(64)
        self.mark_awaited = blank(64)
        self.mark_objects = blank(64)
        self.statement = 0
        self.self_object = NONE
        self.unions: list[tuple[tuple[int, int], ...]] = []
        self.services: _Services
        self.resources = Resources(engine)
        self.envelope: UseOrder

    def new_object(self, number: int, is_timeline: bool) -> int:
        """Take a row for an object of class `number`."""
        if self.object_count == len(self.object_class):
            lengthen(self, "object_class object_var0 object_constant object_head object_timeline")
        o = self.object_count
        self.object_count += 1
        self.object_class[o] = number
        self.object_var0[o] = NONE
        self.object_constant[o] = NONE
        self.object_head[o] = self.first_object_head + o
        self.object_timeline[o] = is_timeline
        return o

    def push(self, start: int, end: int, scope: int, slot: int, value: int) -> None:
        """Put a block on the stack; before it starts, `value` goes into variable slot `slot` (NONE: nothing does)."""
        top = self.stack_length
        if top == len(self.stack_at):
            lengthen(self, "stack_at stack_end stack_scope stack_slot stack_value")
        self.stack_at[top] = start
        self.stack_end[top] = end
        self.stack_scope[top] = scope
        self.stack_slot[top] = slot
        self.stack_value[top] = value
        self.stack_length = top + 1

    def enqueue(self, guard: int) -> None:
        """Have a guard looked at."""
        if self.queue_length == len(self.queue):
            lengthen(self, "queue")
        self.queue[self.queue_length] = guard
        self.queue_length += 1

    def gather_woken(self) -> None:
        """Have all guards looked at that the engine has woken."""
        engine = self.engine
        for i in range(engine.woken_count):
            self.enqueue(self.guard_of[engine.woken[i]])
        engine.clear_woken()

    def keep_queued(self, done: int) -> None:
        """Take the first `done` guards off the queue."""
        left = self.queue_length - done
        for i in range(left):
            self.queue[i] = self.queue[done + i]
        self.queue_length = left

    def add_operand(self, v: int) -> None:
        """Put a variable behind the collected operands."""
        if self.operands_used == len(self.operands):
            lengthen(self, "operands")
        self.operands[self.operands_used] = v
        self.operands_used += 1

    def note_watch(self, constraint: int, guard: int) -> None:
        """Remember which guard a constraint wakes."""
        if constraint >= len(self.guard_of):
            lengthen(self, "guard_of", need=constraint + 1)
        self.guard_of[constraint] = guard

    def note_form(self, prototype: int, lower: float, upper: float) -> None:
        """Remember that a prototype is an interval."""
        if prototype >= len(self.form):
            lengthen(self, "form form_lower form_upper", need=prototype + 1)
        self.form[prototype] = 1
        self.form_lower[prototype] = lower
        self.form_upper[prototype] = upper

    def await_variable(self, v: int) -> None:
        """Count a guard that waits for `v`."""
        self.variable_guards[v] += 1
        if self.rows.level:
            if self.awaited_count == len(self.awaited):
                lengthen(self, "awaited")
            self.awaited[self.awaited_count] = v
            self.awaited_count += 1

    def end_waiting(self, watch: int) -> None:
        """Count that a guard, or the follower of a merged token, waits no more for what `watch` listens to."""
        for v in self.engine.arguments(watch):
            self.variable_guards[v] -= 1

    def forget_awaited(self, count: int) -> None:
        """Go back to where a search had made `count` variables awaited."""
        while self.awaited_count > count:
            self.awaited_count -= 1
            self.variable_guards[self.awaited[self.awaited_count]] -= 1

    def reserve_variables(self, count: int) -> None:
        """Have rows for the first `count` variables of the engine: constants are variables that nobody notes."""
        if count > len(self.variable_role):
            names = "variable_role variable_owner variable_name variable_guards proxy_index proxy_member"
            lengthen(self, names, need=count)

    def note_variable(self, v: int, role: int, owner: int, name: int) -> None:
        """Remember what a variable of the engine is."""
        if v >= len(self.variable_role):
            self.reserve_variables(v + 1)
        self.variable_role[v] = role
        self.variable_owner[v] = owner
        self.variable_name[v] = name
        self.variable_guards[v] = 0
        self.proxy_index[v] = NONE
