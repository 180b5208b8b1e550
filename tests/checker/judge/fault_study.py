"""Study of the judge's reach: engines broken on purpose fly missions of many models; what the judge says of each.

NDDLC_INTERPRETED=1 python -m tests.checker.judge.fault_study [rounds] [mission ...]
"""

import sys
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from random import Random

import runtime.build_form
from checker.judge.judge import judge_mission
from checker.judge.rendering import disagreement_text
from checker.judge.values import may_be_equal
from checker.mission import read_mission
from checker.models import load_models
from runtime.executive.mission import record_mission
from runtime.executive.outcome import EventKind
from tests.checker.judge.faults import EndlessError, Fault, broken, faults
from tests.checker.judge.missions import GPS, INL, cooking, walking
from tests.executive.flying import Flown
from tests.programs import programs_of

FRONT = INL.parents[1] / "front/mission.toml"
CASES = sorted((Path(__file__).resolve().parents[2] / "executive/cases").glob("*/mission.toml"))
Fly = Callable[[], Flown]


@dataclass(frozen=True, slots=True)
class Broken:
    """What became of a mission under a fault: raised, noticed, ended (an abort), repaired, alike or silent."""

    mission: str
    fault: Fault
    fate: str
    said: str  # by the judge, or by the engine that raised
    flown: Flown | None = None


def history(mission: Flown) -> list[tuple[object, ...]]:
    """What was executed on each timeline, whatever number a token has."""
    return [
        (record.reactor, one.object, one.start, one.end, one.predicate, *one.arguments)
        for record in mission.record.reactors
        for one in sorted(record.tokens, key=lambda one: (str(one.object), str(one.start), one.key))
        if one.state == "active" and isinstance(one.end, int) and one.end <= record.last_tick
    ]


def is_alike(mission: Flown, right: Flown) -> bool:
    """Whether two missions executed the same, reals within the tolerance."""
    ours, theirs = history(mission), history(right)
    return len(ours) == len(theirs) and all(
        len(one) == len(other) and all(may_be_equal(a, b) for a, b in zip(one, other, strict=True))  # type: ignore[arg-type]
        for one, other in zip(ours, theirs, strict=True)
    )


def broken_flights(name: str, fly: Fly, rounds: range, spans: int, seconds: float) -> Iterator[Broken]:
    """Fly a mission under every kind of fault, each round at other places of the model."""
    right = fly()
    for number in rounds:
        for fault in faults(Random(f"{name} {number}"), spans):
            try:
                with broken(fault, seconds):
                    mission = fly()
            except (Exception, EndlessError) as problem:
                yield Broken(name, fault, "raised", f"{type(problem).__name__}: {problem}")
                continue
            yield Broken(name, fault, *_fate(mission, right), mission)


def _fate(mission: Flown, right: Flown) -> tuple[str, str]:
    if not mission.report.holds:
        return "noticed", disagreement_text(mission.report.disagreements[0])
    if mission.outcome.abort is not None:
        return "ended", mission.outcome.abort.code
    if is_alike(mission, right):
        return "alike", ""
    if any(event.kind is EventKind.RELAX for event in mission.outcome.events):
        return "repaired", ""
    return "silent", ""


def file_mission(path: Path, seed: int = 1, until: int | None = None) -> Fly:
    """A mission file, flown by the general engine alone."""
    mission, _ = read_mission(path)
    assert mission is not None
    agent = load_models(mission).agent
    programs = programs_of(agent)

    def fly() -> Flown:
        outcome, record = record_mission(agent, programs, seed, None, False, until, False)
        report = judge_mission(agent, programs.programs, outcome, record, programs.constraints)
        return Flown(agent, programs.programs, outcome, record, report)

    return fly


MISSIONS: dict[str, tuple[Callable[[], Fly], int, float]] = {  # how to load it, pieces of text, seconds
    "walking": (lambda: lambda: walking(1, until=24, compiles=False), 48, 3.0),
    "cooking": (lambda: lambda: cooking(1), 120, 6.0),
    "gps": (lambda: file_mission(GPS), 120, 6.0),
    "inl": (lambda: file_mission(INL, until=60), 300, 20.0),
    "front": (lambda: file_mission(FRONT, until=60), 300, 20.0),
} | {path.parent.name: (lambda path=path: file_mission(path), 60, 3.0) for path in CASES}


def study(names: list[str], rounds: range) -> Counter[str]:
    """Fly all; print what was silent, and the count of every fate."""
    seen: Counter[str] = Counter()
    for name in names:
        load, spans, seconds = MISSIONS[name]
        part: Counter[str] = Counter()
        for one in broken_flights(name, load(), rounds, spans, seconds):
            part[one.fate] += 1
            if one.fate in ("silent", "repaired"):
                print(f"{one.fate}: {name}: {one.fault.kind}, {one.fault.name}", flush=True)
        print(name, dict(part), flush=True)
        seen += part
    return seen


if __name__ == "__main__":
    print(dict(study(sys.argv[2:] or list(MISSIONS), range(int(sys.argv[1]) if len(sys.argv) > 1 else 1))))
