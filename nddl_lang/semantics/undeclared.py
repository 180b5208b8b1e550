"""`name == value;` with a complaint that nothing is called `name` in; what mends it, by the type of the value, out."""

from dataclasses import replace

from nddl_lang.semantics.codes import UNKNOWN_NAME
from nddl_lang.semantics.names import find
from nddl_lang.semantics.schema import Kind, Type
from nddl_lang.semantics.scope import BlockKind, Context, Scope
from nddl_lang.semantics.types import comparable, reference_type
from nddl_lang.syntax.nodes import BinaryExpr, ExprConstraint, PathExpr
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix
from nddl_lang.text.source import Span


def propose_declaration(context: Context, scope: Scope, node: ExprConstraint, first: int) -> None:
    """Where a rule gives an unknown name a value and no known one is meant, propose to declare it.

    The complaints of this statement begin with number `first`. A known name that is spelt alike and could never equal
    the value is not meant.
    """
    expression = node.expression
    if scope.kind is not BlockKind.RULE or not isinstance(expression, BinaryExpr) or expression.op != "==":
        return
    type_ = context.tables.types.get(expression.right)
    if type_ is None or not isinstance(expression.left, PathExpr) or len(expression.left.parts) != 1:
        return
    name = expression.left.parts[0]
    for number, complaint in enumerate(context.complaints[first:], start=first):
        if complaint.code is not UNKNOWN_NAME or complaint.span != name.span:
            continue
        if (complaint.help is None and not complaint.fixes) or not _may_be_meant(context, scope, complaint, type_):
            written = f"{type_.name} {name.name};"
            fix = Fix(f"declare `{written}`", (_before(node.span, written),), safe=False)
            context.complaints[number] = replace(complaint, help=f"declare it: `{written}`", fixes=(fix,))


def _may_be_meant(context: Context, scope: Scope, complaint: Diagnostic, value: Type) -> bool:
    """Whether what the only fix of a complaint writes may be equal to the value; what is not known by name may."""
    edits = [edit for fix in complaint.fixes for edit in fix.edits]
    reference = find(context, scope, edits[0].text) if len(edits) == 1 else None
    found = reference_type(reference, scope.own_class) if reference is not None else None
    if found is None:
        return True
    is_truth = (found.kind is Kind.BOOL, value.kind is Kind.BOOL)
    return is_truth[0] is is_truth[1] and comparable(found, value, context.symbols.is_subclass)


def _before(span: Span, written: str) -> Edit:
    """Put a statement before the one at `span`: on a line of its own where that one begins its line."""
    text = span.source.text
    start = text.rfind("\n", 0, span.begin) + 1
    indentation = text[start : span.begin]
    gap = " " if indentation.strip() else f"\n{indentation}"
    return Edit(Span(span.anchor, span.start, span.start), f"{written}{gap}")
