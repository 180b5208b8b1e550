"""`nddlc explain`: why one mission of a run failed, from the value that was drawn to the line that gave way."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from checker.batch.result import MissionResult
from checker.batch.store import LATEST, Run, RunStore, StoreError, open_store
from checker.batch.worker import fly_one
from checker.campaign import Campaign
from checker.contrast_rendering import contrast_data, contrast_lines
from checker.excerpts import Excerpts
from checker.explain import result_data, result_text, story_data, story_text
from checker.findings import Fault, Findings
from checker.flight import load
from checker.mission import read_mission
from checker.models import ModelSet
from checker.oracle import Verdict
from nddlc.check import STORE
from nddlc.inputs import Unusable
from nddlc.mission_trust import models_of
from nddlc.trust import trust_option
from runtime.executive.rendering import event_data, trace_line


@click.command()
@click.argument("what", metavar="RUN[#MISSION]", default=LATEST)
@click.option("--format", "style", type=click.Choice(["text", "json"]), default="text", help="How to print it.")
@click.option("--store", "store_path", type=click.Path(path_type=Path), default=STORE, help="Where runs are kept.")
@click.option("--events", is_flag=True, help="Print the whole trace too.")
@trust_option
def command(what: str, style: str, store_path: Path, events: bool, is_trusted: bool) -> int:
    """Explain why a mission failed.

    RUN is the id that `nddlc check` printed, or `latest`. Without a mission the first failed one is explained.
    """
    name, _, number = what.partition("#")
    if number and not number.isdigit():
        raise Unusable(f"`{number}` is no number of a mission", "write RUN#MISSION, such as latest#37")
    if not store_path.exists():
        raise Unusable(f"there is no store `{store_path}`", "`nddlc check` makes one; --store names another")
    try:
        with open_store(store_path) as store:
            return _explain(store, name or LATEST, int(number) if number else None, style, events, is_trusted)
    except StoreError as problem:
        raise Unusable(str(problem), problem.advice) from None


def _explain(store: RunStore, name: str, number: int | None, style: str, events: bool, is_trusted: bool) -> int:
    run = store.find(name)
    if run is None:
        known = ", ".join(store.run_ids()[:10])
        raise Unusable(f"no single run is named `{name}`", f"runs in the store: {known or 'none'}")
    campaign, is_same = campaign_of(run, is_trusted)
    results = tuple(campaign.judged(one) for one in store.results(run.id))
    first = number or next((one.number for one in results if one.verdict is Verdict.FAIL), None)
    findings = campaign.assess(results, may_fly=is_same, focus=first)
    findings = replace(findings, run_id=run.id)
    result = _result(run, first, campaign, findings, is_same)
    fault = next((one for one in findings.faults if result.number in one.bucket.missions), None)
    excerpts = Excerpts(Path(campaign.models.agent.root))
    if not is_same and style == "text":
        click.echo("model, mission file or nddlc have changed since this run; the explanation is of what was flown\n")
    text, plain = _told(result, fault, campaign, findings, excerpts)
    if result.verdict is Verdict.FAIL and is_same:
        contrast = campaign.contrast(result, findings.results)
        if contrast is not None:
            text += "\n".join(["", *contrast_lines(contrast)]) + "\n"
        plain |= {"contrast": contrast_data(contrast)}
    if events and result.outcome is not None:
        lines = [trace_line(event) for event in result.outcome.events]
        text += "\n" + "\n".join(lines) + "\n"
        plain |= {"events": lines, "trace": [event_data(event) for event in result.outcome.events]}
    click.echo(text if style == "text" else json.dumps(plain, ensure_ascii=False, indent=1), nl=style != "text")
    return 0


def _told(
    result: MissionResult, fault: Fault | None, campaign: Campaign, findings: Findings, excerpts: Excerpts
) -> tuple[str, dict[str, Any]]:
    if result.verdict is not Verdict.FAIL:
        return result_text(result, findings.run_id), result_data(result, findings.run_id)
    story = campaign.story(result, fault)
    return story_text(story, findings.run_id, excerpts), story_data(story, findings.run_id, excerpts)


def campaign_of(run: Run, is_trusted: bool) -> tuple[Campaign, bool]:
    """The mission as its file is now, and whether that is still what was flown."""
    path = Path(run.mission_file)
    if path.is_relative_to(Path.cwd()):
        path = path.relative_to(Path.cwd())
    try:
        mission, _ = read_mission(path)
    except OSError as problem:
        raise Unusable(f"cannot read `{path}`, the mission file of the run: {problem.strerror}") from None
    if mission is None:
        raise Unusable(f"`{path}`, the mission file of the run, is in error", f"nddlc check {path}")
    mission = replace(mission, check=replace(mission.check, seed=run.seed, missions=run.missions))
    models = models_of(mission, is_trusted=is_trusted, is_named=False)
    campaign = Campaign(mission, models, load)
    if models.has_errors:
        return Campaign(mission, ModelSet(mission.agent, {}, {}, {}, ()), load), False
    return campaign, campaign.run.id == run.id


def _result(run: Run, number: int | None, campaign: Campaign, findings: Findings, is_same: bool) -> MissionResult:
    """The mission asked for, flown again from its seed where its trace was not kept."""
    if number is None:
        raise Unusable(f"no mission of run {run.id} failed", f"{run.id}#N shows mission N all the same")
    if not 1 <= number <= run.missions:
        raise Unusable(f"run {run.id} has missions 1 to {run.missions}, not {number}")
    stored = next((result for result in findings.results if result.number == number), None)
    if stored is not None and (stored.has_trace or not is_same):
        return stored
    if not is_same:
        raise Unusable(f"mission {number} of run {run.id} was not flown, and the model or nddlc has changed since")
    return campaign.judged(fly_one(load(campaign.models.agent), campaign.task(number), keep_trace=True))
