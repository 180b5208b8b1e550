"""Controllability agrees with the game played to its end; its cycles are enough; the command tells of missions."""

import json
import os
import shutil
from dataclasses import replace
from itertools import product
from math import inf
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

from checker.controllability.dynamic import offending_cycle
from checker.controllability.network import ContingentLink, RequirementEdge, UncertainNetwork
from checker.controllability.static import is_consistent, is_strongly_controllable, is_weakly_controllable, joined
from checker.proofs.intervals import Ranges
from nddlc.controllability import command
from nddlc.inputs import Unusable
from tests.checker.controllability_games import random_network, wins

pytestmark = pytest.mark.once

GPS = Path(__file__).parents[2] / "models" / "gps"
DEADLINE = GPS.parent / "templates" / "deadline"
# The 10^4 networks of the goal: NDDLC_PROOFS=10000.
MOST = int(os.environ.get("NDDLC_PROOFS", "300"))
HORIZON = 20
FURTHEST = 9  # the greatest weight that `random_network` gives an edge


def networks(seed: int, count: int = MOST) -> list[UncertainNetwork]:
    chance = np.random.default_rng(seed)
    return [random_network(chance) for _ in range(count)]


def some_schedule(network: UncertainNetwork, lengths: tuple[int, ...]) -> bool:
    """Whether there is a schedule for these durations."""
    fixed = [
        edge
        for link, length in zip(network.links, lengths, strict=True)
        for edge in (RequirementEdge(link.start, link.end, length), RequirementEdge(link.end, link.start, -length))
    ]
    return is_consistent(network.points, [*network.edges, *fixed])


def test_dynamic_controllability_is_to_win_the_game() -> None:
    answers = set()
    for network in networks(7):
        answer = offending_cycle(network) is None
        assert answer == wins(network, HORIZON), network
        answers.add(answer)
    assert answers == {True, False}


def test_weak_controllability_is_a_schedule_for_all_durations() -> None:
    for network in networks(8):
        ranges = [range(link.lower, link.upper + 1) for link in network.links]
        assert is_weakly_controllable(network) == all(some_schedule(network, each) for each in product(*ranges))


def test_strong_controllability_is_one_schedule_for_all_durations() -> None:
    answers = set()
    for network in networks(9):
        ends = {link.end for link in network.links}
        free = [point for point in range(network.points) if point not in ends]
        ranges = [range(link.lower, link.upper + 1) for link in network.links]
        # A schedule of shortest distances from the first point: at most four edges, none longer than FURTHEST.
        found = any(
            all(_keeps(network, times, each) for each in product(*ranges))
            for others in product(range(-4 * FURTHEST, 4 * FURTHEST + 1), repeat=len(free) - 1)
            if _may_stand(network, times := dict(zip(free, (0, *others), strict=True)))
        )
        assert is_strongly_controllable(network) == found, network
        answers.add(found)
    assert answers == {True, False}


def _may_stand(network: UncertainNetwork, times: dict[int, int]) -> bool:
    """Whether the times of what is chosen keep what is said of them alone."""
    return all(
        times[edge.later] - times[edge.earlier] <= edge.weight
        for edge in network.edges
        if edge.later in times and edge.earlier in times
    )


def _keeps(network: UncertainNetwork, times: dict[int, int], lengths: tuple[int, ...]) -> bool:
    times = dict(times)
    for link, length in zip(network.links, lengths, strict=True):
        times[link.end] = times[link.start] + length
    return all(times[edge.later] - times[edge.earlier] <= edge.weight for edge in network.edges)


def test_strong_is_dynamic_and_dynamic_is_weak() -> None:
    for network in networks(10):
        strong, dynamic = is_strongly_controllable(network), offending_cycle(network) is None
        assert dynamic or not strong
        assert is_weakly_controllable(network) or not dynamic


