"""What is flown is what was read: files that change while missions are flown change no mission."""

from pathlib import Path

import pytest

from checker.batch.process import Flyer
from checker.mission import Mission, read_mission
from checker.models import load_models
from checker.oracle import Verdict
from checker.pinned import PinnedModels, pinned
from nddlc.main import run
from runtime.executive.configuration import AgentConfiguration
from runtime.user.fault import UserCodeError
from tests.checker.test_causes import GOAL, MISSION, MODEL
from tests.executive.test_coded import CODE, OWNER, USER
from tests.executive.test_coded import MISSION as CODED

RIGHT = MODEL.replace("RUN_MAX = 12", "RUN_MAX = 30")


def read(path: Path) -> Mission:
    mission, found = read_mission(path)
    assert mission is not None, found
    return mission


def verdict_in_a_new_process(load: PinnedModels, agent: AgentConfiguration) -> Verdict:
    with Flyer(load, agent, 60.0) as flyer:
        return flyer.fly(agent, 1, 1).verdict


def test_a_model_that_changes_is_flown_as_it_was_read(tmp_path: Path) -> None:
    model = tmp_path / "planner.nddl"
    model.write_text(RIGHT)
    (tmp_path / "mission.toml").write_text(MISSION + GOAL.format(5))
    models = load_models(read(tmp_path / "mission.toml"))
    load = pinned(models)
    model.write_text(MODEL)
    assert verdict_in_a_new_process(load, models.agent) is Verdict.PASS
    now = load_models(read(tmp_path / "mission.toml"))
    assert verdict_in_a_new_process(pinned(now), now.agent) is Verdict.FAIL
    model.unlink()
    assert verdict_in_a_new_process(load, models.agent) is Verdict.PASS


def test_code_that_changes_is_not_flown_as_if_it_were_the_old_one(tmp_path: Path) -> None:
    code = tmp_path / "eye.py"
    for name, text in (("eye.py", CODE), ("sim.nddl", OWNER), ("user.nddl", USER)):
        (tmp_path / name).write_text(text)
    (tmp_path / "mission.toml").write_text(CODED.format(code="eye.py:Eye", on_failure="abort_agent"))
    models = load_models(read(tmp_path / "mission.toml"))
    code.write_text(CODE + "# another text\n")
    with pytest.raises(UserCodeError, match=r"eye\.py: changed while missions were flown"):
        verdict_in_a_new_process(pinned(models), models.agent)


def test_files_of_one_name_in_two_folders_are_two_models(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, text in (("wrong", MODEL), ("right", RIGHT)):
        (tmp_path / name).mkdir()
        (tmp_path / name / "planner.nddl").write_text(text)
        (tmp_path / name / "mission.toml").write_text(MISSION + GOAL.format(5))
    for name, code in (("wrong", 1), ("right", 0), ("wrong", 1)):
        monkeypatch.chdir(tmp_path / name)
        assert run(["run", "mission.toml"]) == code
        assert run(["check", "mission.toml", "--missions", "1"]) == code
        capsys.readouterr()
        assert run(["explain", "latest#1"]) == 0
        assert ("nothing to explain" in capsys.readouterr().out) == (code == 0)
