"""What an agent runs, for tests that make agents by hand."""

from collections.abc import Mapping
from pathlib import Path

from checker.flight import load_code, load_solver
from compiler.lower import compile_model
from compiler.program import Program
from nddl_lang.analysis import analyse_file
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.mission import MissionPrograms
from runtime.user.library import load_library


def programs_of(agent: AgentConfiguration, compiled: Mapping[str, Program] | None = None) -> MissionPrograms:
    """What `agent` runs, compiled from the files as they are at this moment, unless `compiled` has its models."""
    root = Path(agent.root)
    library = load_library(root, agent.constraints, seconds=agent.constraint_seconds)
    if compiled is None:
        models = {each.model: analyse_file(root / each.model, callables=library.callables) for each in agent.reactors}
        compiled = {name: compile_model(each) for name, each in models.items()}
    programs = tuple(compiled[each.model] for each in agent.reactors)
    solvers = tuple(load_solver(root, each.solver) for each in agent.reactors)
    return MissionPrograms(programs, solvers, library.constraints, load_code(root, agent.coded))
