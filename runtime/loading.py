"""Load a model: its file in; diagnostics, and the plan database after its script, out."""

import gc
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from dataclasses import dataclass, replace
from itertools import takewhile
from pathlib import Path
from typing import Any

from compiler.lower import compile_model
from compiler.program import Program
from nddl_lang.analysis import Analysis, analyse, analyse_file, analyse_text
from nddl_lang.repair import repaired
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.nodes import Module
from nddl_lang.syntax.parser import MOST_LEXEMES
from nddl_lang.text.diagnostic import Diagnostic, Severity
from nddl_lang.text.render import as_dict
from runtime.plan.database import PlanDatabase
from runtime.plan.readout.readout import read_state
from runtime.plan.readout.state import PlanState
from runtime.user.library import NO_LIBRARY, Library


@dataclass(frozen=True, slots=True)
class Loaded:
    """A model after its script has run; there is no database where its text is in error."""

    file: str
    diagnostics: tuple[Diagnostic, ...]
    program: Program | None
    database: PlanDatabase | None

    @property
    def is_refused(self) -> bool:
        """Whether the text, or a statement of the script, is in error."""
        return any(each.severity is Severity.ERROR for each in self.diagnostics)

    def state(self) -> PlanState | None:
        """The state of the plan; None where the model is refused."""
        return None if self.database is None or self.is_refused else read_state(self.database)


@contextmanager
def _no_collecting() -> Iterator[None]:
    """Look for no garbage: what a model is made of stays, and looking through it again and again is half the work."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()


@_no_collecting()
def load(
    path: Path,
    directories: tuple[str, ...] = (),
    dialect: Dialect | None = None,
    library: Library = NO_LIBRARY,
    name: str | None = None,
    text: str | None = None,
    most: int = MOST_LEXEMES,
) -> Loaded:
    """Analyse, compile and run the script of the model at `path`; the script stops at the first error.

    With `text`, that is the model, and `path` only says where it would stand.
    """
    file = name or str(path)
    if text is None:
        analysis = analyse_file(path, dialect, directories, library.callables, most)
    else:
        analysis = analyse_text(str(path), text, dialect, directories, library.callables, most)
    found = repaired(analysis).diagnostics
    if any(each.severity is Severity.ERROR for each in found):
        fault = _fault_above(analysis, library)
        return Loaded(file, found if fault is None else (fault, *found), None, None)
    program, database, fault = _run(analysis, library)
    return Loaded(file, found if fault is None else (*found, fault), program, database)


def _run(analysis: Analysis, library: Library) -> tuple[Program, PlanDatabase, Diagnostic | None]:
    """Compile a model without errors and run its script; what that stumbled over, if anything."""
    program = compile_model(analysis)
    database = PlanDatabase(program, constraints=library.constraints)
    with redirect_stdout(sys.stderr):  # what constraints print there would be read by programs
        fault = database.run_script()
    return program, database, fault


def _fault_above(analysis: Analysis, library: Library) -> Diagnostic | None:
    """What the script stumbles over before it comes to the first statement whose meaning is in error."""
    errors = [each for each in analysis.diagnostics if each.severity is Severity.ERROR]
    place = errors[0].span
    if not all(_is_about_meaning(each) for each in errors):
        return None
    above = tuple(
        takewhile(
            lambda statement: statement.span.source is not place.source or statement.span.finish <= place.begin,
            analysis.statements,
        )
    )
    start = analyse(replace(analysis.loaded, module=Module(above)), library.callables)
    return None if start.has_errors else _run(start, library)[2]


def as_data(loaded: Loaded, plan: PlanState | None) -> dict[str, Any]:
    """What became of the model, for programs; `plan` is its state, None where the text is in error."""
    ordered = sorted(loaded.diagnostics, key=_is_about_meaning)
    return {
        "file": loaded.file,
        "load": "error" if loaded.is_refused else "ok",
        "consistent": None,
        "diagnostics": [as_dict(each) for each in ordered],
        **({"domains": {}, "tokens": [], "order": {}} if plan is None else plan.as_data()),
        "solve": None,
    }


def _is_about_meaning(diagnostic: Diagnostic) -> bool:
    """Whether a complaint can arise only after the whole text was read: those of the syntax come first."""
    return diagnostic.code.kind not in ("syntax", "include")
