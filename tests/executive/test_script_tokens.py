"""Facts and goals that a model's own script states: what holds at first, and what is wanted of this mission."""

from dataclasses import replace

import pytest

from runtime.solver.configuration.configuration import Configuration, FlawFilter, Match, default_configuration
from tests.executive.flying import flown, fly, history, lines, planner, simulator

KILN = """
class Kiln extends AgentTimeline {
  predicate Cold { } predicate Warm { } predicate Hot { int heat; }
  Kiln(Mode m) { super(m, "Cold"); }
}
Kiln kiln = new Kiln(Internal);
close();
"""


@pytest.mark.parametrize("lookahead", [0, 1, 20])
def test_a_fact_that_may_hold_from_the_beginning_does(lookahead: int) -> None:
    outcome = fly(planner("works", f"{KILN} fact(kiln.Warm w);", "kiln", lookahead=lookahead))
    assert history(outcome, "kiln") == ["0 Warm"]


def test_of_two_facts_the_one_that_the_other_follows_holds_first() -> None:
    text = f"{KILN} fact(kiln.Hot h); fact(kiln.Warm w); w meets h; w.duration == 4; h.heat == 9; h.duration == 3;"
    assert history(fly(simulator("works", text, "kiln")), "kiln") == ["0 Warm", "4 Hot(heat=9)", "7 Cold"]


def test_a_fact_of_later_waits_for_its_tick() -> None:
    outcome = fly(simulator("works", f"{KILN} fact(kiln.Warm w); w.start >= 2; w.start <= 6;", "kiln"))
    assert history(outcome, "kiln")[0] == "0 Cold"


def test_a_fact_that_does_not_fit_at_first_waits_until_it_does() -> None:
    rule = "Kiln::Warm { met_by(Cold c); c.start >= 0; }"
    text = f"{KILN.replace('Kiln kiln', rule + ' Kiln kiln')} fact(kiln.Warm w); w.start <= 3;"
    assert history(fly(planner("works", text, "kiln")), "kiln")[0] == "0 Cold"


@pytest.mark.parametrize("lookahead", [1, 20])
@pytest.mark.parametrize("word", ["goal", "rejectable"])
def test_what_the_script_wants_begins_as_soon_as_it_may_and_not_before_the_mission(word: str, lookahead: int) -> None:
    outcome = fly(planner("works", f"{KILN} {word}(kiln.Hot h); h.heat == 3;", "kiln", lookahead=lookahead))
    assert history(outcome, "kiln") == ["0 Cold", "1 Hot(heat=3)"]


@pytest.mark.parametrize("lookahead", [1, 20])
def test_what_the_script_wants_at_a_tick_begins_then(lookahead: int) -> None:
    text = f"{KILN} rejectable(kiln.Hot h); h.heat == 3; h.start == 4; h.duration == 2;"
    outcome = fly(planner("works", text, "kiln", lookahead=lookahead))
    assert history(outcome, "kiln") == ["0 Cold", "4 Hot(heat=3)", "6 Cold"]


def test_what_the_script_wants_of_others_is_asked_of_them() -> None:
    kiln = KILN.replace("Internal", "External")
    outcome = fly(
        planner("user", f"{kiln} rejectable(kiln.Hot h); h.heat == 3; h.start == 4;", external="kiln"),
        simulator("works", KILN, "kiln"),
    )
    assert history(outcome, "kiln") == ["0 Cold", "4 Hot(heat=3)"]
    assert lines(outcome, "request") == ["3 request user kiln Hot(heat=3)"]


def test_a_wish_whose_time_is_over_leaves_the_plan() -> None:
    text = f"{KILN} fact(kiln.Warm w); w.duration == 6; rejectable(kiln.Hot h); h.heat == 3; h.start <= 4;"
    mission = flown(planner("works", text, "kiln"))
    assert history(mission.outcome, "kiln") == ["0 Warm", "6 Cold"]
    assert mission.report.disagreements == ()


def test_who_leaves_out_every_flaw_plans_nothing_and_settles_what_holds() -> None:
    turns = "Kiln::Cold { duration == 2; meets(Warm w); } Kiln::Warm { duration == 3; met_by(Cold c); meets(Cold d); }"
    text = f"{KILN.replace('Kiln kiln', turns + ' Kiln kiln')} rejectable(kiln.Hot h); h.heat == 3;"
    for match in (Match(), Match(class_name="Object")):
        solver = Configuration("", (FlawFilter(match=match),), ())
        mission = flown(planner("works", text, "kiln"), solver=solver)
        assert history(mission.outcome, "kiln") == ["0 Cold", "2 Warm", "5 Cold", "7 Warm", "10 Cold"]
        assert mission.report.disagreements == ()


