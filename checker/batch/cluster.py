"""Fly missions on a Dask cluster: tasks in, results out, with the interface of `fly_all`.

Missions go out in chunks; each lane of the cluster flies them in a process of its own, so that one that dies or hangs
costs one mission and no worker of Dask. What a worker of Dask was flying when it died is flown by others, and what no
worker is left for ends as an ERROR. Models are read where the worker runs: the folder of the mission must be there too.
"""

import contextlib
import signal
import threading
import time
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from distributed import CancelledError, Client, wait
from distributed.scheduler import KilledWorker

import runtime.build_form
from checker.batch.pool import Batch, ClusterError, Supervisor
from checker.batch.process import GRACE, Flyer
from checker.batch.result import MissionResult
from checker.batch.signals import FirstSignals
from checker.batch.worker import Load, Task, error_result
from runtime.executive.configuration import AgentConfiguration

_LARGEST_CHUNK = 8
_QUIET = 0.25  # seconds between two looks at the clock
_TRANSFER = 30.0  # seconds in which the results of a chunk come over
_ANSWER = "30s"  # in which the scheduler answers
_GONE = (OSError, TimeoutError, CancelledError)  # what Dask raises of a cluster that is gone: there is nothing to end
_DESERTED = 60.0  # seconds in which a worker may come back where there is none


class Cluster:
    """A Dask cluster at an address."""

    def __init__(self, address: str) -> None:
        self._address = address

    def fly(self, batch: Batch, supervisor: Supervisor) -> signal.Signals | None:
        """Fly a batch, with as many workers as the cluster has."""
        signals = FirstSignals()
        try:
            client = Client(self._address, timeout=_ANSWER)
        except (OSError, ValueError) as problem:
            raise ClusterError(self._address, str(problem)) from None
        try:
            with signals:
                while batch.tasks and not supervisor.is_enough():
                    current = _Round(client, batch)
                    current.fly(supervisor, signals)
                    if signals.first is not None or current.is_lost:
                        break
                    batch = replace(batch, tasks=batch.more())
                with contextlib.suppress(*_GONE):
                    client.run(_dismiss_all, on_error="ignore")
        finally:
            with contextlib.suppress(*_GONE):
                client.close()
        return signals.first


class _Round:
    """One generation of tasks on the cluster."""

    def __init__(self, client: Client, batch: Batch) -> None:
        self._client, self._batch, tasks = client, batch, batch.tasks
        lanes = max(1, sum(client.nthreads().values()))
        size = max(1, min(_LARGEST_CHUNK, len(tasks) // (lanes * 4)))
        self._futures: dict[Any, tuple[Task, ...]] = {}
        self.is_lost = False  # the cluster has no worker left
        for first in range(0, len(tasks), size):
            self._submit(tuple(tasks[first : first + size]))

    def _submit(self, chunk: tuple[Task, ...]) -> None:
        batch = self._batch
        future = self._client.submit(_fly_chunk, batch.load, batch.agent, batch.time_limit, chunk, pure=False)
        self._futures[future] = chunk

    def fly(self, supervisor: Supervisor, signals: FirstSignals) -> None:
        """Give each result to `supervisor` until all are there, or there are enough."""
        told = peopled = time.monotonic()  # when the last result came, and when there last was a worker
        while self._futures and signals.first is None and not supervisor.is_enough():
            if sum(self._take(future, supervisor) for future in self._finished()):
                told = peopled = time.monotonic()
                continue
            now = time.monotonic()
            if self._has_workers():
                peopled = now
            self.is_lost = self.is_lost or now > peopled + _DESERTED
            if self.is_lost or now > told + self._time_allowed():
                reason = f"took longer than {self._batch.time_limit:g} s"
                self._give_up(supervisor, "the cluster has no worker left" if self.is_lost else reason)
                break
        with contextlib.suppress(*_GONE):
            self._client.cancel(list(self._futures), force=True)

    def _has_workers(self) -> bool:
        try:
            return bool(self._client.nthreads())
        except OSError:  # nor a scheduler
            return False

    def _give_up(self, supervisor: Supervisor, reason: str) -> None:
        for chunk in self._futures.values():
            for task in chunk:
                supervisor.take(error_result(task, reason))

    def _time_allowed(self) -> float:
        return (self._batch.time_limit + GRACE) * (_LARGEST_CHUNK + 1)

    def _finished(self) -> list[Any]:
        try:
            return list(wait(list(self._futures), timeout=_QUIET, return_when="FIRST_COMPLETED").done)
        except TimeoutError:
            return []
        except CancelledError:  # by nobody: the scheduler is gone
            self.is_lost = True
            return []

    def _take(self, future: Any, supervisor: Supervisor) -> bool:
        """Give the results of a future to `supervisor`; False if they are lost with their worker and are made again."""
        problem: BaseException | None = None
        results: list[MissionResult] = []
        try:
            results = future.result(timeout=_TRANSFER)
        except (Exception, CancelledError) as raised:
            if isinstance(raised, TimeoutError) and future.status != "error":
                return False
            problem = raised
        chunk = self._futures.pop(future)
        if problem is None:
            for result in results:
                supervisor.take(result)
        elif isinstance(problem, KilledWorker) and len(chunk) > 1:
            for task in chunk:
                self._submit((task,))
        else:
            reason = f"{type(problem).__name__}: {problem}"
            if isinstance(problem, KilledWorker):
                reason = "workers of the cluster died again and again while they flew it"
            for task in chunk:
                supervisor.take(error_result(task, reason))
        return True


_FLYERS: dict[int, tuple[Load, AgentConfiguration, Flyer]] = {}  # by thread of this worker of Dask


def _fly_chunk(load: Load, agent: AgentConfiguration, time_limit: float, chunk: Sequence[Task]) -> list[MissionResult]:
    """What a worker of the cluster does; the process that flies has loaded the models, and stays for the next chunk."""
    lane = threading.get_ident()
    known = _FLYERS.get(lane)
    if known is None or known[:2] != (load, agent):
        if known is not None:
            known[2].dismiss()
        known = _FLYERS[lane] = (load, agent, Flyer(load, agent, time_limit))
    return [known[2].fly_task(task) for task in chunk]


def _dismiss_all() -> None:
    """End the processes of this worker of Dask."""
    while _FLYERS:
        _FLYERS.popitem()[1][2].dismiss()
