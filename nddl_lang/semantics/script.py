"""Check the statements of the script that act on what is declared: tokens, assignments, allocations."""

from dataclasses import replace

from nddl_lang.semantics import domains
from nddl_lang.semantics.allocation import check_allocation
from nddl_lang.semantics.codes import DUPLICATE_OBJECT, LEAVES_DOMAIN, NOT_A_VARIABLE
from nddl_lang.semantics.names import resolve
from nddl_lang.semantics.natives import LEAST_DURATION, SELF_ACTIVATING
from nddl_lang.semantics.schema import (
    ClassReference,
    Domain,
    EnumValue,
    GlobalReference,
    Label,
    Reference,
    TokenReference,
    TokenVariableReference,
    Type,
    Values,
)
from nddl_lang.semantics.scope import BlockKind, Context, Scope
from nddl_lang.semantics.tokens import check_instances, check_relation
from nddl_lang.semantics.types import reference_type
from nddl_lang.semantics.values import check_value, constant, domain_key, reference_key
from nddl_lang.syntax.nodes import (
    Allocation,
    Assignment,
    BoolLiteral,
    Expr,
    FloatLiteral,
    GoalStatement,
    Instance,
    IntervalExpr,
    IntLiteral,
    NewExpr,
    PathExpr,
    Relation,
    StringLiteral,
    VariableDecl,
)
from nddl_lang.text.diagnostic import Edit, Fix
from nddl_lang.text.source import Span

_GOAL_STATES = ("ACTIVE", "MERGED")
_REJECTABLE_STATES = (*_GOAL_STATES, "REJECTED")


def check_goal(context: Context, node: GoalStatement) -> None:
    """Check `goal(object.p q);`, `fact(...)` or `rejectable(...)`."""
    scope = Scope(BlockKind.SCRIPT)
    for instance, label in zip(node.instances, check_instances(context, scope, node.instances), strict=True):
        if label is not None:
            _note_token(context, label, node.kind, instance)


def check_script_relation(context: Context, node: Relation) -> None:
    """Check a relation between tokens of the script."""
    labels = check_relation(context, Scope(BlockKind.SCRIPT), node)
    for label, instance in zip(labels, node.created, strict=True):
        if label is not None:
            _note_token(context, label, "child", instance)


def check_new(context: Context, node: Allocation) -> None:
    """Check `new C(...);`."""
    check_allocation(context, Scope(BlockKind.SCRIPT), node.value)


def check_assignment(context: Context, node: Assignment) -> None:
    """Check `a = value;`: it fits, and leaves the variable a value."""
    scope = Scope(BlockKind.SCRIPT)
    reference = resolve(context, scope, node.target, type_name=_evident_type(node))
    if isinstance(node.value, NewExpr):
        check_allocation(context, scope, node.value)
        if isinstance(reference, GlobalReference):
            _note_object(context, reference.variable.name, node)
    type_ = _target_type(context, node.target, reference, _evident_type(node))
    if type_ is None or check_value(context, scope, node.value, type_, node.target.span.text) is None:
        return
    left = check_domain(context, node.target, type_, node.value)
    key = domain_key(context, node.target)
    if key is not None and left is not None:
        context.symbols.put_base_domain(key, left)
    if isinstance(reference, TokenVariableReference) and reference.name == "state":
        note_state(context, reference.label, left)


def _evident_type(node: Assignment) -> str | None:
    """The type of what is assigned to a single name, where it is plain from the text."""
    if node.op != "=" or len(node.target.parts) != 1:
        return None
    match node.value:
        case NewExpr(class_name=name):
            return name.name
        case IntervalExpr(lower=lower, upper=upper):
            return "float" if "." in f"{lower.span.text}{upper.span.text}" else "int"
        case IntLiteral():
            return "int"
        case FloatLiteral():
            return "float"
        case BoolLiteral():
            return "bool"
        case StringLiteral():
            return "string"
        case _:
            return None


