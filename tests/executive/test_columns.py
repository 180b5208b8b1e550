"""Columns: what a simulator did is kept as numbers, and reads as the tokens and events that they stand for."""

import pickle
from dataclasses import replace
from functools import lru_cache
from math import inf
from pathlib import Path

import numpy as np
import pytest

from checker.batch.result import MissionResult, read_record, write_record
from checker.figures import Figures
from checker.mission import read_mission
from checker.oracle import judge
from checker.report.track import track_of
from runtime.executive.columns import GuardColumns, RunColumns, StoredValues, TokenColumns, ValueColumn
from runtime.executive.events import EventLog, causes_of, events_on, heads_of, numbered, single_events
from runtime.executive.mission import record_mission
from runtime.executive.outcome import EventKind, Outcome
from runtime.executive.record import BodyRun, GuardRun, MissionRecord, Value, ValueRange
from tests.executive.determined_models import random_case
from tests.executive.flying import fly, simulator
from tests.programs import programs_of

INL = Path(__file__).resolve().parents[2] / "models/auv/inl/mission.toml"


@lru_cache(maxsize=1)
def flown() -> tuple[Outcome, MissionRecord]:
    mission, _ = read_mission(INL)
    assert mission is not None
    return record_mission(mission.agent, programs_of(mission.agent), 3, until=700)


def value(column: ValueColumn, row: int, names: list[str]) -> Value:
    number = column.numbers[row].item()
    if number != number:
        return ValueRange(-inf, inf)
    match column.kind:
        case "name":
            return names[int(number)]
        case "bool":
            return bool(number)
        case kind:
            return int(number) if kind == "int" else number


def run_of(run: RunColumns, row: int, names: list[str]) -> BodyRun:
    guards = tuple(guard_of(each, row, names) for each in run.guards)
    return BodyRun(
        run.rule,
        tuple(value(each, 0, names) for each in run.locals.part(row, row + 1)),
        tuple(each[row].item() for each in run.children),
        guards,
    )


def guard_of(guard: GuardColumns, row: int, names: list[str]) -> GuardRun:
    is_true = bool(guard.is_true[row])
    run = guard.then if is_true else guard.otherwise
    index = int((guard.is_true[:row] == is_true).sum())  # among the rows that took the same branch
    return GuardRun("then" if is_true else "else", True, None if run is None else run_of(run, index, names))


def arguments_of(tokens: TokenColumns, index: int, names: list[str]) -> tuple[Value, ...]:
    kinds = tokens.kinds[tokens.times.predicates[index]]
    stored = StoredValues(tokens.store, tokens.times.values[index : index + 1], kinds)
    return tuple(value(column, 0, names) for column in stored.columns())


def compare(tokens: TokenColumns) -> int:
    """Compare every group with the tokens that it stands for; how many there are."""
    names = list(tokens.symbols)
    seen: set[int] = set()
    for group in tokens.groups:
        for row, index in enumerate(group.indices.tolist()):
            token = tokens[index]
            assert (token.predicate, token.object, token.state) == (group.predicate, group.object, "active")
            assert token.arguments == arguments_of(tokens, index, names)
            assert token.runs == tuple(run_of(each, row, names) for each in group.runs)
            seen.add(index)
    active = {index for index, token in enumerate(tokens) if token.state == "active"}
    assert seen == active
    return len(seen)


def test_groups_of_columns_are_the_tokens_of_the_record() -> None:
    tokens = flown()[1].reactors[2].tokens
    assert isinstance(tokens, TokenColumns)
    assert compare(tokens) > 700


@pytest.mark.parametrize("seed", range(12))
def test_groups_of_random_simulators_are_their_tokens(seed: int) -> None:
    agent, programs = random_case(seed).agent()
    for reactor in record_mission(agent, programs, seed)[1].reactors:
        if isinstance(reactor.tokens, TokenColumns):
            compare(reactor.tokens)


def test_times_of_columns_are_those_of_the_tokens() -> None:
    tokens = flown()[1].reactors[2].tokens
    assert isinstance(tokens, TokenColumns)
    times, names = tokens.times, tokens.names
    for index, token in enumerate(tokens):
        assert token.key == times.keys[index]
        assert (token.predicate, token.object) == (names[times.predicates[index]], names[times.objects[index]])
        assert token.merged_into == times.merged_into[index]
        assert (token.fate == "over", token.tick) == (bool(times.is_over[index]), times.ticks[index])
        assert not isinstance(token.start, int) or token.start == times.starts[index]
        assert not isinstance(token.end, int) or token.end == times.ends[index] == times.latest[index]


