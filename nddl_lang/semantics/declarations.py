"""Declare enums, typedefs and global variables."""

from nddl_lang.semantics import domains
from nddl_lang.semantics.allocation import check_allocation
from nddl_lang.semantics.classes import complain_taken
from nddl_lang.semantics.codes import CLASS_TYPEDEF, DUPLICATE_NAME, DUPLICATE_VALUE, NARROWED_TYPEDEF
from nddl_lang.semantics.declared_twice import without_second
from nddl_lang.semantics.schema import Domain, Enumeration, EnumValue, Kind, Type, Typedef, Values, Variable
from nddl_lang.semantics.scope import BlockKind, Context, Scope
from nddl_lang.semantics.typenames import find_declared_type, find_type
from nddl_lang.semantics.types import TOKEN_STATES
from nddl_lang.semantics.values import check_value, constant
from nddl_lang.syntax.nodes import EnumDecl, Identifier, NewExpr, TypedefDecl, VariableDecl
from nddl_lang.text.diagnostic import Note


def check_enum(context: Context, node: EnumDecl) -> None:
    """Declare an enum and its values."""
    name = node.name.name
    # Models of EUROPA's first years repeat the built-in enum; EUROPA passes over it, and so do we.
    if name == TOKEN_STATES or complain_taken(context, node.name):
        return
    values = tuple(dict.fromkeys(value.name for value in node.values))
    enum = Enumeration(name, values, node, node.name.span, node.doc)
    context.symbols.put("enum", name, enum)
    context.tables.declared[node.name] = enum
    own: dict[str, Identifier] = {}
    for value in node.values:
        known = context.symbols.find_value(value.name)
        if known is not None:
            first = own.get(value.name)
            notes = _enum_note(context, known) if first is None else (Note("the first one is here", first.span),)
            context.complain(DUPLICATE_VALUE.at(value.span, notes=notes, name=value.name, enum=known.enum))
            continue
        own[value.name] = value
        declared = EnumValue(name, value.name)
        context.symbols.put("value", value.name, declared)
        context.tables.declared[value] = declared


def _enum_note(context: Context, value: EnumValue) -> tuple[Note, ...]:
    enum = context.symbols.find_enum(value.enum)
    if enum is None or enum.node is None:
        return (Note(f"`{value.value}` is a state of tokens"),)
    spans = [identifier.span for identifier in enum.node.values if identifier.name == value.value]
    return (Note("the first one is here", spans[0]),)


def check_typedef(context: Context, node: TypedefDecl) -> None:
    """Declare a typedef."""
    name = node.name.name
    base = find_type(context, node.base)
    is_taken = complain_taken(context, node.name)
    if base is None:
        context.symbols.put_faulty(name)
        return
    if base.kind is Kind.OBJECT:
        context.complain(CLASS_TYPEDEF.at(node.base.span, name=base.base))
        context.symbols.put_faulty(name)
        return
    is_sound = check_value(context, Scope(BlockKind.SCRIPT), node.domain, base, name) is not None
    if is_taken:
        return
    restriction = constant(context, node.domain) if is_sound else None
    if restriction is not None and base.restriction is not None:
        both = domains.intersect(restriction, base.restriction, base.kind)
        if both is not None and both != restriction:
            found, allowed = domains.text(both), domains.text(base.restriction)
            context.complain(
                NARROWED_TYPEDEF.at(node.domain.span, name=name, found=found, base=base.name, allowed=allowed)
            )
        restriction = both
    typedef = Typedef(name, Type(base.kind, name, base.base, restriction), node, node.name.span, node.doc)
    context.symbols.put("typedef", name, typedef)
    context.tables.declared[node.name] = typedef


def check_globals(context: Context, node: VariableDecl) -> None:
    """Declare global variables."""
    scope = Scope(BlockKind.SCRIPT)
    type_ = find_declared_type(context, node.type_name, [one.name for one in node.declarators])
    for declarator in node.declarators:
        name = declarator.name.name
        first = context.symbols.find_global(name) or context.symbols.find_goal(name)
        if first is not None:
            notes = (Note("the first declaration is here", first.span),) if first.span is not None else ()
            complaint = DUPLICATE_NAME.at(declarator.name.span, notes=notes, name=name)
            context.complain(without_second(complaint, node, declarator))
        value = declarator.initialiser
        if isinstance(value, NewExpr):
            check_allocation(context, scope, value)
        if type_ is None:
            context.symbols.put_faulty(name)
            continue
        is_sound = value is None or check_value(context, scope, value, type_, name, node) is not None
        if first is not None:
            continue
        variable = Variable(name, type_, declarator.name.span, value, node, node.doc)
        context.symbols.put("global", name, variable)
        context.tables.declared[declarator.name] = variable
        context.tables.locals[declarator] = variable
        if isinstance(value, NewExpr):
            context.symbols.put("object", name, declarator.name.span)
            context.symbols.put_base_domain(name, Values((name,)))
        elif is_sound:
            given = constant(context, value) if value is not None else None
            context.symbols.put_base_domain(name, _narrowed(type_, given))


def _narrowed(type_: Type, given: Domain | None) -> Domain | None:
    if given is None or type_.restriction is None:
        return given or type_.restriction
    return domains.intersect(given, type_.restriction, type_.kind)
