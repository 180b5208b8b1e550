"""A store that may be damaged in, what is whole of it out: told, or moved to a new store."""

import sqlite3
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path

from checker.batch.connection import Run, StoreError, check_version, place_to_read
from checker.batch.moved import place_now
from checker.batch.store import open_store, result_of
from checker.batch.write_ahead_log import log_damage

_MOST_MESSAGES = 20
_MOST_MISSIONS = 10_000_000  # of one run that are looked for where its row does not say how many there are


@dataclass(frozen=True, slots=True)
class StoreDamage:
    """What is wrong with a store. `missions` are damaged rows, `pages` what SQLite says of the file as a whole."""

    runs: int
    whole: int
    missions: tuple[tuple[str, int], ...]
    pages: tuple[str, ...]

    @property
    def is_none(self) -> bool:
        """Whether nothing is wrong."""
        return not (self.missions or self.pages)


def examine(path: Path) -> StoreDamage:
    """Look at every page and every row; raises StoreError where the file is no store of this version."""
    with _open(path) as connection:
        pages = _integrity(connection)
        runs = _runs(connection)
        whole, damaged = 0, []
        for run in runs:
            for number, is_whole in _numbers(connection, run):
                if is_whole:
                    whole += 1
                else:
                    damaged.append((run.id, number))
    log = log_damage(path, path)
    return StoreDamage(len(runs), whole, tuple(damaged), (*pages, *([log] if log else [])))


def salvage(path: Path, target: Path) -> StoreDamage:
    """Put what is whole of the store at `path` into a new one at `target`; the old one stays as it is."""
    found = examine(path)
    with _open(path) as connection, open_store(target) as store:
        for run in _runs(connection):
            store.begin(_as_it_is_now(connection, path, run), keep=True)
            for number, is_whole in _numbers(connection, run):
                row = _row(connection, run.id, number) if is_whole else None
                result = result_of(row) if row is not None else None
                if result is not None:
                    store.add(run, result)
    return found


def _as_it_is_now(connection: sqlite3.Connection, path: Path, run: Run) -> Run:
    """The run with its mission file where that is now; a store that is older, or damaged there, does not know."""
    with suppress(sqlite3.Error):
        return replace(run, mission_file=place_now(connection, path, run.mission_file))
    return run


@contextmanager
def _open(path: Path) -> Iterator[sqlite3.Connection]:
    """A connection that only reads, with the version checked."""
    with ExitStack() as stack:
        place = stack.enter_context(place_to_read(path))
        try:
            connection = sqlite3.connect(f"{place.resolve().as_uri()}?mode=ro", uri=True, timeout=10.0)
            stack.enter_context(closing(connection))
            check_version(connection, path)
        except sqlite3.Error as problem:
            lost = f"nothing of `{path}` can be read: {problem}"
            raise StoreError(lost, "delete it; runs are flown again") from problem
        yield connection


def _integrity(connection: sqlite3.Connection) -> tuple[str, ...]:
    """What SQLite finds wrong with the pages."""
    try:
        rows = connection.execute(f"PRAGMA integrity_check({_MOST_MESSAGES})").fetchall()
    except sqlite3.Error as problem:
        return (str(problem),)
    lines = [line for row in rows for line in str(row[0]).splitlines()]
    return tuple(line for line in lines if line != "ok" and not line.startswith("***"))


def _runs(connection: sqlite3.Connection) -> list[Run]:
    """The runs that can be read, from either end of a table with a hole, in the order in which they began."""
    found: dict[int, Run] = {}
    for order in ("ASC", "DESC"):
        query = f"SELECT turn, id, mission_file, seed, missions, sampler FROM runs ORDER BY turn {order}"
        try:
            for turn, *values in connection.execute(query):
                if all(isinstance(each, kind) for each, kind in zip(values, (str, str, int, int, str), strict=True)):
                    found[turn] = Run(*values)
        except sqlite3.Error:
            continue
    return [found[turn] for turn in sorted(found)]


def _numbers(connection: sqlite3.Connection, run: Run) -> Iterator[tuple[int, bool]]:
    """The missions of a run that are, or were, in the store, and whether their rows are whole."""
    try:
        numbers = [row[0] for row in connection.execute("SELECT number FROM missions WHERE run = ?", (run.id,))]
    except sqlite3.Error:  # a page is damaged: ask for each by itself
        numbers = list(range(1, min(run.missions, _MOST_MISSIONS) + 1))
    for number in numbers:
        try:
            row = _row(connection, run.id, number)
        except sqlite3.Error:
            yield number, False
            continue
        if row is not None:
            yield number, result_of(row) is not None


def _row(connection: sqlite3.Connection, run_id: str, number: int) -> tuple[object, ...] | None:
    query = "SELECT run, number, verdict, result, checksum FROM missions WHERE run = ? AND number = ?"
    found: tuple[object, ...] | None = connection.execute(query, (run_id, number)).fetchone()
    return found
