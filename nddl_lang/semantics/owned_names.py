"""A name that stands alone in a rule in, such as `quantity`; the paths that it may have been short for out."""

from nddl_lang.semantics.schema import Kind
from nddl_lang.semantics.scope import Context, Scope


def owned_names(context: Context, scope: Scope, name: str) -> list[str]:
    """The variables of that name which the tokens and the objects have that the rule names."""
    return [*_variables_of_tokens(scope, name), *_members_of_variables(context, scope, name)]


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
