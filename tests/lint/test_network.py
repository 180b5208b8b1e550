"""A network of times that cannot hold together has a cycle with a negative sum, and it is found."""

import random

import pytest

from nddl_lang.lint.network import Edge, negative_cycle


def edge(earlier: int, later: int, weight: float) -> Edge:
    return Edge((earlier, "start"), (later, "start"), weight, "", None)


@pytest.mark.parametrize("seed", range(60))
def test_a_cycle_is_found_where_there_is_one(seed: int) -> None:
    draw = random.Random(seed)
    count = draw.randint(2, 8)
    edges = [
        edge(draw.randrange(count), draw.randrange(count), draw.randint(-3, 9)) for _ in range(draw.randint(2, 16))
    ]
    nearest = [[0.0 if a == b else float("inf") for b in range(count)] for a in range(count)]
    for each in edges:
        a, b = int(str(each.earlier[0])), int(str(each.later[0]))
        nearest[a][b] = min(nearest[a][b], each.weight)
    for middle in range(count):
        for a in range(count):
            for b in range(count):
                nearest[a][b] = min(nearest[a][b], nearest[a][middle] + nearest[middle][b])
    cycle = negative_cycle(edges)
    assert (cycle != []) == any(nearest[each][each] < 0 for each in range(count))
    if cycle:
        assert sum(each.weight for each in cycle) < 0
        assert all(one.later == other.earlier for one, other in zip(cycle, [*cycle[1:], cycle[0]], strict=True))


def test_a_chain_takes_two_rounds_in_whichever_order_it_is_written() -> None:
    chain = [edge(each, each + 1, -1) for each in range(20_000)]
    assert negative_cycle(chain) == negative_cycle(chain[::-1]) == []
