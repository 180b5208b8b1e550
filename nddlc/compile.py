"""`nddlc compile`: tell which reactors become register code, and which choices are in the way of the others."""

import sys
from collections.abc import Iterator
from contextlib import redirect_stdout

import click

from checker.models import ModelSet
from checker.pinned import pinned
from compiler.determined.codes import CHOICE_LEFT
from compiler.determined.reasons import ChoiceReason
from nddl_lang.mission_suffixes import MISSION_SUFFIXES
from nddl_lang.text.nearest import nearest
from nddl_lang.text.render import render
from nddlc.fitting import colours
from nddlc.inputs import Unusable, configured, read_by, readable
from nddlc.one_mission import prepare
from nddlc.trust import library_for, trust_option
from runtime.determined.building import find_out
from runtime.determined.loading import RegisterProgram
from runtime.executive.configuration import ReactorConfiguration
from runtime.executive.mission import loaded_bench
from runtime.executive.workbench import Workbench
from runtime.loading import load
from runtime.plan.database import PlanDatabase

_OWN, _USED = ("Internal", "Private"), ("External", "Observe")


@click.command()
@click.argument("path", metavar="FILE")
@click.option("--reactor", help="Look at this reactor of a mission only.")
@click.option("--explain", is_flag=True, help="Show the choices that are in the way, each with its line.")
@click.option("-I", "--include", "directories", multiple=True, metavar="DIR", help="Look for included files here too.")
@click.option("--dialect", type=click.Choice(["nddl3", "nddlc"]), help="The same option as before the command.")
@trust_option
@click.pass_context
def command(
    ctx: click.Context,
    path: str,
    reactor: str | None,
    explain: bool,
    directories: tuple[str, ...],
    dialect: str | None,
    is_trusted: bool,
) -> int:
    """Tell which reactors are determined: they fly as register code, without a plan database.

    FILE is a model (.nddl), taken as a simulator that owns its internal timelines, or a mission file (.toml, or
    T-REX's .xml or .cfg). Ends with 1 if a simulator leaves a choice.
    """
    (file,) = readable((path,), directories)
    if file.suffix in MISSION_SUFFIXES:
        _, _, models = prepare(path, is_trusted=is_trusted)
        found = list(_of_mission(models, reactor))
    elif reactor is not None:
        raise Unusable("`--reactor` names a reactor of a mission file, and this is a model")
    else:
        library = library_for(file, configured(file), is_trusted=is_trusted)
        way = read_by(ctx, file, directories, dialect)
        loaded = load(file, way.directories, way.dialect, library, path, most=way.most)
        if loaded.is_refused or loaded.database is None or loaded.program is None:
            for each in loaded.diagnostics:
                click.echo(render(each, colour=colours()), err=True)
            raise Unusable("the model is in error: nothing was compiled")
        found = [_of_model(path, loaded.database)]
    for configuration, program, reasons in found:
        click.echo("\n".join(_page(configuration, program, reasons, explain)))
    return int(any(program is None and configuration.lookahead <= 1 for configuration, program, _ in found))


_Found = tuple[ReactorConfiguration, RegisterProgram | None, tuple[ChoiceReason, ...]]


def _of_mission(models: ModelSet, name: str | None) -> Iterator[_Found]:
    """The reactors of a mission, or the one that is asked for."""
    agent = models.agent
    names = [each.name for each in agent.reactors]
    if name is not None and name not in names:
        meant = nearest(name, names)
        advice = f"did you mean `{meant}`?" if meant is not None else f"there are: {', '.join(names)}"
        raise Unusable(f"the mission has no reactor `{name}`", advice)
    programs = pinned(models).programs_of(agent)
    for number, configuration in enumerate(agent.reactors):
        if name in (None, configuration.name):
            with redirect_stdout(sys.stderr):
                bench = loaded_bench(agent, programs, number, lambda parameter, token: None)
            found = find_out(bench, programs.programs[number], configuration, agent.tick, agent.final_tick)
            yield configuration, *found


def _of_model(path: str, database: PlanDatabase) -> _Found:
    """A model by itself: its timelines play the part that their mode says."""
    bench = Workbench(database, path)
    bench.set_global("TICK_DURATION", 1.0)
    bench.set_global("MISSION_START", 0)
    bench.set_global("MISSION_END", 2**40)
    modes = {name: bench.mode(o) for o, name in enumerate(database.objects.names) if database.plan.object_timeline[o]}
    internal = tuple(name for name, mode in modes.items() if mode in _OWN or not mode)
    external = tuple(name for name, mode in modes.items() if mode in _USED)
    configuration = ReactorConfiguration(path, path, internal=internal, external=external)
    return configuration, *find_out(bench, database.program, configuration, 1.0, 2**40)


def _page(
    configuration: ReactorConfiguration,
    program: RegisterProgram | None,
    reasons: tuple[ChoiceReason, ...],
    explain: bool,
) -> Iterator[str]:
    if program is not None:
        blocks = [block for block in program.blocks if block is not None]
        size = sum(len(block.instructions) for block in blocks)
        order = ", ".join(program.model.lines[n].name for n in program.order)
        what = f"{len(blocks)} blocks, {size} instructions, {program.layout.top} registers"
        yield f"{configuration.name}: determined, {what}"
        if explain:
            yield f"  timelines in causal order: {order}"
        return
    yield f"{configuration.name}: not determined, the general engine plans it"
    for reason in reasons if explain else ():
        if reason.span is None:
            yield f"  {reason.text}\n  help: {reason.advice}"
        else:
            yield render(CHOICE_LEFT.at(reason.span, help=reason.advice, reason=reason.text), colour=colours())
