"""`nddlc controllability`: can the plan of a mission be carried out, however long the vehicle takes?"""

from pathlib import Path
from typing import Any

import click

from checker.controllability.dynamic import offending_cycle
from checker.controllability.static import is_strongly_controllable, is_weakly_controllable, joined
from checker.excerpts import Excerpts
from checker.mission import LARGEST_SEED
from checker.proofs.certify import MOST_TOKENS
from checker.proofs.rendering import Answer, control_data, control_lines
from checker.proofs.uncertain import branches_flown, plan_networks, requests_flown
from nddl_lang.text.values import json_text
from nddlc.certify import certifier_of
from nddlc.inputs import Unusable, mission_here
from nddlc.one_mission import prepare
from nddlc.trust import trust_option


@click.command()
@click.argument("path", metavar="[MISSION]", required=False)
@click.option("--seed", type=click.IntRange(0, LARGEST_SEED), help="Of the mission flown, else that of the file.")
@click.option("--format", "style", type=click.Choice(["text", "json"]), default="text", help="How to print it.")
@trust_option
def command(path: str | None, seed: int | None, style: str, is_trusted: bool) -> int:
    """Tell whether the plans of MISSION can be carried out, however long the vehicle takes for what it is asked.

    A flight that passes gives the plan of each reactor: tokens, order, relations. What the reactor asks others for is
    uncertain, between the least and the greatest duration over the box of the sampled parameters, as far as the lines
    tell that this flight used, and as flights at the corners of the box and at drawn points show it. The plan is
    dynamically controllable if some strategy keeps all demands that only knows what has happened. It is not if none
    does for durations that flights have shown. Ends with 0 if all plans are, with 1 if one is not, with 2 if it cannot
    be told.
    """
    _, mission, models = prepare(mission_here(path), is_trusted=is_trusted)
    certifier = certifier_of(mission, models, mission.check.seed if seed is None else seed)
    if not certifier.find_structure():
        raise Unusable(certifier.excess or "none of the missions flown passes, so there is no plan to look at")
    excerpts = Excerpts(Path(models.agent.root))
    answers: list[dict[str, Any]] = []
    lines: list[str] = []
    verdicts = {0}
    flights, others, known = [], [], set[object]()
    for point, record, passes in certifier.records_over_the_box():
        flights.append(requests_flown(models.agent, record))
        taken = branches_flown(record)
        if passes and not taken <= known and sum(len(each.tokens) for each in record.reactors) <= MOST_TOKENS:
            known |= taken
            others.append(certifier.structure(point, record))
    ranges = certifier.ranges(others=[structure for structure, _ in others])
    for plan in plan_networks(certifier.structures[0], certifier.dated[0], ranges, flights, others):
        cycle = offending_cycle(plan.network)
        is_shown = cycle is not None and offending_cycle(plan.as_shown()) is not None
        is_strong = cycle is None and is_strongly_controllable(joined(plan.network))
        is_weak = cycle is None or is_weakly_controllable(plan.network)
        verdicts.add(1 if is_shown else 2 if plan.endless or cycle is not None else 0)
        answer = Answer(cycle, is_shown=is_shown, is_strong=is_strong, is_weak=is_weak)
        lines += control_lines(mission.agent.name, plan, answer, excerpts)
        answers.append(control_data(plan, answer, excerpts))
    if not answers:
        lines.append(f"{mission.agent.name}: no reactor asks another for anything: nothing is uncertain")
    click.echo(json_text(answers) if style == "json" else "\n".join(lines))
    return 1 if 1 in verdicts else max(verdicts)
