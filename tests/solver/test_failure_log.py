"""What a failure log says of resources: who needs how much of what there is, in one conflict."""

from pathlib import Path

from runtime.plan.readout.cause_rendering import words
from runtime.solver.learning.attempts import Attempt
from runtime.solver.learning.failure_log import FailureLog
from runtime.solver.learning.rendering import story
from runtime.solver.tags import EXHAUSTED
from tests.solver.planning import resources_configuration, solver_for


def only_attempt(folder: Path, text: str) -> Attempt:
    """The one attempt in the failure log of a model without a plan."""
    solver = solver_for(folder, text, how=resources_configuration())
    log = FailureLog(solver.database, solver.agenda, solver.stack)
    solver.failure_log = log
    assert solver.solve(2000, 2**60) == EXHAUSTED
    failure = log.end
    while failure is not None:
        (attempt,) = failure.attempts
        failure = attempt.dead_end
    return attempt


def test_uses_that_do_not_fit_are_one_conflict(tmp_path: Path) -> None:
    text = "Unary tool = new Unary();\nclose();\n"
    for name, length in (("a", 3), ("b", 4), ("c", 2)):
        text += f"goal(tool.use {name}); eq({name}.duration, {length}); leq(2, {name}.start); leq({name}.end, 10);\n"
    told = only_attempt(tmp_path, text)
    assert words(told.causes[0].term) == "tool needs 9 of 8 ticks available in [2, 10]: a 3, b 4, c 2"
    assert [line.span is not None for line in told.causes] == [False, *[True] * 9]
    assert {line.span.line for line in told.causes if line.span is not None} == {3, 4, 5}


def test_the_amount_counts_where_there_is_more_than_one(tmp_path: Path) -> None:
    text = "Reusable team = new Reusable(2.0, 0.0); close();"
    for name in "abcde":
        text += f"goal(team.uses {name}); eq({name}.duration, 3); eq({name}.quantity, 1.0);"
        text += f"leq(0, {name}.start); leq({name}.end, END);"
    told = words(only_attempt(tmp_path, text.replace("END", "7")).causes[0].term)
    assert told == "team needs 15 of 14 amount times ticks available in [0, 7]: a 3, b 3, c 3, d 3, e 3"
    told = words(only_attempt(tmp_path, text.replace("END", "5")).causes[0].term)
    assert told == "team needs 5 of 2 available at 2: a 1, b 1, c 1, d 1, e 1"


def test_a_tank_that_runs_dry_says_to_what_it_falls(tmp_path: Path) -> None:
    text = "Reservoir tank = new Reservoir(5.0, 0.0, 10.0); close();"
    for name in "ab":
        text += f"goal(tank.consume {name}); eq({name}.quantity, 3.0); leq(0, {name}.time); leq({name}.time, 10);"
    assert words(only_attempt(tmp_path, text).causes[0].term) == (
        "the level of tank falls to -1 at 10, its least is 0: a 3, b 3"
    )
    assert words(only_attempt(tmp_path, text.replace("consume", "produce")).causes[0].term) == (
        "the level of tank rises to 11 at 10, its greatest is 10: a 3, b 3"
    )


def test_a_use_is_named_with_the_token_that_asks_for_it(tmp_path: Path) -> None:
    text = """
        Reusable m = new Reusable(1.0, 0.0);
        class Job extends Timeline { predicate run { } }
        Job::run { eq(duration, 4); equals(m.uses u); eq(u.quantity, 1.0); leq(0, start); leq(end, 7); }
        Job one = new Job(); Job two = new Job();
        close();
        goal(one.run a); a.start = [0 9];
        goal(two.run b); b.start = [0 9];
    """
    solver = solver_for(tmp_path, text, how=resources_configuration())
    log = FailureLog(solver.database, solver.agenda, solver.stack)
    solver.failure_log = log
    assert solver.solve(2000, 2**60) == EXHAUSTED
    assert log.end is not None
    assert "m needs 2 of 1 available at 3: Reusable.uses#1 of b 1, Reusable.uses#2 of a 1" in "\n".join(story(log.end))
