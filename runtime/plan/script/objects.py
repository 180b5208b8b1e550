"""Objects: members, names, constructors; open variables of their classes grow with them."""

from collections.abc import Generator, Iterator
from dataclasses import dataclass

from compiler.program import Assign, ClassCode, ConstructorCode, NewObject, Program, SuperCode, TypeCode
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Span
from runtime.constraints.domains.tags import KIND_FLOAT, KIND_OBJECT
from runtime.plan.rules.rule_bytecode import RuleBytecode
from runtime.plan.rules.rule_interpreter import run
from runtime.plan.script.assignments import copy_current, overlap
from runtime.plan.script.codes import CLOSED_CLASS, ENDLESS_OBJECT, OUTSIDE_DOMAIN
from runtime.plan.script.natives import DEFAULTS, FILLED, LIMITS_OF
from runtime.plan.store.domain_texts import base_text
from runtime.plan.store.links import new_head
from runtime.plan.store.operands import operand
from runtime.plan.store.plan import Plan
from runtime.plan.store.prototypes import Prototypes
from runtime.plan.store.scopes import make_variable
from runtime.plan.tags import INITIAL, MINIMUM, NONE, ROLE_INTERNAL, ROLE_MEMBER, SCOPE_SCRIPT

OperandCode = tuple[int, int]  # an operand in bytecode


@dataclass(frozen=True, eq=False, slots=True)
class New:
    """A `new` with compiled arguments."""

    class_number: int
    constructor: int
    arguments: tuple["OperandCode | New", ...]
    name: str | None
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class Super:
    """A `super(...)` with compiled arguments."""

    class_number: int
    constructor: int
    arguments: tuple[OperandCode, ...]
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class Fill:
    """An assignment to a member."""

    target: OperandCode
    value: "OperandCode | New"
    name: str
    span: Span


Step = Super | Fill | int  # of a constructor: one of the above or the number of a block
_Making = Generator["_Making", int | Diagnostic, int | Diagnostic]  # yields what must be made first


@dataclass(frozen=True, eq=False, slots=True)
class PreparedConstructor:
    """A constructor ready to run."""

    parameters: tuple[int, ...]  # prototypes
    steps: tuple[Step, ...]
    slots: int


