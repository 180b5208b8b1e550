"""Fly mutants of missions and print one line for each flight: run it as a module, in either form of the engine.

Each flight is judged. With the engine compiled, determined reactors are flown by the general engine too, and all
missions once more by two other processes, each its share from the last to the first, as two workers of a batch may.
What must not be is said in a line that begins with `WRONG`.
"""

import random
import signal
import sys
import time
from argparse import ArgumentParser
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from hashlib import sha256
from multiprocessing import get_context
from pathlib import Path
from types import FrameType

import numpy as np

from runtime.build_form import interpreting_is_asked
from checker.counterfactual.search import sites_in
from checker.judge.judge import judge_mission
from checker.judge.rendering import disagreement_text
from checker.mission import read_mission
from checker.models import load_models
from checker.mutation.edits import EditSite, SmallEdit
from checker.mutation.kinds import REPAIRS, EditKind
from checker.mutation.variant import open_over, with_edit
from checker.pinned import pinned
from runtime.determined.told import StoredObservations
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.event_parts import EventColumns
from runtime.executive.events import EventLog
from runtime.executive.mission import (
    MissionPrograms,
    UnusableModelError,
    record_mission,
    register_program,
    run_mission,
)
from runtime.executive.outcome import Event, Outcome
from runtime.executive.rendering import trace_json
from tests.executive.determined_models import told

ROOT = Path(__file__).parents[3]
FILES = sorted(
    [
        *(ROOT / "tests" / "executive").rglob("mission.toml"),
        *(ROOT / "models").rglob("m*.toml"),
    ]
)

MORE = sorted((ROOT / "tests" / "checker" / "unseen").rglob("mission.toml"))  # of which mutants are explained, too

CASES = ROOT / "tests" / "executive" / "cases"  # 20 times as many as all other missions, and small

TRIALS = 20  # until a mutant is a model
SHARES = 2
NOT_FLOWN = SLOW, INVALID, LEFT_OUT = "slow", "invalid", "left_out"
WITHOUT_CHANCE = 3  # missions of a mutant that samples nothing: all are alike


class SlowError(Exception):
    """A flight takes too long: what the model now asks for is hard to find."""


@contextmanager
def at_most(seconds: float) -> Iterator[None]:
    """Raise `SlowError` in what takes more of the processor's time: the alarm of real time watches a modeler's code."""

    def ring(number: int, frame: FrameType | None) -> None:
        raise SlowError

    before = signal.signal(signal.SIGPROF, ring)
    signal.setitimer(signal.ITIMER_PROF, max(seconds, 0.001))
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def edit_of(sites: Sequence[EditSite], chance: random.Random) -> SmallEdit | None:
    """One small fault of a kind and at a place that chance draws; None where there is nothing to change."""
    kinds: dict[EditKind, list[SmallEdit]] = {}
    for site in sites:
        for edit in site.edits:
            if edit.kind not in REPAIRS:
                kinds.setdefault(edit.kind, []).append(edit)
    return chance.choice(kinds[chance.choice(list(kinds))]) if kinds else None


@dataclass(frozen=True, slots=True)
class Limits:
    """What a mutant's missions may take: seconds of one flight and of all, and the tick at which they are ended.

    Seconds are those of the processor.
    """

    seconds: float = 60.0
    whole: float = 600.0
    until: int | None = None
    general: int = sys.maxsize  # the missions of a mutant that the general engine flies too; interpreted, judged
    general_until: int | None = None  # the tick at which the general engine's are ended, at most
    ticks: range = range(sys.maxsize)  # the final ticks of missions of which mutants are flown


