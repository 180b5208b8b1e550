"""`nddlc compare`: two runs of missions with common seeds, such as those of two versions of a model."""

from pathlib import Path
from typing import Any

import click

from checker.batch.connection import StoreError
from checker.batch.result import MissionResult, write_record
from checker.batch.store import RunStore, read_store
from checker.comparison import Comparison, Lost, Mission, Trialled, compare
from checker.limits import Limit
from checker.losses import amount
from checker.oracle import Verdict
from checker.rendering import failure_text
from checker.report.sentences import missions, percent
from checker.sampling.rendering import number
from checker.sampling.sampler import RANDOM_POINT, MissionRole
from checker.statistics import LEAST_CHANCE
from nddl_lang.text.read import real_path
from nddl_lang.text.values import json_text, json_value
from nddlc.inputs import STORE, Unusable

_SAME, _WORSE = 0, 1
_SURE = 0.05
_MOST = 40  # flips that are printed
_LOST = ("repairs of plans", "goals given up", "requests undelivered")


@click.command()
@click.argument("before", metavar="A")
@click.argument("after", metavar="B")
@click.option("--confidence", type=click.FloatRange(0.5, 0.999999), default=0.95, help="Of the interval.")
@click.option("--store", "store_path", type=click.Path(path_type=Path), default=STORE, help="Where runs are kept.")
@click.option("--format", "style", type=click.Choice(["text", "json"]), default="text", help="How to print it.")
def command(before: str, after: str, confidence: float, store_path: Path, style: str) -> int:
    """Compare two runs on the seeds that both have flown, and list the missions that flipped.

    A and B are ids of runs (as `nddlc check` printed them, or `latest`), or reports (report.json). Ends with 1 where B
    fails more often, and chance would bring so uneven a count of flips in less than one case in twenty.
    """
    both = [_missions(each, store_path) for each in (before, after)]
    found = compare(both[0], both[1], confidence)
    if not found.missions:
        raise Unusable("these runs have no mission in common", "fly both with the same --seed and sampler")
    is_same = _identity(before, store_path) == _identity(after, store_path)
    if style == "json":
        click.echo(json_text(_data(found, before, after, confidence)))
    else:
        if is_same:
            click.echo(f"`{before}` and `{after}` are one and the same run: it is compared with itself")
        click.echo(_text(found, before, after, confidence), nl=False)
    return _WORSE if found.is_worse and found.chance < _SURE else _SAME


def _identity(name: str, store_path: Path) -> str:
    """What tells a run or a report from all others."""
    if name.endswith(".json"):
        return str(real_path(Path(name)))
    with read_store(store_path) as store:
        run = store.find(name)
    return name if run is None else run.id


def _missions(name: str, store_path: Path) -> dict[Mission, Trialled]:
    """The missions of a run, by what makes them the same; ERRORs are left out."""
    if name.endswith(".json"):
        return _reported(Path(name))
    try:
        with read_store(store_path) as store:
            return _stored(store, name)
    except StoreError as problem:
        raise Unusable(str(problem), problem.advice) from None


def _stored(store: RunStore, name: str) -> dict[Mission, Trialled]:
    run = store.find(name)
    if run is None:
        known = ", ".join(store.run_ids()[:10])
        raise Unusable(f"no single run is named `{name}`", f"runs in the store: {known or 'none'}")
    results = [one for one in store.results(run.id) if one.number > 0 and one.verdict is not Verdict.ERROR]
    return {(one.seed, write_record(one.point)): _trialled(one) for one in results}


def _trialled(result: MissionResult) -> Trialled:
    judgement = result.judgement
    text = failure_text(judgement, result.open_goals)
    is_random = result.point.role is MissionRole.RANDOM
    losses = result.losses
    lost = Lost(losses.repaired, amount(losses, Limit.REJECTED), losses.lost)
    return Trialled(result.number, result.verdict is Verdict.FAIL, judgement.code, text, is_random, lost)


def _reported(path: Path) -> dict[Mission, Trialled]:
    """The missions of a report; only plain random ones are known by their seed alone."""
    try:
        listed = json_value(path.read_text(encoding="utf-8"))["missions"]
        point = write_record(RANDOM_POINT)
        return {
            (int(one["seed"]), point): Trialled(
                int(one["mission"]),
                one["verdict"] == "FAIL",
                str(one["code"]),
                str(one["reason"]),
                lost=Lost(one["losses"]["repairs"], len(one["losses"]["rejected"]), one["losses"]["undelivered"]),
            )
            for one in listed
            if one["verdict"] != "ERROR" and one.get("role", "random") == "random"
        }
    except (OSError, ValueError, KeyError, TypeError) as problem:
        raise Unusable(f"`{path}` is no report of nddlc: {problem}") from None


def _text(found: Comparison, before: str, after: str, confidence: float) -> str:
    count = found.missions
    worse = sum(one.now_fails for one in found.flips)
    lines = [
        f"{missions(count)} in common: {before} failed {found.failed_before} ({percent(found.failed_before / count)}), "
        f"{after} failed {found.failed_after} ({percent(found.failed_after / count)})",
        f"  {worse} fail only in {after}, {len(found.flips) - worse} only in {before}; "
        f"McNemar's exact test: p {'<=' if found.chance <= LEAST_CHANCE else '='} {found.chance:.3g}",
        f"  {_change_text(found, confidence)}",
    ]
    changed = [
        f"{what} {was} -> {now}"
        for what, was, now in zip(_LOST, found.lost_before, found.lost_after, strict=True)
        if was != now
    ]
    lines += [f"  what they cost: {', '.join(changed)}"] if changed else []
    for one in found.flips[:_MOST]:
        failing = one.after if one.now_fails else one.before
        side = "now fails" if one.now_fails else "no longer fails"
        lines.append(f"  mission {failing.number} (seed {one.seed}) {side}: {failing.code} {failing.reason}")
    if len(found.flips) > _MOST:
        lines.append(f"  and {len(found.flips) - _MOST} more")
    return "\n".join(lines) + "\n"


def _change_text(found: Comparison, confidence: float) -> str:
    """The change of the failure rate with its interval; where there is none, why."""
    if found.change is None or found.interval is None:
        return "a sampler chose all of these missions: by how much the failure rate changes they do not tell"
    lower, upper = (number(round(100.0 * end, 2)) for end in found.interval)
    basis = "" if found.counted == found.missions else f" (by the {missions(found.counted)} that no sampler chose)"
    points = number(round(100.0 * found.change, 2))
    return f"the rate changes by {points} points{basis}, {number(confidence * 100.0)} % interval {lower} to {upper}"


def _data(found: Comparison, before: str, after: str, confidence: float) -> dict[str, Any]:
    return {
        "before": before,
        "after": after,
        "missions": found.missions,
        "failed_before": found.failed_before,
        "failed_after": found.failed_after,
        "p": found.chance,
        "counted": found.counted,
        "change": found.change,
        "confidence": confidence,
        "interval": None if found.interval is None else list(found.interval),
        "lost_before": found.lost_before._asdict(),
        "lost_after": found.lost_after._asdict(),
        "flips": [
            {
                "seed": one.seed,
                "before": one.before.number,
                "after": one.after.number,
                "now_fails": one.now_fails,
                "code": (one.after if one.now_fails else one.before).code,
                "reason": (one.after if one.now_fails else one.before).reason,
            }
            for one in found.flips
        ],
    }
