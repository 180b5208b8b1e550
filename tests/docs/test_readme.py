"""What README.md shows of a check of models/gps is what that prints; `...` stands for what is left out."""

import re
from pathlib import Path

import pytest

from tests.docs.sessions import Step, carry_out, comparable

ROOT = Path(__file__).parents[2]
BLOCK = re.compile(r"^```\n\$ (nddlc check models/gps/mission\.toml)\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def pattern_of(said: str) -> str:
    """A regular expression for an excerpt: `...` alone on a line is any lines, else any text within a line."""
    lines = [re.escape(line).replace(re.escape("..."), ".*") for line in comparable(said).splitlines()]
    return "".join(r"(?:.*\n)*?" if line.strip("\\ ") == ".*" else f"{line}\n" for line in lines)


@pytest.mark.once
def test_readme_shows_what_a_check_prints(tmp_path: Path) -> None:
    (found,) = BLOCK.findall((ROOT / "README.md").read_text(encoding="utf-8"))
    command, said = found
    (tmp_path / "models").symlink_to(ROOT / "models")
    (done,) = carry_out([Step(f"COLUMNS=400 {command}", said)], tmp_path)  # no line is folded
    assert re.fullmatch(pattern_of(said), comparable(done.printed) + "\n"), done.printed


@pytest.mark.parametrize(("said", "is_so"), [("a 5 of ...\n", True), ("a 6 of 7\n", False), ("  ...\nb\n", False)])
def test_an_excerpt_is_compared_with_all_that_is_printed(said: str, is_so: bool) -> None:
    assert bool(re.fullmatch(pattern_of(said), "a 5 of 7\n")) == is_so
