"""`nddlc plan` as a user sees it: chart, table and verdict, as text, picture and page; reasons; limits."""

import io
import re
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

from nddlc.main import run

TWO = """\
class Lamp extends Timeline { predicate On { int level; } predicate Off { } }
Lamp lamp = new Lamp();
close();
goal(lamp.On a);
a.start = 0;
a.end = 10;
goal(lamp.On b);
b.start = [0 5];
goal(lamp.Off c);
c.start = [10 20];
c.duration = 5;
"""
CLASH = """\
class Lamp extends Timeline { predicate On { } predicate Off { } }
Lamp lamp = new Lamp();
close();
goal(lamp.On a);
goal(lamp.Off b);
a.start = 0;
b.start = 0;
"""
LONG = "\n".join(
    f"int v{i} = [1 9];\n" + "\n".join(f"neq(v{j}, v{i});" for j in range(i)) for i in range(10)
)  # ten that differ, nine values: no bound tells


class Terminal(io.StringIO):
    """A stream that says that somebody looks at it."""

    def isatty(self) -> bool:
        return True


def planned(folder: Path, text: str, *options: str) -> int:
    path = folder / "model.nddl"
    path.write_text(text)
    return run(["plan", "--horizon", "0", "100", *options, str(path)])


def test_a_plan_is_a_chart_a_table_and_a_verdict(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert planned(tmp_path, TWO) == 0
    lines = capsys.readouterr().out.splitlines()
    assert re.fullmatch(r"lamp +\|On=+\|Off=+", lines[0])
    assert any(re.match(r"b +Lamp\.On +MERGED a$", line) for line in lines)
    assert re.fullmatch(r"plan found after \d+ steps, \d+ decisions in force", lines[-1])


def test_a_picture_holds_every_active_token(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert planned(tmp_path, TWO, "--format", "svg") == 0
    picture = ElementTree.fromstring(capsys.readouterr().out)
    titles = [each.text or "" for each in picture.iter("{http://www.w3.org/2000/svg}title")]
    assert [title.split()[0].rstrip(":,") for title in titles] == ["a", "c"]


def test_a_page_says_what_the_text_says(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert planned(tmp_path, TWO) == 0
    text = capsys.readouterr().out
    assert planned(tmp_path, TWO, "--format", "html") == 0
    page = capsys.readouterr().out
    cells = re.findall(r"<td>(.*?)</td>", page)
    assert "MERGED a" in cells
    assert all(cell in text for cell in cells)
    assert text.splitlines()[-1] in page
    assert "<svg" in page


def test_a_page_without_a_plan_says_why(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert planned(tmp_path, CLASH, "--format", "html", "--explain") == 1
    page = capsys.readouterr().out
    assert "<svg" not in page
    assert "no plan exists: all choices fail" in page
    assert "model.nddl:6: `a.start = 0;`" in page


def test_an_explanation_names_lines_of_the_model(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert planned(tmp_path, CLASH, "--explain") == 1
    told = capsys.readouterr().out
    assert "why there is no plan:" in told
    assert "model.nddl:6: `a.start = 0;`" in told
    assert "model.nddl:7: `b.start = 0;`" in told


def test_a_search_stops_when_time_is_over(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert planned(tmp_path, LONG, "--strategy", "europa", "--max-seconds", "0.001") == 1
    assert re.search(r"no plan found yet: stopped after \d+ steps", capsys.readouterr().out)


def test_progress_is_told_on_a_terminal_and_wiped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setattr("nddlc.plan.PATIENCE", 0.0)
    planned(tmp_path, LONG, "--strategy", "europa", "--max-steps", "3000")
    told = terminal.getvalue()
    assert re.search(r"\r0 s, \d+ steps, \d+ failed, depth \d+ +\r", told)
    assert told.endswith("\r" + " " * 70 + "\r")


def test_an_empty_horizon_is_a_wrong_use(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "model.nddl"
    path.write_text(TWO)
    assert run(["plan", "--horizon", "5", "5", str(path)]) == 2
    assert "the horizon from 5 to 5 is empty" in capsys.readouterr().err
