"""What was given no value is named where it is declared: a constant, or a local variable that lines read."""

from pathlib import Path

import pytest

from checker.counterfactual.candidates import Candidate, Suspicion
from checker.counterfactual.dependence import Dependence
from checker.counterfactual.loose_ends import loose_ends
from checker.counterfactual.usage import usage_of
from checker.mutation.edits import sites_of
from checker.mutation.variant import load_graph

pytestmark = pytest.mark.once

MODEL = """int LONG;
int SHORT;
int NEVER;
float GIVEN = 3.0;
SHORT = 3;
class T extends Timeline { predicate P { } }
T::P { duration <= LONG; duration >= SHORT; start >= GIVEN; }
"""


def test_a_constant_without_a_value_is_named_where_it_is_declared(tmp_path: Path) -> None:
    (tmp_path / "m.nddl").write_text(MODEL, encoding="utf-8")
    sites = sites_of(load_graph(tmp_path / "m.nddl", ()))
    candidates = [Candidate(site, 0.25, Suspicion.CONFLICT) for site in sites]
    found = loose_ends(Dependence((), sites), candidates, usage_of(sites))
    assert [(one.candidate.site.first, one.variable) for one in found if one.is_unset] == [(1, "LONG")]


LOCALS = """class Lot { float weight; Lot(float w) { weight = w; } }
class T extends Timeline { predicate P { float a; float b; } }
T::P {
    float lost;
    float kept;
    float idle;
    float bales;
    float rolls;
    Lot lot;
    kept == 2.0 * b;
    a == lost + kept;
    bales * 2.0 == lot.weight;
    lot.weight == rolls * 3.0;
    a >= bales + rolls;
}
"""


def test_a_local_variable_that_lines_read_and_none_sets_is_named(tmp_path: Path) -> None:
    (tmp_path / "m.nddl").write_text(LOCALS, encoding="utf-8")
    sites = sites_of(load_graph(tmp_path / "m.nddl", ()))
    found = loose_ends(Dependence((), sites), (), usage_of(sites))
    assert [(one.candidate.site.first, one.variable) for one in found if one.is_unset] == [(4, "lost")]


CHOSEN = """class Gate { int side; float width; Gate(int s, float w) { side = s; width = w; } }
class Duty extends Timeline { predicate Water { int side; } }
Duty::Water {
    Gate gate;
    bool quick;
    gate.side == side;
    if (quick) { gate.width >= 1.5; }
    duration == 5;
}
"""


def test_an_object_that_a_planner_chooses_is_not_missed(tmp_path: Path) -> None:
    (tmp_path / "m.nddl").write_text(CHOSEN, encoding="utf-8")
    sites = sites_of(load_graph(tmp_path / "m.nddl", ()))
    assert not [one.variable for one in loose_ends(Dependence((), sites), (), usage_of(sites)) if one.is_unset]


STEPS = """class Motion extends Timeline { predicate Step { float x; float x1; float y1; } }
Motion::Step {
    float px;
    meets(object.Step next);
    next.x == x1;
    px == x + 2.0;
    x1 == px;
    y1 == 2.0 * px;
}
"""


def test_a_parameter_that_its_own_rule_sets_is_not_missed_by_the_rule_before(tmp_path: Path) -> None:
    (tmp_path / "m.nddl").write_text(STEPS, encoding="utf-8")
    sites = sites_of(load_graph(tmp_path / "m.nddl", ()))
    usage = usage_of(sites)
    line = next(one for one in sites if one.text == "x1 == px;")
    fitness = {edit.new: usage.fitness(edit, line) for edit in line.edits if edit.old == "px"}
    assert fitness["next.x1"] <= 0.0


BOUNDED = """class Part extends Timeline { predicate Test { int level; level <= 3; } }
Part::Test { duration == level; }
"""


def test_a_parameter_that_its_predicate_bounds_is_set_by_who_asks_for_it(tmp_path: Path) -> None:
    (tmp_path / "m.nddl").write_text(BOUNDED, encoding="utf-8")
    sites = sites_of(load_graph(tmp_path / "m.nddl", ()))
    assert not [one.variable for one in loose_ends(Dependence((), sites), (), usage_of(sites)) if one.is_unset]
