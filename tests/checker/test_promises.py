"""A violated property is told with what became of the requests for what it promises."""

import shutil
from pathlib import Path

import pytest

from nddlc.main import run

pytestmark = pytest.mark.once

LOOKOUT = Path(__file__).parents[2] / "models/templates/lookout"


def test_the_story_of_a_property_tells_what_was_asked_for_and_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for each in ("ship.nddl", "mission.toml", "lookout.py"):
        shutil.copy(LOOKOUT / each, tmp_path)
    monkeypatch.chdir(tmp_path)
    code = Path("lookout.py").read_text(encoding="utf-8")
    Path("lookout.py").write_text(code.replace('"Slow", start', '"Slow", knots=3, start'), encoding="utf-8")
    assert run(["check", "--missions", "2", "--workers", "1", "--flights", "0", "--trust"]) == 1
    capsys.readouterr()
    assert run(["explain", "latest", "--flights", "0", "--trust"]) == 0
    lines = [line for line in capsys.readouterr().out.splitlines() if " tick " in f" {line}"]
    seen, asked, refused = (
        next(at for at, line in enumerate(lines) if words in line)
        for words in ("publishes whales = Seen", "requests Slow(knots=3) on ship", "refuse Slow(knots=3)")
    )
    assert seen < asked < refused
    assert "there is no parameter `knots` (there is none)" in lines[refused]
