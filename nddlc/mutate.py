"""`nddlc mutate`: make small faults in the models of a mission, fly them, and say which are noticed and which found."""

from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from typing import Any

import click

from checker.counterfactual.effort import MOST_FLIGHTS, MOST_SECONDS, Bounds
from checker.counterfactual.rendering import cause_data
from checker.mission import LARGEST_SEED, Mission
from checker.models import load_models
from checker.names import relative_name
from checker.yardstick import TOP, Fate, MutantReport, measure, open_flyer, prepare, with_mandatory_goals
from nddl_lang.text.values import json_text
from nddlc.inputs import Unusable
from nddlc.one_mission import prepare as read
from nddlc.trust import trust_option

_MUTANTS, _MISSIONS = 40, 5
_INTERRUPTED = 130


@click.command()
@click.argument("path", metavar="MISSION")
@click.option("--limit", type=click.IntRange(1), default=_MUTANTS, help=f"How many faults to make ({_MUTANTS}).")
@click.option("--missions", type=click.IntRange(1), default=_MISSIONS, help=f"Flown of each ({_MISSIONS}).")
@click.option("--seed", type=click.IntRange(0, LARGEST_SEED), default=0, help="What decides which faults (0).")
@click.option("--mandatory", is_flag=True, help="Make all goals of the mission mandatory.")
@click.option("--flights", type=click.IntRange(0), default=MOST_FLIGHTS, help=f"Trials for a cause ({MOST_FLIGHTS}).")
@click.option("--seconds", type=click.FloatRange(0.0), default=MOST_SECONDS, help=f"For these ({MOST_SECONDS:g}).")
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
@trust_option
def command(
    path: str,
    limit: int,
    missions: int,
    seed: int,
    mandatory: bool,
    flights: int,
    seconds: float,
    as_json: bool,
    is_trusted: bool,
) -> int:
    """Make small faults in the models of MISSION, one at a time and in memory, and measure what comes of them.

    Each fault is flown in some missions that pass without it. Where one fails, the line of the fault is looked for
    among the causes that `nddlc explain` would show: first, in the top three, or at all. Of a line that is gone, its
    rule is looked for. Faults that stay silent tell what the checks of the mission do not notice. Nothing is written.
    """
    _, mission, models = read(path, is_trusted=is_trusted)
    if mandatory:
        mission = with_mandatory_goals(mission)
        models = load_models(mission)
    found: list[MutantReport] = []
    with open_flyer(mission, models) as flyer, _until_interrupted() as ending:
        ground = prepare(mission, models, missions, flyer)
        if not ground.seeds:
            raise Unusable(f"none of the first {missions} missions passes without a fault", "--missions flies more")
        bounds = Bounds(flights, seconds)
        for one in islice(measure(ground, flyer, seed, lambda: bounds), limit):
            found.append(one)
            if not as_json:
                click.echo(_line(one, mission))
    if as_json:
        click.echo(json_text(_data(found, mission, seed, bool(ending))))
    else:
        click.echo("\n" + "\n".join(_summary(found)))
    return _INTERRUPTED if ending else 0


@contextmanager
def _until_interrupted() -> Iterator[list[str]]:
    """Ctrl-C ends what is done inside and is noted; what was found until then is told."""
    ending: list[str] = []
    try:
        yield ending
    except KeyboardInterrupt:
        ending.append("interrupted")


def _line(one: MutantReport, mission: Mission) -> str:
    edit = one.edit
    place = f"{relative_name(edit.file, Path(mission.agent.root))}:{edit.line}"
    old, new = (" ".join(text.split()) for text in (edit.old, edit.new))
    head = f"{place}: {edit.kind}: `{old}` -> `{new}`" if new else f"{place}: {edit.kind}: `{old}`"
    match one.fate:
        case Fate.SILENT:
            return f"{head}: silent"
        case Fate.ERROR:
            return f"{head}: error: {one.message}"
        case Fate.FAILS:
            what = "rule" if one.is_drop else "line"
            rank = f"no cause is its {what}"
            if one.place:
                rank = f"its {what} is cause {one.place} of {len(one.causes.ranked)}"
            faults = f"{one.faults} fault{'' if one.faults == 1 else 's'}"
            return (
                f"{head}: {one.failed} of {one.flown} fail ({one.code}), {faults}, {rank}, {one.causes.flights} trials"
            )


def _summary(found: Sequence[MutantReport]) -> list[str]:
    counts = _counts(found)
    lines = [
        f"{counts['mutants']} faults: {counts['fails']} make missions fail, {counts['silent']} stay silent, "
        f"{counts['error']} end in an error"
    ]
    for name, what in (("changed", "changed lines"), ("dropped", "dropped lines, found by their rules")):
        group = counts[name]
        if group["fails"]:
            names = {"first": "first", "top": f"in the top {TOP}", "any": "among the causes"}
            ranks = ", ".join(f"{name} {group[key]} ({group[key] / group['fails']:.0%})" for key, name in names.items())
            lines.append(f"  {group['fails']} {what}: {ranks}")
    if counts["fails"]:
        one = counts["one_fault"]
        lines.append(f"  {one} ({one / counts['fails']:.0%}) are one fault to `nddlc check`, whatever they break")
    silent = Counter(one.edit.kind for one in found if one.fate is Fate.SILENT)
    if silent:
        lines.append("  silent: " + ", ".join(f"{count} {kind}" for kind, count in silent.most_common()))
    return lines


def _counts(found: Sequence[MutantReport]) -> dict[str, Any]:
    fates = Counter(one.fate for one in found)
    counts: dict[str, Any] = {"mutants": len(found), **{fate.value: fates[fate] for fate in Fate}}
    counts["one_fault"] = sum(one.faults == 1 for one in found)
    for name, is_drop in (("changed", False), ("dropped", True)):
        group = [one for one in found if one.fate is Fate.FAILS and one.is_drop is is_drop]
        counts[name] = {
            "fails": len(group),
            "first": sum(one.place == 1 for one in group),
            "top": sum(1 <= one.place <= TOP for one in group),
            "any": sum(one.place > 0 for one in group),
        }
    return counts


def _data(found: Sequence[MutantReport], mission: Mission, seed: int, interrupted: bool) -> dict[str, Any]:
    root = Path(mission.agent.root)
    return {
        "mission": mission.agent.name,
        "seed": seed,
        "interrupted": interrupted,
        "counts": _counts(found),
        "mutants": [
            {
                "file": relative_name(one.edit.file, root),
                "line": one.edit.line,
                "kind": one.edit.kind.value,
                "old": one.edit.old,
                "new": one.edit.new.strip(),
                "rule": one.rule,
                "fate": one.fate.value,
                "code": one.code,
                "message": one.message,
                "failed": one.failed,
                "flown": one.flown,
                "rank": one.rank,
                "rule_rank": one.rule_rank,
                "faults": one.faults,
                "trials": one.causes.flights,
                "causes": [cause_data(cause, one.causes.remarks) for cause in one.causes.ranked],
            }
            for one in found
        ],
    }
