"""`nddlc plan`: search a plan for a model, and show it, or say why there is none."""

import json
import sys
import time
from collections.abc import Iterator
from contextlib import redirect_stdout
from pathlib import Path

import click

from nddl_lang.text.read import read_source
from nddl_lang.text.render import render
from nddlc.because import as_data, shortened, story
from nddlc.gantt import chart
from nddlc.inputs import Unusable, chosen_dialect, colours, readable
from nddlc.load import TOKEN_HEAD, table, token_row
from nddlc.loading import Facts, Loaded, facts, load
from nddlc.picture import page, svg
from runtime.plan.codes import REJECTED
from runtime.plan.readout import live_tokens, read, token_names
from runtime.solver.account import Failure, Recorder
from runtime.solver.codes import PLAN, RESULT_NAMES
from runtime.solver.configuration import Configuration, default_configuration
from runtime.solver.limits import Limits, model_limits
from runtime.solver.read import read_configuration
from runtime.solver.search import Solver

DEFAULT_HORIZON = (0, 1000)
PATIENCE = 0.5  # seconds until progress is told, and between two tellings


@click.command()
@click.argument("file", metavar="FILE")
@click.option("-I", "--include", "directories", multiple=True, metavar="DIR", help="Look for included files here too.")
@click.option("--dialect", type=click.Choice(["nddl3", "nddlc"]), help="The same option as before the command.")
@click.option("--config", "config", metavar="FILE", help="What to mend and how, in EUROPA's XML or in TOML.")
@click.option("--horizon", nargs=2, type=int, metavar="LO HI", help="Plan what lies between these ticks.")
@click.option("--max-steps", type=click.IntRange(0), help="Stop after so many steps.")
@click.option("--max-depth", type=click.IntRange(0), help="Stop when so many decisions are in force.")
@click.option("--max-seconds", type=click.FloatRange(0, min_open=True), help="Stop after so many seconds.")
@click.option(
    "--strategy",
    type=click.Choice(["nddlc", "europa"]),
    default="nddlc",
    help="How to search: nddlc learns from conflicts; europa makes EUROPA's steps one by one.",
)
@click.option("--explain", is_flag=True, help="Say why there is no plan, or why goals were rejected.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object in one line.")
@click.option("--format", "style", type=click.Choice(["text", "svg", "html"]), default="text", help="How to show it.")
@click.pass_context
def command(
    ctx: click.Context,
    file: str,
    directories: tuple[str, ...],
    dialect: str | None,
    config: str | None,
    horizon: tuple[int, int] | None,
    max_steps: int | None,
    max_depth: int | None,
    max_seconds: float | None,
    strategy: str,
    explain: bool,
    as_json: bool,
    style: str,
) -> int:
    """Search a plan for a model and show it.

    Ends with 0 if there is a plan, with 1 if there is none or it was not found in time.
    """
    (path,) = readable((file,), directories)
    configuration = _configuration(config)
    if horizon is not None and horizon[0] >= horizon[1]:
        raise Unusable(f"the horizon from {horizon[0]} to {horizon[1]} is empty")
    loaded = load(path, directories, chosen_dialect(ctx, dialect), file)
    told = facts(loaded)
    if loaded.database is None or loaded.is_refused:
        _show_refusal(loaded, told, as_json)
        return 1
    limits = _limits(loaded, horizon, max_steps, max_depth)
    solver = Solver(loaded.database, configuration, limits.start, limits.end, strategy == "europa")
    recorder = Recorder(loaded.database, solver.queues, solver.stack) if explain else None
    solver.account = recorder
    clock = _Clock(solver, max_seconds)
    with redirect_stdout(sys.stderr):  # what constraints print there would be read by programs
        result = solver.solve(limits.steps, limits.depth, clock)
    clock.wipe()
    reasons = _reasons(recorder, told, result)
    told |= read(loaded.database) | {"consistent": told["consistent"]}
    told["solve"] = {"result": RESULT_NAMES[result], "steps": solver.steps, "depth": solver.depth}
    if explain:
        told["explanation"] = {name: as_data(failure) for name, failure in reasons.items()}
    if as_json:
        click.echo(json.dumps(told, ensure_ascii=False))
    elif style == "svg":
        click.echo(svg(told, (limits.start, limits.end)), nl=False)
    elif style == "html":
        said = [_verdict(told), *(line for name, failure in reasons.items() for line in _why(name, failure))]
        click.echo(page(told, (limits.start, limits.end), Path(file).name, said), nl=False)
    else:
        for each in loaded.diagnostics:
            click.echo(render(each, colour=colours()))
        click.echo("\n".join(_lines(told, limits)))
        for name, failure in reasons.items():
            click.echo("\n".join(_why(name, failure)))
    return 0 if result == PLAN else 1


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
        click.echo(render(each, colour=colours()), err=True)
    if configuration is None:
        raise Unusable(f"`{name}` is no usable configuration")
    return configuration


