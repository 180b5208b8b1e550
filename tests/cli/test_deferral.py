"""What is large is imported when it is used: z3 and networkx by commands that explain or prove, not by the others."""

import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from nddlc.deferral import LARGE, defer
from nddlc.main import named

pytestmark = pytest.mark.once


def other_files(folder: Path, **bodies: str) -> None:
    """Write modules of these names into a folder."""
    for name, body in bodies.items():
        (folder / f"{name}.py").write_text(textwrap.dedent(body), encoding="utf-8")


def said_last(code: str, folder: Path) -> str:
    """The last line that a fresh interpreter prints."""
    told = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code)],
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
        env={"PYTHONPATH": str(Path.cwd())},
    )
    return told.stdout.splitlines()[-1]


@pytest.fixture
def importable(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder to import from, whose modules are forgotten afterwards."""
    monkeypatch.syspath_prepend(str(tmp_path))
    for name in ("deferred_large", "deferred_one", "deferred_other", "deferred_broken"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    return tmp_path


def test_a_deferred_module_runs_once_a_name_of_it_is_used(importable: Path, capsys: pytest.CaptureFixture[str]) -> None:
    other_files(
        importable,
        deferred_large="print('runs')\nlimit = 7\n",
        deferred_one="import deferred_large as large\ndef limit(): return large.limit\n",
        deferred_other="import deferred_large\ndef missing(): return deferred_large.bound\n",
    )
    defer("deferred_large")
    limit, missing = named("deferred_one:limit"), named("deferred_other:missing")
    assert capsys.readouterr().out == ""
    assert limit() == 7
    with pytest.raises(AttributeError, match=r"deferred_large.*bound"):
        missing()
    assert capsys.readouterr().out == "runs\n"


def test_a_deferred_module_that_fails_fails_at_each_use(importable: Path) -> None:
    other_files(importable, deferred_broken="import no_such_module_anywhere\n")
    defer("deferred_broken", "no_such_module_anywhere")
    for _ in range(2):
        with pytest.raises(ModuleNotFoundError, match="no_such_module_anywhere"):
            named("deferred_broken:anything")
    with pytest.raises(ModuleNotFoundError):
        named("no_such_module_anywhere:anything")


def test_a_signal_while_a_module_is_loaded_is_heeded_once_it_is_whole(importable: Path) -> None:
    body = """
        import signal
        try:
            signal.raise_signal(signal.SIGINT)
        except:
            pass
        whole = True
    """
    other_files(importable, deferred_large=body)
    defer("deferred_large")
    with pytest.raises(KeyboardInterrupt):
        named("deferred_large:whole")
    assert named("deferred_large:whole")


def test_a_mission_that_passes_needs_nothing_that_explains_or_proves(tmp_path: Path) -> None:
    mission = str(Path("models/gps/mended.toml").resolve())
    code = f"""
        import sys
        from nddlc.main import nddlc, run
        for name in ("certify", "check", "run"):
            nddlc.get_command(None, name)
        print(run(["run", {mission!r}]), [name for name in {LARGE} if sys.modules[name].__dict__.get("__all__")
              or f"{{name}}.{{name}}" in sys.modules or f"{{name}}.utils" in sys.modules])
    """
    assert said_last(code, tmp_path) == "0 []"


def test_a_mission_in_an_editor_loads_no_arrays_and_no_judge(tmp_path: Path) -> None:
    mission = Path("models/gps/mission.toml").resolve()
    code = f"""
        import sys
        from pathlib import Path
        from nddl_lang.text.source import Source
        from nddlc.editor import examine_for_editor
        path = Path({str(mission)!r})
        examine_for_editor(Source(str(path), path.read_text()), path.parent, False)
        looked_at = "checker.models", "compiler.lower", "numpy", "checker.judge.tokens", "checker.properties"
        print([name for name in looked_at if name in sys.modules])
    """
    assert said_last(code, tmp_path) == "['checker.models', 'compiler.lower']"
