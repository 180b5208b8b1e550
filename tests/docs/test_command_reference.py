"""The reference of the command line says what the commands take."""

import shutil
import subprocess

import pytest

from nddlc.main import COMMANDS
from tests.docs.command_reference import DOCS, pages


@pytest.mark.parametrize("name", list(pages()))
def test_the_reference_is_that_of_the_commands(name: str) -> None:
    assert (DOCS / name).read_text(encoding="utf-8") == pages()[name], "run python -m tests.docs.command_reference"


def test_every_command_and_option_is_told() -> None:
    text = pages()["commands.md"]
    for name in COMMANDS:
        assert f"\n## nddlc {name}\n" in text
    for option in ("--max-failures", "--install-completion", "--template", "--unsafe-fixes"):
        assert option in text


@pytest.mark.skipif(shutil.which("groff") is None, reason="no groff here")
def test_the_man_page_is_read_without_a_complaint() -> None:
    page = subprocess.run(
        ["groff", "-man", "-Tutf8", "-ww", str(DOCS / "nddlc.1")], capture_output=True, text=True, check=True
    )
    assert page.stderr == "" and "130 interrupted" in page.stdout
