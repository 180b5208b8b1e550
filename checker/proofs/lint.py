"""A model file in, what z3 proves to be impossible in its rules out: what `nddlc lint --prove` adds."""

from pathlib import Path

from checker.proofs.codes import DEAD_BRANCH, IMPOSSIBLE_BRANCH, IMPOSSIBLE_RULE
from checker.proofs.rules import prove_rules
from compiler.lower import compile_model
from nddl_lang.analysis import Analyser
from nddl_lang.lint.suppression import suppress
from nddl_lang.semantics.callables import Callables
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.includes import load_module_graph
from nddl_lang.syntax.parser import MOST_ASKED_FOR
from nddl_lang.text.diagnostic import Diagnostic

_PROVED = (IMPOSSIBLE_RULE, DEAD_BRANCH, IMPOSSIBLE_BRANCH)


def prove_model(
    path: Path, directories: tuple[Path, ...], dialect: Dialect, callables: Callables
) -> tuple[Diagnostic, ...]:
    """What is impossible in the rules of a model without errors, but for what a comment takes back."""
    analysis = Analyser(callables).analyse(load_module_graph(path, directories, dialect, most=MOST_ASKED_FOR))
    if analysis.has_errors:
        return ()
    found, _ = prove_rules(compile_model(analysis))
    return tuple(each for each in suppress(analysis, tuple(found), is_linted=True) if each.code in _PROVED)
