"""The sessions of a page of the docs: blocks of commands with what they print, carried out one after the other.

`python -m tests.docs.sessions PAGE...` writes what is printed today into the pages.
"""

import os
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"
PAGES = (DOCS / "tutorial.md", DOCS / "cookbook.md")
_BLOCK = re.compile(r"(?<=^```console\n).*?(?=^```$)", re.DOTALL | re.MULTILINE)
# What differs from machine to machine, time to time, and one version of nddlc to the next: ids of runs, and dates.
_CHANGING = re.compile(r"\b[0-9a-f]{8}\b|\d{4}-\d\d-\d\dT[\d:]+\+00:00")
_PROGRAMS = {"nddlc": "-P -m nddlc.main", "python3": ""}  # what pages call, as this environment has it
_LONGEST = 120  # seconds for one command


@dataclass(frozen=True)
class Step:
    """A command of a page, and what the page says that it prints."""

    command: str
    printed: str


def sessions(text: str) -> list[list[Step]]:
    """The blocks of a page; a line that begins with `$ ` is a command."""
    return [_steps(block.group()) for block in _BLOCK.finditer(text)]


def carry_out(steps: list[Step], folder: Path) -> list[Step]:
    """The commands with what they print now, in a folder that `cd` of an earlier one may have changed."""
    done: list[Step] = []
    place = folder
    for step in steps:
        script = f"{step.command}\nprintf '\\0%s' \"$PWD\""
        environment = {**os.environ, "NO_COLOR": "1", "COLUMNS": "110", "PYTHONPATH": str(DOCS.parent)}
        defined = "".join(f'{name}() {{ "{sys.executable}" {what} "$@"; }}\n' for name, what in _PROGRAMS.items())
        shell = ["bash", "-c", defined + script]
        ended = subprocess.run(shell, cwd=place, env=environment, capture_output=True, text=True, timeout=_LONGEST)
        printed, _, where = ended.stdout.rpartition("\0")
        place = Path(where)
        done.append(Step(step.command, printed))
    return done


def place_after(steps: list[Step], folder: Path) -> Path:
    """Where a block leaves one that began in `folder`, by the `cd` commands in it."""
    for step in steps:
        if step.command.startswith("cd "):
            folder = folder / step.command.removeprefix("cd ")
    return folder


def comparable(text: str) -> str:
    """A text without what may change, and without blanks at the ends of lines."""
    return "\n".join(line.rstrip() for line in _CHANGING.sub("ID", text).strip().splitlines())


def rewritten(text: str, folder: Path) -> str:
    """A page with what its commands print now."""
    pieces, last, place = [], 0, folder
    for block in _BLOCK.finditer(text):
        steps = carry_out(_steps(block.group()), place)
        place = place_after(steps, place)
        pieces += [text[last : block.start()], "".join(f"$ {step.command}\n{_ended(step.printed)}" for step in steps)]
        last = block.end()
    return "".join(pieces) + text[last:]


def _steps(block: str) -> list[Step]:
    steps: list[Step] = []
    for piece in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
        command, _, printed = piece.partition("\n")
        steps.append(Step(command, printed))
    return steps


def _ended(printed: str) -> str:
    lines = [line.rstrip() for line in printed.strip("\n").splitlines()]
    return "".join(f"{line}\n" for line in lines)


def main() -> None:
    """Write the pages that are named anew, or all."""
    for page in [Path(name) for name in sys.argv[1:]] or PAGES:
        with tempfile.TemporaryDirectory() as folder:
            page.write_text(rewritten(page.read_text(encoding="utf-8"), Path(folder)), encoding="utf-8")


if __name__ == "__main__":
    main()
