"""Tables of a plan, filled from a program: predicates, rules, relations, members, bytecode, prototypes."""

from array import array
from collections.abc import Iterable
from math import inf

from compiler.program import DomainConstant, Program, TypeCode
from nddl_lang.semantics.natives import SELF_ACTIVATING
from nddl_lang.semantics.relations import RELATIONS, DurationRule, Point
from runtime.constraints.domains.tags import KIND_INT
from runtime.plan.rules.rule_bytecode import RuleBytecode
from runtime.plan.store.links import new_head
from runtime.plan.store.names import Names
from runtime.plan.store.plan import Plan
from runtime.plan.store.prototypes import STATES, Prototypes
from runtime.plan.tags import (
    DURATION_EQUAL,
    DURATION_FREE,
    DURATION_ORIGIN_SHORTER,
    DURATION_TARGET_SHORTER,
    END,
    FLAG_ACTION,
    FLAG_EVENT,
    FLAG_NATIVE,
    HEAD_PREDICATE,
    NONE,
    RESOURCE_CONSUMES,
    RESOURCE_HOLDS,
    RESOURCE_PRODUCES,
    START,
)

_DURATIONS = {
    DurationRule.NONE: DURATION_FREE,
    DurationRule.EQUAL: DURATION_EQUAL,
    DurationRule.TARGET_SHORTER: DURATION_TARGET_SHORTER,
    DurationRule.ORIGIN_SHORTER: DURATION_ORIGIN_SHORTER,
}
_POINTS = {
    Point.ORIGIN_START: (0, START),
    Point.ORIGIN_END: (0, END),
    Point.TARGET_START: (1, START),
    Point.TARGET_END: (1, END),
}


def _packed(numbers: Iterable[int]) -> "array[int]":
    """Numbers as an array that is never empty."""
    return array("q", [*numbers, 0])


def load_members(plan: Plan, program: Program, prototypes: Prototypes, names: Names) -> None:
    """Where each class has its members; their names take the lowest numbers."""
    for class_ in program.classes:
        for member in class_.members:
            names.number(member.name)
    width = len(names.texts)
    plan.member_names = width
    at = array("q", [NONE]) * (width * len(program.classes) + 1)
    typed = array("q", [NONE]) * (width * len(program.classes) + 1)
    prototype = array("q", [NONE]) * (width + 1)
    for number, class_ in enumerate(program.classes):
        for k, member in enumerate(class_.members):
            name = names.number(member.name)
            at[number * width + name] = k
            typed[number * width + name] = prototypes.of(member.type, member.domain)
            if prototype[name] < 0:
                prototype[name] = typed[number * width + name]
    plan.member_at = at
    plan.member_prototype = typed
    plan.name_prototype = prototype


def load_prototypes(plan: Plan, program: Program, prototypes: Prototypes) -> None:
    """Prototypes of the built-in variables of tokens, and of the objects of each class; room for global variables."""
    plan.globals = array("q", [NONE]) * (len(program.globals) + 1)
    plan.state_prototype = _states(prototypes, "ACTIVE", "MERGED")
    plan.rejectable_prototype = _states(prototypes, "ACTIVE", "MERGED", "REJECTED")
    plan.native_prototype = _states(prototypes, "ACTIVE")
    plan.duration_prototype = plan.engine.new_interval(KIND_INT, 1, inf, NONE, NONE)
    plan.instant_prototype = plan.engine.new_interval(KIND_INT, 0, 0, NONE, NONE)
    plan.time_prototype = plan.engine.new_interval(KIND_INT, -inf, inf, NONE, NONE)
    classes = [prototypes.of(TypeCode("object", class_.name, None), None) for class_ in program.classes]
    plan.class_prototype = _packed(classes)


def _states(prototypes: Prototypes, *names: str) -> int:
    """The prototype of a token's state."""
    return prototypes.of_domain(DomainConstant("symbol", STATES, None, names))


def load_relations(plan: Plan) -> None:
    """Temporal relations as numbers."""
    starts: list[int] = []
    cells: list[int] = []
    durations: list[int] = []
    for row in RELATIONS.values():
        starts.append(len(cells))
        for distance in row.distances:
            cells += [*_POINTS[distance.earlier], *_POINTS[distance.later], distance.lower, distance.upper]
        durations.append(_DURATIONS[row.duration])
    plan.relation_start = _packed([*starts, len(cells)])
    plan.relation_distance = _packed(cells)
    plan.relation_duration = _packed(durations)


