"""Sampled parameters in flight: one value per mission, or a new one at each update, whatever the planner tries."""

from dataclasses import replace

import pytest

from runtime.executive.chance import sample
from runtime.executive.configuration import GoalConfiguration, ParameterConfiguration
from runtime.executive.outcome import EventKind, Outcome
from tests.executive.flying import flown, fly, history, in_all_ways, lines, planner, simulator

SEA = """
float SWELL = [0.0 1.0];
class Sea extends AgentTimeline { predicate Wave { float height; } Sea(Mode m) { super(m, "Wave"); } }
Sea::Wave { height == sampledParameter(SWELL); duration == 3; }
"""
OWN = "Sea sea = new Sea(Internal); close();"


def sailed(mode: str, extra: str = "", seed: int = 5) -> Outcome:
    """Thirty ticks at sea."""
    swell = ParameterConfiguration("SWELL", 0.0, 1.0, mode="intra" if mode == "intra" else "inter", update=7)
    return fly(simulator("sea", f"{SEA}{extra}{OWN}", "sea"), until=30, parameters=(swell,), seed=seed)


def heights(outcome: Outcome) -> list[tuple[int, str]]:
    """Each wave: when it began, how high it was."""
    return [(int(line.partition(" ")[0]), line.partition("=")[2]) for line in history(outcome, "sea")]


def test_a_parameter_of_the_mission_is_drawn_once() -> None:
    outcome = sailed("inter")
    assert len(outcome.draws) == 1 and outcome.draws[0].tick == 0
    assert len({height for _, height in heights(outcome)}) == 1


