"""One mission of a mission file: flown from a seed and given values, and its trace as text that is flown again."""

import json
import math
import os
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from checker.batch.identity import model_digest
from checker.before_mission import put_before
from checker.flight import fly_recorded
from checker.mission import Mission
from checker.models import ModelSet
from checker.oracle import Judgement, judge_within
from checker.pinned import pinned
from checker.real_time import RealTimeClock
from nddl_lang.text.read import real_path
from nddl_lang.text.values import json_value
from runtime.executive.clocks import FastClock, LogClock
from runtime.executive.outcome import Outcome
from runtime.executive.rendering import trace_json
from runtime.limits import TIME_LIMIT

_HEAD = "mission"  # the kind of the first line of a trace


@dataclass(frozen=True, slots=True)
class FlightSettings:
    """What decides a flight, beside the mission file: the seed, values given to parameters, where it stops.

    `steps` are those that planners made in each tick, where another clock than the mission file's decided it.
    """

    seed: int
    values: Mapping[str, float]
    until: int | None = None
    steps: tuple[tuple[int, int], ...] | None = None


@dataclass(frozen=True, slots=True)
class Flight:
    """A flight that is over."""

    settings: FlightSettings
    models: str  # digest
    outcome: Outcome
    judgement: Judgement
    before: tuple[tuple[str, str, str], ...] = ()  # put before the mission: predicate, timeline, and who asked for it


def fly(
    mission: Mission,
    models: ModelSet,
    settings: FlightSettings,
    clock: FastClock | None = None,
    now: Callable[[], float] = time.monotonic,
) -> Flight:
    """Fly the mission once, by a clock, by the steps that another one counted, or by that of the mission file.

    In real time it takes its time; else it raises OutOfTimeError where a search goes on beyond the mission's limit, by
    `now`, which is asked every few decisions. Where a sampler placed parameters, their values are settings then.
    """
    programs = pinned(models).programs_of(models.agent)
    logged = None if settings.steps is None else LogClock(dict(settings.steps))
    limit = math.inf if isinstance(clock, RealTimeClock) else mission.check.time_limit
    with TIME_LIMIT.lasting(limit, now):
        outcome, record = fly_recorded(
            models.agent, programs, settings.seed, dict(settings.values), settings.until, clock=clock or logged
        )
    if clock is not None:
        settings = replace(settings, steps=tuple(sorted(clock.counts.items())))
    placed = {one.name for one in models.agent.parameters if one.share is not None}
    drawn = {one.parameter: one.value for one in outcome.draws if one.parameter in placed}
    settings = replace(settings, values=drawn | dict(settings.values))
    judged = judge_within(outcome, mission.check.limits)
    return Flight(settings, model_digest(models.texts), outcome, judged, put_before(models.agent, record))


def trace_text(flight: Flight, mission: Path, trace: Path) -> str:
    """The flight as JSON Lines: first what decides it, with the mission file relative to the trace, then its events."""
    head: dict[str, object] = {
        "tick": 0,
        "phase": "start",
        "kind": _HEAD,
        "mission": Path(os.path.relpath(real_path(mission), real_path(trace).parent)).as_posix(),
        "models": flight.models,
        "seed": flight.settings.seed,
        "values": dict(sorted(flight.settings.values.items())),
        "until": flight.settings.until,
    }
    if flight.settings.steps is not None:
        head["steps"] = flight.settings.steps
    lines = [json.dumps(head, ensure_ascii=False, separators=(",", ":"))]
    lines += [trace_json(event) for event in flight.outcome.events]
    return "\n".join(lines) + "\n"


@dataclass(frozen=True, slots=True)
class Recorded:
    """A trace that was read back."""

    mission: Path
    models: str
    settings: FlightSettings
    lines: tuple[str, ...]


def read_trace(path: Path) -> Recorded:
    """Read a trace; raises OSError, or ValueError where the file is none."""
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    try:
        head: dict[str, Any] = json_value(lines[0]) if lines else {}
    except ValueError:
        raise ValueError("its first line is no JSON object") from None
    if not isinstance(head, dict) or head.get("kind") != _HEAD:
        raise ValueError("its first line does not say which mission it is of")
    try:
        values = {str(name): float(value) for name, value in head["values"].items()}
        steps = tuple((int(tick), int(count)) for tick, count in head["steps"]) if "steps" in head else None
        until = None if head["until"] is None else int(head["until"])
        settings = FlightSettings(int(head["seed"]), values, until, steps)
        return Recorded(path.parent / str(head["mission"]), str(head["models"]), settings, tuple(lines[1:]))
    except (KeyError, TypeError, ValueError, AttributeError) as problem:
        raise ValueError("its first line lacks what decides the flight") from problem


def first_departure(recorded: Recorded, flight: Flight) -> tuple[int, str, str] | None:
    """The number of the first line that differs (from 1), as recorded and as flown now; empty where there is none."""
    flown = [trace_json(event) for event in flight.outcome.events]
    for number in range(max(len(flown), len(recorded.lines))):
        old = recorded.lines[number] if number < len(recorded.lines) else ""
        new = flown[number] if number < len(flown) else ""
        if old != new:
            return number + 2, old, new
    return None
