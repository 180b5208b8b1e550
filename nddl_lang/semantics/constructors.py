"""Declare constructors, and check their bodies: `super(...)` first, then one value per member."""

from collections.abc import Sequence
from dataclasses import replace

from nddl_lang.semantics import domains
from nddl_lang.semantics.allocation import (
    argument_types,
    check_allocation,
    choose,
    constructor_notes,
    has_empty_constructor,
    signature_text,
    takes,
)
from nddl_lang.semantics.codes import (
    ASSIGNED_TWICE,
    CONSTRUCTOR_NAME,
    DUPLICATE_CONSTRUCTOR,
    DUPLICATE_FORMAL,
    MISSING_SUPER,
    NO_BASE,
    NOT_A_MEMBER,
    SUPER_NOT_FIRST,
    UNKNOWN_NAME,
)
from nddl_lang.semantics.expressions import type_of
from nddl_lang.semantics.names import complain_unknown, complain_unknown_member, find, follow, resolve, suggest_name
from nddl_lang.semantics.schema import (
    Chosen,
    Class,
    Constructor,
    Domain,
    Kind,
    LocalReference,
    MemberReference,
    Reference,
    Type,
    Variable,
)
from nddl_lang.semantics.scope import BlockKind, Context, Scope, is_told
from nddl_lang.semantics.typenames import find_declared_type
from nddl_lang.semantics.values import check_value, constant
from nddl_lang.syntax.nodes import Assignment, BrokenStatement, ConstructorDecl, NewExpr, PathExpr, SuperCall
from nddl_lang.text.diagnostic import Edit, Fix, Note
from nddl_lang.text.nearest import nearest
from nddl_lang.text.source import Span


def declare_constructors(context: Context, owner: Class, nodes: list[ConstructorDecl]) -> dict[ConstructorDecl, Scope]:
    """Declare all constructors of a class before any body is read; the scopes of their bodies."""
    scopes: dict[ConstructorDecl, Scope] = {}
    seen: dict[tuple[str, ...], Constructor] = {}
    for node in nodes:
        if node.name.name != owner.name:
            fix = Fix(f"write `{owner.name}`", (Edit(node.name.span, owner.name),), safe=False)
            context.complain(CONSTRUCTOR_NAME.at(node.name.span, fixes=(fix,), owner=owner.name))
        scope = scopes[node] = Scope(BlockKind.CONSTRUCTOR, owner.name)
        parameters = _declare_formals(context, scope, node)
        if parameters is None:
            context.symbols.put_partial(owner.name)
            continue
        constructor = Constructor(owner.name, tuple(parameters), node, node.name.span)
        key = tuple(parameter.type.name for parameter in parameters)
        if (first := seen.get(key)) is not None:
            notes = (Note("the first one is here", first.span),) if first.span is not None else ()
            signature = signature_text(constructor)
            context.complain(DUPLICATE_CONSTRUCTOR.at(node.name.span, notes=notes, signature=signature))
            continue
        seen[key] = constructor
        owner.constructors.append(constructor)
        context.tables.declared[node.name] = constructor
    if not nodes:
        owner.constructors.append(Constructor(owner.name, (), None, None))
    return scopes


def _declare_formals(context: Context, scope: Scope, node: ConstructorDecl) -> list[Variable] | None:
    parameters: list[Variable] = []
    is_complete = True
    for formal in node.parameters:
        type_ = find_declared_type(context, formal.type_name, [formal.name])
        name = formal.name.name
        if (first := scope.variables.get(name)) is not None:
            notes = (Note("the first one is here", first.variable.span),)
            context.complain(DUPLICATE_FORMAL.at(formal.name.span, notes=notes, name=name))
        if type_ is None:
            scope.doubt(name)
            is_complete = False
            continue
        parameter = Variable(name, type_, formal.name.span, None, formal)
        parameters.append(parameter)
        scope.variables[name] = LocalReference(parameter)
        context.tables.declared[formal.name] = parameter
        context.tables.locals[formal] = parameter
    return parameters if is_complete else None


def check_constructor(context: Context, owner: Class, node: ConstructorDecl, scope: Scope) -> None:
    """Check the body of a constructor."""
    base = context.symbols.find_class(owner.base) if owner.base is not None else None
    calls_super = any(isinstance(statement, SuperCall | BrokenStatement) for statement in node.body)
    is_certain = not context.symbols.is_partial(owner.name)
    if base is not None and not calls_super and is_certain and not has_empty_constructor(base):
        notes = constructor_notes(base)
        context.complain(MISSING_SUPER.at(node.name.span, notes=notes, base=base.name))
    given: dict[str, tuple[Domain, Span]] = {}
    for index, statement in enumerate(node.body):
        match statement:
            case SuperCall():
                if index > 0:
                    context.complain(SUPER_NOT_FIRST.at(statement.span))
                _check_super(context, scope, base, statement)
            case Assignment():
                _check_assignment(context, scope, statement, given)
            case BrokenStatement(span=span):
                scope.doubt(span.text)


