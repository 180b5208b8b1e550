"""The temporal side of a rule body: distances between the times of its tokens, and whether they can hold together.

A cycle of distances whose sum is negative has no solution, and only such a cycle has none (Dechter, Meiri, Pearl).
It is looked for with Bellman and Ford's algorithm; every second round goes backwards (Yen), so that chains take two.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from nddl_lang.text.source import Span

_TOLERANCE = 1e-4  # floats that differ by less may count as equal
Node = tuple[object, str]  # a token with `start` or `end`; an event has only `start`


@dataclass(frozen=True, eq=False, slots=True)
class Edge:
    """time of `later` - time of `earlier` <= `weight`; `why` says so in words, `span` is where the text says it."""

    earlier: Node
    later: Node
    weight: float
    why: str
    span: Span | None
    is_duration: bool = False
    is_containment: bool = False


def negative_cycle(edges: Sequence[Edge]) -> list[Edge]:
    """The edges of a cycle with a negative sum, in order; none where all distances can hold together.

    Of several edges between two times the tightest counts, of equal ones the first.
    """
    tightest: dict[tuple[Node, Node], Edge] = {}
    for edge in edges:
        known = tightest.get((edge.earlier, edge.later))
        if known is None or edge.weight < known.weight:
            tightest[edge.earlier, edge.later] = edge
    edges = list(tightest.values())
    distance: dict[Node, float] = {}
    before: dict[Node, Edge] = {}
    for edge in edges:
        distance[edge.earlier] = distance[edge.later] = 0.0
    for number in range(len(distance) + 1):
        is_changed = False
        for edge in edges if number % 2 == 0 else reversed(edges):
            through = distance[edge.earlier] + edge.weight
            if through < distance[edge.later] - _TOLERANCE:
                distance[edge.later] = through
                before[edge.later] = edge
                is_changed = True
        if not is_changed:
            return []
        if cycle := _cycle_of(before):
            return cycle
    return []


def _cycle_of(before: dict[Node, Edge]) -> list[Edge]:
    """A cycle among the edges by which nodes were reached last; its sum is negative."""
    done: dict[Node, Node] = {}  # by node, where the walk began that met it
    for begin in before:
        at = begin
        while at in before and at not in done:
            done[at] = begin
            at = before[at].earlier
        if done.get(at) == begin and at in before:
            cycle = [before[at]]
            while cycle[-1].earlier != at:
                cycle.append(before[cycle[-1].earlier])
            return cycle[::-1]
    return []