def test_a_parameter_that_varies_changes_at_its_updates_only() -> None:
    outcome = sailed("intra")
    by_update: dict[int, set[str]] = {}
    for tick, height in heights(outcome):
        by_update.setdefault(tick // 7, set()).add(height)
    assert [len(values) for values in by_update.values()] == [1, 1, 1, 1, 1]
    assert len(set.union(*by_update.values())) == 5
    assert [draw.tick for draw in outcome.draws] == [0, 7, 14, 21, 28]


def test_choices_that_were_tried_in_vain_do_not_change_a_value() -> None:
    # A second kind of wave is tried first at every third tick, draws, and is found not to fit.
    stormy = SEA.replace(
        "predicate Wave { float height; }", "predicate Storm { float height; } predicate Wave { float height; }"
    )
    stormy = stormy.replace('"Wave"', '"Storm"')
    stormy += "Sea::Storm { height == sampledParameter(SWELL); height > 2.0; }"
    swell = ParameterConfiguration("SWELL", 0.0, 1.0, mode="intra", update=7)
    troubled = fly(simulator("sea", f"{stormy}{OWN}", "sea"), until=30, parameters=(swell,), seed=5)
    calm = sailed("intra")
    assert heights(troubled) == heights(calm)
    assert troubled.draws == calm.draws
    assert lines(troubled, "relax") == []


def test_another_parameter_does_not_change_a_value() -> None:
    more = "float WIND = [0.0 1.0];" + " Sea::Wave { float wind; wind == sampledParameter(WIND); }"
    assert heights(sailed("intra", more)) == heights(sailed("intra"))
    assert {draw.parameter for draw in sailed("intra", more).draws} == {"SWELL", "WIND"}


def test_other_seeds_give_other_values() -> None:
    assert len({sailed("inter", seed=seed).draws[0].value for seed in range(20)}) == 20


def test_a_given_value_replaces_the_draw() -> None:
    swell = ParameterConfiguration("SWELL", 0.0, 1.0, mode="intra", update=7)
    flyer = simulator("sea", f"{SEA}{OWN}", "sea")
    outcome = fly(flyer, until=30, parameters=(swell,), overrides={"SWELL": 0.25})
    assert {height for _, height in heights(outcome)} == {"0.25)"}


def test_a_draw_is_told_before_what_it_leads_to() -> None:
    outcome = sailed("inter")
    kinds = [event.kind for event in outcome.events]
    assert kinds.index(EventKind.SAMPLE) < kinds.index(EventKind.OBSERVATION)


def test_a_goal_with_a_range_leaves_the_draw_its_say() -> None:
    goals = (GoalConfiguration("sea", "Wave", parameters=(("height", (0.0, 1.0)),)),)
    swell = ParameterConfiguration("SWELL", 0.0, 1.0)
    outcome = fly(simulator("sea", f"{SEA}{OWN}", "sea"), until=9, goals=goals, parameters=(swell,))
    assert len({height for _, height in heights(outcome)}) == 1


@pytest.mark.parametrize("compiles", [False, True])
def test_a_command_that_begins_later_than_it_might_has_the_draw_of_the_tick_at_which_it_begins(compiles: bool) -> None:
    # It is planned at tick 24 for 25 or later; what holds then lasts until 28, and the draw changes at 28.
    shop = """
    float SLOW = [0.1 2.0];
    class Shop extends AgentTimeline { predicate Rest { } predicate Do { float d; } Shop(Mode m) { super(m, "Rest"); } }
    Shop::Do { int t; d == sampledParameter(SLOW); t == ceil(d * 4.0); duration == t + 1; }
    Shop::Rest { duration == 4; }
    Shop shop = new Shop(Internal); close();
    """
    goals = (GoalConfiguration("shop", "Do", 16, False, (25.0, 28.0)),)
    slow = ParameterConfiguration("SLOW", 0.1, 2.0, mode="intra", update=7)
    for seed in range(5):
        flight = flown(
            simulator("shop", shop, "shop"), until=40, goals=goals, parameters=(slow,), seed=seed, compiles=compiles
        )
        outcome = flight.outcome
        assert flight.report.holds
        drawn = {draw.tick: draw.value for draw in outcome.draws}
        (begun,) = [line for line in history(outcome, "shop") if "Do(" in line]
        assert begun.startswith("28 ")
        assert float(begun.partition("d=")[2].rstrip(")")) == drawn[28]


ARM = """
float LOAD = [0.0 1.0];
class Arm extends AgentTimeline {
    predicate Rest { }
    predicate Do { int n; bool full; }
    Arm(Mode m) { super(m, "Rest"); }
}
Arm::Do { float load; load == sampledParameter(LOAD); full == (load > 0.4); duration == LENGTH; }
Arm arm = new Arm(Internal); close();
"""
LOAD = ParameterConfiguration("LOAD", 0.0, 1.0, mode="intra", update=3)


def done(tick: int, n: int, start: tuple[float, float], *full: bool) -> GoalConfiguration:
    """A command of the arm: when it is sent, its number, when it may begin, and whether the arm is to be full."""
    return GoalConfiguration("arm", "Do", tick, False, start, parameters=(("n", n), *(("full", one) for one in full)))


def arm_in_all_ways(length: str, goals: tuple[GoalConfiguration, ...], seed: int, update: int = 3) -> Outcome:
    """Forty ticks of the arm."""
    text = ARM.replace("LENGTH", length)
    return in_all_ways(simulator("arm", text, "arm"), 40, goals, (replace(LOAD, update=update),), seed)


@pytest.mark.parametrize("is_busy", [False, True])
def test_what_is_drawn_at_the_first_tick_at_which_a_command_can_begin_decides(is_busy: bool) -> None:
    goals = (done(0, 1, (1.0, 1.0)), done(2, 2, (3.0, 30.0), False))[not is_busy :]
    free = 11 if is_busy else 3
    begun = 0
    for seed in range(9):
        outcome = arm_in_all_ways("10", goals, seed)
        fits = sample(LOAD, seed, free).value <= 0.4
        found = [int(line.partition(" ")[0]) for line in history(outcome, "arm") if "n=2" in line]
        assert found == [free] * fits
        assert lines(outcome, "relax") == []
        assert [line.partition(" ")[0] for line in lines(outcome, "reject")] == ([] if fits else [str(free)])
        for event in outcome.events:
            if event.kind is EventKind.REJECT:
                assert event.conflict is not None and "LOAD" in event.conflict.parameters
        begun += fits
    assert 0 < begun < 9


def test_a_planner_plans_with_the_draw_of_the_earliest_start() -> None:
    text, fitting = ARM.replace("LENGTH", "10"), []
    for seed in range(6):
        flight = flown(
            planner("arm", text, "arm"),
            until=40,
            goals=(done(0, 2, (3.0, 30.0), False),),
            parameters=(LOAD,),
            seed=seed,
        )
        fitting.append(sample(LOAD, seed, 3).value <= 0.4)
        assert flight.report.holds
        assert [line.partition(" ")[0] for line in history(flight.outcome, "arm")] == (
            ["0", "3", "13"] if fitting[-1] else ["0"]
        )
        assert [line.partition(" ")[0] for line in lines(flight.outcome, "reject")] == ([] if fitting[-1] else ["0"])
    assert {True, False} == set(fitting)


def test_a_command_is_rejected_where_what_it_asks_for_may_not_begin_as_drawn() -> None:
    text = """
    float LOAD = [0.0 1.0];
    class Arm extends AgentTimeline { predicate Rest { } predicate Do { } Arm(Mode m) { super(m, "Rest"); } }
    class Hand extends AgentTimeline { predicate Open { } predicate Grip { } Hand(Mode m) { super(m, "Open"); } }
    Hand hand = new Hand(Internal);
    Arm::Do { duration == 5; equals(hand.Grip g); }
    Hand::Grip { float load; load == sampledParameter(LOAD); load <= 0.4; }
    Arm arm = new Arm(Internal); close();
    """
    load = replace(LOAD, update=4)
    seen = set()
    for seed in range(9):
        goals = (GoalConfiguration("arm", "Do", 2, False, (6.0, 30.0)),)
        outcome = in_all_ways(simulator("arm", text, "arm hand"), 40, goals, (load,), seed)
        fits = sample(load, seed, 6).value <= 0.4
        assert [line.partition(" ")[0] for line in lines(outcome, "reject")] == ([] if fits else ["6"])
        assert [line.partition(" ")[0] for line in history(outcome, "arm")] == (["0", "6", "11"] if fits else ["0"])
        seen.add(fits)
    assert seen == {True, False}


def test_what_is_drawn_for_a_command_that_waits_leaves_no_other_without_room() -> None:
    # However long the first lasts, there is room for two short ones behind it: which are short is drawn as they begin.
    goals = (done(0, 1, (1.0, 1.0)), done(2, 2, (3.0, 30.0)), done(4, 3, (5.0, 24.0)))
    begun = []
    for seed in range(9):
        outcome = arm_in_all_ways("floor(load * 20.0) + 1", goals, seed, 8)
        first_over = 2 + int(sample(replace(LOAD, update=8), seed, 1).value * 20.0)
        assert all(int(line.partition(" ")[0]) >= first_over for line in lines(outcome, "reject"))
        assert lines(outcome, "relax") == []
        begun.append(len([line for line in history(outcome, "arm") if "Do(" in line]))
    assert {2, 3} <= set(begun)


def test_a_fact_to_come_is_drawn_for_as_it_begins_whichever_ticks_are_visited() -> None:
    text = ARM.replace("LENGTH", "3") + "fact(arm.Do d); d.start >= 25; d.start <= 38;"
    ways = [
        flown(simulator("arm", text, "arm"), until=60, parameters=(LOAD,), seed=3, every_tick=every)
        for every in (False, True)
    ]
    assert lines(ways[0].outcome) == lines(ways[1].outcome)
    assert [draw.tick for draw in ways[0].outcome.draws] == [36]
