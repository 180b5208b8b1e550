"""Lower declarations: classes with their constructors, predicates with the constraints of all levels, rules."""

from collections.abc import Iterator

from compiler import constants
from compiler.body import Body, Frame, Model
from compiler.expressions import value
from compiler.program import (
    FIRST_PARAMETER,
    ClassCode,
    ConstructorCode,
    Field,
    LocalVariable,
    MemberCode,
    ParameterCode,
    PredicateCode,
    RuleCode,
    SuperCode,
    TokenVariable,
)
from compiler.statements import assign, assign_to, constraint, given, link, statement
from nddl_lang.semantics.natives import SELF_ACTIVATING
from nddl_lang.semantics.schema import Class, Constructor, MemberReference, Predicate, Rule, Schema
from nddl_lang.syntax.nodes import (
    Assignment,
    BrokenStatement,
    CallConstraint,
    ExprConstraint,
    Instance,
    Relation,
    RuleStatement,
    SuperCall,
    VariableDecl,
)

_NATIVE = ("Timeline", *sorted(SELF_ACTIVATING))


# ---- classes ----


def class_code(class_: Class, model: Model) -> ClassCode:
    """A class with its inherited members and its own constructors."""
    ancestry = model.schema.ancestry(class_.name)
    members = tuple(
        MemberCode(member.name, constants.type_code(member.type), None)
        for name in reversed(ancestry)
        for member in model.schema.classes[name].members.values()
    )
    constructors = tuple(_constructor_code(constructor, class_, model) for constructor in class_.constructors)
    native = next((name for name in ancestry if name in _NATIVE), None)
    return ClassCode(class_.name, class_.base, members, constructors, native, class_.span)


def _constructor_code(constructor: Constructor, class_: Class, model: Model) -> ConstructorCode:
    """A constructor: `super` first, then members that the class initialises, then its own assignments."""
    body = Body(model, Frame())
    for parameter in constructor.parameters:
        body.frame.variables[parameter] = LocalVariable(body.frame.new_slot())
    statements = () if constructor.node is None else constructor.node.body
    calls = [node for node in statements if isinstance(node, SuperCall)]
    supers = [_super_code(call, body) for call in calls] or list(_implicit_super(class_, model, constructor))
    before, body.code = body.code, []
    assignments = [node for node in statements if isinstance(node, Assignment)]
    assigned = {name for node in assignments if (name := _own_member(node, model)) is not None}
    for member in class_.members.values():
        if member.initialiser is not None and member.name not in assigned:
            type_ = constants.type_code(member.type)
            assign_to(
                Field(None, (member.name,)), type_, member.initialiser, member.name, member.initialiser.span, body
            )
    for node in assignments:
        target = body.operand(model.tables.references[node.target])
        assign(node, target, constants.type_code(model.type_of(node.target)), body)
    parameters = tuple(constants.type_code(parameter.type) for parameter in constructor.parameters)
    return ConstructorCode(parameters, (*before, *supers, *body.code), constructor.span, body.frame.slots)


def _super_code(call: SuperCall, body: Body) -> SuperCode:
    chosen = body.model.tables.constructors[call].constructor
    arguments = tuple(value(argument, body) for argument in call.arguments)
    return SuperCode(chosen.class_name, _number(chosen, body.model.schema), arguments, call.span)


def _implicit_super(class_: Class, model: Model, constructor: Constructor) -> Iterator[SuperCode]:
    span = constructor.span or class_.span
    if class_.is_native or class_.base is None or span is None:
        return
    for candidate in model.schema.classes[class_.base].constructors:
        if not candidate.parameters:
            yield SuperCode(class_.base, _number(candidate, model.schema), (), span)
            return


def _number(constructor: Constructor, schema: Schema) -> int:
    return schema.classes[constructor.class_name].constructors.index(constructor)


def _own_member(node: Assignment, model: Model) -> str | None:
    match model.tables.references.get(node.target):
        case MemberReference(base=None, members=(member,)):
            return member.name
        case _:
            return None


# ---- predicates ----


def predicate_code(
    predicate: Predicate, rules: tuple[int, ...], effects: tuple[str, ...], model: Model
) -> PredicateCode:
    """A predicate as its class has it."""
    frame = Frame(predicates={0: predicate})
    body = Body(model, frame)
    parameters: list[ParameterCode] = []
    for position, parameter in enumerate(predicate.parameters):
        type_ = constants.type_code(parameter.type)
        domain, copy_of = given(parameter.initialiser, type_, body)
        for target, leaves in link(TokenVariable(0, FIRST_PARAMETER + position), parameter.initialiser, body).items():
            assert isinstance(target, TokenVariable)
            model.parameters[predicate.full_name, target.variable] = leaves
        parameters.append(ParameterCode(parameter.name, type_, domain, copy_of, parameter.span))
    for node in predicate.nodes:
        for line in node.body:
            match line:
                case CallConstraint() | ExprConstraint():
                    constraint(line, body)
                case Assignment():
                    target = body.operand(model.tables.references[line.target])
                    assign(line, target, constants.type_code(model.type_of(line.target)), body)
                case VariableDecl() | BrokenStatement():
                    pass
    return PredicateCode(
        predicate.full_name,
        predicate.class_name,
        tuple(parameters),
        tuple(body.code),
        frame.slots,
        frame.tokens,
        predicate.is_action,
        predicate.is_event,
        effects,
        rules,
        predicate.span,
    )


def all_predicates(schema: Schema) -> Iterator[Predicate]:
    """Every predicate of every class that has it, declared or inherited."""
    for class_ in schema.classes.values():
        yield from class_.inherited.values()
        yield from class_.predicates.values()


def firing_rules(predicate: Predicate, schema: Schema) -> tuple[int, ...]:
    """The numbers of the rules that fire on a token of `predicate`: the ancestors' first, else as declared."""
    found: list[int] = []
    for class_name in reversed(schema.ancestry(predicate.class_name)):
        for number, rule in enumerate(schema.rules):
            if rule.predicate.name == predicate.name and rule.predicate.class_name == class_name:
                found.append(number)
    return tuple(found)


# ---- rules ----


def rule_code(rule: Rule, declared_at: int, model: Model) -> RuleCode:
    """A rule with its flattened slots."""
    frame = Frame(predicates={0: rule.predicate})
    body = Body(model, frame)
    for node in rule.node.body:
        statement(node, body)
    return RuleCode(rule.predicate.full_name, tuple(body.code), frame.slots, frame.tokens, rule.node.span, declared_at)


def effects_of(predicate: Predicate, rules: tuple[int, ...], model: Model) -> tuple[str, ...]:
    """What every run of the rules of an action yields: full predicate names in order of appearance, one per effect."""
    if not predicate.is_action:
        return ()
    targets = model.tables.targets
    instances = (made for number in rules for made in _certain_instances(model.schema.rules[number].node.body))
    return tuple(targets[instance].predicate.full_name for instance in instances if instance.role == "effect")


def _certain_instances(statements: tuple[RuleStatement, ...]) -> Iterator[Instance]:
    """What stands behind no guard and in no loop: like EUROPA, no action is chosen for what it may not bring about."""
    for node in statements:
        if isinstance(node, Relation):
            yield from node.created
