"""Tell the user that nddlc itself failed, and leave what a report of it needs in a file."""

import os
import platform
import shlex
import sys
import tempfile
import traceback

import click

_SIGN = "this is a bug in nddlc, not in your model"


def report(bug: Exception, arguments: list[str]) -> None:
    """Print a short message; the traceback goes to a file."""
    what = f"{type(bug).__name__}: {bug}" if str(bug) else type(bug).__name__
    text = "".join(traceback.format_exception(bug))
    head = f"command: nddlc {shlex.join(arguments)}\npython: {sys.version}\nplatform: {platform.platform()}\n\n"
    click.echo(f"nddlc: {_SIGN}: {what.splitlines()[0]}", err=True)
    try:
        handle, path = tempfile.mkstemp(prefix="nddlc-bug-", suffix=".txt")
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(head + text)
    except OSError:
        click.echo(text, err=True)
        return
    click.echo(f"  the details are in {path}; please send that file along with a report", err=True)
