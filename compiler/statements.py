"""Lower the statements that rules, predicate bodies and the script share: declarations, constraints, relations."""

from typing import assert_never

from compiler import constants
from compiler.body import Body
from compiler.expressions import SAMPLED, define, enforce, is_compound, sample, union, value
from compiler.program import (
    Assign,
    Child,
    Constant,
    DomainConstant,
    Guard,
    Instruction,
    LocalVariable,
    NewObject,
    NewVariable,
    ObjectLoop,
    Operand,
    Post,
    Relate,
    TypeCode,
)
from nddl_lang.semantics.schema import Kind, TokenVariableReference, Variable
from nddl_lang.syntax import nodes
from nddl_lang.syntax.nodes import (
    BrokenStatement,
    CallConstraint,
    CallExpr,
    Declarator,
    Expr,
    ExprConstraint,
    IfStatement,
    Instance,
    IntervalExpr,
    NewExpr,
    PathExpr,
    Relation,
    RuleStatement,
    SetExpr,
    VariableDecl,
)
from nddl_lang.text.source import Span

_USES = "uses"
_CHARGED = ((1, Kind.FLOAT), (2, Kind.INT), (3, Kind.INT))  # quantity, start, end


def statement(node: RuleStatement, body: Body) -> None:
    """Append the instructions of one statement of a rule."""
    match node:
        case VariableDecl(declarators=declarators):
            for declarator in declarators:
                _local(declarator, body)
        case CallConstraint() | ExprConstraint():
            constraint(node, body)
        case Relation():
            _relation(node, body)
        case IfStatement():
            _guard(node, body)
        case nodes.Foreach():
            _foreach(node, body)
        case BrokenStatement():
            raise AssertionError("only a model without errors is compiled")
        case _:
            assert_never(node)


# ---- constraints ----


def constraint(node: CallConstraint | ExprConstraint, body: Body) -> None:
    """Append a constraint in call form or infix form."""
    message = None if node.message is None else node.message.value
    match node:
        case CallConstraint(name=name) if name.name == SAMPLED:
            sample(value(node.arguments[0], body), node, body)
        case CallConstraint(name=name, arguments=arguments, span=span):
            operands = tuple(value(argument, body) for argument in arguments)
            row = body.model.callables.constraints[name.name]
            if row.name == _USES:
                operands = _charge(node, operands, message, body)
            body.emit(Post(row.alias_of or row.name, operands, message, span))
        case ExprConstraint(expression=expression):
            enforce(expression, message, body)
        case _:
            assert_never(node)


def _charge(
    node: CallConstraint, operands: tuple[Operand, ...], message: str | None, body: Body
) -> tuple[Operand, ...]:
    """The operands of `uses` with a real quantity and whole times: a number of the other type is equated with one."""
    charged = list(operands)
    for index, kind in _CHARGED:
        argument = node.arguments[index]
        type_ = constants.basic(kind)
        if (domain := body.model.constant(argument)) is not None and kind is Kind.FLOAT:
            charged[index] = Constant(constants.converted(domain, type_))
        elif body.model.type_of(argument).kind is not kind:
            charged[index] = body.implicit(type_, node.span)
            body.emit(Post("eq", (charged[index], operands[index]), message, node.span))
    return tuple(charged)


# ---- variables ----


def _local(declarator: Declarator, body: Body) -> None:
    """Append the declaration of a rule's local variable."""
    variable = body.model.tables.locals[declarator]
    type_ = constants.type_code(variable.type)
    initialiser = declarator.initialiser
    domain, copy_of = given(initialiser, type_, body)
    slot = body.frame.new_slot()
    target = LocalVariable(slot)
    if isinstance(initialiser, NewExpr):
        body.emit(new_object(initialiser, variable.name, body, slot=slot, type_=type_))
    else:
        body.emit(NewVariable(slot, variable.name, type_, domain, copy_of, declarator.span))
        body.frame.sources |= link(target, initialiser, body)
    body.frame.variables[variable] = target


def given(initialiser: Expr | None, type_: TypeCode, body: Body) -> tuple[DomainConstant | None, Operand | None]:
    """What an initialiser says at once: a domain, or the variable whose base domain is copied."""
    match initialiser:
        case None:
            return None, None
        case _ if (domain := body.model.constant(initialiser)) is not None:
            return constants.converted(domain, type_), None
        case PathExpr():
            return None, body.operand(body.model.tables.references[initialiser])
        case SetExpr(items=items):
            return None, union(items, body)
        case _:
            return None, None


