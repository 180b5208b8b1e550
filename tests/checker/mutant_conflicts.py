"""Failing missions of mutants in, each conflict that an explanation prints out, with the text it was flown with."""

from collections.abc import Iterator
from itertools import islice
from pathlib import Path

from checker.causes import failed_by
from checker.counterfactual.search import sites_in
from checker.mission import read_mission
from checker.models import load_models
from checker.mutation.choice import mutants_of
from checker.mutation.variant import load_over, open_over, with_edit
from checker.proofs.places import ModelText, text_of
from runtime.executive.outcome import Conflict


def conflicts_of_mutants(
    path: Path, mutants: int, missions: int, seed: int = 0
) -> Iterator[tuple[Conflict, ModelText]]:
    """The conflicts of some missions of each mutant that is still a model."""
    mission, _ = read_mission(path)
    assert mission is not None
    agent = load_models(mission).agent
    sampled = {parameter.name for parameter in agent.parameters}
    sites = [site for site in sites_in(agent) if site.named not in sampled]
    for mutant in islice(mutants_of(sites, seed), mutants):
        overlay = with_edit((), mutant.edit)
        models = load_models(mission, open_over(overlay))
        if models.has_errors:
            continue
        fly = load_over(overlay, models.agent)
        text = text_of(models.agent, models.programs)
        for number in range(missions):
            outcome = fly(number)
            told = failed_by(outcome).conflict
            repairs = outcome.abort.repairs if outcome.abort is not None else ()
            yield from ((one, text) for one in (told, *repairs) if one is not None)
