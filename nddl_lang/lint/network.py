"""The temporal side of a rule body: distances between the times of its tokens, and whether they can hold together.

A cycle of distances whose sum is negative has no solution, and only such a cycle has none (Dechter, Meiri, Pearl).
It is looked for with Bellman and Ford's algorithm, in a graph that is as small as one rule.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from nddl_lang.text.source import Span

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
    """The edges of a cycle with a negative sum, in order; none where all distances can hold together."""
    distance: dict[Node, float] = {}
    before: dict[Node, Edge] = {}
    for edge in edges:
        distance[edge.earlier] = distance[edge.later] = 0.0
    last: Node | None = None
    for _ in range(len(distance)):
        last = None
        for edge in edges:
            through = distance[edge.earlier] + edge.weight
            if through < distance[edge.later] - 1e-9:
                distance[edge.later] = through
                before[edge.later] = edge
                last = edge.later
        if last is None:
            return []
    if last is None:
        return []
    node = last
    for _ in range(len(distance)):  # from any node that still moves, this many steps back lead into the cycle
        node = before[node].earlier
    cycle: list[Edge] = []
    at = node
    while True:
        edge = before[at]
        cycle.append(edge)
        at = edge.earlier
        if at == node:
            return cycle[::-1]
