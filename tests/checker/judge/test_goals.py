"""Goals in the eyes of the judge: of a flight that is cut short only what is said to be achieved counts."""

from dataclasses import replace

import pytest

from runtime.executive.configuration import GoalConfiguration
from runtime.executive.outcome import EventKind
from runtime.executive.record import TokenRecord
from tests.checker.judge.corruption import again
from tests.executive.flying import Flown, flown, planner

MODEL = """
class User extends AgentTimeline { predicate Idle { } predicate Busy { } User(Mode m) { super(m, "Idle"); } }
User::Busy { duration == 8; }
User user = new User(Internal); close();
"""


def flight(stop: int | None) -> Flown:
    """A flight with one mandatory goal, executed from 3 to 11."""
    goals = (GoalConfiguration("user", "Busy", mandatory=True, start=(3, 3)),)
    return flown(planner("user", MODEL, "user"), until=30, goals=goals, stop=stop)


@pytest.mark.parametrize("stop", [2, 9, 11, 20, None])
def test_a_flight_may_be_cut_short_anywhere(stop: int | None) -> None:
    assert flight(stop).report.holds


@pytest.mark.parametrize("stop", [20, None])
def test_what_is_said_to_be_achieved_must_have_been_executed(stop: int | None) -> None:
    mission = flight(stop)
    [owner] = mission.record.reactors
    tokens = tuple(replace_end(one) if one.predicate == "User.Busy" else one for one in owner.tokens)
    record = mission.record._replace(reactors=(owner._replace(tokens=tokens),))
    assert "goal" in {one.kind for one in again(mission._replace(record=record)).disagreements}
    events = tuple(each for each in mission.outcome.events if each.kind is not EventKind.ACHIEVED)
    silent = mission._replace(record=record, outcome=replace(mission.outcome, events=events))
    assert ("goal" in {one.kind for one in again(silent).disagreements}) == (stop is None)


def replace_end(token: TokenRecord) -> TokenRecord:
    """The token, as if it went on."""
    assert isinstance(token.start, int)
    return token._replace(end=31, duration=31 - token.start)
