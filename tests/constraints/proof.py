"""Judge the engine on random networks and sets of constraints: `make engine-proof`, the tests with many more examples.

python -m tests.constraints.proof [COUNT]    COUNT of each (100,000)

Networks live: edges, distances, restrictions, decisions come, are undone, done again, retracted; after each step all
bounds are compared with those of all-pairs distances. Sets have constraints of all operations: what propagation leaves
is compared with enumeration, and searching with the engine must find just the solutions. Solutions of constraints on
reals are drawn first, and no propagation around them may lose one. Explanations of conflicts are judged whole, and
without each of their elements. Turns that plan and undo must leave nothing behind. Exits with 1 if anything differs.
"""

import sys
import time
from collections.abc import Callable

from runtime.build_form import build_form
from tests.constraints import random_conflicts, random_networks, random_reals, random_sets
from tests.constraints.signatures import SIGNATURES
from tests.constraints.test_explanations import explain_and_shrink
from tests.constraints.test_propagation import compare_with_naive_fixpoint
from tests.solver.lasting import plan_and_undo, post_and_undo, tick

Z3_SHARE = 50  # z3 is asked about one in so many
SHOWN = 5


def judged(what: str, count: int, judge: Callable[[int], None]) -> int:
    """Judge `count` random examples; print how long it took and which went wrong; give how many did."""
    begun = time.monotonic()
    wrong = 0
    for seed in range(count):
        try:
            judge(seed)
        except Exception as problem:  # whatever goes wrong is a finding
            wrong += 1
            if wrong <= SHOWN:
                print(f"  seed {seed}: {type(problem).__name__}: {problem}", flush=True)
    print(f"{what}: {count} judged, {wrong} wrong, {time.monotonic() - begun:.0f} s", flush=True)
    return wrong


def share(spare: int, elements: int) -> str:
    """Say how minimal explanations are."""
    return f"{elements} elements of explanations, {100 * (1 - spare / max(1, elements)):.2f} % of them needed"


def lasted(what: str, life: Callable[[int], list[tuple[int, int]]], turns: int) -> int:
    """Take many turns; print what is held after the first tenth and at the end; give 1 if it grows."""
    begun = time.monotonic()
    found = life(turns)
    (early, early_process), (late, late_process) = found[1], found[-1]
    print(f"{what}: {turns} turns, {time.monotonic() - begun:.0f} s", flush=True)
    print(
        f"  arrays {early} bytes, then {late}; process {early_process / 2**20:.2f} MiB, then {late_process / 2**20:.2f}"
    )
    return int(late > early or late_process > early_process + 2**21)


def main() -> None:
    """Judge all and exit with 1 if anything differs."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
    print(f"engine: {build_form()}")
    nets = random_networks.Tally()
    wrong = judged("temporal networks", count, lambda seed: random_networks.judge_network(seed, nets))
    print(f"  {nets.comparisons} comparisons of all bounds, {nets.undone} times undone, {nets.retractions} retractions")
    print(f"  {nets.conflicts} conflicts, {share(nets.spare, nets.elements)}")
    wrong += judged("constraint sets, bounds as of the naive fixpoint", count, compare_with_naive_fixpoint)
    sets = random_sets.Tally()
    wrong += judged("constraint sets, solutions", count, lambda seed: random_sets.judge_search(seed, sets))
    print(f"  {sets.solutions} solutions, {sets.refuted} sets without any, {sets.nodes} decisions tried")
    print(f"  {len(sets.posts)} of {len(SIGNATURES)} operations, each at least {min(sets.posts.values())} times")
    wrong += judged("constraint sets, conflicts", count, lambda seed: random_conflicts.judge_conflict(seed, sets))
    print(f"  {sets.conflicts} conflicts, {share(sets.spare + sets.far_spare, sets.elements + sets.far_elements)}")
    print(f"  without functions that wait for their arguments: {share(sets.spare, sets.elements)}")
    print(f"  with such functions: {share(sets.far_spare, sets.far_elements)}")
    reals = random_reals.Tally()
    wrong += judged("solutions in reals", count, lambda seed: random_reals.judge_reals(seed, reals))
    print(f"  {reals.narrowed} bounds narrowed around them, {len(reals.posts)} operations")
    wrong += judged(
        "explanations that z3 judges", count // Z3_SHARE, lambda seed: explain_and_shrink(seed, seed % 2 > 0)
    )
    wrong += lasted("plan and undo", plan_and_undo, count)
    wrong += lasted("post and undo", post_and_undo, count)
    wrong += lasted("restrict and retract, tick by tick", tick, count // 5)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
