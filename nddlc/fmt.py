"""`nddlc fmt`: put models into the one style, or tell which are not in it."""

import difflib
import gc
import sys
from pathlib import Path

import click

from nddl_lang.formatter.format import format_text
from nddl_lang.lint.configuration import settings_in
from nddl_lang.syntax.dialect import Dialect, declared_dialect
from nddl_lang.text.diagnostic import Severity
from nddl_lang.text.printable import printable
from nddl_lang.text.render import render
from nddlc.fitting import colours
from nddlc.inputs import Unusable, chosen_dialect, models_below, models_only, readable, write_text

_STDIN = "-"


@click.command()
@click.argument("files", nargs=-1, required=True, metavar="FILE...")
@click.option("--dialect", type=click.Choice(["nddl3", "nddlc"]), help="The same option as before the command.")
@click.option("--check", "only_check", is_flag=True, help="Write nothing; end with 1 if a file is not in the style.")
@click.option("--diff", "with_diff", is_flag=True, help="Write nothing; show what would change.")
@click.pass_context
def command(ctx: click.Context, files: tuple[str, ...], dialect: str | None, only_check: bool, with_diff: bool) -> int:
    """Put models into the one style; `-` reads a text and prints it.

    FILE is a model, or a directory, of which all models (.nddl) are taken.
    Statements with mistakes stay as they are. Ends with 1 if there are such, or if --check or --diff finds
    something to change.
    """
    # As in `lint`: looking for garbage would only cost.
    gc.disable()
    ctx.call_on_close(gc.enable)
    chosen = chosen_dialect(ctx, dialect)
    dry = only_check or with_diff
    changed, broken = 0, 0
    for name in _named(files):
        before = _read(name)
        most = settings_in(Path(name).parent).most_lexemes
        formatted = format_text(before, chosen or declared_dialect(before) or Dialect.NDDLC, name, most)
        mistakes = [each for each in formatted.diagnostics if each.severity is Severity.ERROR]
        broken += bool(mistakes)
        if mistakes:
            click.echo("\n".join(render(each, colour=colours()) for each in mistakes), err=True)
        if formatted.text != before:
            changed += 1
            if with_diff:
                click.echo(_difference(name, before, formatted.text), nl=False)
            elif only_check:
                click.echo(f"would format {printable(name)}")
            elif name != _STDIN:
                write_text(Path(name), formatted.text)
                click.echo(f"formatted {printable(name)}")
        if name == _STDIN and not dry:
            sys.stdout.buffer.write(formatted.text.encode("utf-8"))
    return int(broken > 0 or (dry and changed > 0))


def _named(files: tuple[str, ...]) -> dict[str, None]:
    """The files, with those below the directories that are named, each once."""
    found: dict[str, None] = {}
    for name in files:
        found.update(dict.fromkeys(map(str, models_below(name)) if Path(name).is_dir() else (name,)))
    return found


def _read(name: str) -> str:
    if name == _STDIN:
        content, name = sys.stdin.buffer.read(), "the standard input"
    else:
        models_only((name,))
        (path,) = readable((name,), ())
        content = path.read_bytes()
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError as problem:
        place = content.count(b"\n", 0, problem.start) + 1
        raise Unusable(
            f"`{name}` is not UTF-8 text (line {place})", "formatting it could change what it says"
        ) from None


def _difference(name: str, before: str, after: str) -> str:
    lines = difflib.unified_diff(before.splitlines(True), after.splitlines(True), name, f"{name} (formatted)")
    return "".join(line if line.endswith("\n") else f"{line}\n\\ no line end\n" for line in lines)
