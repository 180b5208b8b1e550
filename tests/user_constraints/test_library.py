"""Modules with constraints: what is taken from them, and what is refused with a sentence."""

from importlib.metadata import EntryPoint
from pathlib import Path

import pytest

from nddl_lang.analysis import analyse_text
from runtime.user.fault import UserCodeError
from runtime.user.library import load_library
from tests.user_constraints.own import TWICE, library, written

MINE = 'class Mine(Constraint):\n    name = "{}"\n    signature = "{}"\n    meaning = "mine"\n'
HOLDS = "    def holds(self, values):\n        return True\nCONSTRAINTS = [Mine()]\n"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (MINE.format("eq", "x:number") + HOLDS, "a constraint cannot be called `eq`: that is a built-in constraint"),
        (MINE.format("cos", "x:number") + HOLDS, "called `cos`: that is a built-in function"),
        (MINE.format("before", "x:number") + HOLDS, "called `before`: that is a temporal relation"),
        (MINE.format("goal", "x:number") + HOLDS, "called `goal`: that is a word of the language"),
        (MINE.format("a b", "x:number") + HOLDS, "`Mine` needs a `name` that can be written in a model, not 'a b'"),
        (MINE.format("mine", "x:colour") + HOLDS, 'the constraint `mine` needs a `signature` such as "x:number'),
        (MINE.format("mine", "x:token") + HOLDS, "cannot have an argument of the kind token (`x`)"),
        (MINE.format("mine", "") + HOLDS, "the constraint `mine` has no arguments"),
        (MINE.format("mine", "x:number") + "CONSTRAINTS = [Mine()]", "has neither `propagate` nor `holds`"),
        (
            MINE.format("mine", "x:number") + "CONSTRAINTS = [Mine]",
            "`CONSTRAINTS` has the class `Mine`; write `Mine()`",
        ),
        (
            MINE.format("mine", "x:number"),
            "no constraints; end it with a list such as `CONSTRAINTS = [MyConstraint()]`",
        ),
        (TWICE + "CONSTRAINTS *= 2", "there is a constraint `twice` already, in"),
        ("def", "own.py:2: the module cannot be loaded: SyntaxError"),
        ("import nowhere_to_be_found", "own.py:2: the module cannot be loaded: ModuleNotFoundError"),
        (TWICE + "Twice.files = ('chart.csv',)", "cannot read `chart.csv`, which `twice` names among its files"),
    ],
)
def test_what_is_no_constraint_is_refused(text: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(UserCodeError) as caught:
        library(tmp_path, text)
    assert said in str(caught.value)
    assert "own.py" in str(caught.value)


def test_the_language_knows_names_and_arguments(tmp_path: Path) -> None:
    own = library(tmp_path, TWICE)
    codes = [
        each.code.id
        for each in analyse_text("m.nddl", "twice(1);\nthrice(1, 2);\n", callables=own.callables).diagnostics
    ]
    assert codes == ["NDDL320", "NDDL208"]
    assert [each.code.id for each in analyse_text("m.nddl", "twice(1, 2);\n").diagnostics] == ["NDDL208"]


def test_texts_are_those_of_the_module_and_its_files(tmp_path: Path) -> None:
    (tmp_path / "chart.csv").write_text("1,2\n", encoding="utf-8")
    own = library(tmp_path, TWICE + "Twice.files = ('chart.csv',)\n")
    assert sorted(own.texts) == ["chart.csv", "own.py"]
    assert own.texts["chart.csv"] == "1,2\n"


def test_installed_packages_bring_constraints(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    written(tmp_path, TWICE, "harbour_rules.py")
    monkeypatch.syspath_prepend(tmp_path)
    points = [EntryPoint("harbour", "harbour_rules", "nddlc.constraints")]
    own = load_library(tmp_path, [], points)
    assert list(own.texts) == ["harbour:harbour_rules.py"]
    assert "twice" in own.callables.constraints
    with pytest.raises(UserCodeError, match=r"entry point `harbour` \(missing\) cannot be loaded"):
        load_library(tmp_path, [], [EntryPoint("harbour", "missing", "nddlc.constraints")])
