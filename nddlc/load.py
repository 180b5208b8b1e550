"""`nddlc load`: execute models and show the tokens and variables that result."""

from collections.abc import Iterator

import click

from nddl_lang.text.render import render
from nddl_lang.text.values import json_text
from nddlc.fitting import colours, columns, say
from nddlc.inputs import configured, model_files, models_only, read_by, readable
from nddlc.trust import library_for, trust_option
from runtime.loading import Loaded, as_data, load
from runtime.plan.readout.state import PlanState
from runtime.solver.flaws.relief import may_be_relieved
from runtime.view.load_text import lines


@click.command()
@model_files
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object per file, each in one line.")
@trust_option
@click.pass_context
def command(
    ctx: click.Context,
    files: tuple[str, ...],
    directories: tuple[str, ...],
    dialect: str | None,
    as_json: bool,
    is_trusted: bool,
) -> int:
    """Execute models, each by itself, and show their tokens and variables.

    Ends with 0 if all is well, with 1 if a model is in error or contradicts itself.
    """
    is_fine = True
    models_only(files)
    for path, name in zip(readable(files, directories), files, strict=True):
        library = library_for(path, configured(path), is_trusted=is_trusted)
        way = read_by(ctx, path, directories, dialect)
        loaded = load(path, way.directories, way.dialect, library, name, most=way.most)
        plan = loaded.state()
        is_fine = is_fine and plan is not None and plan.is_consistent
        if as_json:
            click.echo(json_text(as_data(loaded, plan), None))
        else:
            say("\n".join([*_page(loaded, plan, len(files) > 1), ""]))
    return int(not is_fine)


def _page(loaded: Loaded, plan: PlanState | None, with_name: bool) -> Iterator[str]:
    """What a modeler wants to see of one file."""
    if with_name:
        yield f"== {loaded.file} =="
    colour = colours()
    for each in loaded.diagnostics:
        yield render(each, colour=colour)
    if plan is None:
        yield "refused: the model is in error"
    else:
        relieved = loaded.database is not None and may_be_relieved(loaded.database)
        yield from lines(plan, columns(), may_be_relieved=relieved)
