"""`nddlc plan`: search a plan for a model, and show it, or say why there is none."""

import sys
from collections.abc import Iterator, Mapping
from contextlib import redirect_stdout
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from nddl_lang.mission_suffixes import MISSION_SUFFIXES
from nddl_lang.text.read import read_source
from nddl_lang.text.render import render
from nddl_lang.text.values import json_text
from nddlc.cancellation import Clock
from nddlc.fitting import colours, columns, fitted, say
from nddlc.goals import goals_of
from nddlc.inputs import Unusable, configured, read_by, readable
from nddlc.trust import library_for, trust_option
from runtime.constraints.domains.tags import HALF_INF, INF
from runtime.executive.planning_table import leaving_times
from runtime.limits import bounded, half_of_the_machine
from runtime.loading import Loaded, as_data, load
from runtime.plan.database import PlanDatabase
from runtime.plan.readout.level_profile import LevelProfile, level_profiles
from runtime.plan.readout.open_levels import open_levels
from runtime.plan.readout.readout import live_tokens, read_state, span_of, token_names
from runtime.plan.tags import FLAG_GOAL, FLAG_REJECTABLE, REJECTED
from runtime.solver.configuration.configuration import Configuration, FlawFilter, default_configuration
from runtime.solver.configuration.limits import Limits, model_limits
from runtime.solver.configuration.read import read_configuration
from runtime.solver.flaws.relief import may_be_relieved
from runtime.solver.learning.attempts import FailedFlaw
from runtime.solver.learning.failure_log import FailureLog
from runtime.solver.learning.rendering import as_data as reason_data
from runtime.solver.learning.rendering import story
from runtime.solver.search import Solver
from runtime.solver.tags import PLAN, RESULT_NAMES
from runtime.view.drawing import drawing
from runtime.view.picture import page, svg
from runtime.view.plan_text import INTERRUPTED, PlanReport, found_values, lines, verdict

_DEFAULT_HORIZON = (0, 1000)


def _tick(text: str) -> int:
    """A whole number, or `inf` and `-inf` for no end and no beginning, which lie beyond all ticks."""
    if text.lower().lstrip("+") in ("inf", "-inf"):
        return -INF if text.startswith("-") else INF
    try:
        number = int(text)
    except ValueError:
        raise click.BadParameter(f"`{text}` is no whole number, nor inf or -inf; it takes two, LO and HI") from None
    if abs(number) >= HALF_INF:
        raise click.BadParameter(f"`{text}` is too far away; write inf or -inf")
    return number


