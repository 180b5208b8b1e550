"""The five steps from a model to the sea (founding paper, section 3), and the records that each was passed.

A record holds for the models that it was made of: change them, and the steps begin again. Records lie in `process/`
beside the mission file, one JSON line each, to be kept with the models.
"""

import json
from dataclasses import asdict, dataclass
from enum import StrEnum
from pathlib import Path

from nddl_lang.text.values import json_value


class ProcessStep(StrEnum):
    """A step; each needs a record of the one before."""

    DEVELOP = "develop"
    GOLD = "gold"
    RANDOM = "random"
    QSIM = "qsim"
    BENCH = "bench"


STEPS = {
    ProcessStep.DEVELOP: "the models are in order, and a mission on the P-Sim passes",
    ProcessStep.GOLD: "a mission was accepted by hand, and happens as accepted",
    ProcessStep.RANDOM: "random missions fail no more often than is accepted",
    ProcessStep.QSIM: "hand-made missions pass on the physics simulator (Q-Sim)",
    ProcessStep.BENCH: "the mission passes on the vehicle's hardware on the bench (V-Sim)",
}
UNBUILT = {
    ProcessStep.QSIM: "there is no physics simulator yet",
    ProcessStep.BENCH: "there is no bench yet: it needs the vehicle's hardware",
}


@dataclass(frozen=True, slots=True)
class StepRecord:
    """That a step was passed: of which models, by whom, when, and what was seen."""

    step: str
    models: str  # digest
    by: str
    at: str
    seen: str


def records_path(mission: Path) -> Path:
    """Where the records of a mission are."""
    return mission.parent / "process" / f"{mission.stem}.jsonl"


def read_records(path: Path) -> tuple[StepRecord, ...]:
    """All records, in order; raises ValueError where a line is none."""
    if not path.exists():
        return ()
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
        return tuple(StepRecord(**json_value(line)) for line in lines if line.strip())
    except TypeError as problem:
        raise ValueError(str(problem)) from problem


def record_text(records: tuple[StepRecord, ...]) -> str:
    """Records as lines."""
    return "".join(json.dumps(asdict(one), ensure_ascii=False) + "\n" for one in records)


def passed(records: tuple[StepRecord, ...], models: str) -> dict[ProcessStep, StepRecord]:
    """The latest record of each step for these models; a step without the one before counts as not passed."""
    found: dict[ProcessStep, StepRecord] = {}
    for step in ProcessStep:
        own = [one for one in records if one.step == step and one.models == models]
        if not own:
            break
        found[step] = own[-1]
    return found


def missing_before(step: ProcessStep, records: tuple[StepRecord, ...], models: str) -> ProcessStep | None:
    """The first step that must be passed before this one can begin."""
    done = passed(records, models)
    before = list(ProcessStep)[: list(ProcessStep).index(step)]
    return next((one for one in before if one not in done), None)
