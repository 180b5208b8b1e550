"""`nddlc run RUN#MISSION` flies a mission of a stored run again, where its sampler had placed it."""

import json
from pathlib import Path

import pytest

from nddlc.main import run
from tests.checker.conditions.campaigns import campaign

pytestmark = pytest.mark.once


def test_a_mission_that_a_sampler_placed_is_flown_there(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    campaign(tmp_path, "bool high; high == (p > 0.9); if (high == true) { r >= 2.0; }", missions=16)
    monkeypatch.chdir(tmp_path)
    limit = ("--max-failure-rate", "1", "--flights", "0", "--no-conditions")
    assert run(["check", "mission.toml", "--sampler", "corners", *limit]) == 0
    told = capsys.readouterr().out
    report = json.loads(Path("nddlc-report/report.json").read_text())
    failed = next(one for one in report["missions"] if one["verdict"] == "FAIL" and one["role"] == "designed")
    of_design = sum(one["role"] == "designed" and one["verdict"] == "FAIL" for one in report["missions"])
    designed = sum(one["role"] == "designed" for one in report["missions"])
    assert f"; {of_design} of the {designed} that the design chose failed\n" in told

    assert run(["run", f"latest#{failed['mission']}", "--trace", "t.jsonl"]) == 1
    assert f"seed {failed['seed']}: FAIL" in capsys.readouterr().out
    head = json.loads(Path("t.jsonl").read_text().splitlines()[0])
    assert head["values"]["P"] > 0.9 and set(head["values"]) == set("PQR")
    assert run(["replay", "t.jsonl"]) == 0

    for what, problem in (
        ("latest#99", "has missions 1 to 16, not 99"),
        ("latest#0", "16, not 0"),
        ("latest#k1", "16, not k1"),
        ("latest#x", "is no number of a mission"),
    ):
        capsys.readouterr()
        assert run(["run", what]) == 2
        assert problem in capsys.readouterr().err
