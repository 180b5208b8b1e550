"""The command `nddlc`: find the subcommand, run it, and turn every way it can end into an exit code.

0 holds · 1 findings · 2 the command or its configuration is unusable · 3 a bug of nddlc · 130 interrupted.
"""

import errno
import gc
import os
import sys
from collections.abc import Sequence
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import Any

import click

import runtime.build_form
from nddl_lang.text.nearest import nearest
from nddlc.fitting import columns, fitted
from runtime.limits import LimitError
from runtime.user.black_box import HERE
from runtime.user.fault import UserCodeError
from runtime.user.output import let_readers_go

# A subcommand is one file, imported only when it is used; a new one needs a line here and nothing else.
COMMANDS = {
    "new": ("nddlc.new", "Begin a project: a model, its simulator and a mission."),
    "lint": ("nddlc.lint", "Report everything that is wrong with models."),
    "fmt": ("nddlc.fmt", "Put models into the one style."),
    "load": ("nddlc.load", "Load models and show their tokens and variables."),
    "compile": ("nddlc.compile", "Tell which reactors become register code, and what is in the way of others."),
    "plan": ("nddlc.plan", "Search a plan for a model."),
    "run": ("nddlc.run", "Fly one mission, and show what happened."),
    "replay": ("nddlc.replay", "Fly the mission of a trace again, and say where it departs."),
    "gold": ("nddlc.gold", "Compare a mission with how it was accepted to be."),
    "check": ("nddlc.check", "Fly the missions of a mission file, and say what fails and why."),
    "compare": (
        "nddlc.compare",
        "Compare two runs on common seeds: which missions flipped.",
    ),
    "cluster": ("nddlc.cluster", "Start a Dask cluster on this machine, to fly missions on."),
    "process": ("nddlc.process", "Take the five steps from a model to the sea, and show which are passed."),
    "study": ("nddlc.study", "Fly variants of models under several samplings, and draw what finds which mistake."),
    "convert": ("nddlc.convert", "Turn a batch file in XML into tables of a mission file."),
    "mutate": ("nddlc.mutate", "Make small faults in models, and say which of them are noticed and found."),
    "explain": ("nddlc.explain", "Explain why one mission of a run failed."),
    "shrink": ("nddlc.shrink", "Shrink a failed mission of a run to the simplest one that fails alike."),
    "promote": ("nddlc.promote", "Keep a failed mission of a run as a regression case."),
    "store": ("nddlc.store", "Look whether a store of runs is whole, and salvage a damaged one."),
    "validate": ("nddlc.validate", "Judge a mission, a record, a trace or a plan against the model."),
    "certify": ("nddlc.certify", "Prove that no value in the box breaks a mission, or fly one that does."),
    "controllability": (
        "nddlc.controllability",
        "Tell whether plans can be carried out, however long the vehicle takes.",
    ),
    "lsp": ("nddlc.lsp", "Serve an editor over standard input and output."),
    "rule": ("nddlc.rule", "Explain a code that a message carries."),
    "schema": ("nddlc.schema", "Print the JSON schema of mission files, or of what a command prints."),
}
# What is slow where the engine is not compiled.
_PLANNING = (
    *("load", "compile", "plan", "run", "replay", "gold", "check", "process", "study", "mutate"),
    *("explain", "shrink", "promote", "validate", "certify", "controllability"),
)
# What may run Python of a project, and therefore does so in a process that is watched.
_SUPERVISED = frozenset((*_PLANNING, "lsp"))
_UNUSABLE, _BUG, _INTERRUPTED = 2, 3, 130
_MACHINE = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EROFS)  # no room, or a broken disk
_FORBIDDEN = (errno.EACCES, errno.EPERM, errno.ELOOP, errno.ENAMETOOLONG)


class _Subcommands(click.Group):
    """A group that knows the names of its commands, but imports only the one that is called."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """The names, in the order of the table."""
        return list(COMMANDS)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """The command that is called; of a mistyped name, say which one may be meant."""
        if args[0] not in COMMANDS and not args[0].startswith("-"):
            meant = nearest(args[0], COMMANDS)
            advice = f"; did you mean `{meant}`?" if meant is not None else ""
            ctx.fail(f"there is no command `{args[0]}`{advice}")
        return super().resolve_command(ctx, args)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command in its file, where the table names one."""
        if cmd_name not in COMMANDS:
            return None
        if cmd_name in _PLANNING:
            named("nddlc.deferral:defer_large")()
        gc.disable()  # nothing of what is imported here is garbage
        found: click.Command = named(f"{COMMANDS[cmd_name][0]}:command")
        gc.freeze()
        gc.enable()
        return found

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the commands without importing them."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, caption) for name, (_, caption) in COMMANDS.items()])


