"""Regression cases: shrunk missions that once failed, as TOML beside the mission file, to be flown first."""

import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from checker.conditions.space import fixed
from runtime.executive.configuration import AgentConfiguration

_NAME_ENDS = ".regressions.toml"


@dataclass(frozen=True, slots=True)
class RegressionCase:
    """A mission that is to pass. `goals` are numbers of the mission file's goals, from 0; `was` says how it failed."""

    name: str
    seed: int
    final_tick: int
    goals: tuple[int, ...]
    parameters: tuple[tuple[str, float], ...]
    was: str


class RegressionError(Exception):
    """A file of cases that cannot be used."""


def regressions_path(mission: Path) -> Path:
    """The file of a mission's cases."""
    return mission.with_name(mission.stem + _NAME_ENDS)


def read_cases(path: Path) -> tuple[RegressionCase, ...]:
    """The cases in a file, none where there is no file; raises RegressionError."""
    if not path.exists():
        return ()
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as problem:
        raise RegressionError(f"`{path}`: {problem}") from None
    cases = data.get("case", [])
    if not isinstance(cases, list):
        raise RegressionError(f"`{path}`: `case` is no list of tables; write [[case]]")
    return tuple(_case(path, number, one) for number, one in enumerate(cases, 1))


def _case(path: Path, number: int, table: Any) -> RegressionCase:
    match table:
        case {
            "name": str(name),
            "seed": int(seed),
            "final_tick": int(final_tick),
            "goals": list(goals),
            "parameters": dict(parameters),
        } if all(isinstance(one, int) for one in goals):
            if all(isinstance(value, int | float) for value in parameters.values()):
                values = tuple((key, float(value)) for key, value in parameters.items())
                return RegressionCase(name, seed, final_tick, tuple(goals), values, str(table.get("was", "")))
    raise RegressionError(f"`{path}`: case {number} needs name, seed, final_tick, goals and parameters")


def cases_text(cases: Sequence[RegressionCase]) -> str:
    """Cases as a file has them."""
    parts = ["# Missions that failed once and are to pass: written by `nddlc promote`, flown first by `nddlc check`.\n"]
    for case in cases:
        parts.append(
            f"\n[[case]]\nname = {_text(case.name)}\nwas = {_text(case.was)}\nseed = {case.seed}\n"
            f"final_tick = {case.final_tick}\ngoals = [{', '.join(map(str, case.goals))}]\n[case.parameters]\n"
        )
        parts += [f"{_text(name)} = {value!r}\n" for name, value in case.parameters]
    return "".join(parts)


def agent_of(case: RegressionCase, agent: AgentConfiguration) -> AgentConfiguration:
    """The agent that flies a case; raises RegressionError where the mission has changed too much."""
    known = {one.name for one in agent.parameters}
    missing = [name for name, _ in case.parameters if name not in known]
    if missing:
        raise RegressionError(f"case `{case.name}` gives `{missing[0]}`, which the models do not sample")
    if any(not 0 <= number < len(agent.goals) for number in case.goals):
        raise RegressionError(f"case `{case.name}` has a goal that the mission file lacks")
    goals = tuple(agent.goals[number] for number in case.goals)
    return replace(fixed(agent, dict(case.parameters)), goals=goals, final_tick=case.final_tick)


def _text(value: str) -> str:
    """A basic string of TOML."""
    plain = value.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(each if each >= " " and each != "\x7f" else f"\\u{ord(each):04x}" for each in plain) + '"'
