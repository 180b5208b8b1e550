"""The models of a mission, read and checked: programs, what they sample, and all that is wrong with them."""

import errno
import hashlib
import os
from collections.abc import Container, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain
from pathlib import Path

from checker.codes import OTHER_NUMBER, OUT_OF_TIME
from checker.figures import figure_misfits
from checker.goal_fit import goals_out_of_time
from checker.influence import Influence, lines_of_influence
from checker.mission import Mission, parse_mission
from checker.model_fit import complete, find_misfits, sampling_misfits
from checker.model_graph import read_model
from checker.names import relative_name
from checker.planner_fit import unordered_resources
from checker.property_fit import property_misfits
from checker.role_fit import find_role_misfits
from checker.shared_timelines import shared_misfits
from checker.solver_fit import solver_misfits
from compiler.lower import compile_model
from compiler.program import ParameterSite, Program
from nddl_lang.analysis import Analysis, analyse
from nddl_lang.lint.codes import UNCLOSED
from nddl_lang.lint.configuration import settings_in
from nddl_lang.lint.linter import lint
from nddl_lang.lint.scripts import unclosed_in_mission
from nddl_lang.repair import repaired
from nddl_lang.semantics.callables import Callables
from nddl_lang.syntax.includes import OpenText
from nddl_lang.text.diagnostic import Diagnostic, Severity
from nddl_lang.text.read import NotAFileError, read_text
from nddl_lang.text.source import Source
from runtime.executive.configuration import AgentConfiguration
from runtime.solver.configuration.read import read_configuration
from runtime.user.library import load_library


@dataclass(frozen=True, eq=False, slots=True)
class ModelSet:
    """What the reactors of an agent run. `programs` and `influence` are empty where a diagnostic is an error.

    `agent` is the mission's, with every parameter that the models sample and every range filled in. `findings` are what
    lint warns of in the models, and of goals for which there is no time, where that was asked for.
    """

    agent: AgentConfiguration
    programs: dict[str, Program]  # by model path as the mission file has it
    texts: dict[str, str]  # by file name, for the digest of a run
    influence: Influence
    diagnostics: tuple[Diagnostic, ...]
    findings: tuple[Diagnostic, ...] = ()

    @property
    def has_errors(self) -> bool:
        """Whether the mission cannot be flown."""
        return any(diagnostic.severity is Severity.ERROR for diagnostic in self.diagnostics)


def examine(source: Source, root: Path, open_text: OpenText = read_text) -> tuple[Diagnostic, ...]:
    """All that is wrong with a mission file in the folder `root`, and with its models, which `open_text` opens."""
    mission, found = parse_mission(source, root)
    return found if mission is None else (*found, *load_models(mission, open_text).diagnostics)


def _named_files(agent: AgentConfiguration, root: Path) -> Iterator[tuple[str, str]]:
    """The files that settings of reactors in Python name: traces that they play, tables that they read.

    Of one that is too large to be read at once, its digest.
    """
    for name in dict.fromkeys(value for each in agent.coded for _, value in each.settings if isinstance(value, str)):
        try:
            text = _text_or_digest(root / name)
        except (OSError, ValueError):
            continue  # no name of a file
        if text is not None:
            yield name, text


def _text_or_digest(path: Path) -> str | None:
    """What stands for a regular file; raises OSError and ValueError."""
    if not path.is_file():
        return None
    try:
        return read_text(path)
    except NotAFileError:
        with path.open("rb") as opened:
            return hashlib.file_digest(opened, "sha256").hexdigest()


