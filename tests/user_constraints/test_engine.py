"""Constraints written in Python narrow, refuse, fail and explain like built-in ones."""

from pathlib import Path

import pytest

from checker.proofs.conflict import Finding, confirm
from runtime.constraints.explanation.cause import CauseKind
from runtime.constraints.minimisation.minimise import minimise
from runtime.executive.rendering import element_text
from runtime.executive.story import conflict_of
from runtime.executive.workbench import Workbench
from runtime.user.fault import UserCodeError
from tests.user_constraints.own import TWICE, database, domains, library

ODD = """
class Odd(Constraint):
    name = "odd"
    signature = "x:number"
    meaning = "x is odd"

    def holds(self, values):
        return values[0] % 2 == 1


CONSTRAINTS = [Odd()]
"""
CALM = """
class Calm(Constraint):
    name = "calm"
    signature = "sea:any port:object night:bool label:string"
    meaning = "one may leave the port"

    def propagate(self, view):
        if view.values(1) is not None:
            assert all(isinstance(each, str) for each in view.values(1))
        return view.keep(0, ["GLASSY", "RIPPLED"]) and view.remove(0, "RIPPLED") and view.fix(2, True)

    def holds(self, values):
        return values[1:] == ["home", True, "late"]


CONSTRAINTS = [Calm()]
"""


def test_bounds_follow_both_ways(tmp_path: Path) -> None:
    found = domains("int x = [1 10]; int y = [0 13]; twice(y, x);", library(tmp_path, TWICE))
    assert found == {"x": "[1, 6] int", "y": "[2, 12] int"}


def test_a_test_alone_refuses_wrong_values(tmp_path: Path) -> None:
    own = library(tmp_path, ODD)
    assert "" not in domains("int x = 3; odd(x); odd(5);", own)
    assert domains("int x = 4; odd(x);", own)[""] == "inconsistent"


def test_a_function_is_computed_once_its_arguments_are_known(tmp_path: Path) -> None:
    text = 'CONSTRAINTS = [function("root", "x:number", "float", lambda x: x**0.5 if x >= 0 else None, "the root")]'
    own = library(tmp_path, text)
    assert domains("float x = 9.0; float y; y == root(x);", own)["y"] == "{3.0} float"
    assert domains("float y; root(y, 16.0);", own)["y"] == "{4.0} float"
    assert domains("float x = [1.0 4.0]; float y = [0.0 9.0]; y == root(x);", own)["y"] == "[0.0, 9.0] float"
    assert domains("float y; y == root(-1.0);", own)[""] == "inconsistent"


def test_names_are_texts(tmp_path: Path) -> None:
    own = library(tmp_path, CALM)
    text = """enum Sea { GLASSY, RIPPLED, ROUGH }
    class Port { }
    Port home = new Port(); Port far = new Port(); close();
    Sea sea; bool night;
    """
    found = domains(f'{text} calm(sea, home, night, "late");', own)
    assert (found["sea"], found["night"]) == ("{GLASSY} Sea", "{true} bool")
    assert domains(f'{text} calm(sea, far, night, "late");', own)[""] == "inconsistent"
    assert domains(f'{text} calm(sea, home, night, "early");', own)[""] == "inconsistent"


def test_a_rule_posts_it_for_each_token_and_a_conflict_names_its_line(tmp_path: Path) -> None:
    own = library(tmp_path, TWICE)
    text = """class A extends Timeline { predicate P { int d; twice(d, duration); neq(d, 3); } }
    A a = new A(); close();
    goal(a.P p);
    p.duration <= 9;
    p.d == 30;
    """
    made = database(text, own)
    assert not made.is_consistent
    causes = minimise(made.engine, made.engine.explain())
    lines = [made.code.spans[cause.span].text for cause in causes if cause.kind is CauseKind.CONSTRAINT]
    assert "twice(d, duration);" in lines
    assert "neq(d, 3);" not in lines