@dataclass(frozen=True, slots=True)
class Mutant:
    """A mission with a fault in one of its models."""

    name: str
    agent: AgentConfiguration
    programs: MissionPrograms
    limits: Limits
    is_determined: bool  # some reactor is, and is flown as register code

    def told(self, seed: int, outcome: Outcome) -> str:
        """How a mission ended, and the digest of its trace; the first one's is that of the text."""
        lines = map(trace_json, outcome.events) if seed == 0 else parts_of(outcome.events)
        trace = "\n".join(lines).replace(str(ROOT), "")
        code = outcome.abort.code if outcome.abort is not None else "F10" if outcome.open_goals else "ended"
        return f"{code} {outcome.last_tick} {sha256(trace.encode()).hexdigest()[:16]}"

    def general_until(self) -> int | None:
        """The tick at which the general engine's missions are ended."""
        ends = [one for one in (self.limits.until, self.limits.general_until) if one is not None]
        return min(ends, default=None)

    def lines(self, seed: int) -> Iterator[str]:
        """One flight, and what is wrong about it."""
        outcome, record = record_mission(self.agent, self.programs, seed, until=self.limits.until)
        yield f"{self.name} {seed} {self.told(seed, outcome)}"
        if seed < self.limits.general or not interpreting_is_asked():
            report = judge_mission(self.agent, self.programs.programs, outcome, record, self.programs.constraints)
            for one in report.disagreements:
                said = " ".join(disagreement_text(one).split()).replace(str(ROOT), "")
                yield f"WRONG {self.name} {seed} judge: {said}"
        if self.is_determined and seed < self.limits.general and not interpreting_is_asked():
            until = self.general_until()
            general = run_mission(self.agent, self.programs, seed, until=until, compiles=False)
            if until != self.limits.until:
                outcome = run_mission(self.agent, self.programs, seed, until=until)
            if told(general) != told(outcome):
                yield f"WRONG {self.name} {seed} the determined form tells something else than the general engine"

    def share(self, seeds: Sequence[int]) -> list[str]:
        """What these missions come to, flown from the last to the first."""
        found = []
        for seed in reversed(seeds):
            try:
                with at_most(self.limits.seconds):
                    outcome, _ = record_mission(self.agent, self.programs, seed, until=self.limits.until)
                    found.append(f"{self.name} {seed} {self.told(seed, outcome)}")
            except SlowError:
                continue
            except Exception as problem:
                found.append(f"{self.name} {seed} error {type(problem).__name__}")
        return found


def parts_of(events: Sequence[Event]) -> Iterator[str]:
    """All that a trace is made of; runs of observations by their columns, at a tenth of the cost of their text."""
    numbers: dict[int, int] = {}
    for part in events.parts if isinstance(events, EventLog) else events:
        if isinstance(part, Event):
            yield trace_json(part)
            continue
        if id(part.columns) not in numbers:
            numbers[id(part.columns)] = len(numbers)
            yield from columns_of(part.columns.stored())
        yield f"{numbers[id(part.columns)]} {part.first} {part.count}"


def columns_of(columns: EventColumns) -> Iterator[str]:
    """All that the lines of a simulator's observations are made of."""
    assert isinstance(columns, StoredObservations)
    yield f"{columns.name} {columns.symbols}"
    for kind in columns.kinds:
        yield f"{kind.timeline} {kind.predicate} {kind.full_name} {kind.shapes}"
        yield from (
            np.asarray(one, np.int64).tobytes().hex() for one in (kind.indices, kind.ticks, kind.rows, kind.causes)
        )
        yield np.asarray(kind.values, np.float64).tobytes().hex()


def mutant_of(number: int, files: Sequence[Path], limits: Limits) -> tuple[str, Mutant | None]:
    """The name of mutant `number`, and the mutant itself, unless nothing that was tried is a model or it is left out.

    Where there are cases and other missions, every second number is of those others.
    """
    chance = random.Random(number)
    kinds = [[one for one in files if (CASES in one.parents) is is_case] for is_case in (True, False)]
    file = chance.choice(kinds[number % 2] or kinds[1 - number % 2])
    mission, _ = read_mission(file)
    assert mission is not None
    place = str(file.parent.relative_to(ROOT)).replace(" ", "_")
    if mission.agent.final_tick not in limits.ticks:
        return f"{number} {place} {LEFT_OUT}", None
    sites = sites_in(mission.agent)
    for _ in range(TRIALS):
        edit = edit_of(sites, chance)
        if edit is None:
            break
        models = load_models(mission, open_over(with_edit((), edit)))
        if not models.has_errors:
            at = f"{Path(edit.file).name}:{edit.line}"
            name = f"{number} {place} {edit.kind.value.replace(' ', '_')}@{at}"
            programs = pinned(models).programs_of(models.agent)
            return name, Mutant(name, models.agent, programs, limits, _is_determined(models.agent, programs))
    return f"{number} {place} {INVALID}", None


