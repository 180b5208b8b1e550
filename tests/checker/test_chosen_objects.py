"""The line that chooses the object on which a rule asks for a token bears on that token."""

from pathlib import Path

import pytest

from checker.counterfactual.dependence import Dependence
from checker.counterfactual.search import sites_in
from checker.mission import read_mission
from checker.models import load_models

pytestmark = pytest.mark.once

LABORATORY = Path(__file__).parent / "unseen" / "wetlab"


@pytest.mark.parametrize(("rule", "choice"), [("Job.Urgent", "device.quick == true;")])
def test_what_chooses_an_object_is_near_to_what_is_asked_for_on_it(rule: str, choice: str) -> None:
    mission, _ = read_mission(LABORATORY / "mission.toml")
    assert mission is not None
    models = load_models(mission)
    sites = sites_in(models.agent)
    graph = Dependence([models.programs[one.model] for one in models.agent.reactors], sites)
    asking, choosing = (
        next(number for number, site in enumerate(sites) if site.rule == rule and site.text == text)
        for text in ("contains(device.Run run);", choice)
    )
    assert graph.distances({asking: 0.0})[choosing] < 2.0
