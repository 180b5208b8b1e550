"""A name that stands alone in a rule in, such as `quantity`; the paths that it may have been short for out."""

from collections.abc import Sequence
from dataclasses import replace

from nddl_lang.semantics.schema import Kind, Label, Predicate
from nddl_lang.semantics.scope import Context, Scope
from nddl_lang.text.diagnostic import Diagnostic, Edit, Fix, Note
from nddl_lang.text.source import Span


def owned_names(context: Context, scope: Scope, name: str) -> list[str]:
    """The variables of that name which the tokens and the objects have that the rule names."""
    return [*_variables_of_tokens(scope, name), *_members_of_variables(context, scope, name)]


def others_with(context: Context, scope: Scope, name: str, compared: str | None) -> list[str]:
    """What a rule has of that name, but for `compared`: of its tokens and objects, its parameters and variables."""
    is_bare = name in scope.parameters or scope.find_local(name) is not None
    found = [*owned_names(context, scope, name), *([name] if is_bare else [])]
    return [each for each in found if each != compared]


def owned_by_others(complaint: Diagnostic, at: Span, others: Sequence[str]) -> Diagnostic:
    """The complaint that something lacks a variable, with who has it."""
    help_ = f"did you mean {' or '.join(f'`{each}`' for each in others)}?"
    return replace(complaint, help=help_, fixes=only_one(at, others))


def only_one(at: Span, texts: Sequence[str]) -> tuple[Fix, ...]:
    """The fix that writes what is meant, where one text alone may be."""
    return tuple(Fix(f"write `{text}`", (Edit(at, text),), safe=False) for text in texts if len(texts) == 1)


def labels_of(context: Context, scope: Scope, class_name: str | None, predicate: str) -> list[Label]:
    """The tokens that a block sees of a predicate of that name, of a class or of any."""
    labels = [scope.find_label(name) for name in dict.fromkeys(scope.visible_labels())]
    return [one for one in labels if one is not None and is_of(context, one.predicate, class_name, predicate)]


def is_of(context: Context, predicate: Predicate, class_name: str | None, name: str) -> bool:
    """Whether a predicate has a name, in a class or in any."""
    is_kind = class_name is None or context.symbols.is_subclass(predicate.class_name, class_name)
    return predicate.name == name and is_kind


def declared_note(predicate: Predicate) -> tuple[Note, ...]:
    """A note that points at the declaration of a predicate."""
    if predicate.span is None:
        return ()
    return (Note(f"`{predicate.full_name}` is declared here", predicate.span),)


def _variables_of_tokens(scope: Scope, name: str) -> list[str]:
    """The variables of the tokens that a block names which are called so."""
    found: list[str] = []
    block: Scope | None = scope
    while block is not None:
        for label in block.labels.values():
            if any(parameter.name == name for parameter in label.predicate.parameters):
                found.append(f"{label.name}.{name}")
        block = block.parent
    return found


def _members_of_variables(context: Context, scope: Scope, name: str) -> list[str]:
    """The members of that name which the objects in the parameters and local variables of a rule have."""
    own = scope.own.predicate.parameters if scope.own is not None else ()
    objects = [*own, *(each.variable for each in scope.variables.values())]
    found = [one for one in objects if one.type is not None and one.type.kind is Kind.OBJECT]
    return [f"{one.name}.{name}" for one in found if context.symbols.find_member(one.type.base, name) is not None]
