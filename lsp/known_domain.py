"""A variable where a rule names it in; what the comparisons of the rule that hold there leave of its domain out."""

from lsp.uses import constants
from nddl_lang.analysis import Analysis
from nddl_lang.lint.logic import Known, assume
from nddl_lang.lint.part import Key, Part
from nddl_lang.lint.reading import declared, token_domain, written
from nddl_lang.semantics import domains
from nddl_lang.semantics.schema import Domain, Kind, TokenVariableReference, Values, Variable
from nddl_lang.syntax.nodes import ExprConstraint, Foreach, IfStatement, RuleDecl, RuleStatement


def known_domain(
    analysis: Analysis, thing: Variable | TokenVariableReference, around: tuple[object, ...]
) -> Domain | None:
    """The values that are left, a superset of those that the variable takes; None where they are those of before.

    Only comparisons with what is known by itself count, of the rule and of the branches around the place, those below
    the place as well: a rule demands all of them at once.
    """
    rule = next((node for node in around if isinstance(node, RuleDecl)), None)
    tables = analysis.by_statement.get(rule) if rule is not None else None
    if rule is None or tables is None:
        return None
    if isinstance(thing, Variable):
        key: Key = (thing, "")
        before = declared(thing)
    else:
        key = (thing.label, thing.name)
        before = token_domain(thing.label.predicate, thing.name, thing.type)
    kind = thing.type.kind
    if before is None and kind is Kind.ENUM and (enum := analysis.schema.enums.get(thing.type.base)) is not None:
        before = Values(tuple(enum.values))
    given: dict[Key, Domain] = {
        (variable, ""): domain
        for variable, value in constants(analysis).items()
        if variable.initialiser is None and (domain := written(value, variable.type.kind)) is not None
    }
    known = _known_at(Part(rule, tables, analysis.dialect), rule, around, Known(constants=given))
    left = known.domains.get(key)
    if left is not None and before is not None:
        left = domains.intersect(before, left, kind)
    left = _without(left if left is not None else before, known, key)
    return None if left is None or left == before or kind is Kind.OBJECT else left


def _known_at(part: Part, rule: RuleDecl, around: tuple[object, ...], known: Known) -> Known:
    body: tuple[RuleStatement, ...] | None = rule.body
    while body is not None:
        for statement in body:
            if isinstance(statement, ExprConstraint):
                known = assume(part, statement.expression, True, known)
        inner = next((each for each in body if each in around and isinstance(each, IfStatement | Foreach)), None)
        body = None
        match inner:
            case Foreach():
                body = inner.body
            case IfStatement(condition=condition, then=then, otherwise=otherwise):
                for block, holds in ((then, True), (otherwise or (), False)):
                    if any(each in around for each in block):
                        known, body = assume(part, condition, holds, known), block
            case None:
                pass
    return known


def _without(domain: Domain | None, known: Known, key: Key) -> Domain | None:
    """The domain without the values that branches on the way leave out."""
    gone = known.excluded.get(key, frozenset())
    if not isinstance(domain, Values) or not gone:
        return domain
    items = tuple(item for item in domain.items if item not in gone)
    return Values(items) if items else domain
