"""A judge that agrees with a right mission disagrees as soon as its record or its trace is altered."""

from collections.abc import Callable
from math import inf
from random import Random

import pytest

from runtime.executive.record import NOBODY, ValueRange
from tests.checker.judge.corruption import ALTERATIONS, again, executed, put
from tests.checker.judge.missions import MISSIONS, walking
from tests.executive.flying import Flown

OFTEN = 6


@pytest.mark.parametrize("alter", ALTERATIONS, ids=lambda one: one.__name__)
@pytest.mark.parametrize("name", MISSIONS)
def test_an_altered_record_is_noticed(name: str, alter: Callable[[Flown, Random], Flown | None]) -> None:
    silent = []
    for seed in (0, 1, 2):
        mission = MISSIONS[name](seed)
        assert mission.report.holds
        for number in range(OFTEN):
            altered = alter(mission, Random(f"{name} {seed} {alter.__name__} {number}"))
            if altered is None or (altered.record, altered.outcome) == (mission.record, mission.outcome):
                continue
            if again(altered).holds:
                silent.append((seed, number))
    assert not silent


@pytest.mark.parametrize("until", [30, 240])
def test_a_draw_that_was_left_open_is_noticed(until: int) -> None:
    mission = walking(1, until)
    reactor = mission.record.reactors[0]
    at = next(k for k in executed(reactor) if reactor.tokens[k].predicate == "Walk.Step")
    (run,) = reactor.tokens[at].runs
    open_run = run._replace(locals=(ValueRange(-inf, inf), *run.locals[1:]))
    report = again(put(mission, 0, at, reactor.tokens[at]._replace(runs=(open_run,))))
    assert [(one.kind, one.name) for one in report.disagreements] == [("draw", "GUST")]


@pytest.mark.parametrize("name", MISSIONS)
def test_a_right_mission_raises_no_alarm_and_little_is_left_open(name: str) -> None:
    for seed in range(12):
        report = MISSIONS[name](seed).report
        assert report.holds
        assert report.judged > 100 and report.open < report.judged / 10


def test_a_child_that_a_rule_has_run_without_is_noticed() -> None:
    mission = MISSIONS["cooking"](1)
    reactor = mission.record.reactors[0]
    at = next(k for k in executed(reactor) if reactor.tokens[k].predicate == "Chef.Cook")
    (run,) = reactor.tokens[at].runs
    without = run._replace(children=(NOBODY, *run.children[1:]))
    report = again(put(mission, 0, at, reactor.tokens[at]._replace(runs=(without,))))
    assert [(one.kind, one.name, one.found) for one in report.disagreements] == [("child", "h", "not on record")]
