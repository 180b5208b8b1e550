"""A real Neovim, without a screen, with the files of editors/neovim: what its user sees."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PART = "class Gps extends Timeline {\n    predicate Idle { }\n    predicate Active { int hits; }\n}\n"
MODEL = """\
#include "part.nddl"
Gps gps = new Gps();
goal(gps.Active first);
first.hits == 3; Gpz   other;
"""


@pytest.mark.skipif(shutil.which("nvim") is None, reason="there is no Neovim")
def test_a_user_of_neovim_can_work(tmp_path: Path) -> None:
    (tmp_path / "part.nddl").write_text(PART)
    (tmp_path / "model.nddl").write_text(MODEL)
    command = [sys.executable, "-m", "nddlc.main", "lsp"]
    lua = "{" + ", ".join(f'"{word}"' for word in command) + "}"
    environment = {
        **os.environ,
        "NDDLC_SCRIPT": str(tmp_path),
        "HOME": str(tmp_path),
        "XDG_STATE_HOME": str(tmp_path),
        "PYTHONPATH": str(ROOT),
    }
    path = ROOT / "editors" / "neovim"
    set_up = [f"set runtimepath^={path}", f"lua vim.g.nddlc_command = {lua}", "runtime plugin/nddl.lua"]
    options = [word for each in set_up for word in ("--cmd", each)]
    script = Path(__file__).with_name("neovim.lua")
    ended = subprocess.run(
        ["nvim", "--headless", "-u", "NONE", "-n", "-i", "NONE", *options, "-c", f"luafile {script}"],
        env=environment,
        cwd=tmp_path,
        capture_output=True,
        timeout=900,
        check=False,
    )
    assert ended.returncode == 0, ended.stderr
    seen = json.loads((tmp_path / "seen.json").read_text())
    assert seen.get("problem") is None
    assert seen["filetype"] == "nddl"
    assert any("Gpz" in message for message in seen["wrong"])
    assert seen["jumped"] == [3, 14]
    assert {"Active", "Idle"} <= set(seen["offered"])
    assert "Gps" in seen["action"]
    assert seen["mended"] == MODEL.replace("Gpz", "Gps")
    assert seen["renamed"] == seen["mended"].replace("Active", "Awake")
    assert (tmp_path / "part.nddl").read_text() == PART.replace("Active", "Awake")
    assert "Gps other;\n" in seen["formatted"]
    assert (tmp_path / "model.nddl").read_text() == seen["formatted"]
