"""Failures are grouped by their culprit, and tied to the parameter values that bring them about."""

from dataclasses import replace
from pathlib import Path

import pytest

from checker.batch.result import MissionResult
from checker.batch.worker import Load, Task, fly_one
from checker.buckets import group_failures
from checker.causes import draws_behind, events_to_abort
from checker.conditions.find import find_condition
from checker.conditions.flights import Refly
from checker.conditions.rendering import condition_text
from checker.counterfactual.missions import Missions
from checker.counterfactual.ranking import Causes, Claim, RankedLine
from checker.culprit import culprit_of
from checker.faults import faults_of
from checker.mission import read_mission
from checker.mutation.edits import SmallEdit
from checker.mutation.kinds import EditKind
from checker.oracle import Judgement, Verdict
from checker.sampling.seeds import mission_seed
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.outcome import OpenGoal, Outcome, Reason, ReasonKind
from runtime.executive.rendering import event_text
from runtime.plan.readout.names import TokenName
from tests.checker.fake_agent import CONSTANT, LIMIT, linked_conflict, load_linked, load_split, split_conflict


def agent() -> AgentConfiguration:
    mission, _ = read_mission(Path("models/gps/mission.toml"))
    assert mission is not None
    return mission.agent


def fly(load: Load) -> tuple[MissionResult, ...]:
    flight = load(agent())
    return tuple(fly_one(flight, Task(number, mission_seed(7234, number))) for number in range(1, 201))


def test_the_line_to_blame_is_the_limit_not_the_draw() -> None:
    for conflict in (linked_conflict(3.95), split_conflict(3.95)):
        found = culprit_of(conflict)
        assert found.place == LIMIT
        assert found.limits == (CONSTANT,)
    assert culprit_of(None).place is None


def test_failures_at_one_line_are_one_bucket() -> None:
    results = fly(load_linked)
    (bucket,) = group_failures(results)
    assert bucket.code == "F1"
    assert bucket.culprit.place == LIMIT
    assert 2 <= len(bucket.missions) <= 20
    assert bucket.share == len(bucket.missions) / 200
    assert bucket.first_tick == bucket.last_tick == 265


class Stub:
    """A seeker that tells one line of every failure."""

    def __init__(self, cause: RankedLine) -> None:
        self.cause = cause

    def causes(self, missions: Missions) -> Causes:
        return Causes((self.cause,))

    def mends(self, cause: RankedLine, failed: MissionResult, beside: frozenset[str]) -> bool:
        return False


def test_only_a_line_that_was_flown_makes_one_fault_of_two_groups() -> None:
    results = fly(load_linked)
    (bucket,) = group_failures(results)
    groups = [replace(bucket, missions=(one,), parts=(one,)) for one in bucket.missions[:2]]
    flown = RankedLine(LIMIT, "", Claim.MENDS, SmallEdit(EditKind.CONSTANT, "a.nddl", 0, 1, "1", "2", 1))
    assert [one.parts for one, _ in faults_of(groups, results, Stub(flown))] == [bucket.missions[:2]]
    loose = RankedLine(LIMIT, "", Claim.LOOSE_END, variable="x")
    assert [one.parts for one, _ in faults_of(groups, results, Stub(loose))] == [(one,) for one in bucket.missions[:2]]


class LateStub(Stub):
    """A seeker that finds the line in the second of two groups alone; its change mends the first as well."""

    def causes(self, missions: Missions) -> Causes:
        self.asked = getattr(self, "asked", 0) + 1
        return Causes((self.cause,)) if self.asked > 1 else Causes(flights=40)

    def mends(self, cause: RankedLine, failed: MissionResult, beside: frozenset[str]) -> bool:
        return cause == self.cause


def test_what_a_later_cause_mends_is_one_fault_with_it_where_no_change_was_found_before() -> None:
    results = fly(load_linked)
    (bucket,) = group_failures(results)
    groups = [replace(bucket, missions=(one,), parts=(one,)) for one in bucket.missions[:2]]
    flown = RankedLine(LIMIT, "", Claim.MENDS, SmallEdit(EditKind.CONSTANT, "a.nddl", 0, 1, "1", "2", 1))
    ((found, causes),) = faults_of(groups, results, LateStub(flown))
    assert sorted(found.parts) == list(bucket.missions[:2])
    assert causes.first == replace(flown, among=2)


class WiderStub(Stub):
    """A seeker whose second cause mends the first group as well, but for one mission; the first mends its own alone."""

    def __init__(self, first: RankedLine, second: RankedLine, fails: int | None) -> None:
        super().__init__(second)
        self.found = [second, first]
        self.fails = fails

    def causes(self, missions: Missions) -> Causes:
        return Causes((self.found.pop(),))

    def mends(self, cause: RankedLine, failed: MissionResult, beside: frozenset[str]) -> bool:
        return cause == self.cause and failed.number != self.fails