FAN = """
class Fan extends AgentTimeline { predicate Off { } predicate On { } Fan(Mode m) { super(m, "Off"); } }
Kiln::Hot { duration == 4; starts(Fan.On f); }
Kiln kiln = new Kiln(Internal); Fan fan = new Fan(Internal); close();
"""
BOTH = f"{KILN.partition('Kiln kiln')[0]}{FAN}"


def leaving_out(match: Match, component: str = "") -> Configuration:
    """The default table with a filter of tokens; of one manager, or of all."""
    found, one = default_configuration(), FlawFilter(match=match)
    if not component:
        return replace(found, filters=(*found.filters, one))
    managers = [
        replace(each, filters=(*each.filters, one)) if each.component == component else each for each in found.managers
    ]
    return replace(found, managers=tuple(managers))


@pytest.mark.parametrize("lookahead", [1, 20])
@pytest.mark.parametrize("component", ["", "OpenConditionManager"])
@pytest.mark.parametrize("match", [Match(class_name="Fan"), Match(predicate="On"), Match(parent_predicate="Kiln.Hot")])
@pytest.mark.parametrize("word", ["fact", "rejectable"])
def test_what_is_not_planned_is_settled_when_it_holds(word: str, match: Match, component: str, lookahead: int) -> None:
    text = f"{BOTH} {word}(kiln.Hot h); h.heat == 3; h.start == 4;"
    mission = flown(planner("works", text, "kiln fan", lookahead=lookahead), solver=leaving_out(match, component))
    assert history(mission.outcome, "kiln") == ["0 Cold", "4 Hot(heat=3)", "8 Cold"]
    assert history(mission.outcome, "fan") == ["0 Off", "4 On"]
    assert mission.report.disagreements == ()


ORDERED = "ThreatManager"
UNORDERED = replace(
    default_configuration(), managers=tuple(one for one in default_configuration().managers if one.component != ORDERED)
)


@pytest.mark.parametrize("lookahead", [1, 20])
@pytest.mark.parametrize(
    "solver",
    [*(leaving_out(Match(class_name=name), ORDERED) for name in ("Kiln", "Fan", "AgentTimeline")), UNORDERED],
    ids=["kiln", "fan", "all", "no manager"],
)
def test_what_is_planned_is_put_in_order_whatever_a_table_leaves_out(solver: Configuration, lookahead: int) -> None:
    wishes = "rejectable(kiln.Hot g); g.heat == 2; g.start == 3; rejectable(kiln.Hot h); h.heat == 3; h.start >= 5;"
    mission = flown(planner("works", f"{BOTH} {wishes}", "kiln fan", lookahead=lookahead), until=20, solver=solver)
    assert history(mission.outcome, "kiln") == ["0 Cold", "3 Hot(heat=2)", "7 Hot(heat=3)", "11 Cold"]
    assert mission.report.disagreements == ()


def test_a_wish_that_is_not_to_be_planned_is_given_up() -> None:
    text = f"{BOTH} rejectable(kiln.Hot h); h.heat == 3; h.start == 4;"
    mission = flown(planner("works", text, "kiln fan", lookahead=20), solver=leaving_out(Match(class_name="Kiln")))
    assert history(mission.outcome, "kiln") == ["0 Cold"]
    assert mission.report.disagreements == ()


@pytest.mark.parametrize("lookahead", [1, 20])
def test_of_two_wishes_at_once_one_is_done_and_the_other_given_up_and_both_are_told(lookahead: int) -> None:
    wishes = "rejectable(kiln.Hot g); g.heat == 2; g.start == 5; rejectable(kiln.Hot h); h.heat == 3; h.start == 4;"
    mission = flown(planner("works", f"{BOTH} {wishes}", "kiln fan", lookahead=lookahead))
    assert lines(mission.outcome, "reject") == ["5 reject works kiln Hot(heat=2): the planner found no place for it"]
    assert lines(mission.outcome, "achieved") == ["8 achieved works kiln Hot(heat=3)"]
    assert mission.report.disagreements == ()
