"""Hold the properties of a mission file against its models: predicates and arguments that these do not have."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from checker.codes import (
    ILL_VALUE,
    NO_ARGUMENT,
    NO_EFFECT,
    NO_PREDICATE,
    NO_REACTOR,
    NO_RESOURCE,
    OUT_OF_RANGE,
    SINGLE_LEVEL,
)
from checker.goal_fit import strange_value
from checker.mission import Mission
from checker.mission_table import describe
from checker.named_objects import named_objects, resources_of
from checker.respelt import meant_name, respelt, rewritten, written_anew
from compiler.program import TOKEN_TIMES, PredicateCode, Program
from nddl_lang.text.diagnostic import Diagnostic
from runtime.executive.configuration import LevelPattern, PropertyConfiguration, TokenPattern
from runtime.executive.expression import parse_expression

_Path = tuple[str | int, ...]
_NUMBERS = ("int", "float", "bool")


def property_misfits(mission: Mission, programs: Mapping[str, Program]) -> Iterator[Diagnostic]:
    """Complain of what a property says of tokens that can never be."""
    for number, one in enumerate(mission.agent.properties):
        path: _Path = ("property", number)
        yield from _time_misfits(mission, one, path)
        if one.level is not None:
            yield from _level_misfits(mission, one.level, path, programs)
            continue
        yield from _pattern_misfits(mission, one.pattern, path, programs)
        if one.then is not None:
            yield from _pattern_misfits(mission, one.then, (*path, "then"), programs)


def _time_misfits(mission: Mission, one: PropertyConfiguration, path: _Path) -> Iterator[Diagnostic]:
    """Complain of times that no mission lasts to."""
    final = mission.agent.final_tick
    wanted = ""
    if 0 < final <= one.since:
        wanted = f"before the end of the mission, {final}"
    elif one.by is not None and one.by < one.since:
        wanted = f"at most `by`, {one.by}"
    if wanted:
        yield OUT_OF_RANGE.at(mission.text.value_span((*path, "from")), key="from", wanted=wanted, found=one.since)
    if one.by is not None and 0 < final < one.by:
        span = mission.text.value_span((*path, "by"))
        yield NO_EFFECT.at(span, what=f"by = {one.by}", help=f"the mission ends at tick {final}")


def _level_misfits(
    mission: Mission, level: LevelPattern, path: _Path, programs: Mapping[str, Program]
) -> Iterator[Diagnostic]:
    """Complain of a reactor or a resource that is not there."""
    names = [one.name for one in mission.agent.reactors]
    if level.reactor and level.reactor not in names:
        advice = _advice(level.reactor, names, "reactors")
        span = mission.text.value_span((*path, "reactor"))
        yield respelt(NO_REACTOR.at(span, name=level.reactor, help=advice), level.reactor, names)
        return
    chosen = [one for one in mission.agent.reactors if level.reactor in ("", one.name) and one.model in programs]
    known = [name for one in chosen for name in resources_of(programs[one.model])]
    if level.resource not in known:
        advice = _advice(level.resource, list(dict.fromkeys(known)), "resources")
        complaint = NO_RESOURCE.at(mission.text.value_span((*path, "resource")), name=level.resource, help=advice)
        yield respelt(complaint, level.resource, known)
    least, most = level.bounds
    if least == most:
        help_ = f"`level = [{least:g}, inf]` is at least {least:g}, `level = [-inf, {least:g}]` at most"
        span = mission.text.value_span((*path, "level"))
        yield SINGLE_LEVEL.at(span, resource=level.resource, level=f"{least:g}", help=help_)


def _pattern_misfits(
    mission: Mission, pattern: TokenPattern, path: _Path, programs: Mapping[str, Program]
) -> Iterator[Diagnostic]:
    agent = mission.agent
    listed = [one for one in agent.reactors if pattern.timeline in (*one.internal, *one.external)]
    program = next((programs[one.model] for one in listed if one.model in programs), None)
    if program is None:
        return
    objects = named_objects(program)
    class_name = objects.get(pattern.timeline)
    if class_name is None:
        return  # told at its owner
    own = [one for one in program.predicates if one.class_name == class_name]
    known = {one.name.rpartition(".")[2]: one for one in own}
    if pattern.predicate and pattern.predicate not in known:
        span = mission.text.value_span((*path, "predicate"))
        advice = _advice(pattern.predicate, list(known), "predicates")
        complaint = NO_PREDICATE.at(span, class_name=class_name, predicate=pattern.predicate, help=advice)
        yield respelt(complaint, pattern.predicate, known)
        return
    chosen = [known[pattern.predicate]] if pattern.predicate else own
    names = {parameter.name for one in chosen for parameter in one.parameters}
    for name in dict.fromkeys(_names_of(pattern)):
        if name not in names:
            is_listed = name in dict(pattern.parameters)
            key: _Path = (*path, "parameters", name) if is_listed else (*path, "where")
            span = mission.text.key_span(key) if is_listed else mission.text.value_span(key)
            what = pattern.predicate or str(class_name)
            offered = [*sorted(names), *TOKEN_TIMES]
            advice = _value_advice(name, chosen, program) or _advice(name, offered, "arguments")
            yield respelt(NO_ARGUMENT.at(span, predicate=what, name=name, help=advice), name, offered)
    if all(name in names for name in _names_of(pattern)):
        yield from _uncompared(mission, pattern, path, chosen)
    for one in chosen:
        yield from _strange_values(mission, pattern, path, one, program)


def _uncompared(
    mission: Mission, pattern: TokenPattern, path: _Path, predicates: list[PredicateCode]
) -> Iterator[Diagnostic]:
    """Complain of arguments in a condition that are no numbers: it would never hold."""
    span = mission.text.value_span((*path, "where"))
    for name in dict.fromkeys(_names_of(replace(pattern, parameters=()))):
        found = [one for one in predicates if name in {parameter.name for parameter in one.parameters}]
        kinds = [next(each.type for each in one.parameters if each.name == name) for one in found]
        if kinds and all(one.kind not in _NUMBERS for one in kinds):
            yield ILL_VALUE.at(
                span, predicate=found[0].name, name=name, wanted="a number for `where` to compare",
                found=f"of `{kinds[0].type_name or kinds[0].kind}`", help=f"write `parameters = {{ {name} = ... }}`",
            )  # fmt: skip


def _value_advice(name: str, predicates: list[PredicateCode], program: Program) -> str | None:
    """What to write where a condition names a value that an argument may have, which is no number."""
    parameters = [parameter for one in predicates for parameter in one.parameters]
    for one in parameters:
        if one.type.kind == "bool" and name in ("true", "false"):
            return f"`where` compares numbers; write `parameters = {{ {one.name} = {name} }}`"
        if one.type.kind == "enum" and name in dict(program.enums).get(one.type.type_name, ()):
            return f'`where` compares numbers; write `parameters = {{ {one.name} = "{name}" }}`'
    return None


def _strange_values(
    mission: Mission, pattern: TokenPattern, path: _Path, predicate: PredicateCode, program: Program
) -> Iterator[Diagnostic]:
    codes = {parameter.name: parameter for parameter in predicate.parameters}
    for name, value in pattern.parameters:
        if name in codes and not isinstance(value, tuple):
            strange = strange_value(codes[name], value, program)
            if strange is not None:
                span = mission.text.value_span((*path, "parameters", name))
                complaint = ILL_VALUE.at(
                    span, predicate=predicate.name, name=name, wanted=strange.wanted, found=describe(value),
                    help=strange.advice,
                )  # fmt: skip
                if strange.meant is not None:
                    complaint = rewritten(complaint, str(value), strange.meant)
                elif strange.written is not None:
                    complaint = written_anew(complaint, strange.written)
                yield complaint


def _advice(name: str, known: list[str], what: str) -> str:
    close = meant_name(name, known)
    return f"did you mean `{close}`?" if close else f"{what}: {', '.join(known) or 'none'}"


def _names_of(pattern: TokenPattern) -> tuple[str, ...]:
    """The arguments that a pattern speaks of; the times of a token are none."""
    where = parse_expression(pattern.where).names if pattern.where else ()
    return tuple(name for name in (*(name for name, _ in pattern.parameters), *where) if name not in TOKEN_TIMES)
