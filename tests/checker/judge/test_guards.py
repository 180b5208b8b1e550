"""A guard that waits though the record decides it is noticed; one whose inputs a mission leaves open is not."""

from dataclasses import replace

import pytest

from nddl_lang.text.source import Span
from runtime.executive.configuration import GoalConfiguration, ParameterConfiguration
from runtime.executive.record import GuardRun, ValueRange
from runtime.solver.configuration.configuration import FlawFilter, Match, default_configuration
from tests.checker.judge.corruption import again, put
from tests.executive.flying import Flown, flown, simulator

MODEL = """
enum Hue { red, green }
int LAG = [1 4];
class Box { int w; Box(int x) { w = x; } }
Box b1 = new Box(3);
Box b2 = new Box(3);
class Arm extends AgentTimeline {
  predicate Rest { } predicate Act { int n; Hue hue; int lag = [1 4]; } Arm(Mode m) { super(m, "Rest"); }
}
class Tap extends AgentTimeline { predicate Shut { } predicate Run { int k; } Tap(Mode m) { super(m, "Shut"); } }
Arm arm = new Arm(Internal);
Tap tap = new Tap(Internal);
Arm::Act { duration == 3; RULE }
close();
"""
ASKED = GoalConfiguration("arm", "Act", 0, False, (13, 19), None, None, (("n", 2),))
LAG = ParameterConfiguration("LAG", 1, 4, distribution="discrete", values=(1, 2, 4), mode="intra", update=5)
UNDRIVEN = replace(
    default_configuration(),
    filters=(*default_configuration().filters, FlawFilter(match=Match(class_name="Arm", variable="hue"))),
)

RUN = "{ equals(Tap.Run s); s.k == n; }"
DECIDED = [
    f"if (n < 3) {RUN}",
    f"if (n > 3) {{ }} else {RUN}",
    f"bool few; few == (n < 3); if (few) {RUN}",
    f"int x = [4 10]; if (x > 3) {RUN}",
    f"if (start > 2) {RUN}",
    f"if (object == arm) {RUN}",
    f"Box b; if (b.w == 3) {RUN}",
    f"if (hue == red) {RUN}",
    f"met_by(Rest r); if (r.end > 2) {RUN}",
    "equals(Tap.Run s); s.k == n; if (s.k == 2) { s.duration <= 3; }",
    "if (n < 3) { int mine; mine == sampledParameter(LAG); }",
]
OPEN = [
    f"float x = [4.0 10.0]; if (x > 3.0) {RUN}",
    f"int x; x >= 4; if (x > 3) {RUN}",
    f"if (duration == 3) {RUN}",
    "before(Tap.Run s); s.k == n; s.start >= start + 20; if (s.k == 2) { s.duration == 2; }",
]


def _flown(rule: str, is_decided: bool = True) -> Flown:
    solver = None if is_decided else UNDRIVEN
    flyer = simulator("sim", MODEL.replace("RULE", rule), "arm tap")
    return flown(flyer, until=30, goals=(ASKED,), parameters=(LAG,), compiles=False, solver=solver)


def _waiting(mission: Flown) -> tuple[list[GuardRun], Flown]:
    """The guards of the command as they ran, and the mission as if the first had not been decided."""
    tokens = mission.record.reactors[0].tokens
    at = next(k for k, each in enumerate(tokens) if each.predicate == "Arm.Act")
    (run,) = tokens[at].runs
    silent = run._replace(guards=(GuardRun("waiting", False, None), *run.guards[1:]))
    return list(run.guards), put(mission, 0, at, tokens[at]._replace(runs=(silent,)))


@pytest.mark.parametrize("rule", DECIDED)
def test_a_branch_that_never_ran_is_noticed_though_its_inputs_are_said_to_be_open(rule: str) -> None:
    mission = _flown(rule)
    assert mission.report.holds
    guards, silent = _waiting(mission)
    assert guards[0].branch != "waiting"
    (one,) = again(silent).disagreements
    assert (one.kind, one.held, one.found) == ("guard", "no branch", guards[0].branch)
    assert isinstance(one.span, Span) and one.span.text.startswith("if (")


def test_a_whole_number_that_was_left_open_decides_a_guard_if_all_its_values_do() -> None:
    mission = _waiting(_flown(f"int x = [4 10]; if (x > 3) {RUN}"))[1]
    tokens = mission.record.reactors[0].tokens
    at = next(k for k, each in enumerate(tokens) if each.predicate == "Arm.Act")
    for values, noticed in ((ValueRange(4, 10), 1), (ValueRange(2, 10), 0)):
        run = tokens[at].runs[0]._replace(locals=(values,))
        report = again(put(mission, 0, at, tokens[at]._replace(runs=(run,))))
        assert len(report.disagreements) == noticed


@pytest.mark.parametrize("rule", OPEN)
def test_a_guard_whose_inputs_no_solver_decides_is_left_open(rule: str) -> None:
    mission = _flown(rule)
    assert mission.report.holds and mission.outcome.abort is None
    assert [guard.branch for guard in _waiting(mission)[0]] == ["waiting"]


def test_a_guard_on_a_variable_that_a_table_leaves_out_is_left_open() -> None:
    mission = _flown(f"hue != red; if (hue == green) {RUN}", is_decided=False)
    assert mission.report.holds
    assert [guard.branch for guard in _waiting(mission)[0]] == ["waiting"]


def test_a_draw_for_a_parameter_that_was_left_open_is_noticed() -> None:
    mission = _flown("lag == sampledParameter(LAG);")
    assert mission.report.holds
    tokens = mission.record.reactors[0].tokens
    at = next(k for k, each in enumerate(tokens) if each.predicate == "Arm.Act")
    left = tokens[at]._replace(arguments=(*tokens[at].arguments[:2], ValueRange(1, 4)))
    assert [(one.kind, one.name) for one in again(put(mission, 0, at, left)).disagreements] == [("draw", "LAG")]
