"""The causal graph of a mission: an outcome in; samples, observations, tokens, rules, conflicts and the end out.

Edges are recorded causes. Events name the events that caused them; a conflict is made of its elements, an element of
the rule that posted it for a token; what an element observed, drew or was asked leads to that event, and so into the
reactor that published, and to who asked for it.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from itertools import chain, islice

import networkx as nx

from runtime.executive.outcome import (
    Conflict,
    ConflictElement,
    Deadlock,
    ElementKind,
    Event,
    EventKind,
    FailedChoice,
    OpenGoal,
    Outcome,
    SourcePlace,
)
from runtime.plan.readout.names import TokenName
from runtime.plan.readout.statements import Argument


class NodeKind(StrEnum):
    """What a node of the graph is."""

    SAMPLE = "sample"
    OBSERVATION = "observation"
    REQUEST = "request"
    DECISION = "decision"  # of the planner or the executive
    TOKEN = "token"
    RULE = "rule"  # an instance: the rule of a token
    CONSTRAINT = "constraint"  # with relations, durations, assignments, resources
    CONFLICT = "conflict"
    TRIED = "tried"  # a choice of the search that failed
    DEADLOCK = "deadlock"  # no choice is left
    REPAIR = "repair"
    REFUSAL = "refusal"  # of a request or goal: refused, rejected, recalled
    GOAL = "goal"  # that stayed open
    ABORT = "abort"


Subject = Event | ConflictElement | Conflict | Deadlock | FailedChoice | OpenGoal | TokenName

_EVENTS = {
    EventKind.SAMPLE: NodeKind.SAMPLE,
    EventKind.OBSERVATION: NodeKind.OBSERVATION,
    EventKind.ACHIEVED: NodeKind.OBSERVATION,
    EventKind.REQUEST: NodeKind.REQUEST,
    EventKind.RECALL: NodeKind.REFUSAL,
    EventKind.REFUSE: NodeKind.REFUSAL,
    EventKind.REJECT: NodeKind.REFUSAL,
    EventKind.RELAX: NodeKind.REPAIR,
    EventKind.KILL: NodeKind.ABORT,
    EventKind.ABORT: NodeKind.ABORT,
    EventKind.END: NodeKind.ABORT,
}
_DECIDED = (ElementKind.ORDER, ElementKind.DECISION, ElementKind.LONGEST, ElementKind.CLOCK)
_PLAIN = (NodeKind.TOKEN, NodeKind.RULE)  # left out where only the conflict is shown


@dataclass(frozen=True, slots=True)
class GraphNode:
    """A node: `number` counts from 0 in the order of making; `tick` and `reactor` where they are known."""

    number: int
    kind: NodeKind
    subject: Subject
    tick: int | None = None
    reactor: str = ""
    place: SourcePlace | None = None


@dataclass(frozen=True, eq=False, slots=True)
class CausalGraph:
    """Nodes by number, and who caused whom, as pairs of numbers; `ends` are what the mission came to."""

    nodes: tuple[GraphNode, ...]
    edges: tuple[tuple[int, int], ...]
    ends: tuple[int, ...]


def causal_graph(outcome: Outcome) -> CausalGraph:
    """The whole graph of a mission that failed."""
    made = _Maker(outcome)
    return CausalGraph(tuple(made.nodes), tuple(sorted(made.edges)), tuple(made.ends))


def focused(graph: CausalGraph, level: int) -> CausalGraph:
    """What led to the end: at level 0 events and conflicts with what they are made of, at 1 tokens and rules too.

    At level 2 everything that happened is kept. What is left out is bridged: causes of it become causes of its effects.
    """
    if level > 1:
        return graph
    whole: nx.DiGraph[int] = nx.DiGraph()
    whole.add_nodes_from(range(len(graph.nodes)))
    whole.add_edges_from(graph.edges)
    kept = set(graph.ends)
    for end in graph.ends:
        kept |= nx.ancestors(whole, end)
    whole = whole.subgraph(kept).copy()
    if level == 0:
        for number in sorted(kept):
            if graph.nodes[number].kind in _PLAIN:
                before, after = list(whole.predecessors(number)), list(whole.successors(number))
                whole.remove_node(number)
                whole.add_edges_from((one, other) for one in before for other in after if one != other)
    nodes = tuple(graph.nodes[number] for number in sorted(whole.nodes))
    return CausalGraph(nodes, tuple(sorted(whole.edges)), graph.ends)


def layers(graph: CausalGraph) -> list[list[int]]:
    """The numbers of the nodes in layers, causes before effects: the longest way from a root decides."""
    network: nx.DiGraph[int] = nx.DiGraph()
    network.add_nodes_from(node.number for node in graph.nodes)
    network.add_edges_from(graph.edges)
    return [sorted(layer) for layer in nx.topological_generations(network)]


class _Maker:
    """Makes the nodes and edges of one outcome."""

    def __init__(self, outcome: Outcome) -> None:
        self.nodes: list[GraphNode] = []
        self.edges: set[tuple[int, int]] = set()
        self.ends: list[int] = []
        self._events: list[int] = []
        self._end = len(outcome.events)  # of what is made now: what came later did not cause it
        self._tokens: dict[tuple[str, TokenName], int] = {}
        self._rules: dict[tuple[str, TokenName, str], int] = {}
        for event in outcome.events:
            self._event(event)
        if outcome.abort is not None:
            for repair in outcome.abort.repairs:
                self._join(self._conflict(repair, outcome.abort.reactor, outcome.abort.tick), self.ends[-1:])
        for goal in outcome.open_goals:
            self._goal(goal, outcome.last_tick)

    def _node(
        self, kind: NodeKind, subject: Subject, tick: int | None, reactor: str, place: SourcePlace | None = None
    ) -> int:
        self.nodes.append(GraphNode(len(self.nodes), kind, subject, tick, reactor, place))
        return len(self.nodes) - 1

    def _join(self, cause: int, effects: list[int]) -> None:
        self.edges.update((cause, effect) for effect in effects if cause != effect)

    def _event(self, event: Event) -> None:
        causes = [self._events[cause] for cause in event.causes]
        parts = [self._conflict(event.conflict, event.reactor, event.tick)] if event.conflict is not None else []
        if event.deadlock is not None:
            parts.append(self._deadlock(event.deadlock, event.reactor, event.tick))
        number = self._node(_EVENTS[event.kind], event, event.tick, event.reactor)
        self._events.append(number)
        for cause in (*causes, *parts):
            self._join(cause, [number])
        if event.kind in (EventKind.ABORT, EventKind.KILL) or (event.kind is EventKind.END and event.code):
            self.ends.append(number)

    def _goal(self, goal: OpenGoal, tick: int) -> None:
        number = self._node(NodeKind.GOAL, goal, tick, "")
        if goal.event >= 0:
            self._join(self._events[goal.event], [number])
        self._end = goal.event + 1 if goal.event >= 0 else len(self._events)
        if goal.conflict is not None:
            self._join(self._conflict(goal.conflict, "", tick), [number])
        if goal.deadlock is not None:
            self._join(self._deadlock(goal.deadlock, "", tick), [number])
        if not self.ends:
            self.ends.append(number)
        elif self._is_over():
            self._join(number, self.ends[-1:])

    def _is_over(self) -> bool:
        """Whether the mission came to its end, so that open goals are why it failed."""
        end = self.nodes[self.ends[-1]].subject
        return isinstance(end, Event) and end.kind is EventKind.END

    def _deadlock(self, deadlock: Deadlock, reactor: str, tick: int) -> int:
        causes = []
        for choice in deadlock.tried:
            parts = [self._conflict(choice.conflict, reactor, tick)] if choice.conflict is not None else []
            if choice.leads_to is not None:
                parts.append(self._deadlock(choice.leads_to, reactor, tick))
            number = self._node(NodeKind.TRIED, choice, tick, reactor)
            for part in parts:
                self._join(part, [number])
            causes.append(number)
        number = self._node(NodeKind.DEADLOCK, deadlock, tick, reactor)
        for cause in causes:
            self._join(cause, [number])
        return number

    def _conflict(self, conflict: Conflict, reactor: str, tick: int) -> int:
        elements = [self._element(element, reactor, tick) for element in conflict.elements]
        number = self._node(NodeKind.CONFLICT, conflict, tick, reactor)
        for element in elements:
            self._join(element, [number])
        return number

    def _element(self, element: ConflictElement, reactor: str, tick: int) -> int:
        kind = NodeKind.DECISION if element.kind in _DECIDED else NodeKind.CONSTRAINT
        reactor = _reactor_of(element) or reactor
        number = self._node(kind, element, None, reactor, element.place)
        for source in self._sources(element):
            self._join(source, [number])
        if element.token is not None:
            token = self._token(element.token, reactor)
            if element.rule and element.place is not None:
                key = (reactor, element.token, element.rule)
                if key not in self._rules:
                    self._rules[key] = self._node(NodeKind.RULE, element.token, None, reactor)
                    self._join(token, [self._rules[key]])
                token = self._rules[key]
            self._join(token, [number])
        return number

    def _token(self, token: TokenName, reactor: str) -> int:
        key = (reactor, token)
        if key not in self._tokens:
            self._tokens[key] = self._node(NodeKind.TOKEN, token, None, reactor)
            about = self._latest_of(token, (EventKind.OBSERVATION, EventKind.REQUEST))
            if about is not None:
                self._join(about, [self._tokens[key]])
        return self._tokens[key]

    def _sources(self, element: ConflictElement) -> Iterator[int]:
        """The events that an element comes from: a draw, what was observed, what was asked for."""
        for term in element.terms:
            if term.name == "sampledParameter":
                name, value = str(term.arguments[1]), term.arguments[2]
                meant = (number for number in self._past() if self._drew(number, name, value))
                drawn = (number for number in self._past() if self._drew(number, name))
                yield from islice(chain(meant, drawn), 1)
        found: int | None = None
        if element.observed is not None:
            found = self._latest(*element.observed)
        elif element.token is not None and element.kind in (ElementKind.OBSERVATION, ElementKind.REQUEST):
            wanted = EventKind.OBSERVATION if element.kind is ElementKind.OBSERVATION else EventKind.REQUEST
            found = self._latest_of(element.token, (wanted,))
        if found is not None:
            yield found

    def _past(self) -> Iterator[int]:
        """The events so far, the latest first."""
        last = min(self._end, len(self._events)) - 1
        return (self._events[index] for index in range(last, -1, -1))

    def _drew(self, number: int, parameter: str, value: Argument | None = None) -> bool:
        event = self.nodes[number].subject
        draw = event.draw if isinstance(event, Event) else None
        return draw is not None and draw.parameter == parameter and value in (None, draw.value)

    def _latest(self, predicate: str, timeline: str) -> int | None:
        """The last time that a timeline was seen to hold a predicate."""
        for number in self._past():
            event = self.nodes[number].subject
            assert isinstance(event, Event)
            if (event.kind, event.predicate, event.timeline) == (EventKind.OBSERVATION, predicate, timeline):
                return number
        return None

    def _latest_of(self, token: TokenName, kinds: tuple[EventKind, ...]) -> int | None:
        """The last event of these kinds that is about a token of the same class and predicate."""
        for number in self._past():
            event = self.nodes[number].subject
            assert isinstance(event, Event)
            if event.kind in kinds and event.token is not None and event.token.predicate == token.predicate:
                return number
        return None


def _reactor_of(element: ConflictElement) -> str:
    """The reactor whose plan an element is about, if it names a variable."""
    return next((one.reactor for one in element.variables), "")
