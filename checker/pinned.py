"""The models of a mission as they were read, so that every process of a run flies the same ones."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache, partial
from pathlib import Path

from checker.batch.identity import model_digest
from checker.batch.worker import Fly
from checker.flight import fly_programs, load_code, load_solver
from checker.models import ModelSet
from checker.mutation.variant import Overlay
from compiler.program import Program
from nddl_lang.text.read import read_text, real_path
from runtime.executive.configuration import AgentConfiguration, CodeConfiguration
from runtime.executive.mission import MissionPrograms
from runtime.solver.configuration.configuration import Configuration, default_configuration
from runtime.user.fault import UserCodeError
from runtime.user.library import load_library

_Reactors = tuple[tuple[str, str | None], ...]  # model and solver of each
_CHANGED = "what was flown so far was flown with the code before; start again to fly it as it is now"


@dataclass(frozen=True, slots=True)
class PinnedModels:
    """The models of a mission as they were read: what every process flies, though files change in the meantime.

    Called with an agent, it gives what flies one mission per call and has it judged; that raises `DisagreementError`
    where the judge holds that the executive broke the model. Python code of the project is loaded by each process
    itself; where its text is another by then, UserCodeError is raised.
    """

    digest: str  # of all texts
    texts: Mapping[str, str] = field(compare=False, repr=False)  # by name relative to the mission file
    programs: Mapping[str, Program] = field(compare=False, repr=False)  # by model as the mission file has it
    solvers: Mapping[str, Configuration] = field(compare=False, repr=False)

    def __call__(self, agent: AgentConfiguration) -> Fly:
        return partial(fly_programs, agent, self.programs_of(agent))

    def programs_of(self, agent: AgentConfiguration) -> MissionPrograms:
        """The compiled models of `agent`, the flaw handling of its reactors, and the code of those in Python."""
        reactors = tuple((reactor.model, reactor.solver) for reactor in agent.reactors)
        return _assembled(self, reactors, Path(agent.root), agent.constraints, agent.constraint_seconds, agent.coded)


def pinned(models: ModelSet) -> PinnedModels:
    """The models of a mission, for as many flights as there may be."""
    root = Path(models.agent.root)
    paths = {reactor.solver for reactor in models.agent.reactors if reactor.solver is not None}
    solvers = {path: load_solver(root, path) for path in sorted(paths)}
    return PinnedModels(model_digest(models.texts), models.texts, models.programs, solvers)


def overlay_of(models: ModelSet) -> Overlay:
    """The texts of a mission's models as they were read, for trials with edits of them."""
    return tuple((str(real_path(Path(models.agent.root) / name)), text) for name, text in models.texts.items())


@lru_cache(maxsize=4)
def _assembled(
    models: PinnedModels,
    reactors: _Reactors,
    root: Path,
    constraints: tuple[str, ...],
    seconds: float,
    coded: tuple[CodeConfiguration, ...],
) -> MissionPrograms:
    library = load_library(root, constraints, seconds=seconds)
    code = load_code(root, coded)
    now = library.texts | {each.file: read_text(root / each.file) for each in coded if each.file}
    for name in now:
        if models.texts.get(name) != now[name]:
            raise UserCodeError(f"{name}: changed while missions were flown", advice=_CHANGED)
    solvers = tuple(default_configuration() if path is None else models.solvers[path] for _, path in reactors)
    return MissionPrograms(tuple(models.programs[model] for model, _ in reactors), solvers, library.constraints, code)
