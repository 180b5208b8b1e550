"""Hold a mission file against its models: timelines, goals and parameters that they do not have, ranges they give."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

from checker.codes import (
    BEYOND_MODEL,
    ILL_DISTRIBUTION,
    ILL_VALUE,
    NO_ARGUMENT,
    NO_PREDICATE,
    NO_RANGE,
    NO_TIMELINE,
    UNUSED_PARAMETER,
)
from checker.goal_fit import strange_value, too_long
from checker.mission import Mission
from checker.mission_table import describe
from checker.named_objects import named_objects
from checker.respelt import meant_name, respelt, rewritten, written_anew
from compiler.program import DomainConstant, ParameterSite, PredicateCode, Program
from nddl_lang.text.diagnostic import Diagnostic, Note
from nddl_lang.text.source import Span
from runtime.constraints.domains.tags import HALF_INF
from runtime.executive.configuration import AgentConfiguration, Bounds, ParameterConfiguration, Value
from runtime.executive.expression import parse_expression

_Bounds = tuple[float, float]


def find_misfits(mission: Mission, programs: Mapping[str, Program]) -> Iterator[Diagnostic]:
    """Complain of timelines, predicates and arguments that the models of their reactors do not have."""
    text = mission.text
    owners: dict[str, Program] = {}
    for number, reactor in enumerate(mission.agent.reactors):
        program = programs[reactor.model]
        objects = named_objects(program)
        for key, timelines in (("internal", reactor.internal), ("external", reactor.external)):
            for index, timeline in enumerate(timelines):
                if timeline not in objects:
                    span = text.value_span((*text.reactor_path(number), key, index))
                    advice = _advice(timeline, [*objects], "objects of the model")
                    complaint = NO_TIMELINE.at(span, model=reactor.model, timeline=timeline, help=advice)
                    yield respelt(complaint, timeline, objects)
                elif key == "internal":
                    owners[timeline] = program
    for number, goal in enumerate(mission.agent.goals):
        owner = owners.get(goal.timeline)
        if owner is None:
            continue
        class_name = named_objects(owner)[goal.timeline]
        predicates = {one.name.rpartition(".")[2]: one for one in owner.predicates if one.class_name == class_name}
        predicate = predicates.get(goal.predicate)
        if predicate is None:
            span = text.value_span(("goal", number, "predicate"))
            others = [other for other, program in owners.items() if _has(program, other, goal.predicate)]
            advice = _advice(goal.predicate, [*predicates], "predicates")
            if others and not advice.startswith("did"):
                advice = f"the timeline `{others[0]}` has it"
            complaint = NO_PREDICATE.at(span, class_name=class_name, predicate=goal.predicate, help=advice)
            yield respelt(complaint, goal.predicate, predicates)
        else:
            yield from _strange_arguments(mission, number, predicate, owner)
            yield from too_long(mission.agent, text, number, predicate, owner)


def _strange_arguments(
    mission: Mission, number: int, predicate: PredicateCode, program: Program
) -> Iterator[Diagnostic]:
    known = {parameter.name: parameter for parameter in predicate.parameters}
    for name, value in mission.agent.goals[number].parameters:
        path = ("goal", number, "parameters", name)
        if name not in known:
            span = mission.text.key_span(path)
            meant = meant_name(name, known) or _taking(mission, number, predicate, value, program)
            advice = f"did you mean `{meant}`?" if meant else _advice(name, [*known], "parameters")
            complaint = NO_ARGUMENT.at(span, predicate=predicate.name, name=name, help=advice)
            yield complaint if meant is None else rewritten(complaint, name, meant)
            continue
        strange = strange_value(known[name], value, program)
        if strange is not None:
            span = mission.text.value_span(path)
            found = describe([*value] if isinstance(value, tuple) else value)
            code = ILL_VALUE.at(
                span, predicate=predicate.name, name=name, wanted=strange.wanted, found=found, help=strange.advice
            )
            declared = known[name].span
            if strange.meant is not None:
                code = rewritten(code, str(value), strange.meant)
            elif strange.written is not None:
                code = written_anew(code, strange.written)
            yield code if declared is None else replace(code, notes=(Note("declared here", declared),))


def _taking(
    mission: Mission, number: int, predicate: PredicateCode, value: Value | Bounds, program: Program
) -> str | None:
    """The only parameter without a value that can take one; numbers fit many: of these the only one left at all."""
    given = {name for name, _ in mission.agent.goals[number].parameters}
    left = [one for one in predicate.parameters if one.name not in given]
    if isinstance(value, str):
        left = [one for one in left if one.type.kind in ("enum", "object")]
        left = [one for one in left if strange_value(one, value, program) is None]
    return left[0].name if len(left) == 1 and strange_value(left[0], value, program) is None else None


def sampling_misfits(mission: Mission, sites: Mapping[str, ParameterSite]) -> Iterator[Diagnostic]:
    """Complain of parameters that no model samples, and of those that have no range anywhere."""
    for parameter in mission.agent.parameters:
        site = sites.get(parameter.name)
        span = _span_of(mission, parameter)
        if site is None:
            advice = _advice(parameter.name, [*sites], "sampled parameters")
            yield respelt(UNUSED_PARAMETER.at(span, name=parameter.name, help=advice), parameter.name, sites)
        elif site.kind == "int" and (wrong := _fractions(parameter)):
            notes = tuple(Note("sampled here", use) for use in site.uses[:1])
            yield ILL_DISTRIBUTION.at(span, reason=f"the model samples whole numbers, and {wrong}", notes=notes)
        elif parameter.expression and (strange := _unread(parameter, mission, sites)):
            yield ILL_DISTRIBUTION.at(
                mission.text.value_span(("parameters", parameter.name, "expression")),
                reason=f"the expression reads `{strange}`, which is no parameter",
                help=_advice(strange, [*sites], "sampled parameters"),
            )
        elif parameter.name in mission.needs_range and _bounds(site.default) is None:
            notes = tuple(Note("sampled here", use) for use in site.uses[:1])
            yield NO_RANGE.at(span, name=parameter.name, notes=notes)
        elif parameter.name not in mission.needs_range and (beyond := _beyond(parameter, _bounds(site.default))):
            notes = tuple(Note("sampled here", use) for use in site.uses[:1])
            advice = "rules read such a value all the same: widen the range in the model, or narrow it here"
            yield BEYOND_MODEL.at(span, name=parameter.name, reason=beyond, help=advice, notes=notes)
    listed = {parameter.name for parameter in mission.agent.parameters}
    for name, site in sites.items():
        if name not in listed and _bounds(site.default) is None:
            advice = f"write [parameters.{name}] with a `range` in {mission.source.name}"
            yield NO_RANGE.at(site.uses[0], name=name, help=advice)


def _span_of(mission: Mission, parameter: ParameterConfiguration) -> Span:
    """Where a parameter is written: the head of its table, or its name in that of a joint one."""
    kind, _, table = parameter.stream.partition(" ")
    if kind == "joint" and table:
        columns = [one.name for one in mission.agent.parameters if one.stream == parameter.stream]
        return mission.text.value_span(("joint", table, "parameters", columns.index(parameter.name)))
    return mission.text.key_span(("parameters", parameter.name))


def _unread(parameter: ParameterConfiguration, mission: Mission, sites: Mapping[str, ParameterSite]) -> str | None:
    """The first name in an expression that no parameter has."""
    known = {one.name for one in mission.agent.parameters} | sites.keys()
    return next((name for name in parse_expression(parameter.expression).names if name not in known), None)


def _fractions(parameter: ParameterConfiguration) -> str:
    """Why a whole number cannot be drawn so; empty where it can."""
    strange = [value for value in parameter.values if value != int(value)]
    if strange:
        return f"{strange[0]:g} is none"
    clipped = [end for end in parameter.clip or () if math.isfinite(end) and end != int(end)]
    if clipped:
        return f"{clipped[0]:g} of its `clip` is none"
    if not parameter.values and not parameter.expression and math.floor(parameter.upper) < math.ceil(parameter.lower):
        return f"there is none from {parameter.lower:g} to {parameter.upper:g}"
    return ""


def _beyond(parameter: ParameterConfiguration, own: _Bounds | None) -> str:
    """What is drawn outside of the model's range; empty where nothing is. Of normal and computed ones it is silent."""
    if own is None:
        return ""
    says = f"the model says {own[0]:g} to {own[1]:g}"
    if parameter.values:
        found = next((value for value in parameter.values if not own[0] <= value <= own[1]), None)
        return "" if found is None else f"as {found:g}, and {says}"
    if parameter.distribution not in ("uniform", "truncated_normal"):
        return ""
    least, most = parameter.clip or (-math.inf, math.inf)
    lower, upper = max(parameter.lower, least), min(parameter.upper, most)
    return "" if own[0] <= lower and upper <= own[1] else f"from {lower:g} to {upper:g}, and {says}"


