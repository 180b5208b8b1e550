"""A mission file in, its sites out: goals, properties, and how far ahead and how fast reactors plan.

What is drawn is the world's: it is not changed. What else a goal may ask for is what others of its predicate ask for,
the other truth value, or a number half or a tenth as large.
"""

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from checker.mission import Mission, parse_mission
from checker.mission_table import MissionText
from checker.mutation.edits import EditSite, SmallEdit, edited
from checker.mutation.kinds import EditKind
from compiler.program import TOKEN_TIMES
from nddl_lang.text.read import real_path
from nddl_lang.text.source import Source
from runtime.executive.configuration import AgentConfiguration, GoalConfiguration, PropertyConfiguration

_PARAMETERS = "parameters"
_NUMBER = re.compile(r"(?<![\w.])\d+(\.\d+)?")
_SERIES = 3  # goals that each have a number of their own
_FACTORS = (2.0, 10.0, 0.5, 0.1)
_LONGER = (2, 10)  # times as many ticks, of a property


def mission_sites(mission: Mission) -> dict[tuple[str, int], list[EditSite]]:
    """The sites of each reactor and each goal, by table and number."""
    final, text = mission.agent.final_tick, mission.text
    found: dict[tuple[str, int], list[EditSite]] = {}
    if text.source.name.endswith(".toml"):
        for number, reactor in enumerate(mission.agent.reactors):
            ahead = 1 if reactor.lookahead == 0 else final
            values = {"lookahead": ahead if reactor.lookahead not in (1, final) else None}
            values["latency"] = 1 if reactor.latency > 1 else None
            found["reactor", number] = list(_sites(text, text.reactor_path(number), values))
        coded = sorted({path[1] for path in text.places if path[:1] == ("reactor",) and path[2:] == ("code",)}, key=str)
        for number, table in enumerate(coded):
            found["setting", number] = list(_settings(text, table))
        for number in range(len(mission.agent.goals)):
            found["goal", number] = list(_times(mission, number))
            found["asked", number] = list(_asked(mission, number))
        for number, kept in enumerate(mission.agent.properties):
            moments = {"by": final if kept.by is not None else None, "from": 0 if kept.since > 0 else None}
            sites = list(_sites(text, ("property", number), moments))
            found["property", number] = [*sites, *_longer(text, number, kept, final), *_promised(text, number, kept)]
    return found


def is_due(edit: SmallEdit, kept: PropertyConfiguration, broken: int | None, final: int) -> bool:
    """Whether what broke a promise at a tick is due before the mission is over with an edit of it; else none can."""
    if broken is None or not kept.ticks or edit.old != str(kept.ticks):
        return True
    return broken + int(edit.new) - kept.ticks < final


def _longer(text: MissionText, number: int, kept: PropertyConfiguration, final: int) -> Iterator[EditSite]:
    """The ticks within which something is promised, more of them, as long as anything can be due in time."""
    path = ("property", number, "ticks")
    longer = [str(times * kept.ticks) for times in _LONGER if 0 < times * kept.ticks < final]
    if longer and path in text.places:
        yield _site(text, path, EditKind.PROMISE, longer)


def agent_with(mission: Mission, agent: AgentConfiguration, edit: SmallEdit) -> AgentConfiguration:
    """The agent with the goals and reactors that the mission file has with an edit; as it is where that is none.

    It is judged by no property that it was not judged by before.
    """
    text = Source(mission.source.name, edited(mission.source.text, edit))
    changed, _ = parse_mission(text, Path(mission.agent.root))
    if changed is None:
        return agent
    pairs = zip(changed.agent.goals, agent.goals, strict=True)
    goals = tuple(replace(goal, mandatory=known.mandatory) for goal, known in pairs)
    agent = replace(agent, reactors=changed.agent.reactors, coded=changed.agent.coded, goals=goals)
    judged = {one.name for one in agent.properties}
    return replace(agent, properties=tuple(one for one in changed.agent.properties if one.name in judged))


def _sites(text: MissionText, table: tuple[str | int, ...], values: Mapping[str, object]) -> Iterator[EditSite]:
    for key, value in values.items():
        path = (*table, key)
        if value is not None and path in text.places:
            kind = EditKind.PROMISE if table[0] == "property" else EditKind.MISSION
            yield _site(text, path, kind, [str(value)])


def _settings(text: MissionText, table: object) -> Iterator[EditSite]:
    """The numbers that a reactor in Python is given, each twice, ten times, half and a tenth as large."""
    for path in [path for path in text.places if path[:1] == ("reactor",) and path[1:2] == (table,)]:
        if path[2:3] == ("settings",) and len(path) > len(("reactor", table, "settings")):
            said = text.value_span(path).text
            if _NUMBER.fullmatch(said) and float(said):
                yield _site(text, path, EditKind.SETTING, [_scaled(said, factor) for factor in _FACTORS])


def _scaled(number: str, factor: float) -> str:
    changed = float(number) * factor
    return repr(round(changed, 12)) if "." in number else str(max(round(changed), 1))


def _times(mission: Mission, number: int) -> Iterator[EditSite]:
    """The times of a goal: it may come at any time, as soon as the goal before it, or only be later."""
    goal, text, final = mission.agent.goals[number], mission.text, mission.agent.final_tick
    for key, bounds in zip(TOKEN_TIMES, (goal.start, goal.end, goal.duration), strict=True):
        path = ("goal", number, key)
        if bounds is not None and path in text.places:
            others = [f"[0, {final}]"]
            before = [one.start[1] for one in mission.agent.goals if one.start is not None and one.start[1] < bounds[0]]
            if key == "start" and before:
                others.append(f"[{max(before)}, {bounds[1]}]")
            others.append(f"[{bounds[0]}, {final}]")
            site = _site(text, path, EditKind.MISSION, list(dict.fromkeys(others)))
            is_odd = key == "start" and _breaks_order(mission.agent.goals, number)
            yield replace(site, agreeing=frozenset((one.begin, one.new) for one in site.edits if is_odd))


