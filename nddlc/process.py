"""`nddlc process`: the five steps from a model to the sea, one command each; none begins before the one before it."""

import getpass
import os
from datetime import UTC, datetime
from pathlib import Path

import click

from checker.batch.connection import StoreError
from checker.batch.identity import model_digest
from checker.batch.store import open_store
from checker.campaign import Campaign
from checker.gold import differences, gold_lines, gold_path, read_gold
from checker.mission import Mission
from checker.models import ModelSet
from checker.one_flight import FlightSettings, fly
from checker.oracle import Verdict
from checker.pinned import pinned
from checker.process import (
    STEPS,
    UNBUILT,
    ProcessStep,
    StepRecord,
    missing_before,
    passed,
    read_records,
    record_text,
    records_path,
)
from checker.report.sentences import decision, headline
from nddlc.check import cores
from nddlc.inputs import STORE, Unusable, write_text
from nddlc.one_mission import prepare
from nddlc.trust import trust_option

_PASSED, _FINDINGS = 0, 1


@click.command()
@click.argument("action", type=click.Choice(["status", *(step.value for step in ProcessStep)]))
@click.argument("path", metavar="MISSION")
@click.option("--by", metavar="NAME", help="Who takes the step; by default you.")
@click.option("--workers", type=click.IntRange(1), help="Processes to fly with (random).")
@click.option("--store", "store_path", type=click.Path(path_type=Path), default=STORE, help="Where runs are kept.")
@trust_option
def command(action: str, path: str, by: str | None, workers: int | None, store_path: Path, is_trusted: bool) -> int:
    """Take one of the five steps with a mission, or show which are passed.

    develop, gold, random, qsim, bench: a step begins only where the one before is passed with the same models. Records
    lie in `process/` beside the mission file. Ends with 1 where a step is not passed, with 2 where it cannot begin.
    """
    file, mission, models = prepare(path, is_trusted=is_trusted)
    place, digest = records_path(file), model_digest(models.texts)
    try:
        records = read_records(place)
    except (OSError, ValueError) as problem:
        raise Unusable(f"`{place}` holds no records: {problem}") from None
    if action == "status":
        click.echo(_status(records, digest, file, path), nl=False)
        return _PASSED if len(passed(records, digest)) == len(ProcessStep) - len(UNBUILT) else _FINDINGS
    step = ProcessStep(action)
    lacking = missing_before(step, records, digest)
    if lacking is not None:
        advice = f"`nddlc process {lacking} {path}`"
        raise Unusable(f"step `{step}` cannot begin: `{lacking}` is not passed with these models", advice)
    if step in UNBUILT:
        raise Unusable(f"step `{step}` cannot be taken: {UNBUILT[step]}")
    is_passed, seen = _take(step, file, mission, models, workers or cores(), store_path)
    click.echo(f"{step}: {'passed' if is_passed else 'not passed'}: {seen}")
    if not is_passed:
        return _FINDINGS
    now = datetime.now(UTC).isoformat(timespec="seconds")
    record = StepRecord(step.value, digest, by or _user(), now, seen)
    write_text(place, record_text((*records, record)))
    return _PASSED


def _take(
    step: ProcessStep, file: Path, mission: Mission, models: ModelSet, workers: int, store_path: Path
) -> tuple[bool, str]:
    """Whether a step is passed, and what was seen."""
    if step is ProcessStep.DEVELOP:
        flight = fly(mission, models, FlightSettings(mission.check.seed, {}))
        verdict = flight.judgement.verdict
        return verdict is Verdict.PASS, f"seed {mission.check.seed}: {verdict.value} at tick {flight.outcome.last_tick}"
    if step is ProcessStep.GOLD:
        return _gold(file, mission, models)
    campaign = Campaign(mission, models, pinned(models))
    try:
        with open_store(store_path) as store:
            flown = campaign.fly(workers, store)
    except StoreError as problem:
        raise Unusable(str(problem), problem.advice) from None
    findings = campaign.assess(flown.results, ending=flown.ending, may_fly=False, sampling=flown.sampling)
    is_passed = findings.holds and flown.ended_by is None
    return is_passed, f"{headline(findings)}; {decision(findings)}; run {findings.run_id}"


def _gold(file: Path, mission: Mission, models: ModelSet) -> tuple[bool, str]:
    place = gold_path(file, mission.check.seed)
    try:
        gold = read_gold(place)
    except FileNotFoundError:
        raise Unusable(f"there is no gold standard `{place}`", f"`nddlc gold accept {file}` makes one") from None
    except (OSError, ValueError) as problem:
        raise Unusable(f"`{place}` is no gold standard: {problem}") from None
    flight = fly(mission, models, FlightSettings(gold.seed, gold.values))
    found = differences(gold.lines, gold_lines(flight.outcome))
    if found:
        return False, f"{len(found)} places differ from what {gold.by} accepted; `nddlc gold diff {file}` shows them"
    return True, f"as {gold.by} accepted at {gold.at}"


def _status(records: tuple[StepRecord, ...], digest: str, file: Path, path: str) -> str:
    """A line per step, and the command that takes the next one."""
    done = passed(records, digest)
    lines = [f"{file.name}, models {digest[:12]}"]
    for number, (step, meaning) in enumerate(STEPS.items(), 1):
        record = done.get(step)
        old = [one for one in records if one.step == step and one.models != digest]
        if record is not None:
            state = f"passed by {record.by} at {record.at}: {record.seen}"
        elif step in UNBUILT:
            state = f"not possible: {UNBUILT[step]}"
        elif old:
            state = f"not passed with these models (with earlier ones by {old[-1].by} at {old[-1].at})"
        else:
            state = "not passed"
        lines += [f"{number}. {step.value}: {meaning}", f"   {state}"]
    following = next((step for step in STEPS if step not in done and step not in UNBUILT), None)
    if following is not None:
        lines.append(f"next: `nddlc process {following} {path}`")
    return "\n".join(lines) + "\n"


def _user() -> str:
    try:
        return getpass.getuser()
    except (KeyError, OSError):
        return os.environ.get("USER", "unknown")
