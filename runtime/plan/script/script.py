"""Script: each statement prepared once, executed and propagated; the first that is not allowed ends it."""

from collections.abc import Callable
from typing import assert_never

from compiler.program import (
    Assign,
    Call,
    Child,
    Guard,
    Instruction,
    NewGlobal,
    NewObject,
    NewToken,
    NewVariable,
    ObjectLoop,
    Post,
    Relate,
    Sample,
)
from nddl_lang.text.diagnostic import Diagnostic
from runtime.plan.lifecycle import fire
from runtime.plan.script.calls import Calls
from runtime.plan.script.codes import NO_OBJECT
from runtime.plan.script.objects import Objects
from runtime.plan.store.operands import operand
from runtime.plan.store.scopes import make_variable
from runtime.plan.tags import FLAG_FACT, FLAG_GOAL, FLAG_REJECTABLE, NONE, ROLE_GLOBAL, SCOPE_SCRIPT
from runtime.plan.tokens.retraction import withdraw_refusals
from runtime.plan.tokens.tokens import make_token

_KINDS = {"goal": FLAG_GOAL, "fact": FLAG_FACT, "rejectable": FLAG_REJECTABLE}
Action = Callable[[], Diagnostic | None]


class Script:
    """The statements of a program, ready to run."""

    def __init__(self, predicates: dict[str, int], objects: Objects) -> None:
        self.plan = objects.plan
        self.program = objects.program
        self.prototypes = objects.prototypes
        self.code = objects.code
        self.predicates = predicates
        self.objects = objects
        self.labels: dict[int, str] = {}
        slots = self.program.script_slots
        size = slots + self.program.script_tokens
        self.scope = self.plan.rows.new_scope(SCOPE_SCRIPT, NONE, NONE, NONE, slots, size)
        self.calls = Calls(objects, self.labels, self.scope)
        self.actions: list[Action] = [self.prepare(instruction) for instruction in self.program.script]
        self.next = 0

    def run(self) -> Diagnostic | None:
        """Execute what is left of the script; what stopped it, if anything did."""
        while self.next < len(self.actions):
            self.plan.statement = self.next
            action = self.actions[self.next]
            self.next += 1
            withdraw_refusals(self.plan)
            fault = action()
            if fault is None:
                fire(self.plan)
                fault = self.objects.fault
            if fault is not None:
                self.next = len(self.actions)
                return fault
            self.plan.engine.commit()
        self.plan.statement = len(self.actions)
        return None

    def prepare(self, instruction: Instruction) -> Action:
        """What a statement does when its turn comes."""
        match instruction:
            case NewGlobal():
                return self._prepare_global(instruction)
            case NewObject():
                return self._prepare_object(instruction)
            case Assign():
                fill = self.objects.prepare_fill(instruction)
                return lambda: self.objects.fill(fill, self.scope)
            case NewToken():
                return self._prepare_token(instruction)
            case Call():
                return self.calls.prepare(instruction)
            case Post() | Sample() | Relate() | NewVariable() | Guard() | ObjectLoop() | Child():
                block = self.code.body((instruction,))
                return lambda: self.push(block)
            case _:
                assert_never(instruction)

    def push(self, block: int) -> Diagnostic | None:
        """Have a block run by the next `fire`."""
        self.plan.push(self.plan.block_start[block], self.plan.block_end[block], self.scope, NONE, NONE)
        return None

    def _prepare_global(self, new: NewGlobal) -> Action:
        """A global variable with its base domain."""
        prototype = self.prototypes.of(new.type, new.domain)
        kind, value = self.code.optional(new.copy_of)
        span = self.code.span(new.span)

        def act() -> Diagnostic | None:
            plan = self.plan
            v = make_variable(plan, prototype, ROLE_GLOBAL, new.index, new.index)
            plan.globals[new.index] = v
            if new.copy_of is not None:
                source = operand(plan, self.scope, kind, value, span)
                return self.objects.restrict(v, source, new.name, new.span)
            return None

        return act

    def _prepare_object(self, new: NewObject) -> Action:
        """An object, and the global variable that holds it."""
        ready = self.objects.prepare_new(new)

        def act() -> Diagnostic | None:
            plan = self.plan
            index = new.global_index
            o = self.objects.make(ready, self.scope, None)
            if isinstance(o, Diagnostic):
                return o
            if index is not None:
                plan.globals[index] = make_variable(plan, plan.object_constant[o], ROLE_GLOBAL, index, index)
            return None

        return act

    def _prepare_token(self, new: NewToken) -> Action:
        """A goal, a fact or a rejectable token."""
        predicate = self.predicates[new.predicate]
        kind, value = (NONE, NONE) if isinstance(new.object, str) else self.code.operand(new.object)
        span = self.code.span(new.span)
        class_name = self.program.predicates[predicate].class_name
        number = self.prototypes.class_numbers[class_name]

        def act() -> Diagnostic | None:
            plan = self.plan
            if not self.prototypes.objects[number]:
                return NO_OBJECT.at(new.span, name=class_name)
            given = NONE if kind < 0 else operand(plan, self.scope, kind, value, span)
            t = make_token(plan, predicate, _KINDS[new.kind], NONE, NONE, given, span)
            if new.label is not None:
                self.labels[t] = new.label
            plan.rows.set_slot(self.scope, self.program.script_slots + new.slot, t)
            return None

        return act
