"""Declare predicates, and check their bodies: parameters, and constraints that hold for every token."""

from nddl_lang.semantics.codes import (
    BUILTIN_PARAMETER,
    CLASS_AS_VALUE,
    DUPLICATE_PARAMETER,
    DUPLICATE_PREDICATE,
    FOREIGN_TARGET,
    UNKNOWN_NAME,
)
from nddl_lang.semantics.constraining import check_call_constraint, check_expression_constraint
from nddl_lang.semantics.declared_twice import without_second
from nddl_lang.semantics.names import find, resolve
from nddl_lang.semantics.natives import builtin_type
from nddl_lang.semantics.schema import Class, ClassReference, Label, Predicate, TokenVariableReference, Variable
from nddl_lang.semantics.scope import BlockKind, Context, Scope
from nddl_lang.semantics.typenames import find_declared_type
from nddl_lang.semantics.values import check_value
from nddl_lang.syntax.nodes import (
    Assignment,
    BrokenStatement,
    CallConstraint,
    Declarator,
    ExprConstraint,
    Identifier,
    PathExpr,
    PredicateDecl,
    VariableDecl,
)
from nddl_lang.text.diagnostic import Note
from nddl_lang.text.nearest import nearest


def check_predicate(context: Context, owner: Class, node: PredicateDecl) -> None:
    """Declare the predicate of `node` in `owner` and check its body."""
    name = node.name.name
    if (known := owner.predicates.get(name)) is not None:
        notes = (Note("the first one is here", known.span),) if known.span is not None else ()
        context.complain(DUPLICATE_PREDICATE.at(node.name.span, notes=notes, owner=owner.name, name=name))
        return
    parent = owner.inherited.pop(name, None)
    parameters = list(parent.parameters) if parent is not None else []
    own = _declare_parameters(context, owner, parent, node)
    predicate = Predicate(
        owner.name,
        name,
        (*parameters, *own.values()),
        node.is_action or (parent is not None and parent.is_action),
        parent is not None and parent.is_event,
        (*(parent.nodes if parent is not None else ()), node),
        (*(parent.declared_in if parent is not None else ()), owner.name),
        node.name.span,
        node.doc,
    )
    owner.predicates[name] = predicate
    context.tables.declared[node.name] = predicate
    scope = Scope(BlockKind.PREDICATE, owner.name, Label("this", predicate, node.name.span))
    scope.parameters = {parameter.name: parameter for parameter in parameters}
    for declarator, parameter in own.items():
        scope.expect(parameter.name, declarator.name.span)
    _check_body(context, scope, node, own)


def _declare_parameters(
    context: Context, owner: Class, parent: Predicate | None, node: PredicateDecl
) -> dict[Declarator, Variable]:
    """The parameters that the body adds, in order."""
    known = {parameter.name: parameter for parameter in parent.parameters} if parent is not None else {}
    own: dict[Declarator, Variable] = {}
    full_name = f"{owner.name}.{node.name.name}"
    probe = Predicate(owner.name, "", (), False, parent is not None and parent.is_event, (), (), None)
    for statement in node.body:
        if not isinstance(statement, VariableDecl):
            continue
        type_ = find_declared_type(context, statement.type_name, [one.name for one in statement.declarators])
        for declarator in statement.declarators:
            name = declarator.name.name
            if builtin_type(name, probe) is not None:
                context.complain(BUILTIN_PARAMETER.at(declarator.name.span, name=name))
            elif (first := known.get(name)) is not None:
                notes = (Note("the first one is here", first.span),) if first.span is not None else ()
                complaint = DUPLICATE_PARAMETER.at(declarator.name.span, notes=notes, owner=full_name, name=name)
                context.complain(without_second(complaint, statement, declarator))
            elif type_ is None:
                context.symbols.put_faulty(name)
            else:
                parameter = Variable(
                    name, type_, declarator.name.span, declarator.initialiser, statement, statement.doc
                )
                known[name] = own[declarator] = parameter
                context.tables.declared[declarator.name] = parameter
                context.tables.locals[declarator] = parameter
    return own


def _check_body(context: Context, scope: Scope, node: PredicateDecl, own: dict[Declarator, Variable]) -> None:
    for statement in node.body:
        match statement:
            case VariableDecl():
                for declarator in statement.declarators:
                    _check_parameter(context, scope, declarator, own.get(declarator), statement)
            case CallConstraint():
                check_call_constraint(context, scope, statement)
            case ExprConstraint(expression=PathExpr(parts=(name,))) if _is_half_declared(context, scope, name):
                pass
            case ExprConstraint():
                check_expression_constraint(context, scope, statement)
            case Assignment():
                _check_assignment(context, scope, statement)
            case BrokenStatement(span=span):
                scope.doubt(span.text)


def _is_half_declared(context: Context, scope: Scope, name: Identifier) -> bool:
    """Whether a name that stands alone is half the declaration of a parameter; then says which half is missing."""
    reference = find(context, scope, name.name)
    assert scope.own_class is not None
    if isinstance(reference, ClassReference):
        word = f"{name.name[:1].lower()}{name.name[1:]}"
        help_ = f"a parameter has a name behind its type: `{name.name} {word};`"
        complaint = CLASS_AS_VALUE.at(name.span, name=name.name, help=help_)
    elif reference is None and not context.symbols.is_doubtful(name.name) and not nearest(name.name, scope.visible()):
        word = name.name
        help_ = f"a parameter has a type before its name: `int {word};`"
        complaint = UNKNOWN_NAME.at(name.span, name=word, help=help_)
    else:
        return False
    context.complain(complaint)
    scope.doubt(word)
    context.symbols.put_faulty(word)
    context.symbols.put_partial(scope.own_class)
    return True


def _check_parameter(
    context: Context, scope: Scope, declarator: Declarator, parameter: Variable | None, node: VariableDecl
) -> None:
    if parameter is None:
        return
    if declarator.initialiser is not None:
        check_value(context, scope, declarator.initialiser, parameter.type, parameter.name, node)
    scope.parameters[parameter.name] = parameter


def _check_assignment(context: Context, scope: Scope, node: Assignment) -> None:
    reference = resolve(context, scope, node.target)
    if reference is None:
        return
    if not isinstance(reference, TokenVariableReference):
        context.complain(FOREIGN_TARGET.at(node.target.span))
        return
    check_value(context, scope, node.value, reference.type, node.target.span.text)
