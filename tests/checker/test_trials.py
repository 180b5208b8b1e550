"""Trials of a fault are counted for what was flown; what a name or a value of an enumeration says for a change."""

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from checker.batch.result import MissionResult
from checker.counterfactual.candidates import Candidate, Suspicion
from checker.counterfactual.damage import ALIKE, HEAVY, collapsed_of, voided_of
from checker.counterfactual.effort import Bounds
from checker.counterfactual.missions import Missions
from checker.counterfactual.ranking import Claim, rank
from checker.counterfactual.smallness import cost_of, delay_of
from checker.counterfactual.trials import Try, try_out
from checker.counterfactual.tried import LineTrial, Trials
from checker.counterfactual.turns import Turns
from checker.counterfactual.usage import usage_of
from checker.losses import GoalEnd, GoalFate, Losses
from checker.mutation.edits import EditSite, SmallEdit, sites_of
from checker.mutation.kinds import EditKind
from checker.mutation.variant import load_graph
from checker.oracle import Judgement, Verdict
from runtime.executive.configuration import GoalConfiguration
from runtime.executive.outcome import Abort, Event, EventKind, Outcome, Phase, PropertyFate, Reason, ReasonKind

MODEL = """#include "TREX.nddl"
int GRACE;
int SPAN;
GRACE = 0;
SPAN = 60;
enum Flag { red, amber }
enum Load { crate, barrel, sack }
class Mast extends AgentTimeline {
  predicate Bare { }
  predicate Flies { Flag flag; Load load; int by; }
  Mast(Mode m) { super(m, "Bare"); }
}
Mast::Flies {
  duration <= SPAN;
  met_by(object.Flies last);
  meets(object.Flies next);
  last.flag == red;
  next.flag == amber;
  last.load == crate;
  next.load == barrel;
  by == start + GRACE;
}
"""


def sites(folder: Path) -> dict[str, EditSite]:
    """The sites of the model by their text."""
    (folder / "mast.nddl").write_text(MODEL, encoding="utf-8")
    return {site.text: site for site in sites_of(load_graph(folder / "mast.nddl", ()))}


def result(number: int, verdict: Verdict) -> MissionResult:
    return MissionResult(number, number, Judgement(verdict, "F3"), Outcome(number, 90, 200, None, (), (), ()), True)


def tried(
    found: dict[str, EditSite],
    texts: Sequence[str],
    fly: Try,
    failed: int = 3,
    passed: int = 1,
    bounds: Bounds | None = None,
) -> Trials:
    """What trials at some lines tell of so many missions."""
    candidates = [Candidate(found[text], 0.0, Suspicion.CONFLICT) for text in texts]
    missions = Missions(
        [result(number, Verdict.FAIL) for number in range(1, failed + 1)],
        [result(100 + number, Verdict.PASS) for number in range(passed)],
    )
    return try_out(candidates, missions, usage_of(list(found.values())), fly, bounds or Bounds())


def test_of_a_line_the_edit_that_helps_all_missions_is_told_and_was_flown_in_each(tmp_path: Path) -> None:
    flown: set[tuple[str, str, int]] = set()

    def fly(edit: SmallEdit, mission: MissionResult, _: float) -> MissionResult:
        flown.add((edit.old, edit.new, mission.number))
        helps = {"120": (1, 3, 100), "600": (1, 2, 3, 100)}.get(edit.new, ())
        return result(mission.number, Verdict.PASS if mission.number in helps else Verdict.FAIL)

    (cause,) = tried(sites(tmp_path), ["SPAN = 60;"], fly).causes
    assert (cause.edit.new, cause.helped, cause.missions, cause.spoilt) == ("600", 3, 3, 0)
    assert {("60", new, 1) for new in ("120", "600")} <= flown
    assert {("60", "600", number) for number in (1, 2, 3, 100)} <= flown


