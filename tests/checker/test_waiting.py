"""The story of a goal that stayed open to the end tells what was waited for."""

from pathlib import Path

import pytest

from checker.batch.worker import Task, fly_one
from checker.mission import read_mission
from checker.models import load_models
from checker.mutation.variant import load_over, open_over
from checker.rendering import waiting_text
from checker.sampling.seeds import mission_seed
from checker.waiting import waited_for
from nddl_lang.text.read import real_path

MODEL = Path(__file__).resolve().parent / "unseen/papermill"

pytestmark = pytest.mark.once


def test_what_goes_on_is_told_through_all_planners_with_what_the_last_one_uses() -> None:
    mission, found = read_mission(MODEL / "mission.toml")
    assert mission is not None, found
    path = real_path(MODEL / "foreman.nddl")
    overlay = ((str(path), path.read_text().replace("full.end == end;", "")),)
    models = load_models(mission, open_over(overlay))
    task = Task(1, mission_seed(mission.check.seed, 1))
    result = fly_one(load_over(overlay, models.agent), task, keep_trace=True)
    assert result.outcome is not None
    assert [waiting_text(one) for one in waited_for(result.outcome, models.agent)] == [
        "Order on `sales`, asked for by the mission file at tick 0, goes on since tick 672",
        "Batch on `line`, asked for by office at tick 687, goes on since tick 688; of what foreman uses, "
        "`pulper` holds Empty since tick 727, `dryer` holds Cold since tick 797, `winder` holds Still since tick 835",
    ]
