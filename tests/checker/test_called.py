"""Constraints in Python in a conflict: z3 knows of them what calls have shown, and says so."""

from dataclasses import replace
from pathlib import Path

import pytest

from checker.proofs.conflict import Confirmation, Finding, confirm
from checker.proofs.places import ModelText
from checker.rendering import confirmation_text
from runtime.executive.outcome import Conflict
from runtime.executive.story import conflict_of
from runtime.executive.workbench import Workbench
from runtime.plan.readout.statements import Term
from tests.user_constraints.own import TWICE, database, library

SILENT = TWICE.replace("def terms", "def words")
ROOT = """
CONSTRAINTS = [function("root", "x:number", "float", lambda x: x ** 0.5 if x >= 0 else None, "the square root")]
"""
COLOUR = """
class Dark(Constraint):
    name = "dark"
    signature = "colour:any least:number"
    meaning = "the colour is dark"

    def holds(self, values):
        return values[0] == "BLACK" and values[1] >= 3


CONSTRAINTS = [Dark()]
"""


def told(folder: Path, model: str, module: str) -> tuple[Conflict, ModelText]:
    """The conflict of a model with a constraint of its own, and its text."""
    made = database(model, library(folder, module))
    conflict = conflict_of(Workbench(made, "reactor"))
    assert conflict is not None
    return conflict, ModelText({"reactor": made.program}, folder, ("own.py",))


def without_one(conflict: Conflict, text: ModelText, found: Confirmation) -> list[Finding]:
    """What z3 says of the core without each of its elements."""
    core = [conflict.elements[number] for number in found.core]
    return [confirm(Conflict(tuple(one for one in core if one is not dropped)), text).finding for dropped in core]


@pytest.mark.parametrize(
    ("model", "module", "name"),
    [
        ("int x = [1 10]; int y = [0 13]; y == 13; x >= 7; twice(y, x);", SILENT, "twice"),
        ("float x = [0.0 9.0]; float y; x == 9.0; y == root(x); y >= 4.5;", ROOT, "root"),
        ("enum Colour { RED, BLACK } Colour c; int k = [0 9]; c == BLACK; k == 2; dark(c, k);", COLOUR, "dark"),
    ],
)
def test_a_conflict_is_confirmed_but_for_what_was_called(tmp_path: Path, model: str, module: str, name: str) -> None:
    conflict, text = told(tmp_path, model, module)
    found = confirm(conflict, text)
    assert found.finding is Finding.CONFIRMED and not found.untranslated
    assert [one.name for one in found.called] == [name]
    assert found.called[0].calls > 0 and found.called[0].file.endswith("own.py")
    assert f"but for `{name}` ({found.called[0].file}:" in confirmation_text(found)
    if found.is_minimal:
        assert set(without_one(conflict, text, found)) == {Finding.REFUTED}


def test_what_the_constraint_takes_is_no_conflict(tmp_path: Path) -> None:
    conflict, text = told(tmp_path, "int x = [1 10]; int y = [0 13]; y == 13; x >= 7; twice(y, x);", SILENT)
    lie = [replace(one, terms=tuple(_even(term) for term in one.terms), place=None) for one in conflict.elements]
    assert confirm(Conflict(tuple(lie)), text).finding is Finding.REFUTED


def _even(term: Term) -> Term:
    """The same of 14 instead of 13, which is twice a whole number."""
    return replace(term, arguments=tuple(14 if one == 13 else one for one in term.arguments))


def test_a_constraint_that_raises_leaves_it_undecided(tmp_path: Path) -> None:
    conflict, text = told(tmp_path, "int x = [1 10]; int y = [0 13]; y == 13; x >= 7; twice(y, x);", SILENT)
    library(tmp_path, SILENT.replace("2 * view.lower(1)", "1 / 0"))
    assert confirm(conflict, text).finding is Finding.UNKNOWN
