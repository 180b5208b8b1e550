"""Check constraint statements: named ones against the table, expressions for having a truth value."""

from dataclasses import replace

from nddl_lang.semantics.arguments import check_count, check_types
from nddl_lang.semantics.codes import FORMER_CONSTRAINT, NOT_IN_NDDL3, UNKNOWN_CONSTRAINT
from nddl_lang.semantics.constraints import CONSTRAINTS_ELSEWHERE, FORMER_CONSTRAINTS, ConstraintRow, Origin
from nddl_lang.semantics.expressions import NO_ENVIRONMENT, check_condition, type_of
from nddl_lang.semantics.functions import FUNCTIONS
from nddl_lang.semantics.names import suggest_name
from nddl_lang.semantics.sampled import sampled_parameter
from nddl_lang.semantics.scope import Context, Scope
from nddl_lang.semantics.signature import ArgumentKind
from nddl_lang.semantics.undeclared import propose_declaration
from nddl_lang.syntax.advice import advise_operator
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.nodes import CallConstraint, ExprConstraint
from nddl_lang.text.diagnostic import Edit, Fix


def check_expression_constraint(context: Context, scope: Scope, node: ExprConstraint) -> None:
    """Check `a + b == c;`."""
    first = len(context.complaints)
    check_condition(context, scope, node.expression)
    propose_declaration(context, scope, node, first)


def check_call_constraint(context: Context, scope: Scope, node: CallConstraint) -> None:
    """Check `eq(a, b);`."""
    name = node.name.name
    row = context.callables.constraints.get(name)
    if row is None:
        for argument in node.arguments:
            type_of(context, scope, argument)
        if not context.callables.has_gaps:
            _complain_unknown(context, node)
        return
    if row.origin is Origin.NDDLC and context.dialect is Dialect.NDDL3:
        context.complain(NOT_IN_NDDL3.at(node.name.span, help=NO_ENVIRONMENT, name=name))
    types = [
        sampled_parameter(context, scope, node, argument, FUNCTIONS[name])
        if _is_parameter(row, index)
        else type_of(context, scope, argument)
        for index, argument in enumerate(node.arguments)
    ]
    if check_count(context, name, row.signature, len(types), node.span, row.meaning):
        check_types(context, name, row.signature, node.arguments, types)


# What comparisons are called elsewhere that no constraint states with the same arguments; without `_`.
_DEMANDS = ("assert", "assume", "check", "ensure", "expect", "must", "require")
_COMPARISONS = {
    **dict.fromkeys(("geq", "ge", "gte", "greaterthanequal", "greaterorequal", "greaterthaneq"), ">="),
    **dict.fromkeys(("gt", "greaterthan", "greater"), ">"),
}


def _is_parameter(row: ConstraintRow, index: int) -> bool:
    argument = row.signature.argument(index)
    return argument is not None and argument.kind is ArgumentKind.PARAMETER


def _complain_unknown(context: Context, node: CallConstraint) -> None:
    name = node.name.name
    today = FORMER_CONSTRAINTS.get(name)
    if today is not None:
        fix = Fix(f"write `{today}`", (Edit(node.name.span, today),))
        context.complain(FORMER_CONSTRAINT.at(node.name.span, fixes=(fix,), name=name, today=today))
        return
    complaint = UNKNOWN_CONSTRAINT.at(node.name.span, name=name)
    plain = name.casefold().replace("_", "")
    sign = _COMPARISONS.get(plain)
    if sign is not None and len(node.arguments) == 2:
        left, right = (each.span.text for each in node.arguments)
        meant = f"{left} {sign} {right};"
        fix = Fix(f"write `{meant}`", (Edit(node.span, meant),), safe=False)
        context.complain(UNKNOWN_CONSTRAINT.at(node.name.span, fixes=(fix,), name=name))
        return
    if plain in _DEMANDS and len(node.arguments) == 1:
        meant = f"{node.arguments[0].span.text};"
        fix = Fix(f"write `{meant}`", (Edit(node.span, meant),))
        context.complain(replace(complaint, help="each line of a rule is a demand already", fixes=(fix,)))
        return
    if (advice := advise_operator(name)) is not None:
        context.complain(replace(complaint, help=advice))
        return
    if name in FORMER_CONSTRAINTS:
        complaint = UNKNOWN_CONSTRAINT.at(
            node.name.span, help="write it as an expression, such as `a + b <= c`", name=name
        )
    statements = () if node.arguments else ("close",)
    complaint = suggest_name(
        complaint, node.name, (*context.callables.constraints, *statements), CONSTRAINTS_ELSEWHERE.get(plain)
    )
    own = "one of your own is in a file that `modules` of `[constraints]` names, in nddlc.toml and the mission file"
    context.complain(complaint if complaint.help is not None else replace(complaint, help=own))
