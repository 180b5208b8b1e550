"""An abort in, its causal graph out: which draws and events led to it, and which line of the model is to blame.

Two graphs: events of the trace point at what they caused (across reactors), and the causes of the conflict hang
together by the variables they share (inside the reactor that gave up). "Future work" of the founding paper, section 6.
"""

import re
from dataclasses import dataclass

import networkx as nx

from runtime.executive.outcome import Cause, Conflict, Event, Outcome, Place

WORLD = ("sample", "observation", "clock", "horizon")  # kinds of causes that no line of the model can help
LIMITS = ("leq", "lt", "neq", "bounds", "withinBounds", "precedes", "strictlyPrecedes")
MOST_EVENTS = 8  # of the way to the abort, the last ones


@dataclass(frozen=True, slots=True)
class Blame:
    """The line that the conflict ends at, and the lines that set what it compares with."""

    place: Place | None
    because: str
    limits: tuple[Place, ...]


def blame(conflict: Conflict | None) -> Blame:
    """The written limit that stands farthest from what the world did: where draw and model collide."""
    if conflict is None:
        return Blame(None, "", ())
    index = culprit(conflict)
    if index is None:
        return Blame(None, "", ())
    chosen = conflict.causes[index]
    near = conflict_graph(conflict).adj[index]
    limits = [
        cause.place
        for number, cause in enumerate(conflict.causes)
        if number in near and cause.kind in ("assignment", "declaration") and cause.place not in (None, chosen.place)
    ]
    return Blame(chosen.place, chosen.because, tuple(place for place in dict.fromkeys(limits) if place))


def culprit(conflict: Conflict) -> int | None:
    """The number of the cause to blame; None where no cause is written anywhere."""
    graph = conflict_graph(conflict)
    roots = [number for number, cause in enumerate(conflict.causes) if cause.kind == "sample"]
    roots = roots or [number for number, cause in enumerate(conflict.causes) if cause.kind in WORLD]
    far: dict[int, float] = nx.multi_source_dijkstra_path_length(graph, roots) if roots else {}
    candidates = [
        (_rank(cause), -far.get(number, len(conflict.causes)), -number)
        for number, cause in enumerate(conflict.causes)
        if cause.place is not None and cause.kind not in WORLD
    ]
    return -min(candidates)[2] if candidates else None


def in_telling_order(conflict: Conflict) -> list[int]:
    """The numbers of the causes, from the draws outwards, the line to blame last; as given where nothing was drawn."""
    graph = conflict_graph(conflict)
    roots = [number for number, cause in enumerate(conflict.causes) if cause.kind == "sample"]
    far: dict[int, float] = nx.multi_source_dijkstra_path_length(graph, roots) if roots else {}
    last = culprit(conflict)
    return sorted(
        graph, key=lambda number: (number == last, far.get(number, len(conflict.causes) if roots else 0), number)
    )


def conflict_graph(conflict: Conflict) -> "nx.Graph[int]":
    """The causes by number, joined where they speak of the same variable."""
    names = {variable.name for variable in conflict.variables}
    graph: nx.Graph[int] = nx.Graph()
    graph.add_nodes_from(range(len(conflict.causes)))
    speakers: dict[str, list[int]] = {}
    for number, cause in enumerate(conflict.causes):
        for term in cause.terms:
            for argument in term.arguments:
                if isinstance(argument, str) and argument in names:
                    for other in speakers.setdefault(argument, []):
                        if other != number:
                            graph.add_edge(other, number)
                    speakers[argument].append(number)
    return graph


def event_graph(events: tuple[Event, ...]) -> "nx.DiGraph[int]":
    """The events of a trace by index, each with arrows to what it caused."""
    graph: nx.DiGraph[int] = nx.DiGraph()
    graph.add_nodes_from(range(len(events)))
    for index, event in enumerate(events):
        graph.add_edges_from((cause, index) for cause in event.causes)
    return graph


def events_to_abort(outcome: Outcome, parameters: tuple[str, ...]) -> tuple[int, ...]:
    """Indices of the events on the way from a draw to the abort, in order, the abort left out.

    From the draw of the first of `parameters` that is connected with the abort; else from whatever draw is; else the
    latest cause of each event, backwards. Of a long way, its root and its end.
    """
    if outcome.abort is None or not outcome.events:
        return ()
    graph = event_graph(outcome.events)
    target = outcome.abort.event
    ancestors: set[int] = nx.ancestors(graph, target)
    draws = {index: _drawn(outcome.events[index]) for index in sorted(ancestors, reverse=True)}
    wanted = [index for name in parameters for index, drawn in draws.items() if drawn == name]
    wanted += [index for index, drawn in draws.items() if drawn is not None]
    if wanted:
        way: list[int] = nx.shortest_path(graph, wanted[0], target)[:-1]
    else:
        way = []
        current = target
        while causes := outcome.events[current].causes:
            current = max(causes)
            way.insert(0, current)
    return tuple(way if len(way) <= MOST_EVENTS else [way[0], *way[1 - MOST_EVENTS :]])


def draws_behind(outcome: Outcome) -> tuple[str, ...]:
    """The parameters that the abort depends on by the conflict's terms, or, failing those, by the trace."""
    if outcome.abort is None:
        return ()
    causes = outcome.abort.conflict.causes if outcome.abort.conflict is not None else ()
    names = [str(t.arguments[1]) for cause in causes for t in cause.terms if t.name == "sampledParameter"]
    if not names and outcome.events:
        ancestors: set[int] = nx.ancestors(event_graph(outcome.events), outcome.abort.event)
        drawn = (_drawn(outcome.events[index]) for index in sorted(ancestors))
        names = [name for name in drawn if name is not None]
    return tuple(dict.fromkeys(names))


def _drawn(event: Event) -> str | None:
    """The parameter that a sample event is about; its text is `NAME = value`."""
    found = re.match(r"(\w+) = ", event.text) if event.kind == "sample" else None
    return found[1] if found else None


def _rank(cause: Cause) -> int:
    """How likely a line is the mistaken one: written limits before values before relations before the rest."""
    is_limit = any(term.name in LIMITS for term in cause.terms)
    match cause.kind:
        case "constraint" | "duration" if is_limit:
            return 0
        case "assignment" | "declaration":
            return 1
        case "relation" | "order":
            return 2
        case _:
            return 3
