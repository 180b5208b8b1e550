"""A short form of `make engine-proof`: random networks and sets of constraints, beside slow and obvious judges."""

import random

import pytest

from tests.constraints import random_conflicts, random_networks, random_reals, random_sets
from tests.constraints.reference import BATCHES, seeds
from tests.constraints.signatures import SIGNATURES

NEEDED = 0.95  # the share of elements without which an explanation must be consistent


@pytest.mark.parametrize("batch", BATCHES)
def test_networks_live_as_all_pairs_distances_say(batch: int) -> None:
    tally = random_networks.Tally()
    for seed in seeds(batch):
        random_networks.judge_network(seed, tally)
    assert tally.comparisons > 4 * tally.networks
    assert tally.spare == 0


@pytest.mark.parametrize("batch", BATCHES)
def test_search_finds_just_the_solutions(batch: int) -> None:
    tally = random_sets.Tally()
    for seed in seeds(batch):
        random_sets.judge_search(seed, tally)
    assert tally.solutions > 0 or tally.refuted == tally.sets


def test_explanations_are_inconsistent_and_nearly_minimal() -> None:
    tally = random_sets.Tally()
    for batch in BATCHES:
        for seed in seeds(batch):
            random_conflicts.judge_conflict(seed, tally)
    spare, elements = tally.spare + tally.far_spare, tally.elements + tally.far_elements
    assert tally.far_elements > 0 and spare <= (1 - NEEDED) * elements


def test_every_operation_is_drawn() -> None:
    drawn = {op for seed in range(3000) for op, _ in random_sets.draw(random.Random(seed)).posts}
    assert drawn == set(SIGNATURES)


@pytest.mark.parametrize("batch", BATCHES)
def test_no_solution_in_reals_is_ever_lost(batch: int) -> None:
    tally = random_reals.Tally()
    for seed in seeds(batch):
        random_reals.judge_reals(seed, tally)
    assert tally.narrowed > 0
