"""`nddlc certify`: prove that no value in the box breaks a mission, or fly one that does."""

from collections.abc import Callable
from itertools import count
from pathlib import Path
from typing import Any

import click

from checker.excerpts import Excerpts
from checker.flight import fly_recorded
from checker.mission import LARGEST_SEED, Mission
from checker.models import ModelSet, load_models
from checker.mutation.variant import open_over
from checker.oracle import Verdict, judge_within
from checker.pinned import pinned
from checker.proofs.box import Point
from checker.proofs.certify import Certainty, Certificate, Certifier
from checker.proofs.constants import SafeConstant, places_of, safe_constant, with_value
from checker.proofs.rendering import certificate_data, certificate_lines, constant_lines, place_of
from nddl_lang.text.values import json_text
from nddlc.inputs import Unusable, mission_here
from nddlc.one_mission import prepare
from nddlc.seeking import SeekingDisplay
from nddlc.trust import trust_option
from runtime.executive.outcome import Outcome
from runtime.executive.record import MissionRecord


@click.command()
@click.argument("path", metavar="[MISSION]", required=False)
@click.option("--bound", "bounds", multiple=True, metavar="NAME", help="Find the safe value of a constant; repeatable.")
@click.option("--seed", type=click.IntRange(0, LARGEST_SEED), help="Of the missions flown, else that of the file.")
@click.option("--no-corners", is_flag=True, help="Fly no corners of the box before anything is proved.")
@click.option("--rules-only", is_flag=True, help="Leave the properties out: certify the rules of the models alone.")
@click.option("--format", "style", type=click.Choice(["text", "json"]), default="text", help="How to print it.")
@trust_option
def command(
    path: str | None,
    bounds: tuple[str, ...],
    seed: int | None,
    no_corners: bool,
    rules_only: bool,
    style: str,
    is_trusted: bool,
) -> int:
    """Prove that no value of the sampled parameters in their box breaks MISSION, or fly a mission that fails.

    A flight fixes the structure: tokens, their order, relations, branches of rules. z3 proves for the whole box that
    all lines of the models hold with the times that follow from the parameters then, or gives a point that is flown.
    docs/proofs.md says exactly what is proved. With --bound the value of a constant from which on the mission is
    certified. Ends with 0 if it is certified, with 1 if it is refuted or unknown, with 2 if it cannot be flown.
    """
    _, mission, models = prepare(mission_here(path), is_trusted=is_trusted)
    excerpts = Excerpts(Path(models.agent.root))
    chosen = mission.check.seed if seed is None else seed
    with SeekingDisplay(done="flying and proving") as display:
        certifier = certifier_of(mission, models, chosen, display)
        found = certifier.certify(corners=not no_corners, rules_only=rules_only)
        told = [_bounded(name, certifier, mission, models, chosen, rules_only) for name in bounds]
    if style == "json":
        data: dict[str, Any] = certificate_data(found, certifier.box, excerpts)
        data["bounds"] = [_bound_data(*each, excerpts) for each in told]
        click.echo(json_text(data))
    else:
        lines = certificate_lines(mission.agent.name, found, certifier.box, excerpts)
        for name, safe, places, again in told:
            lines.append("")
            if safe is None:
                lines.append(f"{name}: no safe value was found for these structures")
            else:
                lines += constant_lines(safe, places, again, excerpts)
        click.echo("\n".join(lines))
    return 0 if found.certainty is Certainty.CERTIFIED else 1


_Bound = tuple[str, SafeConstant | None, tuple[Any, ...], Certificate | None]


def certifier_of(
    mission: Mission, models: ModelSet, seed: int, progress: Callable[[int], None] = lambda flights: None
) -> Certifier:
    """What certifies a mission, with missions flown in this process; `progress` is told how many."""
    agent, limits = models.agent, mission.check.limits
    flown = pinned(models).programs_of(agent)
    flights = count()

    def fly(point: Point) -> tuple[Outcome, MissionRecord, bool]:
        progress(next(flights))
        outcome, record = fly_recorded(agent, flown, seed, point)
        return outcome, record, judge_within(outcome, limits).verdict is Verdict.PASS

    return Certifier(agent, flown.programs, fly, limits=limits)


def _bounded(
    name: str, certifier: Certifier, mission: Mission, models: ModelSet, seed: int, rules_only: bool
) -> _Bound:
    """The safe value of a constant, and the certificate of the models that have it."""
    places = places_of(name, certifier.programs)
    if not places:
        raise Unusable(f"the models give no constant `{name}` a value")
    safe = safe_constant(certifier, name)
    overlay = with_value(places[0], safe.value) if safe is not None and len(places) == 1 else None
    if safe is None or overlay is None:
        return name, safe, places, None
    changed = load_models(mission, open_over(overlay))
    return (
        name,
        safe,
        places,
        None if changed.has_errors else certifier_of(mission, changed, seed).certify(rules_only=rules_only),
    )


def _bound_data(
    name: str, safe: SafeConstant | None, places: tuple[Any, ...], again: Certificate | None, excerpts: Excerpts
) -> dict[str, Any]:
    return {
        "name": name,
        "own": None if safe is None else safe.own,
        "value": None if safe is None else safe.value,
        "is_least": None if safe is None else safe.is_least,
        "certified": again is not None and again.certainty is Certainty.CERTIFIED,
        "places": [place_of(span, excerpts.root).file for span in places],
    }
