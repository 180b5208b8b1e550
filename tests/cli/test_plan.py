"""`nddlc plan` as a user sees it: chart, table and verdict, as text, picture and page; reasons; limits."""

import io
import json
import re
import signal
import subprocess
import sys
from itertools import pairwise
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
TANK = """\
class Tank extends Reservoir { Tank(float first, float least, float most) { super(first, least, most); } }
class Lamp extends Timeline { predicate On { } }
Lamp::On { starts(Tank.consume c); c.quantity == 3.5; }
Tank tank = new Tank(10.0, 0.0, 20.0);
Lamp lamp = new Lamp();
close();
goal(lamp.On a);
a.start = 20;
a.end = 30;
goal(lamp.On b);
b.start = 40;
b.end = 60;
"""


def pigeons(count: int) -> str:
    """That many variables which differ, and one value too few: no bound tells."""
    lines = [f"int v{i} = [1 {count - 1}];\n" + "\n".join(f"neq(v{j}, v{i});" for j in range(i)) for i in range(count)]
    return "\n".join(lines)


LONG = pigeons(10)


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
    assert re.fullmatch(r"lamp +\|On=+\|Off=+\.+", lines[0])
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
    cells = re.findall(r"<td[^>]*>(.*?)</td>", page)
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
    monkeypatch.setattr("nddlc.cancellation._PROGRESS_SECONDS", 0.0)
    planned(tmp_path, LONG, "--strategy", "europa", "--max-steps", "3000")
    told = terminal.getvalue()
    assert re.search(r"\r0 s, \d+ steps, \d+ failed, depth \d+ +\r", told)
    assert told.endswith("\r" + " " * 70 + "\r")


