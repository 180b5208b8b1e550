"""What `nddlc explain` tells where it was not kept: a mission judged again, flown where its trace was not kept."""

from dataclasses import dataclass, replace
from pathlib import Path

import click

from checker.batch.connection import Run
from checker.batch.result import MissionResult, read_record
from checker.batch.store import RunStore, read_store
from checker.batch.worker import fly_one
from checker.campaign import Campaign
from checker.conditions.record import read_condition
from checker.contrast_rendering import contrast_data
from checker.counterfactual.effort import Bounds
from checker.counterfactual.ranking import Causes
from checker.excerpts import Excerpts
from checker.explain import MOST_CAUSES, page_text, result_data, result_text, story_data
from checker.findings import Fault
from checker.graph import causal_graph, focused
from checker.graph_rendering import graph_data, graph_dot, graph_svg, graph_text
from checker.judge.written_values import DocumentError
from checker.logged import Departure, MissionLog, ReactorLog, first_departure, read_mission_log, with_players
from checker.mission import read_mission
from checker.models import ModelSet, load_models
from checker.names import as_named, mission_name, number_text
from checker.oracle import Verdict
from checker.pinned import pinned
from nddl_lang.text.values import json_text
from nddlc.fitting import say
from nddlc.inputs import Unusable, readable
from nddlc.mission_trust import models_of
from nddlc.samplers import SAMPLERS, find_sampler
from nddlc.seeking import SeekingDisplay
from runtime.executive.rendering import event_data, trace_line

_DRAWN = {"dot": graph_dot, "svg": graph_svg}


def explain(
    name: str,
    number: int | None,
    *,
    mission_path: Path | None,
    style: str,
    store_path: Path,
    verbose: int,
    bounds: Bounds,
    events: bool,
    is_trusted: bool,
) -> int:
    """Explain mission `number` of the run `name`, or that of a log `name` of the mission at `mission_path`."""
    if mission_path is not None:
        return _print(_replayed(Path(name), mission_path, bounds, is_trusted), style, events, verbose)
    with read_store(store_path) as store:
        return _print(_found(store, name, number, bounds, is_trusted), style, events, verbose)


@dataclass(frozen=True, eq=False, slots=True)
class _Found:
    """A mission of a run and what is known of it; `is_same`: its models are still those that were flown."""

    campaign: Campaign
    run_id: str
    result: MissionResult
    fault: Fault | None
    is_same: bool
    results: tuple[MissionResult, ...]
    of_log: tuple[str, ...] = ()


def _found(store: RunStore, name: str, number: int | None, bounds: Bounds, is_trusted: bool) -> _Found:
    run = run_named(store, name)
    campaign, is_same = campaign_of(run, is_trusted)
    results = tuple(campaign.judged(one) for one in store.results(run.id))
    failed = next((one.number for one in results if one.verdict is Verdict.FAIL), None)
    first = failed if number is None else number
    kept = {example: read_record(Causes, text) for example, text in store.causes(run.id).items()}
    may_fly = is_same and bounds.flights > 0
    causes = {example: one for example, one in kept.items() if not may_fly or one.is_all_of(bounds.flights)}
    conditions = {example: read_condition(text) for example, text in store.conditions(run.id).items()}
    with SeekingDisplay() as seeking:
        findings = campaign.assess(
            results,
            may_fly=may_fly,
            focus=first,
            bounds=bounds if bounds.flights else None,
            conditions=conditions,
            causes=causes,
            progress=seeking,
        )
    findings = replace(findings, run_id=run.id)
    result = _result(run, first, campaign, results, is_same)
    fault = next((one for one in findings.faults if result.number in one.bucket.missions), None)
    return _Found(campaign, run.id, result, fault, is_same, results)


def _replayed(path: Path, mission_path: Path, bounds: Bounds, is_trusted: bool) -> _Found:
    """The mission of a log flown again, with players where the log tells what a reactor did that asks nobody."""
    (file,) = readable((str(mission_path),), ())
    try:
        log = read_mission_log(path)
    except (OSError, ValueError, DocumentError) as problem:
        raise Unusable(f"`{path}` is no log of a mission: {problem}") from None
    mission, _ = read_mission(file)
    if mission is None or models_of(mission, is_trusted=is_trusted).has_errors:
        raise Unusable(f"`{mission_path}` or its models are in error", f"nddlc check {mission_path}")
    changed, others = with_players(mission, log)
    players = [one.name for one in changed.agent.coded if one.class_name == "LogPlayer"]
    if not players:
        raise Unusable(
            f"`{path}` has no log of a reactor of the mission that asks nobody", "these are what can be played again"
        )
    models = load_models(changed, is_linted=True)
    campaign = Campaign(changed, models, pinned(models))
    task = campaign.task(1) if log.seed is None else replace(campaign.task(1), seed=log.seed)
    result = campaign.judged(fly_one(campaign.load(campaign.models.agent), task, keep_trace=True))
    findings = campaign.assess((result,), focus=1, bounds=bounds if bounds.flights else None)
    fault = next(iter(findings.faults), None)
    return _Found(
        campaign,
        path.name,
        result,
        fault,
        True,
        (result,),
        _told_of_log(log, players, others, result, changed.agent.until),
    )


