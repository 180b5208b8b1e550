"""A damaged store is told apart from a bug, and what is whole of it is kept."""

import os
import shutil
import sqlite3
import subprocess
import sys
from pathlib import Path

import pytest

from checker.batch.connection import Run, StoreError
from checker.batch.salvage import examine, salvage
from checker.batch.store import open_store
from checker.regression import RegressionError, read_cases
from nddlc.main import run
from tests.checker.fake_agent import load_linked
from tests.checker.test_batch import fly

pytestmark = pytest.mark.once

RUNS = (Run("abcd1234", "/m.toml", 7, 200), Run("00ff00ff", "/n.toml", 8, 5))


@pytest.fixture
def store(tmp_path: Path) -> Path:
    """Two runs; all is in the main file."""
    path = tmp_path / "runs.sqlite"
    results = fly(load_linked, range(200), 1)
    with open_store(path) as opened:
        for one in RUNS:
            opened.begin(one, keep=True)
            for result in results[: one.missions]:
                opened.add(one, result)
    connection = sqlite3.connect(path)
    connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    connection.close()
    return path


def test_a_whole_store_is_said_to_be_whole(store: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["store", "check", str(store)]) == 0
    assert "is whole: 205 missions of 2 runs" in capsys.readouterr().out


def test_a_changed_row_is_found_and_left_out(
    store: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    connection = sqlite3.connect(store)
    connection.execute("UPDATE missions SET result = replace(result, '\"seed\":2', '\"seed\":3') WHERE number = 3")
    connection.commit()
    connection.close()
    assert run(["store", "check", str(store)]) == 1
    assert "mission 3 of run abcd1234 cannot be read" in capsys.readouterr().out
    monkeypatch.chdir(store.parent)
    assert run(["explain", "abcd#3", "--store", "runs.sqlite"]) == 2
    with open_store(store) as opened, pytest.raises(StoreError, match=r"mission 3 of run abcd1234 .* is damaged"):
        opened.begin(RUNS[0], keep=True)
    assert run(["store", "salvage", str(store)]) == 0
    assert "kept: 203 missions of 2 runs" in capsys.readouterr().out
    assert examine(store).is_none
    assert not examine(Path(f"{store}.damaged")).is_none
    with open_store(store) as opened:
        assert len(opened.begin(RUNS[0], keep=True)) == 199
        assert opened.run_ids() == ["abcd1234", "00ff00ff"]


def test_damaged_pages_cost_what_was_on_them(store: Path, tmp_path: Path) -> None:
    content = bytearray(store.read_bytes())
    pages = len(content) // 4096
    assert pages > 10
    for page in (pages // 2, pages - 2):
        content[page * 4096 : page * 4096 + 4096] = b"\xa5" * 4096
    store.write_bytes(bytes(content))
    found = examine(store)
    assert found.pages
    with open_store(store) as opened, pytest.raises(StoreError, match="is damaged"):
        opened.begin(RUNS[0], keep=True)
    salvage(store, tmp_path / "new.sqlite")
    after = examine(tmp_path / "new.sqlite")
    assert after.is_none
    assert 0 < after.whole == found.whole < 205


@pytest.mark.parametrize(
    ("make", "complaint"),
    [
        (lambda path: path.write_bytes(b"no database at all, and long enough to be sure" * 99), "is no store of nddlc"),
        (lambda path: sqlite3.connect(path).executescript("CREATE TABLE t (x)"), "a database of something else"),
        (lambda path: path.mkdir(), "no file that a store could be in"),
    ],
)
def test_what_is_no_store_is_not_called_a_bug(
    tmp_path: Path, make: object, complaint: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert callable(make)
    path = tmp_path / "x.sqlite"
    make(path)
    assert run(["check", "models/gps/mission.toml", "--flights", "2", "--missions", "2", "--store", str(path)]) == 2
    assert complaint in capsys.readouterr().err
    assert run(["store", "check", str(path)]) == 2


def test_a_store_that_is_moved_away_meanwhile_is_told_and_has_all_that_was_flown(tmp_path: Path) -> None:
    """SQLite goes on writing into a file that was moved or removed, and says nothing."""
    (tmp_path / "here").mkdir()
    results = fly(load_linked, range(9), 1)
    with pytest.raises(StoreError, match="was moved, removed or replaced"), open_store(tmp_path / "here/s") as opened:
        opened.begin(RUNS[0], keep=True)
        opened.add(RUNS[0], results[0])
        opened.flush()
        (tmp_path / "here").rename(tmp_path / "there")
        for result in results[1:]:
            opened.add(RUNS[0], result)
        opened.flush()
    with open_store(tmp_path / "there/s") as moved:
        assert len(moved.results(RUNS[0].id)) == len(results)


def test_cases_in_a_folder_are_no_bug(tmp_path: Path) -> None:
    (tmp_path / "m.regressions.toml").mkdir()
    with pytest.raises(RegressionError, match="cannot be read"):
        read_cases(tmp_path / "m.regressions.toml")


@pytest.mark.parametrize("place", [0, 6, 20])
def test_a_log_that_sqlite_would_drop_without_a_word_is_told(
    store: Path, place: int, capsys: pytest.CaptureFixture[str]
) -> None:
    """Magic, version, salt: SQLite takes the log for an empty one, and said that nothing is wrong."""
    connection = sqlite3.connect(store)
    connection.execute("UPDATE runs SET missions = 6 WHERE id = '00ff00ff'")
    connection.commit()
    log = Path(f"{store}-wal")
    written = bytearray(log.read_bytes())
    connection.close()
    log.write_bytes(written)
    assert examine(store).is_none
    written[place] ^= 0x40
    log.write_bytes(written)
    assert run(["store", "check", str(store)]) == 1
    assert "what was written last" in capsys.readouterr().out
    with pytest.raises(StoreError, match="what was written last"), open_store(store):
        pass
    assert run(["store", "salvage", str(store)]) == 0
    assert Path(f"{store}.damaged-wal").read_bytes() == written
    assert run(["store", "check", str(store)]) == 0


@pytest.mark.once
def test_a_store_where_nothing_may_be_written_is_read(store: Path, tmp_path: Path) -> None:
    """Also what its log alone has; root may write anywhere, so it has to give that up first."""
    plain = [] if os.geteuid() else ["setpriv", "--bounding-set", "-dac_override,-dac_read_search"]
    if plain and shutil.which(plain[0]) is None:
        pytest.skip("no setpriv")
    archive = tmp_path / "archive"
    archive.mkdir()
    writer = sqlite3.connect(store)
    writer.execute("DELETE FROM missions WHERE run = ? AND number > 3", (RUNS[1].id,))
    writer.commit()
    for part in ("", "-wal"):
        shutil.copy(f"{store}{part}", archive / f"runs.sqlite{part}")
    writer.close()
    files = sorted(archive.iterdir())
    for file in files:
        file.chmod(0o444)
    archive.chmod(0o555)
    try:
        path = str(archive / "runs.sqlite")
        calls = [["store", "check", path], ["compare", "00ff", "00ff", "--store", path]]
        text = f"from nddlc.main import run\nfor one in {calls}: print(run(one))"
        found = subprocess.run([*plain, sys.executable, "-c", text], capture_output=True, text=True, check=True)
        assert "is whole: 203 missions of 2 runs\n0\n" in found.stdout
        assert "3 missions in common" in found.stdout
        assert sorted(archive.iterdir()) == files
    finally:
        archive.chmod(0o755)
