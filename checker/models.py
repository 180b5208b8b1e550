"""The models of a mission, read and checked: programs, what they sample, and all that is wrong with them."""

from dataclasses import dataclass, replace
from pathlib import Path

from checker.influence import Influence, lines_of_influence
from checker.mission import Mission
from checker.mission_codes import NO_RANGE, UNUSED_PARAMETER
from checker.mission_table import nearest
from checker.names import relative_name
from compiler.lower import compile_model
from compiler.program import DomainConstant, ParameterSite, Program
from nddl_lang.analysis import Analysis, analyse_file
from nddl_lang.text.diagnostic import Diagnostic, Note, Severity
from runtime.executive.configuration import AgentConfiguration, ParameterConfiguration
from runtime.executive.outcome import Place


@dataclass(frozen=True, eq=False, slots=True)
class ModelSet:
    """What the reactors of an agent run. `programs` and `influence` are empty where a diagnostic is an error.

    `agent` is the mission's, with every parameter that the models sample and every range filled in.
    """

    agent: AgentConfiguration
    programs: dict[str, Program]  # by model path as the mission file has it
    texts: dict[str, str]  # by file name, for the digest of a run
    influence: Influence
    diagnostics: tuple[Diagnostic, ...]

    @property
    def has_errors(self) -> bool:
        """Whether the mission cannot be flown."""
        return any(diagnostic.severity is Severity.ERROR for diagnostic in self.diagnostics)


def load_models(mission: Mission) -> ModelSet:
    """Read all models of a mission; every mistake in them is reported, once."""
    agent = mission.agent
    analyses = analyse_models(agent)
    root = Path(agent.root)
    texts = {
        relative_name(source.name, root): source.text
        for analysis in analyses.values()
        for source in analysis.loaded.sources
    }
    found: dict[tuple[str, int, str, str], Diagnostic] = {}
    for analysis in analyses.values():
        for one in analysis.diagnostics:
            found.setdefault((one.span.source.name, one.span.begin, one.code.id, one.message), one)
    if any(one.severity is Severity.ERROR for one in found.values()):
        return ModelSet(agent, {}, texts, {}, tuple(found.values()))
    programs = {model: compile_model(analysis) for model, analysis in analyses.items()}
    sites = _sites(programs)
    completed, complaints = _complete(mission, sites)
    return ModelSet(completed, programs, texts, _influence(programs, sites, root), (*found.values(), *complaints))


def analyse_models(agent: AgentConfiguration) -> dict[str, Analysis]:
    """The meaning of each model of an agent, by its path in the mission file."""
    names = dict.fromkeys(reactor.model for reactor in agent.reactors)
    return {name: analyse_file(Path(agent.root) / name) for name in names}


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
            (rule, Place(relative_name(place.file, root), place.line, place.column, place.text))
            for program in programs.values()
            for rule, place in lines_of_influence(program, name)
        )
        for name in sites
    }


def _complete(mission: Mission, sites: dict[str, ParameterSite]) -> tuple[AgentConfiguration, list[Diagnostic]]:
    """Fill in what the mission file leaves to the models; complain of what neither says."""
    spans = dict(mission.parameter_spans)
    diagnostics: list[Diagnostic] = []
    parameters: list[ParameterConfiguration] = []
    for parameter in mission.agent.parameters:
        site = sites.get(parameter.name)
        if site is None:
            close = nearest(parameter.name, [*sites])
            listed = "sampled parameters: " + (", ".join(sites) or "none")
            advice = f"did you mean `{close}`?" if close else listed
            diagnostics.append(UNUSED_PARAMETER.at(spans[parameter.name], name=parameter.name, help=advice))
            continue
        box = (parameter.lower, parameter.upper)
        if parameter.name in mission.needs_range:
            default = _bounds(site.default)
            if default is None:
                notes = tuple(Note("sampled here", span) for span in site.uses[:1])
                diagnostics.append(NO_RANGE.at(spans[parameter.name], name=parameter.name, notes=notes))
            box = default or box
        is_whole = parameter.is_whole or site.kind == "int"
        parameters.append(replace(parameter, lower=box[0], upper=box[1], is_whole=is_whole))
    listed_names = {parameter.name for parameter in mission.agent.parameters}
    for name, site in sites.items():
        if name not in listed_names:
            bounds = _bounds(site.default)
            if bounds is None:
                advice = f"write [parameters.{name}] with a `range` in {mission.source.name}"
                diagnostics.append(NO_RANGE.at(site.uses[0], name=name, help=advice))
            else:
                parameters.append(ParameterConfiguration(name, *bounds, is_whole=site.kind == "int"))
    return replace(mission.agent, parameters=tuple(parameters)), diagnostics


def _bounds(domain: DomainConstant | None) -> tuple[float, float] | None:
    """A finite range of numbers, if that is what the domain is."""
    if domain is None:
        return None
    if domain.interval is not None:
        lower, upper = domain.interval
        return (float(lower), float(upper)) if max(abs(lower), abs(upper)) < 2**51 else None
    numbers = [float(value) for value in domain.values or () if isinstance(value, int | float)]
    return (min(numbers), max(numbers)) if numbers and len(numbers) == len(domain.values or ()) else None
