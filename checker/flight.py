"""Fly real missions: load the models of an agent once, then run the executive from a seed."""

import sys
from collections.abc import Mapping
from contextlib import redirect_stdout
from dataclasses import replace
from functools import lru_cache, partial
from pathlib import Path
from typing import overload

from checker.batch.garbage import seldom_collected
from checker.batch.worker import Fly
from checker.coverage import universe_of
from checker.judge.judge import breaches, judge_mission
from checker.judge.rendering import DisagreementError
from checker.names import relative_name
from checker.properties import property_fates
from compiler.lower import compile_model
from nddl_lang.analysis import analyse_file
from nddl_lang.text.read import read_source
from runtime.executive.configuration import AgentConfiguration, CodeConfiguration
from runtime.executive.events import changed_events
from runtime.executive.mission import MissionPrograms, record_mission
from runtime.executive.outcome import Conflict, Deadlock, Event, Outcome, SourcePlace
from runtime.executive.record import MissionRecord
from runtime.solver.configuration.configuration import Configuration, default_configuration
from runtime.solver.configuration.read import read_configuration
from runtime.user.library import load_library
from runtime.user.reactor import Reactor
from runtime.user.reactor_library import load_reactor

Reactors = tuple[tuple[str, str | None], ...]  # model and solver of each


def load(agent: AgentConfiguration) -> Fly:
    """Compile the models of `agent`; the result flies one mission per call, and has it judged.

    It raises `DisagreementError` where the judge holds that the executive broke the model.
    """
    root = Path(agent.root)
    reactors = tuple((reactor.model, reactor.solver) for reactor in agent.reactors)
    load_programs(root, reactors, agent.constraints, agent.constraint_seconds)
    return partial(fly_once, agent)


def fly_once(
    agent: AgentConfiguration, seed: int, values: Mapping[str, float] | None = None, until: int | None = None
) -> Outcome:
    """Fly one mission; `values` replaces draws of the named parameters, `until` ends it before its final tick.

    It raises `DisagreementError` where the judge holds that the executive broke the model.
    """
    return fly_programs(agent, programs_of(agent), seed, values, until)


def fly_programs(
    agent: AgentConfiguration,
    programs: MissionPrograms,
    seed: int,
    values: Mapping[str, float] | None = None,
    until: int | None = None,
    *,
    tells_on: bool = True,
) -> Outcome:
    """Fly one mission with the models as they were compiled; see `fly_once`.

    Without `tells_on` conflicts end at what was observed: enough for who asks for the verdict alone.
    """
    return fly_recorded(agent, programs, seed, values, until, tells_on=tells_on)[0]


def fly_recorded(
    agent: AgentConfiguration,
    programs: MissionPrograms,
    seed: int,
    values: Mapping[str, float] | None = None,
    until: int | None = None,
    *,
    tells_on: bool = True,
) -> tuple[Outcome, MissionRecord]:
    """The same, with the record of what was executed."""
    root = Path(agent.root)
    with seldom_collected(), redirect_stdout(sys.stderr):  # what constraints print would end up in reports
        outcome, record = record_mission(agent, programs, seed, values, until=until, tells_on=tells_on)
        report = judge_mission(agent, programs.programs, outcome, record, programs.constraints, values)
    if report.errors:
        raise DisagreementError(report)
    behaviour = universe_of(programs.programs).features(record, outcome.events)
    arguments = _arguments(programs) if agent.properties else {}
    fates = property_fates(agent, arguments, record, outcome.last_tick, outcome.events, report.profiles)
    outcome = replace(outcome, breaches=breaches(report), behaviour=behaviour, properties=fates)
    return _relative(outcome, root), record


def _arguments(programs: MissionPrograms) -> dict[str, tuple[str, ...]]:
    """The names of the arguments of each predicate."""
    return {
        predicate.name: tuple(parameter.name for parameter in predicate.parameters)
        for program in programs.programs
        for predicate in program.predicates
    }


def programs_of(agent: AgentConfiguration) -> MissionPrograms:
    """The compiled models of `agent`, the flaw handling of its reactors, and the code of those in Python."""
    root = Path(agent.root)
    reactors = tuple((reactor.model, reactor.solver) for reactor in agent.reactors)
    programs = load_programs(root, reactors, agent.constraints, agent.constraint_seconds)
    return replace(programs, code=load_code(root, agent.coded))


@lru_cache(maxsize=4)
def load_programs(root: Path, reactors: Reactors, constraints: tuple[str, ...], seconds: float) -> MissionPrograms:
    """The compiled models and the flaw handling of some reactors; kept, for flights that differ in parameters only."""
    library = load_library(root, constraints, seconds=seconds)
    models = {
        model: compile_model(analyse_file(root / model, callables=library.callables))
        for model in dict.fromkeys(model for model, _ in reactors)
    }
    solvers = tuple(load_solver(root, solver) for _, solver in reactors)
    return MissionPrograms(tuple(models[model] for model, _ in reactors), solvers, library.constraints)


@lru_cache(maxsize=4)
def load_code(root: Path, coded: tuple[CodeConfiguration, ...]) -> tuple[type[Reactor], ...]:
    """The classes of the reactors that are written in Python."""
    return tuple(load_reactor(root, each.file, each.class_name) for each in coded)


def load_solver(root: Path, path: str | None) -> Configuration:
    """The flaw handling in a file; the default where none is named."""
    if path is None:
        return default_configuration()
    configuration, _ = read_configuration(read_source(root / path))
    return configuration or default_configuration()


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
