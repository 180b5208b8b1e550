"""Hold the goals of a mission file against its time, and their values against the types of the model."""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass

from checker.codes import OUT_OF_RANGE, OUT_OF_TIME
from checker.mission_table import MissionText
from checker.named_objects import named_objects
from checker.single_values import numbers_of
from compiler.instructions import branched_instructions
from compiler.program import (
    DURATION,
    END,
    START,
    Constant,
    DomainConstant,
    ParameterCode,
    Post,
    PredicateCode,
    Program,
    TokenVariable,
)
from nddl_lang.text.diagnostic import Diagnostic, Note
from nddl_lang.text.nearest import nearest
from nddl_lang.text.source import Span
from runtime.constraints.domains.tags import HALF_INF
from runtime.executive.configuration import AgentConfiguration, Bounds, GoalConfiguration, Value

_MOST_NAMED = 12
_WHOLE = re.compile(r"[-+]?(?:0|[1-9]\d*)")
_NUMBER = re.compile(r"[-+]?(?:0|[1-9]\d*)(?:\.\d+)?")
_TRUTHS = {"true": "true", "false": "false", "yes": "true", "no": "false", "on": "true", "off": "false"}


@dataclass(frozen=True, slots=True)
class Strange:
    """What a value should have been."""

    wanted: str
    advice: str | None = None
    meant: str | None = None  # of the names that there are, the one that it resembles
    written: str | None = None  # what is to stand there in its place, quotes and all


# ---- time ----


def goals_out_of_time(agent: AgentConfiguration, text: MissionText) -> Iterator[Diagnostic]:
    """Complain of goals that no mission can achieve, whatever the models say, and of bounds that are no ticks."""
    if agent.final_tick < 1:
        return
    for number, goal in enumerate(agent.goals):
        for key, bounds in (("start", goal.start), ("end", goal.end), ("duration", goal.duration)):
            for bound in bounds or ():
                if math.isfinite(bound) and bound != int(bound):
                    span = text.value_span(("goal", number, key))
                    yield OUT_OF_RANGE.at(span, key=key, wanted="whole ticks", found=bound)
        late = _out_of_time(goal, agent.final_tick)
        if late is not None:
            key, reason, advice = late
            yield OUT_OF_TIME.at(text.value_span(("goal", number, key)), reason=reason, help=advice)


def too_long(
    agent: AgentConfiguration, text: MissionText, number: int, predicate: PredicateCode, program: Program
) -> Iterator[Diagnostic]:
    """Complain of a goal that cannot be achieved since its rule says how long it lasts at least."""
    goal = agent.goals[number]
    found = max(_least_durations(predicate, program), key=lambda one: one[0], default=None)
    if found is None or agent.final_tick < 1 or _out_of_time(goal, agent.final_tick) is not None:
        return
    late = _out_of_time(goal, agent.final_tick, found[0])
    if late is not None:
        key, reason, advice = late
        notes = (Note(f"it lasts {found[0]:g} ticks or longer", found[1]),)
        yield OUT_OF_TIME.at(text.value_span(("goal", number, key)), reason=reason, help=advice, notes=notes)


def _least_durations(predicate: PredicateCode, program: Program) -> Iterator[tuple[float, Span]]:
    """How long tokens of a predicate last at least by each line that its rules say in any case."""
    numbers = dict(numbers_of(program))
    own = {at: TokenVariable(0, at) for at in (DURATION, START, END)}
    for rule in program.rules:
        for step, within in branched_instructions(rule.body) if rule.predicate == predicate.name else ():
            if not isinstance(step, Post) or within:
                continue
            least: object = None
            match step.name, step.operands:
                case "eq", (first, second) if own[DURATION] in (first, second):
                    least = numbers.get(second if first == own[DURATION] else first)
                case (("leq" | "lt"), (first, second)) if second == own[DURATION]:
                    least = numbers.get(first)
                case "temporalDistance", (first, Constant(domain=domain), second) if domain.interval is not None:
                    if (first, second) == (own[START], own[END]):
                        least = domain.interval[0]
                    elif (first, second) == (own[END], own[START]):
                        least = -domain.interval[1]
            if isinstance(least, int | float) and least < HALF_INF:
                yield math.floor(least) + 1.0 if step.name == "lt" else float(least), step.span


