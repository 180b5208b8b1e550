"""Nothing of a project is run unless the user said so: modules that would leave a mark are read, named or refused."""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from lsp.documents import Documents
from lsp.project import ServerSettings
from nddl_lang.lint.python_module import read_module
from nddlc.editor import known_to_editor
from nddlc.main import run
from tests.user_constraints.own import HEAD, TWICE

pytestmark = pytest.mark.once

Captured = pytest.CaptureFixture[str]
MODEL = "int x = [1 10];\nint y = [0 13];\ntwice(y, x);\n"
ROOT = Path(__file__).parents[2]
MISSION = """
[mission]
name = "m"
final_tick = 5
[constraints]
modules = ["{module}"]
[[reactor]]
name = "r"
model = "m.nddl"
internal = []
[[reactor]]
name = "coded"
code = "{code}"
[reactor.settings]
trace = "played.jsonl"
reactor = "coded"
"""


class Trap:
    """A folder where a module leaves a mark as soon as it is run."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.mark = folder / "mark"
        self.text = f"from pathlib import Path\nPath({str(self.mark)!r}).touch()\n{HEAD}{TWICE}"

    def lay(self, place: str, model: str, module: str, configuration: str = "nddlc.toml") -> Path:
        """Put the module at `place`, and a model with a configuration that names it as `module`."""
        path = self.folder / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(self.text, encoding="utf-8")
        file = self.folder / model
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(MODEL, encoding="utf-8")
        (self.folder / configuration).write_text(f"[constraints]\nmodules = [{module!r}]\n", encoding="utf-8")
        return file

    def has_sprung(self) -> bool:
        """Whether the module was run since this was asked last."""
        found = self.mark.exists()
        self.mark.unlink(missing_ok=True)
        return found


@pytest.fixture
def trap(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Trap:
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    return Trap(tmp_path)


def opened(file: Path, *, is_trusted: bool = False) -> list[str]:
    documents = Documents(ServerSettings(is_trusted=is_trusted, know=known_to_editor))
    news = documents.open(file.as_uri(), 1, file.read_text(encoding="utf-8"))
    return [str(each.code) for publication in news for each in publication.diagnostics]


def test_opening_and_linting_read_and_do_not_run(trap: Trap, capsys: Captured) -> None:
    file = trap.lay("ws/own.py", "ws/m.nddl", "own.py", "ws/nddlc.toml")
    assert opened(file) == []
    assert run(["lint", str(file)]) == 0
    assert run(["check", str(file)]) == 0
    assert run(["fmt", "--check", str(file)]) == 0
    assert not trap.has_sprung()
    file.write_text("int x = [1 10];\ntwice(x);\n", encoding="utf-8")
    assert opened(file) == ["NDDL320"]
    assert run(["lint", str(file)]) == 1
    assert "`twice`" in capsys.readouterr().out
    assert not trap.has_sprung()
    assert opened(file, is_trusted=True) == ["NDDL320"]
    assert trap.has_sprung()


COMMANDS: dict[str, Callable[[Path], list[str]]] = {
    "load": lambda file: ["load", str(file)],
    "plan": lambda file: ["plan", str(file)],
    "compile": lambda file: ["compile", str(file)],
}


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize(
    ("place", "model", "module", "configuration"),
    [
        ("evil.py", "ws/m.nddl", "../evil.py", "ws/nddlc.toml"),
        ("evil.py", "ws/m.nddl", "{folder}/evil.py", "ws/nddlc.toml"),
        ("evil.py", "ws/m.nddl", "sub/../../evil.py", "ws/nddlc.toml"),
        ("evil.py", "ws/a/b/c/m.nddl", "evil.py", "nddlc.toml"),
        ("ws/own.py", "ws/a/b/c/m.nddl", "own.py", "ws/nddlc.toml"),
    ],
)
def test_what_lies_outside_is_refused_with_its_place(
    command: str, place: str, model: str, module: str, configuration: str, trap: Trap, capsys: Captured
) -> None:
    (trap.folder / "ws" / "sub").mkdir(parents=True)
    file = trap.lay(place, model, module.format(folder=trap.folder), configuration)
    assert run(COMMANDS[command](file)) == 2
    told = capsys.readouterr().err
    assert told.count("NDDL599") == 1 and "nddlc.toml:2" in told and "--trust" in told
    assert not trap.has_sprung()
    run([*COMMANDS[command](file), "--trust"])
    assert trap.has_sprung()


def test_a_link_does_not_lead_outside(trap: Trap) -> None:
    file = trap.lay("evil.py", "ws/m.nddl", "own.py", "ws/nddlc.toml")
    (trap.folder / "ws" / "own.py").symlink_to(trap.folder / "evil.py")
    assert run(["load", str(file)]) == 2
    assert not trap.has_sprung()


def test_a_linked_model_does_not_name_another_project(trap: Trap) -> None:
    trap.lay("other/own.py", "other/m.nddl", "own.py", "other/nddlc.toml")
    (trap.folder / "ws").mkdir()
    (trap.folder / "ws" / "m.nddl").symlink_to(trap.folder / "other" / "m.nddl")
    assert run(["load", str(trap.folder / "ws" / "m.nddl")]) == 2
    assert not trap.has_sprung()


def test_the_named_folder_and_the_one_stood_in_are_the_project(trap: Trap, monkeypatch: pytest.MonkeyPatch) -> None:
    file = trap.lay("ws/own.py", "ws/m.nddl", "own.py", "ws/nddlc.toml")
    assert run(["load", str(file)]) == 0
    assert trap.has_sprung()
    deep = trap.lay("ws2/own.py", "ws2/a/b/m.nddl", "own.py", "ws2/nddlc.toml")
    assert run(["load", str(deep)]) == 2
    assert not trap.has_sprung()
    monkeypatch.chdir(trap.folder / "ws2")
    assert run(["load", "a/b/m.nddl"]) == 0
    assert trap.has_sprung()


@pytest.mark.parametrize(
    ("module", "code"),
    [("../evil.py", ":LogPlayer"), ("own.py", "../evil.py:Evil"), ("own.py", "{folder}/evil.py:Evil")],
)
@pytest.mark.parametrize("command", ["check", "run", "gold", "validate", "compile"])
def test_a_mission_runs_what_lies_below_it_only(
    command: str, module: str, code: str, trap: Trap, capsys: Captured
) -> None:
    file = trap.lay("evil.py", "ws/m.nddl", "own.py")
    (trap.folder / "ws" / "own.py").write_text(f"{HEAD}{TWICE}", encoding="utf-8")
    file.with_name("played.jsonl").write_text('{"tick":0,"kind":"observation","reactor":"coded"}\n', encoding="utf-8")
    mission = file.with_name("mission.toml")
    mission.write_text(MISSION.format(module=module, code=code.format(folder=trap.folder)), encoding="utf-8")
    action = ["diff"] if command == "gold" else []
    assert run([command, *action, str(mission)]) == 2
    told = capsys.readouterr().err
    assert "NDDL599" in told and "mission.toml:" in told
    assert not trap.has_sprung()


def test_a_trace_and_a_store_name_no_project(trap: Trap, capsys: Captured) -> None:
    file = trap.lay("ws/own.py", "ws/m.nddl", "own.py", "ws/nddlc.toml")
    mission = file.with_name("mission.toml")
    text = MISSION.format(module="own.py", code=":LogPlayer").partition('[[reactor]]\nname = "coded"')[0]
    mission.write_text(text, encoding="utf-8")
    assert run(["run", str(mission), "--trace", "t.jsonl"]) == 0
    assert run(["check", str(mission), "--missions", "2"]) == 0
    assert trap.has_sprung()
    assert run(["replay", "t.jsonl"]) == 2
    assert run(["explain", "latest#1"]) == 2
    assert capsys.readouterr().err.count("NDDL599") == 2
    assert not trap.has_sprung()
    assert run(["replay", "t.jsonl", "--mission", str(mission)]) == 0
    assert run(["explain", "latest#1", "--trust"]) == 0


def test_processes_that_fly_do_not_import_from_the_folder_stood_in(tmp_path: Path) -> None:
    mark = tmp_path / "mark"
    for name in ("multiprocessing", "json", "click", "numpy", "struct"):
        (tmp_path / f"{name}.py").write_text(f"open({str(mark)!r}, 'w').write({name!r})\n", encoding="utf-8")
    (tmp_path / "bin").mkdir()
    script = tmp_path / "bin" / "start.py"
    script.write_text("from nddlc.main import main\nif __name__ == '__main__':\n    main()\n", encoding="utf-8")
    mission = ROOT / "models" / "gps" / "mission.toml"
    words = [sys.executable, str(script), "check", str(mission), "--missions", "2", "--workers", "1", "--no-store"]
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONSAFEPATH"}
    environment |= {"PYTHONPATH": str(ROOT)}
    done = subprocess.run(words, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert not mark.exists()
    assert "missions" in done.stdout, done.stderr


def test_a_module_that_cannot_be_read_hides_names(trap: Trap, capsys: Captured) -> None:
    file = trap.lay("ws/own.py", "ws/m.nddl", "own.py", "ws/nddlc.toml")
    (trap.folder / "ws" / "own.py").write_text(f"{HEAD}CONSTRAINTS = [each() for each in ()]\n", encoding="utf-8")
    assert opened(file) == ["NDDL598"]
    assert run(["lint", "--format", "json", str(file)]) == 1
    (told,) = json.loads(capsys.readouterr().out)["diagnostics"]
    assert told["code"] == "NDDL598" and told["file"].endswith("nddlc.toml")


def described(text: str) -> list[tuple[Any, ...]]:
    read = read_module(HEAD + text)
    return [
        *((each.name, each.signature, each.result, each.gives) for _, each in read.found),
        *((gap.line, gap.reason) for gap in read.gaps),
    ]


NEAR = 'class Near(Constraint):\n    name = "near_to"\n    signature = "x:number y:number"\n    meaning = "near"\n'


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (NEAR + "CONSTRAINTS = [Near()]", [("near_to", "x:number y:number", None, None)]),
        (NEAR + "CONSTRAINTS = Near()", [("near_to", "x:number y:number", None, None)]),
        (
            NEAR + "Near.gives = 'float'\nmine = Near()\nCONSTRAINTS = (mine,)",
            [("near_to", "x:number y:number", None, "float")],
        ),
        (
            NEAR + "class Far(Near):\n    name = 'far' '_off'\n    result = -1\n"
            "CONSTRAINTS = [Near()]\nCONSTRAINTS += [Far()]",
            [("near_to", "x:number y:number", None, None), ("far_off", "x:number y:number", -1, None)],
        ),
        (NEAR + "CONSTRAINTS = []\nCONSTRAINTS.append(Near())", [("near_to", "x:number y:number", None, None)]),
        (
            "NAME = 'kn'\nCONSTRAINTS = [function(f'{NAME}ots', 'speed:number', 'float', lambda s: s * 2, 'knots')]",
            [("knots", "result:number speed:number", 0, "float")],
        ),
        (
            "CONSTRAINTS = [function(meaning='m', name='even', result='bool', inputs='x:number', compute=abs)]",
            [("even", "result:bool x:number", 0, "bool")],
        ),
        (
            NEAR + "    def __init__(self, name, kind='number'):\n"
            "        self.name = name\n        self.signature = 'x:' + kind\n"
            "CONSTRAINTS = [Near('a'), Near(name='b', kind='bool')]",
            [("a", "x:number", None, None), ("b", "x:bool", None, None)],
        ),
        (
            "import runtime.user.constraint as api\nclass Other(api.Constraint):\n"
            "    name = 'o'\n    signature = 'x:any'\n    meaning = 'm'\nCONSTRAINTS = [Other()]",
            [("o", "x:any", None, None)],
        ),
        (NEAR + "CONSTRAINTS = [Near]", [(1, "`CONSTRAINTS` has the class `Near`; write `Near()`")]),
        (NEAR, [(1, "it has no list `CONSTRAINTS`")]),
        (NEAR + "CONSTRAINTS = [Near() for _ in range(2)]", [(1, "what `CONSTRAINTS` holds is computed")]),
        (NEAR + "if x:\n    Near.name = 'z'\nCONSTRAINTS = [Near()]", [(1, "what `CONSTRAINTS` holds is computed")]),
        (NEAR + "    name = input()\nCONSTRAINTS = [Near()]", [(7, "the `name` of `Near` is computed")]),
        ("CONSTRAINTS = [", [(2, "it is no Python: '[' was never closed")]),
        ("x = " + "-" * 100000 + "1", [(1, "it cannot be parsed")]),
        ("CONSTRAINTS = " + "'a' + " * 5000 + "'b'", [(1, "it cannot be parsed")]),
    ],
)
def test_signatures_are_read_from_the_syntax_tree(text: str, told: list[tuple[Any, ...]]) -> None:
    assert described(text) == told


def test_the_example_is_read_as_it_is_run() -> None:
    read = read_module((ROOT / "models" / "bathymetry" / "chart.py").read_text(encoding="utf-8"))
    ((_, one),) = read.found
    assert (one.name, one.signature, one.gives, one.result, read.gaps) == (
        "chart_depth",
        "depth:number x:number y:number",
        "float",
        0,
        (),
    )
