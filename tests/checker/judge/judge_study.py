"""Study of the judge's reach: faults in the source of engine and executive, flown, put to the judge and to an oracle.

make judge-study, or NDDLC_INTERPRETED=1 python -m tests.checker.judge.judge_study [faults [first [mission ...]]]

Each fault is one changed node of the syntax tree of a line that the mission runs. It is flown in a process of its own,
by register code or by the general engine, within limits of time and memory; record and trace are judged here, where
nothing is broken. Whether a record breaks the model the plain oracle says, which shares nothing with the judge.
"""

import os
import pickle
import resource
import signal
import sys
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from random import Random
from types import FrameType
from typing import Any

import runtime.build_form
from checker.judge.judge import judge_mission
from checker.judge.rendering import disagreement_text
from checker.mission import read_mission
from checker.models import load_models
from checker.statistics import exact_interval
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.mission import MissionPrograms, record_mission
from runtime.executive.outcome import Outcome
from runtime.executive.record import MissionRecord
from tests.checker.judge.fault_study import CASES, history, is_alike
from tests.checker.judge.missions import GPS
from tests.checker.judge.plain_mission import objections
from tests.checker.judge.source_faults import FaultySource, SourceFault
from tests.executive.determined_models import random_case
from tests.executive.flying import Flown
from tests.programs import programs_of

_SECONDS, _MEMORY = 20, 4 * 2**30
_ROOT = GPS.parents[2]
_ROOMS = tuple(str(_ROOT / "runtime" / room) for room in ("constraints", "plan", "executive", "determined"))
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
)


@dataclass(frozen=True, slots=True)
class Ready:
    """A mission that is loaded, and was never flown here."""

    agent: AgentConfiguration
    programs: MissionPrograms
    seed: int
    compiles: bool

    def fly(self) -> tuple[Outcome, MissionRecord]:
        """Fly it, and leave all that it was as plain values."""
        outcome, record = record_mission(self.agent, self.programs, self.seed, compiles=self.compiles)
        reactors = tuple(one._replace(tokens=tuple(one.tokens)) for one in record.reactors)
        return replace(outcome, events=tuple(outcome.events)), MissionRecord(reactors)

    def flown(self, result: tuple[Outcome, MissionRecord]) -> Flown:
        """A flight with what the judge says of it."""
        outcome, record = result
        report = judge_mission(self.agent, self.programs.programs, outcome, record, self.programs.constraints)
        return Flown(self.agent, self.programs.programs, outcome, record, report)


def apart(work: Callable[[], Any]) -> Any:
    """What comes of some work in a process of its own; None where it raises, hangs or takes too much."""
    ours, theirs = os.pipe()
    child = os.fork()
    if child == 0:
        status = 1
        try:
            os.close(ours)
            resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
            resource.setrlimit(resource.RLIMIT_CPU, (_SECONDS, _SECONDS))
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
    """The lines of the engine that a mission runs."""
    found: dict[str, set[int]] = {}

    def at_call(frame: FrameType, _event: str, _argument: object) -> Any:
        file = frame.f_code.co_filename
        if not file.startswith(_ROOMS) or any(part in file for part in _TELLING):
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


class _Stand:
    """A mission with the lines that it runs and its right flight."""

    def __init__(self, mission: Ready) -> None:
        self.mission = mission
        self.lines: dict[str, set[int]] = apart(lambda: _lines_of(mission))
        assert self.lines, "its lines were not found in time"
        self.right = mission.flown(apart(mission.fly))
        assert self.right.report.holds, "a right mission was objected to"
        assert not self.objections(self.right), "the oracle objects to a right mission"

    def objections(self, flown: Flown) -> list[str]:
        """What the oracle objects to."""
        return objections(flown.agent, flown.programs, flown.outcome, flown.record)


def _missions(names: Iterable[str]) -> dict[str, Ready]:
    """Missions by name: files, random simulators `random N`; with `general` behind it by the general engine."""
    found = {}
    for name in names:
        if name.startswith("random"):
            agent, programs = random_case(int(name.split()[1])).agent()
        else:
            mission, _ = read_mission(_ROOT / name / "mission.toml")
            assert mission is not None
            agent = load_models(mission).agent
            programs = programs_of(agent)
        for compiles in (True, False):
            found[name if compiles else f"{name} general"] = Ready(agent, programs, 1, compiles)
    return found


NAMES = (
    "models/gps",
    *(f"models/templates/{name}" for name in ("battery", "noise", "rover", "survey", "retry")),
    "tests/checker/unseen/quay",
    "tests/checker/unseen/kiln",
    *(f"random {number}" for number in (2, 3, 6, 12, 14, 15, 19, 23)),
    *(str(path.parent.relative_to(_ROOT)) for path in CASES[::40]),
)


def _report(seen: Counter[str]) -> None:
    broke = seen["noticed"] + seen["MISSED"]
    print(dict(sorted(seen.items())))
    if broke:
        low, high = exact_interval(seen["noticed"], broke, 0.95)
        rate = seen["noticed"] / broke
        print(f"of {broke} records that break the model {seen['noticed']} noticed: {rate:.3f} [{low:.3f} {high:.3f}]")


def study(count: int, first: int, names: list[str]) -> int:
    """Fly so many faults; how many records break the model and are not noticed."""
    ready = _missions(names)
    stands: dict[str, _Stand] = {}
    seen: Counter[str] = Counter()
    for number in range(first, first + count):
        dice = Random(number)
        name = dice.choice(sorted(ready))
        if name not in stands:
            stands[name] = _Stand(ready[name])
        stand = stands[name]
        file = dice.choice(sorted(stand.lines))
        source = FaultySource(file, stand.lines[file])
        fault = source.fault(dice) if source.places else None
        if fault is None:
            seen["no fault"] += 1
            continue

        def work(fault: SourceFault = fault, stand: _Stand = stand) -> tuple[Outcome, MissionRecord]:
            fault.put_in_place()
            return stand.mission.fly()

        result = apart(work)
        fate, said = ("raised, or without an end", "") if result is None else _fate(stand, result)
        seen[fate] += 1
        seen["records changed"] += fate in ("noticed", "MISSED", "another right mission", "only the judge objects")
        where = f"{Path(file).relative_to(_ROOT)}:{fault.line} {fault.function}, {fault.kind}"
        print(number, name, where, fate, said, sep="; ", flush=True)
    _report(seen)
    return seen["MISSED"]


def _fate(stand: _Stand, result: tuple[Outcome, MissionRecord]) -> tuple[str, str]:
    """What judge and oracle say of a record."""
    try:
        flown = stand.mission.flown(result)
        found = stand.objections(flown)
    except (TypeError, KeyError, ValueError, AssertionError, IndexError) as problem:
        return "no record", repr(problem)
    said = [disagreement_text(one).splitlines()[0] for one in flown.report.disagreements]
    if found:
        return ("noticed", said[0]) if said else ("MISSED", found[0])
    if said:
        return "only the judge objects", said[0]
    abort, right = flown.outcome.abort, stand.right.outcome.abort
    is_same = is_alike(flown, stand.right) and (abort and abort.code) == (right and right.code)
    return ("alike" if is_same else "another right mission"), f"{len(history(flown))} tokens"


if __name__ == "__main__":
    assert runtime.build_form.build_form() != "compiled", "functions of the compiled engine cannot be replaced"
    _COUNT = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    _FIRST = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    sys.exit(study(_COUNT, _FIRST, sys.argv[3:] or list(NAMES)) > 0)