def test_times_that_are_one_are_chosen_once() -> None:
    """A second name for each time changes nothing but that what ends with a link is chosen by nobody."""
    answers = set()
    for network in networks(12):
        twice = UncertainNetwork(2 * network.points, list(network.edges), list(network.links))
        for point in range(network.points):
            twice.between(point, network.points + point, 0, 0)
        again = joined(twice)
        strong = is_strongly_controllable(again)
        assert strong == is_strongly_controllable(network)
        assert len({offending_cycle(each) is None for each in (again, twice, network)}) == 1
        assert is_weakly_controllable(again) == is_weakly_controllable(network)
        answers.add((strong, is_strongly_controllable(twice)))
    assert (True, False) in answers
    clash = UncertainNetwork(3, [], [ContingentLink(0, 1, 1, 2)])
    clash.between(1, 2, 0, 0)
    clash.between(1, 2, 1, None)
    assert not is_strongly_controllable(joined(clash))
    both = UncertainNetwork(3, [], [ContingentLink(0, 1, 1, 2), ContingentLink(0, 2, 1, 2)])
    both.between(1, 2, 0, 0)
    assert not is_strongly_controllable(joined(both))


def test_the_edges_of_the_cycle_are_enough() -> None:
    seen = 0
    for network in networks(11):
        network = UncertainNetwork(
            network.points, [replace(each, why=k) for k, each in enumerate(network.edges)], network.links
        )
        cycle = offending_cycle(network)
        if cycle is None:
            continue
        edges = [each for each in network.edges if each.why in cycle]
        links = [each for each in network.links if each.why in cycle]
        assert offending_cycle(UncertainNetwork(network.points, edges, links)) is not None
        seen += len(edges) < len(network.edges)
    assert seen


def test_one_who_must_know_beforehand_cannot() -> None:
    """The sonar has to be on 5 before the drive ends, which takes 10 to 20: weakly, not dynamically."""
    network = UncertainNetwork(3, [], [ContingentLink(0, 1, 10, 20, "drive")])
    network.between(2, 1, 5, 6, "sonar")
    assert is_weakly_controllable(network)
    assert not is_strongly_controllable(network)
    assert offending_cycle(network) is not None
    network.edges.clear()
    network.between(1, 2, 0, 1, "sonar")
    assert offending_cycle(network) is None
    assert not is_strongly_controllable(network)


def test_a_long_chain_needs_no_deep_stack() -> None:
    network = UncertainNetwork(3001)
    for k in range(1500):
        network.links.append(ContingentLink(2 * k, 2 * k + 1, 1, 3, k))
        network.between(2 * k + 1, 2 * k + 2, 1, 1, k)
    assert offending_cycle(network) is None
    network.between(0, 3000, None, 5999, "last")
    assert offending_cycle(network) is not None


@pytest.mark.parametrize(("mission", "answer"), [("mission.toml", False), ("mended.toml", True)])
def test_the_command_tells_of_a_mission(mission: str, answer: bool) -> None:
    found = CliRunner().invoke(command, [str(GPS / mission), "--format", "json"], standalone_mode=False)
    assert found.exception is None
    assert found.return_value == (0 if answer else 1)
    (plan,) = json.loads(found.output)
    assert plan["reactor"] == "navigator"
    assert plan["dynamic"] is answer
    taken = {(each["token"].partition("#")[0], *each["between"]) for each in plan["durations"]}
    expected = {("Helm.Run", 134, 200), ("Helm.Run", 100, 150), ("Helm.Ascend", 25, 25), ("Gps.Active", 1, 40)}
    assert taken == expected
    if not answer:
        assert "duration <= SURFACE_MAX;" in [each["text"].partition(";")[0] + ";" for each in plan["cycle"]]


def test_the_command_names_the_lines_that_no_strategy_keeps() -> None:
    found = CliRunner().invoke(command, [str(GPS / "mission.toml")], standalone_mode=False)
    assert "plan of navigator: not dynamically controllable; strongly: no, weakly: no" in found.output
    assert "duration <= SURFACE_MAX" in found.output
    assert "takes 1 to 40" in found.output


