"""`nddlc replay`: fly the mission of a trace again, and say where it departs."""

import json
from pathlib import Path

import click

from checker.one_flight import first_departure, fly, read_trace
from nddl_lang.text.values import json_value
from nddlc.inputs import Unusable, readable
from nddlc.one_mission import prepare
from nddlc.trust import trust_option

_SAME, _DEPARTS = 0, 1


@click.command()
@click.argument("path", metavar="TRACE")
@click.option("--mission", metavar="MISSION", help="The mission file, if it is not where the trace says.")
@trust_option
def command(path: str, mission: str | None, is_trusted: bool) -> int:
    """Fly the mission of a trace again.

    TRACE was written by `nddlc run --trace`. Ends with 0 if the same happens, with 1 if the flight departs from the
    trace: then the first event that differs is shown.
    """
    (file,) = readable((path,), ())
    try:
        recorded = read_trace(Path(file))
    except ValueError as problem:
        raise Unusable(f"`{path}` is no trace: {problem}", "`nddlc run MISSION --trace FILE` writes one") from None
    _, read, models = prepare(mission or str(recorded.mission), is_trusted=is_trusted, is_named=mission is not None)
    flight = fly(read, models, recorded.settings)
    found = first_departure(recorded, flight)
    if found is None:
        click.echo(f"the same: {len(recorded.lines)} events, to tick {flight.outcome.last_tick}")
        return _SAME
    number, old, new = found
    if recorded.models != flight.models:
        click.echo("the models are not those of the trace")
    click.echo(f"departs at line {number}:")
    was, now = _shown(old), _shown(new)
    if was == now:
        was, now = (f"{was}, {what}" for what in _unlike(old, new))
    click.echo(f"  in the trace: {was}")
    click.echo(f"  flown now:    {now}")
    return _DEPARTS


def _unlike(old: str, new: str) -> tuple[str, str]:
    """What two events that look alike in short have that differs, as the trace has it."""
    before, after = json_value(old), json_value(new)
    keys = [key for key in {**before, **after} if before.get(key) != after.get(key)]
    first, second = (", ".join(f"{key} {json.dumps(one.get(key))}" for key in keys) for one in (before, after))
    return first, second


def _shown(line: str) -> str:
    """An event of a trace in short."""
    if not line:
        return "nothing"
    try:
        event = json_value(line)
        inside = ", ".join(f"{name}={value}" for name, value in event["arguments"].items())
        what = f"{event['predicate']}({inside})" if inside else event["predicate"]
        parts = (f"tick {event['tick']}", event["reactor"], event["kind"], event["timeline"], what)
        return " ".join(part for part in parts if part)
    except (ValueError, KeyError, TypeError, AttributeError):
        return line
