"""What the search learns is true of the model, and the store stays small."""

from itertools import product
from pathlib import Path
from random import Random

import pytest

from runtime.solver.learning import nogoods
from runtime.solver.search import Solver
from runtime.solver.tags import EXHAUSTED, PLAN, UNBOUND_VARIABLE
from tests.solver.planning import solver_for
from tests.solver.random_models import guards_model

COLOURS = 3


def colouring(seed: int, count: int) -> tuple[str, list[tuple[int, int]]]:
    """A map to colour: the model, and which countries touch."""
    random = Random(seed)
    pairs = [(i, j) for i in range(count) for j in range(i + 1, count) if random.random() < 0.55]
    lines = [f"int v{i} = [1 {COLOURS}];" for i in range(count)]
    return "\n".join([*lines, *(f"neq(v{i}, v{j});" for i, j in pairs)]) + "\n", pairs


def learned(solver: Solver) -> list[dict[int, int]]:
    """The nogoods over global variables, each as values by the variable's number."""
    names = {number: name for name, number in solver.nogoods.numbers.items()}
    found = []
    for one in solver.nogoods.sets:
        choices = [names[number] for number in one]
        assert all(kind == UNBOUND_VARIABLE for kind, _ in choices)
        found.append({solver.plan.variable_name[v]: value for _, (v, value) in choices})
    return found


def test_no_colouring_has_all_choices_of_a_nogood(tmp_path: Path) -> None:
    count, total = 7, 0
    for seed in range(40):
        text, pairs = colouring(seed, count)
        solver = solver_for(tmp_path, text)
        solutions = [
            values
            for values in product(range(1, COLOURS + 1), repeat=count)
            if all(values[i] != values[j] for i, j in pairs)
        ]
        assert solver.solve(10000, 2**60) == (PLAN if solutions else EXHAUSTED)
        for one in learned(solver):
            total += 1
            assert not any(all(values[v] == value for v, value in one.items()) for values in solutions), text
    assert total > 10


@pytest.mark.parametrize("seed", range(20))
def test_a_full_store_changes_no_verdict(tmp_path: Path, seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(nogoods, "_MOST", 4)
    solver = solver_for(tmp_path, guards_model(seed))
    small = solver.solve(20000, 2**60)
    assert len(solver.nogoods.sets) <= 4
    monkeypatch.setattr(nogoods, "_LONGEST", 0)
    without = solver_for(tmp_path, guards_model(seed))
    assert without.solve(20000, 2**60) == small
    assert not without.nogoods.sets


def test_what_is_learned_is_not_explored_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text, _ = colouring(3, 24)
    steps = []
    for longest in (24, 0):
        monkeypatch.setattr(nogoods, "_LONGEST", longest)
        solver = solver_for(tmp_path, text)
        solver.solve(20000, 2**60)
        steps.append(solver.steps)
    assert steps[0] <= steps[1]
