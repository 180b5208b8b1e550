"""Flights that were made before, kept in a file: what ranks causes may change, what flies has not."""

import hashlib
import pickle
import sqlite3
import zlib
from dataclasses import replace
from functools import cache, partial
from pathlib import Path

from checker.batch.engine import ROOT
from checker.batch.process import Flyer
from checker.batch.result import MissionResult
from checker.batch.worker import Load, Task
from checker.oracle import Verdict
from runtime.executive.configuration import AgentConfiguration

_FLIES = ("nddl_lang", "compiler", "runtime", "checker/judge", "checker/flight.py", "checker/oracle.py")
_FLIES_TOO = ("checker/losses.py", "checker/batch", "checker/coverage.py", "checker/sampling")


@cache
def _engine() -> bytes:
    content = hashlib.sha256()
    for name in (*_FLIES, *_FLIES_TOO):
        place = ROOT / name
        for path in sorted(place.rglob("*.py")) if place.is_dir() else [place]:
            content.update(path.read_bytes())
    return content.digest()


def _name_of(task: Task) -> str:
    """A task by its content; of its load the texts, as a function has no content."""
    load = task.load
    assert load is None or isinstance(load, partial)
    return repr((replace(task, load=None), load is not None and (load.args, load.keywords)))


class RememberingFlyer(Flyer):
    """Flies what was not flown before by the same engine; `texts` is all that a load of its own does not tell of."""

    def __init__(self, load: Load, agent: AgentConfiguration, time_limit: float, texts: str, place: Path) -> None:
        super().__init__(load, agent, time_limit)
        self._texts = texts
        self.flown, self.remembered = 0, 0
        place.parent.mkdir(parents=True, exist_ok=True)
        self._kept = sqlite3.connect(place, timeout=60.0, isolation_level=None)
        self._kept.execute("create table if not exists flight (key blob primary key, result blob)")

    def fly_task(self, task: Task, most_seconds: float = float("inf")) -> MissionResult:
        """The result of one mission; what was given up, as it took too long, is flown again."""
        asked = f"{self._texts}{_name_of(task)}".replace(str(ROOT), "")  # other worktrees fly the same
        key = hashlib.sha256(_engine() + asked.encode()).digest()
        row = self._kept.execute("select result from flight where key = ?", (key,)).fetchone()
        if row is not None:
            self.remembered += 1
            found = pickle.loads(zlib.decompress(row[0]))
            assert isinstance(found, MissionResult)
            return found
        self.flown += 1
        result = super().fly_task(task, most_seconds)
        if result.verdict is not Verdict.ERROR or "took longer" not in result.judgement.message + result.detail:
            content = zlib.compress(pickle.dumps(result), 1)
            self._kept.execute("insert or replace into flight values (?, ?)", (key, content))
        return result