def test_events_read_by_index_are_those_that_are_passed_by() -> None:
    events = flown()[0].events
    assert isinstance(events, EventLog)
    passed = tuple(events)
    assert [events[k] for k in range(len(events))] == list(passed)
    assert events[-1] == passed[-1] and events[3:7] == passed[3:7] and events == passed
    with pytest.raises(IndexError):
        events[len(events)]


def test_each_cause_of_an_event_came_before_it() -> None:
    events = flown()[0].events
    lines: dict[str, int] = {}
    for index, event in enumerate(events):
        assert all(cause < index for cause in event.causes)
        if event.kind is EventKind.OBSERVATION and event.reactor == "psim":
            last = lines.get(event.timeline)
            assert (
                event.causes == (() if last is None else (last,)) or events[event.causes[0]].kind is EventKind.REQUEST
            )
            lines[event.timeline] = index


def test_a_sent_trace_is_the_same_trace() -> None:
    events = flown()[0].events
    sent = pickle.loads(pickle.dumps(events))
    assert isinstance(sent, EventLog) and sent == events
    assert pickle.loads(pickle.dumps(sent)) == events


def test_a_kept_trace_is_the_same_trace() -> None:
    outcome = flown()[0]
    sent = replace(outcome, events=pickle.loads(pickle.dumps(outcome.events)))
    texts = {write_record(MissionResult(1, 3, judge(each), each, True)) for each in (outcome, sent)}
    assert len(texts) == 1
    found = read_record(MissionResult, texts.pop()).outcome
    assert found == outcome


def test_questions_about_a_trace_are_answered_as_by_its_events() -> None:
    events = flown()[0].events
    passed = tuple(events)
    for each in (events, pickle.loads(pickle.dumps(events))):
        assert list(heads_of(each)) == list(heads_of(passed))
        assert list(causes_of(each)) == [event.causes for event in passed]
        assert list(events_on(each, {"helm", "motion"})) == list(events_on(passed, {"helm", "motion"}))
        assert list(numbered(each)) == [(index, passed[index]) for index, _ in numbered(each)]
        assert [event for _, event in numbered(each)] == single_events(events)


def test_the_way_read_off_columns_is_that_of_the_events() -> None:
    outcome = flown()[0]
    figures = Figures("motion", ("x", "y", "z"), "", "", "", "helm", "Run", "path", "survey")
    one, other = (track_of(each, figures) for each in (outcome, replace(outcome, events=tuple(outcome.events))))
    assert one is not None and other is not None
    assert np.array_equal(one.ticks, other.ticks) and np.array_equal(one.positions, other.positions)
    assert (one.samples, one.targets, len(one.phases)) == (other.samples, other.targets, len(other.phases))
    assert one.samples and one.targets


def test_single_events_are_all_but_those_of_the_simulator() -> None:
    events = flown()[0].events
    assert single_events(events) == [event for event in events if event in single_events(events)]
    assert len(single_events(events)) < len(events) / 4


COUNTER = """
class Count extends AgentTimeline { predicate At { int n; int m; } Count(Mode m) { super(m, "At"); } }
Count::At { duration == SPAN; meets(object.At next); m == n + 1; next.n == m; }
Count count = new Count(Internal);
close();
fact(count.At a); a.start == 0; a.n == 0;
"""


def test_two_simulators_that_run_ahead_tell_in_the_order_of_time() -> None:
    one = simulator("one", COUNTER.replace("SPAN", "2").replace("count", "one"), "one")
    two = simulator("two", COUNTER.replace("SPAN", "3").replace("count", "two"), "two")
    ticks = [event.tick for event in fly(one, two, until=600).events]
    assert ticks == sorted(ticks) and len(ticks) > 500
    assert fly(one, two, until=600, every_tick=True).events == fly(one, two, until=600).events


def test_the_first_observation_of_a_predicate_is_found_without_expanding_any() -> None:
    events = flown()[0].events
    assert isinstance(events, EventLog)
    single = [(one.tick, one.timeline) for one in single_events(events) if one.kind is EventKind.OBSERVATION]
    firsts: dict[str, tuple[int, str]] = {}
    for _, tick, timeline, predicate in heads_of(events):
        if (tick, timeline) not in single:
            firsts[predicate] = min(firsts.get(predicate, (tick, timeline)), (tick, timeline))
    assert {"Step", "Holds", "Ready"} <= firsts.keys()
    for log in (events, pickle.loads(pickle.dumps(events))):
        assert {each: log.first_in_runs(each) for each in firsts} == {each: [one] for each, one in firsts.items()}
        assert log.first_in_runs("Failed") == []
