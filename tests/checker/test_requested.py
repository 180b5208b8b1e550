"""An argument that was asked for leads to the lines that asked, whatever the requested token is merged with."""

from functools import partial
from pathlib import Path

import pytest

from checker.causes import failed_by
from checker.coverage import branches_taken
from checker.mission import read_mission
from checker.models import load_models
from checker.mutation.variant import load_over, open_over
from checker.proofs.places import text_of
from checker.requested import lines_that_ask
from checker.sampling.seeds import mission_seed
from checker.yardstick import open_flyer
from nddl_lang.text.read import real_path
from runtime.executive.outcome import ElementKind

ROOT = Path(__file__).resolve().parents[2]
TEMPLATE = ROOT / "models" / "templates" / "survey"

pytestmark = pytest.mark.once


BRANCHES = """if (length >= 0.0) {
        drive.distance == length + length;
    } else {
        drive.distance == length;
    }"""


# What they ask for is not what was asked for here, so that they did not ask.
OTHERS = """float FAR = 777.5;
Survey::Far { contains(Thruster.Drive drive); drive.distance == FAR; }
Survey::Home { contains(Thruster.Drive drive); drive.distance == 10.0; }
"""


# What goes on from the argument does not say what it is.
USES = """drive.distance == length + length;
    float used, more; used == drive.distance * 2.0; more == used + 1.0;"""


@pytest.mark.parametrize("asking", ["drive.distance == length + length;", BRANCHES, USES])
def test_the_line_of_the_planner_is_told_that_asked_a_simulator_for_too_much(asking: str) -> None:
    mission, found = read_mission(TEMPLATE / "mission.toml")
    assert mission is not None, found
    path = real_path(TEMPLATE / "planner.nddl")
    text = path.read_text()
    others = text.replace("drive.distance == length;", asking).replace("Survey survey =", OTHERS + "Survey survey =")
    overlay = ((str(path), others.replace("predicate Leg ", "predicate Home { } predicate Far { } predicate Leg ")),)
    models = load_models(mission, open_over(overlay))
    with open_flyer(mission, models) as flyer:
        result = flyer.fly(models.agent, 1, mission_seed(mission.check.seed, 1), partial(load_over, overlay))
    conflict = failed_by(result.outcome).conflict
    assert conflict is not None
    # The sonar's own rule has a child with which the requested token is merged.
    terms = [(one, one.terms[0]) for one in conflict.elements if len(one.terms) == 1]
    (element,) = [one for one, term in terms if term.name == "bounds" and one.variables[0].name == "distance"]
    assert element.kind is ElementKind.REQUEST
    programs = text_of(models.agent, models.programs).programs
    assert result.outcome is not None
    in_order = [models.programs[each.model] for each in models.agent.reactors]
    taken = branches_taken(in_order, result.outcome.behaviour)
    lines = lines_that_ask(element, programs, Path(models.agent.root), {"Leg", "Drive", "Scan", "Far", "Home"}, taken)
    line = text[: text.index("drive.distance")].count("\n") + 1 + (asking is BRANCHES)
    assert [(one.rule, one.place.file, one.place.line) for one in lines] == [("Survey.Leg", "planner.nddl", line)]
    assert lines_that_ask(element, programs, Path(models.agent.root), ()) == ()
    # A branch that some token of the mission took is not that of the token which asked.
    held = {"Leg", "Drive", "Scan"}
    assert lines_that_ask(element, programs, Path(models.agent.root), held, None, result.outcome.events) == lines