@click.command()
@click.argument("file", metavar="FILE")
@click.option("-I", "--include", "directories", multiple=True, metavar="DIR", help="Look for included files here too.")
@click.option("--dialect", type=click.Choice(["nddl3", "nddlc"]), help="The same option as before the command.")
@click.option("--reactor", metavar="NAME", help="Of a mission file: the reactor whose goals are planned.")
@click.option("--config", "config", metavar="FILE", help="What to mend and how, in EUROPA's XML or in TOML.")
@click.option("--horizon", nargs=2, type=_tick, metavar="LO HI", help="Plan what lies between these ticks (or inf).")
@click.option("--max-steps", type=click.IntRange(0), help="Stop after so many steps.")
@click.option("--max-depth", type=click.IntRange(0), help="Stop when so many decisions are in force.")
@click.option("--max-seconds", type=click.FloatRange(0, min_open=True), help="Stop after so many seconds.")
@click.option("--max-memory", type=click.IntRange(1), metavar="MIB", help="Stop at so much; half of the machine's.")
@click.option(
    "--strategy",
    type=click.Choice(["nddlc", "europa"]),
    default="nddlc",
    help="How to search: nddlc learns from conflicts; europa makes EUROPA's steps one by one.",
)
@click.option("--allow-unplanned", is_flag=True, help="End with 0 also if goals may lie outside the horizon.")
@click.option("--explain", is_flag=True, help="Say why there is no plan, or why goals were rejected.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object in one line.")
@click.option("--format", "style", type=click.Choice(["text", "svg", "html"]), default="text", help="How to show it.")
@trust_option
@click.pass_context
def command(
    ctx: click.Context,
    file: str,
    directories: tuple[str, ...],
    dialect: str | None,
    reactor: str | None,
    config: str | None,
    horizon: tuple[int, int] | None,
    max_steps: int | None,
    max_depth: int | None,
    max_seconds: float | None,
    max_memory: int | None,
    strategy: str,
    allow_unplanned: bool,
    explain: bool,
    as_json: bool,
    style: str,
    is_trusted: bool,
) -> int:
    """Search a plan for a model and show it.

    FILE is a model, or a mission file (.toml, or T-REX's .xml or .cfg): then a plan for the goals of its planner is
    searched, up to its final tick. Ends with 0 if there is a plan, with 1 if there is none, it was not found in
    time, or leaves goals out.
    """
    (path,) = readable((file,), directories)
    text = None
    if path.suffix in MISSION_SUFFIXES:
        path, text, solver_file, last = goals_of(path, reactor)
        config, horizon = config or solver_file, horizon or (0, last)
    elif reactor is not None:
        raise Unusable("--reactor names a reactor of a mission file (.toml, or T-REX's .xml or .cfg)")
    configuration = _configuration(config)
    if text is not None:
        configuration = leaving_times(configuration)
    if horizon is not None and horizon[0] >= horizon[1]:
        raise Unusable(f"the horizon from {horizon[0]} to {horizon[1]} is empty")
    if horizon is not None:
        configuration = _within_horizon(configuration)
    settings = configured(path)
    library = library_for(path, settings, is_trusted=is_trusted)
    way = read_by(ctx, path, directories, dialect)
    loaded = load(path, way.directories, way.dialect, library, file, text, way.most)
    before = loaded.state()
    if loaded.database is None or before is None:
        _show_refusal(loaded, as_json)
        return 1
    database = loaded.database
    relieved = may_be_relieved(database)
    limits = _limits(database, horizon, max_steps, max_depth)
    solver = Solver(database, configuration, limits.start, limits.end, strategy == "europa")
    log = FailureLog(database, solver.agenda, solver.stack) if explain else None
    solver.failure_log = log
    clock = Clock(solver, max_seconds)
    budget = max_memory or half_of_the_machine()
    try:
        # What constraints print to standard output would be read by programs.
        with clock, redirect_stdout(sys.stderr), bounded(budget):
            result = solver.solve(limits.steps, limits.depth, clock)
    except MemoryError:
        return _tell_of_memory(loaded, budget, solver.steps, as_json)
    was_consistent = before.is_consistent or solver.steps > 0 or result == PLAN
    reasons = _reasons(log, was_consistent, result)
    plan = read_state(database)
    ended = INTERRUPTED if clock.is_interrupted and result != PLAN else RESULT_NAMES[result]
    report = PlanReport(
        plan,
        ended,
        solver.steps,
        solver.depth,
        limits,
        frozenset(name for t in live_tokens(database) if (name := database.token_label(t)) is not None),
        found_values(plan, before.variables) if ended != "exhausted" else [],
        was_consistent,
        not solver.is_partial or (not was_consistent and not relieved),
        strategy == "europa",
        frozenset(_goals(database)),
        explain,
        _creeping(database),
        list(open_levels(database)) if ended == "plan" else [],
    )
    profiles = level_profiles(database, limits.start)
    if as_json:
        click.echo(json_text(_data(loaded, report, profiles, reasons, before.is_consistent, reactor), None))
    else:
        _show(loaded, report, profiles, reasons, style)
    if ended == INTERRUPTED:
        return 130
    return int(result != PLAN or bool(report.creeping) or (bool(report.beyond()) and not allow_unplanned))


def _tell_of_memory(loaded: Loaded, budget: int, steps: int, as_json: bool) -> int:
    """Say that the search was stopped; the plan is in no state to be shown."""
    if as_json:
        data = as_data(loaded, None) | {"load": "ok", "solve": {"result": "memory", "steps": steps}}
        click.echo(json_text(data, None))
    else:
        say(f"no plan found yet: stopped after {steps} steps, when {budget} MiB of memory were used up\n")
        click.echo("  help: a rule may ask for ever more tokens, see `nddlc lint`; --max-memory allows more", err=True)
    return 1


def _creeping(database: PlanDatabase) -> list[str]:
    """The places of constraints whose bounds still moved when propagation was left off."""
    spans = {span_of(database, database.engine.span[c]) for c in database.engine.creeping if database.engine.op[c] >= 0}
    return [f"{Path(span.source.name).name}:{span.line}" for span in sorted(filter(None, spans), key=lambda s: s.begin)]


def _goals(database: PlanDatabase) -> Iterator[str]:
    """The tokens that the script asked for by `goal`, by name."""
    rows = database.plan.rows
    for t, name in token_names(database, live_tokens(database)).items():
        if rows.flags[t] & FLAG_GOAL and not rows.flags[t] & FLAG_REJECTABLE and rows.parent[t] < 0:
            yield name


