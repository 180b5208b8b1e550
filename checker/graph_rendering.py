"""A causal graph in; text for people, JSON for programs, DOT for Graphviz and a picture as SVG out."""

import textwrap
from collections import defaultdict
from html import escape
from typing import Any, assert_never

from checker.excerpts import Excerpts
from checker.explain import place_data
from checker.graph import CausalGraph, GraphNode, NodeKind, layers
from checker.rendering import element_line, event_line
from runtime.executive.outcome import Conflict, ConflictElement, Deadlock, Event, FailedChoice, OpenGoal
from runtime.executive.rendering import choice_text, deadlock_text, goal_text
from runtime.plan.readout.names import TokenName

_COLOURS = {
    NodeKind.SAMPLE: "#fff1c4",
    NodeKind.OBSERVATION: "#d9ecff",
    NodeKind.REQUEST: "#d9ecff",
    NodeKind.CONSTRAINT: "#e6f4e1",
    NodeKind.RULE: "#e6f4e1",
    NodeKind.CONFLICT: "#ffd9d2",
    NodeKind.DEADLOCK: "#ffd9d2",
    NodeKind.ABORT: "#ffb3a7",
    NodeKind.GOAL: "#ffb3a7",
}
_GREY = "#eeeeee"
_WIDE, _LINE, _GAP, _LETTER = 34, 15.0, 26.0, 6.6


def node_text(node: GraphNode) -> str:
    """What a node is about, in one line."""
    match node.subject:
        case Event() as event:
            return event_line(event)
        case ConflictElement() as element:
            return element_line(element)
        case Conflict(elements=elements):
            return f"{len(elements)} causes cannot hold together"
        case Deadlock() as deadlock:
            return deadlock_text(deadlock)
        case FailedChoice(choice=choice):
            return f"tried in vain: {choice_text(choice)}"
        case OpenGoal() as goal:
            return f"open goal {goal_text(goal)}"
        case TokenName() as token:
            return f"the rule of {token}" if node.kind is NodeKind.RULE else str(token)
        case _:
            assert_never(node.subject)


def graph_text(graph: CausalGraph) -> str:
    """Each node with its causes by number, causes first."""
    before = _causes(graph)
    by_number = {node.number: node for node in graph.nodes}
    lines = []
    for layer in layers(graph):
        for number in layer:
            node = by_number[number]
            when = f"tick {node.tick}, " if node.tick is not None else ""
            where = f"  {node.place.file}:{node.place.line}" if node.place is not None else ""
            causes = f"  <- {', '.join(map(str, before[number]))}" if before[number] else ""
            lines.append(f"{number:>5}  {node.kind}: {when}{node_text(node)}{where}{causes}")
    return "\n".join(lines) + "\n"


def graph_data(graph: CausalGraph, excerpts: Excerpts) -> dict[str, Any]:
    """Nodes and edges; an edge leads from a cause to what it caused."""
    return {
        "nodes": [
            {
                "id": node.number,
                "kind": node.kind.value,
                "text": node_text(node),
                "tick": node.tick,
                "reactor": node.reactor,
                "place": place_data(node.place, excerpts),
            }
            for node in graph.nodes
        ],
        "edges": [list(edge) for edge in graph.edges],
        "ends": list(graph.ends),
    }


def graph_dot(graph: CausalGraph) -> str:
    """The graph in Graphviz' language."""
    lines = ["digraph causes {", "  rankdir=TB;", '  node [shape=box, style=filled, fontname="sans-serif"];']
    for node in graph.nodes:
        label = "\\n".join(_quoted(line) for line in _label(node))
        lines.append(f'  n{node.number} [label="{label}", fillcolor="{_COLOURS.get(node.kind, _GREY)}"];')
    lines += [f"  n{one} -> n{other};" for one, other in graph.edges]
    return "\n".join([*lines, "}"]) + "\n"


def graph_svg(graph: CausalGraph) -> str:
    """The graph as a picture: causes above what they caused, each layer in the order that crosses least."""
    by_number = {node.number: node for node in graph.nodes}
    before = _causes(graph)
    column = _WIDE * _LETTER + _GAP
    place: dict[int, tuple[float, float, float]] = {}
    top = _GAP
    order: dict[int, float] = {}
    for layer in layers(graph):
        # The mean of the causes' places: the barycentre heuristic of Sugiyama.
        means = {
            one: sum(order[k] for k in before[one]) / len(before[one]) if before[one] else float(number)
            for number, one in enumerate(layer)
        }
        tallest = 0.0
        for number, one in enumerate(sorted(layer, key=lambda one: (means[one], one))):
            order[one] = float(number)
            height = _LINE * len(_label(by_number[one])) + 10.0
            place[one] = (_GAP + number * column, top, height)
            tallest = max(tallest, height)
        top += tallest + 2 * _GAP
    width = max((x for x, _, _ in place.values()), default=0.0) + column
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {top:.0f}" '
        'font-family="sans-serif" font-size="12">',
        '<defs><marker id="to" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
        '<path d="M0 0 8 4 0 8z" fill="#666"/></marker></defs>',
    ]
    middle = (column - _GAP) / 2
    for one, other in graph.edges:
        (x1, y1, height), (x2, y2, _) = place[one], place[other]
        start, end = y1 + height, y2
        parts.append(
            f'<path d="M{x1 + middle:.1f} {start:.1f}C{x1 + middle:.1f} {start + _GAP:.1f} '
            f'{x2 + middle:.1f} {end - _GAP:.1f} {x2 + middle:.1f} {end:.1f}" '
            'fill="none" stroke="#666" marker-end="url(#to)"/>'
        )
    for number, (x, y, height) in place.items():
        node = by_number[number]
        parts.append(
            f'<g><title>{escape(node_text(node))}</title><rect x="{x:.1f}" y="{y:.1f}" width="{column - _GAP:.1f}" '
            f'height="{height:.1f}" rx="4" fill="{_COLOURS.get(node.kind, _GREY)}" stroke="#666"/>'
        )
        for line, text in enumerate(_label(node), 1):
            parts.append(f'<text x="{x + 6:.1f}" y="{y + line * _LINE:.1f}">{escape(text)}</text>')
        parts.append("</g>")
    return "\n".join([*parts, "</svg>"]) + "\n"


def _label(node: GraphNode) -> list[str]:
    """A node in short lines: what it is and when, what it says, where that is written."""
    head = f"{node.kind}" if node.tick is None else f"{node.kind}, tick {node.tick}"
    lines = [head, *textwrap.wrap(node_text(node), _WIDE, max_lines=3, placeholder=" ...")]
    if node.place is not None:
        lines.append(f"{node.place.file}:{node.place.line}"[-_WIDE:])
    return lines


def _causes(graph: CausalGraph) -> dict[int, list[int]]:
    found: dict[int, list[int]] = defaultdict(list)
    for one, other in graph.edges:
        found[other].append(one)
    return found


def _quoted(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')