def test_an_empty_horizon_is_a_wrong_use(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "model.nddl"
    path.write_text(TWO)
    assert run(["plan", "--horizon", "5", "5", str(path)]) == 2
    assert "the horizon from 5 to 5 is empty" in capsys.readouterr().err


def test_the_level_of_a_resource_is_drawn_from_step_to_step(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert planned(tmp_path, TANK) == 0
    told = capsys.readouterr().out
    assert re.search(r"^tank +\|10-+\|6\.5-+\|3-+$", told, re.M)
    assert planned(tmp_path, TANK, "--json") == 0
    levels = json.loads(capsys.readouterr().out)["levels"]
    assert levels == {"tank": {"limits": [0.0, 20.0], "steps": [[0, 10.0, 10.0], [20, 6.5, 6.5], [40, 3.0, 3.0]]}}
    assert planned(tmp_path, TANK, "--format", "svg") == 0
    picture = ElementTree.fromstring(capsys.readouterr().out)
    titles = [each.text for each in picture.iter("{http://www.w3.org/2000/svg}title")]
    assert titles[-3:] == ["tank: 10 from 0", "tank: 6.5 from 20", "tank: 3 from 40"]


def test_goals_that_are_not_planned_are_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert planned(tmp_path, TWO, "--horizon", "0", "12") == 1
    assert "the horizon from 0 to 12, see --horizon: c\n" in capsys.readouterr().out


def test_an_infinite_horizon_holds_what_never_ends(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = TWO.replace("c.duration = 5;", "c.duration = [5 +inf];")
    assert planned(tmp_path, text, "--horizon", "-inf", "inf", "--json") == 0
    last = json.loads(capsys.readouterr().out)["tokens"][-1]
    assert (last["state"], last["end"]) == ("ACTIVE", [15, "+inf"])
    assert planned(tmp_path, text, "--horizon", "-inf", "inf") == 0
    assert re.search(r"^lamp +\|On=+\|Off=+\.+>$", capsys.readouterr().out, re.M)


def test_values_that_the_search_found_are_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert planned(tmp_path, "int x = [1 3];\nint y = [1 3];\nint z = 5;\nneq(x, y);\n") == 0
    assert "x         1\ny         2\n\nplan found" in capsys.readouterr().out


def test_a_model_without_goals_has_nothing_to_plan(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert (
        planned(tmp_path, "class Lamp extends Timeline { predicate On { } }\nLamp lamp = new Lamp();\nclose();\n") == 0
    )
    assert capsys.readouterr().out.endswith("no goal asks for anything, so there was nothing to plan\n")


@pytest.mark.parametrize(
    ("step", "verdict"),
    [
        ("0.1", "no plan exists: all choices fail, after 0 steps"),
        (
            "0.0001",
            "no plan known: all flaws are resolved after 0 steps, 0 decisions in force, but bounds still move at "
            "model.nddl:4, so values may not exist",
        ),
    ],
)
def test_what_propagation_left_off_is_carried_on_or_told(
    step: str, verdict: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = f"float a = [0.0 100.0];\nfloat b = [0.0 100.0];\na == b + {step};\na == b;\n"
    assert planned(tmp_path, text) == 1
    assert capsys.readouterr().out.endswith(verdict + "\n")


@pytest.mark.parametrize("width", [40, 60, 80, 200])
def test_lines_are_no_wider_than_the_terminal(
    width: int, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    long = "lantern_that_bears_a_name_which_nobody_would_want_to_type"
    assert planned(tmp_path, TWO.replace("lamp.", f"{long}.").replace("Lamp lamp", f"Lamp {long}")) == 0
    assert all(len(line) <= width for line in capsys.readouterr().out.splitlines()[:-1])  # but for the verdict


def test_a_thousand_tokens_are_drawn_on_their_rows(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    goals = "".join(f"goal(lamp.On g{i});\ng{i}.start = {10 * i};\ng{i}.end = {10 * i + 9};\n" for i in range(1000))
    assert planned(tmp_path, TWO.partition("goal")[0] + goals, "--horizon", "0", "10000") == 0
    told = capsys.readouterr().out
    assert re.match(r"lamp +[|#=]{80,}\n", told)
    assert "`#` several tokens" in told


@pytest.mark.skipif(not hasattr(signal, "SIGINT") or sys.platform == "win32", reason="Ctrl-C is no signal there")
def test_an_interrupted_search_shows_how_far_it_came(tmp_path: Path) -> None:
    path = tmp_path / "model.nddl"
    path.write_text(pigeons(12))
    code = (
        "import os, signal, sys, threading, time\n"
        "from nddlc.main import run\n"
        "from nddlc.cancellation import Clock\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "enter = Clock.__enter__\n"
        "def entered(clock):\n"
        "    threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()\n"
        "    return enter(clock)\n"
        "Clock.__enter__ = entered\n"
        f"sys.exit(run(['plan', '--strategy', 'europa', {str(path)!r}]))\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=60)
    assert re.search(r"^v0 +1\n", done.stdout, re.M)
    assert re.search(r"no plan found yet: interrupted after \d+ steps, \d+ decisions in force\n$", done.stdout)
    assert done.returncode == 130


def test_variables_of_tokens_that_rules_made_are_shown_with_the_token_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert planned(tmp_path, TANK) == 0
    assert "variable" not in capsys.readouterr().out
    (tmp_path / "active.nddl").write_text(TANK + "a.activate();\n")
    assert run(["load", str(tmp_path / "active.nddl")]) == 0
    told = capsys.readouterr().out
    assert "\nTank.consume#1 " in told
    assert "Tank.consume#1.start" not in told


MOVABLE = """\
class Lamp extends Timeline { predicate On { float power; } }
Lamp lamp = new Lamp();
close();
float share = [0 1];
share == 0.1 + 0.2;
goal(lamp.On first);
first.start = [0 20];
first.duration = 10;
first.power == 59.3 * 0.1;
goal(lamp.On second);
second.start = [15 20];
second.end = 40;
first before second;
"""


def test_times_that_are_open_are_drawn_with_their_range(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert planned(tmp_path, MOVABLE) == 0
    first, second, _, legend, *_ = capsys.readouterr().out.splitlines()
    assert re.fullmatch(r"lamp +\|On=+\.+", first) and re.fullmatch(r" +\|On=+", second)
    assert first.count(".") == pytest.approx(first.count("=") + 3, abs=2)  # until 10 at the earliest, 20 at the latest
    assert legend == "each token as early as it can be; `.` where it may be later"
    assert planned(tmp_path, MOVABLE, "--format", "svg") == 0
    picture = ElementTree.fromstring(capsys.readouterr().out)
    boxes = [
        (round(float(each.attrib["x"]) - 48), round(float(each.attrib["width"])), each.attrib.get("fill-opacity"))
        for each in picture.iter("{http://www.w3.org/2000/svg}rect")
        if each.attrib["fill"] != "none"
    ]
    # 22.5 pixels a tick: where a token may hold, where it does if it is early, and where it does in any case.
    assert boxes == [(0, 450, "0.2"), (0, 225, "0.35"), (338, 562, "0.2"), (338, 562, "0.35"), (450, 450, None)]


def test_where_many_tokens_may_move_they_are_drawn_early(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    names = [f"t{number}" for number in range(12)]
    times = "0 <= {0}.start;\n{0}.duration = 2;\n{0}.end <= 90;\n"
    goals = "".join(f"goal(lamp.On {name});\n{times.format(name)}" for name in names)
    order = "".join(f"{one} before {other};\n" for one, other in pairwise(names))
    head = "class Lamp extends Timeline { predicate On { } }\nLamp lamp = new Lamp();\nclose();\n"
    assert planned(tmp_path, head + goals + order) == 0
    row, _, legend, *_ = capsys.readouterr().out.splitlines()
    assert row.count("|On") == 12 and "." not in row
    assert legend == "each token as early as it can be"


def test_numbers_are_shown_as_they_are_read(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert planned(tmp_path, MOVABLE) == 0
    said = capsys.readouterr().out
    assert "power=5.93" in said and "00000000" not in said and "99999" not in said
    assert planned(tmp_path, MOVABLE, "--json") == 0
    assert "0.30000000000000004" in capsys.readouterr().out


BOATS = """\
class Dock { int n; Dock(int k) { n = k; } }
class Boat extends Timeline { predicate Go { } predicate At { Dock d; } }
Dock a = new Dock(1);
Dock b = new Dock(2);
Boat boat = new Boat();
Boat::Go {
  Dock choice;
  foreach (x in choice) { met_by(At t); t.d == x; }
}
close();
goal(boat.Go g);
g.start >= 0;
g.end <= 20;
"""


def test_a_value_that_a_foreach_went_through_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "boats.nddl").write_text(BOATS)
    assert run(["plan", "--explain", str(tmp_path / "boats.nddl")]) == 1
    told = capsys.readouterr().out
    assert "g::choice may not lose a value any more: `foreach` has gone through {a, b}" in told


LOOSE = """\
class Valve extends Timeline { predicate Open { } }
class Panel extends Timeline { predicate Flush { } }
Panel::Flush { contains(Valve.Open o); }
Valve valve = new Valve();
Panel panel = new Panel();
close();
goal(panel.Flush flush);
flush.activate();
"""


def test_an_activated_goal_of_which_nothing_is_planned_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model = tmp_path / "loose.nddl"
    model.write_text(LOOSE)
    assert run(["plan", str(model)]) == 1
    told = capsys.readouterr().out
    assert "nothing planned of what these ask for, since they may lie outside the horizon from 0 to 1000" in told
    assert told.rstrip().endswith("but 1 goal left out")
    assert run(["plan", str(model), "--allow-unplanned"]) == 0
    model.write_text(
        LOOSE.replace("flush.activate();", "flush.start = [0 10];\nflush.end = [0 50];\nflush.activate();")
    )
    assert run(["plan", str(model)]) == 0
