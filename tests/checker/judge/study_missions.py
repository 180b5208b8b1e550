"""Missions of the study of faults: loaded but never flown here, each flown in a process of its own."""

import gc
import os
import pickle
import resource
import signal
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from types import CodeType, FrameType, FunctionType
from typing import Any

from checker.judge.judge import judge_mission
from checker.mission import read_mission
from checker.models import load_models
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.mission import MissionPrograms, record_mission
from runtime.executive.outcome import Outcome
from runtime.executive.record import MissionRecord
from tests.checker.judge.fault_study import CASES
from tests.checker.judge.missions import GPS
from tests.checker.judge.plain_mission import objections
from tests.executive.determined_models import random_case
from tests.executive.flying import Flown
from tests.executive.generated.flights import loaded
from tests.executive.generated.writer import random_agent
from tests.programs import programs_of

ROOT = GPS.parents[2]
_WATCHED = 30
_MEMORY = 4 * 2**30
_ROOMS = tuple(str(ROOT / "runtime" / room) for room in ("constraints", "plan", "executive", "determined", "solver"))
# What tells of a mission, or loads its models, and does not make it.
_TELLING = (
    "rendering",
    "story",
    "explanation",
    "minimisation",
    "readout",
    "relational",
    "claims",
    "trace",
    "outlines",
    "script",
    "prototypes",
    "loading",
    "building",
    "stock",
    "registry",
    "configuration",
    "/record",
)


@dataclass(frozen=True, slots=True)
class Ready:
    """A mission that is loaded, and was never flown here."""

    name: str
    agent: AgentConfiguration
    programs: MissionPrograms
    compiles: bool

    def fly(self) -> tuple[Outcome, MissionRecord]:
        """Fly it, and leave all that it was as plain values."""
        outcome, record = record_mission(self.agent, self.programs, 1, compiles=self.compiles)
        reactors = tuple(one._replace(tokens=tuple(one.tokens)) for one in record.reactors)
        return replace(outcome, events=tuple(outcome.events)), MissionRecord(reactors)

    def flown(self, result: tuple[Outcome, MissionRecord]) -> Flown:
        """A flight with what the judge says of it."""
        outcome, record = result
        report = judge_mission(self.agent, self.programs.programs, outcome, record, self.programs.constraints)
        return Flown(self.agent, self.programs.programs, outcome, record, report)

    def objections(self, flown: Flown) -> list[str]:
        """What the oracle objects to."""
        return objections(flown.agent, flown.programs, flown.outcome, flown.record)


def apart(work: Callable[[], Any], seconds: int) -> Any:
    """What comes of some work in a process of its own; None where it raises, hangs or takes too much."""
    ours, theirs = os.pipe()
    child = os.fork()
    if child == 0:
        status = 1
        try:
            os.close(ours)
            resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
            resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
            signal.signal(signal.SIGXCPU, signal.SIG_DFL)
            os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
            told = pickle.dumps(work())
            with os.fdopen(theirs, "wb") as pipe:
                pipe.write(told)
            status = 0
        finally:
            os._exit(status)
    os.close(theirs)
    with os.fdopen(ours, "rb") as pipe:
        told = pipe.read()
    _, status = os.waitpid(child, 0)
    return pickle.loads(told) if status == 0 else None


def _lines_of(mission: Ready) -> dict[str, set[int]]:
    """The lines of the engine that a mission runs, in the first calls of each function: to watch all takes long."""
    found: dict[str, set[int]] = {}
    calls: Counter[CodeType] = Counter()

    def at_call(frame: FrameType, _event: str, _argument: object) -> Any:
        file = frame.f_code.co_filename
        if not file.startswith(_ROOMS) or any(part in file for part in _TELLING):
            return None
        calls[frame.f_code] += 1
        if calls[frame.f_code] > _WATCHED:
            return None
        lines = found.setdefault(file, set())

        def at_line(frame: FrameType, event: str, _argument: object) -> Any:
            if event == "line":
                lines.add(frame.f_lineno)
            return at_line

        return at_line

    sys.settrace(at_call)
    mission.fly()
    sys.settrace(None)
    return found


@dataclass(frozen=True, slots=True)
class Stand:
    """A mission with the lines that it runs and its right flight."""

    mission: Ready
    lines: dict[str, set[int]]
    right: Flown


def stand_of(mission: Ready, seconds: int = 20) -> Stand | None:
    """A mission's stand; None where it takes too long with its lines watched."""
    lines = apart(lambda: _lines_of(mission), seconds)
    result = apart(mission.fly, seconds)
    if lines is None or result is None:
        return None
    right = mission.flown(result)
    assert right.report.holds, f"the judge objects to {mission.name}, which is right: {right.report.disagreements[0]}"
    said = mission.objections(right)
    assert not said, f"the oracle objects to {mission.name}, which is right: {said[0]}"
    return Stand(mission, lines, right)


NAMES = (
    "models/gps",
    *(f"models/templates/{name}" for name in ("battery", "noise", "rover", "survey", "retry", "window", "deadline")),
    *(f"tests/checker/unseen/{name}" for name in ("quay", "kiln", "brewery", "orchard", "lab", "theatre", "ward")),
    *(f"random {number}" for number in range(20)),
    *(f"agent {number}" for number in range(30)),
    *(str(path.parent.relative_to(ROOT)) for path in CASES[::16]),
)


def ready(names: tuple[str, ...]) -> Iterator[Ready]:
    """Missions: files, `random N` simulators, `agent N`; each by register code, and by the general engine."""
    for name in names:
        kind, _, number = name.partition(" ")
        if kind == "random":
            agent, programs = random_case(int(number)).agent()
        elif kind == "agent":
            with TemporaryDirectory() as folder:
                agent, programs = loaded(random_agent(int(number), wide=True).write(Path(folder)))
        else:
            mission, _ = read_mission(ROOT / name / "mission.toml")
            assert mission is not None
            agent = load_models(mission).agent
            programs = programs_of(agent)
        for compiles in (True, False):
            yield Ready(name if compiles else f"{name} general", agent, programs, compiles)


def functions_of_the_engine() -> list[FunctionType]:
    """Those that are loaded."""
    return [
        each
        for each in gc.get_objects()
        if isinstance(each, FunctionType) and each.__code__.co_filename.startswith(_ROOMS)
    ]
