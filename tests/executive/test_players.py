"""A player in the place of each reactor of the variations in turn: what the others do stays the same."""

import json
import os
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from runtime.executive.configuration import CodeConfiguration, ReactorConfiguration
from runtime.executive.mission import MissionPrograms, run_mission
from runtime.executive.outcome import Outcome
from runtime.user.log_player import LogPlayer
from tests.executive.flying import Flown
from tests.executive.test_variations import VARIATIONS, flown_of, lines
from tests.executive.variations.form import Data, Variation

FEWER = 1 if os.environ.get("NDDLC_CASES") == "all" else 7
IN_TURN = ("two_users_ask_in_one_tick", "recall_of_one_of_two_who_share", "chain_of_three_leaf_is_killed_before")
OTHER_TYPES = "undefined_of_an_enums_value"  # its user's model, which alone is left, does not know a value
CHOSEN = [one for k, one in enumerate(VARIATIONS) if k % FEWER == 0 or one.name in IN_TURN]
KEYS = ("tick", "kind", "reactor", "timeline", "predicate", "arguments", "start", "end", "duration", "stage", "code")
PLAYED = ("observation", "request", "recall")
ANSWERS = ("refuse", "reject")
ENDS = ("kill", "abort")


@pytest.mark.once
@pytest.mark.parametrize("one", [one for one in CHOSEN if one.name != OTHER_TYPES], ids=lambda one: one.name)
def test_a_player_in_the_place_of_a_reactor_changes_nothing(one: Variation, tmp_path: Path) -> None:
    mission = flown_of(one)
    events = lines(mission.outcome)
    (tmp_path / "trace.jsonl").write_text("\n".join(map(json.dumps, events)))
    for each in mission.agent.reactors:
        kinds = {event["kind"] for event in events if event["reactor"] == each.name}
        if not kinds.intersection((*ANSWERS, *ENDS)):
            played = lines(with_player(one, mission, each, tmp_path))
            assert told(played, each.name) == told(events, each.name)


def with_player(one: Variation, mission: Flown, each: ReactorConfiguration, folder: Path) -> Outcome:
    """The mission with a player in the place of one reactor."""
    settings = (("trace", "trace.jsonl"), ("reactor", each.name))
    place = (each.latency, each.internal, each.external)
    player = CodeConfiguration(each.name, "", LogPlayer.__name__, *place, settings, each.lookahead)
    pairs = [pair for pair in zip(mission.agent.reactors, mission.programs, strict=True) if pair[0] != each]
    agent = replace(
        mission.agent,
        root=str(folder),
        reactors=tuple(reactor for reactor, _ in pairs),
        coded=(player,),
        order=tuple(reactor.name for reactor in mission.agent.reactors),
    )
    programs = MissionPrograms(
        tuple(program for _, program in pairs), tuple(one.solver for _ in pairs), code=(LogPlayer,)
    )
    return run_mission(agent, programs, 1)


def told(events: list[Data], name: str) -> list[list[Any]]:
    """What happened, but for what a player of that name does not say, and draws."""
    return [
        [plain(event.get(key)) for key in KEYS]
        for event in events
        if event["kind"] in (*PLAYED, *ANSWERS, *ENDS, "relax", "achieved")
        and (event["reactor"] != name or event["kind"] in PLAYED)
    ]


def plain(value: Any) -> Any:
    """A value without the type of its numbers: no model says that of a goal for a player."""
    if isinstance(value, dict):
        return {name: plain(each) for name, each in value.items()}
    if isinstance(value, list):
        return [plain(each) for each in value]
    return value if isinstance(value, bool) or not isinstance(value, int) else float(value)
