"""A mission of a stored run as `nddlc run` flies it again: its file, its models where a sampler placed it, its seed."""

from dataclasses import replace
from pathlib import Path

import click

from checker.batch.connection import LATEST, StoreError
from checker.batch.store import read_store
from checker.mission import Mission
from checker.models import ModelSet
from checker.names import as_named
from nddlc.explanation import campaign_of, check_random, run_named
from nddlc.inputs import Unusable, mission_of_run


def stored_flight(what: str, store_path: Path, is_trusted: bool) -> tuple[Path, Mission, ModelSet, int]:
    """What `RUN#MISSION` names: mission file, mission, models with the values that a sampler chose, seed.

    A mission that the batch had not reached is flown if it is a plain random one.
    """
    name, number = mission_of_run(what)
    if number is None:
        raise Unusable(f"`{what}` names no mission of a run", "write RUN#MISSION, such as latest#37")
    try:
        with read_store(store_path) as store:
            run = run_named(store, name or LATEST)
            result = store.result(run.id, number)
    except StoreError as problem:
        raise Unusable(str(problem), problem.advice) from None
    file = as_named(run.mission_file)
    campaign, is_same = campaign_of(run, is_trusted)
    models = campaign.models
    if models.has_errors or not models.texts:
        raise Unusable("the models are in error: nothing was flown", f"nddlc lint {file}")
    if result is None:
        check_random(run, number)
    if not is_same:
        click.echo(f"note: model, mission file or nddlc have changed since run {run.id}", err=True)
    task = campaign.task(number, result)
    return file, campaign.mission, replace(models, agent=task.agent or models.agent), task.seed