def _target_type(
    context: Context, target: PathExpr, reference: Reference | None, type_name: str | None = None
) -> Type | None:
    """The type of the variable that `reference` denotes; a complaint where it is none. `type_name`: of what it gets."""
    if reference is None:
        return None
    match reference:
        case ClassReference():
            what = "a class"
        case TokenReference():
            what = "a token"
        case EnumValue():
            what = "an enum value"
        case _:
            return reference_type(reference, None)
    complaint = NOT_A_VARIABLE.at(target.span, name=target.span.text, what=what)
    if type_name is not None and isinstance(reference, ClassReference) and reference.name == type_name:
        name = reference.name[0].lower() + reference.name[1:]
        after = Span(target.span.anchor, target.span.end, target.span.end)
        fix = Fix(f"write `{type_name} {name}`", (Edit(after, f" {name}"),), safe=False)
        complaint = replace(complaint, help=f"give the object a name: `{type_name} {name} = ...`", fixes=(fix,))
    context.complain(complaint)
    return None


def check_domain(context: Context, target: PathExpr, type_: Type, value: Expr) -> Domain | None:
    """Complain where no value is left to the variable; what its base domain lies within, None where unknown."""
    given = constant(context, value)
    if given is None:
        return None
    known = _known_domain(context, target, type_)
    if known is None:
        return given
    left = domains.intersect(known, given, type_.kind)
    if left is None:
        name, text = target.span.text, value.span.text
        context.complain(LEAVES_DOMAIN.at(value.span, text=text, name=name, domain=domains.set_text(known, type_.kind)))
    return left


def _known_domain(context: Context, target: PathExpr, type_: Type) -> Domain | None:
    """What the base domain of a variable of the script lies within, None where nothing is known."""
    key = domain_key(context, target)
    known = context.symbols.base_domain(key) if key is not None else None
    if known is not None:
        return known
    reference = context.tables.references.get(target)
    if isinstance(reference, TokenVariableReference):
        return _declared_domain(context, reference)
    return type_.restriction


def note_state(context: Context, label: Label, state: Domain | None) -> None:
    """Note that the state of a token of the script was given."""
    known = str(state.items[0]) if isinstance(state, Values) and len(state.items) == 1 else None
    context.symbols.put_token_state(label.name, known)


def _note_token(context: Context, label: Label, kind: str, instance: Instance) -> None:
    symbols = context.symbols
    prefix = context.tables.targets[instance].object
    key = reference_key(context, prefix) if not isinstance(prefix, str) else None
    object_domain = symbols.base_domain(key) if key is not None else None
    is_active = any(owner.name in SELF_ACTIVATING for owner in symbols.ancestry(label.predicate.class_name))
    symbols.put_token(label.name, kind, "ACTIVE" if is_active else "INACTIVE")
    if object_domain is not None:
        symbols.put_base_domain(f"{label.name}.object", object_domain)
    symbols.put_base_domain(f"{label.name}.state", Values(_REJECTABLE_STATES if kind == "rejectable" else _GOAL_STATES))


def _note_object(context: Context, name: str, node: Assignment) -> None:
    first = context.symbols.look("object", name)
    if first is not None:
        context.complain(DUPLICATE_OBJECT.at(node.span, name=name))
    else:
        context.symbols.put("object", name, node.target.span)


def _declared_domain(context: Context, variable: TokenVariableReference) -> Domain | None:
    """What the declaration of a token's variable leaves of its type, as far as it is written out there."""
    domain = LEAST_DURATION if variable.name == "duration" and not variable.label.predicate.is_event else None
    known: Domain | None = domain or variable.type.restriction
    for written in _written_values(variable):
        given = constant(context, written)
        if given is not None and known is not None:
            known = domains.intersect(known, given, variable.type.kind) or known
        else:
            known = known or given
    return known


def _written_values(variable: TokenVariableReference) -> list[Expr]:
    values: list[Expr] = []
    for node in variable.label.predicate.nodes:
        for statement in node.body:
            if isinstance(statement, VariableDecl):
                values += [
                    declarator.initialiser
                    for declarator in statement.declarators
                    if declarator.name.name == variable.name and declarator.initialiser is not None
                ]
            elif isinstance(statement, Assignment) and statement.target.span.text == variable.name:
                values.append(statement.value)
    return values
