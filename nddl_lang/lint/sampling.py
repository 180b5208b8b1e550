"""Find sampled parameters that are drawn for nothing, that never vary, or whose draws do not all fit."""

from collections.abc import Iterator
from dataclasses import dataclass

from nddl_lang.lint.codes import DRAWN_IN_VAIN, DRAWS_OUTSIDE, NEVER_VARIED, OTHER_RANGE
from nddl_lang.lint.local_names import used_variables
from nddl_lang.lint.part import Facts, Finding, Key, Part
from nddl_lang.lint.reading import declared, domain_of, key_of
from nddl_lang.semantics import domains
from nddl_lang.semantics.schema import Domain, GlobalReference, LocalReference, Reference, Variable
from nddl_lang.syntax.nodes import (
    BinaryExpr,
    CallConstraint,
    CallExpr,
    Expr,
    ExprConstraint,
    IntLiteral,
    PathExpr,
    RuleDecl,
)
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix, Note
from nddl_lang.text.source import Span


@dataclass(frozen=True, eq=False, slots=True)
class _DrawSite:
    """One place where a sampled parameter is drawn; `receiver` is what takes the value, where it is a variable."""

    parameter: Reference
    name: str
    span: Span
    receiver: Key | None
    receiver_text: str
    domain: Domain | None


def draws_of(part: Part) -> Iterator[_DrawSite]:
    """The draws of a statement."""
    tables = part.tables
    if not tables.sampled:
        return
    for constraint in part.all(ExprConstraint):
        expression = constraint.expression
        if isinstance(expression, BinaryExpr) and expression.op == "==":
            for path, call in ((expression.left, expression.right), (expression.right, expression.left)):
                if isinstance(call, CallExpr) and call in tables.sampled:
                    yield _draw(part, tables.sampled[call], call.arguments[0], path)
    for statement in part.all(CallConstraint):
        if statement in tables.sampled:
            yield _draw(part, tables.sampled[statement], statement.arguments[-1], statement.arguments[0])


def _draw(part: Part, parameter: Reference, argument: Expr, receiver: Expr) -> _DrawSite:
    key = key_of(part.reference(receiver)) if isinstance(receiver, PathExpr) else None
    domain = domain_of(part, receiver) if key is not None else None
    return _DrawSite(parameter, argument.span.text, argument.span, key, receiver.span.text, domain)


def lint_draws(part: Part) -> Iterator[Finding]:
    """Draws that nothing reads, or that need not fit what receives them."""
    if not part.tables.sampled:
        return
    mentions: dict[Variable, int] = {}
    for path in part.all(PathExpr):
        reference = part.reference(path)
        if isinstance(reference, LocalReference):
            mentions[reference.variable] = mentions.get(reference.variable, 0) + 1
    for draw in draws_of(part):
        if draw.receiver is not None and isinstance(part.node, RuleDecl):
            receiver = draw.receiver[0]
            if isinstance(receiver, Variable) and receiver in used_variables(part) and mentions.get(receiver) == 1:
                notes = (Note(f"nothing else refers to `{receiver.name}`", receiver.span),)
                yield DRAWN_IN_VAIN.at(draw.span, notes=notes, name=draw.name)
        yield _fitting(draw)


def _fitting(draw: _DrawSite) -> Finding:
    def finding(facts: Facts) -> Diagnostic | None:
        parameter = draw.parameter
        if not isinstance(parameter, GlobalReference):
            return None
        variable = parameter.variable
        range_ = facts.assigned.get((variable, "")) or declared(variable)
        if range_ is None:
            return None
        notes = (Note(f"`{variable.name}` is declared here", variable.span),)
        kind = variable.type.kind
        if domains.is_single(range_):
            if (difference := _meant_interval(variable)) is not None:
                place, written = difference
                notes = (Note("what is drawn is used here", draw.span),)
                help_ = f"`{place.text}` is a difference; an interval is written `{written}`"
                fixes = (Fix(f"write `{written}`", (Edit(place, written),), safe=False),)
                value = domains.text(range_)
                return NEVER_VARIED.at(place, notes=notes, help=help_, fixes=fixes, name=draw.name, value=value)
            help_ = f"give it a range, as in `{variable.name} = [1 5]`, or use the value without `sampledParameter`"
            return NEVER_VARIED.at(draw.span, notes=notes, help=help_, name=draw.name, value=domains.text(range_))
        if draw.domain is not None and not domains.is_within(range_, draw.domain, kind):
            help_ = "a mission that draws a value outside of it fails"
            return DRAWS_OUTSIDE.at(
                draw.span,
                notes=notes,
                help=help_,
                name=draw.name,
                range=domains.set_text(range_),
                receiver=f"`{draw.receiver_text}`",
                domain=domains.set_text(draw.domain),
            )
        return None

    return finding


def _meant_interval(variable: Variable) -> tuple[Span, str] | None:
    """Where `2-6` stands for the range of a parameter, and how that is written."""
    match variable.initialiser:
        case BinaryExpr(op="-", left=IntLiteral(value=low), right=IntLiteral(value=high), span=span) if low < high:
            return span, f"[{low} {high}]"
    return None


def compare_draws(parts: list[Part]) -> Iterator[Diagnostic]:
    """A parameter without a range of its own that is drawn into variables with different ranges."""
    first: dict[object, _DrawSite] = {}
    for part in parts:
        for draw in draws_of(part) if part.tables.sampled else ():
            if isinstance(draw.parameter, GlobalReference) and declared(draw.parameter.variable) is not None:
                continue
            if draw.domain is None:
                continue
            parameter = draw.parameter
            key = parameter.variable if isinstance(parameter, GlobalReference) else parameter
            before = first.setdefault(key, draw)
            if before.domain is not None and before.domain != draw.domain:
                notes = (Note("the other place is here", before.span),)
                here, there = domains.set_text(draw.domain), domains.set_text(before.domain)
                yield OTHER_RANGE.at(draw.span, notes=notes, name=draw.name, domain=here, other=there)