def test_an_edit_that_spoils_what_passed_gives_way_to_one_that_does_not(tmp_path: Path) -> None:
    def fly(edit: SmallEdit, mission: MissionResult, _: float) -> MissionResult:
        helps = {"1": (1, 2, 100), "5": (1, 2)}.get(edit.new, ()) if edit.old == "0" else ()
        return result(mission.number, Verdict.PASS if mission.number in helps else Verdict.FAIL)

    (cause,) = tried(sites(tmp_path), ["GRACE = 0;"], fly, failed=2).causes
    assert (cause.edit.new, cause.helped, cause.missions, cause.spoilt) == ("1", 2, 2, 0)


@pytest.mark.parametrize(("further", "helped"), [(0, 1), (20, 3)])
def test_flights_go_on_until_a_change_helps_in_all_missions(further: int, helped: int, tmp_path: Path) -> None:
    """The usual ones are over as soon as the smallest change is known to help the first mission alone."""

    def fly(edit: SmallEdit, mission: MissionResult, _: float) -> MissionResult:
        helps = {"65": (1,), "600": (1, 2, 3)}.get(edit.new, ())
        return result(mission.number, Verdict.PASS if mission.number in helps else Verdict.FAIL)

    found = tried(sites(tmp_path), ["SPAN = 60;"], fly, passed=0, bounds=Bounds(6, further=further))
    (cause,) = found.causes
    assert cause.helped == helped
    assert found.flights <= 6 + further


def cheapest(site: EditSite, found: dict[str, EditSite], kind: EditKind) -> float:
    usage = usage_of(list(found.values()))
    return min(cost_of(edit, site, usage) for edit in site.edits if edit.kind is kind)


def test_a_number_that_has_a_name_is_hardly_nothing(tmp_path: Path) -> None:
    found = sites(tmp_path)
    costs = [cheapest(found[text], found, EditKind.OFF_BY_ONE) for text in ("GRACE = 0;", "SPAN = 60;")]
    assert costs[0] < costs[1] - 0.5


def test_a_value_of_an_enumeration_is_hardly_left_without_a_line_where_all_others_have_one(tmp_path: Path) -> None:
    found = sites(tmp_path)
    costs = [cheapest(found[text], found, EditKind.VALUE) for text in ("last.flag == red;", "last.load == crate;")]
    assert costs[0] > costs[1] + 1.0  # no line speaks of a sack either


def test_each_of_many_values_of_an_enumeration_is_tried_later_than_the_only_other_one(tmp_path: Path) -> None:
    found = sites(tmp_path)
    usage = usage_of(list(found.values()))
    turns = {
        text: [delay_of(edit, found[text], usage) for edit in found[text].edits if edit.kind is EditKind.VALUE]
        for text in ("last.flag == red;", "last.load == crate;")
    }
    (only,) = turns["last.flag == red;"]
    first, second = turns["last.load == crate;"]
    assert only is not None and first is not None and only < first == second


def test_a_large_model_has_more_flights_where_a_mission_is_short() -> None:
    assert Bounds(40).grown(900, 1000).flights == 40
    assert Bounds(40).grown(2500, 1000).flights == 80
    assert Bounds(40).grown(20_000, 1000).flights == 120
    assert Bounds(40).grown(20_000, 30_000).flights == 40
    assert Bounds(0).grown(20_000, 1000).flights == 0
    assert [Bounds(40).grown(changes, 1000).further for changes in (900, 2500, 20_000)] == [80, 40, 0]
    assert Bounds(40).grown(900, 1000).lengthened().flights == 120
    assert Bounds(40).grown(900, 30_000).further == 0


def test_a_word_that_left_a_flight_without_an_end_waits_at_other_lines() -> None:
    def candidate(text: str) -> Candidate:
        edits = tuple(SmallEdit(EditKind.VALUE, "a.nddl", 3, 4, "red", new, 1) for new in ("amber", "green"))
        return Candidate(EditSite("a.nddl", 1, 1, 1, "", (1, 1), text, edits), 0.0, Suspicion.TRACE)

    turns = Turns(lambda _: ())
    one, other = candidate("one"), candidate("other")
    for at, each in ((0.5, one), (0.6, other)):
        for edit in each.site.edits:
            turns.add(at, each, edit)
    turns.avoid(turns.pop()[2])
    order = []
    while turns:
        _, each, edit = turns.pop()
        order.append((each.site.text, edit.new))
    assert order == [("one", "green"), ("other", "green"), ("other", "amber")]