def _data(
    loaded: Loaded,
    report: PlanReport,
    profiles: Mapping[str, LevelProfile],
    reasons: Mapping[str, FailedFlaw],
    was_consistent: bool,
    reactor: str | None,
) -> dict[str, Any]:
    """The result for programs; of a mission also whose goals were planned, where that was asked for."""
    data = as_data(loaded, report.plan) | {"consistent": was_consistent}
    data["solve"] = {"result": report.result, "steps": report.steps, "depth": report.depth}
    if report.is_exhausted:
        data["solve"]["is_complete"] = report.is_complete
    data["solve"]["creeping"] = list(report.creeping) if report.result == "plan" else []
    data["solve"]["open_levels"] = [each.as_data() for each in report.open_levels]
    data["solve"]["unplanned"] = report.beyond() if report.result == "plan" else []
    if report.is_explained:
        data["explanation"] = {name: reason_data(failure) for name, failure in reasons.items()}
    data["levels"] = {name: each.as_data() for name, each in profiles.items()}
    if reactor is not None:
        data["reactor"] = reactor
    return data


def _show(
    loaded: Loaded,
    report: PlanReport,
    profiles: Mapping[str, LevelProfile],
    reasons: Mapping[str, FailedFlaw],
    style: str,
) -> None:
    """Print what was found in the form that was asked for."""
    drawn = drawing(report.plan, (report.limits.start, report.limits.end), profiles)
    if style == "svg":
        click.echo(svg(drawn), nl=False)
    elif style == "html":
        reason = [line for name, failure in reasons.items() for line in _why(name, failure)]
        click.echo(page(report, drawn, Path(loaded.file).name, [*verdict(report), *reason]), nl=False)
    else:
        for each in loaded.diagnostics:
            say(f"{render(each, colour=colours())}\n")
        say("\n".join([*lines(report, drawn, columns()), ""]))
        for name, failure in reasons.items():
            say("\n".join([*_why(name, failure), ""]))


def _configuration(name: str | None) -> Configuration:
    """The configuration in a file, or the default one."""
    if name is None:
        return default_configuration()
    try:
        source = read_source(name)
    except OSError as problem:
        raise Unusable(f"cannot read `{name}`: {problem.strerror or problem}") from None
    configuration, complaints = read_configuration(source)
    for each in complaints:
        click.echo(fitted(render(each, colour=colours()), columns()), err=True)
    if configuration is None:
        raise Unusable(f"`{name}` is no usable configuration")
    return configuration


def _within_horizon(configuration: Configuration) -> Configuration:
    """The same for what lies in the horizon alone, where the file has no filter for that: in flight none needs one."""
    if any(each.component == "HorizonFilter" for each in configuration.filters):
        return configuration
    return replace(configuration, filters=(FlawFilter("HorizonFilter"), *configuration.filters))


def _limits(database: PlanDatabase, horizon: tuple[int, int] | None, steps: int | None, depth: int | None) -> Limits:
    """What the command line says, else what the model says, else the default."""
    own = model_limits(database) or Limits(*_DEFAULT_HORIZON)
    start, end = horizon or (own.start, own.end)
    return Limits(start, end, own.steps if steps is None else steps, own.depth if depth is None else depth)


def _show_refusal(loaded: Loaded, as_json: bool) -> None:
    if as_json:
        click.echo(json_text(as_data(loaded, None), None))
        return
    for each in loaded.diagnostics:
        say(f"{render(each, colour=colours())}\n")
    click.echo("refused: the model is in error")


def _reasons(log: FailureLog | None, was_consistent: bool, result: int) -> dict[str, FailedFlaw]:
    """What an explanation was asked for: why there is no plan, or why tokens were rejected."""
    if log is None:
        return {}
    if not was_consistent:
        return {"there is no plan": log.note_contradiction()}
    if result == PLAN:
        return {f"`{name}` was rejected": failure for name, failure in log.rejections.items() if _is_out(log, name)}
    return {} if log.end is None else {"there is no plan": log.end}


def _why(name: str, failure: FailedFlaw) -> Iterator[str]:
    """The lines that explain one thing."""
    yield from ("", f"why {name}:", *story(failure))


def _is_out(log: FailureLog, name: str) -> bool:
    """Whether the token of that name is rejected now."""
    tokens = token_names(log.database, live_tokens(log.database))
    return any(tokens[t] == name and log.plan.rows.status[t] == REJECTED for t in tokens)