def _breaks_order(goals: Sequence[GoalConfiguration], number: int) -> bool:
    """Whether the goals of a timeline would be written in the order of their times if it were not for one.

    So they are on 30 of 36 timelines of right missions.
    """
    timeline = goals[number].timeline
    times = {at: one.start[0] for at, one in enumerate(goals) if one.timeline == timeline and one.start is not None}
    whole, rest = list(times.values()), [time for at, time in times.items() if at != number]
    return len(whole) >= _SERIES and rest == sorted(rest) and whole != sorted(whole)


def _promised(text: MissionText, number_of: int, kept: PropertyConfiguration) -> Iterator[EditSite]:
    """The levels that a resource keeps within, without one of the limits, and the first number of a condition."""
    table = ("property", number_of)
    if (level := (*table, "level")) in text.places and kept.level is not None:
        lower, upper = kept.level.bounds
        wider = [one for one in ((-math.inf, upper), (lower, math.inf)) if one != (lower, upper)]
        yield _site(text, level, EditKind.PROMISE, [f"[{low:g}, {high:g}]" for low, high in wider])
    if (where := (*table, "where")) in text.places:
        said = text.value_span(where).text
        number = _NUMBER.search(said)
        if number is not None:
            others = [f"{float(number.group()) * factor:g}" for factor in (2.0, 0.5, 10.0, 0.1)]
            yield _site(
                text, where, EditKind.PROMISE, [said[: number.start()] + one + said[number.end() :] for one in others]
            )


def _asked(mission: Mission, number: int) -> Iterator[EditSite]:
    """The parameters that a goal gives one value."""
    goals, text = mission.agent.goals, mission.text
    goal = goals[number]
    for key, value in goal.parameters:
        path = ("goal", number, _PARAMETERS, key)
        if path not in text.places or isinstance(value, tuple):
            continue
        found = [
            text.value_span(other).text
            for at, one in enumerate(goals)
            if (one.timeline, one.predicate) == (goal.timeline, goal.predicate)
            and (other := ("goal", at, _PARAMETERS, key)) in text.places
        ]
        match value:
            case bool():
                found.append(str(not value).lower())
            case int() | float() if value > 1:
                found += [str(value // part if isinstance(value, int) else value / part) for part in (2, 10)]
            case _:
                pass
        own = text.value_span(path)
        fresh: list[str] = []
        if isinstance(value, int) and not isinstance(value, bool) and _is_copy(goals, number, key):
            asked = _asked_for(goals, goal, key)
            fresh = [str(one) for one in (value + 1, value - 1) if one > 0 and one not in asked]
        others = [one for one in dict.fromkeys((*fresh, *found)) if one not in (own.text, "0")]
        site = _site(text, path, EditKind.GOAL, others)
        unlike = frozenset((own.begin, one) for one in others if _leaves_others(goals, number, key, one))
        yield replace(site, wanted=frozenset((own.begin, one) for one in fresh), unlike=unlike)


def _leaves_others(goals: Sequence[GoalConfiguration], number: int, key: str, new: str) -> bool:
    """Whether a number that lies among those of the other goals of its predicate would not with a new value."""
    beside = [one for at, one in enumerate(goals) if at != number and _what(one)[:2] == _what(goals[number])[:2]]
    known = [value for one in beside if isinstance(value := dict(one.parameters).get(key), int | float)]
    value = dict(goals[number].parameters)[key]
    if not known or not isinstance(value, int | float) or not _NUMBER.fullmatch(new):
        return False
    return min(known) <= value <= max(known) and not min(known) <= float(new) <= max(known)


def _is_copy(goals: Sequence[GoalConfiguration], number: int, key: str) -> bool:
    """Whether a goal asks for what one before it does, or has a number of that one where all others have their own."""
    goal = goals[number]
    asked, value = _asked_for(goals, goal, key), dict(goal.parameters)[key]
    is_series = len(asked) >= _SERIES and len(set(asked)) == len(asked) - 1
    return any(
        _what(one) == _what(goal) or (is_series and dict(one.parameters).get(key) == value)
        for one in goals[:number]
        if _what(one)[:2] == _what(goal)[:2]
    )


def _asked_for(goals: Sequence[GoalConfiguration], goal: GoalConfiguration, key: str) -> list[object]:
    """What goals of a predicate ask for by one parameter."""
    return [dict(one.parameters).get(key) for one in goals if _what(one)[:2] == _what(goal)[:2]]


def _what(goal: GoalConfiguration) -> tuple[object, ...]:
    """What a goal asks for, whenever it be."""
    return goal.timeline, goal.predicate, goal.parameters


def _site(text: MissionText, path: tuple[str | int, ...], kind: EditKind, values: Sequence[str]) -> EditSite:
    file = str(real_path(Path(text.source.name)))
    entry, span = text.entry_span(path), text.value_span(path)
    line, column = text.source.locate(entry.begin)
    edits = tuple(SmallEdit(kind, file, span.begin, span.finish, span.text, one, span.line) for one in values)
    last = text.source.locate(span.finish - 1)[0]
    return EditSite(file, line, column, last, "", (line, last), entry.text, edits, begin=entry.begin)
