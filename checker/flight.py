"""Fly real missions: load the models of an agent once, then run the executive from a seed."""

import re
import sys
from contextlib import redirect_stdout
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

from checker.batch.worker import Fly
from checker.names import relative_name
from compiler.lower import compile_model
from nddl_lang.analysis import analyse_file
from nddl_lang.text.read import read_source
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.mission import MissionPrograms, run_mission
from runtime.executive.outcome import Cause, Conflict, Outcome
from runtime.solver.configuration.configuration import Configuration, default_configuration
from runtime.solver.configuration.read import read_configuration
from runtime.user.library import load_library

PREFIX = re.compile(r"\b\w+:(?=\w)")  # the reactor's name before a variable's
Reactors = tuple[tuple[str, str | None], ...]  # model and solver of each


def load(agent: AgentConfiguration) -> Fly:
    """Compile the models of `agent`; the result flies one mission per call."""
    root = Path(agent.root)
    reactors = tuple((reactor.model, reactor.solver) for reactor in agent.reactors)
    programs = load_programs(root, reactors, agent.constraints, agent.constraint_seconds)

    def fly(seed: int) -> Outcome:
        with redirect_stdout(sys.stderr):  # what constraints print would end up in reports
            return _relative(run_mission(agent, programs, seed), root)

    return fly


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


def load_solver(root: Path, path: str | None) -> Configuration:
    """The flaw handling in a file; the default where none is named."""
    if path is None:
        return default_configuration()
    configuration, _ = read_configuration(read_source(root / path))
    return configuration or default_configuration()


def _relative(outcome: Outcome, root: Path) -> Outcome:
    """The outcome with files named relative to the mission, so that it is the same in every checkout."""
    abort = outcome.abort
    if abort is None:
        return outcome
    conflict = None if abort.conflict is None else _renamed(abort.conflict, root)
    repairs = tuple(_renamed(one, root) for one in abort.repairs)
    return replace(outcome, abort=replace(abort, conflict=conflict, repairs=repairs))


def _renamed(conflict: Conflict, root: Path) -> Conflict:
    return replace(conflict, causes=tuple(_placed(cause, root) for cause in conflict.causes))


def _placed(cause: Cause, root: Path) -> Cause:
    because = PREFIX.sub("", cause.because)
    if cause.place is None:
        return replace(cause, because=because)
    return replace(cause, because=because, place=replace(cause.place, file=relative_name(cause.place.file, root)))
