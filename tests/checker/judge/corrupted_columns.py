"""Study of corrupted columns: whether columns say of each what single tokens say.

python -m tests.checker.judge.corrupted_columns [corruptions] [mission.toml ...]
"""

import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import NamedTuple

import pytest

import runtime.build_form
from checker.judge.judge import judge_mission
from checker.judge.report import JudgeReport
from checker.mission import read_mission
from checker.models import load_models
from runtime.determined import reactor
from runtime.determined.expand import _Expansion
from runtime.determined.loading import RegisterProgram
from runtime.determined.machine import Machine
from runtime.determined.tags import KIND, VALUES
from runtime.executive.columns import TokenColumns
from runtime.executive.mission import record_mission
from runtime.executive.outcome import Outcome
from runtime.executive.record import MissionRecord, TokenRecord
from tests.checker.judge.missions import GPS, INL
from tests.checker.judge.test_bulk import one_at_a_time
from tests.programs import programs_of

FILES = (INL, INL.parents[1] / "front/mission.toml", GPS)
UNTIL = 400
_START = 0  # of a row of the log


class Flight(NamedTuple):
    """A mission that was flown, with what the record of its simulator was made of."""

    judge: Callable[[MissionRecord], JudgeReport]
    record: MissionRecord
    simulator: tuple[RegisterProgram, Machine, int]

    def report(self, tokens: TokenColumns | tuple[TokenRecord, ...]) -> JudgeReport:
        """The report if the simulator did what `tokens` say."""
        reactors = [
            each._replace(tokens=tokens) if isinstance(each.tokens, TokenColumns) else each
            for each in self.record.reactors
        ]
        return self.judge(MissionRecord(tuple(reactors)))


def flight(path: Path, seed: int) -> Flight:
    """A short flight of a mission."""
    caught: list[tuple[RegisterProgram, Machine, int]] = []

    def catching(program: RegisterProgram, machine: Machine, tick: int) -> TokenColumns:
        caught.append((program, machine, tick))
        return _Expansion(program, machine, tick).columns()

    mission, _ = read_mission(path)
    assert mission is not None
    agent = load_models(mission).agent
    programs = programs_of(agent)
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(reactor, "expand", catching)
        outcome, record = record_mission(agent, programs, seed, until=UNTIL)

    def judged(record: MissionRecord, outcome: Outcome = outcome) -> JudgeReport:
        return judge_mission(agent, programs.programs, outcome, record, programs.constraints)

    return Flight(judged, record, *caught)


def corrupt(expansion: _Expansion, dice: Random) -> str:
    """Change one number of a record: a value, a time, an end, a child, a merged token or the place of arguments."""
    kind = dice.choice(("value", "value", "value", "start", "end", "child", "merge", "arguments", "truth"))
    rows, walk, count = expansion.rows, expansion.walk, expansion.walk.count
    row = dice.randrange(count)
    match kind:
        case "value" | "truth":
            at = dice.randrange(expansion.machine.log.value_count)
            by = dice.choice((1.0, -2.0, 0.01, 2e-5, 1e-6, float("nan"), 1e17))
            before = expansion.values[at]
            expansion.values[at] = float(before == 0) if kind == "truth" else before + by
        case "start":
            rows[row, _START] += dice.choice((-2, -1, 1, 2))
        case "end":
            walk.ends[row] += dice.choice((-2, -1, 1, 2))
        case "child":
            at = dice.randrange(len(walk.child_keys))
            walk.child_keys[at] = int(expansion.all_keys[dice.randrange(len(expansion.all_keys))])
        case "merge" if len(expansion.merged):
            at = dice.randrange(len(expansion.merged))
            if rows[row, KIND] == rows[expansion.merged[at, 2], KIND]:
                expansion.merged[at, 2] = row
        case _:
            other = dice.randrange(count)
            if rows[row, KIND] == rows[other, KIND]:
                rows[row, VALUES] = rows[other, VALUES]
    return kind


def compare(flown: Flight, dice: Random) -> tuple[str, bool, bool]:
    """Corrupt a record; what was changed, whether columns and single tokens say the same, and whether they object."""
    program, machine, tick = flown.simulator
    log = machine.log
    kept = list(log.values), list(log.rows)
    expansion = _Expansion(program, machine, tick)
    try:
        kind = corrupt(expansion, dice)
        quick = flown.report(expansion.columns())
        with pytest.MonkeyPatch.context() as patched:
            one_at_a_time(patched)
            single = flown.report(tuple(expansion.columns()))
    finally:
        for index, value in enumerate(kept[0]):
            log.values[index] = value
        for index, number in enumerate(kept[1]):
            log.rows[index] = number
    is_same = quick.disagreements == single.disagreements and quick.open == single.open
    return kind, is_same, not quick.holds


def study(count: int, paths: list[Path]) -> int:
    """Corrupt records of missions; how many the judges do not agree on."""
    wrong = 0
    for path in paths:
        seen: Counter[str] = Counter()
        for number in range(count):
            if number % 50 == 0:
                flown = flight(path, number // 50)
            kind, agrees, objects = compare(flown, Random(f"{path.parent.name} {number}"))
            seen[f"{kind} {'noticed' if objects else 'silent'}"] += 1
            if not agrees:
                wrong += 1
                print(path.parent.name, number, kind, "the judges do not agree", flush=True)
        print(path.parent.name, dict(sorted(seen.items())), flush=True)
    return wrong


if __name__ == "__main__":
    sys.exit(study(int(sys.argv[1]) if len(sys.argv) > 1 else 100, [Path(p) for p in sys.argv[2:]] or list(FILES)) > 0)
