"""`name == value;` with a complaint that nothing is called `name` in; what mends it, by the type of the value, out."""

from dataclasses import replace

from nddl_lang.semantics.codes import UNKNOWN_NAME
from nddl_lang.semantics.names import COMPARISONS, find
from nddl_lang.semantics.schema import Kind, Type
from nddl_lang.semantics.scope import BlockKind, Context, Scope
from nddl_lang.semantics.types import comparable, reference_type
from nddl_lang.syntax.nodes import BinaryExpr, Expr, ExprConstraint, PathExpr
from nddl_lang.syntax.walk import descendants
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix
from nddl_lang.text.source import Span


def propose_declaration(context: Context, scope: Scope, node: ExprConstraint, first: int) -> None:
    """Where a rule gives an unknown name a value and no known one is meant, propose to declare it.

    The complaints of this statement begin with number `first`. A known name that is spelt alike is not meant where it
    could never equal the value, nor where the value is computed from it. What has members and is called like a class is
    declared as an object of that.
    """
    if scope.kind is not BlockKind.RULE:
        return
    for number, complaint in enumerate(context.complaints[first:], start=first):
        if complaint.code is not UNKNOWN_NAME:
            continue
        if (owner := _class_of(context, node, complaint)) is not None:
            context.complaints[number] = declared(complaint, node.span, owner)
        elif isinstance(node.expression, BinaryExpr) and node.expression.op in COMPARISONS:
            for side, other in _sides(node.expression):
                if isinstance(side, PathExpr) and len(side.parts) == 1 and complaint.span == side.span:
                    is_given = side is node.expression.left or not isinstance(other, PathExpr)
                    type_ = context.tables.types.get(other) if is_given and node.expression.op == "==" else None
                    context.complaints[number] = _reconsidered(context, scope, node, complaint, other, type_)


def _sides(binary: BinaryExpr) -> tuple[tuple[Expr, Expr], tuple[Expr, Expr]]:
    return (binary.left, binary.right), (binary.right, binary.left)


def _class_of(context: Context, node: ExprConstraint, complaint: Diagnostic) -> str | None:
    """The class that an unknown name is called like, but for capitals, where it has the member behind the dot."""
    name = complaint.span.text
    members = {
        each.parts[1].name
        for each in descendants(node)
        if isinstance(each, PathExpr) and len(each.parts) > 1 and each.parts[0].span == complaint.span
    }
    alike = [each for each in context.symbols.names("class") if each.casefold() == name.casefold()]
    has_them = all(context.symbols.find_member(each, member) is not None for each in alike for member in members)
    return alike[0] if members and len(alike) == 1 and has_them else None


def _reconsidered(
    context: Context, scope: Scope, node: ExprConstraint, complaint: Diagnostic, value: Expr, type_: Type | None
) -> Diagnostic:
    """A complaint of a name that is compared with `value`, of `type_` where it is given that."""
    proposed = {edit.text for fix in complaint.fixes for edit in fix.edits}
    is_circular = any(isinstance(each, PathExpr) and each.span.text in proposed for each in descendants(value))
    is_told = complaint.help is not None or complaint.fixes
    if type_ is not None and (not is_told or is_circular or not _may_be_meant(context, scope, complaint, type_)):
        return declared(complaint, node.span, type_.name)
    return replace(complaint, help=None, fixes=()) if is_circular else complaint


def declared(complaint: Diagnostic, statement: Span, type_name: str) -> Diagnostic:
    """The complaint of an unknown name with its declaration, before a statement, as help."""
    written = f"{type_name} {complaint.span.text};"
    fix = Fix(f"declare `{written}`", (_before(statement, written),), safe=False)
    return replace(complaint, help=f"declare it: `{written}`", fixes=(fix,))


def asked_for(complaint: Diagnostic, statement: Span, written: str) -> Diagnostic:
    """The complaint of an unknown token with what asks for it, before a statement, as help."""
    fix = Fix(f"ask for `{written}`", (_before(statement, written),), safe=False)
    return replace(complaint, help=f"ask for it: `{written}`", fixes=(fix,))


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
