"""Fly real missions: run the executive from a seed, have what it did judged, and name files as the mission does."""

import sys
from collections.abc import Mapping
from contextlib import redirect_stdout
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import overload

from checker.batch.garbage import seldom_collected
from checker.coverage import universe_of
from checker.judge.judge import breaches, few_listed, judge_mission
from checker.judge.rendering import DisagreementError
from checker.names import relative_name
from checker.properties import property_fates
from nddl_lang.text.read import read_source
from runtime.executive.clocks import FastClock
from runtime.executive.configuration import AgentConfiguration, CodeConfiguration
from runtime.executive.events import changed_events
from runtime.executive.mission import MissionPrograms, record_mission
from runtime.executive.outcome import Conflict, Deadlock, Event, Outcome, SourcePlace
from runtime.executive.record import MissionRecord
from runtime.solver.configuration.configuration import Configuration, default_configuration
from runtime.solver.configuration.read import read_configuration
from runtime.user.reactor import Reactor
from runtime.user.reactor_library import load_reactor


def fly_programs(
    agent: AgentConfiguration,
    programs: MissionPrograms,
    seed: int,
    values: Mapping[str, float] | None = None,
    until: int | None = None,
    *,
    tells_on: bool = True,
    clock: FastClock | None = None,
) -> Outcome:
    """Fly one mission; `values` replaces draws of the named parameters, `until` ends it before its final tick, as does
    the agent's own.

    It raises `DisagreementError` where the judge holds that the executive broke the model. Without `tells_on`
    conflicts end at what was observed: enough for who asks for the verdict alone.
    """
    return fly_recorded(agent, programs, seed, values, until, tells_on=tells_on, clock=clock)[0]


def fly_recorded(
    agent: AgentConfiguration,
    programs: MissionPrograms,
    seed: int,
    values: Mapping[str, float] | None = None,
    until: int | None = None,
    *,
    tells_on: bool = True,
    clock: FastClock | None = None,
) -> tuple[Outcome, MissionRecord]:
    """The same, with the record of what was executed."""
    root = Path(agent.root)
    until = agent.until if until is None else until
    with seldom_collected(), redirect_stdout(sys.stderr):  # what constraints print would end up in reports
        outcome, record = record_mission(agent, programs, seed, values, until=until, tells_on=tells_on, clock=clock)
        record = few_listed(record)
        report = judge_mission(agent, programs.programs, outcome, record, programs.constraints, values)
    if report.errors:
        raise DisagreementError(report)
    behaviour = universe_of(programs.programs).features(record, outcome.events)
    arguments = _arguments(programs) if agent.properties else {}
    is_cut = outcome.abort is None and outcome.last_tick < agent.final_tick
    fates = property_fates(agent, arguments, record, outcome.last_tick, outcome.events, report.profiles, is_cut=is_cut)
    outcome = replace(outcome, breaches=breaches(report), behaviour=behaviour, properties=fates)
    return _relative(outcome, root), record


def _arguments(programs: MissionPrograms) -> dict[str, tuple[str, ...]]:
    """The names of the arguments of each predicate."""
    return {
        predicate.name: tuple(parameter.name for parameter in predicate.parameters)
        for program in programs.programs
        for predicate in program.predicates
    }


def load_code(root: Path, coded: tuple[CodeConfiguration, ...]) -> tuple[type[Reactor], ...]:
    """The classes of the reactors that are written in Python."""
    return tuple(load_reactor(root, each.file, each.class_name) for each in coded)


def load_solver(root: Path, path: str | None) -> Configuration:
    """The flaw handling in a file; the default where none is named."""
    if path is None:
        return default_configuration()
    configuration, complaints = read_configuration(read_source(root / path))
    assert configuration is not None, complaints  # a mission with mistakes is not flown
    return configuration


def _relative(outcome: Outcome, root: Path) -> Outcome:
    """The outcome with files named relative to the mission, so that it is the same in every checkout."""
    abort = outcome.abort
    if abort is not None:
        repairs = tuple(_conflict(one, root) for one in abort.repairs)
        abort = replace(
            abort, conflict=_conflict(abort.conflict, root), repairs=repairs, deadlock=_deadlock(abort.deadlock, root)
        )
    goals = tuple(
        replace(goal, conflict=_conflict(goal.conflict, root), deadlock=_deadlock(goal.deadlock, root))
        for goal in outcome.open_goals
    )
    events = changed_events(outcome.events, partial(_event, root=root))
    return replace(outcome, abort=abort, events=events, open_goals=goals)


def _event(event: Event, root: Path) -> Event:
    if event.conflict is None and event.deadlock is None:
        return event
    return replace(event, conflict=_conflict(event.conflict, root), deadlock=_deadlock(event.deadlock, root))


@overload
def _conflict(conflict: Conflict, root: Path) -> Conflict: ...
@overload
def _conflict(conflict: None, root: Path) -> None: ...
def _conflict(conflict: Conflict | None, root: Path) -> Conflict | None:
    if conflict is None:
        return None
    elements = (replace(element, place=_place(element.place, root)) for element in conflict.elements)
    return Conflict(tuple(elements))


def _deadlock(deadlock: Deadlock | None, root: Path) -> Deadlock | None:
    if deadlock is None:
        return None
    tried = (
        replace(one, conflict=_conflict(one.conflict, root), leads_to=_deadlock(one.leads_to, root))
        for one in deadlock.tried
    )
    return replace(deadlock, tried=tuple(tried))


def _place(place: SourcePlace | None, root: Path) -> SourcePlace | None:
    return None if place is None else replace(place, file=relative_name(place.file, root))
