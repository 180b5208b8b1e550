"""Lower the script: the top-level statements in the order in which they are executed."""

from typing import assert_never

from compiler import constants
from compiler.body import Body
from compiler.expressions import value
from compiler.program import (
    STATE,
    Assign,
    Call,
    GlobalVariable,
    NewGlobal,
    NewToken,
    Relate,
    TokenVariable,
)
from compiler.statements import assign, constraint, given, instance_object, link, new_object, path_name, relation_bounds
from nddl_lang.semantics.schema import ClassReference, TokenReference
from nddl_lang.syntax.nodes import (
    Allocation,
    Assignment,
    BrokenStatement,
    CallConstraint,
    ClassDecl,
    Declarator,
    EnumDecl,
    ExprConstraint,
    GoalStatement,
    Include,
    Instance,
    MethodCall,
    NewExpr,
    Relation,
    RuleDecl,
    Statement,
    TypedefDecl,
    VariableDecl,
)

_ACTIVE = "ACTIVE"


def execute(node: Statement, body: Body) -> None:
    """Append the instructions of one top-level statement; declarations of types and rules have none."""
    match node:
        case VariableDecl(declarators=declarators):
            for declarator in declarators:
                _global(declarator, body)
        case Assignment():
            _assignment(node, body)
        case CallConstraint() | ExprConstraint():
            constraint(node, body)
        case GoalStatement(kind=kind, instances=instances):
            for instance in instances:
                _token(kind, instance, body)
        case Relation():
            _relation(node, body)
        case Allocation(value=expr):
            body.emit(new_object(expr, None, body))
        case MethodCall():
            body.emit(_restriction(node, body) or _call(node, body))
        case ClassDecl() | EnumDecl() | TypedefDecl() | RuleDecl() | Include():
            pass
        case BrokenStatement():
            raise AssertionError("only a model without errors is compiled")
        case _:
            assert_never(node)


def _global(declarator: Declarator, body: Body) -> None:
    variable = body.model.tables.locals.get(declarator) or body.model.schema.globals[declarator.name.name]
    type_ = constants.type_code(variable.type)
    initialiser = declarator.initialiser
    domain, copy_of = given(initialiser, type_, body)
    index = len(body.model.globals)
    if isinstance(initialiser, NewExpr):
        body.emit(new_object(initialiser, variable.name, body, global_index=index, type_=type_))
    else:
        body.emit(NewGlobal(index, variable.name, type_, domain, copy_of, declarator.span))
    body.model.globals[variable] = index
    for target, leaves in link(GlobalVariable(index), initialiser, body).items():
        if all(isinstance(leaf, GlobalVariable) for leaf in leaves):  # rules see nothing else of the script
            body.model.sources[target] = leaves


def _assignment(node: Assignment, body: Body) -> None:
    target = body.operand(body.model.tables.references[node.target])
    domain = body.model.constant(node.value)
    if isinstance(target, TokenVariable) and target.variable == STATE and constants.single(domain) == _ACTIVE:
        body.emit(Call("activate", target.token, None, None, (), path_name(node.target), node.span))
        return
    assign(node, target, constants.type_code(body.model.type_of(node.target)), body)


def _token(kind: str, instance: Instance, body: Body) -> int:
    target = body.model.tables.targets[instance]
    holder = instance_object(instance, body)
    assert holder != "own", "the script has no token of its own"
    slot = body.frame.new_token(target.predicate, target.label)
    name = None if instance.name is None else instance.name.name
    body.emit(NewToken(slot, target.predicate.full_name, name, kind, holder, instance.span))
    return slot


def _relation(node: Relation, body: Body) -> None:
    tables, frame = body.model.tables, body.frame
    origin = frame.token(tables.origins[node])
    bounds = relation_bounds(node, body)
    targets = [_token("goal", instance, body) for instance in node.created]
    if node.existing is not None:
        targets.append(frame.token(tables.existing[node]))
    for target in targets:
        body.emit(Relate(node.relation.name, origin, target, bounds, node.span))


def _restriction(node: MethodCall, body: Body) -> Assign | None:
    """`v.specify([1 5])`: with several values it restricts the variable, as an assignment does."""
    if node.method.name != "specify" or len(node.arguments) != 1:
        return None
    domain = body.model.constant(node.arguments[0])
    if domain is None or constants.single(domain) is not None:
        return None
    target = body.operand(body.model.tables.references[node.target])
    type_ = constants.type_code(body.model.type_of(node.target))
    return Assign(target, path_name(node.target), constants.converted(domain, type_), None, node.span)


def _call(node: MethodCall, body: Body) -> Call:
    """A method call; what it is called on decides which of the three targets is set."""
    arguments = tuple(value(argument, body) for argument in node.arguments)
    method, written = node.method.name, path_name(node.target)
    if not node.target.parts:
        return Call(method, None, None, None, arguments, written, node.span)
    reference = body.model.tables.references[node.target]
    match reference:
        case ClassReference(name=name):
            return Call(method, None, None, name, arguments, written, node.span)
        case TokenReference(label=label):
            return Call(method, body.frame.token(label), None, None, arguments, written, node.span)
        case _:
            return Call(method, None, body.operand(reference), None, arguments, written, node.span)
