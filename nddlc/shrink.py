"""`nddlc shrink`: the simplest mission that fails as one of a run did; `promote` shares how it is found and told."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click

from checker.batch.connection import LATEST, StoreError
from checker.batch.store import read_store
from checker.buckets import group_failures
from checker.names import mission_name
from checker.oracle import Verdict
from checker.rendering import failure_text
from checker.sampling.rendering import number
from checker.shrink import Shrunk
from nddl_lang.text.values import json_text
from nddlc.explanation import campaign_of, run_named
from nddlc.inputs import STORE, Unusable, mission_of_run
from nddlc.trust import trust_option


@dataclass(frozen=True, slots=True)
class ShrunkMission:
    """A shrunk mission, the mission file that it is of, and the failure in one line."""

    shrunk: Shrunk
    mission_file: Path
    run_id: str
    was: str
    goals: int


@click.command()
@click.argument("what", metavar="RUN[#MISSION]", default=LATEST)
@click.option("--format", "style", type=click.Choice(["text", "json"]), default="text", help="How to print it.")
@click.option("--store", "store_path", type=click.Path(path_type=Path), default=STORE, help="Where runs are kept.")
@trust_option
def command(what: str, style: str, store_path: Path, is_trusted: bool) -> int:
    """Shrink a failed mission to the simplest one that fails alike.

    The fewest parameters that are not in the middle of their range, the simplest values for these, the fewest goals and
    the shortest mission; the same line of the model is to blame. Without a mission the first failed one is shrunk.
    """
    found = shrunk_mission(what, store_path, is_trusted)
    if style == "json":
        click.echo(json_text(_data(found)))
    else:
        click.echo("\n".join(shrunk_lines(found)))
    return 0


def shrunk_mission(what: str, store_path: Path, is_trusted: bool) -> ShrunkMission:
    """The mission that is named, shrunk."""
    name, chosen = mission_of_run(what)
    try:
        with read_store(store_path) as store:
            run = run_named(store, name or LATEST)
            campaign, is_same = campaign_of(run, is_trusted)
            results = tuple(campaign.judged(one) for one in store.results(run.id))
    except StoreError as problem:
        raise Unusable(str(problem), problem.advice) from None
    if not is_same:
        raise Unusable(f"model, mission file or nddlc have changed since run {run.id}", "`nddlc check` flies it again")
    failed = [one for one in results if one.verdict is Verdict.FAIL and chosen in (None, one.number)]
    if not failed:
        named = f"no mission of {run.id}" if chosen is None else f"{mission_name(chosen)} of run {run.id}"
        raise Unusable(f"{named} failed" if chosen is None else f"{named} did not fail")
    shrunk = campaign.shrink(failed[0], results)
    if shrunk is None:
        raise Unusable(f"mission {failed[0].number} of run {run.id} does not fail alike when it is flown again")
    return ShrunkMission(shrunk, Path(run.mission_file), run.id, _was(shrunk), len(campaign.models.agent.goals))


def _was(shrunk: Shrunk) -> str:
    """Code and culprit of a failure, else its reason."""
    (bucket,) = group_failures((shrunk.result,))
    place = bucket.culprit.place
    if place is None:
        return f"{bucket.code}: {failure_text(bucket.judgement, bucket.open_goals, bucket.refusal)}"
    return f"{bucket.code} at {place.file}:{place.line}: {place.text.strip()}"


def shrunk_lines(found: ShrunkMission) -> list[str]:
    """A shrunk mission for people."""
    shrunk = found.shrunk
    values = dict(shrunk.values)
    lines = [f"mission {shrunk.result.number} of run {found.run_id}, shrunk by {shrunk.flights} flights: {found.was}"]
    lines += [f"  {name} = {number(values[name])}" for name in shrunk.off]
    nominal = [name for name, _ in shrunk.values if name not in shrunk.off]
    if nominal:
        lines.append(f"  in the middle of their ranges: {', '.join(nominal)}")
    if shrunk.redrawn:
        lines.append(f"  as drawn from seed {shrunk.result.seed}: {', '.join(shrunk.redrawn)}")
    if found.goals:
        kept = " and ".join([f"number {one + 1}" for one in shrunk.goals]) or "none"
        lines.append(f"  of the {found.goals} goals of the mission file: {kept}")
    lines.append(f"  final tick {shrunk.final_tick}")
    return lines


def _data(found: ShrunkMission) -> dict[str, Any]:
    shrunk = found.shrunk
    return {
        "run": found.run_id,
        "mission": shrunk.result.number,
        "seed": shrunk.result.seed,
        "was": found.was,
        "parameters": dict(shrunk.values),
        "off_nominal": list(shrunk.off),
        "redrawn": list(shrunk.redrawn),
        "goals": list(shrunk.goals),
        "final_tick": shrunk.final_tick,
        "flights": shrunk.flights,
    }
