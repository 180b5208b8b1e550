"""Every case of the conformance suite, and our own, in the portable dialect: what comes out against what must."""

import json
import re
from pathlib import Path

import pytest

from nddlc.main import run
from tests.conformance.judge import Facts, differences

HERE = Path(__file__).parent
CASES = HERE / "cases"
FOLDERS = {path.stem: folder for folder in (CASES, HERE / "own") for path in folder.glob("*.json")}
NAMES = sorted(FOLDERS)
MOST_STEPS = 2000


def command_line(name: str, solve: Facts | None) -> list[str]:
    """How a case is run."""
    common = ["--json", "--include", str(CASES / "include"), str(FOLDERS[name] / f"{name}.nddl")]
    if solve is None:
        return ["--dialect", "nddl3", "load", *common]
    horizon = ["--horizon", *map(str, solve["horizon"])]
    limit = ["--max-steps", str(solve.get("max_steps", MOST_STEPS))]
    config = ["--config", str(HERE / "configs" / f"{solve['config']}.xml")]
    return ["--dialect", "nddl3", "plan", *config, *horizon, *limit, *common]


@pytest.mark.parametrize("name", NAMES)
def test_case(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    want = json.loads((FOLDERS[name] / f"{name}.json").read_text(encoding="utf-8"))["expect"]
    text = (FOLDERS[name] / f"{name}.nddl").read_bytes().decode("latin-1")
    code = run(command_line(name, want.get("solve")))
    told = capsys.readouterr()
    if code in (0, 1):
        found = differences(want, json.loads(told.out), set(re.findall(r"\benum\s+(\w+)", text)))
    else:
        found = [f"exit code {code}: {told.err}"]
    assert not found, "\n".join(found)


def test_no_case_of_our_own_hides_a_public_one() -> None:
    assert not {path.stem for path in CASES.glob("*.json")} & {path.stem for path in (HERE / "own").glob("*.json")}
