"""A project with constraints of its own in a folder, and the models of the tests as plan databases."""

from collections.abc import Sequence
from pathlib import Path
from textwrap import dedent

import runtime.build_form
from compiler.lower import compile_model
from nddl_lang.analysis import analyse_text
from runtime.plan.database import PlanDatabase
from runtime.plan.readout.readout import read
from runtime.user.constraint import Constraint
from runtime.user.library import Library, load_library

HEAD = "from runtime.user.constraint import Constraint, function, near\n"
TWICE = """
class Twice(Constraint):
    name = "twice"
    signature = "y:number x:number"
    meaning = "y is twice x"
    result = 0

    def propagate(self, view):
        return (
            view.raise_to(0, 2 * view.lower(1))
            and view.reduce_to(0, 2 * view.upper(1))
            and view.raise_to(1, view.lower(0) / 2)
            and view.reduce_to(1, view.upper(0) / 2)
        )

    def terms(self, arguments):
        return [("addEq", (arguments[1], arguments[1], arguments[0]))]


CONSTRAINTS = [Twice()]
"""


def written(folder: Path, text: str, name: str = "own.py") -> Path:
    """Write a module with constraints."""
    path = folder / name
    path.write_text(HEAD + dedent(text), encoding="utf-8")
    return path


def library(folder: Path, text: str) -> Library:
    """The constraints of a module."""
    return load_library(folder, [written(folder, text).name], ())


def database(text: str, own: Library) -> PlanDatabase:
    """A model after its script."""
    analysis = analyse_text("model.nddl", text, callables=own.callables)
    assert not analysis.has_errors, [each.message for each in analysis.diagnostics]
    made = PlanDatabase(compile_model(analysis), constraints=own.constraints)
    assert made.run_script() is None
    return made


def domains(text: str, own: Library) -> dict[str, str]:
    """The domains of a model's variables, and `consistent`."""
    found = read(database(text, own))
    told: dict[str, str] = found["domains"]
    return told | ({} if found["consistent"] else {"": "inconsistent"})


def only(constraints: Sequence[Constraint]) -> Constraint:
    """The one constraint of a module."""
    (constraint,) = constraints
    return constraint