def _limits(loaded: Loaded, horizon: tuple[int, int] | None, steps: int | None, depth: int | None) -> Limits:
    """What the command line says, else what the model says, else the default."""
    assert loaded.database is not None
    own = model_limits(loaded.database) or Limits(*DEFAULT_HORIZON)
    start, end = horizon or (own.start, own.end)
    return Limits(start, end, own.steps if steps is None else steps, own.depth if depth is None else depth)


def _show_refusal(loaded: Loaded, told: Facts, as_json: bool) -> None:
    if as_json:
        click.echo(json.dumps(told, ensure_ascii=False))
        return
    for each in loaded.diagnostics:
        click.echo(render(each, colour=colours()))
    click.echo("refused: the model is in error")


def _reasons(recorder: Recorder | None, told: Facts, result: int) -> dict[str, Failure]:
    """What an explanation was asked for: why there is no plan, or why tokens were rejected."""
    if recorder is None:
        return {}
    if told["consistent"] is False:
        return {"there is no plan": recorder.contradiction()}
    if result == PLAN:
        return {
            f"`{name}` was rejected": failure for name, failure in recorder.reasons.items() if _is_out(recorder, name)
        }
    return {} if recorder.end is None else {"there is no plan": recorder.end}


def _why(name: str, failure: Failure) -> Iterator[str]:
    """The lines that explain one thing."""
    yield from ("", f"why {name}:", *shortened(story(failure, 1)))


def _is_out(recorder: Recorder, name: str) -> bool:
    """Whether the token of that name is rejected now."""
    tokens = token_names(recorder.database, live_tokens(recorder.database))
    return any(tokens[t] == name and recorder.plan.rows.status[t] == REJECTED for t in tokens)


class _Clock:
    """Tell whether time is over; on a terminal, show how far a long search has come."""

    def __init__(self, solver: Solver, seconds: float | None) -> None:
        self.solver = solver
        self.seconds = seconds
        self.begun = self.told = time.monotonic()
        self.is_terminal = sys.stderr.isatty()

    def __call__(self) -> bool:
        now = time.monotonic()
        if self.is_terminal and now - self.told >= PATIENCE:
            self.told = now
            solver = self.solver
            self.write(
                f"{now - self.begun:.0f} s, {solver.steps} steps, {solver.failures} failed, depth {solver.depth}"
            )
        return self.seconds is not None and now - self.begun >= self.seconds

    def write(self, line: str) -> None:
        """Put a line where the last one stood."""
        click.echo(f"\r{line:<70}\r", err=True, nl=False)

    def wipe(self) -> None:
        """Take the line away, if there is one."""
        if self.told > self.begun:
            self.write("")


def _lines(told: Facts, limits: Limits) -> Iterator[str]:
    """What a modeler wants to see."""
    result = told["solve"]["result"]
    if result == "plan":
        yield from chart(told, (limits.start, limits.end), 100)
        yield ""
    tokens = [token_row(token) for token in told["tokens"]]
    if tokens:
        yield from table(TOKEN_HEAD, tokens)
        yield ""
    yield _verdict(told)


def _verdict(told: Facts) -> str:
    solve = told["solve"]
    count = f"{solve['steps']} steps"
    if solve["result"] == "plan":
        return f"plan found after {count}, {solve['depth']} decisions in force"
    if solve["result"] == "timeout":
        return f"no plan found yet: stopped after {count}"
    if told["consistent"] is False:
        return "no plan exists: the model contradicts itself before any decision"
    return f"no plan exists: all choices fail, after {count}"