def test_a_mission_that_passes_as_a_token_takes_no_time_any_more_has_lost_something() -> None:
    def flown(ends: int) -> MissionResult:
        seen = [("Bare", 0), ("Flies", 20), ("Bare", 20 + ends)]
        events = tuple(
            Event(tick, Phase.START, EventKind.OBSERVATION, "sea", "mast", predicate, (), ())
            for predicate, tick in seen
        )
        return MissionResult(1, 1, Judgement(Verdict.PASS), Outcome(1, 90, 200, None, (), events, ()), True)

    assert collapsed_of(flown(1), flown(40)) > collapsed_of(flown(8), flown(40)) == 0.0
    assert collapsed_of(flown(1), flown(1)) == 0.0


@pytest.mark.parametrize(("is_void", "name", "cost"), [(True, "p", HEAVY), (False, "p", 0.0), (True, "q", 0.0)])
def test_a_property_that_is_kept_as_nothing_was_due_is_evaded(is_void: bool, name: str, cost: float) -> None:
    broken = PropertyFate("p", False, 60, -math.inf)
    outcome = Outcome(1, 90, 200, None, (), (), ())
    passed = MissionResult(1, 1, Judgement(Verdict.PASS), outcome, True)
    failed = replace(passed, judgement=Judgement(Verdict.FAIL, "P1", broken=broken))
    fates = (PropertyFate(name, True, None, math.inf, is_void),)
    again = replace(passed, outcome=replace(outcome, properties=fates))
    assert voided_of(again, failed) == cost
    assert voided_of(again, passed) == 0.0


def test_what_was_tried_on_no_other_mission_comes_behind_what_helps_all() -> None:
    site = EditSite("m.nddl", 1, 1, 1, "", (1, 1), "int A = 6;", ())
    candidate = Candidate(site, 0.0, Suspicion.CONFLICT)
    small, large = (SmallEdit(EditKind.CONSTANT, "m.nddl", 8, 9, "6", new, 1) for new in ("5", "60"))
    untried = LineTrial(candidate, small, 0.0, 2.0)
    clean = LineTrial(candidate, large, 0.0, 3.0, helped=3, missions=3, is_untried=False)
    partly = LineTrial(candidate, small, 0.0, 2.0, helped=2, missions=3, is_untried=False)
    assert sorted([partly, untried, clean], key=lambda one: one.weight) == [clean, untried, partly]


@pytest.mark.parametrize(
    ("is_mandatory", "start", "given_up", "damage"),
    [
        (False, (800.0, 900.0), None, 0.0),  # it was not to begin before the failure
        (False, (5.0, 900.0), None, HEAVY),
        (True, (800.0, 900.0), None, HEAVY),
        (False, (5.0, 900.0), 40, 0.0),  # it had been given up before
        (False, (5.0, 900.0), 73, HEAVY),  # with the failure
    ],
)
def test_a_goal_weighs_that_the_failed_mission_might_have_achieved(
    is_mandatory: bool, start: tuple[float, float], given_up: int | None, damage: float
) -> None:
    """A goal for tick 800 that every mission gives up made all changes that mend a failure at 73 `evade`."""
    goals = (
        GoalConfiguration("job", "Do", start=(5.0, 40.0), mandatory=True),
        GoalConfiguration("job", "Do", start=start, mandatory=is_mandatory),
    )
    abort = Abort("F1", 73, "r", ("job",), Reason(ReasonKind.GOES_ON), None, 2, 0)
    then = GoalFate.OPEN if given_up is None else GoalFate.REJECTED
    ends = (GoalEnd(0, GoalFate.OPEN, 73), GoalEnd(1, then, given_up or 73))
    failed = replace(
        result(1, Verdict.FAIL), outcome=Outcome(1, 73, 2000, abort, (), (), ()), losses=Losses(goals=ends)
    )
    ends = (GoalEnd(0, GoalFate.ACHIEVED, 60), GoalEnd(1, GoalFate.REJECTED, 98))
    mended = replace(result(1, Verdict.PASS), losses=Losses(goals=ends))
    assert Missions([failed], goals=goals).damage_of(mended, failed) == damage


