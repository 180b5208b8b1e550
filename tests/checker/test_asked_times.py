"""A time that was asked for leads to the lines by which the reactors came to ask that stand before in a chain."""

from pathlib import Path

import pytest

from checker.batch.worker import Task, fly_one
from checker.causes import failed_by
from checker.culprit import culprit_of
from checker.mission import read_mission
from checker.models import load_models
from checker.mutation.variant import load_over, open_over
from checker.proofs.conflict import Finding, confirm
from checker.proofs.places import text_of
from checker.sampling.seeds import mission_seed
from nddl_lang.text.read import real_path
from runtime.executive.events import single_events
from runtime.executive.outcome import ElementKind

UNSEEN = Path(__file__).resolve().parent / "unseen"

pytestmark = pytest.mark.once


@pytest.mark.parametrize(
    ("name", "file", "constant", "wanted", "number"),
    [
        ("crane", "foreman.nddl", "BAY_MAX", 180, 9),  # two planners: the other one gives up what was asked
        ("cablecar", "operator.nddl", "RIDE_MAX", 260, 2),  # refused by the world
    ],
)
def test_the_limit_of_who_asked_is_what_breaks(name: str, file: str, constant: str, wanted: int, number: int) -> None:
    mission, found = read_mission(UNSEEN / name / "mission.toml")
    assert mission is not None, found
    path = real_path(UNSEEN / name / file)
    given = next(line for line in path.read_text().splitlines() if line.startswith(f"int {constant} ="))
    overlay = ((str(path), path.read_text().replace(given, f"int {constant} = {wanted};")),)
    models = load_models(mission, open_over(overlay))
    task = Task(number, mission_seed(mission.check.seed, number))
    result = fly_one(load_over(overlay, models.agent), task, keep_trace=True)
    conflict = failed_by(result.outcome).conflict
    culprit = culprit_of(conflict)
    assert conflict is not None
    assert culprit.place is not None
    assert [one.text for one in (culprit.place, *culprit.limits)] == [
        f"duration <= {constant}",
        f"{constant} = {wanted}",
    ]
    assert result.outcome is not None
    conflicts = [conflict, *(one.conflict for one in single_events(result.outcome.events) if one.conflict is not None)]
    asked = [one for each in conflicts for one in each.elements if one.kind is ElementKind.REQUEST]
    assert any(one.says is not None and one.terms[0].name == "eq" for one in asked)  # as in the plan of who asked
    proved = confirm(conflict, text_of(models.agent, models.programs))
    assert (proved.finding, proved.is_minimal) == (Finding.CONFIRMED, True)