def _out_of_time(goal: GoalConfiguration, final_tick: int, least: float = 1.0) -> tuple[str, str, str] | None:
    """The key at fault, why there is no time for a goal, and what to do; it lasts `least` ticks or longer."""
    over = f"the mission ends at tick {final_tick}"
    later = "let the mission end later (`final_tick`)"
    start, end, duration = goal.start or _ANY, goal.end or _ANY, goal.duration or _ANY
    shortest = max(duration[0], least)
    latest = final_tick - shortest  # that it may begin

    def sooner(key: str, tick: float, how: str) -> str:
        return f"{how} at tick {tick:g} or earlier (`{key}`), or {later}" if tick >= 0 else later

    if goal.at >= final_tick:
        return "at", f"it is sent at tick {goal.at}, and {over}", sooner("at", latest - 1, "send it")
    if start[0] >= final_tick:
        advice = sooner("start", latest, "let it begin") if latest > goal.at else later
        return "start", f"it begins at tick {start[0]:g} or later, and {over}", advice
    if start[1] <= goal.at:
        advice = "let it begin later (`start`)"
        advice = f"send it before tick {start[1]:g} (`at`), or {advice}" if start[1] > 0 else advice
        return (
            "start",
            f"it begins by tick {start[1]:g}, and is sent at tick {goal.at}",
            advice,
        )
    if duration[1] < least:
        shortest_one = "a token lasts one tick or longer" if least <= 1 else f"its rule says {least:g} or more"
        return "duration", f"it lasts {duration[1]:g} ticks at most", shortest_one
    first = max(start[0], goal.at + 1.0)
    if first + shortest > final_tick:
        key = "duration" if goal.duration is not None else "start" if goal.start is not None else "at"
        advice = later
        if key == "duration" and final_tick - first >= least:
            advice = f"let it last {final_tick - first:g} ticks or less (`duration`), or {later}"
        elif start[0] > goal.at + 1 and latest > goal.at:
            advice = sooner("start", latest, "let it begin")
        elif start[0] <= goal.at + 1:
            advice = sooner("at", latest - 1, "send it")
        return key, f"it ends at tick {first + shortest:g} or later, and {over}", advice
    if end[0] > final_tick:
        return "end", f"it ends at tick {end[0]:g} or later, and {over}", sooner("end", final_tick, "let it end")
    if end[1] < first + shortest:
        return "end", f"it ends by tick {end[1]:g}, and cannot before tick {first + shortest:g}", "widen its bounds"
    return None


_ANY: Bounds = (-math.inf, math.inf)


# ---- values ----


def strange_value(parameter: ParameterCode, value: Value | Bounds, program: Program) -> Strange | None:
    """What is wrong with the value that a goal gives to a parameter of its predicate."""
    kind = parameter.type.kind
    domains = [one for one in (parameter.type.domain, parameter.domain) if one is not None]
    match kind:
        case "int" | "float":
            return _strange_number(value, domains, is_whole=kind == "int")
        case "bool":
            return (
                None
                if isinstance(value, bool)
                else Strange("true or false", written=_TRUTHS.get(str(value).casefold()))
            )
        case "enum":
            known = dict(program.enums).get(parameter.type.type_name, ())
            return _strange_name(value, _allowed([*known], domains), f"a value of `{parameter.type.type_name}`")
        case "object":
            wanted = parameter.type.type_name
            fitting = [name for name, own in named_objects(program).items() if _is_a(own, wanted, program)]
            return _strange_name(value, fitting, f"an object of class `{wanted}`")
        case _:
            texts = [str(one) for domain in domains for one in domain.values or ()]
            return _strange_name(value, texts or None, "a text")


def _strange_number(value: Value | Bounds, domains: list[DomainConstant], *, is_whole: bool) -> Strange | None:
    what = "a whole number" if is_whole else "a number"
    if isinstance(value, bool | str):
        quoted = _WHOLE if is_whole else _NUMBER
        is_number = isinstance(value, str) and quoted.fullmatch(value.strip()) is not None
        return Strange(f"{what}, or a range of them", written=str(value).strip() if is_number else None)
    lower, upper = value if isinstance(value, tuple) else (value, value)
    if math.isnan(lower) or (not isinstance(value, tuple) and math.isinf(lower)):
        return Strange(what)
    if is_whole and any(math.isfinite(bound) and bound != int(bound) for bound in (lower, upper)):
        return Strange(what)
    for domain in domains:
        if domain.interval is not None:
            least, most = domain.interval
            if upper < least or lower > most:
                return Strange(f"{what} {_range(least, most)}")
        elif domain.values is not None:
            numbers = [float(one) for one in domain.values if isinstance(one, int | float)]
            if numbers and not any(lower <= one <= upper for one in numbers):
                return Strange("one of " + ", ".join(f"{one:g}" for one in numbers[:_MOST_NAMED]))
    return None


def _range(least: float, most: float) -> str:
    if most >= HALF_INF:
        return f"of at least {least:g}"
    return f"of at most {most:g}" if least <= -HALF_INF else f"from {least:g} to {most:g}"


def _strange_name(value: Value | Bounds, known: list[str] | None, what: str) -> Strange | None:
    """A name is a text, and where they are known, one of the names that there are."""
    listed = ", ".join((known or [])[:_MOST_NAMED]) if known is not None else ""
    if not isinstance(value, str):
        there = f"there are: {listed}" if listed else None
        return Strange(f"{what}, in quotes", there)
    if known is None or value in known:
        return None
    close = nearest(value, known)
    return Strange(what, f"did you mean `{close}`?" if close else f"there are: {listed or 'none'}", close)


def _allowed(known: list[str], domains: list[DomainConstant]) -> list[str]:
    for domain in domains:
        if domain.values is not None:
            known = [name for name in known if name in domain.values]
    return known


def _is_a(name: str | None, ancestor: str, program: Program) -> bool:
    """Whether a class is another one or extends it."""
    bases = {each.name: each.base for each in program.classes}
    while name is not None:
        if name == ancestor:
            return True
        name = bases.get(name)
    return False
