"""Variations of the missions of T-REX's rules: what comes of each was written down from the rules alone."""

import json
import os
from pathlib import Path
from typing import Any

import pytest

from checker.judge.rendering import disagreement_text
from checker.oracle import judge
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.mission import MissionPrograms, run_mission
from runtime.executive.outcome import Outcome
from runtime.executive.rendering import event_data
from tests.executive.determined_models import told
from tests.executive.flying import Flown, flown
from tests.executive.variations.form import Data, Variation, read_variations

FILES = sorted((Path(__file__).parent / "variations").glob("*.txt"))
FEWER = 1 if os.environ.get("NDDLC_CASES") == "all" else 5  # `make cases` has all flown in every way
VARIATIONS = [one for file in FILES for one in read_variations(file)]


@pytest.mark.parametrize("one", VARIATIONS, ids=lambda one: one.name)
def test_what_the_rules_say_comes_of_a_variation(one: Variation) -> None:
    mission = flown_of(one)
    assert mission.report.holds, [disagreement_text(each) for each in mission.report.disagreements]
    assert departures(one, mission.outcome) == []


@pytest.mark.once
@pytest.mark.parametrize("one", VARIATIONS[::FEWER], ids=lambda one: one.name)
def test_no_way_of_flying_changes_a_variation(one: Variation) -> None:
    mission = flown_of(one)
    programs = MissionPrograms(mission.programs, tuple(one.solver for _ in mission.programs))
    general, each = (fly(mission.agent, programs, **way) for way in ({"compiles": False}, {"every_tick": True}))
    assert told(general) == told(mission.outcome)
    assert [brief(event) for event in lines(each)] == [brief(event) for event in lines(mission.outcome)]


def fly(agent: AgentConfiguration, programs: MissionPrograms, **way: bool) -> Outcome:
    """The outcome of one way of flying."""
    return run_mission(agent, programs, 1, **way)  # type: ignore[arg-type]


def flown_of(one: Variation) -> Flown:
    """A variation once flown, and judged."""
    return flown(
        *one.flyers.values(),
        until=one.until,
        goals=tuple(one.goals),
        parameters=tuple(one.parameters),
        on_failure=one.on_failure,
        solver=one.solver,
    )


def lines(outcome: Outcome) -> list[Data]:
    """The events as the trace has them."""
    found: list[Data] = json.loads(json.dumps([event_data(event) for event in outcome.events]))
    return found


def brief(event: Data) -> tuple[Any, ...]:
    """An event without its reasons."""
    return tuple(event[key] for key in ("tick", "kind", "reactor", "timeline", "predicate", "arguments"))


def departures(one: Variation, outcome: Outcome) -> list[str]:
    """Where a flight is not as it must be."""
    judgement, events, wrong = judge(outcome), lines(outcome), []
    if (judgement.verdict.value, judgement.code) not in [(one.verdict[0], code) for code in one.verdict[1]]:
        wrong.append(f"{judgement.verdict.value} {judgement.code} and not {one.verdict}")
    if not at(one.last_tick, outcome.last_tick):
        wrong.append(f"ends at {outcome.last_tick}")
    for timeline, wanted in one.observations.items():
        got = [
            (event["tick"], event["predicate"], list(event["arguments"].values()))
            for event in events
            if event["kind"] == "observation" and event["timeline"] == timeline
        ]
        if not is_sequence(wanted, got):
            wrong.append(f"{timeline}: {got}")
    position = 0
    for pattern in one.events:
        found = [index for index in range(position, len(events)) if fits(pattern, events[index])]
        if not found:
            wrong.append(f"missing or out of order: {pattern}")
            break
        position = found[0] + 1
    wrong += [f"missing: {pattern}" for pattern in one.unordered if not any(fits(pattern, each) for each in events)]
    for pattern in one.counts:
        count = sum(fits(pattern, event) for event in events)
        if count != pattern["n"]:
            wrong.append(f"{count} of {pattern}")
    period, shown = one.draws
    values: dict[int, Any] = {}
    for event in events:
        for timeline, name in shown:
            if event["kind"] == "observation" and event["timeline"] == timeline and name in event["arguments"]:
                value = event["arguments"][name]
                if not same(values.setdefault(event["tick"] // period, value), value):
                    wrong.append(f"{timeline}.{name} is {value} at {event['tick']}")
    return wrong


def at(wanted: Any, tick: int) -> bool:
    """Whether a tick is the one wanted, or within bounds."""
    return bool(wanted[0] <= tick <= wanted[1] if isinstance(wanted, list) else wanted == tick)


def same(wanted: Any, got: Any) -> bool:
    """Whether a value is the one wanted, but for the rounding of numbers."""
    if isinstance(wanted, bool) or isinstance(got, bool) or not isinstance(wanted, int | float):
        return bool(wanted == got)
    return isinstance(got, int | float) and abs(wanted - got) <= 1e-9 * max(1.0, abs(wanted))


def is_sequence(wanted: list[Any], got: list[tuple[int, str, list[Any]]]) -> bool:
    """Whether observations are those wanted, in order, but for what may be missing."""
    if not wanted:
        return not got
    tick, predicate, values, *may = wanted[0]
    if (
        got
        and at(tick, got[0][0])
        and got[0][1] == predicate
        and len(values) == len(got[0][2])
        and all(map(same, values, got[0][2]))
        and is_sequence(wanted[1:], got[1:])
    ):
        return True
    return bool(may) and is_sequence(wanted[1:], got)


def fits(pattern: Data, event: Data) -> bool:
    """Whether an event is as a pattern has it."""
    arguments, wanted = event.get("arguments") or {}, pattern.get("arguments", {})
    return (
        all(
            event.get(key) == pattern[key]
            for key in ("kind", "reactor", "timeline", "predicate", "code")
            if key in pattern
        )
        and at(pattern.get("tick", event["tick"]), event["tick"])
        and all(name in arguments and same(value, arguments[name]) for name, value in wanted.items())
    )
