"""Controllability by definition, for small networks: the game against the vehicle, tick by tick, played to its end."""

from collections.abc import Iterator
from itertools import chain, combinations

import numpy as np

from checker.controllability.network import ContingentLink, UncertainNetwork

Times = tuple[int | None, ...]


def random_network(chance: np.random.Generator) -> UncertainNetwork:
    """A network of three to five points, of which one or two are ends of links."""
    links = int(chance.integers(1, 3))
    free = int(chance.integers(2, 4))
    network = UncertainNetwork(free + links)

    for number in range(links):
        start = int(chance.integers(0, free + number))
        lower = int(chance.integers(1, 3))
        network.links.append(
            ContingentLink(start, free + number, lower, lower + int(chance.integers(0, 4)), f"link {number}")
        )
    for _ in range(int(chance.integers(2, 6))):
        a, b = chance.choice(network.points, 2, replace=False).tolist()
        lower = int(chance.integers(-3, 4))
        network.between(a, b, lower, lower + int(chance.integers(0, 7)), f"{a} to {b}")
    return network


def wins(network: UncertainNetwork, horizon: int) -> bool:
    """Whether the one who chooses can keep all edges: the vehicle moves first in each tick, and is answered at once."""
    ends = {link.end: link for link in network.links}
    seen: dict[tuple[int, Times], bool] = {}

    def holds(times: Times) -> bool:
        for edge in network.edges:
            a, b = times[edge.earlier], times[edge.later]
            if a is not None and b is not None and b - a > edge.weight:
                return False
        return True

    def play(tick: int, times: Times) -> bool:
        if None not in times:
            return True
        if tick > horizon:
            return False
        key = (tick, times)
        if key not in seen:
            seen[key] = all(answer(tick, moved) for moved in moves(tick, times))
        return seen[key]

    def moves(tick: int, times: Times) -> Iterator[Times]:
        """What the vehicle may do."""
        may: list[int] = []
        must: list[int] = []
        for end, link in ends.items():
            start = times[link.start]
            if times[end] is None and start is not None and start + link.lower <= tick:
                (must if tick == start + link.upper else may).append(end)
        for chosen in subsets(may):
            yield put(times, (*must, *chosen), tick)

    def answer(tick: int, times: Times) -> bool:
        if not holds(times):
            return False
        free = [point for point in range(network.points) if times[point] is None and point not in ends]
        if tick == 0:  # to wait before the first point changes nothing
            return any(play(1, after) for chosen in subsets(free) if chosen and holds(after := put(times, chosen, 0)))
        return any(holds(after := put(times, chosen, tick)) and play(tick + 1, after) for chosen in subsets(free))

    return play(0, (None,) * network.points)


def subsets(things: list[int]) -> Iterator[tuple[int, ...]]:
    """All subsets."""
    return chain.from_iterable(combinations(things, size) for size in range(len(things) + 1))


def put(times: Times, points: tuple[int, ...], tick: int) -> Times:
    """The times with some points at a tick."""
    return tuple(tick if number in points else time for number, time in enumerate(times))
