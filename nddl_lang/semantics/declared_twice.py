"""A second declaration of one name in; the complaint with what mends it out."""

from dataclasses import replace

from nddl_lang.semantics.codes import DUPLICATE_TOKEN
from nddl_lang.semantics.natives import builtin_type
from nddl_lang.semantics.schema import Label
from nddl_lang.semantics.scope import Context, Scope
from nddl_lang.syntax.nodes import Declarator, VariableDecl
from nddl_lang.syntax.removal import undeclare
from nddl_lang.text.diagnostic import Diagnostic, Note


def without_second(complaint: Diagnostic, node: VariableDecl, declarator: Declarator) -> Diagnostic:
    """The complaint with the fix that removes the declaration, which gives no value that would be lost."""
    is_empty = declarator.initialiser is None
    fixes = (undeclare(node, node.declarators.index(declarator), safe=False),) if is_empty else ()
    return replace(complaint, help="remove this one, or give it another name", fixes=fixes)


def tell_reused(context: Context, scope: Scope, label: Label, name: str) -> bool:
    """Whether a token lacks a parameter that one of the same name before it has; that is told, once, at its label.

    What else is unknown in the rule may have been meant to be the name of one of both.
    """
    first = scope.hidden_by(label)
    if first is None or label.span is None or builtin_type(name, label.predicate) is not None:
        return False
    has = [any(each.name == name for each in one.predicate.parameters) for one in (first, label)]
    if has != [True, False]:
        return False
    if label.name not in context.reported:
        context.reported.add(label.name)
        notes = (Note("the first declaration is here", first.span),) if first.span is not None else ()
        help_ = f"`{label.name}` is the token of `{first.predicate.full_name}` already: give this one another name"
        context.complain(DUPLICATE_TOKEN.at(label.span, notes=notes, help=help_, name=label.name))
        scope.doubt_all()
    return True