@pytest.mark.parametrize(
    ("claim", "fails", "is_one"), [(Claim.MENDS, None, True), (Claim.MENDS, 2, False), (Claim.PARTLY, None, False)]
)
def test_a_later_cause_that_mends_a_group_before_is_that_of_both(claim: Claim, fails: int | None, is_one: bool) -> None:
    results = fly(load_linked)
    (bucket,) = group_failures(results)
    several, other = bucket.missions[:3], bucket.missions[3]
    groups = [
        replace(bucket, missions=several, parts=several[:1]),
        replace(bucket, missions=(other,), parts=(other,)),
    ]
    change = SmallEdit(EditKind.CONSTANT, "a.nddl", 0, 1, "1", "2", 1)
    narrow, wide = RankedLine(LIMIT, "", Claim.MENDS, change), RankedLine(CONSTANT, "", claim, change)
    found = faults_of(groups, results, WiderStub(narrow, wide, None if fails is None else several[fails]))
    firsts = [(len(one.missions), causes.first and causes.first.place) for one, causes in found]
    assert firsts == ([(4, CONSTANT)] if is_one else [(3, LIMIT), (1, CONSTANT)])


class UnlikeStub(WiderStub):
    """A seeker of whose causes none mends what the others are of."""

    def mends(self, cause: RankedLine, failed: MissionResult, beside: frozenset[str]) -> bool:
        return False


@pytest.mark.parametrize(("columns", "count"), [(0, 1), (9, 2)])
def test_first_causes_at_one_statement_are_one_fault_and_two_on_one_line_are_not(columns: int, count: int) -> None:
    results = fly(load_linked)
    (bucket,) = group_failures(results)
    groups = [replace(bucket, missions=(one,), parts=(one,)) for one in bucket.missions[:2]]
    change = SmallEdit(EditKind.CONSTANT, "a.nddl", 0, 1, "1", "2", 1)
    first = RankedLine(LIMIT, "", Claim.MENDS, change)
    second = RankedLine(replace(LIMIT, column=LIMIT.column + columns), "", Claim.MENDS, change)
    assert len(faults_of(groups, results, UnlikeStub(first, second, None))) == count


def reflying(load: Load) -> Refly:
    return lambda agent, number, seed: fly_one(load(agent), Task(number, seed))


@pytest.mark.parametrize(("load", "is_in_terms"), [(load_linked, True), (load_split, False)])
def test_the_condition_is_found_by_flying_again(load: Load, is_in_terms: bool) -> None:
    results = fly(load)
    (bucket,) = group_failures(results)
    found = find_condition(bucket, results, agent(), 7234, reflying(load))
    assert found is not None
    assert condition_text(found) == "GPS_HIT_RATE > 3.8"
    assert found.precision.value == found.recall.value == 1.0
    assert found.in_terms == (found.single if is_in_terms else ())


@pytest.mark.parametrize("most", [0, 20, 60])
def test_where_time_is_over_there_are_fewer_flights_and_the_condition_is_still_measured(most: int) -> None:
    results, flown = fly(load_split), [0]
    (bucket,) = group_failures(results)
    refly = reflying(load_split)

    def counted(given: AgentConfiguration, number: int, seed: int) -> MissionResult:
        flown[0] += 1
        return refly(given, number, seed)

    found = find_condition(bucket, results, agent(), 7234, counted, lambda share: flown[0] < share * most)
    whole = find_condition(bucket, results, agent(), 7234, refly)
    assert flown[0] <= max(most, 0.6 * most + 12) + 1
    assert whole is not None and whole.fresh > 100
    assert found is not None and 12 <= found.fresh <= max(most, 12)
    assert found.recall.interval[0] < whole.recall.interval[0]


def test_without_flights_the_samples_must_do() -> None:
    results = fly(load_split)
    (bucket,) = group_failures(results)
    found = find_condition(bucket, results, agent(), 7234, None)
    assert found is not None
    assert found.parameters == ("GPS_HIT_RATE",)
    assert found.near is None
    assert found.single[0].edge == pytest.approx(3.8, abs=0.05)


def test_what_stays_open_does_not_split_a_bucket() -> None:
    mission = Outcome(1, 90, 90, None, (), (), ())
    failed = Judgement(Verdict.FAIL, "F10", reason=Reason(ReasonKind.GOALS_OPEN))
    dropped = Reason(ReasonKind.DROPPED, repair=Reason(ReasonKind.GOES_ON, TokenName("Nav.Go", 3), tick=7))
    results = []
    for number, goals in enumerate((("map",), ("map", "sample"), ("sample",)), 1):
        token = TokenName("Nav.Go", number)
        lost = replace(dropped, repair=Reason(ReasonKind.GOES_ON, token, tick=7 + number))
        opened = tuple(OpenGoal(goal, "Visit", reason=lost) for goal in goals)
        results.append(MissionResult(number, number, failed, replace(mission, open_goals=opened), has_trace=True))
    (bucket,) = group_failures(tuple(results))
    assert bucket.missions == (1, 2, 3)


def test_the_events_lead_from_the_draw_to_the_abort() -> None:
    result = next(one for one in fly(load_split) if one.has_trace)
    assert result.outcome is not None
    events = [event_text(result.outcome.events[index]) for index in events_to_abort(result.outcome, ("GPS_HIT_RATE",))]
    assert events[0].startswith("GPS_HIT_RATE = 3.")
    assert events[1:] == ["Active(minHits=10.0)"]
    assert draws_behind(result.outcome) == ("GPS_HIT_RATE",)
