"""`nddlc schema`: the JSON schema of a file that nddlc reads, or of what a command prints as JSON."""

import click

from checker.schemas import SCHEMAS, schema
from nddl_lang.text.values import json_text


@click.command()
@click.argument("name", type=click.Choice(SCHEMAS))
def command(name: str) -> None:
    """Print a JSON schema: of mission and study files, or of what a command prints as JSON.

    `report` is report.json and what `check --format json` prints; where nothing could be flown, that is `lint`. `study`
    is study.json, `study-file` what `study` reads; `trace` is a line of a trace, but for its first.
    """
    click.echo(json_text(schema(name)))
