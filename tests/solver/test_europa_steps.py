"""Where EUROPA's own order of steps hangs on details: what its network knows, and whose variables it decides."""

from pathlib import Path

from nddl_lang.text.source import Source
from runtime.solver.configuration.read import read_configuration
from runtime.solver.tags import EXHAUSTED, PLAN
from tests.solver.planning import solver_for

SHIP = "class Ship extends Timeline { predicate Sail { int sails = {2, 3}; } predicate Drift { } }"
EXAMPLES = """
<Solver name="that decides objects too">
  <FlawFilter component="HorizonFilter" policy="PartiallyContained"/>
  <ThreatManager defaultPriority="0"><FlawHandler component="StandardThreatHandler"/></ThreatManager>
  <OpenConditionManager defaultPriority="0">
    <FlawHandler component="StandardOpenConditionHandler"/>
  </OpenConditionManager>
  <UnboundVariableManager defaultPriority="0">
    <FlawFilter var-match="start"/>
    <FlawFilter var-match="end"/>
    <FlawFilter var-match="duration"/>
    <FlawFilter component="InfiniteDynamicFilter"/>
    <FlawHandler component="StandardVariableHandler"/>
  </UnboundVariableManager>
</Solver>
"""
OUT = "Ship ship = new Ship(); close();"


def steps(folder: Path, text: str, *, europa: bool = True) -> tuple[int, int, int]:
    """How a search ends, after how many steps, with how many decisions in force."""
    solver = solver_for(folder, text, europa=europa)
    result = solver.solve(1000, 1000)
    return result, solver.steps, solver.depth


def test_a_comparison_of_times_is_no_edge_for_europa(tmp_path: Path) -> None:
    goals = "goal(ship.Drift a); goal(ship.Drift b); a.start = [0 50]; b.start = [0 50]; a.end = [1 60]; "
    # EUROPA tries to put b before a, which its network of times does not forbid; only then does b go behind a.
    asked = goals + "lt(a.start, b.start); leq(a.end, b.start);"
    related = goals + "a before b;"
    by_comparison = steps(tmp_path, SHIP + OUT + asked)
    by_relation = steps(tmp_path, SHIP + OUT + related)
    assert by_comparison[0] == by_relation[0] == PLAN
    assert by_comparison[1] > by_relation[1]
    assert steps(tmp_path, SHIP + OUT + asked, europa=False)[1] == by_relation[1]


def test_variables_of_a_rejected_token_are_not_decided(tmp_path: Path) -> None:
    rule = "Ship::Sail { sails == 2; sails != 2; }"
    text = SHIP + rule + OUT + "rejectable(ship.Sail s); s.start = [0 50];"
    for europa in (True, False):
        result, _, depth = steps(tmp_path, text, europa=europa)
        assert (result, depth) == (PLAN, 1)


def test_variables_of_a_token_that_was_active_in_vain_are_not_decided(tmp_path: Path) -> None:
    branches = "if (way == 1) { contains(object.Drift d); } else { contains(object.Drift d); }"
    rule = f"Ship::Sail {{ int way = {{1, 2}}; {branches} }}"
    text = SHIP + rule + OUT + "rejectable(ship.Sail s); s.start = [0 50]; s.end = [1 60];"
    for europa in (True, False):
        result, _, depth = steps(tmp_path, text, europa=europa)
        assert (result, depth) == (PLAN, 1)


def test_a_goal_that_fits_nowhere_exhausts_the_search(tmp_path: Path) -> None:
    goals = "goal(ship.Drift a); goal(ship.Drift b); a.start = 0; b.start = 0; a.duration = 5; b.duration = 7;"
    assert steps(tmp_path, SHIP + OUT + goals)[0] == EXHAUSTED


def test_the_only_object_of_a_class_is_given_whether_or_not_the_class_is_closed(tmp_path: Path) -> None:
    pier = "class Pier extends Timeline { predicate Busy { } } class Port extends Timeline { Pier pier; " + (
        "Port(Pier p) { pier = p; } predicate Call { } } Port::Call { met_by(object.pier.Busy b); }"
    )
    scene = pier + "Pier pier = new Pier(); Port port = new Port(pier); {} goal(port.Call c); c.start = [1 9];"
    how, complaints = read_configuration(Source("examples.xml", EXAMPLES))
    assert how is not None and not complaints
    for closing in ("", "close();"):
        solver = solver_for(tmp_path, scene.replace("{} goal", closing + " goal"), europa=True, how=how)
        assert (solver.solve(100, 100), solver.steps) == (PLAN, 4)
