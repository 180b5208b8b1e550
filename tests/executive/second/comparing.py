"""A mission flown by nddlc and by the second agent: what differs between the two traces."""

from collections import Counter
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from runtime.executive.chance import sample
from runtime.executive.mission import run_mission
from tests.executive.generated.flights import lines_of, loaded
from tests.executive.second.agent import fly
from tests.executive.second.description import FAR, Description
from tests.executive.second.writing import written

KEYS = ("kind", "reactor", "timeline", "predicate", "arguments", "start", "stage", "code")
COSTS = (1, 2, 3)  # steps of a decision: a token may be two (that it is made, and where), and what fails is tried, too
KINDS = ("observation", "request", "recall", "reject", "refuse", "relax", "kill", "abort", "end", "achieved")


def told(events: list[dict[str, Any]]) -> list[tuple[Any, ...]]:
    """The events as far as both tell them, sorted within a tick."""
    found = []
    for event in events:
        if event["kind"] not in KINDS:
            continue
        values: dict[str, Any] = {key: event.get(key) for key in KEYS}
        if values["kind"] in ("kill", "abort", "end"):
            values |= {"timeline": None, "predicate": None, "arguments": None}
        if values["kind"] == "end":
            values["code"] = None
        if not (values["kind"] == "request" and values["reactor"]):
            values["start"] = None
        elif values["start"][1] == "inf" or values["start"][1] > FAR // 2:
            values["start"][1] = "inf"
        found.append((event["tick"], *(str(values[key] or "") for key in KEYS)))
    return sorted(found)


def differences(description: Description) -> tuple[list[str], int]:
    """What only one of the two tells (`-` nddlc, `+` the second agent), and how often a planner had a choice."""
    with TemporaryDirectory() as folder:
        agent, programs = loaded(written(description, Path(folder)))
        outcome = run_mission(agent, programs, 1)
    parameters = {parameter.name: parameter for parameter in agent.parameters}
    theirs = Counter(told(lines_of(outcome)))
    first: list[str] = []
    for cost in COSTS:
        events, choices = fly(description, lambda name, tick: int(sample(parameters[name], 1, tick).value), cost)
        mine = Counter(told(events))
        wrong = [f"- {one}" for one in sorted((theirs - mine).elements())]
        wrong += [f"+ {one}" for one in sorted((mine - theirs).elements())]
        if not wrong:
            return [], choices
        first = first or wrong
    return first, choices
