"""Where a token may stand in a sequence: found by halving, against one search per token of the sequence."""

from pathlib import Path

import pytest

from runtime.constraints.stn.distances import Distances
from runtime.plan.tags import ACTIVE, END, INACTIVE, LIST_ORDER, LISTS, START
from runtime.solver.resolvers.insertions import is_out_of_range, may_coincide
from runtime.solver.tags import MOVED
from tests.solver.planning import solver_for
from tests.solver.random_models import rules_model, timelines_puzzle


def coincides(distances: Distances, mine: int, theirs: int) -> bool:
    """Whether both times may be the same, by four searches of their own."""
    return all(
        distances.admits(mine + time, theirs + time, 0) and distances.admits(theirs + time, mine + time, 0)
        for time in (START, END)
    )


@pytest.mark.parametrize("europa", [False, True])
def test_tokens_of_a_sequence_coincide_where_single_searches_say_so(tmp_path: Path, europa: bool) -> None:
    asked = 0
    for text in [timelines_puzzle(seed).text for seed in range(25)] + [rules_model(seed) for seed in range(25)]:
        solver = solver_for(tmp_path, text, europa=europa)
        agenda, rows = solver.agenda, solver.plan.rows
        distances = Distances(solver.engine, europa)
        for _ in range(40):
            if solver.step() != MOVED:
                break
            tokens = range(rows.token_count)
            placed = [c for c in tokens if rows.status[c] == ACTIVE and rows.link_head[LISTS * c + LIST_ORDER] >= 0]
            for t in tokens:
                if rows.status[t] in (ACTIVE, INACTIVE):
                    agenda.sequence.look_around(t)
                    for c in placed:
                        wanted = coincides(distances, rows.var0[t], rows.var0[c])
                        assert may_coincide(agenda, c) == wanted, text
                        assert is_out_of_range(agenda, c) != wanted
                        asked += 1
    assert asked > 1000
