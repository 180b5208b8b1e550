"""What subcommands that read models share: their options, files checked before any work, and when to colour."""

import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

from nddl_lang.syntax.dialect import Dialect

Function = TypeVar("Function", bound=Callable[..., Any])


class Unusable(click.ClickException):
    """A command line that cannot be carried out, with what to do about it."""

    exit_code = 2

    def __init__(self, message: str, advice: str | None = None) -> None:
        super().__init__(message)
        self.advice = advice

    def show(self, file: Any = None) -> None:
        """One line of complaint, one of advice."""
        click.echo(f"nddlc: {self.message}", err=True)
        if self.advice is not None:
            click.echo(f"  help: {self.advice}", err=True)


def model_files(command: Function) -> Function:
    """Let a command take model files and the directories of their includes."""
    command = click.option(
        "-I", "--include", "directories", multiple=True, metavar="DIR", help="Look for included files here too."
    )(command)
    command = click.option(
        "--dialect", type=click.Choice(["nddl3", "nddlc"]), help="The same option as before the command."
    )(command)
    return click.argument("files", nargs=-1, required=True, metavar="FILE...")(command)


def chosen_dialect(ctx: click.Context, given: str | None) -> Dialect | None:
    """The dialect that the command line asks for; None leaves the choice to the texts."""
    name = given or ctx.obj
    return None if name is None else Dialect(name)


def readable(files: tuple[str, ...], directories: tuple[str, ...]) -> list[Path]:
    """The files as paths; complains before any work of one that cannot be read."""
    for name in directories:
        if not Path(name).is_dir():
            raise Unusable(f"no directory `{name}` to look for includes in")
    return [_readable(name) for name in files]


def _readable(name: str) -> Path:
    path = Path(name)
    if path.is_dir():
        raise Unusable(f"`{name}` is a directory", f"name the files in it, as in `{path / '*.nddl'}`")
    try:
        with path.open("rb") as file:
            file.read(1)
    except FileNotFoundError:
        raise Unusable(f"no file `{name}`", _alike(path)) from None
    except OSError as problem:
        raise Unusable(f"cannot read `{name}`: {problem.strerror or problem}") from None
    return path


def _alike(path: Path) -> str | None:
    """A file that may have been meant."""
    for candidate in (path.with_suffix(".nddl"), Path(f"{path}.nddl")):
        if candidate != path and candidate.is_file():
            return f"there is `{candidate}`"
    return None


def colours() -> bool:
    """Whether to colour: on a terminal, unless NO_COLOR is set."""
    return sys.stdout.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"
