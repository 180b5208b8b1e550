"""Fly mutants of missions and print one line for each flight: run it as a module, in either form of the engine.

Each flight is judged; with the engine compiled, determined reactors are flown by the general engine too. What must not
be is said in a line that begins with `WRONG`.
"""

import random
import shutil
import signal
import sys
import tempfile
from argparse import ArgumentParser
from collections.abc import Iterator
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path
from types import FrameType

from runtime.build_form import interpreting_is_asked
from checker.judge.judge import judge_mission
from checker.judge.rendering import disagreement_text
from checker.mission import read_mission
from checker.models import load_models
from checker.mutation.edits import EditKind, SmallEdit, edited, sites_of
from checker.mutation.variant import load_graph
from checker.pinned import programs_of
from nddl_lang.text.read import real_path
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.mission import MissionPrograms, record_mission, run_mission
from runtime.executive.rendering import trace_json
from tests.executive.determined_models import told

ROOT = Path(__file__).parents[3]
FILES = sorted(
    [
        *(ROOT / "tests" / "executive").rglob("mission.toml"),
        *(ROOT / "models").rglob("m*.toml"),
    ]
)

TRIALS = 6  # until a mutant is a model


class SlowError(Exception):
    """A flight takes too long: what the model now asks for is hard to find."""


@contextmanager
def at_most(seconds: int) -> Iterator[None]:
    """Raise `SlowError` in what takes longer."""

    def ring(number: int, frame: FrameType | None) -> None:
        raise SlowError

    before = signal.signal(signal.SIGALRM, ring)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def edit_of(model: Path, chance: random.Random) -> SmallEdit | None:
    """One small fault of a text, of a kind and at a place that chance draws; None where there is nothing to change."""
    file = str(real_path(model))
    kinds: dict[EditKind, list[SmallEdit]] = {}
    for site in sites_of(load_graph(model, ())):
        for edit in site.edits if site.file == file else ():
            kinds.setdefault(edit.kind, []).append(edit)
    return chance.choice(kinds[chance.choice(list(kinds))]) if kinds else None


def lines_of(number: int, missions: int, seconds: int) -> Iterator[str]:
    """What mutant `number` does in a number of missions."""
    chance = random.Random(number)
    file = FILES[chance.randrange(len(FILES))]
    with tempfile.TemporaryDirectory() as scratch:
        place = Path(scratch) / "mission"
        shutil.copytree(file.parent, place)
        mission, _ = read_mission(place / file.name)
        assert mission is not None
        models = sorted(place.glob("*.nddl"))
        kind, read = "", load_models(mission)
        for _ in range(TRIALS):
            model = models[chance.randrange(len(models))]
            whole = model.read_text()
            edit = edit_of(model, chance)
            if edit is None:
                continue
            kind = edit.kind.value
            model.write_text(edited(whole, edit))
            read = load_models(mission)
            if not read.has_errors:
                break
            model.write_text(whole)
        name = f"{number} {file.parent.name} {kind.replace(' ', '_') or 'none'}"
        if read.has_errors:
            yield f"{name} invalid"
            return
        programs = programs_of(read.agent)
        for seed in range(missions):
            try:
                with at_most(seconds):
                    yield from _flight(f"{name} {seed}", read.agent, programs, seed, str(place))
            except SlowError:
                yield f"{name} {seed} slow"
                return
            except Exception as problem:
                said = " ".join(str(problem).replace(str(place), "").split())
                yield f"WRONG {name} {seed} error {type(problem).__name__}: {said}"
                return


def _flight(name: str, agent: AgentConfiguration, programs: MissionPrograms, seed: int, place: str) -> Iterator[str]:
    outcome, record = record_mission(agent, programs, seed)
    report = judge_mission(agent, programs.programs, outcome, record, programs.constraints)
    trace = "\n".join(map(trace_json, outcome.events)).replace(place, "")
    code = outcome.abort.code if outcome.abort is not None else "F10" if outcome.open_goals else "ended"
    yield f"{name} {code} {outcome.last_tick} {sha256(trace.encode()).hexdigest()[:16]}"
    for disagreement in report.disagreements:
        yield f"WRONG {name} judge: {' '.join(disagreement_text(disagreement).split())}".replace(place, "")
    if not interpreting_is_asked() and told(run_mission(agent, programs, seed, compiles=False)) != told(outcome):
        yield f"WRONG {name} the determined form tells something else than the general engine"


def main() -> None:
    """Fly mutants FIRST to LAST - 1."""
    parser = ArgumentParser()
    parser.add_argument("first", type=int)
    parser.add_argument("last", type=int)
    parser.add_argument("--missions", type=int, default=20)
    parser.add_argument("--seconds", type=int, default=60)
    given = parser.parse_args()
    for number in range(given.first, given.last):
        for line in lines_of(number, given.missions, given.seconds):
            print(line)
            sys.stdout.flush()


if __name__ == "__main__":
    main()
