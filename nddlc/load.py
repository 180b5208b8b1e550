"""`nddlc load`: execute models and show the tokens and variables that result."""

import json
from collections.abc import Iterable, Iterator, Sequence

import click

from nddl_lang.text.render import render
from nddlc.gantt import shortened
from nddlc.inputs import chosen_dialect, colours, columns, model_files, readable
from nddlc.loading import Facts, Loaded, facts, load

TOKEN_HEAD = ("token", "predicate", "state", "object", "start", "duration", "end", "parameters")
LEAST = 6  # characters of a cell that are shown in any case


@click.command()
@model_files
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object per file, each in one line.")
@click.pass_context
def command(
    ctx: click.Context, files: tuple[str, ...], directories: tuple[str, ...], dialect: str | None, as_json: bool
) -> int:
    """Execute models, each by itself, and show their tokens and variables.

    Ends with 0 if all is well, with 1 if a model is in error or contradicts itself.
    """
    chosen = chosen_dialect(ctx, dialect)
    is_fine = True
    for path, name in zip(readable(files, directories), files, strict=True):
        loaded = load(path, directories, chosen, name)
        told = facts(loaded)
        is_fine = is_fine and told["consistent"] is True
        if as_json:
            click.echo(json.dumps(told, ensure_ascii=False))
        else:
            click.echo("\n".join(_page(loaded, told, len(files) > 1)))
    return int(not is_fine)


def _page(loaded: Loaded, told: Facts, with_name: bool) -> Iterator[str]:
    """What a modeler wants to see of one file."""
    if with_name:
        yield f"== {loaded.file} =="
    colour = colours()
    for each in loaded.diagnostics:
        yield render(each, colour=colour)
    if loaded.is_refused:
        yield "refused: the model is in error"
        return
    tokens = [token_row(token) for token in told["tokens"]]
    if tokens:
        yield from table(TOKEN_HEAD, tokens, columns())
        yield ""
    shown = {token["id"] for token in told["tokens"]}
    variables = [(name, domain) for name, domain in told["domains"].items() if name.partition(".")[0] not in shown]
    if variables:
        yield from table(("variable", "domain"), variables, columns())
        yield ""
    for timeline, order in told["order"].items():
        if order:
            yield f"{timeline}: {' then '.join(order)}"
    yield "consistent" if told["consistent"] else "inconsistent: no plan can satisfy this model"


def token_row(token: Facts) -> tuple[str, ...]:
    """The cells of one token."""
    parameters = ", ".join(f"{name} {domain}" for name, domain in (token.get("params") or {}).items())
    times = [_bounds(token.get(key)) for key in ("start", "duration", "end")]
    state = token["state"] if token.get("merged_into") is None else f"{token['state']} {token['merged_into']}"
    return (token["id"], token["predicate"], state, token.get("object") or "", *times, parameters)


def _bounds(pair: Sequence[object] | None) -> str:
    if not pair:
        return ""
    lower, upper = pair
    return str(lower) if lower == upper else f"[{lower}, {upper}]"


def table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]], room: int | None = None) -> Iterator[str]:
    """Rows under a head, in columns as wide as they need to be, or as `room` lets them be: the widest give way."""
    lines = [head, *rows]
    widths = [max(len(line[column]) for line in lines) for column in range(len(head))]
    least = [min(width, LEAST) for width in widths]
    while room is not None and sum(widths) + 2 * (len(head) - 1) > room and widths != least:
        widest = max(range(len(head)), key=lambda column: widths[column] - least[column])
        widths[widest] -= 1
    for number, line in enumerate(lines):
        cells = (shortened(cell, width).ljust(width) for cell, width in zip(line, widths, strict=True))
        yield "  ".join(cells).rstrip()
        if number == 0:
            yield "  ".join("-" * width for width in widths)
