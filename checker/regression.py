"""Regression cases: missions that failed once, flown before all others.

A case comes from one of two places and is flown, judged and told in one way. `nddlc check` keeps the first failures
of each fault in its store, by seed: these are local, and nobody has to think of them. `nddlc promote` writes a shrunk
one as TOML beside the mission file: it goes into version control, and must pass whatever failure rate is accepted.
"""

import tomllib
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from checker.batch.result import MissionResult
from checker.buckets import Key, bucket_key
from checker.conditions.space import fixed
from checker.oracle import PROPERTY, Verdict
from checker.sampling.sampler import RANDOM_POINT, SamplePoint, with_point
from checker.written_mission import quoted
from nddl_lang.text.values import toml_value
from runtime.executive.configuration import AgentConfiguration, PropertyKind

_NAME_ENDS = ".regressions.toml"
_MOST_ALIKE = 3  # failures of a bucket that are kept


@dataclass(frozen=True, slots=True)
class RegressionCase:
    """A mission that is to pass; `was` says how it failed. One with a name was promoted.

    `goals` are numbers of the mission file's goals, from 0; None leaves goals and final tick as the mission has them.
    """

    name: str
    seed: int
    was: str
    point: SamplePoint = RANDOM_POINT
    final_tick: int | None = None
    goals: tuple[int, ...] | None = None
    parameters: tuple[tuple[str, float], ...] = ()

    @property
    def is_promoted(self) -> bool:
        """Whether somebody has promoted it: then it must pass."""
        return bool(self.name)


@dataclass(frozen=True, slots=True)
class FlownCase:
    """A case and what became of it now."""

    case: RegressionCase
    result: MissionResult

    @property
    def passes(self) -> bool:
        """Whether it does not fail any more."""
        return self.result.verdict is Verdict.PASS


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
        data = toml_value(path.read_text(encoding="utf-8"))
    except OSError as problem:
        raise RegressionError(f"`{path}` cannot be read: {problem.strerror or problem}") from None
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
            "goals": list(goals),
            "parameters": dict(parameters),
        } if all(isinstance(one, int) for one in goals) and isinstance(table.get("final_tick", 0), int):
            if all(isinstance(value, int | float) for value in parameters.values()):
                values = tuple((key, float(value)) for key, value in parameters.items())
                was = str(table.get("was", ""))
                return RegressionCase(
                    name or f"case {number}", seed, was, RANDOM_POINT, table.get("final_tick"), tuple(goals), values
                )
    raise RegressionError(f"`{path}`: case {number} needs name, seed, goals and parameters")


def cases_text(cases: Sequence[RegressionCase]) -> str:
    """Cases as a file has them."""
    parts = ["# Missions that failed once and are to pass: written by `nddlc promote`, flown first by `nddlc check`.\n"]
    for case in cases:
        goals = ", ".join(map(str, case.goals or ()))
        ends = "" if case.final_tick is None else f"final_tick = {case.final_tick}\n"
        parts.append(
            f"\n[[case]]\nname = {quoted(case.name)}\nwas = {quoted(case.was)}\nseed = {case.seed}\n"
            f"{ends}goals = [{goals}]\n[case.parameters]\n"
        )
        parts += [f"{quoted(name)} = {value!r}\n" for name, value in case.parameters]
    return "".join(parts)


def agent_of(case: RegressionCase, agent: AgentConfiguration) -> AgentConfiguration:
    """The agent that flies a case; raises RegressionError where the mission has changed too much."""
    known = {one.name for one in agent.parameters}
    missing = [name for name, _ in case.parameters if name not in known]
    if missing:
        raise RegressionError(f"case `{case.name}` gives `{missing[0]}`, which the models do not sample")
    agent = with_point(fixed(agent, dict(case.parameters)) if case.parameters else agent, case.point)
    if case.goals is not None:
        if any(not 0 <= number < len(agent.goals) for number in case.goals):
            raise RegressionError(f"case `{case.name}` has a goal that the mission file lacks")
        is_whole = len(case.goals) == len(agent.goals) or case.was.startswith(PROPERTY)
        agent = replace(agent, goals=tuple(agent.goals[number] for number in case.goals))
        if not is_whole:  # what is to be reached may be what a goal that was left out asks for
            kept = tuple(one for one in agent.properties if one.kind is not PropertyKind.REACHED)
            agent = replace(agent, properties=kept)
    return agent if case.final_tick is None else replace(agent, final_tick=case.final_tick)


def worth_keeping(results: Sequence[MissionResult], flown: Sequence[FlownCase]) -> list[MissionResult]:
    """Of each bucket of failures the first ones, unless it has as many among the cases."""
    cases = [one.result for one in flown if one.result.verdict is Verdict.FAIL]
    found: Counter[Key] = Counter(bucket_key(result) for result in cases)
    chosen = []
    for result in results:
        if result.verdict is Verdict.FAIL:
            key = bucket_key(result)
            found[key] += 1
            if found[key] <= _MOST_ALIKE:
                chosen.append(result)
    return chosen
