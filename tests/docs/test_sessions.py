"""What a page of the docs says that a command prints, it prints."""

from pathlib import Path

import pytest

from tests.docs.sessions import PAGES, Step, carry_out, comparable, place_after, sessions


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_the_commands_of_a_page_print_what_it_says(page: Path, tmp_path: Path) -> None:
    blocks = sessions(page.read_text(encoding="utf-8"))
    assert blocks
    place = tmp_path
    for block in blocks:
        for said, done in zip(block, carry_out(block, place), strict=True):
            assert comparable(done.printed) == comparable(said.printed), said.command
        place = place_after(block, place)


def test_another_output_is_noticed(tmp_path: Path) -> None:
    (block,) = sessions("text\n```console\n$ echo a; cd /\nb\n$ pwd\n/\n```\n")
    assert block == [Step("echo a; cd /", "b\n"), Step("pwd", "/\n")]
    assert [step.printed for step in carry_out(block, tmp_path)] == ["a\n", "/\n"]
    assert comparable("run 0a1b2c3d, seed 1 \n") == comparable("run 9deadbe9, seed 1")
    assert comparable("run 0a1b2c3d, seed 1") != comparable("run 0a1b2c3d, seed 2")