@pytest.mark.parametrize(
    ("recall", "before", "passed", "damage"),
    [
        (None, (GoalFate.ACHIEVED, 90), (), HEAVY),
        (300, (GoalFate.OPEN, 0), (), 0.0),  # the mission file takes it back
        (None, (GoalFate.REJECTED, 98), (), ALIKE),  # without the change it is given up, too
        (None, (GoalFate.REJECTED, 97), (), HEAVY),
        (None, (GoalFate.ACHIEVED, 90), (GoalFate.LATE,), 0.0),  # what passed had lost it
        (None, (GoalFate.ACHIEVED, 90), (GoalFate.LATE, GoalFate.ACHIEVED), HEAVY),
    ],
)
def test_a_goal_weighs_that_would_be_achieved_without_the_change(
    recall: int | None, before: tuple[GoalFate, int], passed: tuple[GoalFate, ...], damage: float
) -> None:
    """One optional goal that is always rejected, and one that the mission takes back, made the right line `evade`."""
    goals = (
        GoalConfiguration("job", "Do", start=(5.0, 40.0), mandatory=True),
        GoalConfiguration("job", "Do", start=(5.0, 90.0), recall=recall),
    )
    ends = (GoalEnd(0, GoalFate.REJECTED, 60), GoalEnd(1, *before))
    failed = replace(result(1, Verdict.FAIL), losses=Losses(goals=ends))
    mended = replace(
        result(1, Verdict.PASS),
        losses=Losses(goals=(GoalEnd(0, GoalFate.ACHIEVED, 60), GoalEnd(1, GoalFate.REJECTED, 98))),
    )
    others = [
        replace(result(2, Verdict.PASS), losses=Losses(goals=(GoalEnd(0, GoalFate.ACHIEVED, 50), GoalEnd(1, fate, 98))))
        for fate in passed
    ]
    assert Missions([failed], others, goals=goals).damage_of(mended, failed) == damage


def test_what_a_reactor_in_python_is_given_is_tried_both_ways_at_once(tmp_path: Path) -> None:
    """Which way it is better off is not known, and a failure that stays as it was tells nothing of the other way."""
    line = sites(tmp_path)["SPAN = 60;"]
    edits = tuple(
        SmallEdit(EditKind.SETTING, line.file, line.begin, line.begin + 2, "60", new, line.first)
        for new in ("120", "600", "30", "6")
    )
    flown: list[str] = []

    def fly(edit: SmallEdit, mission: MissionResult, _: float) -> MissionResult:
        flown.append(edit.new)
        return result(mission.number, Verdict.FAIL)

    found = sites(tmp_path) | {line.text: replace(line, edits=edits)}
    tried(found, [line.text, "duration <= SPAN;"], fly)
    assert flown[:2] == ["600", "6"]


@pytest.mark.parametrize(("sign", "claims"), [("-", [Claim.MENDS]), ("", [Claim.LOOSENS])])
def test_a_bound_for_what_was_set_takes_the_demand_away_where_the_token_ends_at_once(
    sign: str, claims: list[Claim], tmp_path: Path
) -> None:
    def fly(edit: SmallEdit, mission: MissionResult, _: float) -> MissionResult:
        is_bound = edit.kind is EditKind.COMPARISON
        seen = (("Flies", 20), ("Bare", 21 if is_bound else 24))
        events = tuple(
            Event(tick, Phase.START, EventKind.OBSERVATION, "sea", "mast", predicate, (), ())
            for predicate, tick in seen
        )
        flown = result(mission.number, Verdict.PASS if is_bound or edit.new == sign else Verdict.FAIL)
        return replace(flown, outcome=Outcome(1, 90, 200, None, (), events, ()))

    trials = tried(sites(tmp_path), ["by == start + GRACE;"], fly, failed=1, passed=0)
    assert [one.claim for one in rank(trials, tmp_path).ranked] == claims
