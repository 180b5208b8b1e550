"""A stand-in for the agent: outcomes made by hand from the draws of models/gps, for tests of the checker alone."""

import math
import os
import time
from dataclasses import replace

from checker.batch.worker import Fly
from runtime.executive.chance import sample
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.outcome import (
    Abort,
    Cause,
    Conflict,
    Draw,
    Event,
    Outcome,
    Place,
    Term,
    VariableInfo,
)

SURFACE_MAX = 63  # less 25 ticks of ascent: fails when 10 * rate > 38
ASCENT = 25
SAMPLE = Place("psim.nddl", 40, 3, "gpsHitRate == sampledParameter(GPS_HIT_RATE);")
PRODUCT = Place("psim.nddl", 41, 3, "expectedDuration == gpsHitRate * minHits;")
LASTS = Place("psim.nddl", 42, 3, "duration <= expectedDuration;")
CONTAINS = Place("rules.nddl", 30, 3, "contains(Gps.Active fix);")
LIMIT = Place("rules.nddl", 34, 3, "duration <= SURFACE_MAX;")
CONSTANT = Place("navigator.nddl", 5, 1, "SURFACE_MAX = 66;")


def linked_conflict(rate: float) -> Conflict:
    """The draw, the rule of Figure 7 and the navigator's limit, in one database."""
    gps, nav = "Gps.Active#7", "Nav.Surface#5"
    causes = (
        Cause("sample", SAMPLE, "Gps::Active", gps, f"gpsHitRate == {rate!r}", (
            Term("sampledParameter", (f"{gps}.gpsHitRate", "GPS_HIT_RATE", rate)),)),
        Cause("constraint", PRODUCT, "Gps::Active", gps, "expectedDuration == gpsHitRate * 10", (
            Term("mulEq", (f"{gps}.gpsHitRate", 10.0, f"{gps}.expectedDuration")),)),
        Cause("constraint", LASTS, "Gps::Active", gps, f"duration >= {10 * rate:g}", (
            Term("leq", (f"{gps}.expectedDuration", f"{gps}.duration")),)),
        Cause("duration", None, "", gps, "end - start == duration", (
            Term("temporalDistance", (f"{gps}.start", f"{gps}.duration", f"{gps}.end")),)),
        Cause("relation", CONTAINS, "Nav::Surface", nav, "the fix begins at least 25 ticks after the surfacing", (
            Term("precedence", (f"{gps}.start", f"{nav}.start", -ASCENT)),
            Term("precedence", (f"{nav}.end", f"{gps}.end", 0)))),
        Cause("duration", None, "", nav, "end - start == duration", (
            Term("temporalDistance", (f"{nav}.start", f"{nav}.duration", f"{nav}.end")),)),
        Cause("assignment", CONSTANT, "", "", f"SURFACE_MAX == {SURFACE_MAX}", (
            Term("bounds", ("SURFACE_MAX", SURFACE_MAX, SURFACE_MAX)),)),
        Cause("constraint", LIMIT, "Nav::Surface", nav, f"duration <= {SURFACE_MAX}", (
            Term("leq", (f"{nav}.duration", "SURFACE_MAX")),)),
    )  # fmt: skip
    kinds = {"gpsHitRate": "float", "expectedDuration": "float", "SURFACE_MAX": "int"}
    names = dict.fromkeys(
        argument
        for cause in causes
        for term in cause.terms
        for argument in term.arguments
        if isinstance(argument, str) and argument != "GPS_HIT_RATE"
    )
    return Conflict(causes, tuple(VariableInfo(name, kinds.get(name.rpartition(".")[2], "int")) for name in names))


def split_conflict(rate: float) -> Conflict:
    """What the navigator alone sees: no fix yet, and the time of the surfacing is over."""
    nav = "Nav.Surface#5"
    causes = (
        Cause("clock", None, "", nav, "still at it at tick 264, so end >= 265", (
            Term("bounds", (f"{nav}.end", 265, 900)),)),
        Cause("observation", None, "", nav, "began at tick 201", (Term("bounds", (f"{nav}.start", 201, 201)),)),
        *linked_conflict(rate).causes[5:],
    )  # fmt: skip
    kept = tuple(v for v in linked_conflict(rate).variables if v.name.startswith((nav, "SURFACE_MAX")))
    return Conflict(causes, kept)


def _outcome(agent: AgentConfiguration, seed: int, *, is_linked: bool) -> Outcome:
    draws = tuple(sample(parameter, seed, 0) for parameter in agent.parameters)
    rate = next(draw.value for draw in draws if draw.parameter == "GPS_HIT_RATE")
    events = [
        Event(0, "observe", "observation", "psim", "helm", "Inactive"),
        *_sampled(draws),
        Event(101, "dispatch", "request", "navigator", "helm", "Ascend", (0,)),
        Event(226, "observe", "observation", "psim", "gps", "Active(minHits=10)", (3, 1)),
    ]
    end, conflict = ASCENT + math.ceil(10 * rate), None
    if end > SURFACE_MAX:
        conflict = linked_conflict(rate) if is_linked else split_conflict(rate)
    if conflict is None:
        events.append(Event(agent.final_tick, "end", "end", "", "", f"mission over at tick {agent.final_tick}"))
        return Outcome(seed, agent.final_tick, agent.final_tick, None, draws, tuple(events), ())
    summary = "`gps` still holds `Active` when it must be over"
    events.append(Event(265, "synchronise", "relax", "navigator", "", "keep past", (4,)))
    events.append(Event(265, "synchronise", "abort", "navigator", "gps", f"F1: {summary}", (4, 5)))
    abort = Abort("F1", 265, "navigator", ("gps",), summary, conflict, 2, len(events) - 1)
    return Outcome(seed, 265, agent.final_tick, abort, draws, tuple(events), ())


def _sampled(draws: tuple[Draw, ...]) -> list[Event]:
    return [Event(25, "synchronise", "sample", "psim", "", f"{one.parameter} = {one.value!r}") for one in draws]


def load_linked(agent: AgentConfiguration) -> Fly:
    """A fake agent whose conflicts reach from the draw to the limit."""
    return lambda seed: _outcome(agent, seed, is_linked=True)


def load_split(agent: AgentConfiguration) -> Fly:
    """A fake agent whose conflicts end at the border of the navigator."""
    return lambda seed: _outcome(agent, seed, is_linked=False)


def load_troubled(agent: AgentConfiguration) -> Fly:
    """A fake agent that now and then breaks, hangs or dies, by its seed."""

    def fly(seed: int) -> Outcome:
        match seed % 10:
            case 0:
                raise ValueError("a bug of ours")
            case 1:
                time.sleep(60.0)
            case 2:
                os._exit(9)
        return replace(_outcome(agent, seed, is_linked=True), seed=seed)

    return fly


def load_slow(agent: AgentConfiguration) -> Fly:
    """A fake agent that takes its time."""

    def fly(seed: int) -> Outcome:
        time.sleep(0.02)
        return _outcome(agent, seed, is_linked=True)

    return fly


def load_broken(_agent: AgentConfiguration) -> Fly:
    """A fake agent that fails in every flight."""

    def fly(seed: int) -> Outcome:
        raise ValueError(f"a bug of ours in mission with seed {seed}")

    return fly


def load_nothing(_agent: AgentConfiguration) -> Fly:
    """A fake agent that cannot be loaded."""
    raise RuntimeError("no such engine")
