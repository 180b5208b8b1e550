"""What a mission is read with: the files that settings of reactors in Python name, whatever they are."""

import os
from pathlib import Path

from checker.mission import read_mission
from checker.models import load_models
from nddl_lang.text.read import LARGEST

MISSION = """
[mission]
name = "named"
final_tick = 5
[[reactor]]
name = "eye"
code = "code.py:Eye"
internal = ["eye"]
[reactor.settings]
table = "table.csv"
large = "large.csv"
endless = "/dev/zero"
pipe = "pipe"
text = "no name of a file"
[[reactor]]
name = "user"
model = "user.nddl"
lookahead = 10
external = ["eye"]
"""
USER = """#include "TREX.nddl"
class Eye extends AgentTimeline { predicate Dark { } Eye(Mode m) { super(m, "Dark"); } }
Eye eye = new Eye(Observe); close();
"""


def texts(folder: Path) -> dict[str, str]:
    mission, found = read_mission(folder / "mission.toml")
    assert mission is not None, found
    return load_models(mission).texts


def test_files_that_settings_name_belong_to_a_run_within_limits(tmp_path: Path) -> None:
    (tmp_path / "mission.toml").write_text(MISSION)
    (tmp_path / "user.nddl").write_text(USER)
    (tmp_path / "code.py").write_text("from runtime.user.reactor import Reactor\n\nclass Eye(Reactor):\n    pass\n")
    (tmp_path / "table.csv").write_text("1,2")
    os.mkfifo(tmp_path / "pipe")
    with (tmp_path / "large.csv").open("wb") as large:
        large.truncate(LARGEST + 1)
    first = texts(tmp_path)
    assert first["table.csv"] == "1,2"
    assert len(first["large.csv"]) == 64
    assert not {"/dev/zero", "pipe", "no name of a file"} & first.keys()
    with (tmp_path / "large.csv").open("r+b") as large:
        large.write(b"1")
    assert texts(tmp_path)["large.csv"] != first["large.csv"]
