"""`nddlc convert`: the founding paper's batch file as tables of a mission file."""

from pathlib import Path

import click

from checker.batch_xml import batch_toml, read_batch
from nddl_lang.text.read import read_source
from nddl_lang.text.render import render
from nddlc.fitting import colours
from nddlc.inputs import Unusable, readable, write_text

_DONE, _UNUSABLE = 0, 2


@click.command()
@click.argument("path", metavar="BATCH")
@click.option("--output", type=click.Path(path_type=Path), help="Where to write it, instead of printing it.")
def command(path: str, output: Path | None) -> int:
    """Convert a batch file (XML) to tables of a mission file.

    What is printed is `[parameters.NAME]` for each sampled parameter, and the batch seed under `[check]`.
    """
    (file,) = readable((path,), ())
    batch, complaints = read_batch(read_source(file))
    for each in complaints:
        click.echo(render(each, colour=colours()), err=True)
    if batch is None:
        return _UNUSABLE
    text = batch_toml(batch)
    if output is None:
        click.echo(text, nl=False)
    elif output.exists():
        raise Unusable(f"there is `{output}` already", "delete it, or name another file")
    else:
        write_text(output, text)
    return _DONE