def _told_of_log(
    log: MissionLog, players: list[str], others: dict[str, ReactorLog], result: MissionResult, until: int | None
) -> tuple[str, ...]:
    """What the log says of the end of the mission, and where the flight is another."""
    told = [f"played from the log: {', '.join(players)}"]
    told += [f"`{name}` breaks off at tick {log.last_tick}" for name in log.cut_off]
    if log.ends is None:
        told.append(f"nothing is on record after tick {log.last_tick}: what held then goes on")
    elif until is not None:
        told.append(
            f"the record ends at tick {until}: what makes the mission pass here takes it past that, no more is known"
        )
    told += [f"T-REX ended `{one.reactor}` at tick {one.failed}" for one in log.reactors if one.failed is not None]
    lines = [line for one in others.values() for line in one.provided]
    events = result.outcome.events if result.outcome is not None else ()
    departure: Departure | None = first_departure(log, lines, events)
    if departure is not None:
        told.append(
            f"departs from the log at tick {departure.tick}, on `{departure.timeline}`: in the log"
            f" {_begun(departure.logged)} then, in this flight {_begun(departure.flown)}"
        )
    return tuple(told)


def _begun(predicate: str) -> str:
    return f"{predicate} begins" if predicate else "nothing begins"


def _print(found: _Found, style: str, events: bool, verbose: int) -> int:
    result, campaign = found.result, found.campaign
    excerpts = Excerpts(Path(campaign.models.agent.root))
    is_shown = style != "text" or verbose
    graph = focused(causal_graph(result.outcome), verbose) if is_shown and result.outcome is not None else None
    if style in _DRAWN:
        if graph is None or not graph.ends:
            raise Unusable(
                f"{mission_name(result.number)} of run {found.run_id} has no causes to draw", "it did not fail"
            )
        click.echo(_DRAWN[style](graph), nl=False)
        return 0
    if found.of_log and style == "text":
        say("\n".join([*found.of_log, "", ""]))
    if not found.is_same and style == "text":
        is_read = bool(campaign.models.texts)
        now = "model, mission file or nddlc have changed since this run" if is_read else "the models are in error now"
        say(f"{now}; the explanation is of what was flown\n\n")
    if result.verdict is Verdict.FAIL:
        contrast = campaign.contrast(result, found.results, found.fault) if found.is_same else None
        story = campaign.story(result, found.fault, found.results, contrast)
        most = len(found.fault.causes.ranked) if found.fault is not None and verbose else MOST_CAUSES
        drawn = f"\nthe causal graph, each node with the numbers of its causes:\n{graph_text(graph)}" if graph else ""
        text = page_text(story, contrast, found.run_id, excerpts, most, drawn)
        plain = story_data(story, found.run_id, excerpts)
        plain |= {"graph": graph_data(graph, excerpts)} if graph is not None else {}
        plain |= {"contrast": contrast_data(contrast)} if found.is_same else {}
    else:
        text, plain = result_text(result, found.run_id), result_data(result, found.run_id)
    if events and result.outcome is not None:
        lines = [trace_line(event) for event in result.outcome.events]
        text += "\n" + "\n".join(lines) + "\n"
        plain |= {"events": lines, "trace": [event_data(event) for event in result.outcome.events]}
    plain |= {"log": list(found.of_log)} if found.of_log else {}
    if style == "text":
        say(text)
    else:
        click.echo(json_text(plain))
    return 0


def run_named(store: RunStore, name: str) -> Run:
    """The run of that name."""
    run = store.find(name)
    if run is None:
        known = ", ".join(store.run_ids()[:10])
        raise Unusable(f"no single run is named `{name}`", f"runs in the store: {known or 'none'}")
    return run


def check_random(run: Run, number: int) -> None:
    """Complain of a mission that was not flown, unless it is a random one of the run, which its number tells."""
    if not 1 <= number <= run.missions:
        raise Unusable(f"run {run.id} has missions 1 to {run.missions}, not {number_text(number)}")
    if run.sampler != "random":
        raise Unusable(f"{mission_name(number)} of run {run.id} was not flown, and only the sampler knows where it is")


def campaign_of(run: Run, is_trusted: bool) -> tuple[Campaign, bool]:
    """The mission as its file is now, and whether that is still what was flown."""
    path = as_named(run.mission_file)
    try:
        mission, _ = read_mission(path)
    except OSError as problem:
        raise Unusable(f"cannot read `{path}`, the mission file of the run: {problem.strerror}") from None
    if mission is None:
        raise Unusable(f"`{path}`, the mission file of the run, is in error", f"nddlc check {path}")
    mission = replace(mission, check=replace(mission.check, seed=run.seed, missions=run.missions))
    models = models_of(mission, is_trusted=is_trusted, is_named=False, is_linted=True)
    campaign = Campaign(mission, models, pinned(models))
    if models.has_errors:
        nothing = ModelSet(mission.agent, {}, {}, {}, ())
        return Campaign(mission, nothing, pinned(nothing)), False
    if run.sampler in SAMPLERS:
        name, make_sampler = find_sampler(run.sampler)
        campaign = replace(campaign, sampler_name=name, make_sampler=make_sampler)
    else:
        campaign = replace(campaign, sampler_name=run.sampler)
    return campaign, campaign.run.id == run.id


def _result(
    run: Run, number: int | None, campaign: Campaign, results: tuple[MissionResult, ...], is_same: bool
) -> MissionResult:
    """The mission asked for, flown again from its seed where its trace was not kept."""
    if number is None:
        raise Unusable(f"no mission of run {run.id} failed", f"{run.id}#N shows mission N all the same")
    stored = next((result for result in results if result.number == number), None)
    if stored is not None and (stored.has_trace or not is_same):
        return stored
    if stored is None:
        check_random(run, number)
    if not is_same:
        raise Unusable(f"mission {number} of run {run.id} was not flown, and the model or nddlc has changed since")
    task = campaign.task(number, stored)
    return campaign.judged(fly_one(campaign.load(task.agent or campaign.models.agent), task, keep_trace=True))
