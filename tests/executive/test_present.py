"""What a timeline holds when nothing forces it: goes on, begins what is planned, falls back, or tries anything else."""

import pytest

from runtime.executive.configuration import GoalConfiguration
from runtime.executive.outcome import ChoiceKind, PresentChoice
from runtime.executive.rendering import reason_text
from tests.executive.flying import fly, history, lines, planner, simulator

STATES = """
class Cell extends AgentTimeline {
  predicate A { } predicate B { } predicate C { }
  Cell(Mode m) { super(m, "A"); }
}
"""
CELL = "Cell cell = new Cell(Internal); close();"


def lived(rules: str, until: int = 9, objects: str = CELL, lookahead: int = 1) -> list[str]:
    """What a cell with these rules publishes."""
    outcome = fly(planner("it", f"{STATES}{rules}{objects}", "cell", lookahead=lookahead), until=until)
    assert outcome.abort is None, reason_text(outcome.abort.reason)
    return history(outcome, "cell")


def test_the_default_holds_from_the_first_tick_to_the_last() -> None:
    assert lived("") == ["0 A"]


def test_what_holds_goes_on_as_long_as_it_may() -> None:
    assert lived("Cell::A { duration <= 4; meets(B b); }") == ["0 A", "4 B"]


@pytest.mark.parametrize("lookahead", [1, 20])
def test_what_holds_is_kept_unless_its_timeline_is_early(lookahead: int) -> None:
    rules = "Cell::A { duration >= 2; duration <= 6; meets(B b); }"
    assert lived(rules, lookahead=lookahead) == ["0 A", "6 B"]
    text = f"{STATES}{rules}Cell cell = new Cell(Internal); close();"
    assert history(fly(planner("it", text, "cell", lookahead=20, early=("cell",))), "cell")[:2] == ["0 A", "2 B"]


def test_a_late_timeline_begins_what_nobody_asked_for_when_it_must() -> None:
    rules = "Cell::A { duration <= 3; any(B b); start <= b.start; b.start <= start + 5; } Cell::B { duration == 1; }"
    text = f"{STATES}{rules}Cell cell = new Cell(Internal); close(); goal(Cell.A first); first.start == 0;"
    usual = history(fly(planner("it", text, "cell", lookahead=20)), "cell")
    late = history(fly(planner("it", text, "cell", lookahead=20, late=("cell",))), "cell")
    assert usual[:2] == ["0 A", "3 B"]
    assert late[:3] == ["0 A", "3 A", "5 B"]


def test_the_default_comes_back_when_nothing_is_planned() -> None:
    rules = "Cell::A { duration == 3; meets(B b); } Cell::B { duration == 2; }"
    assert lived(rules) == ["0 A", "3 B", "5 A", "8 B"]


def test_the_default_follows_itself() -> None:
    assert lived("Cell::A { duration <= 4; }") == ["0 A", "4 A", "8 A"]


def test_another_value_is_taken_where_the_default_cannot_be() -> None:
    rules = "Cell::A { duration == 3; meets(B b); } Cell::B { duration == 2; meets(C c); }"
    assert lived(rules) == ["0 A", "3 B", "5 C"]
    assert lived("Cell::A { start >= 4; } Cell::B { start >= 2; }") == ["0 C"]


def test_a_timeline_without_a_default_name_begins_undefined() -> None:
    bare = "class Bare extends AgentTimeline { predicate A { } Bare(Mode m) { super(m); } }"
    outcome = fly(simulator("it", f"{bare} Bare bare = new Bare(Internal); close();", "bare"), until=3)
    assert history(outcome, "bare") == ["0 undefined"]


@pytest.mark.parametrize("given", ["fact", "goal"])
def test_what_the_script_says_of_the_first_tick_holds_then(given: str) -> None:
    script = f"Cell cell = new Cell(Internal); close(); {given}(Cell.C first); first.start == 0; first.duration == 4;"
    assert lived("", objects=script) == ["0 C", "4 A"]


def test_what_the_script_says_of_a_later_tick_holds_then() -> None:
    script = "Cell cell = new Cell(Internal); close(); goal(Cell.C later); later.start == 5; later.duration == 2;"
    assert lived("", objects=script, lookahead=20) == ["0 A", "5 C", "7 A"]


def test_nothing_fits_and_the_agent_says_so() -> None:
    rules = "Cell::A { duration <= 3; } Cell::B { start >= 5; } Cell::C { start >= 5; }"
    rules += " Cell::A { if (start > 0) { end <= 2; } } Cell::undefined { end <= 0; }"
    outcome = fly(simulator("it", f"{STATES}{rules}{CELL}", "cell"), until=9)
    assert outcome.abort is not None
    assert (outcome.abort.code, outcome.abort.tick) == ("F3", 3)
    assert outcome.abort.timelines == ("cell",)


def test_a_private_timeline_is_synchronised_like_any_other() -> None:
    rules = "Cell::A { duration == 3; meets(B b); }"
    assert lived(rules, objects=CELL.replace("Internal", "Private")) == ["0 A", "3 B"]


def test_a_requested_token_starts_as_soon_as_it_may() -> None:
    goals = (GoalConfiguration("cell", "B", at=4, duration=(2, 2)), GoalConfiguration("cell", "C", at=4, start=(8, 30)))
    outcome = fly(simulator("it", f"{STATES}{CELL}", "cell"), until=12, goals=goals)
    assert lines(outcome, "reject", "relax") == []
    assert history(outcome, "cell") == ["0 A", "5 B", "7 A", "8 C"]


def test_a_request_waits_until_its_timeline_is_free() -> None:
    goals = (GoalConfiguration("cell", "B", at=1), GoalConfiguration("cell", "C", at=2))
    outcome = fly(simulator("it", f"{STATES} Cell::B {{ duration == 5; }} {CELL}", "cell"), until=12, goals=goals)
    assert history(outcome, "cell") == ["0 A", "2 B", "7 C"]


def test_all_that_was_tried_on_a_timeline_is_told() -> None:
    model = """
    class User extends AgentTimeline { predicate Idle { } predicate Busy { } User(Mode m) { super(m, "Idle"); } }
    User::Idle { duration <= 3; start <= 0; }
    User::Busy { start >= 99; }
    User user = new User(Internal); close();
    """
    outcome = fly(planner("user", model, "user"), until=9)
    assert outcome.abort is not None and outcome.abort.code == "F3" and outcome.abort.deadlock is not None
    found = {}
    for one in outcome.abort.deadlock.tried:
        assert isinstance(one.choice, PresentChoice) and one.conflict is not None
        found[one.choice.kind, one.choice.predicate] = {each.place.line for each in one.conflict.elements if each.place}
    assert {kind for kind, _ in found} == {ChoiceKind.NEW} and len(found) == 2
    assert {4, 5} <= set().union(*found.values())
