"""Stores of projects that were copied or moved: what they hold is of the mission file that lies beside them now."""

import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from checker.batch.connection import Run
from checker.batch.result import MissionResult
from checker.batch.salvage import salvage
from checker.batch.store import open_store
from checker.oracle import Judgement, Verdict

pytestmark = pytest.mark.once

STORE = ".nddlc/runs.sqlite"


def flown(project: Path, seed: int = 7) -> Run:
    """A run with one failure in the store of a project."""
    (project / ".nddlc").mkdir(parents=True, exist_ok=True)
    (project / "mission.toml").touch()
    run = Run(f"abcd{seed:04}", str((project / "mission.toml").resolve()), seed, 5)
    failed = MissionResult(1, seed, Judgement(Verdict.FAIL, "F1"), None, has_trace=False)
    with open_store(project / STORE) as store:
        store.begin(run, keep=True)
        store.add(run, failed)
        store.keep_failures(run, [failed])
    return run


def mission_file(store: Path, name: str = "latest") -> str | None:
    with open_store(store) as opened:
        run = opened.find(name)
    return run.mission_file if run is not None else None


def test_a_run_in_a_copy_of_a_project_is_of_the_copy(tmp_path: Path) -> None:
    run = flown(tmp_path / "first")
    shutil.copytree(tmp_path / "first", tmp_path / "copy")
    copied = str((tmp_path / "copy/mission.toml").resolve())
    assert mission_file(tmp_path / "copy" / STORE) == copied
    assert mission_file(tmp_path / "copy" / STORE, copied) == copied
    assert mission_file(tmp_path / "first" / STORE) == run.mission_file


def test_a_copy_has_the_failures_of_the_original_once(tmp_path: Path) -> None:
    flown(tmp_path / "first")
    shutil.copytree(tmp_path / "first", tmp_path / "copy")
    flown(tmp_path / "copy")
    other = flown(tmp_path / "copy", 8)
    with open_store(tmp_path / "copy" / STORE) as store:
        assert [case.seed for case in store.failures(other)] == [7]


def test_what_lies_nowhere_in_the_project_is_where_it_was(tmp_path: Path) -> None:
    run = flown(tmp_path / "first")
    (tmp_path / "moved").mkdir()
    shutil.copyfile(tmp_path / "first" / STORE, tmp_path / "moved/runs.sqlite")
    assert mission_file(tmp_path / "moved/runs.sqlite") == run.mission_file


def test_a_store_without_places_is_of_the_file_that_it_names(tmp_path: Path) -> None:
    run = flown(tmp_path / "first")
    with closing(sqlite3.connect(tmp_path / "first" / STORE)) as connection, connection:
        connection.execute("DROP TABLE places")
    shutil.copytree(tmp_path / "first", tmp_path / "copy")
    assert mission_file(tmp_path / "copy" / STORE) == run.mission_file


def test_what_is_salvaged_from_a_copy_is_of_the_copy(tmp_path: Path) -> None:
    flown(tmp_path / "first")
    shutil.copytree(tmp_path / "first", tmp_path / "copy")
    salvage(tmp_path / "copy" / STORE, tmp_path / "copy/.nddlc/new.sqlite")
    assert mission_file(tmp_path / "copy/.nddlc/new.sqlite") == str((tmp_path / "copy/mission.toml").resolve())
