"""Whatever becomes of a model by mistake, the whole tool answers: no crash, no hang, no contradiction.

NDDLC_FUZZ sets how many mutants are tried: `NDDLC_FUZZ=1000000 pytest tests/cli/test_mutants.py`.
"""

import os
import random
import time

import pytest

from compiler.lower import compile_model
from nddl_lang.analysis import analyse_text
from nddl_lang.lint.linter import lint
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.text.render import render
from runtime.plan.database import PlanDatabase
from runtime.plan.readout.readout import read
from runtime.solver.configuration.configuration import default_configuration
from runtime.solver.search import Solver
from runtime.solver.tags import PLAN, TIMEOUT
from tests.cli.mutants import mutant
from tests.syntax.corpus import texts

MUTANTS = int(os.environ.get("NDDLC_FUZZ", "4000")) // 20
PARTS = 4
MOST_SECONDS = 10.0  # of CPU time for one mutant; the slowest takes a tenth of it
MOST_STEPS = 60


@pytest.mark.parametrize("part", range(PARTS))
def test_mutants_are_answered(part: int) -> None:
    for seed in range(part, MUTANTS, PARTS):
        chance = random.Random(seed)
        text = mutant(chance.choice(texts()), chance)
        dialect = chance.choice(list(Dialect))
        begun = time.process_time()
        try:
            answer(text, dialect)
        except BaseException:
            print(f"seed {seed}, {dialect}:\n{text}")
            raise
        assert time.process_time() - begun < MOST_SECONDS, f"seed {seed}, {dialect}:\n{text}"


def answer(text: str, dialect: Dialect) -> None:
    """Lint, load, read out and plan by both strategies, which must not contradict each other."""
    analysis = analyse_text("t.nddl", text, dialect)
    for complaint in lint(analysis):
        assert render(complaint)
    if analysis.has_errors:
        return
    verdicts = set()
    for europa in (False, True):
        database = PlanDatabase(compile_model(analysis))
        if database.run_script() is not None:
            return
        was_consistent = read(database)["consistent"]
        solver = Solver(database, default_configuration(), 0, 100, europa)
        result = solver.solve(MOST_STEPS, 10**6, lambda: False)
        facts = read(database)
        if result == PLAN:
            assert was_consistent and facts["consistent"]
        verdicts.add(result)
    assert len(verdicts - {TIMEOUT}) <= 1, verdicts
