"""Pages of `nddlc explain` that `nddlc check` has kept: told again as they are while they are true, and no longer."""

import shutil
import sqlite3
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path

import pytest

from checker.batch.explanations import kept_page
from checker.batch.store import open_store
from nddlc.inputs import STORE
from nddlc.main import run
from tests.checker.fake_agent import load_split

pytestmark = pytest.mark.once

GPS = Path("models/gps").resolve()
FLIGHTS = 2
HEAVY = ("numpy", "networkx.utils", "z3.z3core", "runtime.executive.agent")  # deferred ones have no parts


@pytest.fixture(scope="module")
def checked(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A folder with the gps mission, checked there with a stand-in for the agent."""
    folder = tmp_path_factory.mktemp("kept") / "gps"
    shutil.copytree(GPS, folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        patch.setattr("nddlc.check.pinned", lambda models: load_split)
        patch.setattr("nddlc.explanation.pinned", lambda models: load_split)
        assert run(["check", "mission.toml", "--flights", str(FLIGHTS)]) == 1
        yield folder


def page() -> str | None:
    return kept_page(STORE, "latest", None, FLIGHTS)


def test_a_kept_page_is_what_explain_makes_anew(checked: Path, capsys: pytest.CaptureFixture[str]) -> None:
    asked = ["explain", "latest", "--flights", str(FLIGHTS)]
    kept = page()
    assert kept is not None
    assert run(asked) == 0
    assert capsys.readouterr().out == kept
    with closing(sqlite3.connect(STORE)) as connection, connection:
        rows = connection.execute("SELECT * FROM explanations").fetchall()
        connection.execute("DELETE FROM explanations")
    assert page() is None
    assert run(asked) == 0
    assert capsys.readouterr().out == kept
    with closing(sqlite3.connect(STORE)) as connection, connection:
        connection.executemany("INSERT INTO explanations VALUES (?, ?, ?, ?, ?, ?, ?)", rows)
    assert "is the nearest that passes" in kept


def test_a_kept_page_is_told_without_what_flies_missions(checked: Path) -> None:
    asked = f"run(['explain', 'latest', '--flights', '{FLIGHTS}'])"
    code = f"import sys; from nddlc.main import run; {asked}; print([one for one in {HEAVY} if is_loaded(one)])"
    deferred = "is_loaded = lambda name: type(sys.modules.get(name, 0)).__name__ not in ('int', '_Deferred')"
    path = str(Path(__file__).resolve().parents[2])
    told = subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path.insert(0, {path!r}); {deferred}; {code}"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert told.stdout.endswith("[]\n")
    assert told.stdout.startswith("mission ")


@pytest.mark.parametrize(
    "change",
    [
        lambda: Path("rules.nddl").write_text(Path("rules.nddl").read_text() + "// more\n"),
        lambda: Path("mission.toml").write_text(Path("mission.toml").read_text() + "# more\n"),
        lambda: Path("nddlc.toml").write_text("# settings\n"),
        lambda: Path("another.nddl").write_text("// would be found first by an include\n"),
        lambda: Path("../nddlc.toml").write_text("# settings above\n"),
        lambda: Path("vehicle.nddl").unlink(),
    ],
    ids=["a model", "the mission", "settings", "another model", "settings above", "a model is gone"],
)
def test_a_kept_page_is_told_no_more_once_something_has_changed(checked: Path, change: Callable[[], object]) -> None:
    assert page() is not None
    before = {path: path.read_bytes() for path in checked.iterdir() if path.is_file()}
    change()
    changed = page()
    for path in (*checked.glob("*.nddl"), *checked.glob("*.toml"), checked.parent / "nddlc.toml"):
        path.unlink(missing_ok=True)
    for path, content in before.items():
        path.write_bytes(content)
    assert changed is None
    assert page() is not None


def test_a_kept_page_is_not_told_from_elsewhere_nor_where_more_may_be_tried(
    checked: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert kept_page(STORE, "latest", None, FLIGHTS + 1) is None
    assert kept_page(STORE, "latest", 1, FLIGHTS) is None  # it passed
    store = STORE.resolve()
    monkeypatch.chdir(checked.parent)
    assert kept_page(store, "latest", None, FLIGHTS) is None


def test_a_damaged_page_is_not_told(checked: Path, tmp_path: Path) -> None:
    copy = tmp_path / "runs.sqlite"
    shutil.copyfile(STORE, copy)
    assert kept_page(copy, "latest", None, FLIGHTS) == page()
    with closing(sqlite3.connect(copy)) as connection, connection:
        connection.execute("UPDATE explanations SET text = replace(text, 'SURFACE', 'SURFICE')")
    assert kept_page(copy, "latest", None, FLIGHTS) is None


@pytest.mark.parametrize("is_whole", [True, False])
def test_a_run_that_begins_again_with_missions_to_fly_forgets_its_pages(
    checked: Path, tmp_path: Path, is_whole: bool
) -> None:
    copy = tmp_path / "runs.sqlite"
    shutil.copyfile(STORE, copy)
    if not is_whole:
        with closing(sqlite3.connect(copy)) as connection, connection:
            connection.execute("DELETE FROM missions WHERE number = 1")
    with open_store(copy) as store:
        known = store.find("latest")
        assert known is not None
        store.begin(known, keep=True)
    assert kept_page(copy, "latest", None, FLIGHTS) == (page() if is_whole else None)