def told(folder: Path, changes: dict[str, str], simulator: str = "") -> tuple[int, dict[str, Any]]:
    """The template `deadline` with texts replaced, asked about: exit code and the one plan."""
    for source in (DEADLINE, DEADLINE.parent / "common"):
        for path in source.iterdir():
            shutil.copy(path, folder)
    for path in folder.glob("*.nddl"):
        text = path.read_text(encoding="utf-8")
        for old, new in changes.items():
            text = text.replace(old, new)
        path.write_text(text, encoding="utf-8")
    if simulator:
        path = folder / "simulator.nddl"
        path.write_text(path.read_text(encoding="utf-8").partition("Oven::Bake")[0] + simulator, encoding="utf-8")
    found = CliRunner().invoke(command, [str(folder / "mission.toml"), "--format", "json"], standalone_mode=False)
    assert found.exception is None
    (plan,) = json.loads(found.output)
    return found.return_value, plan


@pytest.mark.parametrize(("most", "code"), [(90, 0), (89, 1)])
def test_whole_numbers_that_are_drawn_make_durations_uncertain(most: int, code: int, tmp_path: Path) -> None:
    answer, plan = told(tmp_path, {"ANALYSIS_MAX = 90": f"ANALYSIS_MAX = {most}"})
    assert answer == code
    (taken,) = plan["durations"]
    assert (taken["between"], taken["token"].partition("#")[0]) == ([50, 90], "Oven.Bake")
    assert (plan["dynamic"], plan["strong"]) == (code == 0, code == 0)


MOTORS = """
class Motor extends AgentTimeline {
    predicate Still { }
    predicate Run { int kind; }
    Motor(Mode m) { super(m, "Still"); }
}
class Task extends AgentTimeline {
    predicate Rest { }
    predicate Work { }
    Task(Mode m) { super(m, "Rest"); }
}
"""


KIND_OF = """from runtime.user.constraint import function
CONSTRAINTS = [function("kind_of", "size:number", "int", lambda size: 1, "a kind")]
"""


def asked_of_two_runs(folder: Path, demand: str, constants: str = "", kind: str = "1") -> tuple[int, dict[str, Any]]:
    """A task of two runs of 5 to 10 ticks, one after the other, under a further demand: exit code and the one plan."""
    (folder / "plan.nddl").write_text(
        f'#include "TREX.nddl"\n{constants}{MOTORS}Task::Work {{ contains(Motor.Run one); one.kind == {kind};'
        f" contains(Motor.Run two); two.kind == 2; one before two; two.end == end; {demand} }}\n"
        "Task task = new Task(Internal);\nMotor motor = new Motor(External);\nclose();\n"
    )
    (folder / "motor.nddl").write_text(
        f'#include "TREX.nddl"\n{MOTORS}int LENGTH = [5 10];\n'
        "Motor::Run { int d; d == sampledParameter(LENGTH); duration == max(d, kind); }\n"
        "Motor motor = new Motor(Internal);\nclose();\n"
    )
    (folder / "kinds.py").write_text(KIND_OF)
    (folder / "mission.toml").write_text("""
[constraints]
modules = ["kinds.py"]
[mission]
name = "motors"
final_tick = 60
[[reactor]]
name = "planner"
model = "plan.nddl"
lookahead = 60
internal = ["task"]
external = ["motor"]
[[reactor]]
name = "owner"
model = "motor.nddl"
lookahead = 1
internal = ["motor"]
[[goal]]
timeline = "task"
predicate = "Work"
start = [5, 5]
mandatory = true
[parameters.LENGTH]
kind = "int"
mode = "intra"
update = 1
[check]
missions = 20
""")
    found = CliRunner().invoke(command, [str(folder / "mission.toml"), "--format", "json"], standalone_mode=False)
    assert found.exception is None, found.exception
    (plan,) = json.loads(found.output)
    return found.return_value, plan


