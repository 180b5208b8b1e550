"""The detector of the INL mission: the hidden Markov model against its definition, and the thresholds."""

import csv
import math
from pathlib import Path

import pytest

from runtime.user.reactor import Now, Reactor, Seen, Value
from runtime.user.reactor_library import load_reactor

INL = Path(__file__).parents[2] / "models" / "auv" / "inl"
SETTINGS: dict[str, Value] = {"clusters": "clusters.csv", "prior": 0.05, "stay": 0.97, "enter": 0.9, "leave": 0.1}
SURVEYOR: dict[str, Value] = {
    "samplers": 10,
    "width": 300.0,
    "spacing": 50.0,
    "lines": 4,
    "linesPerFix": 4,
    "top": 5.0,
    "bottom": 60.0,
}

GOING = Seen("Run", {"kind": "YoYo"}, 0)


def heard(detector: Reactor, tick: int, cluster: int, helm: Seen = GOING) -> list[str]:
    seen = {"water": Seen("Holds", {"id": cluster}, tick), "helm": helm}
    now = Now(tick, seen, frozenset({"water"}), frozenset())
    detector.tick(now)
    return [one.predicate for one in now.published]


def test_the_belief_is_that_of_the_two_state_model() -> None:
    detector = load_reactor(INL, "detector.py", "Detector")(SETTINGS)
    outside, inside = 0.95, 0.05
    for number, cluster in enumerate([20, 31, 38, 3, 17]):
        heard(detector, 10 * number, cluster)
        inside, outside = 0.97 * inside + 0.03 * outside, 0.03 * inside + 0.97 * outside
        likely = 0.03 + 0.94 * cluster / 38
        inside, outside = inside * likely, outside * (1 - likely)
        inside, outside = inside / (inside + outside), outside / (inside + outside)
        assert math.isclose(vars(detector)["belief"], inside, rel_tol=1e-3)


def test_the_belief_over_all_39_clusters_is_that_of_a_forward_algorithm() -> None:
    with (INL / "clusters.csv").open(encoding="utf-8") as file:
        table = [(int(row["cluster"]), float(row["inside"])) for row in csv.DictReader(file)]
    assert [cluster for cluster, _ in table] == list(range(39))
    assert all(0.0 <= inside <= 1.0 for _, inside in table)
    detector = load_reactor(INL, "detector.py", "Detector")(SETTINGS)
    alpha = (0.95, 0.05)  # Outside, Inside; an emission is as probable as its row says, relative to the other state
    states, told = [], ["Outside"]
    for number, (cluster, inside) in enumerate([*table[::-1], *table, *table[20:], *table[:20]]):
        found = heard(detector, 10 * number, cluster)
        moved = [sum(alpha[a] * (0.97 if a == b else 0.03) for a in range(2)) for b in range(2)]
        joint = (moved[0] * (1.0 - inside), moved[1] * inside)
        alpha = (joint[0] / sum(joint), joint[1] / sum(joint))
        assert math.isclose(vars(detector)["belief"], alpha[1], rel_tol=1e-9)
        if (alpha[1] > 0.9 and told[-1] == "Outside") or (alpha[1] < 0.1 and told[-1] == "Inside"):
            told.append("Inside" if told[-1] == "Outside" else "Outside")
        states += found
    assert states == told


def surveys_asked(ids: list[int]) -> tuple[list[str], list[str]]:
    """What the detector tells of a sequence of clusters, one each ten seconds, and what the surveyor asks for then."""
    detector = load_reactor(INL, "detector.py", "Detector")(SETTINGS)
    surveyor = load_reactor(INL, "detector.py", "Surveyor")(SURVEYOR)
    told, asked = [], []
    for number, cluster in enumerate(ids):
        tick = 10 * number
        for predicate in heard(detector, tick, cluster):
            told.append(predicate)
            here = Seen("Holds", {"x": 100.0, "y": 50.0}, tick)
            now = Now(
                tick, {"feature": Seen(predicate, {}, tick), "vehicle": here}, frozenset({"feature"}), frozenset()
            )
            surveyor.tick(now)
            asked += [one.predicate for one in now.asked]
    return told, asked


def test_sixty_seconds_inside_are_one_detection_and_one_closer_look() -> None:
    assert surveys_asked([3] * 5 + [35] * 6 + [3] * 10) == (["Outside", "Inside", "Outside"], ["HighRes"])
    assert surveys_asked([3] * 5 + [35] * 6) == (["Outside", "Inside"], ["HighRes"])


def test_a_single_outlier_is_no_detection() -> None:
    assert surveys_asked([3] * 5 + [35] + [3] * 20) == (["Outside"], [])


def test_it_tells_of_changes_only() -> None:
    detector = load_reactor(INL, "detector.py", "Detector")(SETTINGS)
    told = [heard(detector, 10 * k, 38 if k < 5 else 0) for k in range(10)]
    assert [said for said in told if said] in (
        [["Outside"], ["Inside"], ["Outside"]],
        [["Outside", "Inside"], ["Outside"]],
    )


def test_what_is_met_at_the_surface_tells_nothing() -> None:
    detector = load_reactor(INL, "detector.py", "Detector")(SETTINGS)
    waiting = [Seen("Inactive", {}, 0), Seen("Run", {"kind": "GetFix"}, 0), Seen("Run", {"kind": "Ascend"}, 0)]
    told = [heard(detector, 10 * k, 38, waiting[k % 3]) for k in range(12)]
    assert [said for said in told if said] == [["Outside"]]
    assert heard(detector, 120, 38) == [] and heard(detector, 130, 38) == ["Inside"]


def test_a_probability_of_none_or_all_is_no_row_of_the_table(tmp_path: Path) -> None:
    (tmp_path / "detector.py").write_text((INL / "detector.py").read_text(encoding="utf-8"), encoding="utf-8")
    (tmp_path / "clusters.csv").write_text("cluster,inside\n0,1.0\n", encoding="utf-8")
    with pytest.raises(ValueError, match="not between 0 and 1"):
        load_reactor(tmp_path, "detector.py", "Detector")(SETTINGS)