def _check_super(context: Context, scope: Scope, base: Class | None, node: SuperCall) -> None:
    _tell_undeclared(context, scope, base, node)
    types = argument_types(context, scope, node.arguments)
    if base is None or (scope.own_class is not None and context.symbols.is_partial(scope.own_class)):
        return
    if base.is_native and node.arguments and base.base is None and scope.own_class is not None:
        context.complain(
            NO_BASE.at(node.span, help=_advise_base(context, scope.own_class, types), name=scope.own_class)
        )
        return
    constructor = choose(context, base, node.arguments, types, node.span)
    if constructor is not None:
        context.tables.constructors[node] = Chosen(constructor)


def _tell_undeclared(context: Context, scope: Scope, base: Class | None, node: SuperCall) -> None:
    """Complain of a name that the constructor should have as a parameter, to judge by what that of the base takes."""
    name = scope.own_class
    fitting = [one for one in base.constructors if len(one.parameters) == len(node.arguments)] if base else []
    for index, argument in enumerate(node.arguments if fitting and name is not None else ()):
        types = {one.parameters[index].type.name: one.parameters[index].type.kind for one in fitting}
        if (
            not isinstance(argument, PathExpr)
            or len(argument.parts) > 1
            or len(types) > 1
            or Kind.STRING in types.values()
        ):
            continue
        word = argument.parts[0].name
        visible = (*scope.visible(), *context.symbols.names("global", "value"))
        is_known = (
            is_told(context, scope, word)
            or find(context, scope, word) is not None
            or nearest(word, visible) is not None
        )
        if not is_known and name is not None:
            context.reported.add(word)
            wanted = next(iter(types))
            fitting_names = [one.variable.name for one in scope.variables.values() if one.variable.type.name == wanted]
            complaint = UNKNOWN_NAME.at(argument.span, name=word)
            if len(fitting_names) == 1:
                context.complain(suggest_name(complaint, argument.parts[0], (), fitting_names[0]))
                continue
            context.symbols.put_partial(name)  # whoever makes an object may give it
            context.complain(replace(complaint, help=f"declare it as a parameter: `{name}({wanted} {word})`"))


def _advise_base(context: Context, name: str, types: Sequence[Type | None]) -> str:
    """Which class is to be extended, by the constructors that would take the arguments."""
    symbols = context.symbols
    names = [each for each in symbols.names("class") if each != name]
    owners = [owner for each in names if (owner := symbols.find_class(each)) is not None]
    fitting = [owner.name for owner in owners if takes(symbols, owner, types)]
    shown = fitting[0] if len(fitting) == 1 else "Base"
    return f"write `class {name} extends {shown} {{ ... }}`, or remove `super(...)`"


def _check_assignment(context: Context, scope: Scope, node: Assignment, given: dict[str, tuple[Domain, Span]]) -> None:
    reference = _resolve_target(context, scope, node.target)
    if isinstance(node.value, NewExpr):
        check_allocation(context, scope, node.value)
    if not isinstance(reference, MemberReference) or not reference.members:
        if reference is None:
            type_of(context, scope, node.value)
        else:
            context.complain(NOT_A_MEMBER.at(node.target.span, name=node.target.span.text))
        return
    member = reference.members[-1]
    if check_value(context, scope, node.value, member.type, node.target.span.text) is None:
        return
    value = constant(context, node.value)
    if value is None or reference.base is not None:
        return
    key = ".".join(item.name for item in reference.members)
    first = given.get(key)
    both = domains.intersect(first[0], value, member.type.kind) if first is not None else value
    if first is not None and both is None:
        notes = (Note("it got its value here", first[1]),)
        was, text = domains.text(first[0]), node.value.span.text
        context.complain(ASSIGNED_TWICE.at(node.span, notes=notes, name=key, first=was, second=text))
    elif both is not None:
        given[key] = (both, node.span)


def _resolve_target(context: Context, scope: Scope, path: PathExpr) -> Reference | None:
    """A target is a member first, even where a parameter has its name; the value on the right is the parameter."""
    head, *rest = path.parts
    assert scope.own_class is not None
    if head.name == "this" and rest:
        head, *rest = rest
        if context.symbols.find_member(scope.own_class, head.name) is None:
            complain_unknown_member(context, scope.own_class, head)
            return None
    member = context.symbols.find_member(scope.own_class, head.name)
    if member is None and not rest and find(context, scope, head.name) is None:
        complain_unknown(context, scope, head, is_target=True)
        context.symbols.put_faulty(head.name)  # whoever reads the member lacks the same declaration
        return None
    if member is None:
        return resolve(context, scope, path)
    start = MemberReference(None, (member,))
    context.tables.references[head] = start
    reference = follow(context, scope, start, head, rest)
    if reference is not None:
        context.tables.references[path] = reference
    return reference