@pytest.mark.parametrize(
    ("body", "said"),
    [
        (
            "return 1 / 0 > view.lower(0)",
            "own.py:7: `propagate` of the constraint `bad`, called at model.nddl:1, failed: ZeroDivisionError",
        ),
        ("view.raise_to(0, 1)", "it returned None instead of True or False"),
        (
            "return view.raise_to(0, float('nan'))",
            "own.py:7: `propagate` of the constraint `bad`, called at model.nddl:1, failed: ValueError: nan",
        ),
        ("return view.raise_to(3, 0)", "IndexError: there is no argument 3; there are 1"),
        (
            "raise SystemExit",
            "own.py:7: `propagate` of the constraint `bad`, called at model.nddl:1, failed: SystemExit",
        ),
    ],
)
def test_what_goes_wrong_in_it_names_file_and_line(body: str, said: str, tmp_path: Path) -> None:
    text = f"""
class Bad(Constraint):
    name = "bad"
    signature = "x:number"
    meaning = "it fails"
    def propagate(self, view):{chr(10)}        {body}
CONSTRAINTS = [Bad()]
"""
    own = library(tmp_path, text.replace("\nclass Bad", "class Bad", 1))
    with pytest.raises(UserCodeError) as caught:
        database("int x = [0 9]; bad(x);", own)
    assert said in str(caught.value)
    assert "Traceback" in caught.value.detail


def test_z3_names_what_it_was_not_told_and_believes_terms(tmp_path: Path) -> None:
    text = "int x = [1 10]; int y = [0 13]; y == 13; x >= 7; twice(y, x);"
    told = conflict_of(Workbench(database(text, library(tmp_path, TWICE)), "reactor"))
    assert told is not None
    assert confirm(told).finding is Finding.CONFIRMED
    assert confirm(told).untranslated == ()
    silent = TWICE.replace("def terms", "def words")
    told = conflict_of(Workbench(database(text, library(tmp_path, silent)), "reactor"))
    assert told is not None
    assert confirm(told).untranslated == ("twice",)
    assert "twice(y, x)" in [element_text(element) for element in told.elements]


@pytest.mark.parametrize(
    ("kind", "body"),
    [
        ("int", "return view.raise_to(0, view.lower(0) + 1)"),
        ("float", "return view.raise_to(0, view.lower(0) + 0.001)"),
        ("float", "return view.reduce_to(0, view.lower(0) + (view.upper(0) - view.lower(0)) * 0.999)"),
    ],
)
def test_one_that_narrows_without_end_is_left_alone(kind: str, body: str, tmp_path: Path) -> None:
    text = f"""
class Creeping(Constraint):
    name = "creeping"
    signature = "x:number"
    meaning = "it never is content"
    runs = 0
    def propagate(self, view):
        Creeping.runs += 1
        assert Creeping.runs < 20000
        {body}
CONSTRAINTS = [Creeping()]
"""
    own = library(tmp_path, text.lstrip())
    end = "1000000000" if kind == "int" else "1000000000.0"
    database(f"{kind} x = [{end[:0]}0{'' if kind == 'int' else '.0'} {end}]; creeping(x);", own)


def test_one_that_widens_changes_nothing(tmp_path: Path) -> None:
    text = """
class Wide(Constraint):
    name = "wide"
    signature = "x:number"
    meaning = "it asks for less than is known"
    def propagate(self, view):
        return view.raise_to(0, -100) and view.reduce_to(0, 100) and view.keep(0, range(-50, 50))
CONSTRAINTS = [Wide()]
"""
    assert domains("int x = [2 7]; wide(x);", library(tmp_path, text.lstrip())) == {"x": "[2, 7] int"}


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("return view.raise_to(0, 'high')", "ValueError"),
        ("return view.raise_to(0, None)", "TypeError"),
        ("return view.fix(0, 'high')", "TypeError"),
        ("return self.propagate(view)", "RecursionError"),
        ("view.count = 9; return view.lower(5) > 0", "IndexError"),
        ("raise KeyboardInterrupt('no')", "KeyboardInterrupt"),
    ],
)
def test_nonsense_becomes_one_message(body: str, said: str, tmp_path: Path) -> None:
    text = f"""
class Bad(Constraint):
    name = "bad"
    signature = "x:number"
    meaning = "it answers nonsense"
    def propagate(self, view):
        {body}
CONSTRAINTS = [Bad()]
"""
    own = library(tmp_path, text.lstrip())
    with pytest.raises((UserCodeError, KeyboardInterrupt)) as caught:
        database("int x = [0 9]; bad(x);", own)
    assert said in f"{type(caught.value).__name__}: {caught.value}"
