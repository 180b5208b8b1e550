"""Declare classes with their members; tell the user where a declaration contradicts another."""

from nddl_lang.semantics.codes import (
    DUPLICATE_MEMBER,
    DUPLICATE_TYPE,
    ENUM_OF_THAT_NAME,
    MEMBER_VALUE,
    NATIVE_CLASS,
    OWN_BASE,
)
from nddl_lang.semantics.constructors import check_constructor, declare_constructors
from nddl_lang.semantics.declared_twice import without_second
from nddl_lang.semantics.natives import ROOT_CLASS
from nddl_lang.semantics.predicates import check_predicate
from nddl_lang.semantics.schema import Class, Predicate, Variable
from nddl_lang.semantics.scope import BlockKind, Context, Scope, names_in
from nddl_lang.semantics.typenames import find_declared_type, find_defined_class, known_type
from nddl_lang.semantics.types import BASIC_TYPES
from nddl_lang.semantics.values import check_value, constant
from nddl_lang.syntax.nodes import (
    BrokenStatement,
    ClassDecl,
    ConstructorDecl,
    Declarator,
    Identifier,
    NewExpr,
    PredicateDecl,
    VariableDecl,
)
from nddl_lang.text.diagnostic import Note


def check_class(context: Context, node: ClassDecl) -> None:
    """Declare the class of `node` and check what it declares."""
    symbols, name = context.symbols, node.name.name
    known = symbols.find_class(name)
    if known is not None and known.is_native:
        context.complain(NATIVE_CLASS.at(node.name.span, name=name))
        return
    is_open = known is not None and (node.members is None or not known.is_defined)
    if known is None and (enum := symbols.find_enum(name)) is not None and symbols.find_typedef(name) is None:
        notes = (Note("the enum is here", enum.span),) if enum.span else ()
        context.complain(ENUM_OF_THAT_NAME.at(node.name.span, notes=notes, name=name))
    elif not is_open and complain_taken(context, node.name):
        return
    if node.members is None:
        if known is None:
            announced = Class(name, ROOT_CLASS, is_defined=False, node=node, span=node.name.span, doc=node.doc)
            symbols.put("class", name, announced)
            context.tables.declared[node.name] = announced
        return
    base = None
    if node.base is not None and node.base.name == name:
        context.complain(OWN_BASE.at(node.base.span, name=name))
    elif node.base is not None:
        base = find_defined_class(context, node.base)
    if node.base is not None and base is None:
        symbols.put_partial(name)
    owner = Class(name, base.name if base is not None else ROOT_CLASS, node=node, span=node.name.span, doc=node.doc)
    symbols.put("class", name, owner)
    context.tables.declared[node.name] = owner
    _inherit_predicates(context, owner)
    _check_members(context, owner, node)


def complain_taken(context: Context, name: Identifier) -> bool:
    """Complain if there is a type of that name already."""
    symbols, word = context.symbols, name.name
    if known_type(context, word) is None:
        return False
    first = symbols.find_typedef(word) or symbols.find_enum(word) or symbols.find_class(word)
    if word in BASIC_TYPES:
        notes: tuple[Note, ...] = (Note(f"`{word}` is a type of the language"),)
    else:
        notes = (Note("the first declaration is here", first.span),) if first is not None and first.span else ()
    context.complain(DUPLICATE_TYPE.at(name.span, notes=notes, name=word))
    return True


def _inherit_predicates(context: Context, owner: Class) -> None:
    """Give the class its ancestors' predicates under names of its own."""
    base = context.symbols.find_class(owner.base) if owner.base is not None else None
    if base is None:
        return
    for name, of_base in {**base.inherited, **base.predicates}.items():
        owner.inherited[name] = Predicate(
            owner.name,
            name,
            of_base.parameters,
            of_base.is_action,
            of_base.is_event,
            of_base.nodes,
            of_base.declared_in,
            of_base.span,
            of_base.doc,
        )


def _check_members(context: Context, owner: Class, node: ClassDecl) -> None:
    members = node.members or ()
    _tie_types_before_constructors(context, node)
    constructors = [member for member in members if isinstance(member, ConstructorDecl)]
    scopes = declare_constructors(context, owner, constructors)
    for member in members:
        match member:
            case VariableDecl(declarators=declarators):
                for scope in scopes.values():
                    for declarator in declarators:
                        scope.expect(declarator.name.name, declarator.name.span)
            case BrokenStatement(span=span):
                context.symbols.put_partial(owner.name)
                for name in names_in(span.text):
                    context.symbols.put_faulty(name)
            case _:
                pass
    for member in members:
        match member:
            case VariableDecl():
                _check_variables(context, owner, member)
            case ConstructorDecl():
                check_constructor(context, owner, member, scopes[member])
            case PredicateDecl():
                check_predicate(context, owner, member)
            case BrokenStatement():
                pass


def _tie_types_before_constructors(context: Context, node: ClassDecl) -> None:
    """Complain of an unknown type where it stands first: the parameters of constructors are looked at before others."""
    members = node.members or ()
    kinds = {type(member) for member in members}
    if BrokenStatement in kinds or ConstructorDecl not in kinds:
        return
    for member in members:
        if isinstance(member, ConstructorDecl):
            return
        body = member.body if isinstance(member, PredicateDecl) else (member,)
        for each in body:
            if isinstance(each, VariableDecl):
                find_declared_type(context, each.type_name, [one.name for one in each.declarators])


def _check_variables(context: Context, owner: Class, node: VariableDecl) -> None:
    type_ = find_declared_type(context, node.type_name, [one.name for one in node.declarators])
    for declarator in node.declarators:
        name = declarator.name.name
        first = context.symbols.find_member(owner.name, name)
        if first is not None:
            notes = (Note("the first one is here", first.span),) if first.span is not None else ()
            complaint = DUPLICATE_MEMBER.at(declarator.name.span, notes=notes, owner=owner.name, name=name)
            context.complain(without_second(complaint, node, declarator))
        elif type_ is None:
            context.symbols.put_partial(owner.name)
            context.symbols.put_faulty(name)
        else:
            variable = Variable(name, type_, declarator.name.span, declarator.initialiser, node, node.doc)
            owner.members[name] = variable
            context.tables.declared[declarator.name] = variable
            context.tables.locals[declarator] = variable
            _check_initialiser(context, owner, declarator, variable, node)


def _check_initialiser(
    context: Context, owner: Class, declarator: Declarator, variable: Variable, node: VariableDecl
) -> None:
    value = declarator.initialiser
    if value is None:
        return
    scope = Scope(BlockKind.CONSTRUCTOR, owner.name)
    is_unknown = isinstance(value, NewExpr) and context.symbols.find_class(value.class_name.name) is None
    if not is_unknown and check_value(context, scope, value, variable.type, variable.name, node) is None:
        return
    if constant(context, value) is None:
        context.complain(MEMBER_VALUE.at(value.span, help="assign it in the constructor", text=value.span.text))
