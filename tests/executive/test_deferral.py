"""Deferral: observations that cannot matter wait; nothing but the number of visits tells the difference."""

from collections.abc import Iterator

import pytest

from runtime.executive import mission
from runtime.executive.configuration import GoalConfiguration
from runtime.executive.plan_reactor import PlanReactor
from runtime.executive.record import TokenRecord
from runtime.executive.rendering import trace_line
from tests.executive.flying import flown as fly_and_judge
from tests.executive.flying import planner, simulator

SHARED = """
class Speed extends AgentTimeline { predicate Is { float v; } Speed(Mode m) { super(m, "Is"); } }
class Step extends AgentTimeline { predicate At { float v; float w; } Step(Mode m) { super(m, "At"); } }
"""
OWNER = f"""{SHARED}
Step::At {{ duration == 3; meets(object.At next); w == v + 1.5; next.v == w; }}
Speed::Is {{ starts_during(Step.At now); v == now.v; duration == 3; }}
Step step = new Step(Private); Speed speed = new Speed(Internal);
close();
fact(step.At a); a.start == 0; eq(a.v, 0.0);
"""
USER = f"""{SHARED}
class Work extends AgentTimeline {{
  predicate Idle {{ }} predicate Do {{ float seen; }} predicate Rest {{ float seen; }}
  Work(Mode m) {{ super(m, "Idle"); }}
}}
RULES
Work work = new Work(Internal); Speed speed = new Speed(Observe);
close();
"""
READS = """
Work::Do { if (start <= AGENT_CLOCK) { starts_during(Speed.Is now); seen == now.v; } duration <= 7; meets(Rest r); }
Work::Rest { if (start <= AGENT_CLOCK) { any(Speed.Is s); s before this; seen == s.v; } duration <= 4; }
"""
GOALS = (
    GoalConfiguration("work", "Do", start=(20, 30)),
    GoalConfiguration("work", "Do", start=(61, 70)),
)
VISITS: list[int] = []


class Counted(PlanReactor):
    """A reactor whose visits are counted."""

    def start_tick(self, tick: int) -> None:
        VISITS.append(tick)
        super().start_tick(tick)


@pytest.fixture(autouse=True)
def visits(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setattr(mission, "PlanReactor", Counted)
    yield
    VISITS.clear()


def flown(rules: str, every_tick: bool) -> tuple[list[str], list[TokenRecord], int]:
    """The trace, the record of the user, and how often the user was awake."""
    VISITS.clear()
    user = planner("user", USER.replace("RULES", rules), "work", "speed")
    found = fly_and_judge(user, simulator("sim", OWNER, "step speed"), until=120, goals=GOALS, every_tick=every_tick)
    assert found.outcome.abort is None and found.report.holds
    tokens = [token._replace(tick=0) for token in found.record.reactors[0].tokens]
    return [f"{trace_line(event)} {event.token}" for event in found.outcome.events], tokens, len(VISITS)


@pytest.mark.parametrize(
    "rules",
    [
        "",
        READS,
        "Speed::Is { v <= 1000.0; }",
        "Work::Do { duration <= 7; contains(Speed.Is s); s.v <= 90.0; }",
        "Work::Do { duration <= 7; starts_after(Speed.Is s); }",
    ],
)
def test_what_waits_is_folded_in_as_if_it_had_not(rules: str) -> None:
    trace, tokens, _ = flown(rules, every_tick=False)
    every_trace, every_tokens, _ = flown(rules, every_tick=True)
    assert trace == every_trace
    assert tokens == every_tokens
    assert sum(token.predicate == "Speed.Is" for token in tokens) >= 40


def test_a_reactor_sleeps_through_what_it_does_not_read() -> None:
    assert flown(READS, every_tick=False)[2] < 25
    assert flown("", every_tick=False)[2] < 15


def test_a_rule_about_what_is_observed_wakes_its_reactor() -> None:
    assert flown("Speed::Is { v <= 1000.0; }", every_tick=False)[2] > 40
