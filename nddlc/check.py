"""`nddlc check`: fly the missions of a mission file and say what fails and why; or check one model's text."""

import os
import sys
from contextlib import ExitStack
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

import click

from checker.batch.connection import StoreError
from checker.batch.interruption import Interruption
from checker.batch.pool import ClusterError, FlyBatch
from checker.batch.process import keeping_a_worker
from checker.batch.store import open_store
from checker.campaign import Campaign, Enough
from checker.counterfactual.effort import MOST_FLIGHTS, Bounds
from checker.coverage import coverage_of
from checker.excerpts import Excerpts
from checker.findings import Findings
from checker.mission import Mission, read_mission
from checker.oracle import OUT_OF_TIME, USER_CODE
from checker.pinned import pinned
from checker.regression import RegressionCase, RegressionError, agent_of, read_cases, regressions_path
from checker.report.coverage import coverage_text
from checker.report.document import json_report
from checker.report.github import github_report
from checker.report.html import html_report
from checker.report.junit import junit_report
from checker.report.markdown import markdown_report
from checker.report.sarif import sarif_report
from checker.report.text import text_report
from checker.sought import seal_of
from checker.stopping import parse_rule
from checker.story import Story
from nddl_lang.analysis import analyse_file
from nddl_lang.repair import repaired
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.text.diagnostic import Diagnostic, Severity
from nddl_lang.text.github import github_line
from nddl_lang.text.render import as_dict, render
from nddl_lang.text.values import json_text
from nddlc.batch_seed import BatchSeed
from nddlc.fitting import colours, say
from nddlc.inputs import STORE, Unusable, chosen_dialect, configured, mission_here, readable, write_text
from nddlc.keeping import keep_findings, keep_pages, sought_before
from nddlc.known import known_callables
from nddlc.main import named
from nddlc.mission_trust import models_of
from nddlc.one_mission import untold, warnings_page
from nddlc.progress import Display
from nddlc.samplers import find_sampler
from nddlc.seeking import SeekingDisplay
from nddlc.trust import trust_option
from nddlc.watch import WatchedCommand

_HOLDS, _FINDINGS, _UNUSABLE, _BUG = 0, 1, 2, 3
_SIGNALLED = 128  # and the number of the signal: 130 for Ctrl-C, 143 for SIGTERM
_REPORT = Path("nddlc-report")
_SECONDS_A_FAULT, _SECONDS = 30.0, 60.0  # that causes are sought, for one fault and for all of them
_STYLES = ("text", "json", "html", "junit", "sarif", "github", "markdown")


