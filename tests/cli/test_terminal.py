"""Names and texts of a model or a mission file command no terminal, and are no HTML in a report."""

import re
import shutil
from pathlib import Path

import pytest

from nddlc.fitting import fitted
from nddlc.main import run
from nddlc.seeking import SeekingDisplay

ROOT = Path(__file__).parents[2]
LINK = "\x1b]8;;http://localhost/\x1b\\here\x1b]8;;\x1b\\"  # OSC 8, a link
EVIL = f"{LINK}\x1b[2J\x1b]0;title\x07\u202e\x9b31m"
IN_TOML = EVIL.encode("unicode_escape").decode("ascii").replace("\\x", "\\u00")
COMMANDS = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")
HTML = "<script>alert(1)</script><img src=x onerror=alert(2)>"

EDITS = {
    "a key": ("mission.toml", "final_tick", f'"{IN_TOML}"'),
    "a file": ("mission.toml", 'model = "planner.nddl"', f'model = "{IN_TOML}.nddl"'),
    "a parameter": ("mission.toml", "length = 260.0", f'"{IN_TOML}" = 260.0'),
    "a timeline": ("mission.toml", 'internal = ["survey"]', f'internal = ["{IN_TOML}"]'),
    "a mission": ("mission.toml", 'name = "survey"', f'name = "{IN_TOML}"'),
    "an include": ("planner.nddl", '#include "vehicle.nddl"', f'#include "{EVIL}.nddl"'),
    "a text": ("planner.nddl", "duration <= LEG_MAX;", f'duration <= "{EVIL}";'),
    "words": ("planner.nddl", "duration <= LEG_MAX;", f"duration <= {EVIL};"),
    "a comment": ("planner.nddl", "duration <= LEG_MAX;", f"duration <= LEG; /* {EVIL} */"),
}


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for path in (ROOT / "models" / "templates" / "survey").iterdir():
        if path.is_file():
            shutil.copy(path, tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("name", EDITS)
def test_nothing_of_a_project_commands_the_terminal(
    name: str, project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file, right, wrong = EDITS[name]
    text = (project / file).read_text(encoding="utf-8")
    assert right in text
    (project / file).write_text(text.replace(right, wrong, 1), encoding="utf-8")
    for line in (["lint", "mission.toml", "."], ["check", "--dry-run", "mission.toml"], ["run", "mission.toml"]):
        assert run(line) in (0, 1, 2)
        said = "".join(capsys.readouterr())
        assert said and COMMANDS.search(said) is None


def test_the_name_of_a_file_commands_nothing(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (project / f"a{EVIL.replace('/', '_')}.nddl").write_text("Foo   x;\n", encoding="utf-8")
    for line in (["lint", "."], ["lint", "--format", "github", "."], ["fmt", "--check", "."], ["fmt", "."]):
        run(line)
        said = "".join(capsys.readouterr())
        assert "nddl" in said and COMMANDS.search(said) is None


def test_a_page_keeps_its_colours_alone() -> None:
    assert (
        fitted(f"\x1b[1;31mred\x1b[0m {LINK}", None)
        == "\x1b[1;31mred\x1b[0m \ufffd]8;;http://localhost/\ufffd\\here\ufffd]8;;\ufffd\\"
    )


def test_a_name_is_no_html_in_a_report(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    mission = project / "mission.toml"
    text = mission.read_text(encoding="utf-8").replace('name = "survey"', f'name = "{HTML}"', 1)
    mission.write_text(text, encoding="utf-8")
    line = "check mission.toml --missions 1 --workers 1 --flights 0 --no-store"
    assert run(line.split()) in (0, 1)
    page = (project / "nddlc-report" / "report.html").read_text(encoding="utf-8")
    assert "alert(1)" in page and "<script>alert" not in page and "<img src=x" not in page
    for part in re.findall(r"<script[^>]*>(.*?)</script>", page, re.DOTALL):
        assert HTML not in part
    capsys.readouterr()


def test_a_long_search_says_how_to_do_without_conditions(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    clock = iter((0.0, 10.0, 40.0))
    monkeypatch.setattr("nddlc.seeking.time.monotonic", lambda: next(clock))
    monkeypatch.setenv("COLUMNS", "120")
    with SeekingDisplay(60.0) as seeking:
        seeking(5)
        seeking(20)
    assert capsys.readouterr().err.splitlines() == [
        "seeking causes and conditions: 5 flights in 10 s (causes: at most 60 s)",
        "seeking causes and conditions: 20 flights in 40 s (quicker: --no-conditions)",
    ]