def named(place: str) -> Any:
    """The object that `module:name` names."""
    module, _, name = place.partition(":")
    return getattr(import_module(module), name)


def _show_version(ctx: click.Context, _: click.Parameter, asked: bool) -> None:
    if asked and not ctx.resilient_parsing:
        click.echo(named("nddlc.version:version_text")())
        ctx.exit()


@click.command(cls=_Subcommands, context_settings={"help_option_names": ["-h", "--help"]})
@click.option("--dialect", type=click.Choice(["nddl3", "nddlc"]), help="How texts are read, whatever they declare.")
@click.option("--version", is_flag=True, is_eager=True, expose_value=False, callback=_show_version, help="Show it.")
@click.option(
    "--install-completion",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=lambda *given: named("nddlc.completion:install")(*given),
    help="Let the shell complete the command line (bash, zsh, fish).",
)
@click.pass_context
def nddlc(ctx: click.Context, dialect: str | None) -> None:
    """Check, run and explain NDDL models.

    nddl3 is the language that EUROPA accepts; nddlc, the default, adds to it.
    """
    ctx.obj = dialect
    if ctx.invoked_subcommand in _PLANNING and (notice := runtime.build_form.uncompiled_notice()) is not None:
        click.echo(f"nddlc: {notice}", err=True)


def run(arguments: Sequence[str] | None = None) -> int:
    """Carry out a command line; its exit code."""
    _open_streams()
    try:
        code = nddlc.main(args=arguments, prog_name="nddlc", standalone_mode=False)
    except click.exceptions.Exit as end:
        return end.exit_code
    except click.ClickException as mistake:
        with suppress(OSError):
            mistake.show()
        return _UNUSABLE
    except UserCodeError as mistake:
        _blame(mistake)
        return _UNUSABLE
    except LimitError as problem:
        _complain(f"nddlc: {problem}\n  help: {problem.advice}")
        return _UNUSABLE
    except MemoryError:
        _complain("nddlc: there is not enough memory for this")
        return _UNUSABLE
    except (click.Abort, KeyboardInterrupt):
        with suppress(KeyboardInterrupt):  # a second one
            _complain("nddlc: interrupted")
        return _INTERRUPTED
    except OSError as problem:
        if problem.errno in _MACHINE:
            where = "the output" if problem.filename is None else f"`{problem.filename}`"
            if problem.filename is None:
                _drop_output()
            _complain(f"nddlc: cannot write {where}: {problem.strerror}")
        elif problem.errno in _FORBIDDEN and problem.filename is not None:
            _complain(f"nddlc: cannot use `{problem.filename}`: {problem.strerror}")
        else:
            return _report(problem, arguments)
        return _UNUSABLE
    except Exception as bug:  # the one place where our own mistakes are caught: to tell the user whose they are
        return _report(bug, arguments)
    return code if isinstance(code, int) else 0


def _report(bug: Exception, arguments: Sequence[str] | None) -> int:
    named("nddlc.crash:report")(bug, sys.argv[1:] if arguments is None else list(arguments))
    return _BUG


def _blame(mistake: UserCodeError) -> None:
    _complain(f"nddlc: {mistake}\n  help: {mistake.advice}")


def _complain(text: str) -> None:
    """Write to standard error; where that cannot be written to, the exit code must do."""
    with suppress(OSError):
        click.echo(fitted(text, columns()), err=True)


def _drop_output() -> None:
    """Let what is left of the output vanish: the interpreter would try to write it once more as it ends."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _open_streams() -> None:
    """Where a stream was closed before the start, let what is written there vanish."""
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, Path(os.devnull).open("w", encoding="utf-8"))  # noqa: SIM115 it stays
    let_readers_go()


def main() -> None:
    """The console script."""
    words = sys.argv[1:]
    if "--trust" in words or not _SUPERVISED.isdisjoint(words):
        _open_streams()
        named("nddlc.supervision:supervise")(_blame, lambda bug: _report(bug, None))
    code = run()
    HERE.leave()
    sys.exit(code)


if __name__ == "__main__":
    main()
