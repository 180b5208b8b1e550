"""A search with restarts has the same verdict as one without, and finds hidden contradictions sooner."""

from collections.abc import Callable
from pathlib import Path

import pytest

from bench.hard_models import model
from runtime.solver.configuration.configuration import Configuration, default_configuration
from runtime.solver.learning.failure_log import FailureLog
from runtime.solver.search import Solver
from runtime.solver.tags import EXHAUSTED, PLAN, RESULT_NAMES
from tests.solver.planning import resources_configuration, solver_for
from tests.solver.random_models import guards_model, loops_model, rules_model, uses_model, variables_puzzle

NEVER = 10**12
CLASSES = """
    class B extends Timeline { predicate p { } }
    class C extends B { }
    class T extends Timeline { predicate q { int x; } }
"""


def restless(folder: Path, text: str, how: Configuration | None = None) -> Solver:
    """A solver that restarts after two failures, then after three, and so on."""
    solver = solver_for(folder, text, how=how)
    solver.refresh()
    solver.agenda.restarts.limit = 2
    return solver


def solved(solver: Solver, most: int = 20000) -> str:
    """What the search says."""
    return RESULT_NAMES[solver.solve(most, 2**60)]


@pytest.mark.parametrize("seed", range(40))
@pytest.mark.parametrize("write", [guards_model, rules_model, uses_model, loops_model])
def test_restarts_change_no_verdict(tmp_path: Path, write: Callable[[int], str], seed: int) -> None:
    text = write(seed)
    for how in (default_configuration(), resources_configuration()):
        plain = solved(solver_for(tmp_path, text, europa=True, how=how), 3000)
        assert plain == "timeout" or solved(restless(tmp_path, text, how)) == plain, text


def test_restarts_change_no_verdict_of_variables(tmp_path: Path) -> None:
    restarts = 0
    for seed in range(150):
        puzzle = variables_puzzle(seed)
        solver = restless(tmp_path, puzzle.text)
        assert solved(solver) == ("plan" if puzzle.has_plan else "exhausted"), puzzle.text
        restarts += solver.agenda.restarts.count
    assert restarts


@pytest.mark.parametrize(("feasible", "wanted"), [(True, PLAN), pytest.param(False, EXHAUSTED, marks=pytest.mark.once)])
def test_what_is_hard_is_found_behind_what_is_easy(tmp_path: Path, feasible: bool, wanted: int) -> None:
    text = model("knot", 6, feasible)
    solver = solver_for(tmp_path, text)
    assert solver.solve(2**62, 2**62) == wanted
    steady = solver_for(tmp_path, text)
    steady.refresh()
    steady.agenda.restarts.limit = NEVER
    steady.solve(10 * solver.steps, 2**62)
    assert steady.steps == solver.steps if feasible else steady.steps >= 10 * solver.steps


def test_runs_grow_and_begin_from_the_root(tmp_path: Path) -> None:
    solver = restless(tmp_path, model("knot", 3, False))
    weights, limits, depths = solver.agenda.restarts, [2], []
    while solver.step() not in (PLAN, EXHAUSTED):
        if weights.limit != limits[-1]:
            limits.append(weights.limit)
            depths.append(solver.depth)
    assert len(limits) > 3
    assert limits == sorted(set(limits))
    assert max(depths) <= 1  # one decision has been made since
    assert solver.is_exhausted


@pytest.mark.parametrize(
    ("text", "free"),
    [
        ("T::q { if (x == 1) { duration <= 3; } }", True),
        ("T::q { if (x == 1) { any(T.q other); } }", True),
        ("T::q { any(C.p other); }", True),
        ("T::q { if (x == 1) { any(C.p other); } }", False),
        ("T::q { if (x == 1) { starts(Reservoir.produce more); } }", False),
        ("T::q { if (x == 1) { starts(Reusable.uses use); } }", True),
        ("T::q { if (x == 1) { if (x == 1) { } else { starts(Reservoir.consume less); } } }", False),
        ("T::q { foreach (o in object) { any(o.q other); } }", False),
    ],
)
def test_variables_keep_their_order_where_it_may_matter(tmp_path: Path, text: str, free: bool) -> None:
    made = (
        "T t = new T(); C c = new C(); Reservoir v = new Reservoir(1.0, 0.0, 2.0); Reusable r = new Reusable(1.0, 0.0);"
    )
    whole = f"{CLASSES} {made} {text} close();"
    assert solver_for(tmp_path, whole).may_restart == free
    assert not solver_for(tmp_path, whole, europa=True).may_restart


def test_a_failure_log_is_of_one_run(tmp_path: Path) -> None:
    solver = restless(tmp_path, model("knot", 2, False))
    solver.failure_log = FailureLog(solver.database, solver.agenda, solver.stack)
    assert solved(solver) == "exhausted"
    assert solver.agenda.restarts.count == 0
