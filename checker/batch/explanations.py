"""What `nddlc check` has told of a failure, kept with the run: the page of `nddlc explain`, as long as it is true.

A page is told again only where everything that it was made of is as it was: nddlc, the mission file, its models, what
configures how they are read, and the folder where the user stands. Nothing is imported here that flies or plans.
"""

import hashlib
import json
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from dataclasses import asdict, dataclass
from pathlib import Path

from checker.batch.connection import connect, find_run, place_to_read, store_error
from checker.batch.engine import engine_digest

_MODEL = ".nddl"


@dataclass(frozen=True, slots=True)
class Sources:
    """Files that a page was made of, some of them missing, and folders in which another model would be found first."""

    files: tuple[str, ...]
    folders: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Explanation:
    """The page of one mission; `is_first`: of the first that failed. It shows what so many trials do (None: all)."""

    mission: int
    is_first: bool
    flights: int | None
    sources: Sources
    text: str

    @property
    def seal(self) -> str:
        """The SHA-256 of the page and all that it was made of, as that is now."""
        content = hashlib.sha256()
        for part in (engine_digest(), str(Path.cwd()), *_content(self.sources), f"{asdict(self)}"):
            content.update(hashlib.sha256(part.encode("utf-8", "surrogatepass")).digest())
        return content.hexdigest()


def _content(sources: Sources) -> Iterator[str]:
    """What there is in files and folders."""
    for name in sources.files:
        path = Path(name)
        yield hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ""
    for name in sources.folders:
        path = Path(name)
        yield json.dumps(sorted(each.name for each in path.iterdir() if each.suffix == _MODEL or each.is_dir()))


def row_of(explanation: Explanation) -> tuple[int, bool, int | None, str, str, str]:
    """What the store keeps; `explanation_in` reads it."""
    sources = json.dumps(asdict(explanation.sources))
    return explanation.mission, explanation.is_first, explanation.flights, sources, explanation.seal, explanation.text


def kept_page(store: Path, name: str, mission: int | None, flights: int) -> str | None:
    """The page of a mission, or of the first that failed, of the run `name`; None where it must be made anew.

    Raises StoreError where the store cannot be read.
    """
    chosen = "SELECT mission, is_first, flights, sources, seal, text FROM explanations WHERE run = ? AND "
    with place_to_read(store) as place, closing(connect(place, store)) as connection:
        try:
            run = find_run(connection, store, name)
            if run is None:
                return None
            which, wanted = ("is_first", ()) if mission is None else ("mission = ?", (mission,))
            row = connection.execute(chosen + which, (run.id, *wanted)).fetchone()
        except sqlite3.Error as problem:
            raise store_error(problem, store) from problem
    if row is None:
        return None
    number, is_first, shown, sources, seal, text = row
    try:
        read = json.loads(sources)
        kept = Explanation(number, bool(is_first), shown, Sources(tuple(read["files"]), tuple(read["folders"])), text)
        is_true = kept.seal == seal
    except (OSError, ValueError, KeyError, TypeError):  # a file or folder is gone, or the row is damaged
        return None
    is_of_run = run.mission_file in kept.sources.files  # not of the project that this one was copied from
    return text if is_true and is_of_run and (shown is None or shown >= flights) else None
