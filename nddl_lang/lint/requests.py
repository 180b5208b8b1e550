"""One rule in; the tokens that it asks for out."""

from collections.abc import Iterator
from dataclasses import dataclass

from nddl_lang.lint.part import Part
from nddl_lang.semantics.literals import number
from nddl_lang.semantics.schema import Predicate, TokenVariableReference
from nddl_lang.syntax.nodes import BinaryExpr, ExprConstraint, Foreach, IfStatement, PathExpr, Relation, RuleDecl


@dataclass(frozen=True, eq=False, slots=True)
class ChildRequest:
    """A rule asks for a token; not `is_certain` where that depends on a condition."""

    wanted: Predicate
    relation: Relation
    is_certain: bool
    is_effect: bool
    is_other: bool  # whether it certainly differs from the one that asks, so that they cannot be merged


def child_requests(part: Part, rule: RuleDecl) -> Iterator[ChildRequest]:
    """The tokens that a rule asks for, in its blocks too."""
    changed = _changed(part)
    pending = [(rule.body, True)]
    while pending:
        body, is_certain = pending.pop()
        for statement in body:
            match statement:
                case Relation():
                    for instance in statement.created:
                        if (predicate := part.predicate_of(instance)) is not None:
                            is_other = part.label_of(instance) in changed
                            yield ChildRequest(predicate, statement, is_certain, instance.role == "effect", is_other)
                case IfStatement(then=then, otherwise=otherwise):
                    pending += [(block, False) for block in (then, otherwise) if block]
                case Foreach(body=inner):
                    pending.append((inner, False))


def _changed(part: Part) -> set[object]:
    """The tokens of which a rule computes a parameter from one of its own, as in `q.n == n + 1`."""
    found: set[object] = set()
    for constraint in part.all(ExprConstraint):
        expression = constraint.expression
        if not isinstance(expression, BinaryExpr) or expression.op != "==":
            continue
        for path, other in ((expression.left, expression.right), (expression.right, expression.left)):
            one = part.reference(path) if isinstance(path, PathExpr) else None
            if (
                not isinstance(one, TokenVariableReference)
                or not isinstance(other, BinaryExpr)
                or other.op not in ("+", "-")
            ):
                continue
            source = part.reference(other.left) if isinstance(other.left, PathExpr) else None
            if isinstance(source, TokenVariableReference) and source.label.name == "this" and source.name == one.name:
                if number(other.right) not in (None, 0):
                    found.add(one.label)
    return found
