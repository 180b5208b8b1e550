"""Completion of the command line in bash, zsh and fish: the script for a shell, and its installation."""

import os
from pathlib import Path

import click
from click.shell_completion import get_completion_class

from nddlc.inputs import Unusable, write_text

_SHELLS = ("bash", "zsh", "fish")
_MARK = "# completion of nddlc"


def install(ctx: click.Context, _: click.Parameter, asked: bool) -> None:
    """What the option `--install-completion` does: write the script of the user's shell, and have the shell read it."""
    if not asked or ctx.resilient_parsing:
        return
    shell = Path(os.environ.get("SHELL", "")).name
    if shell not in _SHELLS:
        raise Unusable(f"`{shell or 'no shell'}` is not known here", f"SHELL names one of {', '.join(_SHELLS)}")
    for path in _install(shell, ctx.find_root().command, Path.home()):
        click.echo(f"wrote {path}")
    click.echo("it counts in shells that are started from now on")
    ctx.exit()


def _install(shell: str, command: click.Command, home: Path) -> list[Path]:
    """Write the files for a shell below `home`; what has been installed before is written anew, not added twice."""
    if shell == "fish":
        script, start = home / ".config/fish/completions/nddlc.fish", None  # read by fish without being told
    else:
        script = home / ".local/share/nddlc" / f"completion.{shell}"
        start = home / f".{shell}rc"
    try:
        script.parent.mkdir(parents=True, exist_ok=True)
    except OSError as problem:
        raise Unusable(f"cannot make `{script.parent}`: {problem.strerror}") from None
    write_text(script, _source(shell, command))
    if start is None:
        return [script]
    text = start.read_text(encoding="utf-8") if start.exists() else ""
    if _MARK in text:
        return [script]
    line = f'[ -r "{script}" ] && . "{script}"  {_MARK}\n'
    if shell == "zsh":
        line = f"autoload -Uz compinit && compinit  {_MARK}\n{line}"
    write_text(start, f"{text}{'' if text.endswith(chr(10)) or not text else chr(10)}{line}")
    return [script, start]


def _source(shell: str, command: click.Command) -> str:
    found = get_completion_class(shell)
    assert found is not None
    return found(command, {}, "nddlc", "_NDDLC_COMPLETE").source()
