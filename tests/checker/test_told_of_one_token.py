"""Of a line that some tokens of a rule came to, a story tells what holds of the token that it is about."""

from pathlib import Path

import pytest

from checker.buckets import group_failures
from checker.conditions.condition import Condition, Literal, Share, axis_feature
from checker.findings import Fault
from checker.influence import ArgumentCondition
from checker.steps import Step, StepKind
from compiler.program import DomainConstant
from tests.checker.fault_study import faults_in, laid_out
from tests.checker.told_steps import failed_mission

pytestmark = pytest.mark.once

FERRY = Path(__file__).parent / "unseen" / "ferry"
TOO_SHORT, FAILING = 3, 9  # the fault `TRIP_MAX = 110`, and a mission that a crossing to the west makes fail


@pytest.fixture(scope="module")
def steps(tmp_path_factory: pytest.TempPathFactory) -> tuple[Step, ...]:
    place = laid_out(FERRY, list(faults_in(FERRY))[TOO_SHORT], tmp_path_factory.mktemp("ferry") / "short")
    given, failed = failed_mission(place, FAILING)
    (bucket,) = group_failures((failed,))
    share = Share(1.0, (0.0, 1.0))
    condition = Condition(((Literal(axis_feature("STREAM"), True, 0.2),),), share, share, 1, None, 0)
    return given.story(failed, Fault(bucket, condition, None)).steps


def test_a_branch_that_its_arguments_rule_out_is_not_told(steps: tuple[Step, ...]) -> None:
    lines = [one.place.text for one in steps if one.kind is StepKind.LINE and one.place is not None]
    assert "way == SPEED + 0.5 * stream;" in lines  # to the west
    assert "way == SPEED - stream;" not in lines


def test_a_rule_whose_tokens_handed_on_another_value_did_not_ask(steps: tuple[Step, ...]) -> None:
    asking = [one.place.line for one in steps if one.kind is StepKind.ASKED and one.place is not None]
    assert asking == [54]  # of Table.Trip; the only Table.Connection had 20 people


@pytest.mark.parametrize(("is_equal", "fails"), [(True, [False, True, False]), (False, [True, False, False])])
def test_an_argument_that_is_open_rules_nothing_out(is_equal: bool, fails: list[bool]) -> None:
    test = ArgumentCondition("to", "EAST", is_equal)
    domains = [DomainConstant("enum", "Bank", None, one) for one in (("EAST",), ("WEST",), ("EAST", "WEST"))]
    assert [test.fails((("to", one),)) for one in domains] == fails
    assert not test.fails(())
