"""The causal graph of missions that fail: from draws, through what others published, to the end."""

import json
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import networkx as nx
import pytest

from checker.flight import fly_programs
from checker.graph import CausalGraph, NodeKind, causal_graph, focused, layers
from checker.graph_rendering import graph_dot, graph_svg, graph_text, node_text
from checker.mission import read_mission
from checker.models import load_models
from checker.pinned import pinned
from nddlc.main import run
from runtime.executive.outcome import Outcome
from tests.checker.test_causes import FACT, GOAL, MISSION, MODEL

GPS = Path("models/gps").resolve()


@pytest.fixture(scope="module")
def late() -> Outcome:
    """A mission in which the satellite receiver is so slow that a surfacing takes too long."""
    mission, _ = read_mission(GPS / "mission.toml")
    assert mission is not None
    models = load_models(mission)
    return fly_programs(models.agent, pinned(models).programs_of(models.agent), 7, {"GPS_HIT_RATE": 3.9})


def ancestors(graph: CausalGraph) -> "nx.DiGraph[int]":
    network: nx.DiGraph[int] = nx.DiGraph(graph.edges)
    assert nx.is_directed_acyclic_graph(network)
    return network


def test_the_draw_in_the_simulator_leads_to_the_abort_of_the_navigator(late: Outcome) -> None:
    graph = causal_graph(late)
    by_number = {node.number: node for node in graph.nodes}
    (end,) = graph.ends
    assert by_number[end].kind is NodeKind.ABORT and by_number[end].reactor == "navigator"
    behind = nx.ancestors(ancestors(graph), end)
    texts = [node_text(by_number[number]) for number in behind]
    assert any("GPS_HIT_RATE" in text for text in texts)
    kinds = {by_number[number].kind for number in behind}
    assert kinds >= {NodeKind.SAMPLE, NodeKind.OBSERVATION, NodeKind.REQUEST, NodeKind.CONSTRAINT, NodeKind.CONFLICT}
    lines = {
        (node.place.file, node.place.line) for node in map(by_number.__getitem__, behind) if node.place is not None
    }
    assert {("rules.nddl", 34), ("psim.nddl", 41)} <= lines


def test_levels_show_more_and_more_and_keep_what_led_where(late: Outcome) -> None:
    graph = causal_graph(late)
    plain, tokens, everything = (focused(graph, level) for level in range(3))
    assert len(plain.nodes) < len(tokens.nodes) < len(everything.nodes) == len(graph.nodes)
    assert not {node.kind for node in plain.nodes} & {NodeKind.TOKEN, NodeKind.RULE}
    whole, bridged = ancestors(graph), ancestors(plain)
    (end,) = graph.ends
    assert nx.ancestors(bridged, end) == nx.ancestors(whole, end) & {node.number for node in plain.nodes}


def test_causes_stand_in_earlier_layers(late: Outcome) -> None:
    graph = focused(causal_graph(late), 0)
    at = {number: depth for depth, layer in enumerate(layers(graph)) for number in layer}
    assert len(at) == len(graph.nodes)
    assert all(at[one] < at[other] for one, other in graph.edges)


def test_it_is_drawn_as_text_dot_and_svg(late: Outcome) -> None:
    graph = focused(causal_graph(late), 0)
    text = graph_text(graph)
    assert len(text.splitlines()) == len(graph.nodes)
    assert re.search(r"abort: tick \d+, navigator.*<- ", text)
    dot = graph_dot(graph)
    assert dot.count(" -> n") == len(graph.edges) and dot.startswith("digraph")
    root = ET.fromstring(graph_svg(graph))
    boxes = root.findall(".//{http://www.w3.org/2000/svg}rect")
    assert len(boxes) == len(graph.nodes)
    corners = {(box.get("x"), box.get("y")) for box in boxes}
    assert len(corners) == len(boxes), "no box hides another"


@pytest.mark.parametrize("code", ["F4", "F10"])
def test_what_the_search_tried_in_vain_leads_to_the_end(
    code: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    goals = "" if code == "F4" else GOAL.format(5)
    (tmp_path / "planner.nddl").write_text(MODEL.replace("close();", FACT) if code == "F4" else MODEL)
    (tmp_path / "mission.toml").write_text(MISSION + goals)
    assert run(["check", "mission.toml", "--missions", "1"]) == 1
    capsys.readouterr()
    assert run(["explain", "--format", "json", "--flights", "0"]) == 0
    plain = json.loads(capsys.readouterr().out)["graph"]
    network: nx.DiGraph[int] = nx.DiGraph(plain["edges"])
    nodes = {node["id"]: node for node in plain["nodes"]}
    behind = [nodes[number] for end in plain["ends"] for number in nx.ancestors(network, end)]
    assert {"tried", "deadlock", "constraint"} <= {node["kind"] for node in behind}
    assert {node["place"]["line"] for node in behind if node["place"] is not None} >= {10, 14}


def test_a_mission_that_passed_has_nothing_to_draw(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "planner.nddl").write_text(MODEL.replace("RUN_MAX = 12", "RUN_MAX = 30"))
    (tmp_path / "mission.toml").write_text(MISSION + GOAL.format(5))
    assert run(["check", "mission.toml", "--missions", "1"]) == 0
    assert run(["explain", "latest#1", "--format", "svg"]) == 2
    assert "did not fail" in capsys.readouterr().err
