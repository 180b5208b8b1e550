"""A study flies each variant under each sampling with common seeds; its figures are those of the draws themselves."""

import json
import shutil
import signal
from dataclasses import replace
from pathlib import Path
from statistics import NormalDist
from xml.etree import ElementTree

import jsonschema
import pytest

from checker.batch.progress import Progress
from checker.campaign import Campaign
from checker.mission import read_mission
from checker.models import load_models
from checker.pinned import pinned
from checker.sampling.seeds import mission_seed
from checker.schemas import schema
from checker.study.cells import StudyCell, campaign_of, findings_of, with_beyond
from checker.study.reading import Variant, read_study
from nddlc.main import run
from nddlc.progress import Display
from runtime.executive.chance import draw

GPS = Path("models/gps").resolve()
SVG = "{http://www.w3.org/2000/svg}"
STUDY = """\
[study]
name = "fixes"
mission = "mission.toml"
seed = 11
missions = 30
modes = ["inter"]
[[variant]]
name = "base"
[[variant]]
name = "short"
file = "short.toml"
missions = 12
beyond = "base"
[variant.expected]
"uniform inter" = 1.0
"""
SHORT = """\
title = "a surfacing of half a minute"
[[edit]]
file = "navigator.nddl"
old = "SURFACE_MAX = 64;"
new = "SURFACE_MAX = 30;"
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    shutil.copytree(GPS, tmp_path / "gps", ignore=shutil.ignore_patterns(".*", "nddlc-*"))
    (tmp_path / "gps" / "study.toml").write_text(STUDY)
    (tmp_path / "gps" / "short.toml").write_text(SHORT)
    monkeypatch.chdir(tmp_path)
    return tmp_path / "gps"


def rates_above(limit: float, count: int, *, is_normal: bool) -> int:
    """In how many of the first missions GPS_HIT_RATE is above a limit, or below 0 as no rate is, drawn by hand."""
    shares = [draw(mission_seed(11, number), "GPS_HIT_RATE", 0) for number in range(1, count + 1)]
    if is_normal:
        return sum(not 0.0 < NormalDist(2.05, 3.9 / 12**0.5).inv_cdf(share) <= limit for share in shares)
    return sum(0.1 + 3.9 * share > limit for share in shares)


@pytest.mark.once
def test_a_study_counts_what_the_draws_decide(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code = run(["study", "gps/study.toml", "--workers", "2", "--format", "json"])
    data = json.loads(capsys.readouterr().out)
    jsonschema.validate(data, schema("study"))
    cells = {(one["variant"], one["sampling"]): one for one in data["cells"]}
    assert {key: one["missions"] for key, one in cells.items()} == {
        ("base", "uniform inter"): 30, ("base", "normal inter"): 30,
        ("short", "uniform inter"): 12, ("short", "normal inter"): 12,
    }  # fmt: skip
    for shape in ("uniform", "normal"):
        base, short = cells["base", f"{shape} inter"], cells["short", f"{shape} inter"]
        assert base["failures"] == rates_above(3.8, 30, is_normal=shape == "normal")
        assert base["errors"] == short["errors"] == 0
        assert short["failures"] >= rates_above(3.8, 12, is_normal=shape == "normal")
        assert short["beyond"] == short["failures"] - rates_above(3.8, 12, is_normal=shape == "normal")
    assert code == (0 if cells["short", "uniform inter"]["rate"] >= 0.92 else 1)
    figure = ElementTree.fromstring(Path("nddlc-study/figure12.svg").read_text())
    assert figure.tag == SVG + "svg"  # without its name space no viewer shows it
    assert len(figure.findall(SVG + "rect")) == 4 + 2
    assert len([one for one in figure.findall(SVG + "line") if one.get("class") == "whisker"]) == 4 * 3
    assert {"n=30", "n=12", "expected"} <= {one.text for one in figure.findall(SVG + "text")}
    assert len(figure.findall(SVG + "polygon")) == 1 + 1  # one rate is expected, and the legend has one
    page = Path("nddlc-study/study.html").read_text()
    assert "http" not in page
    assert "found by" in page


@pytest.mark.once
def test_what_the_mission_limits_fails_a_mission_of_a_study_too(folder: Path) -> None:
    """`nddlc check` and `nddlc study` told two rates of the same missions."""
    file = folder / "mission.toml"
    file.write_text(file.read_text().replace("[check]\n", "[check]\nmax_repairs = 0\n"))
    mission, _ = read_mission(file)
    study, _ = read_study(folder / "study.toml")
    assert mission is not None and study is not None
    models = load_models(mission)
    (base, _) = study.variants
    flown = campaign_of(study, base, "normal intra", Campaign(mission, models, pinned(models)))
    assert flown.mission.check.limits == mission.check.limits != ()


def test_more_missions_are_added_to_what_was_flown(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["study", "gps/study.toml", "--variant", "base", "--workers", "1"]
    run([*arguments, "--missions", "3"])
    first = json.loads(Path("nddlc-study/study.json").read_text())
    assert [one["missions"] for one in first["cells"]] == [3, 3]
    run([*arguments, "--missions", "5"])
    more = json.loads(Path("nddlc-study/study.json").read_text())
    assert [one["missions"] for one in more["cells"]] == [5, 5]
    assert "not flown yet" in capsys.readouterr().out


@pytest.mark.once
def test_a_signal_ends_a_study_at_once(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    seen: list[int] = []

    class Pressed(Display):
        def __call__(self, progress: Progress) -> None:
            if progress.done and not seen:  # a second one would end all
                seen.append(progress.done)
                signal.raise_signal(signal.SIGTERM)

    monkeypatch.setattr("nddlc.study.Display", Pressed)
    assert run(["study", "gps/study.toml", "--workers", "1"]) == 128 + signal.SIGTERM
    told = capsys.readouterr()
    assert "the same command goes on" in told.err and len([one for one in told.err.splitlines() if ", " in one]) == 2
    assert not Path("nddlc-study").exists()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('file = "short.toml"', 'file = "shrt.toml"', "there is no file `shrt.toml`"),
        ('beyond = "base"', 'beyond = "none"', "`beyond` must be a variant named before"),
        ('"uniform inter" = 1.0', '"uniform intra" = 1.0', "no key `uniform intra`"),
        ('modes = ["inter"]', 'modes = ["outer"]', "`modes` must be among inter, intra"),
        ('mission = "mission.toml"', 'mission = "x.toml"', "there is no file `x.toml`"),
        ('name = "short"', 'name = "base"', "the variant `base` is there twice"),
        ("seed = 11", "seed = ", "this is not TOML"),
    ],
)
def test_a_mistake_in_a_study_is_named(folder: Path, old: str, new: str, message: str) -> None:
    (folder / "study.toml").write_text(STUDY.replace(old, new))
    study, found = read_study(folder / "study.toml")
    assert study is None
    assert any(message in one.message for one in found), [one.message for one in found]


def test_a_dry_run_flies_nothing(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["study", "gps/study.toml", "--dry-run", "--missions", "20"]) == 0
    assert "4 cells (base, short; uniform inter, normal inter), 64 missions" in capsys.readouterr().out
    assert not Path("nddlc-study").exists()
    (folder / "short.toml").write_text(SHORT.replace("30", "30 +"))
    assert run(["study", "gps/study.toml", "--dry-run"]) == 2


def test_an_edit_without_its_place_is_named(folder: Path) -> None:
    (folder / "short.toml").write_text(SHORT.replace("64", "65"))
    study, found = read_study(folder / "study.toml")
    assert study is None
    assert "exactly one place" in (found[0].help or "")


def cell(name: str, sampling: str, failing: range, beyond: str = "") -> StudyCell:
    variant = Variant(name, "", (), {}, 40, beyond)
    return StudyCell(variant, sampling, 40, tuple((seed, seed in failing) for seed in range(40)), 0, ())


def test_the_best_sampling_is_told_from_worse_ones_by_common_seeds() -> None:
    cells = [cell("B", "a", range(20)), cell("B", "b", range(16)), cell("B", "c", range(5)), cell("B", "d", range(0))]
    (finding,) = findings_of(cells)
    assert [one.sampling for one in finding.finds] == ["a", "b", "c"]
    assert [one.sampling for one in finding.worse] == ["c", "d"]
    assert [one.sampling for one in finding.missed] == ["d"]


def test_failures_of_a_contained_mistake_are_counted_apart() -> None:
    cells = with_beyond(
        [cell("R3", "a", range(10)), cell("R1", "a", range(4, 18), "R3"), cell("R1", "b", range(3), "R3")]
    )
    assert [(one.beyond, one.apart) for one in cells] == [(None, None), (8, 30), (None, None)]


def test_of_a_mistake_that_contains_another_its_own_rate_is_held_against_the_expected_one() -> None:
    """A third of the missions that pass with the contained mistake fail with both (trex 5.6, R1)."""
    expected = {"a": 1 / 3}
    outer = replace(cell("R1", "a", range(5, 20), "R3"), variant=Variant("R1", "", (), expected, 40, "R3"))
    _, whole = with_beyond([cell("R3", "a", range(10)), outer])
    assert whole.own_rate == pytest.approx(1 / 3)
    assert whole.rate == pytest.approx(0.375)
    assert whole.is_expected(0.02)
    assert not outer.is_expected(0.02)


def test_the_study_of_the_auv_fits_its_models() -> None:
    study, found = read_study(Path("models/auv/study.toml"))
    assert study is not None, [one.message for one in found]
    assert [one.name for one in study.variants] == ["base", "B1", "B2", "B3", "B4", "B5", "R3", "R1", "R2"]
    assert study.variants[0].missions == 400
