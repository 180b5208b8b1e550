"""Of a flight that a variant fails, one of the first three causes is the line that was put in (trex.md 4, row 37)."""

import os
from dataclasses import replace
from pathlib import Path

import pytest

from checker.counterfactual.effort import Bounds
from checker.counterfactual.missions import Missions
from checker.counterfactual.search import CauseSearch, Suspended
from checker.mission import read_mission
from checker.models import load_models
from checker.yardstick import open_flyer
from tests.models.bug_variants import Variant, apply
from tests.models.test_variants import NOMINAL, VARIANTS

pytestmark = pytest.mark.once

# `make variants` has all eight; here is one that is quick to explain.
SHOWN = ("B3",) if os.environ.get("NDDLC_VARIANTS") is None else tuple(one.name for one in VARIANTS)
FIRST = 3


def put_in(variant: Variant) -> set[str]:
    """The statements of a variant that the model without the mistake does not have, or has otherwise."""
    found: set[str] = set()
    for _, old, new in variant.edits:
        before = {line.strip() for line in old.splitlines()}
        found |= {line.strip().rstrip("{ ") for line in new.splitlines() if line.strip() not in before}
    return found


@pytest.mark.parametrize("variant", [one for one in VARIANTS if one.name in SHOWN], ids=lambda one: one.name)
def test_the_line_that_was_put_in_is_among_the_first_causes(variant: Variant, tmp_path: Path) -> None:
    mission, _ = read_mission(apply(variant, tmp_path))
    assert mission is not None
    models, case = load_models(mission), variant.fails[0]
    if case.seed is None:
        values = NOMINAL | case.values
        parameters = [
            replace(each, distribution="fixed", values=(values[each.name],), mode="inter")
            for each in models.agent.parameters
        ]
    else:
        parameters = [replace(each, mode="intra") for each in models.agent.parameters]
    agent = replace(models.agent, parameters=tuple(parameters))
    with open_flyer(mission, models) as flyer:
        failed = flyer.fly(agent, 1, case.seed or 1)
        assert failed.verdict.value == "FAIL"
        programs = [models.programs[each.model] for each in agent.reactors]
        world = Suspended(agent, programs, mission.check.limits, flyer, (), mission)
        causes = CauseSearch(world, Bounds(20, 100.0)).causes(Missions([failed], []))
    named = [cause.place.text.rstrip("; ") for cause in causes.ranked[:FIRST]]
    changed = put_in(variant)
    is_coded = variant.edits[0][0].endswith(".py")  # the line that calls it is the nearest that a model has
    assert any(
        (one and one in line) or (is_coded and cause.claim.value == "coded")
        for one, cause in zip(named, causes.ranked, strict=False)
        for line in changed
    ), named