def load_models(mission: Mission, open_text: OpenText = read_text, *, is_linted: bool = False) -> ModelSet:
    """Read all models of a mission; every mistake in them is reported, once. `open_text` gives the texts of files.

    `is_linted`: find out what lint warns of, too.

    Raises UserCodeError where a module with constraints cannot be used.
    """
    agent = mission.agent
    root = Path(agent.root)
    library = load_library(root, agent.constraints, seconds=agent.constraint_seconds)
    analyses = _analyse_models(agent, library.callables, open_text)
    texts = library.texts | {
        relative_name(source.name, root): source.text
        for analysis in analyses.values()
        for source in analysis.loaded.sources
    }
    texts |= {each.file: (root / each.file).read_text(encoding="utf-8") for each in agent.coded if each.file}
    texts |= dict(_named_files(agent, root))
    solvers = dict.fromkeys(each.solver for each in agent.reactors if each.solver is not None)
    configured = [_opened(root / name, open_text) for name in solvers]
    texts |= {name: source.text for name, source in zip(solvers, configured, strict=True)}
    told = [repaired(analysis).diagnostics for analysis in analyses.values()]
    readings = [read_configuration(source) for source in configured]
    told += [complaints for _, complaints in readings]
    found: dict[_Place, Diagnostic] = {}
    for one in chain.from_iterable(told):
        found.setdefault(_place_of(one), one)
    if any(one.severity is Severity.ERROR for one in found.values()):
        return ModelSet(agent, {}, texts, {}, tuple(found.values()))
    programs = {model: compile_model(analysis) for model, analysis in analyses.items()}
    sites = _sites(programs)
    misfits = [*find_misfits(mission, programs), *sampling_misfits(mission, sites)]
    misfits += find_role_misfits(mission, programs, library.constraints)
    misfits += shared_misfits(mission, programs)
    settings = {name: reading for name, (reading, _) in zip(solvers, readings, strict=True)}
    misfits += unordered_resources(mission, programs, settings)
    misfits += solver_misfits(mission, programs, zip(solvers, configured, strict=True))
    misfits += property_misfits(mission, programs)
    if mission.figures is not None:
        misfits += figure_misfits(mission.figures, mission.text, agent, programs)
    unclosed = [one for each in analyses.values() for one in _chosen(each, unclosed_in_mission(each))]
    misfits += {_place_of(one): one for one in unclosed}.values()
    completed = complete(mission, sites)
    late = (*goals_out_of_time(agent, mission.text), *(one for one in misfits if one.code in _WARNED))
    findings = (*_findings(analyses.values(), found), *late) if is_linted else ()
    return ModelSet(
        completed, programs, texts, _influence(programs, sites, root), (*found.values(), *misfits), findings
    )


def _opened(path: Path, open_text: OpenText) -> Source:
    """The source at `path`; raises OSError."""
    text = open_text(path)
    if text is None:
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(path))
    return Source(str(path), text)


_Place = tuple[str, int, str, str]
_WARNED = frozenset((OUT_OF_TIME, UNCLOSED, OTHER_NUMBER))


def _place_of(one: Diagnostic) -> _Place:
    """What tells a complaint from all others, whichever model it was found in."""
    return one.span.source.name, one.span.begin, one.code.id, one.message


def _findings(analyses: Iterable[Analysis], known: Container[_Place]) -> Iterator[Diagnostic]:
    """What lint warns of by the settings of each model's project, but for what is `known`; each finding once."""
    told: set[_Place] = set()
    for analysis in analyses:
        for one in _chosen(analysis, lint(analysis)):
            place = _place_of(one)
            if one.severity is Severity.WARNING and place not in known and place not in told:
                told.add(place)
                yield one


def _chosen(analysis: Analysis, found: Sequence[Diagnostic]) -> Iterable[Diagnostic]:
    """What the project of a model wants to hear; its settings are read only where there is something to tell."""
    return settings_in(Path(analysis.loaded.root.name).parent).choose(found) if found else ()


def _analyse_models(agent: AgentConfiguration, callables: Callables, open_text: OpenText) -> dict[str, Analysis]:
    """The meaning of each model of an agent, by its path in the mission file."""
    names = dict.fromkeys(reactor.model for reactor in agent.reactors)
    root = Path(agent.root)
    loaded = {name: read_model(root / name, open_text) for name in names}
    return {name: analyse(each, callables) for name, each in loaded.items()}


def _sites(programs: dict[str, Program]) -> dict[str, ParameterSite]:
    """What the models sample, by name; of a parameter that several sample, the first one that gives a range."""
    sites: dict[str, ParameterSite] = {}
    for program in programs.values():
        for site in program.sampled:
            known = sites.get(site.name)
            if known is None or known.default is None:
                sites[site.name] = site
    return sites


def _influence(programs: dict[str, Program], sites: dict[str, ParameterSite], root: Path) -> Influence:
    return {
        name: tuple(
            replace(line, place=replace(line.place, file=relative_name(line.place.file, root)))
            for program in programs.values()
            for line in lines_of_influence(program, name)
        )
        for name in sites
    }
