"""Which Python of a project a command may run (docs/security.md): what the user named in; one refusal, or nothing, out.

The project is the folder of the file that was named, or a folder above it up to the one that the user stands in. Python
of a project lies below the file that asks for it.
"""

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, TypeVar

import click

from nddl_lang.lint.codes import NOT_TRUSTED
from nddl_lang.lint.settings import Settings
from nddl_lang.text.diagnostic import Diagnostic, Note
from nddl_lang.text.read import real_path
from nddl_lang.text.render import render
from nddl_lang.text.source import Span
from nddlc.fitting import colours, columns, fitted
from nddlc.inputs import Unusable
from runtime.user.library import Library, library_of

Function = TypeVar("Function", bound=Callable[..., Any])
_HELP = "look at it, then use `--trust` to run it all the same (docs/security.md)"


class _Refused(Unusable):
    """Python that is not run, told where it is asked for."""

    def __init__(self, diagnostic: Diagnostic) -> None:
        super().__init__(diagnostic.message)
        self.diagnostic = diagnostic

    def show(self, file: Any = None) -> None:
        """The diagnostic."""
        click.echo(fitted(render(self.diagnostic, colour=colours()), columns()), err=True)


def trust_option(command: Function) -> Function:
    """Let a command run Python from outside of the project."""
    return click.option(
        "--trust", "is_trusted", is_flag=True, help="Run the project's Python, wherever its configuration finds it."
    )(command)


def library_for(path: Path, settings: Settings, *, is_trusted: bool) -> Library:
    """The constraints of the project that a named model belongs to, loaded."""
    if not is_trusted and settings.folder is not None:
        permit(
            ((each.path, each.span) for each in settings.modules),
            real_path(settings.folder),
            _is_named(real_path(settings.folder), real_path(path.parent)),
        )
    return library_of(settings)


def _is_named(folder: Path, named: Path) -> bool:
    """Whether a configuration's folder is the one that was named, or lies between it and where the user stands."""
    return folder == named or (named.is_relative_to(folder) and folder.is_relative_to(real_path(Path.cwd())))


def permit(files: Iterable[tuple[Path, Span]], folder: Path, is_named: bool) -> None:
    """Raise Refused where one of the files is not of the project in `folder`, or that was not named."""
    refused = [(path, span) for path, span in files if not (is_named and real_path(path).is_relative_to(folder))]
    if not refused:
        return
    (path, span), *others = refused
    reason = (
        f"it lies outside `{folder}`, the folder of the file that asks for it"
        if is_named
        else f"`{folder}` was not named, and lies above or beside what was"
    )
    notes = tuple(Note(f"`{each.as_posix()}` neither", where) for each, where in others)
    raise _Refused(NOT_TRUSTED.at(span, notes=notes, help=_HELP, path=path.as_posix(), reason=reason))