@click.command(cls=WatchedCommand)
@click.argument("path", metavar="[PATH]", required=False)
@click.option("--missions", type=click.IntRange(1), help="How many missions to fly, whatever the file says.")
@click.option("--seed", type=BatchSeed(), metavar="N|auto", help="The batch seed; `auto` draws a new one.")
@click.option("--max-failure-rate", type=click.FloatRange(0.0, 1.0), help="The accepted rate, whatever the file says.")
@click.option("--workers", type=click.IntRange(1), help="Processes to fly with; by default one per core.")
@click.option("--format", "style", type=click.Choice(_STYLES), default="text", help="What to print.")
@click.option("--output", type=click.Path(path_type=Path), default=_REPORT, help="Where reports go (./nddlc-report).")
@click.option("--store", "store_path", type=click.Path(path_type=Path), default=STORE, help="Where runs are kept.")
@click.option("--no-store", is_flag=True, help="Keep nothing but the report.")
@click.option("--fresh", is_flag=True, help="Fly all missions again, also those that the store has of this run.")
@click.option("--resume", is_flag=True, hidden=True, help="What is done without --fresh.")
@click.option("--seconds", type=click.FloatRange(0.0, min_open=True), help="End when so much time is over.")
@click.option("--max-failures", type=click.IntRange(1), help="End when so many missions have failed.")
@click.option("--stop-when", metavar="RULE", help='End when the missions show or refute a rule such as "p<0.01@95%".')
@click.option("--sampler", default="random", metavar="NAME", help="How missions are chosen (docs/mission.md).")
@click.option("--coverage", is_flag=True, help="Tell which rules and branches no mission exercised.")
@click.option(
    "--flights",
    type=click.IntRange(0),
    default=MOST_FLIGHTS,
    help=f"Trials for causes ({MOST_FLIGHTS}); 0: conditions, too, come of the missions alone.",
)
@click.option("--no-conditions", is_flag=True, help="Fly for causes alone: conditions come of the missions flown.")
@click.option("--cluster", metavar="ADDRESS", help="Fly on a Dask cluster, such as tcp://127.0.0.1:8786.")
@click.option("--dry-run", is_flag=True, help="Only look whether mission file and models are in order.")
@trust_option
@click.pass_context
def command(
    ctx: click.Context,
    path: str | None,
    missions: int | None,
    seed: int | None,
    max_failure_rate: float | None,
    workers: int | None,
    style: str,
    output: Path,
    store_path: Path,
    no_store: bool,
    fresh: bool,
    resume: bool,
    is_trusted: bool,
    seconds: float | None,
    max_failures: int | None,
    stop_when: str | None,
    sampler: str,
    coverage: bool,
    flights: int,
    no_conditions: bool,
    cluster: str | None,
    dry_run: bool,
) -> int:
    """Check a model by flying many missions, or check the text of one model.

    PATH is a mission file (.toml, or T-REX's .xml or .cfg), by default the one here: its models are checked first,
    then its missions are flown. Ends with 0 if not too many missions fail, with 1 if too many do. If PATH is a
    model (.nddl), only its text is checked. What is finished is stored, and a run that was ended before its time
    goes on from there.
    """
    if fresh and resume:
        raise Unusable("--fresh flies everything again, --resume only what is missing", "leave one of them out")
    path = mission_here(path)
    (file,) = readable((path,), ())
    if file.suffix == ".nddl":
        return _check_text(file, chosen_dialect(ctx, None), style, path, is_trusted)
    rule = parse_rule(stop_when) if stop_when is not None else None
    if stop_when is not None and rule is None:
        raise Unusable(f"`{stop_when}` is no rule to stop by", 'write it as "p<0.01@95%" or "p>0.05@99%"')
    sampler, make_sampler = find_sampler(sampler)
    campaign = _prepare(file, missions, seed, max_failure_rate, style, is_trusted)
    if campaign is None:
        return _UNUSABLE
    campaign = replace(campaign, sampler_name=sampler, make_sampler=make_sampler)
    if cluster is not None:
        campaign = replace(campaign, fly_batch=_cluster_at(cluster))
    if dry_run:
        if style == "text":
            click.echo(f"`{path}` and its models are in order; nothing was flown")
        return _HOLDS
    promoted = _promoted(campaign, file)
    count, enough = workers or cores(), Enough(seconds, max_failures, rule)
    ctx.with_resource(keeping_a_worker())
    try:
        with ExitStack() as stack:
            store = None if no_store else stack.enter_context(open_store(store_path))
            show = stack.enter_context(Display(campaign.mission.check.confidence))
            flown = campaign.fly(count, store, fresh=fresh, enough=enough, progress=show, promoted=promoted)
    except StoreError as problem:
        raise Unusable(str(problem), problem.advice) from None
    except ClusterError as problem:
        raise Unusable(str(problem), "start one with `nddlc cluster`, or leave --cluster out") from None
    judged = [campaign.judged(one) for one in flown.results]
    seal = seal_of(judged, flights, campaign.mission.check.confidence, tests_conditions=not no_conditions)
    sought = None if no_store or not flights else sought_before(flown, campaign.run.id, seal, store_path)
    with Interruption() as interruption:
        with SeekingDisplay(_SECONDS) as seeking:
            findings = campaign.assess(
                flown.results,
                ending=flown.ending,
                may_fly=flights > 0,
                tests_conditions=not no_conditions,
                sampling=flown.sampling,
                bounds=Bounds(flights, _SECONDS_A_FAULT) if flights else None,
                seconds=_SECONDS,
                sought=sought,
                cases=flown.cases,
                progress=seeking,
                let=interruption,
            )
        findings = replace(findings, is_stored=not no_store)
        if not no_store and sought is None:
            keep_findings(findings, seal, store_path)
        stories = campaign.stories(findings)
        code = _report(campaign, findings, stories, style, output, coverage=coverage)
        if not no_store and flights and sought is None:
            sys.stdout.flush()  # what follows may take a while
            keep_pages(campaign, flown, findings, stories, store_path, interruption)
    ended_by = flown.ended_by or interruption.first
    return code if ended_by is None else _SIGNALLED + ended_by


def _check_text(file: Path, dialect: Dialect | None, style: str, name: str, is_trusted: bool) -> int:
    """Tell what is wrong with the text of a model that is called `name`; the exit code."""
    settings = configured(file)
    callables, gaps = known_callables(settings, is_trusted=is_trusted)
    chosen = dialect or settings.dialect
    analysis = analyse_file(file, chosen, settings.directories, callables, settings.most_lexemes)
    _tell((*gaps, *repaired(analysis).diagnostics), style)
    if style == "text" and not analysis.has_errors:
        click.echo(f"the text of `{name}` is in order; missions are flown from a mission file (.toml)")
    return _UNUSABLE if analysis.has_errors else _HOLDS


