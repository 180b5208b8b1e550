"""Hold nddlc against both judges on a random model: the verdict of each strategy, and each plan that it finds."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from runtime.plan.readout.readout import read
from runtime.solver.configuration.configuration import Configuration
from runtime.solver.tags import RESULT_NAMES
from tests.solver.planning import resources_configuration, solver_for
from tests.solver.whole.existence import has_plan
from tests.solver.whole.model import RESOURCES, Model, written
from tests.solver.whole.plan_judge import judge_plan
from tests.solver.whole.random_whole import random_whole

HORIZON = (-10, 1000)
MOST_STEPS = 3000
Facts = dict[str, Any]


@dataclass
class Tally:
    """How many verdicts there were, over both strategies."""

    plans: int = 0
    exhausted: int = 0
    timeouts: int = 0
    too_large: int = 0
    tokens: int = 0


def configured(model: Model, seed: int) -> Configuration | None:
    """How the search treats resources; without being told it orders the uses of a Unary as a timeline."""
    used = {thing.class_name for thing in model.things} & set(RESOURCES)
    return resources_configuration() if used - {"Unary"} or (used and seed % 2) else None


def planned(folder: Path, model: Model, europa: bool, seed: int = 1) -> tuple[str, Facts]:
    """The verdict of nddlc, and what `nddlc plan --json` tells of the final state."""
    solver = solver_for(folder, written(model), europa=europa, horizon=HORIZON, how=configured(model, seed))
    result = RESULT_NAMES[solver.solve(MOST_STEPS, 2**60)]
    return result, read(solver.database)


def judge_model(folder: Path, seed: int, tally: Tally) -> None:
    """Raise if nddlc and a judge differ on the model of that seed; every third has resources."""
    model = random_whole(seed, with_resources=seed % 3 == 2)
    exists = has_plan(model)
    tally.too_large += exists is None
    for europa in (False, True):
        result, told = planned(folder, model, europa, seed)
        if result == "timeout":
            tally.timeouts += 1
            continue
        assert exists is None or exists == (result == "plan"), f"{result}, europa={europa}, though exists={exists}"
        if result == "plan":
            tally.plans += 1
            tally.tokens += sum(token["state"] == "ACTIVE" for token in told["tokens"])
            judge_plan(model, told, HORIZON)
        else:
            tally.exhausted += 1
