"""`nddlc convert`: the founding paper's batch file as tables of a mission file, and T-REX's agent file as one."""

from collections.abc import Sequence
from pathlib import Path

import click

from checker.agent_file import is_agent, read_agent_file
from checker.batch_xml import batch_toml, read_batch
from checker.written_mission import mission_toml
from nddl_lang.text.diagnostic import Diagnostic, Severity
from nddl_lang.text.read import read_source
from nddl_lang.text.render import render
from nddl_lang.text.source import Source
from nddlc.fitting import colours
from nddlc.inputs import Unusable, readable, write_text

_DONE, _UNUSABLE = 0, 2


@click.command()
@click.argument("path", metavar="FILE")
@click.option("--output", type=click.Path(path_type=Path), help="Where to write it, instead of printing it.")
def command(path: str, output: Path | None) -> int:
    """Convert a batch file (XML) to tables of a mission file, or an agent file of T-REX (XML) to a mission file.

    Of a batch file that is `[parameters.NAME]` for each sampled parameter, and the batch seed under `[check]`.
    The mission file of an agent belongs beside the agent file: paths in it are relative to that folder.
    """
    (file,) = readable((path,), ())
    source = read_source(file)
    text, complaints = _converted(source, file.parent)
    for each in complaints:
        click.echo(render(each, colour=colours()), err=True)
    if text is None:
        return _UNUSABLE
    if output is None:
        click.echo(text, nl=False)
    elif output.exists():
        raise Unusable(f"there is `{output}` already", "delete it, or name another file")
    else:
        write_text(output, text)
    return _DONE


def _converted(source: Source, folder: Path) -> tuple[str | None, Sequence[Diagnostic]]:
    """The file as TOML, None where it is not understood; and what is wrong with it."""
    if not is_agent(source):
        batch, complaints = read_batch(source)
        return (batch_toml(batch) if batch is not None else None), complaints
    text, values = read_agent_file(source, folder)
    has_errors = any(each.severity is Severity.ERROR for each in text.diagnostics)
    return (mission_toml(values) if values is not None and not has_errors else None), text.diagnostics