def _is_determined(agent: AgentConfiguration, programs: MissionPrograms) -> bool:
    """Whether any reactor is; one whose script needs what is drawn is asked in flight."""
    try:
        return any(register_program(agent, programs, each) is not None for each in range(len(agent.reactors)))
    except UnusableModelError:
        return True


def lines_of(number: int, missions: int, files: Sequence[Path], limits: Limits) -> Iterator[str]:
    """What mutant `number` does in a number of missions, within a time for each of them and for all."""
    name, mutant = mutant_of(number, files, limits)
    if mutant is None:
        yield name
        return
    if not mutant.agent.parameters and not mutant.agent.coded:
        missions = min(missions, WITHOUT_CHANCE)
    end = time.process_time() + limits.whole
    carried_out: dict[int, str] = {}
    for seed in range(missions):
        lines: list[str] = []
        try:
            with at_most(min(limits.seconds, end - time.process_time())):
                lines.extend(mutant.lines(seed))
        except SlowError:
            yield f"{name} {seed} {SLOW}"
            break
        except Exception as problem:
            said = " ".join(str(problem).replace(str(ROOT), "").split())
            yield f"WRONG {name} {seed} error {type(problem).__name__}: {said}"
            break
        yield from lines
        carried_out[seed] = lines[0]
    if not interpreting_is_asked():
        yield from _shares_that_differ(mutant, carried_out)


def _shares_that_differ(mutant: Mutant, carried_out: dict[int, str]) -> Iterator[str]:
    """What comes of a mission otherwise when another process flies it, after others."""
    context = get_context("fork")
    for share in range(SHARES):
        ours, theirs = context.Pipe()
        seeds = list(carried_out)[share::SHARES]
        process = context.Process(target=_fly_share, args=(mutant, seeds, theirs))
        process.start()
        theirs.close()  # so that the end of the process is seen
        for line in ours.recv():
            if line != carried_out[int(line.split()[3])]:
                yield f"WRONG another worker flies otherwise: {line} instead of {carried_out[int(line.split()[3])]}"
        process.join()


def _fly_share(mutant: Mutant, seeds: Sequence[int], to) -> None:  # type: ignore[no-untyped-def]
    to.send(mutant.share(seeds))


def main() -> None:
    """Fly mutants, each in as many missions as is said."""
    parser = ArgumentParser()
    parser.add_argument("mutants", nargs="+", metavar="NUMBER:MISSIONS")
    parser.add_argument("--seconds", type=float, default=60.0, help="for one flight")
    parser.add_argument("--whole", type=float, default=600.0, help="seconds for all flights of a mutant")
    parser.add_argument("--until", type=int, help="the tick at which missions are ended")
    parser.add_argument("--general", type=int, default=sys.maxsize, help="missions that the general engine flies too")
    parser.add_argument("--general-until", type=int, help="the tick at which the general engine's are ended")
    parser.add_argument("--ticks", type=int, nargs=2, default=(0, sys.maxsize), help="final ticks, from and to before")
    parser.add_argument("--only", default="", help="what the paths of mission files begin with")
    given = parser.parse_args()
    files = files_below(given.only)
    if not files:
        parser.error(f"no mission file of the project begins with `{given.only}`")
    limits = Limits(given.seconds, given.whole, given.until, given.general, given.general_until, range(*given.ticks))
    for each in given.mutants:
        number, missions = map(int, each.split(":"))
        for line in lines_of(number, missions, files, limits):
            print(line)
            sys.stdout.flush()


def files_below(start: str) -> list[Path]:
    """The mission files whose path in the project begins with `start`; all but `MORE` where that is empty."""
    return [file for file in (FILES + MORE if start else FILES) if str(file.relative_to(ROOT)).startswith(start)]


if __name__ == "__main__":
    main()