@pytest.mark.parametrize(("most", "is_dynamic"), [(20, True), (19, False)])
def test_ticks_that_a_request_takes_are_not_in_the_network(most: int, is_dynamic: bool, tmp_path: Path) -> None:
    """`Still` stood between the runs while the second was asked for, and its one tick was counted; so was the end of
    `Work` as chosen, though it is that of the second run."""
    code, plan = asked_of_two_runs(tmp_path, f"duration <= {most};")
    assert (code, plan["dynamic"], plan["strong"]) == (int(not is_dynamic), is_dynamic, is_dynamic)


@pytest.mark.parametrize(
    ("demand", "constants"),
    [
        ("two.end <= one.end + {0};", ""),
        ("two.end <= one.end + MOST;", "int MOST = {0};\n"),
        ("int last; last == one.end + MOST; two.end <= last;", "int MOST = {0};\n"),
        ("int last; last == HALF * 2 + one.end; last >= two.end;", "int HALF = {1};\n"),
        ("two.end - MOST <= one.start + one.duration;", "int MOST = {0};\n"),
    ],
)
@pytest.mark.parametrize("most", [9, 10, 14, 16])
def test_a_limit_with_a_name_or_a_local_is_a_demand_like_one_with_a_number(
    demand: str, constants: str, most: int, tmp_path: Path
) -> None:
    # The second run takes up to 10 from the end of the first on, which takes 5 to 10 itself.
    code, plan = asked_of_two_runs(tmp_path, demand.format(most), constants.format(most, most // 2))
    assert (code, plan["dynamic"], plan["strong"]) == (int(most < 10), most >= 10, most >= 15)
    assert plan["left_out"] == 0


def test_what_rests_on_the_flight_is_no_constant(tmp_path: Path) -> None:
    demand = "two.start >= one.end + SETTLE; two.start <= one.end + SETTLE;"  # the end rests on what Python gives
    code, plan = asked_of_two_runs(tmp_path, demand, "int SETTLE;\nSETTLE = 5;\n", "kind_of(SETTLE)")
    assert (code, plan["dynamic"], plan["weak"]) == (0, True, True)


def test_what_is_no_distance_is_counted(tmp_path: Path) -> None:
    code, plan = asked_of_two_runs(tmp_path, "one.duration + two.duration <= MOST;", "int MOST = 21;\n")
    assert code == 0 and plan["left_out"] == 1
    found = CliRunner().invoke(command, [str(tmp_path / "mission.toml")], standalone_mode=False)
    assert "dynamically controllable as far as distances between times go" in found.output


def test_a_branch_that_the_flight_did_not_take_counts(tmp_path: Path) -> None:
    body = "if (heating > 55) { duration == 85; } else { duration == 30; }"
    rule = f"Oven::Bake {{ int heating; heating == sampledParameter(HEATING); {body} }}"
    simulator = f"{rule}\nOven oven = new Oven(Internal);\nclose();\n"
    answer, plan = told(tmp_path, {"ANALYSIS_MAX = 90": "ANALYSIS_MAX = 84"}, simulator)
    assert [each["between"] for each in plan["durations"]] == [[30, 85]]
    assert answer == 1


def test_what_lines_reckon_beyond_all_flights_is_not_called_a_fault(tmp_path: Path) -> None:
    product = "float product; product == heating * rest; duration == ceil(product / 50.0);"
    product = f"int rest; rest == 140 - heating; {product}"
    rule = f"Oven::Bake {{ int heating; heating == sampledParameter(HEATING); {product} }}"
    simulator = f"{rule}\nOven oven = new Oven(Internal);\nclose();\n"
    answer, plan = told(tmp_path, {"ANALYSIS_MAX = 90": "ANALYSIS_MAX = 100"}, simulator)
    (taken,) = plan["durations"]
    assert taken["between"][1] > 100 and 90 < taken["in_flights"][1] <= 98  # 98: both factors are 70
    assert (answer, plan["dynamic"], plan["strong"], plan["weak"]) == (2, None, None, None)
    found = CliRunner().invoke(command, [str(tmp_path / "mission.toml")], standalone_mode=False)
    assert "whether it is controllable is not known" in found.output
    assert f"to {taken['in_flights'][1]} in flights)" in found.output
    assert told(tmp_path, {"ANALYSIS_MAX = 90": "ANALYSIS_MAX = 88"}, simulator)[0] == 1


def test_what_nothing_bounds_is_not_called_controllable(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Ranges, "range", lambda _self, _number: (-inf, inf))
    answer, plan = told(tmp_path, {})
    assert answer == 2
    assert (plan["dynamic"], plan["strong"], plan["weak"]) == (None, None, None)
    assert [each.partition("#")[0] for each in plan["not_known"]] == ["Oven.Bake"]
    found = CliRunner().invoke(command, [str(tmp_path / "mission.toml")], standalone_mode=False)
    assert "whether it is controllable is not known" in found.output
    assert "for how long is not known" in found.output


def test_a_flight_too_large_for_z3_is_refused_at_once() -> None:
    found = CliRunner().invoke(command, [str(GPS.parent / "auv" / "inl" / "mission.toml")], standalone_mode=False)
    assert isinstance(found.exception, Unusable)
    assert "tokens, more than the 10000 that are followed" in found.exception.message


SNOW = """
float NOZZLE = [5.0 7.0];
int SNOWING = [0 2];
Motor::Run {
    float nozzle; nozzle == sampledParameter(NOZZLE);
    int snowing; snowing == sampledParameter(SNOWING);
    if (snowing == 2) { duration == ceil(324.0 / nozzle) + 8; } else { duration == ceil(324.0 / nozzle); }
}
"""


@pytest.mark.parametrize(("most", "code"), [(73, 0), (72, 1)])
def test_a_branch_that_other_flights_took_counts_with_all_that_its_lines_make_of_the_box(
    most: int, code: int, tmp_path: Path
) -> None:
    # 324 / 5 + 8 = 73 ticks; flights of the one branch were counted with what they took alone.
    asked_of_two_runs(tmp_path, f"one.duration <= {most}; two.duration <= {most};")
    text = (tmp_path / "motor.nddl").read_text()
    head, tail = text[: text.index("int LENGTH")], "Motor motor = new Motor(Internal);\nclose();\n"
    (tmp_path / "motor.nddl").write_text(head + SNOW + tail)
    mission = (tmp_path / "mission.toml").read_text().replace("final_tick = 60", "final_tick = 200")
    mission = mission.replace("lookahead = 60", "lookahead = 200").partition("[parameters.LENGTH]")[0]
    (tmp_path / "mission.toml").write_text(mission)
    found = CliRunner().invoke(command, [str(tmp_path / "mission.toml"), "--format", "json"], standalone_mode=False)
    assert found.exception is None, found.exception
    (plan,) = json.loads(found.output)
    assert [each["between"] for each in plan["durations"]] == [[47, 73], [47, 73]]
    assert found.return_value == code


def test_what_lasts_until_something_else_is_asked_for_is_no_duration_of_others(tmp_path: Path) -> None:
    """Its owner has no rule for it: the one who asked ends it, by the next request."""
    demand = "one.end + 5 <= two.start; two.start <= one.end + 5; contains(Motor.Still still); "
    code, plan = asked_of_two_runs(tmp_path, f"{demand} one meets still; still meets two;")
    assert [each["token"].partition("#")[0] for each in plan["durations"]] == ["Motor.Run", "Motor.Run"]
    assert plan["dynamic"] and code == 0
