"""A mission file in, its sites out: times of goals, and how far ahead and how fast reactors plan.

What goals ask for is the user's, and what is drawn is the world's: neither is changed.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from checker.mission import Mission, parse_mission
from checker.mission_table import MissionText
from checker.mutation.edits import EditKind, EditSite, SmallEdit, edited
from nddl_lang.text.read import real_path
from nddl_lang.text.source import Source
from runtime.executive.configuration import AgentConfiguration

_TIMES = ("start", "end", "duration")


def mission_sites(mission: Mission) -> dict[tuple[str, int], list[EditSite]]:
    """The sites of each reactor and each goal, by table and number."""
    final, text = mission.agent.final_tick, mission.text
    found: dict[tuple[str, int], list[EditSite]] = {}
    if text.source.name.endswith(".toml"):
        for number, reactor in enumerate(mission.agent.reactors):
            ahead = 1 if reactor.lookahead == 0 else final
            values = {"lookahead": ahead if reactor.lookahead not in (1, final) else None}
            values["latency"] = 1 if reactor.latency > 1 else None
            at = next(k for k in _numbers(text, "reactor") if _is_named(text, ("reactor", k, "name"), reactor.name))
            found["reactor", number] = list(_sites(text, ("reactor", at), values))
        for number in range(len(mission.agent.goals)):
            anytime = f"[0, {final}]"
            found["goal", number] = list(_sites(text, ("goal", number), dict.fromkeys(_TIMES, anytime)))
    return found


def agent_with(mission: Mission, agent: AgentConfiguration, edit: SmallEdit) -> AgentConfiguration:
    """The agent with the goals and reactors that the mission file has with an edit; as it is where that is none."""
    text = Source(mission.source.name, edited(mission.source.text, edit))
    changed, _ = parse_mission(text, Path(mission.agent.root))
    if changed is None:
        return agent
    pairs = zip(changed.agent.goals, agent.goals, strict=True)
    goals = tuple(replace(goal, mandatory=known.mandatory) for goal, known in pairs)
    return replace(agent, reactors=changed.agent.reactors, goals=goals)


def _sites(text: MissionText, table: tuple[str, int], values: Mapping[str, object]) -> Iterator[EditSite]:
    file = str(real_path(Path(text.source.name)))
    for key, value in values.items():
        path = (*table, key)
        if value is None or path not in text.places:
            continue
        entry, span = text.entry_span(path), text.value_span(path)
        line, column = text.source.locate(entry.begin)
        edit = SmallEdit(EditKind.MISSION, file, span.begin, span.finish, span.text, str(value), span.line)
        last = text.source.locate(span.finish - 1)[0]
        yield EditSite(file, line, column, last, "", (line, last), entry.text, (edit,), begin=entry.begin)


def _numbers(text: MissionText, table: str) -> list[int]:
    return [path[1] for path in text.places if len(path) == 2 and path[0] == table and isinstance(path[1], int)]


def _is_named(text: MissionText, path: tuple[str | int, ...], name: str) -> bool:
    return path in text.places and text.value_span(path).text.strip("\"'") == name
