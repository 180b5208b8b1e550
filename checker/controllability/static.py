"""Strong controllability: one schedule for all durations. Weak: some schedule for all that are known beforehand."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

from checker.controllability.network import RequirementEdge, UncertainNetwork

_MOST_LINKS = 16  # of which every combination of ends is looked at


def is_strongly_controllable(network: UncertainNetwork) -> bool:
    """Whether one schedule of what is chosen will do, whatever the durations are.

    Each time is one that is chosen, and durations behind it. An edge holds for all of them if it holds for the worst.
    """
    behind: dict[int, tuple[int, tuple[int, ...]]] = {}
    ends = {link.end: number for number, link in enumerate(network.links)}

    def origin(point: int) -> tuple[int, tuple[int, ...]]:
        chain: list[int] = []
        while point in ends and len(chain) <= len(network.links):
            chain.append(ends[point])
            point = network.links[ends[point]].start
        return point, tuple(chain)

    for point in range(network.points):
        behind[point] = origin(point)
    edges = []
    for edge in network.edges:
        (first, before), (second, after) = behind[edge.earlier], behind[edge.later]
        least = sum(network.links[number].lower for number in before if number not in after)
        most = sum(network.links[number].upper for number in after if number not in before)
        edges.append(RequirementEdge(first, second, edge.weight - most + least))
    return is_consistent(network.points, edges)


def joined(network: UncertainNetwork) -> UncertainNetwork:
    """The network with one point for all that are one time by demand: what ends as a link ends is chosen by nobody.

    Points stay apart where a demand within them contradicts that, or where they are the ends of several links.
    """
    least = {(edge.earlier, edge.later) for edge in network.edges if edge.weight <= 0}
    groups = {point: {point} for point in range(network.points)}
    for a, b in least:
        if (b, a) in least and groups[a] is not groups[b]:
            groups[a] |= groups[b]
            groups.update(dict.fromkeys(groups[b], groups[a]))
    ends = {link.end for link in network.links}
    standing = list(range(network.points))
    for group in {id(each): each for each in groups.values() if len(each) > 1}.values():
        inner = [edge.weight for edge in network.edges if edge.earlier in group and edge.later in group]
        tied = [link for link in network.links if link.start in group and link.end in group]
        if min(inner) == 0 and not tied and len(group & ends) + (0 in group) <= 1:
            for point in group:
                standing[point] = min(group)
    edges = [replace(one, earlier=standing[one.earlier], later=standing[one.later]) for one in network.edges]
    links = [replace(one, start=standing[one.start], end=standing[one.end]) for one in network.links]
    return UncertainNetwork(network.points, edges, links)


def is_weakly_controllable(network: UncertainNetwork) -> bool | None:
    """Whether for each choice of durations there is a schedule; None where there are too many links to tell.

    The durations for which there is one are a convex set: it has the whole box if it has all its corners.
    """
    if len(network.links) > _MOST_LINKS:
        return None
    for ends in product((0, 1), repeat=len(network.links)):
        fixed = []
        for link, end in zip(network.links, ends, strict=True):
            length = link.upper if end else link.lower
            fixed.append(RequirementEdge(link.start, link.end, length))
            fixed.append(RequirementEdge(link.end, link.start, -length))
        if not is_consistent(network.points, [*network.edges, *fixed]):
            return False
    return True


def is_consistent(points: int, edges: Sequence[RequirementEdge]) -> bool:
    """Whether a simple temporal network has a solution (Bellman and Ford)."""
    distance = [0] * points
    for _ in range(points + 1):
        is_stable = True
        for edge in edges:
            through = distance[edge.earlier] + edge.weight
            if through < distance[edge.later]:
                distance[edge.later] = through
                is_stable = False
        if is_stable:
            return True
    return False
