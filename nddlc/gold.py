"""`nddlc gold`: what a mission did when somebody accepted it, and how it differs from that now."""

import getpass
from datetime import UTC, datetime
from pathlib import Path

import click

from checker.gold import Gold, differences, gold_lines, gold_path, gold_text, read_gold
from checker.mission import LARGEST_SEED
from checker.one_flight import FlightSettings, fly
from nddlc.inputs import Unusable, write_text
from nddlc.one_mission import prepare, values_of
from nddlc.trust import trust_option

_SAME, _DIFFERENT = 0, 1
_MOST = 200  # differences that are printed


@click.command()
@click.argument("action", type=click.Choice(["diff", "accept", "show"]))
@click.argument("path", metavar="MISSION")
@click.option("--seed", type=click.IntRange(0, LARGEST_SEED), help="The seed of the mission, else that of the file.")
@click.option("--param", "given", multiple=True, metavar="NAME=VALUE", help="Give a parameter a value (accept).")
@click.option("--by", metavar="NAME", help="Who accepts; by default you.")
@trust_option
def command(action: str, path: str, seed: int | None, given: tuple[str, ...], by: str | None, is_trusted: bool) -> int:
    """Compare a mission with its gold standard, accept what it does now, or show what was accepted.

    The gold standard lies in `gold/` beside the mission file; its first line says who accepted it, when, and of which
    models. `diff` ends with 0 if nothing differs, with 1 if something does.
    """
    file, mission, models = prepare(path, is_trusted=is_trusted)
    number = mission.check.seed if seed is None else seed
    place = gold_path(file, number)
    if action == "accept":
        settings = FlightSettings(number, values_of(given, models))
        flight = fly(mission, models, settings)
        now = datetime.now(UTC).isoformat(timespec="seconds")
        lines = gold_lines(flight.outcome)
        gold = Gold(file.name, number, dict(settings.values), flight.models, by or _user(), now, lines)
        write_text(place, gold_text(gold))
        click.echo(f"accepted: {len(lines)} events, in `{place}`")
        return _SAME
    gold = _accepted(place)
    if action == "show":
        click.echo(f"accepted by {gold.by} at {gold.at}, models {gold.models[:12]}, seed {gold.seed}")
        for line in gold.lines:
            click.echo(line)
        return _SAME
    flight = fly(mission, models, FlightSettings(gold.seed, gold.values))
    found = differences(gold.lines, gold_lines(flight.outcome))
    if flight.models != gold.models:
        click.echo(f"the models have changed since {gold.by} accepted them at {gold.at}")
    for change in found[:_MOST]:
        click.echo(f"tick {change.tick}{f', {change.timeline}' if change.timeline else ''}")
        for line in change.accepted:
            click.echo(f"  - {line}")
        for line in change.flown:
            click.echo(f"  + {line}")
    if len(found) > _MOST:
        click.echo(f"and {len(found) - _MOST} more")
    click.echo("nothing differs" if not found else f"{len(found)} places differ")
    return _DIFFERENT if found else _SAME


def _user() -> str:
    try:
        return getpass.getuser()
    except (KeyError, OSError):
        return "unknown"


def _accepted(place: Path) -> Gold:
    try:
        return read_gold(place)
    except FileNotFoundError:
        raise Unusable(f"there is no gold standard `{place}`", "`nddlc gold accept` makes one") from None
    except (OSError, ValueError) as problem:
        raise Unusable(f"`{place}` is no gold standard: {problem}") from None