def link(target: Operand, initialiser: Expr | None, body: Body) -> dict[Operand, tuple[Operand, ...]]:
    """Tie `target` to an initialiser that is an expression; the variables that decide it, if there is one."""
    if initialiser is None or not (is_compound(initialiser, body) or isinstance(initialiser, CallExpr)):
        return {}
    definition = body.block()
    definition.leaves = []
    if isinstance(initialiser, CallExpr) and not is_compound(initialiser, body):
        sample(target, initialiser, definition)
    else:
        define(initialiser, target, None, definition)
    body.code += definition.code
    return {target: tuple(definition.leaves)} if definition.leaves else {}


def assign(node: nodes.Assignment, target: Operand, type_: TypeCode, body: Body) -> None:
    """Append `target = value;`."""
    assign_to(target, type_, node.value, path_name(node.target), node.span, body)


def path_name(path: PathExpr) -> str:
    """The name of what a path denotes, seen from its owner."""
    return ".".join(part.name for part in path.parts if part.name != "this")


def assign_to(target: Operand, type_: TypeCode, given_value: Expr, name: str, span: Span, body: Body) -> None:
    """Append the assignment of a value to `target`; a new object is called `name`."""
    if isinstance(given_value, NewExpr):
        body.emit(Assign(target, name, None, new_object(given_value, name, body), span))
        return
    domain, other = given(given_value, type_, body)
    if domain is None and other is None:
        link(target, given_value, body)
    else:
        body.emit(Assign(target, name, domain, other, span))


def new_object(
    expr: NewExpr,
    name: str | None,
    body: Body,
    *,
    slot: int | None = None,
    global_index: int | None = None,
    type_: TypeCode | None = None,
) -> NewObject:
    """The allocation that `new C(...)` asks for."""
    chosen = body.model.tables.constructors[expr].constructor
    arguments = tuple(
        new_object(argument, None, body) if isinstance(argument, NewExpr) else value(argument, body)
        for argument in expr.arguments
    )
    number = body.model.schema.classes[chosen.class_name].constructors.index(chosen)
    return NewObject(chosen.class_name, number, arguments, name, slot, global_index, expr.span, type_)


# ---- tokens ----


def _relation(node: Relation, body: Body) -> None:
    """Append a relation of a rule: new children, or two tokens that exist."""
    tables, frame = body.model.tables, body.frame
    origin = 0 if node.origin is None else frame.token(tables.origins[node])
    bounds = relation_bounds(node, body)
    name = node.relation.name
    for instance in node.created:
        target = tables.targets[instance]
        holder = instance_object(instance, body)
        slot = frame.new_token(target.predicate, target.label)
        label = None if instance.name is None else instance.name.name
        full_name = target.predicate.full_name
        body.emit(Child(slot, full_name, label, instance.role, name, origin, bounds, holder, instance.span))
    if node.existing is not None:
        body.emit(Relate(name, origin, frame.token(tables.existing[node]), bounds, node.span))


def relation_bounds(node: Relation, body: Body) -> tuple[tuple[int, int], ...]:
    """The bounds written after a relation."""
    return tuple(_pair(interval, body) for interval in node.bounds)


def _pair(bound: IntervalExpr, body: Body) -> tuple[int, int]:
    lower, upper = (constants.single(body.model.constant(side)) for side in (bound.lower, bound.upper))
    assert isinstance(lower, int) and isinstance(upper, int), "bounds of relations are whole numbers"
    return lower, upper


def instance_object(instance: Instance, body: Body) -> Operand | str:
    """Where the object of a new token comes from: "own", "any", or the variable that holds it."""
    source = body.model.tables.targets[instance].object
    if isinstance(source, str):
        return source
    if isinstance(source, TokenVariableReference) and source.name == "object" and source.label.name == "this":
        return "own"
    return body.operand(source)


# ---- blocks ----


def _guard(node: IfStatement, body: Body) -> None:
    leaves: list[Operand] = []
    body.leaves = leaves
    condition = value(node.condition, body)
    body.leaves = None
    then = _block(node.then, body)
    otherwise = _block(node.otherwise or (), body)
    body.emit(Guard(condition, tuple(leaves), then, otherwise, node.span))


def _foreach(node: nodes.Foreach, body: Body) -> None:
    collection = value(node.collection, body)
    slot = body.frame.new_slot()
    variable: Variable = body.model.tables.locals[node]
    body.frame.variables[variable] = LocalVariable(slot)
    body.emit(ObjectLoop(slot, collection, _block(node.body, body), node.span))


def _block(statements: tuple[RuleStatement, ...], body: Body) -> tuple[Instruction, ...]:
    inner = body.block()
    for node in statements:
        statement(node, inner)
    return tuple(inner.code)
