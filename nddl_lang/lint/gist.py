"""One top-level statement in; what it contributes to the picture of the whole model out."""

from collections.abc import Iterator
from dataclasses import dataclass

from nddl_lang.lint.local_names import named_variables, used_variables
from nddl_lang.lint.network import Edge
from nddl_lang.lint.part import Key, Part, mentioned_labels
from nddl_lang.lint.reading import bounded, domain_of, key_of
from nddl_lang.lint.requests import ChildRequest, child_requests
from nddl_lang.lint.temporal import RuleTimes
from nddl_lang.semantics.literals import number
from nddl_lang.semantics.schema import (
    ClassReference,
    Domain,
    EnumValue,
    GlobalReference,
    Label,
    MemberReference,
    Variable,
)
from nddl_lang.syntax.nodes import (
    Allocation,
    Assignment,
    BinaryExpr,
    CallConstraint,
    ClassDecl,
    Expr,
    ExprConstraint,
    GoalStatement,
    Identifier,
    MethodCall,
    NewExpr,
    PathExpr,
    PredicateDecl,
    Relation,
    RuleDecl,
    StringLiteral,
    VariableDecl,
)
from nddl_lang.text.source import Span

Given = tuple[Key, Domain, Span]
_TIMED = (Assignment, CallConstraint, ExprConstraint, GoalStatement, MethodCall, Relation, VariableDecl)


@dataclass(frozen=True, eq=False, slots=True)
class Gist:
    """What one statement contributes to the picture of the whole."""

    variables: frozenset[Variable] = frozenset()  # read or written, apart from their declaration
    written: frozenset[Variable] = frozenset()  # that only get a value: members in a constructor, globals in the script
    words: frozenset[str] = frozenset()  # names of types and enum values, and the texts of strings
    names: frozenset[str] = frozenset()  # of the variables that it declares
    parameters: frozenset[Variable] = frozenset()  # of the predicates of a class, those without a value
    labels: frozenset[Label] = frozenset()
    requested: frozenset[str] = frozenset()  # names of the predicates of which it makes tokens
    objects: tuple[NewExpr, ...] = ()
    given: tuple[Given, ...] = ()
    predicate: str = ""  # the full name of that of a rule
    requests: tuple[ChildRequest, ...] = ()  # of a rule
    times: tuple[Edge, ...] = ()  # that a statement of the script demands
    is_script: bool = False  # it makes objects, states goals or closes something


def gist(part: Part) -> Gist:
    """Work out what a statement contributes."""
    words = {type_.name for type_ in part.tables.type_names.values()}
    words |= {type_.base for type_ in part.tables.type_names.values()}
    for reference in part.tables.references.values():
        if isinstance(reference, EnumValue):
            words |= {reference.value, reference.enum}
        elif isinstance(reference, ClassReference):
            words.add(reference.name)
    words |= {literal.value for literal in part.all(StringLiteral)}
    words |= {new.class_name.name for new in part.all(NewExpr)}
    for sampled in part.tables.sampled.values():
        if isinstance(sampled, EnumValue):
            words |= {sampled.value, sampled.enum}
    variables = used_variables(part)
    written: set[Variable] = set()
    if isinstance(part.node, ClassDecl):
        variables, written = _class_uses(part, variables)
    elif (variable := _given_value(part)) is not None:
        written = {variable}
        variables = variables - written
    return Gist(
        frozenset(variables),
        frozenset(written),
        frozenset(words),
        frozenset(each.name for each in named_variables(part)),
        frozenset(_parameters(part)),
        frozenset(mentioned_labels(part)) if not isinstance(part.node, ClassDecl | RuleDecl) else frozenset(),
        frozenset(target.predicate.name for target in part.tables.targets.values()),
        tuple(part.all(NewExpr)),
        tuple(_given(part)),
        _predicate_of(part),
        tuple(child_requests(part, part.node)) if isinstance(part.node, RuleDecl) else (),
        tuple(RuleTimes(part).edges(part.node)) if isinstance(part.node, _TIMED) else (),
        _is_script(part),
    )


def _class_uses(part: Part, variables: set[Variable]) -> tuple[set[Variable], set[Variable]]:
    """What a class reads, and the members that its constructors only give values to."""
    targets = {each.target for each in part.all(Assignment)}
    read: set[Variable] = set()
    written: set[Variable] = set()
    for node in part.all(PathExpr):
        reference = part.reference(node)
        if isinstance(reference, MemberReference) and reference.members:
            if node in targets and len(reference.members) == 1:
                written.add(reference.members[0])
            else:
                read.update(reference.members)
    members = {member for reference in part.tables.references.values() for member in getattr(reference, "members", ())}
    return (variables - members) | read, written - read


def _given_value(part: Part) -> Variable | None:
    """The global variable that a statement of the script does nothing with but to give it a value."""
    match part.node:
        case (
            Assignment(target=target, value=value)
            | MethodCall(target=target, method=Identifier(name="specify"), arguments=(value,))
        ):
            pass
        case ExprConstraint(expression=BinaryExpr(op="==", left=target, right=value)) if (
            domain_of(part, value) is not None
        ):
            pass
        case _:
            return None
    reference = part.reference(target) if isinstance(target, PathExpr) else None
    if not isinstance(reference, GlobalReference):
        return None
    mentioned = (part.reference(node) for node in part.all(PathExpr) if node is not target)
    is_read = any(isinstance(one, GlobalReference) and one.variable is reference.variable for one in mentioned)
    return None if is_read else reference.variable


def _parameters(part: Part) -> Iterator[Variable]:
    for predicate in part.all(PredicateDecl):
        for declaration in predicate.body:
            if isinstance(declaration, VariableDecl):
                for each in declaration.declarators:
                    variable = part.tables.declared.get(each.name)
                    if isinstance(variable, Variable) and each.initialiser is None:
                        yield variable


def _given(part: Part) -> Iterator[Given]:
    """What a statement of the script says about the values of variables."""
    match part.node:
        case VariableDecl(declarators=declarators):
            for declarator in declarators:
                variable = part.tables.declared.get(declarator.name)
                if isinstance(variable, Variable) and declarator.initialiser is not None:
                    if (domain := domain_of(part, declarator.initialiser)) is not None:
                        yield (variable, ""), domain, declarator.span
        case Assignment(target=target, value=value, span=span):
            yield from restricted(part, target, "==", value, span)
        case ExprConstraint(expression=BinaryExpr(op=op, left=left, right=right), span=span):
            yield from restricted(part, left, op, right, span)
        case MethodCall(target=target, method=method, arguments=(value,), span=span) if method.name == "specify":
            yield from restricted(part, target, "==", value, span)


def restricted(part: Part, target: Expr, op: str, value: Expr, span: Span) -> Iterator[Given]:
    """What `target op value` says about the values of a variable."""
    key = key_of(part.reference(target)) if isinstance(target, PathExpr) else None
    limit = number(value)
    domain = domain_of(part, value) if op == "==" else bounded(op, limit) if limit is not None else None
    if key is not None and domain is not None:
        yield key, domain, span


def _predicate_of(part: Part) -> str:
    predicate = part.tables.predicates.get(part.node) if isinstance(part.node, RuleDecl) else None
    return predicate.full_name if predicate is not None else ""


def _is_script(part: Part) -> bool:
    node = part.node
    if isinstance(node, GoalStatement | Allocation):
        return True
    if isinstance(node, MethodCall):
        return node.method.name == "close"
    if isinstance(node, VariableDecl | Assignment):
        return bool(part.all(NewExpr))
    return False
