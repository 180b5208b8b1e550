"""Fly small missions whose models are given as text: reactors in, readable traces out."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import product
from typing import NamedTuple

from checker.judge.judge import judge_mission
from checker.judge.rendering import disagreement_text
from checker.judge.report import JudgeReport
from compiler.lower import compile_model
from compiler.program import Program
from nddl_lang.analysis import analyse_text
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.text.diagnostic import Severity
from runtime.executive.configuration import (
    AgentConfiguration,
    GoalConfiguration,
    OnFailure,
    ParameterConfiguration,
    ReactorConfiguration,
)
from runtime.executive.mission import MissionPrograms, record_mission
from runtime.executive.outcome import Outcome
from runtime.executive.record import MissionRecord
from runtime.executive.rendering import event_text, goal_text
from runtime.solver.configuration.configuration import Configuration, default_configuration


@dataclass(frozen=True, slots=True)
class Flyer:
    """One reactor: its place among the others, and its model as text; `TREX.nddl` is included by itself."""

    configuration: ReactorConfiguration
    text: str


def simulator(name: str, text: str, internal: str, external: str = "", latency: int = 0) -> Flyer:
    """A reactor that looks one tick ahead; timelines are named in one string."""
    return planner(name, text, internal, external, latency, lookahead=1)


def planner(
    name: str,
    text: str,
    internal: str = "",
    external: str = "",
    latency: int = 0,
    lookahead: int = 100,
    max_steps: int | None = None,
    early: tuple[str, ...] = (),
    late: tuple[str, ...] = (),
) -> Flyer:
    """A reactor that plans ahead."""
    place = ReactorConfiguration(
        name,
        f"{name}.nddl",
        latency,
        lookahead,
        tuple(internal.split()),
        tuple(external.split()),
        early=early,
        late=late,
        max_steps=max_steps,
    )
    return Flyer(place, text)


@lru_cache(maxsize=64)
def program(name: str, text: str) -> Program:
    """A model given as text."""
    analysis = analyse_text(name, f'#include "TREX.nddl"\n{text}', Dialect.NDDLC)
    errors = [each.message for each in analysis.diagnostics if each.severity is Severity.ERROR]
    assert not errors, errors
    return compile_model(analysis)


class Flown(NamedTuple):
    """A mission that was flown, and what it takes to judge it."""

    agent: AgentConfiguration
    programs: tuple[Program, ...]
    outcome: Outcome
    record: MissionRecord
    report: JudgeReport


def flown(
    *flyers: Flyer,
    until: int = 10,
    goals: tuple[GoalConfiguration, ...] = (),
    parameters: tuple[ParameterConfiguration, ...] = (),
    on_failure: OnFailure = "abort_agent",
    seed: int = 1,
    overrides: Mapping[str, float] | None = None,
    every_tick: bool = False,
    compiles: bool = True,
    stop: int | None = None,
    solver: Configuration | None = None,
) -> Flown:
    """Fly one mission and judge it; `stop` ends the flight before the final tick, `solver` is that of all reactors."""
    agent = AgentConfiguration(
        "toy",
        ".",
        until,
        tuple(replace(flyer.configuration, solver="solver.toml" if solver else None) for flyer in flyers),
        goals,
        parameters,
        on_failure=on_failure,
    )
    programs = tuple(program(flyer.configuration.model, flyer.text) for flyer in flyers)
    solvers = tuple(solver or default_configuration() for _ in flyers)
    outcome, record = record_mission(
        agent, MissionPrograms(programs, solvers), seed, overrides, every_tick, stop, compiles
    )
    report = judge_mission(agent, programs, outcome, record, overrides=overrides)
    return Flown(agent, programs, outcome, record, report)


def in_all_ways(
    flyer: Flyer,
    until: int,
    goals: tuple[GoalConfiguration, ...],
    parameters: tuple[ParameterConfiguration, ...],
    seed: int,
) -> Outcome:
    """A mission by register code and by the general engine, each with and without every tick visited: all are equal.

    Within a tick, what was achieved comes in the order in which each engine has decided of timelines.
    """
    ways = [
        flown(flyer, until=until, goals=goals, parameters=parameters, seed=seed, compiles=compiles, every_tick=every)
        for compiles, every in product((True, False), (False, True))
    ]
    assert all(each.report.holds for each in ways)
    told = [[line for line in lines(each.outcome) if " sample " not in line] for each in ways]
    for each in told:
        each.sort(key=lambda line: (int(line.split()[0]), line if " achieved " in line else ""))
    assert told[0] == told[1] == told[2] == told[3]
    return ways[0].outcome


def fly(
    *flyers: Flyer,
    until: int = 10,
    goals: tuple[GoalConfiguration, ...] = (),
    parameters: tuple[ParameterConfiguration, ...] = (),
    on_failure: OnFailure = "abort_agent",
    seed: int = 1,
    overrides: Mapping[str, float] | None = None,
    every_tick: bool = False,
) -> Outcome:
    """Fly one mission; the judge has to agree."""
    mission = flown(
        *flyers,
        until=until,
        goals=goals,
        parameters=parameters,
        on_failure=on_failure,
        seed=seed,
        overrides=overrides,
        every_tick=every_tick,
    )
    assert mission.report.holds, [disagreement_text(one) for one in mission.report.disagreements]
    return mission.outcome


def lines(outcome: Outcome, *kinds: str) -> list[str]:
    """The events of a mission as texts: tick, kind, reactor, timeline, what; `kinds` are those that are told."""
    return [
        " ".join(filter(None, (str(e.tick), e.kind, e.reactor, e.timeline, event_text(e))))
        for e in outcome.events
        if not kinds or e.kind in kinds
    ]


def history(outcome: Outcome, timeline: str) -> list[str]:
    """What was published on a timeline: tick and value."""
    return [f"{e.tick} {event_text(e)}" for e in outcome.events if e.kind == "observation" and e.timeline == timeline]


def open_goals(outcome: Outcome) -> list[str]:
    """The mandatory goals that were not achieved, each with its reason."""
    return [goal_text(goal) for goal in outcome.open_goals]
