"""The page on constraints tells the truth: its tables are those of the language, its examples run."""

import re
from pathlib import Path

import runtime.build_form
from compiler.lower import compile_model
from nddl_lang.analysis import analyse_text
from runtime.plan.database import PlanDatabase
from runtime.user.library import load_library
from tests.docs.constraint_tables import BEGIN, PAGE, tables

PYTHON = re.findall(r"^```python\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.M | re.S)


def test_the_tables_are_those_of_the_language() -> None:
    _, found, below = PAGE.read_text(encoding="utf-8").partition(BEGIN)
    assert found
    assert below == tables(), "write them anew: python -m tests.docs.constraint_tables"


def test_the_first_example_is_a_module_with_constraints(tmp_path: Path) -> None:
    (tmp_path / "safety.py").write_text(PYTHON[0], encoding="utf-8")
    library = load_library(tmp_path, ["safety.py"], ())
    text = "float s = [0.0 20.0]; float d = [0.0 9.0]; stops_within(d, s); float k; k == knots(5.0);"
    analysis = analyse_text("model.nddl", text, callables=library.callables)
    assert analysis.diagnostics == ()
    database = PlanDatabase(compile_model(analysis), constraints=library.constraints)
    assert database.run_script() is None
    s, _, k = (database.plan.globals[number] for number in (0, 1, 2))
    assert database.engine.upper(s) <= 6.01
    assert abs(database.engine.lower(k) - 9.71922) < 1e-4


def test_the_example_of_a_test_passes(tmp_path: Path) -> None:
    (tmp_path / "safety.py").write_text(PYTHON[0], encoding="utf-8")
    names: dict[str, object] = {"__file__": str(tmp_path / "test_safety.py")}
    exec(PYTHON[1], names)
    tests = [value for name, value in names.items() if name.startswith("test_") and callable(value)]
    assert tests
    for test in tests:
        test()
