"""Verdicts against trying everything, and of the two strategies against each other."""

from pathlib import Path

import pytest

from tests.solver.planning import verdict
from tests.solver.random_models import rules_model, timelines_puzzle, variables_puzzle


@pytest.mark.parametrize("seed", range(60))
def test_variables_get_values_where_values_exist(tmp_path: Path, seed: int) -> None:
    puzzle = variables_puzzle(seed)
    wanted = "plan" if puzzle.has_plan else "exhausted"
    assert verdict(tmp_path, puzzle.text) == wanted, puzzle.text
    assert verdict(tmp_path, puzzle.text, europa=True) == wanted, puzzle.text


@pytest.mark.parametrize("seed", range(60))
def test_tokens_get_places_where_places_exist(tmp_path: Path, seed: int) -> None:
    puzzle = timelines_puzzle(seed)
    assert verdict(tmp_path, puzzle.text) == ("plan" if puzzle.has_plan else "exhausted"), puzzle.text


@pytest.mark.parametrize("seed", range(60))
def test_backjumping_changes_no_verdict(tmp_path: Path, seed: int) -> None:
    text = rules_model(seed)
    plain = verdict(tmp_path, text, europa=True)
    learned = verdict(tmp_path, text)
    assert plain == "timeout" or learned == plain, text
