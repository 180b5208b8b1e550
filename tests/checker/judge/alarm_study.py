"""Study of false alarms: right engines fly missions of many models and of mutants; whether the judge ever objects.

python -m tests.checker.judge.alarm_study [missions] [kind ...]     kinds: gps, random, cases, mutants, front, inl
"""

import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from itertools import islice
from pathlib import Path

from checker.batch.worker import Fly
from checker.judge.judge import judge_mission
from checker.judge.rendering import DisagreementError, disagreement_text
from checker.mission import read_mission
from checker.models import ModelSet, load_models
from checker.mutation.choice import mutants_of
from checker.mutation.edits import sites_of
from checker.mutation.variant import load_graph, load_over, with_edit
from checker.pinned import pinned
from checker.sampling.seeds import mission_seed
from runtime.executive.mission import record_mission
from tests.checker.judge.fault_study import CASES, FRONT
from tests.checker.judge.missions import GPS, INL
from tests.executive.determined_models import random_case

_OF_EACH_MUTANT = 5
_SEED = 77
Flights = Iterator[tuple[str, bool, list[str]]]  # what was flown, whether it passed, what the judge objects to


def _models(path: Path) -> ModelSet:
    mission, _ = read_mission(path)
    assert mission is not None
    return load_models(mission)


def _fly(path: Path) -> Fly:
    models = _models(path)
    return pinned(models)(models.agent)


def _flown(what: str, fly: Fly, seed: int) -> tuple[str, bool, list[str]]:
    try:
        outcome = fly(seed)
    except DisagreementError as problem:
        return what, False, [disagreement_text(one) for one in problem.report.errors]
    return what, outcome.abort is None and not outcome.open_goals, []


def _file(path: Path) -> Flights:
    """Missions of one file, seed after seed."""
    fly, number = _fly(path), 0
    while True:
        yield _flown(f"{path.parent.name} {number}", fly, mission_seed(_SEED, number))
        number += 1


def _cases() -> Flights:
    """The small missions of the executive, each once."""
    for path in CASES:
        yield _flown(path.parent.name, _fly(path), 1)


def _random() -> Flights:
    """Random simulators, by register code and by the general engine in turn."""
    number = 0
    while True:
        agent, programs = random_case(number).agent()
        try:
            outcome, record = record_mission(agent, programs, number, compiles=number % 2 == 0)
        except Exception as problem:  # a fault of the executive, which it tells itself
            print(f"random {number} raised: {problem}", flush=True)
        else:
            report = judge_mission(agent, programs.programs, outcome, record)
            yield f"random {number}", outcome.abort is None, [disagreement_text(one) for one in report.errors]
        number += 1


def _mutants() -> Flights:
    """Mutants of the navigator and the simulator of the GPS mission; what fails is judged as well."""
    agent = _models(GPS).agent
    for reactor in agent.reactors:
        graph = load_graph(Path(agent.root) / reactor.model, ())
        for mutant in mutants_of(sites_of(graph), _SEED):
            try:
                fly = load_over(with_edit((), mutant.edit), agent)
            except ValueError:
                continue
            for number in range(_OF_EACH_MUTANT):
                try:
                    yield _flown(f"{reactor.name} {mutant.edit}", fly, mission_seed(_SEED, number))
                except Exception as problem:  # a mutant that no engine can load or fly
                    yield f"{reactor.name} {type(problem).__name__}", False, []
                    break


KINDS: dict[str, Callable[[], Flights]] = {
    "cases": _cases,
    "gps": lambda: _file(GPS),
    "random": _random,
    "mutants": _mutants,
    "front": lambda: _file(FRONT),
    "inl": lambda: _file(INL),
}


def study(count: int, kinds: list[str]) -> int:
    """Fly `count` missions of each kind; how many of them the judge objects to, which it should to none."""
    alarms = 0
    for kind in kinds:
        seen: Counter[str] = Counter()
        begun = time.monotonic()
        for what, passed, found in islice(KINDS[kind](), count):
            seen["flown"] += 1
            seen["passed"] += passed
            if found:
                seen["alarms"] += 1
                print(what, found[0], sep=": ", flush=True)
        alarms += seen["alarms"]
        print(kind, dict(seen), f"{time.monotonic() - begun:.0f} s", flush=True)
    return alarms


if __name__ == "__main__":
    sys.exit(study(int(sys.argv[1]) if len(sys.argv) > 1 else 100, sys.argv[2:] or list(KINDS)) > 0)
