"""A solver that takes its agenda up again finds what it would find if it gathered all flaws anew."""

from pathlib import Path

import pytest

from runtime.solver.flaws.filters import PlanningScope
from runtime.solver.search import Solver
from runtime.solver.tags import PLAN
from tests.solver.planning import solver_for

MODEL = """
class Lamp extends Timeline { predicate On { int n; int m; } predicate Off { } }
Lamp::On { eq(duration, 3); leq(1, n); leq(n, 3); leq(1, m); leq(m, 2); meets(Off rest); }
Lamp::Off { eq(duration, 2); }
Lamp a = new Lamp(); Lamp b = new Lamp();
close();
goal(Lamp.On first); leq(10, first.start); leq(first.end, 30);
goal(Lamp.On second); leq(10, second.start); leq(second.end, 30);
goal(Lamp.On third); leq(10, third.start); leq(third.end, 30);
"""


class Window(PlanningScope):
    """What is in scope: nothing, or all."""

    def __init__(self) -> None:
        self.is_open = False

    def admits_token(self, t: int) -> bool:
        """Whether the flaws of a token are to be mended."""
        return self.is_open

    def admits_variable(self, v: int) -> bool:
        """Whether a variable is to be decided."""
        return self.is_open


def steps(solver: Solver) -> list[tuple[int, ...]]:
    """The decisions that lead to a plan, each with the flaw and the state of all tokens after it."""
    made = []
    while solver.step() != PLAN:
        d = solver.depth - 1
        rows = solver.plan.rows
        states = [int(rows.status[t]) for t in range(rows.token_count)]
        made.append((int(solver.stack.kind[d]), int(solver.stack.item[d]), *states))
    return made


@pytest.mark.parametrize("again", ["refresh", "resume"])
def test_a_window_that_opens_shows_all_flaws(tmp_path: Path, again: str) -> None:
    solver = solver_for(tmp_path, MODEL)
    window = Window()
    solver.set_scope(window)
    solver.refresh()
    assert solver.step() == PLAN
    window.is_open = True
    getattr(solver, again)()
    fresh = solver_for(tmp_path, MODEL)
    found = steps(solver)
    assert len(found) > 6
    assert found == steps(fresh)


def test_every_parameter_of_a_token_with_many_is_decided(tmp_path: Path) -> None:
    names = [f"p{k}" for k in range(70)]
    parameters = " ".join(f"int {name};" for name in names)
    ranges = " ".join(f"leq(1, {name}); leq({name}, 2);" for name in names)
    text = (
        f"class Lamp extends Timeline {{ predicate On {{ {parameters} }} }} Lamp::On {{ eq(duration, 3); {ranges} }}"
        "Lamp a = new Lamp(); close(); fact(Lamp.On one); eq(one.start, 10); one.activate();"
    )
    solver = solver_for(tmp_path, text)
    assert solver.solve(200, 200) == PLAN
    rows, engine = solver.plan.rows, solver.engine
    first = int(rows.var0[0])
    assert all(engine.is_singleton(v) for v in range(first, first + int(rows.width[0])))
