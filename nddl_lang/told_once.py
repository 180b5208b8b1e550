"""The complaints of a model in; the same with one message for each mistake that costs several, out."""

from collections.abc import Callable, Iterable, Sequence

from nddl_lang.declared_elsewhere import propose_declared_elsewhere
from nddl_lang.early_close import tell_early_close
from nddl_lang.misspelt_declaration import name_misspelt_declaration
from nddl_lang.not_included import name_missing_include
from nddl_lang.semantics.schema import Schema
from nddl_lang.syntax.includes import LoadedModules
from nddl_lang.syntax.nodes import Identifier, Statement
from nddl_lang.text.diagnostic import Diagnostic


def told_once(
    loaded: LoadedModules,
    schema: Schema,
    complaints: Sequence[Diagnostic],
    declared: Iterable[Identifier],
    names_of: Callable[[Statement], Iterable[Identifier]],
) -> tuple[Diagnostic, ...]:
    """`complaints`, where what has one cause is told at that; `names_of` tells what a statement declares."""
    found = name_misspelt_declaration(loaded.sources, complaints, declared)
    found = name_missing_include(loaded, tell_early_close(found), names_of)
    return propose_declared_elsewhere(loaded.module.statements, schema, found)