class Objects:
    """All objects by number and name."""

    def __init__(self, plan: Plan, program: Program, prototypes: Prototypes, code: RuleBytecode) -> None:
        self.plan = plan
        self.program = program
        self.prototypes = prototypes
        self.code = code
        self.names: list[str] = []
        self.numbers: dict[str, int] = {}
        self.fault: Diagnostic | None = None
        self.unfinished: set[tuple[int, int]] = set()  # the classes and constructors that are under way
        self.constructors = [[self.prepare(each) for each in class_.constructors] for class_ in program.classes]
        self.in_rules = [self.prepare_new(new) for new in code.objects]

    # ---- preparing ----

    def prepare(self, constructor: ConstructorCode) -> PreparedConstructor:
        """Compile a constructor."""
        steps: list[Step] = []
        for step in constructor.body:
            match step:
                case SuperCode(class_name=base, constructor=chosen, arguments=operands, span=span):
                    passed = tuple(self.code.operand(each) for each in operands)
                    steps.append(Super(self.prototypes.class_numbers[base], chosen, passed, span))
                case Assign():
                    steps.append(self.prepare_fill(step))
                case _:
                    steps.append(self.code.body((step,)))
        parameters = tuple(self.prototypes.of(_bare(type_), None) for type_ in constructor.parameters)
        return PreparedConstructor(parameters, tuple(steps), max(constructor.slots, len(parameters)))

    def prepare_fill(self, step: Assign) -> Fill:
        """Compile an assignment."""
        value: OperandCode | New
        if isinstance(step.value, NewObject):
            value = self.prepare_new(step.value)
        else:
            value = self.code.given(step.domain, step.value)
        return Fill(self.code.operand(step.target), value, step.name, step.span)

    def prepare_new(self, new: NewObject) -> New:
        """Compile a `new`, the ones among its arguments included."""
        arguments = tuple(
            self.prepare_new(each) if isinstance(each, NewObject) else self.code.operand(each) for each in new.arguments
        )
        return New(self.prototypes.class_numbers[new.class_name], new.constructor, arguments, new.name, new.span)

    # ---- making ----

    def _allocate(self, number: int, name: str | None) -> int:
        """Make an object with unrestricted members."""
        plan, engine = self.plan, self.plan.engine
        class_ = self.program.classes[number]
        o = plan.new_object(number, class_.native == "Timeline")
        new_head(plan.rows, plan.object_head[o])
        label = self._unique(name, o)
        self.names.append(label)
        self.numbers[label] = o
        if len(class_.members) > 1:
            engine.reserve(len(class_.members))
        for k, member in enumerate(class_.members):
            v = make_variable(plan, self.prototypes.of(member.type, member.domain), ROLE_MEMBER, o, k)
            if k == 0:
                plan.object_var0[o] = v
        constant = engine.new_constant(KIND_OBJECT, o, o)
        plan.object_constant[o] = constant
        plan.note_variable(constant, ROLE_INTERNAL, NONE, NONE)
        if class_.native in LIMITS_OF:
            self._make_resource(o, class_)
        for ancestor in self.prototypes.ancestry(number):
            self.prototypes.objects[ancestor].append(o)
            if plan.rows.level == 0:
                for v in self.prototypes.still_open(ancestor):
                    engine.add_value(v, o)
        return o

    def truncate(self, count: int) -> None:
        """Forget the objects that a search has made."""
        while len(self.names) > count:
            del self.numbers[self.names.pop()]
            o = len(self.names)
            for ancestor in self.prototypes.ancestry(self.plan.object_class[o]):
                self.prototypes.objects[ancestor].remove(o)
        self.plan.object_count = count

    def _unique(self, name: str | None, o: int) -> str:
        """A name that no other object has."""
        if name is None:
            return f"__Object_{o}"
        return name if name not in self.numbers else f"{name}_{o}"

    def make_in_rule(self, scope: int, number: int) -> int:
        """Carry out a `new` of a rule; the variable that holds the object. A fault is left in `fault`.

        Where the class is closed, any object of it is given, so that the rule can be carried out to its end.
        """
        made = self.make(self.in_rules[number], scope, None)
        if isinstance(made, Diagnostic):
            self.fault = self.fault or made
            return self.plan.class_prototype[self.in_rules[number].class_number]
        return self.plan.object_constant[made]

    def make(self, new: New, scope: int, parent: str | None) -> int | Diagnostic:
        """Carry out a `new`; the object, or what is wrong.

        A stack of its own holds the objects around it: parts of parts may be deeper than Python's stack.
        """
        around: list[_Making] = [self._making(new, scope, parent)]
        made: int | Diagnostic | None = None
        while around:
            try:
                inner = next(around[-1]) if made is None else around[-1].send(made)
            except StopIteration as done:
                around.pop()
                made = done.value
            else:
                around.append(inner)
                made = None
        assert made is not None
        return made

    def _making(self, new: New, scope: int, parent: str | None) -> "_Making":
        """The making of an object, and of those that it is given or has as parts, each when its turn comes."""
        plan = self.plan
        span = self.code.span(new.span)
        arguments = []
        for each in new.arguments:
            if isinstance(each, New):
                inner = yield self._making(each, scope, parent)
                if isinstance(inner, Diagnostic):
                    return inner
                arguments.append(plan.object_constant[inner])
            else:
                arguments.append(operand(plan, scope, each[0], each[1], span))
        if self.prototypes.is_closed[new.class_number]:
            return CLOSED_CLASS.at(new.span, name=self.program.classes[new.class_number].name)
        o = self._allocate(new.class_number, new.name if parent is None or new.name is None else f"{parent}.{new.name}")
        kind = (new.class_number, new.constructor)
        if kind in self.unfinished:  # constructors have no branches: this one comes here again and again
            return ENDLESS_OBJECT.at(new.span, name=self.program.classes[new.class_number].name)
        self.unfinished.add(kind)
        fault = yield from self._constructing(new.class_number, new.constructor, o, arguments)
        self.unfinished.remove(kind)
        return fault or o

    def _constructing(
        self, number: int, chosen: int, o: int, arguments: list[int]
    ) -> "Generator[_Making, int | Diagnostic, Diagnostic | None]":
        """Run a constructor of class `number` on object `o`; arguments pass their current domains.

        A stack of its own holds those of the ancestors: a chain of classes may be longer than Python's stack.
        """
        plan = self.plan
        outer = plan.self_object
        running = [self._enter(number, chosen, o, arguments)]
        fault: Diagnostic | None = None
        while running:
            scope, steps = running[-1]
            plan.self_object = o
            step = None if fault is not None else next(steps, None)
            match step:
                case None:
                    running.pop()
                    if scope != NONE and plan.rows.level == 0:
                        plan.rows.release_scope(scope)
                case Super(class_number=base, constructor=of_base, arguments=codes, span=span):
                    passed = [operand(plan, scope, kind, value, self.code.span(span)) for kind, value in codes]
                    running.append(self._enter(base, of_base, o, passed))
                case Fill():
                    part: int | Diagnostic | None = None
                    if isinstance(step.value, New):
                        part = yield self._making(step.value, scope, self.names[o])
                    fault = part if isinstance(part, Diagnostic) else self._fill(step, scope, o, part)
                case _:
                    plan.push(plan.block_start[step], plan.block_end[step], scope, NONE, NONE)
                    run(plan)
        plan.self_object = outer
        return fault

    def _enter(self, number: int, chosen: int, o: int, arguments: list[int]) -> tuple[int, Iterator[Step]]:
        """The scope of a constructor with its parameters, and its steps; a native one is carried out at once."""
        plan = self.plan
        name = self.program.classes[number].name
        if name in DEFAULTS:
            self._fill_native(name, o, arguments)
            return NONE, iter(())
        constructor = self.constructors[number][chosen]
        scope = plan.rows.new_scope(SCOPE_SCRIPT, NONE, NONE, NONE, constructor.slots, constructor.slots)
        for slot, (prototype, argument) in enumerate(zip(constructor.parameters, arguments, strict=True)):
            plan.rows.set_slot(scope, slot, copy_current(plan, prototype, argument))
        return scope, iter(constructor.steps)

    def fill(self, step: Fill, scope: int) -> Diagnostic | None:
        """Carry out an assignment of the script."""
        made = self.make(step.value, scope, None) if isinstance(step.value, New) else None
        return made if isinstance(made, Diagnostic) else self._fill(step, scope, None, made)

    def _fill(self, step: Fill, scope: int, o: int | None, made: int | None) -> Diagnostic | None:
        """Carry out an assignment; `o` is the object under construction, `made` the new one that is assigned."""
        plan = self.plan
        span = self.code.span(step.span)
        target = operand(plan, scope, *step.target, span)
        if isinstance(step.value, New):
            assert made is not None
            if o is not None:
                plan.engine.set_parent(made, o)
            source = plan.object_constant[made]
        else:
            source = operand(plan, scope, *step.value, span)
        return self.restrict(target, source, step.name, step.span)

    def restrict(self, v: int, source: int, name: str, span: Span) -> Diagnostic | None:
        """Intersect the base domain of `v` with that of `source`; what is wrong if they have no value in common."""
        engine = self.plan.engine
        if not overlap(engine, v, source):
            return OUTSIDE_DOMAIN.at(span, value=base_text(self.prototypes, engine, source, self.names), name=name)
        engine.restrict_base_to(v, source, self.code.span(span), NONE)
        return None

    def _fill_native(self, name: str, o: int, arguments: list[int]) -> None:
        """Give the members of a resource their values."""
        plan, engine = self.plan, self.plan.engine
        members = self.program.classes[plan.object_class[o]].members
        where = {member.name: plan.object_var0[o] + k for k, member in enumerate(members)}
        filled = FILLED[name, len(arguments)]
        for member, argument in zip(filled, arguments, strict=True):
            engine.restrict_base(where[member], engine.lower(argument), engine.upper(argument), NONE, NONE)
        for member, value in DEFAULTS[name].items():
            if member not in filled:
                engine.restrict_base(where[member], value, value, NONE, NONE)

    def _make_resource(self, o: int, class_: ClassCode) -> None:
        """Have the levels of a resource watched."""
        where = {member.name: self.plan.object_var0[o] + k for k, member in enumerate(class_.members)}
        assert class_.native is not None
        limits = [where.get(name, NONE) for name in LIMITS_OF[class_.native]]
        if class_.native == "Unary":
            limits[INITIAL] = self.plan.engine.new_constant(KIND_FLOAT, 1.0, 1.0)
            limits[MINIMUM] = self.plan.engine.new_constant(KIND_FLOAT, 0.0, 0.0)
        self.plan.resources.add_resource(o, limits, where.get("profileType", NONE))

    def close(self, number: int) -> None:
        """End the making of objects of a class and of its subclasses."""
        for other in sorted(self.prototypes.heirs(number)):
            if not self.prototypes.is_closed[other]:
                self.prototypes.is_closed[other] = True
                for v in self.prototypes.still_open(other):
                    self.plan.engine.close(v)
                self.prototypes.openings[other] = []


def _bare(type_: TypeCode) -> TypeCode:
    """A type without the restriction of its typedef: arguments are checked by the front end."""
    return TypeCode(type_.kind, type_.type_name, None)
