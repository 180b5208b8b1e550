"""Real editors, without a screen, with the files of editors/: what their users see."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
PART = "class Gps extends Timeline {\n    predicate Idle { }\n    predicate Active { int hits; }\n}\n"
MODEL = """\
#include "part.nddl"
Gps gps = new Gps();
goal(gps.Active first);
first.hits == 3; Gpz   other;
"""


COMMAND = [sys.executable, "-m", "nddlc.main", "lsp"]


def seen_by(editor: list[str], folder: Path) -> dict[str, Any]:
    """What a user of an editor sees, whose script opens the model in a folder and works with it."""
    (folder / "part.nddl").write_text(PART)
    (folder / "model.nddl").write_text(MODEL)
    environment = {
        **os.environ,
        "NDDLC_SCRIPT": str(folder),
        "HOME": str(folder),
        "XDG_STATE_HOME": str(folder),
        "PYTHONPATH": str(ROOT),
    }
    ended = subprocess.run(editor, env=environment, cwd=folder, capture_output=True, timeout=900, check=False)
    assert ended.returncode == 0, ended.stderr
    seen: dict[str, Any] = json.loads((folder / "seen.json").read_text())
    assert seen.get("problem") is None
    assert any("Gpz" in message for message in seen["wrong"])
    assert {"Active", "Idle"} <= set(seen["offered"])
    assert "Gps" in seen["action"]
    assert seen["mended"] == MODEL.replace("Gpz", "Gps")
    assert seen["renamed"] == seen["mended"].replace("Active", "Awake")
    assert (folder / "part.nddl").read_text() == PART.replace("Active", "Awake")
    assert "Gps other;\n" in seen["formatted"]
    assert (folder / "model.nddl").read_text() == seen["formatted"]
    return seen


@pytest.mark.skipif(shutil.which("nvim") is None, reason="there is no Neovim")
def test_a_user_of_neovim_can_work(tmp_path: Path) -> None:
    lua = "{" + ", ".join(f'"{word}"' for word in COMMAND) + "}"
    path = ROOT / "editors" / "neovim"
    set_up = [f"set runtimepath^={path}", f"lua vim.g.nddlc_command = {lua}", "runtime plugin/nddl.lua"]
    options = [word for each in set_up for word in ("--cmd", each)]
    script = Path(__file__).with_name("neovim.lua")
    editor = ["nvim", "--headless", "-u", "NONE", "-n", "-i", "NONE", *options, "-c", f"luafile {script}"]
    seen = seen_by(editor, tmp_path)
    assert seen["filetype"] == "nddl"
    assert seen["jumped"] == [3, 14]


def has_emacs() -> bool:
    """Whether there is an Emacs with Eglot."""
    emacs = shutil.which("emacs")
    asked = [str(emacs), "--batch", "--eval", "(kill-emacs (if (require 'eglot nil t) 0 1))"]
    return emacs is not None and subprocess.run(asked, capture_output=True, check=False).returncode == 0


def test_a_user_of_emacs_can_work(tmp_path: Path) -> None:
    if not has_emacs():
        pytest.skip("there is no Emacs with Eglot")
    words = " ".join(f'"{word}"' for word in COMMAND)
    path, script = ROOT / "editors" / "emacs", Path(__file__).with_name("emacs.el")
    seen = seen_by(
        ["emacs", "--batch", "-L", str(path), "--eval", f"(setq nddl-command '({words}))", "-l", str(script)], tmp_path
    )
    assert seen["mode"] == "nddl-mode"
    assert seen["jumped"] == ["part.nddl", 3, 14]
