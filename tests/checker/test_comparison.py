"""Two versions are compared on common seeds, and the steps of the process come in their order."""

import json
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy import stats

from checker.comparison import Comparison, Trialled, compare
from checker.process import ProcessStep, StepRecord, missing_before, passed
from checker.statistics import LEAST_CHANCE
from nddlc.main import run

pytestmark = pytest.mark.once

GPS = Path("models/gps").resolve()


def trialled(failed: list[bool]) -> dict[tuple[int, str], Trialled]:
    return {(seed, "{}"): Trialled(seed + 1, one, "F1" if one else "", "") for seed, one in enumerate(failed)}


def test_flips_are_counted_on_common_seeds() -> None:
    before, after = trialled([True] * 5 + [False] * 15), trialled([False] * 3 + [True] * 9 + [False] * 6)
    found = compare(before, after, 0.95)
    assert (found.missions, found.failed_before, found.failed_after) == (18, 5, 9)
    assert [one.seed for one in found.flips if not one.now_fails] == [0, 1, 2]
    assert [one.seed for one in found.flips if one.now_fails] == [5, 6, 7, 8, 9, 10, 11]
    assert found.chance == pytest.approx(stats.binomtest(3, 10).pvalue)
    assert found.change == pytest.approx(4 / 18)
    assert found.interval is not None
    assert found.interval[0] < 4 / 18 < found.interval[1]


def test_the_interval_of_the_change_covers() -> None:
    dice = np.random.default_rng(2)
    covered = 0
    for _ in range(300):
        before = dice.random(80) < 0.2
        after = np.where(dice.random(80) < 0.1, ~before, before)
        found = compare(trialled(list(before)), trialled(list(after)), 0.9)
        assert found.interval is not None
        lower, upper = found.interval
        covered += lower <= 0.1 * (1 - 2 * 0.2) <= upper
    assert covered >= 300 * 0.9


def test_missions_that_a_sampler_chose_tell_no_change_of_the_rate() -> None:
    """Twenty plain random missions, then those that a sampler has put where most fail."""
    before, after = trialled([False] * 60), trialled([False] * 18 + [True] * 42)

    def chosen_after(most: int) -> Comparison:
        first, second = (
            {k: replace(one, is_random=one.number <= most) for k, one in run.items()} for run in (before, after)
        )
        return compare(first, second, 0.95)

    mixed, chosen = chosen_after(20), chosen_after(0)
    assert (mixed.missions, mixed.counted, mixed.change) == (60, 20, 0.1)
    assert mixed.interval == compare(trialled([False] * 20), trialled([False] * 18 + [True] * 2), 0.95).interval
    assert (chosen.change, chosen.interval) == (None, None)
    assert chosen.is_worse
    assert chosen.chance == LEAST_CHANCE


def test_nothing_in_common_is_no_comparison() -> None:
    assert compare({}, {}, 0.95).missions == 0


@pytest.fixture
def gps(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    shutil.copytree(GPS, tmp_path / "gps", ignore=shutil.ignore_patterns(".*", "nddlc-*"))
    monkeypatch.chdir(tmp_path)
    return tmp_path / "gps"


def test_two_versions_of_a_model_are_compared(gps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["gps/mission.toml", "--missions", "12", "--workers", "1", "--format", "json"]
    run(["check", *arguments, "--output", "a"])
    model = gps / "navigator.nddl"
    model.write_text(model.read_text().replace("SURFACE_MAX = 64;", "SURFACE_MAX = 30;"))
    run(["check", *arguments, "--output", "b"])
    a, b = (json.loads(Path(name, "report.json").read_text()) for name in "ab")
    capsys.readouterr()
    code = run(["compare", a["run"], b["run"], "--format", "json"])
    found = json.loads(capsys.readouterr().out)
    assert (found["failed_before"], found["failed_after"]) == (a["counts"]["fail"], b["counts"]["fail"])
    assert len(found["flips"]) == b["counts"]["fail"] - a["counts"]["fail"]
    assert code == (1 if found["p"] < 0.05 else 0)
    assert [found[key]["repairs"] for key in ("lost_before", "lost_after")] == [
        each["losses"]["repairs"] for each in (a, b)
    ]
    assert found["lost_before"] != found["lost_after"]
    assert run(["compare", "a/report.json", "b/report.json"]) == code
    assert "McNemar" in (text := capsys.readouterr().out)
    assert f"what they cost: repairs of plans {a['losses']['repairs']} -> {b['losses']['repairs']}" in text
    assert "compared with itself" not in text
    assert run(["compare", "latest", b["run"]]) == 0
    assert f"`latest` and `{b['run']}` are one and the same run" in capsys.readouterr().out
    assert run(["compare", a["run"], "none"]) == 2


def test_steps_come_in_their_order(gps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    mission = gps / "mission.toml"
    mission.write_text(mission.read_text().replace("range = [0.1, 4.0]", "range = [0.1, 2.0]"))
    assert run(["process", "gold", "gps/mission.toml"]) == 2
    assert run(["process", "develop", "gps/mission.toml", "--by", "ann"]) == 0
    assert run(["process", "random", "gps/mission.toml"]) == 2
    assert run(["process", "gold", "gps/mission.toml"]) == 2
    assert run(["gold", "accept", "gps/mission.toml"]) == 0
    assert run(["process", "gold", "gps/mission.toml"]) == 0
    capsys.readouterr()
    assert run(["process", "status", "gps/mission.toml"]) == 1
    text = capsys.readouterr().out
    assert "passed by ann" in text
    assert "3. random: random missions fail no more often than is accepted\n   not passed" in text
    assert "not possible: there is no physics simulator yet" in text
    assert text.endswith("next: `nddlc process random gps/mission.toml`\n")
    model = gps / "navigator.nddl"
    model.write_text(model.read_text() + "// a remark\n")
    assert run(["process", "gold", "gps/mission.toml"]) == 2
    assert run(["process", "status", "gps/mission.toml"]) == 1
    assert "not passed with these models (with earlier ones by ann" in capsys.readouterr().out


def test_a_step_without_the_one_before_counts_as_not_passed() -> None:
    records = (StepRecord("gold", "m", "a", "t", ""), StepRecord("develop", "n", "a", "t", ""))
    assert passed(records, "m") == {}
    assert list(passed(records, "n")) == [ProcessStep.DEVELOP]
    assert missing_before(ProcessStep.RANDOM, records, "n") is ProcessStep.GOLD
    assert missing_before(ProcessStep.DEVELOP, (), "n") is None
