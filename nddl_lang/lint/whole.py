"""All statements of a model in; what only they together tell out."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from nddl_lang.analysis import Analysis
from nddl_lang.lint.local_names import used_variables
from nddl_lang.lint.network import Edge
from nddl_lang.lint.part import Facts, Key, Part, mentioned_labels
from nddl_lang.lint.reading import bounded, domain_of, key_of
from nddl_lang.lint.requests import ChildRequest, child_requests
from nddl_lang.lint.temporal import RuleTimes
from nddl_lang.semantics import domains
from nddl_lang.semantics.literals import number
from nddl_lang.semantics.schema import (
    ClassReference,
    Domain,
    EnumValue,
    Interval,
    Kind,
    Label,
    MemberReference,
    Variable,
)
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.includes import LIBRARY
from nddl_lang.syntax.nodes import (
    Allocation,
    Assignment,
    BinaryExpr,
    CallConstraint,
    ClassDecl,
    Expr,
    ExprConstraint,
    GoalStatement,
    MethodCall,
    NewExpr,
    PathExpr,
    Relation,
    RuleDecl,
    StringLiteral,
    VariableDecl,
)
from nddl_lang.text.read import real_path
from nddl_lang.text.source import Source, Span

Given = tuple[Key, Domain, Span]
_TIMED = (Assignment, CallConstraint, ExprConstraint, GoalStatement, MethodCall, Relation, VariableDecl)


@dataclass(frozen=True, eq=False, slots=True)
class Gist:
    """What one statement contributes to the picture of the whole."""

    variables: frozenset[Variable] = frozenset()  # read or written, apart from their declaration
    written: frozenset[Variable] = frozenset()  # members that only get a value, in a constructor
    words: frozenset[str] = frozenset()  # names of types and enum values, and the texts of strings
    labels: frozenset[Label] = frozenset()
    requested: frozenset[str] = frozenset()  # names of the predicates of which it makes tokens
    objects: tuple[NewExpr, ...] = ()
    given: tuple[Given, ...] = ()
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
    return Gist(
        frozenset(variables),
        frozenset(written),
        frozenset(words),
        frozenset(mentioned_labels(part)) if not isinstance(part.node, ClassDecl | RuleDecl) else frozenset(),
        frozenset(target.predicate.name for target in part.tables.targets.values()),
        tuple(part.all(NewExpr)),
        tuple(_given(part)),
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
            yield from _restricted(part, target, "==", value, span)
        case ExprConstraint(expression=BinaryExpr(op=op, left=left, right=right), span=span):
            yield from _restricted(part, left, op, right, span)
        case MethodCall(target=target, method=method, arguments=(value,), span=span) if method.name == "specify":
            yield from _restricted(part, target, "==", value, span)


def _restricted(part: Part, target: Expr, op: str, value: Expr, span: Span) -> Iterator[Given]:
    key = key_of(part.reference(target)) if isinstance(target, PathExpr) else None
    limit = number(value)
    domain = domain_of(part, value) if op == "==" else bounded(op, limit) if limit is not None else None
    if key is not None and domain is not None:
        yield key, domain, span


@dataclass(eq=False, slots=True)
class Whole:
    """A model: its statements and what they contribute.

    `is_whole` tells whether it is meant to run as it is: it makes objects, states goals or closes something.
    """

    analysis: Analysis
    parts: list[Part]
    gists: list[Gist]
    library: frozenset[Source]
    judged: frozenset[Source]
    is_whole: bool = False
    variables: set[Variable] = field(default_factory=set)
    written: set[Variable] = field(default_factory=set)
    words: set[str] = field(default_factory=set)
    labels: set[Label] = field(default_factory=set)
    requested: set[str] = field(default_factory=set)
    objects: dict[str, list[NewExpr]] = field(default_factory=dict)
    given: dict[Key, list[tuple[Domain, Span]]] = field(default_factory=dict)
    assigned: dict[Key, Domain] = field(default_factory=dict)

    @property
    def dialect(self) -> Dialect:
        """The dialect of the model."""
        return self.analysis.dialect

    def facts(self) -> Facts:
        """What findings in single statements may ask."""
        return Facts(self.analysis.schema, self.objects, self.assigned)

    def inner_given(self, part: Part) -> dict[Key, list[tuple[Domain, Span]]]:
        """What the comparisons inside a rule say about the values of its variables."""
        found: dict[Key, list[tuple[Domain, Span]]] = {}
        if isinstance(part.node, RuleDecl):
            for constraint in part.all(ExprConstraint):
                expression = constraint.expression
                if isinstance(expression, BinaryExpr):
                    given = _restricted(part, expression.left, expression.op, expression.right, constraint.span)
                    for key, domain, span in given:
                        found.setdefault(key, []).append((domain, span))
        return found

    def is_own(self, span: Span | None) -> bool:
        """Whether a place stands in a text that is judged by this model, not one that other models include too."""
        return span is not None and span.source in self.judged

    def all(self, kind: type[GoalStatement]) -> Iterator[tuple[Part, GoalStatement]]:
        """The goals, facts and rejectables of the script."""
        return ((part, part.node) for part in self.parts if isinstance(part.node, kind))


def assemble(analysis: Analysis, parts: list[Part], gists: list[Gist], judged: frozenset[Path] = frozenset()) -> Whole:
    """Put together what the statements contribute; `judged` are included files that the model is judged by too."""
    paths = analysis.loaded.paths
    library = frozenset(source for source, path in paths.items() if Path(path).parent == LIBRARY)
    own = {source for source, path in paths.items() if source not in library and real_path(path) in judged}
    whole = Whole(analysis, parts, gists, library, frozenset({analysis.loaded.root, *own}))
    whole.variables = set().union(*(each.variables for each in gists))
    whole.written = set().union(*(each.written for each in gists))
    whole.words = set().union(*(each.words for each in gists))
    whole.labels = set().union(*(each.labels for each in gists))
    whole.requested = set().union(*(each.requested for each in gists))
    whole.is_whole = any(
        each.is_script and part.node.span.source not in library for part, each in zip(parts, gists, strict=True)
    )
    ancestry: dict[str, list[str]] = {}
    for each in gists:
        for new in each.objects:
            name = new.class_name.name
            if name not in ancestry:
                ancestry[name] = analysis.schema.ancestry(name)
            for owner in ancestry[name]:
                whole.objects.setdefault(owner, []).append(new)
        for key, domain, span in each.given:
            whole.given.setdefault(key, []).append((domain, span))
            kind = _kind(key)
            before = whole.assigned.get(key)
            whole.assigned[key] = domain if before is None else domains.intersect(before, domain, kind) or domain
    return whole


def _kind(key: Key) -> Kind:
    return key[0].type.kind if isinstance(key[0], Variable) else Kind.FLOAT


def _is_script(part: Part) -> bool:
    node = part.node
    if isinstance(node, GoalStatement | Allocation):
        return True
    if isinstance(node, MethodCall):
        return node.method.name == "close"
    if isinstance(node, VariableDecl | Assignment):
        return bool(part.all(NewExpr))
    return False


def hull_of(domain: Domain | None) -> Interval | None:
    """The interval around what is known, None where nothing is."""
    return domains.hull(domain) if domain is not None else None