def load_predicates(plan: Plan, program: Program, prototypes: Prototypes, code: RuleBytecode) -> None:
    """Predicates with parameters, bodies and the rules that fire on them."""
    numbers = prototypes.class_numbers
    flags: list[int] = []
    timeline: list[int] = []
    resource: list[int] = []
    starts: list[int] = []
    rules: list[int] = []
    first_rule: list[int] = []
    parameters: list[int] = []
    copies: list[tuple[int, int]] = []
    timelines = prototypes.with_ancestors(c for c, each in enumerate(program.classes) if each.native == "Timeline")
    for predicate in program.predicates:
        number = numbers[predicate.class_name]
        native = program.classes[number].native
        is_resource = native in SELF_ACTIVATING
        flag = FLAG_ACTION if predicate.is_action else 0
        flag |= FLAG_EVENT if predicate.is_event else 0
        flags.append(flag | (FLAG_NATIVE if is_resource else 0))
        timeline.append(int(number in timelines))
        kind = RESOURCE_HOLDS
        if predicate.is_event:
            kind = RESOURCE_PRODUCES if predicate.name.endswith(".produce") else RESOURCE_CONSUMES
        resource.append(kind if is_resource else 0)
        starts.append(len(parameters))
        for parameter in predicate.parameters:
            parameters.append(prototypes.of(parameter.type, parameter.domain))
            copies.append(code.optional(parameter.copy_of))
        first_rule.append(len(rules))
        rules += predicate.rules
    plan.predicate_class = _packed(numbers[predicate.class_name] for predicate in program.predicates)
    plan.predicate_flags = _packed(flags)
    plan.predicate_timeline = _packed(timeline)
    plan.predicate_resource = _packed(resource)
    plan.parameter_start = _packed(starts)
    plan.parameter_count = _packed(len(predicate.parameters) for predicate in program.predicates)
    plan.parameter_prototype = _packed(parameters)
    plan.parameter_copy_kind = _packed(kind for kind, _ in copies)
    plan.parameter_copy_value = _packed(value for _, value in copies)
    plan.body_block = _packed(code.body(predicate.body) for predicate in program.predicates)
    plan.body_slots = _packed(predicate.body_slots for predicate in program.predicates)
    plan.body_tokens = _packed(max(predicate.body_tokens, 1) for predicate in program.predicates)
    plan.first_rule = _packed([*first_rule, len(rules)])
    plan.rule_number = _packed(rules)
    plan.rule_block = _packed(code.body(rule.body) for rule in program.rules)
    plan.rule_slots = _packed(rule.slots for rule in program.rules)
    plan.rule_tokens = _packed(max(rule.tokens, 1) for rule in program.rules)
    plan.rule_declared = _packed(rule.declared_at for rule in program.rules)
    plan.rule_span = _packed(code.span(rule.span) for rule in program.rules)
    _load_kinds(plan, program, prototypes)
    for head in range(HEAD_PREDICATE + len(program.predicates)):
        new_head(plan.rows, head)
    plan.first_object_head = HEAD_PREDICATE + len(program.predicates)


def _load_kinds(plan: Plan, program: Program, prototypes: Prototypes) -> None:
    """How predicates of one name are related through their classes."""
    suffixes: dict[str, int] = {}
    suffix = [suffixes.setdefault(each.name.rpartition(".")[2], len(suffixes)) for each in program.predicates]
    plan.suffixes = len(suffixes)
    at = array("q", [NONE]) * (len(suffixes) * len(program.classes) + 1)
    for number, predicate in enumerate(program.predicates):
        at[prototypes.class_numbers[predicate.class_name] * plan.suffixes + suffix[number]] = number
    parents: list[int] = []
    roots: list[int] = []
    for number, predicate in enumerate(program.predicates):
        line = [number]
        for class_ in prototypes.ancestry(prototypes.class_numbers[predicate.class_name])[1:]:
            above = at[class_ * plan.suffixes + suffix[number]]
            if above < 0:
                break
            line.append(above)
        parents.append(line[1] if len(line) > 1 else NONE)
        roots.append(line[-1])
    plan.predicate_suffix = _packed(suffix)
    plan.predicate_at = at
    plan.predicate_parent = _packed(parents)
    plan.predicate_root = _packed(roots)


def load_code(plan: Plan, code: RuleBytecode) -> None:
    """Hand the bytecode over."""
    plan.code = _packed(code.cells)
    plan.block_start = _packed(code.block_start)
    plan.block_end = _packed(code.block_end)
    plan.field_kind = _packed(kind for kind, _ in code.field_base)
    plan.field_value = _packed(value for _, value in code.field_base)
    starts: list[int] = []
    cells: list[int] = []
    for members in code.field_members:
        starts.append(len(cells))
        cells += members
    plan.field_start = _packed(starts)
    plan.field_length = _packed(len(members) for members in code.field_members)
    plan.field_names = _packed(cells)
    plan.unions = code.unions
