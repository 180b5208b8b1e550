"""Each slip is told once, in its line, with the help that mends it: by `nddlc lint mission.toml .` in the project."""

import json
import shutil
from pathlib import Path

import pytest

from nddlc.main import run
from tests.cli.slip import Slip
from tests.cli.slips_at_the_harbour import AT_THE_HARBOUR
from tests.cli.slips_in_texts import AT_THE_BAKERY, AT_THE_BREWERY, AT_THE_TELESCOPE
from tests.cli.slips_in_the_survey import IN_THE_SURVEY

HARBOUR = Path(__file__).parent / "harbour"
PROJECTS = {
    **{name: HARBOUR.parent / name for name in ("harbour", "telescope", "depot", "brewery", "quarry")},
    "bakery": HARBOUR.parents[1] / "checker" / "unseen" / "bakery",
    **{name: HARBOUR.parents[2] / "models" / "templates" / name for name in ("survey", "window", "noise", "deadline")},
}
SLIPS = IN_THE_SURVEY + AT_THE_HARBOUR + AT_THE_TELESCOPE + AT_THE_BREWERY + AT_THE_BAKERY
Captured = pytest.CaptureFixture[str]


@pytest.mark.parametrize("slip", SLIPS, ids=lambda each: each.kind)
def test_a_slip_is_told_once_in_its_line_with_help(
    slip: Slip, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Captured
) -> None:
    project, _, file = slip.file.partition("/")
    for path in PROJECTS[project].glob("*.*"):
        shutil.copy(path, tmp_path)
    text = (tmp_path / file).read_text(encoding="utf-8")
    assert slip.right in text
    text = text.replace(slip.right, slip.wrong, 1)
    (tmp_path / file).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    missions = [path.name for path in tmp_path.glob("mission.toml")]
    assert run(["lint", "--format", "json", *missions, "."]) == 1
    (one,) = json.loads(capsys.readouterr().out)["diagnostics"]
    assert Path(one["file"]).name == file
    assert any(each in text.split("\n")[one["line"] - 1] for each in slip.told)
    told = json.dumps(one, ensure_ascii=False).replace('\\"', '"')
    assert any(each in told for each in slip.helps), told


@pytest.mark.parametrize("project", PROJECTS.values(), ids=PROJECTS)
def test_a_project_without_a_slip_is_in_order(project: Path, capsys: Captured) -> None:
    assert run(["lint", *map(str, project.glob("mission.toml")), str(project)]) == 0
    assert "nothing wrong" in capsys.readouterr().out


def test_there_are_as_many_as_were_promised() -> None:
    assert len(SLIPS) >= 47
