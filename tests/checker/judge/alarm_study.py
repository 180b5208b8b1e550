"""Study of false alarms: right engines fly missions of many models and of mutants; whether the judge ever objects.

make alarm-study, or python -m tests.checker.judge.alarm_study [missions [kind ...]]

The shares are those of `KINDS`. `cases` are the small missions of the executive, by register code and by the general
engine; `models` every other mission of the project in turn; `random` simulators; `agents` random agents of several
reactors; `mutants` small faults in all of these models; `plans` what the solver finds for the classic models and for
random ones. Missions that raise, or take longer than a minute, are counted and not judged.
"""

import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import count, cycle, islice
from pathlib import Path
from tempfile import TemporaryDirectory

from checker.judge.judge import judge_mission, judge_plan
from checker.judge.rendering import disagreement_text
from checker.mission import read_mission
from checker.models import load_models
from checker.pinned import pinned
from checker.sampling.seeds import mission_seed
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.mission import MissionPrograms, record_mission
from runtime.executive.recorder import Recorder
from runtime.plan.database import PlanDatabase
from runtime.solver.search import Solver
from runtime.solver.tags import PLAN
from tests.checker.judge.fault_study import CASES, FRONT
from tests.checker.judge.missions import GPS, INL
from tests.executive.determined_models import random_case
from tests.executive.generated.flights import loaded
from tests.executive.generated.writer import random_agent
from tests.executive.mutants.flights import Limits, SlowError, at_most, files_below, mutant_of
from tests.solver.model_data import random_model, written
from tests.solver.planning import resources_configuration, solver_for

_ROOT = GPS.parents[2]
_OF_EACH_MUTANT = 5
_SECONDS = 60.0
_SEED = 77


@dataclass(frozen=True, slots=True)
class Judged:
    """What was flown, how it ended, and what the judge objects to."""

    name: str
    fate: str  # passed, failed, slow, raised or unplanned
    objections: tuple[str, ...] = ()


Flights = Iterator[Judged]


def _judged(
    name: str, agent: AgentConfiguration, programs: MissionPrograms, seed: int, *, compiles: bool = True
) -> Judged:
    """One mission, flown and judged."""
    try:
        with at_most(_SECONDS):
            outcome, record = record_mission(agent, programs, seed, compiles=compiles)
    except SlowError:
        return Judged(name, "slow")
    except Exception:  # a fault of the executive, or a mutant that cannot be flown: not what is studied here
        return Judged(name, "raised")
    report = judge_mission(agent, programs.programs, outcome, record, programs.constraints)
    fate = "passed" if outcome.abort is None and not outcome.open_goals else "failed"
    return Judged(name, fate, tuple(disagreement_text(one) for one in report.errors))


def _of_file(path: Path) -> tuple[AgentConfiguration, MissionPrograms]:
    mission, _ = read_mission(path)
    assert mission is not None
    models = load_models(mission)
    return models.agent, pinned(models).programs_of(models.agent)


def _file(path: Path) -> Flights:
    """Missions of one file, seed after seed."""
    agent, programs = _of_file(path)
    for number in count():
        yield _judged(f"{path.parent.name} {number}", agent, programs, mission_seed(_SEED, number))


def _cases() -> Flights:
    """The small missions of the executive, each in both ways, seed after seed."""
    for number in count():
        for path in CASES:
            agent, programs = _of_file(path)
            for compiles in (True, False):
                seed = mission_seed(_SEED, number)
                yield _judged(f"{path.parent.name} {number} {compiles}", agent, programs, seed, compiles=compiles)


def _models() -> Flights:
    """Every mission of the project but those with a kind of their own, in turn, by register code and without."""
    own = {GPS, INL, FRONT, *CASES}
    files = sorted({*files_below(""), *(_ROOT / "tests/checker/unseen").glob("*/mission.toml")} - own)
    flown = [(path, *_of_file(path)) for path in files if path.parent != INL.parent]
    for number, (path, agent, programs) in enumerate(cycle(flown)):
        turn = number // len(flown)
        name = f"{path.parent.name}/{path.name} {turn}"
        yield _judged(name, agent, programs, mission_seed(_SEED, turn), compiles=turn % 2 == 0)


def _random() -> Flights:
    """Random simulators, by register code and by the general engine in turn."""
    for number in count():
        agent, programs = random_case(number).agent()
        yield _judged(f"random {number}", agent, programs, number, compiles=number % 2 == 0)


def _agents() -> Flights:
    """Random agents of several reactors, with planners among them."""
    for number in count():
        with TemporaryDirectory() as folder:
            agent, programs = loaded(random_agent(number).write(Path(folder)))
            yield _judged(f"agent {number}", agent, programs, 1, compiles=number % 2 == 0)


def _mutants() -> Flights:
    """Mutants of all models, at places that chance draws; what fails is judged as well."""
    files = [path for path in files_below("") if path.parent not in (INL.parent, FRONT.parent)]
    for number in count():
        name, mutant = mutant_of(number, files, Limits())
        if mutant is not None:
            for seed in range(_OF_EACH_MUTANT):
                yield _judged(f"{name} {seed}", mutant.agent, mutant.programs, seed, compiles=seed % 2 == 0)


def _plans() -> Flights:
    """What the solver finds: for the classic models, then for random ones."""
    with TemporaryDirectory() as folder:
        for path in sorted((_ROOT / "models/classic").glob("*.nddl")):
            solver = solver_for(Path(folder), path.read_text(), horizon=(0, 1000), how=resources_configuration())
            yield _planned(path.name, solver)
        for number in count():
            solver = solver_for(Path(folder), written(random_model(number)))
            yield _planned(f"plan {number}", solver)


def _planned(name: str, solver: Solver) -> Judged:
    database: PlanDatabase = solver.database
    if solver.solve(20000, 2**60) != PLAN:
        return Judged(name, "unplanned")
    report, _ = judge_plan(database.program, Recorder(database, name).close())
    return Judged(name, "passed", tuple(disagreement_text(one) for one in report.disagreements))


KINDS: dict[str, tuple[int, Callable[[], Flights]]] = {  # of how many missions in 10,000
    "cases": (600, _cases),
    "gps": (1500, lambda: _file(GPS)),
    "models": (1200, _models),
    "random": (3000, _random),
    "agents": (1000, _agents),
    "mutants": (2000, _mutants),
    "plans": (660, _plans),
    "front": (20, lambda: _file(FRONT)),
    "inl": (20, lambda: _file(INL)),
}


def study(missions: int, kinds: list[str]) -> int:
    """Fly each kind's share; how many missions the judge objects to, which it should to none."""
    total: Counter[str] = Counter()
    for kind in kinds:
        share, flights = KINDS[kind]
        seen: Counter[str] = Counter()
        begun = time.process_time()
        for one in islice(flights(), max(1, share * missions // 10_000)):
            seen[one.fate] += 1
            seen["judged"] += one.fate in ("passed", "failed")
            seen["alarms"] += bool(one.objections)
            if one.objections or one.fate == "raised":
                print(one.name, one.fate, *one.objections[:1], sep=": ", flush=True)
        print(kind, dict(seen), f"{time.process_time() - begun:.0f} s", flush=True)
        total += seen
    print("all", dict(total), f"alarms {total['alarms']} of {total['judged']}")
    return total["alarms"]


if __name__ == "__main__":
    sys.exit(study(int(sys.argv[1]) if len(sys.argv) > 1 else 10_000, sys.argv[2:] or list(KINDS)) > 0)
