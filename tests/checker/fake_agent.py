"""A stand-in for the agent: outcomes made by hand from the draws of models/gps, for tests of the checker alone."""

import math
import os
import time
from dataclasses import replace
from pathlib import Path

from checker.batch.worker import Fly
from compiler.program import DomainConstant
from runtime.executive.chance import sample
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.outcome import (
    Abort,
    Conflict,
    ConflictElement,
    ElementKind,
    Event,
    EventKind,
    Outcome,
    Phase,
    Reason,
    ReasonKind,
    RepairStage,
    SourcePlace,
)
from runtime.limits import LimitError, half_of_the_machine
from runtime.plan.readout.names import TokenName, VariableName
from runtime.plan.readout.statements import Term

SURFACE_MAX = 63  # less 25 ticks of ascent: fails when 10 * rate > 38
ASCENT = 25
SAMPLE = SourcePlace("psim.nddl", 40, 3, "gpsHitRate == sampledParameter(GPS_HIT_RATE);")
PRODUCT = SourcePlace("psim.nddl", 41, 3, "expectedDuration == gpsHitRate * minHits;")
LASTS = SourcePlace("psim.nddl", 42, 3, "duration <= expectedDuration;")
CONTAINS = SourcePlace("rules.nddl", 30, 3, "contains(Gps.Active fix);")
LIMIT = SourcePlace("rules.nddl", 34, 3, "duration <= SURFACE_MAX;")
CONSTANT = SourcePlace("navigator.nddl", 5, 1, "SURFACE_MAX = 64;")
FIX = TokenName("Gps.Active", 7)
SURFACE = TokenName("Nav.Surface", 5)
NUMBER = "float"


def of(token: TokenName, name: str, kind: str = "int") -> VariableName:
    """A variable of a token; those of floats are locals of its rule."""
    return VariableName(name, kind, token, kind == NUMBER)


def element(kind: ElementKind, place: SourcePlace | None, token: TokenName | None, *terms: Term) -> ConflictElement:
    """An element that says its first term."""
    return ConflictElement(kind, place, token.predicate if token and place else "", token, terms[0], terms)


def linked_conflict(rate: float) -> Conflict:
    """The draw, the rule of Figure 7 and the navigator's limit, in one database."""
    drawn, expected = of(FIX, "gpsHitRate", NUMBER), of(FIX, "expectedDuration", NUMBER)
    limit = VariableName("SURFACE_MAX", "int")
    return Conflict((
        element(ElementKind.SAMPLE, SAMPLE, FIX, Term("sampledParameter", (drawn, "GPS_HIT_RATE", rate))),
        element(ElementKind.CONSTRAINT, PRODUCT, FIX, Term("mulEq", (drawn, 10.0, expected))),
        element(ElementKind.CONSTRAINT, LASTS, FIX, Term("leq", (expected, of(FIX, "duration")))),
        element(ElementKind.DURATION, None, FIX, _duration(FIX)),
        element(
            ElementKind.RELATION, CONTAINS, SURFACE,
            Term("precedence", (of(FIX, "start"), of(SURFACE, "start"), -ASCENT)),
            Term("precedence", (of(SURFACE, "end"), of(FIX, "end"), 0)),
        ),
        element(ElementKind.DURATION, None, SURFACE, _duration(SURFACE)),
        element(ElementKind.ASSIGNMENT, CONSTANT, None, Term("bounds", (limit, SURFACE_MAX, SURFACE_MAX))),
        element(ElementKind.CONSTRAINT, LIMIT, SURFACE, Term("leq", (of(SURFACE, "duration"), limit))),
    ))  # fmt: skip


def _duration(token: TokenName) -> Term:
    return Term("temporalDistance", (of(token, "start"), of(token, "duration"), of(token, "end")))


def split_conflict(rate: float) -> Conflict:
    """What the navigator alone sees: no fix yet, and the time of the surfacing is over."""
    lasts = element(ElementKind.CLOCK, None, SURFACE, Term("bounds", (of(SURFACE, "end"), 265, 900)))
    began = element(ElementKind.OBSERVATION, None, SURFACE, Term("bounds", (of(SURFACE, "start"), 201, 201)))
    return Conflict((lasts, began, *linked_conflict(rate).elements[5:]))


def _outcome(agent: AgentConfiguration, seed: int, *, is_linked: bool) -> Outcome:
    draws = tuple(sample(parameter, seed, 0) for parameter in agent.parameters)
    rate = next(draw.value for draw in draws if draw.parameter == "GPS_HIT_RATE")
    hits = (("minHits", DomainConstant("float", "float", (10.0, 10.0), None)),)
    events = [
        Event(0, Phase.OBSERVE, EventKind.OBSERVATION, "psim", "helm", "Inactive"),
        *(Event(25, Phase.SYNCHRONISE, EventKind.SAMPLE, "psim", draw=draw) for draw in draws),
        Event(101, Phase.DISPATCH, EventKind.REQUEST, "navigator", "helm", "Ascend", causes=(0,), request=7),
        Event(226, Phase.OBSERVE, EventKind.OBSERVATION, "psim", "gps", "Active", hits, (3, 1), FIX),
    ]
    end, conflict = ASCENT + math.ceil(10 * rate), None
    if end > SURFACE_MAX:
        conflict = linked_conflict(rate) if is_linked else split_conflict(rate)
    if conflict is None:
        events.append(Event(agent.final_tick, Phase.END, EventKind.END))
        return Outcome(seed, agent.final_tick, agent.final_tick, None, draws, tuple(events), ())
    reason = Reason(ReasonKind.GOES_ON, FIX, tick=265)
    repair = RepairStage.KEEP_PAST
    events.append(
        Event(
            265, Phase.REPAIR, EventKind.RELAX, "navigator", causes=(4,), stage=repair, reason=reason, conflict=conflict
        )
    )
    events.append(
        Event(265, Phase.SYNCHRONISE, EventKind.ABORT, "navigator", "gps", causes=(4, 5), code="F1", reason=reason)
    )
    abort = Abort("F1", 265, "navigator", ("gps",), reason, conflict, 2, len(events) - 1)
    return Outcome(seed, 265, agent.final_tick, abort, draws, tuple(events), ())


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
    """A fake agent that takes its time; where FLOWN names a file, it writes there when it has flown which seed."""
    log = os.environ.get("FLOWN")

    def fly(seed: int) -> Outcome:
        time.sleep(0.02)
        if log is not None:
            with Path(log).open("a", encoding="ascii") as file:  # one short write: lines of two workers do not mix
                file.write(f"{seed} {time.time()}\n")
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


def load_very_slow(agent: AgentConfiguration) -> Fly:
    """A fake agent that needs 0.4 s a mission."""

    def fly(seed: int) -> Outcome:
        time.sleep(0.4)
        return _outcome(agent, seed, is_linked=True)

    return fly


def load_signalled(agent: AgentConfiguration) -> Fly:
    """A fake agent that dies of a real-time signal in the mission with seed 3."""

    def fly(seed: int) -> Outcome:
        if seed == 3:
            os.kill(os.getpid(), 40)
            time.sleep(5.0)
        return _outcome(agent, seed, is_linked=True)

    return fly


def load_greedy(agent: AgentConfiguration) -> Fly:
    """A fake agent that asks for more than half of the machine's memory in the mission with seed 2."""

    def fly(seed: int) -> Outcome:
        if seed == 2:
            bytearray((half_of_the_machine() + 100) * 2**20)
        if seed == 3:
            raise LimitError("no end was found")
        return _outcome(agent, seed, is_linked=True)

    return fly