def complete(mission: Mission, sites: Mapping[str, ParameterSite]) -> AgentConfiguration:
    """The agent with what the mission file leaves to the models: ranges, whole numbers, parameters that it omits."""
    parameters: list[ParameterConfiguration] = []
    for parameter in mission.agent.parameters:
        site = sites.get(parameter.name)
        bounds = _bounds(site.default) if site is not None and parameter.name in mission.needs_range else None
        lower, upper = bounds or (parameter.lower, parameter.upper)
        is_whole = parameter.is_whole or (site is not None and site.kind == "int")
        parameters.append(replace(parameter, lower=lower, upper=upper, is_whole=is_whole))
    listed = {parameter.name for parameter in mission.agent.parameters}
    for name, site in sites.items():
        bounds = _bounds(site.default)
        if name not in listed and bounds is not None:
            parameters.append(ParameterConfiguration(name, *bounds, is_whole=site.kind == "int"))
    return replace(mission.agent, parameters=tuple(parameters))


def _has(program: Program, timeline: str, predicate: str) -> bool:
    """Whether a timeline of the model has a predicate of that name."""
    full_name = f"{named_objects(program)[timeline]}.{predicate}"
    return any(one.name == full_name for one in program.predicates)


def _advice(name: str, known: list[str], what: str) -> str:
    close = meant_name(name, known)
    return f"did you mean `{close}`?" if close else f"{what}: {', '.join(known) or 'none'}"


def _bounds(domain: DomainConstant | None) -> _Bounds | None:
    """A finite range of numbers, if that is what the domain is."""
    if domain is None:
        return None
    if domain.interval is not None:
        lower, upper = domain.interval
        return (float(lower), float(upper)) if max(abs(lower), abs(upper)) < HALF_INF else None
    numbers = [float(value) for value in domain.values or () if isinstance(value, int | float)]
    return (min(numbers), max(numbers)) if numbers and len(numbers) == len(domain.values or ()) else None
