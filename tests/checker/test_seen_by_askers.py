"""Who asks as late as what it had seen let it: the lines behind what it had seen are told by the conflict."""

from pathlib import Path

import pytest

from checker.causes import failed_by
from checker.counterfactual.candidates import candidates_of
from checker.counterfactual.dependence import Dependence
from checker.counterfactual.search import sites_in
from checker.culprit import own_elements
from runtime.executive.outcome import ElementKind
from tests.checker.fault_study import faults_in, laid_out
from tests.checker.told_steps import failed_mission

pytestmark = pytest.mark.once

BEAM = Path(__file__).parent / "unseen" / "beam"
TURN_TOO_LONG, LINE = 6, 53  # the fault `slot.angle * turning` for a quotient


def test_the_line_behind_what_an_asker_waited_for_is_told(tmp_path: Path) -> None:
    place = laid_out(BEAM, list(faults_in(BEAM))[TURN_TOO_LONG], tmp_path / "beam")
    given, failed = failed_mission(place, 1)
    assert failed.outcome is not None
    models = given.models
    conflict = failed_by(failed.outcome).conflict
    assert conflict is not None
    seen = [one for one in conflict.elements if one.kind is ElementKind.OBSERVATION]
    assert seen and not set(seen) & set(own_elements(conflict))
    programs = [models.programs[each.model] for each in models.agent.reactors]
    graph = Dependence(programs, sites_in(models.agent))
    found = candidates_of(failed.outcome, graph, Path(models.agent.root), coded=models.agent.coded)
    (line,) = [one for one in found if Path(one.site.file).name == "devices.nddl" and one.site.first == LINE]
    assert line.told > 0.0
