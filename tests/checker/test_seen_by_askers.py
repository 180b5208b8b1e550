"""Who asks as late as what it had seen let it: the lines behind what it had seen are told by the conflict."""

from pathlib import Path

import pytest

from checker.batch.worker import fly_one
from checker.campaign import Campaign
from checker.causes import failed_by
from checker.counterfactual.candidates import candidates_of
from checker.counterfactual.dependence import Dependence
from checker.counterfactual.search import sites_in
from checker.culprit import own_elements
from checker.mission import read_mission
from checker.models import load_models
from checker.oracle import Verdict
from checker.pinned import pinned
from runtime.executive.outcome import ElementKind
from tests.checker.fault_study import faults_in, laid_out

pytestmark = pytest.mark.once

BEAM = Path(__file__).parent / "unseen" / "beam"
TURN_TOO_LONG, LINE = 6, 53  # the fault `slot.angle * turning` for a quotient


def test_the_line_behind_what_an_asker_waited_for_is_told(tmp_path: Path) -> None:
    place = laid_out(BEAM, list(faults_in(BEAM))[TURN_TOO_LONG], tmp_path / "beam")
    mission, _ = read_mission(place / "mission.toml")
    assert mission is not None
    models = load_models(mission)
    given = Campaign(mission, models, pinned(models))
    failed = fly_one(given.load(models.agent), given.task(1))
    assert failed.verdict is Verdict.FAIL and failed.outcome is not None
    conflict = failed_by(failed.outcome).conflict
    assert conflict is not None
    seen = [one for one in conflict.elements if one.kind is ElementKind.OBSERVATION]
    assert seen and not set(seen) & set(own_elements(conflict))
    programs = [models.programs[each.model] for each in models.agent.reactors]
    graph = Dependence(programs, sites_in(models.agent))
    found = candidates_of(failed.outcome, graph, Path(models.agent.root), coded=models.agent.coded)
    (line,) = [one for one in found if Path(one.site.file).name == "devices.nddl" and one.site.first == LINE]
    assert line.told > 0.0
