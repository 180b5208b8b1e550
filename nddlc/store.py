"""`nddlc store`: look whether a store of runs is whole, and keep what is whole of a damaged one."""

from dataclasses import asdict
from pathlib import Path

import click

from checker.batch.connection import StoreError
from checker.batch.salvage import StoreDamage, examine, salvage
from nddl_lang.text.values import json_text
from nddlc.inputs import STORE, Unusable

_WHOLE, _DAMAGED = 0, 1
_MOST_SHOWN = 20


@click.command()
@click.argument("action", type=click.Choice(["check", "salvage"]))
@click.argument("path", metavar="[STORE]", type=click.Path(path_type=Path), default=STORE)
@click.option("--output", type=click.Path(path_type=Path), help="The new store; else it takes the old one's name.")
@click.option("--format", "style", type=click.Choice(["text", "json"]), default="text", help="How to print it.")
def command(action: str, path: Path, output: Path | None, style: str) -> int:
    """Look whether a store of runs is whole, or keep what is whole of it.

    `check` looks at every page and every mission, and ends with 0 if all are whole, with 1 if not. `salvage` puts
    what is whole into a new store; the old one is kept beside it, with `.damaged` behind its name.
    """
    try:
        if action == "check":
            damage = examine(path)
            _tell(damage, path, style)
            return _WHOLE if damage.is_none else _DAMAGED
        target = output or path.with_name(path.name + ".new")
        if target.exists():
            raise Unusable(f"there is `{target}` already", "delete it, or name another with --output")
        damage = salvage(path, target)
    except StoreError as problem:
        raise Unusable(str(problem), problem.advice) from None
    except OSError as problem:
        raise Unusable(f"cannot write the new store: {problem.strerror or problem}") from None
    if output is None:
        _replace(path, target)
    _tell(damage, path, style)
    if style == "text":
        click.echo(f"kept: {damage.whole} missions of {damage.runs} runs, in `{output or path}`")
    return _WHOLE


def _replace(path: Path, target: Path) -> None:
    """Put the new store in the place of the old one, with what belongs to each."""
    old = path.with_name(path.name + ".damaged")
    for ending in ("", "-wal", "-shm"):
        if Path(f"{path}{ending}").exists():
            Path(f"{path}{ending}").replace(f"{old}{ending}")
    for ending in ("", "-wal", "-shm"):
        if Path(f"{target}{ending}").exists():
            Path(f"{target}{ending}").replace(f"{path}{ending}")
    Path(f"{target}.lock").unlink(missing_ok=True)


def _tell(damage: StoreDamage, path: Path, style: str) -> None:
    if style == "json":
        click.echo(json_text({"store": str(path), "is_whole": damage.is_none, **asdict(damage)}))
        return
    if damage.is_none:
        click.echo(f"`{path}` is whole: {damage.whole} missions of {damage.runs} runs")
        return
    click.echo(f"`{path}` is damaged: {damage.whole} missions of {damage.runs} runs are whole")
    for run, number in damage.missions[:_MOST_SHOWN]:
        click.echo(f"  mission {number} of run {run} cannot be read")
    if len(damage.missions) > _MOST_SHOWN:
        click.echo(f"  and {len(damage.missions) - _MOST_SHOWN} more missions")
    for page in damage.pages[:_MOST_SHOWN]:
        click.echo(f"  {page}")
