"""An order of tokens that a search tried in vain is told as that, not as what happened."""

from pathlib import Path

from checker.rendering import element_line, step_text
from checker.steps import StepKind
from runtime.executive.outcome import ConflictElement, ElementKind
from runtime.plan.readout.names import TokenName, VariableName
from runtime.plan.readout.statements import Term
from tests.checker.fault_study import faults_in, laid_out
from tests.checker.told_steps import JOB_MISSION, failed_mission, steps_of

FERRY = Path(__file__).parent / "unseen" / "ferry"
RAISED_TOO_LONG = 1  # the fault by its index
SHARED = """#include "TREX.nddl"
class Job extends AgentTimeline { predicate Free { } predicate Do { } Job(Mode m) { super(m, "Free"); } }
class Dev extends AgentTimeline { predicate Off { } predicate Run { int n; } Dev(Mode m) { super(m, "Off"); } }
"""
PLANNER = """#include "shared.nddl"
Job::Do {
  contains(Dev.Run a);
  contains(Dev.Run b);
  contains(Dev.Run c);
  a.n == 1;
  b.n == 2;
  c.n == 3;
  a.duration == 10;
  b.duration == 10;
  c.duration == 10;
  duration <= 25;
}
Job job = new Job(Internal);
Dev dev = new Dev(External);
close();
"""
SIMULATOR = """#include "shared.nddl"
Dev::Run { duration == 10; }
Dev dev = new Dev(Internal);
close();
"""


def test_an_order_that_a_search_gave_up_again_is_no_fact(tmp_path: Path) -> None:
    files = {"shared.nddl": SHARED, "planner.nddl": PLANNER, "simulator.nddl": SIMULATOR, "mission.toml": JOB_MISSION}
    steps = steps_of(tmp_path, files, 1)
    given, failed = failed_mission(tmp_path, 1)
    story = given.story(failed, None)
    told = [step_text(step, story) for step in steps if step.kind in (StepKind.CAUSE, StepKind.FAULT)]
    assert "by the order of tokens" not in " ".join(told)
    assert any(text.endswith("(by an order of tokens that was tried in vain)") for text in told)


def test_an_order_of_what_happened_is_told_as_before(tmp_path: Path) -> None:
    """The bridge was down, and then raised: the river found no place for `Up` alone."""
    place = laid_out(FERRY, list(faults_in(FERRY))[RAISED_TOO_LONG], tmp_path / "ferry")
    given, failed = failed_mission(place, 4)
    story = given.story(failed, None)
    told = [step_text(step, story) for step in story.steps if step.kind is StepKind.CAUSE]
    assert "Bridge.Down#1.end <= Bridge.Raising#26.start (by the order of tokens)" in told
    assert "Bridge.Up#10.end <= Bridge.Down#1.start (by an order of tokens that was tried in vain)" in told


def test_what_the_executive_does_and_tokens_that_are_one_are_no_orders() -> None:
    token, other, seen = (TokenName("Dev.Run", 2), TokenName("Job.Do", 1), TokenName("Dev.Run", 5))
    start, end, its, ready = (
        VariableName("start", "int", token),
        VariableName("end", "int", token),
        VariableName("start", "int", seen),
        VariableName("end", "int", other),
    )
    told = [
        element_line(ConflictElement(ElementKind.ORDER, None, "Dev.Run", token, term, (term,)))
        for term in (
            Term("bounds", (start, 6, 6)),
            Term("bounds", (end, 9, 9)),
            Term("bounds", (end, 12, 10**9)),
            Term("precedence", (its, start, 0)),
            Term("precedence", (start, ready, 0)),
        )
    ]
    ends = [text[text.index(" (") + 2 : -1] for text in told]
    assert ends == [
        "as the executive begins it",
        "as the executive ends it",
        "as it goes on",
        "both are one token",
        "by the order of tokens",
    ]
