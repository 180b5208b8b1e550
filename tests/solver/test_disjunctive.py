"""Disjunctive overload check: tokens that need more time than a window has are refused together, and only those."""

from pathlib import Path

import pytest

from runtime.solver.learning.failure_log import FailureLog
from runtime.solver.learning.rendering import story
from runtime.solver.tags import EXHAUSTED, PLAN, RESULT_NAMES
from tests.solver.planning import solver_for
from tests.solver.random_models import rules_model, timelines_puzzle

LANE = "class Lane extends Timeline { predicate run { int n; } } Lane lane = new Lane(); close();"


def told(log: FailureLog) -> str:
    """Why there is no plan."""
    assert log.end is not None
    return "\n".join(story(log.end))


def runs(lengths: tuple[int, ...], end: int) -> str:
    """Goals of these lengths from 1 to `end`, none of which may merge."""
    text = LANE
    for i, length in enumerate(lengths):
        text += f"goal(lane.run g{i}); eq(g{i}.n, {i}); eq(g{i}.duration, {length});"
        text += f"leq(1, g{i}.start); leq(g{i}.end, {end});"
    return text


@pytest.mark.parametrize(("end", "wanted"), [(12, PLAN), (11, EXHAUSTED)])
def test_an_overload_is_one_conflict(tmp_path: Path, end: int, wanted: int) -> None:
    solver = solver_for(tmp_path, runs((4, 4, 3), end))
    log = FailureLog(solver.database, solver.agenda, solver.stack)
    solver.failure_log = log
    assert solver.solve(2000, 2**60) == wanted
    if wanted == EXHAUSTED:
        assert "lane needs 11 of 10 ticks available in [1, 11]" in told(log)
        assert solver.steps < 12


def test_the_longest_tokens_are_the_causes(tmp_path: Path) -> None:
    short = "".join(f"rejectable(lane.run r{i}); eq(r{i}.duration, 1); leq(1, r{i}.start);" for i in range(3))
    text = runs((6, 6), 12).replace(LANE, LANE + short)
    solver = solver_for(tmp_path, text)
    log = FailureLog(solver.database, solver.agenda, solver.stack)
    solver.failure_log = log
    assert solver.solve(20000, 2**60) == EXHAUSTED
    assert "lane needs 12 of 11 ticks available in [1, 12]: " in told(log)


def test_tokens_outside_the_horizon_take_no_time(tmp_path: Path) -> None:
    text = runs((4, 4, 3), 11)
    for horizon, wanted in (((0, 100), EXHAUSTED), ((20, 100), PLAN)):
        solver = solver_for(tmp_path, text, horizon=horizon)
        solver.refresh()
        solver.check_overload()
        assert solver.solve(2000, 2**60) == wanted


@pytest.mark.parametrize("seed", range(60))
def test_overload_checks_change_no_verdict(tmp_path: Path, seed: int) -> None:
    puzzle = timelines_puzzle(seed)
    solver = solver_for(tmp_path, puzzle.text)
    solver.refresh()
    solver.check_overload()
    assert RESULT_NAMES[solver.solve(20000, 2**60)] == ("plan" if puzzle.has_plan else "exhausted"), puzzle.text
    text = rules_model(seed)
    plain = solver_for(tmp_path, text, europa=True).solve(3000, 2**60)
    solver = solver_for(tmp_path, text)
    solver.refresh()
    solver.check_overload()
    assert RESULT_NAMES[plain] == "timeout" or solver.solve(20000, 2**60) == plain, text