def _promoted(campaign: Campaign, file: Path) -> tuple[RegressionCase, ...]:
    """The regression cases beside the mission file, which must fit it."""
    place = regressions_path(file)
    try:
        cases = read_cases(place)
        for case in cases:
            agent_of(case, campaign.models.agent)
    except RegressionError as problem:
        raise Unusable(str(problem), f"mend `{place}`, or remove the case") from None
    return cases


def _prepare(
    file: Path,
    missions: int | None,
    seed: int | None,
    max_failure_rate: float | None,
    style: str,
    is_trusted: bool,
) -> Campaign | None:
    """Read the mission and its models; None where they are in error, which the user has then been told."""
    mission, found = read_mission(file)
    if mission is None:
        _tell(found, style)
        return None
    mission = _overridden(mission, missions, seed, max_failure_rate)
    models = models_of(mission, is_trusted=is_trusted, is_linted=True)
    if models.has_errors:
        _tell((*found, *models.diagnostics), style)
        return None
    if style == "text":
        weighty = (Severity.ERROR, Severity.WARNING)
        told = untold((*found, *models.diagnostics), models)
        _tell(tuple(one for one in told if one.severity in weighty), style)
        say(warnings_page(models))
    return Campaign(mission, models, pinned(models))


def _overridden(mission: Mission, missions: int | None, seed: int | None, max_failure_rate: float | None) -> Mission:
    check = mission.check
    if missions is not None:
        check = replace(check, missions=missions)
    if seed is not None:
        check = replace(check, seed=seed)
    if max_failure_rate is not None:
        check = replace(check, max_failure_rate=max_failure_rate)
    return replace(mission, check=check)


def _tell(diagnostics: tuple[Diagnostic, ...], style: str) -> None:
    """Print diagnostics: as text, or as data for whoever asked for a format that programs read."""
    if style == "github":
        for one in diagnostics:
            click.echo(github_line(one))
        return
    if style not in ("text", "markdown"):
        click.echo(json_text({"diagnostics": [as_dict(one) for one in diagnostics]}))
        return
    colour = colours() and style == "text"
    for one in diagnostics:
        say(f"{render(one, colour=colour)}\n")
    errors = sum(one.severity is Severity.ERROR for one in diagnostics)
    if errors:
        click.echo(f"{errors} error{'' if errors == 1 else 's'}: nothing was flown")


def _cluster_at(address: str) -> FlyBatch:
    """What flies missions on a cluster; asked for late, as Dask is large."""
    if find_spec("distributed") is None:
        raise Unusable("a cluster needs the package `distributed`", "install `nddlc[cluster]`")
    found: FlyBatch = named("checker.batch.cluster:Cluster")(address).fly
    return found


def cores() -> int:
    """How many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _report(
    campaign: Campaign,
    findings: Findings,
    stories: list[Story | None],
    style: str,
    output: Path,
    *,
    coverage: bool,
) -> int:
    """Write every form of the report, print the one that was asked for, and say how it ended."""
    excerpts = Excerpts(Path(campaign.models.agent.root))
    if style == "text":  # first of all: what follows may take a while
        say(text_report(findings, excerpts))
        sys.stdout.flush()
    covered = coverage_of(campaign.models, findings.results) if coverage else None
    pairs = campaign.pairs(findings)
    page = html_report(findings, excerpts, stories, pairs, campaign.drawn(findings, pairs))
    reports = {
        "json": ("report.json", json_report(findings, excerpts, covered)),
        "html": ("report.html", page),
        "junit": ("junit.xml", junit_report(findings, excerpts)),
        "sarif": ("report.sarif", sarif_report(findings, excerpts)),
        "markdown": ("report.md", markdown_report(findings, excerpts)),
    }
    for name, text in reports.values():
        write_text(output / name, text, "--output names a folder")
    if style == "github":
        click.echo(github_report(findings, excerpts), nl=False)
    elif style == "text":
        if covered is not None:
            say("\n" + coverage_text(covered))
        say(f"\nreport: {output / 'report.html'} (beside it report.json, report.md, junit.xml, report.sarif)\n")
    else:
        click.echo(reports[style][1], nl=False)
    if findings.rate.exceeds:
        return _FINDINGS
    if any(result.judgement.code not in (USER_CODE, OUT_OF_TIME) for result in findings.errors):
        return _BUG
    return _UNUSABLE if findings.errors or findings.is_unknown else _HOLDS
