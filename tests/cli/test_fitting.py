"""What commands print fits the terminal, from 60 columns on."""

import re
from pathlib import Path

import pytest

from nddlc.fitting import fitted, linked
from nddlc.main import run

ROOT = Path(__file__).parents[2]
GPS = str(ROOT / "models/gps/mission.toml")
WRONG = """class Boat extends Timeline { predicate Sail { int speed; int heading; } }
Boat::Sail { int a = 1; int bcdef = 2; int ghijk = 3; eq(speed, heading); unknown_constraint(speed, heading, a); }
"""


def test_words_are_wrapped_below_where_they_begin() -> None:
    text = "  cause: change it here, or there\n   2  tick 5: one two three four five\nshort\n"
    assert fitted(text, 24).split("\n") == [
        "  cause: change it here,",
        "    or there",
        "   2  tick 5: one two",
        "            three four",
        "            five",
        "short",
        "",
    ]


def test_a_line_of_source_is_cut_around_what_is_marked() -> None:
    text = "  7 | aaaaaaaaaa bbbbbbbbbb cccccccccc dddd eeeeeeeeeeee\n    |                                  ^^^^\n"
    assert fitted(text, 30).split("\n") == [
        "  7 | …bbbbbb cccccccccc dddd…",
        "    |                    ^^^^",
        "",
    ]


def test_colours_take_no_room() -> None:
    text = "\x1b[1mone two three\x1b[0m four five\n"
    assert fitted(text, 24) == text
    assert fitted(text, 20) == "\x1b[1mone two three\x1b[0m four\n  five\n"


def test_without_a_width_nothing_changes() -> None:
    text = "word " * 100
    assert fitted(text, None) == text


@pytest.mark.once
@pytest.mark.parametrize("width", [60, 80, 200])
def test_commands_fit(
    width: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    monkeypatch.chdir(tmp_path)
    Path("wrong.nddl").write_text(WRONG, encoding="utf-8")
    for words in (
        ["run", GPS, "--seed", "7"],
        ["check", GPS, "--missions", "16", "--workers", "1", "--flights", "3"],
        ["explain", "latest", "--flights", "3"],
        ["plan", str(ROOT / "models/classic/blocks.nddl")],
        ["load", str(ROOT / "models/classic/blocks.nddl")],
        ["lint", "wrong.nddl"],
        ["check", "wrong.nddl"],
        ["lint", "no-such-file.nddl"],
    ):
        run(words)
        out, err = capsys.readouterr()
        lines = f"{out}{err}".split("\n")
        assert len(lines) > 1, words
        for line in lines:
            longest = max(map(len, re.findall(r"\S+", line)), default=0)  # a path is not broken
            assert len(line) <= width or longest > width // 2, (words, line)
        if words[0] == "run":
            assert max(map(len, lines)) > width - 20  # the chart takes the room there is


def test_places_are_links_on_a_terminal(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a b.nddl").write_text("int x;\n", encoding="utf-8")
    uri = (tmp_path / "a b.nddl").as_uri()
    at = "a b.nddl:3:14"
    page = f"\x1b[1;34m  -->\x1b[0m {at}\n --> gone.nddl:3\nsee --> {at}\n   --> {at} (where it breaks)\n"
    link = f"\x1b]8;;{uri}#3\x1b\\{at}\x1b]8;;\x1b\\"
    told = f"\x1b[1;34m  -->\x1b[0m {link}\n --> gone.nddl:3\nsee --> {at}\n   --> {link} (where it breaks)\n"
    assert linked(page) == told
