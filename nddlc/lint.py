"""`nddlc lint`: everything that is wrong with models."""

import json
from collections import Counter
from collections.abc import Sequence

import click

from nddl_lang.analysis import analyse_file
from nddl_lang.text.diagnostic import Diagnostic, Severity
from nddl_lang.text.render import as_dict, render
from nddlc.inputs import chosen_dialect, colours, model_files, readable

FINDINGS = (Severity.ERROR, Severity.WARNING)
WORDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "remark", Severity.HINT: "hint"}


@click.command()
@model_files
@click.option("--format", "style", type=click.Choice(["text", "json"]), default="text", help="How to print findings.")
@click.pass_context
def command(
    ctx: click.Context, files: tuple[str, ...], directories: tuple[str, ...], dialect: str | None, style: str
) -> int:
    """Report everything that is wrong with models.

    Ends with 0 if nothing is wrong, with 1 if there are errors or warnings.
    """
    chosen = chosen_dialect(ctx, dialect)
    found: list[Diagnostic] = []
    seen = set()  # a file that several models include is complained about once
    for path in readable(files, directories):
        for each in analyse_file(path, chosen, directories).diagnostics:
            if (key := (each.span.source.name, each.span.begin, each.code.id, each.message)) not in seen:
                seen.add(key)
                found.append(each)
    if style == "json":
        click.echo(json.dumps({"files": list(files), "diagnostics": [as_dict(each) for each in found]}, indent=1))
    else:
        colour = colours()
        for each in found:
            click.echo(render(each, colour=colour))
        click.echo(summary(found, len(files)))
    return int(any(each.severity in FINDINGS for each in found))


def summary(found: Sequence[Diagnostic], files: int) -> str:
    """How many findings of each weight there are, in one line."""
    counts = Counter(each.severity for each in found)
    words = [_counted(counts[severity], WORDS[severity]) for severity in Severity if counts[severity]]
    return f"{', '.join(words) or 'nothing wrong'} in {_counted(files, 'file')}"


def _counted(number: int, word: str) -> str:
    return f"{number} {word}" if number == 1 else f"{number} {word}s"
