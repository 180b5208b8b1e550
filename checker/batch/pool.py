"""Fly missions on worker processes: tasks in, results out as they come, whatever happens to a worker.

A worker that dies or overruns costs exactly the mission it was flying; the rest of its chunk goes to others. Ctrl-C,
SIGTERM and a hang-up end the batch at once and keep what is finished. The order in which results come may vary; their
content does not.
"""

import contextlib
import os
import signal
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection, wait
from typing import Protocol

import runtime.build_form
from checker.batch.garbage import seldom_collected
from checker.batch.process import GRACE, SPARE, Worker, WorkerError, unloaded
from checker.batch.result import MissionResult
from checker.batch.signals import FirstSignals
from checker.batch.worker import READY, LastWords, Load, LoadFailure, Task, error_result
from checker.oracle import HUNG, USER_CODE
from runtime.executive.configuration import AgentConfiguration
from runtime.user.fault import UserCodeError

_LARGEST_CHUNK = 64
_FAILED_STARTS = 3  # workers in a row that may die before they are ready
_MOST_QUIET = 0.25  # seconds without a look at the clock
_LONGEST_PAUSE = 0.05  # seconds in which results gather


class Supervisor(Protocol):
    """Takes the results of a batch, and says when there are enough."""

    def take(self, result: MissionResult) -> None:
        """Have one more result."""

    def is_enough(self) -> bool:
        """Asked after results, and several times a second: whether to end the batch now."""


def nothing_more() -> Sequence[Task]:
    """There is no further generation of tasks."""
    return ()


class ClusterError(Exception):
    """There is no cluster at an address."""

    def __init__(self, address: str, reason: str) -> None:
        super().__init__(f"no cluster answers at `{address}`: {reason}")


@dataclass(frozen=True, slots=True)
class Batch:
    """Missions to fly with models that `load` loads, each within a limit of seconds; then what `more` has."""

    load: Load
    agent: AgentConfiguration
    tasks: Sequence[Task]
    workers: int  # a cluster has its own
    time_limit: float
    more: Callable[[], Sequence[Task]] = nothing_more


FlyBatch = Callable[[Batch, Supervisor], "signal.Signals | None"]  # what `fly_all` is, and what a cluster does


def fly_all(batch: Batch, supervisor: Supervisor) -> signal.Signals | None:
    """Fly a batch and give each result to `supervisor`; the signal that came meanwhile, which ends it."""
    tasks = batch.tasks or batch.more()
    if not tasks:
        return None
    with _signal_pipe() as signalled, seldom_collected():
        count = batch.workers if batch.more is not nothing_more else min(batch.workers, len(tasks))
        pool = _Pool(replace(batch, tasks=tasks, workers=count), supervisor)
        try:
            ended_by = pool.run(signalled)
            if ended_by is None:
                pool.spare()
            return ended_by
        finally:
            pool.stop()


class _Pool:
    def __init__(self, batch: Batch, supervisor: Supervisor) -> None:
        self.batch, self.supervisor = batch, supervisor
        self.waiting = deque(batch.tasks)
        self.missing = len(batch.tasks)
        self.failed_starts = 0
        self.workers = [self._begun() for _ in range(batch.workers)]

    def _begun(self) -> Worker:
        return Worker(self.batch.load, self.batch.agent, self.batch.workers)

    def run(self, signalled: int) -> signal.Signals | None:
        """Serve workers until every task has its result, or there are enough; a signal ends that at once."""
        looked = time.monotonic()
        while not self.supervisor.is_enough() and (self.missing or self._refill()):
            missing = self.missing
            ends: list[Connection | int] = [worker.connection for worker in self.workers]
            soonest = min(worker.deadline for worker in self.workers if worker.owed or not worker.is_ready)
            ready = wait([*ends, signalled], min(_MOST_QUIET, max(0.0, soonest - time.monotonic())))
            if signalled in ready:
                break
            for worker in list(self.workers):
                if worker.connection in ready:
                    self._listen(worker)
                    while worker in self.workers and worker.owed and worker.connection.poll():
                        self._listen(worker)
                elif (reason := worker.hung()) is not None:
                    self._lose(worker, reason, USER_CODE)
                elif time.monotonic() > worker.deadline and (worker.owed or not worker.is_ready):
                    self._lose(worker, f"took longer than {self.batch.time_limit:g} s", HUNG)
            since, looked = looked, time.monotonic()
            pause = self._pause(missing - self.missing, looked - since)
            if pause and wait([signalled], pause):
                break
        # One that came with the last result, too, is for whoever would fly more.
        return signal.Signals(os.read(signalled, 1)[0]) if wait([signalled], 0.0) else None

    def _refill(self) -> bool:
        """Take the next generation of tasks, if there is one, and have those fly it who are ready."""
        tasks = self.batch.more()
        self.waiting.extend(tasks)
        self.missing += len(tasks)
        if tasks and not self.workers:
            self.workers.append(self._begun())
        for worker in self.workers:
            if worker.is_ready and not worker.owed:
                self._feed(worker)
        return bool(tasks)

    def spare(self) -> None:
        """Leave a worker that has nothing to do to others, where that is wanted."""
        idle = next((worker for worker in self.workers if worker.is_ready and not worker.owed), None)
        if idle is not None and SPARE.is_wanted:
            self.workers.remove(idle)
            SPARE.keep(self.batch.load, self.batch.agent, idle)

    def stop(self) -> None:
        """End every worker; idle ones have nothing to lose, busy ones are not waited for."""
        for worker in self.workers:
            worker.process.kill()
        for worker in self.workers:
            worker.kill()

    def _pause(self, taken: int, seconds: float) -> float:
        """How long results may gather, where `taken` came in `seconds`: until some worker has done half of its work.

        To wake up costs as much as to take a result; where missions take long, it does not matter.
        """
        if not taken or not self.waiting:
            return 0.0
        mission = seconds * len(self.workers) / taken
        pause = min(_LONGEST_PAUSE, mission * min(len(worker.owed) for worker in self.workers) / 2)
        return pause if pause > 2 * mission else 0.0

    def _listen(self, worker: Worker) -> None:
        """Take one thing that a worker has said."""
        try:
            message = worker.connection.recv()
            if isinstance(message, LoadFailure):
                raise unloaded(message)
            if isinstance(message, LastWords):
                self._lose(worker, message.reason, USER_CODE)
                return
            if message == READY:
                worker.is_ready = True
                self.failed_starts = 0
            else:
                worker.owed.popleft()
                self.missing -= 1
                self.supervisor.take(message)
            worker.deadline = time.monotonic() + self.batch.time_limit + GRACE
            if not worker.owed:
                self._feed(worker)
        except (EOFError, OSError):
            self._lose(worker, *worker.fate())

    def _feed(self, worker: Worker) -> None:
        """Give a worker a chunk: the fewer missions are left, the smaller, so that all workers end together."""
        size = max(1, min(_LARGEST_CHUNK, len(self.waiting) // (2 * len(self.workers))))
        chunk = [self.waiting.popleft() for _ in range(min(size, len(self.waiting)))]
        if chunk:
            worker.give(chunk, self.batch.time_limit)

    def _lose(self, worker: Worker, reason: str, code: str = "") -> None:
        """Give up a worker and the mission in flight, and start another one for the rest."""
        worker.kill()
        if worker.owed:
            self.missing -= 1
            self.supervisor.take(error_result(worker.owed.popleft(), reason, code=code))
        elif not worker.is_ready:
            if code == USER_CODE:
                raise UserCodeError(reason)
            self.failed_starts += 1
            if self.failed_starts >= _FAILED_STARTS:
                raise WorkerError(f"workers end before they are ready: {reason}")
        self.waiting.extendleft(reversed(worker.owed))
        self.workers.remove(worker)
        if self.missing:
            self.workers.append(self._begun())


@contextlib.contextmanager
def _signal_pipe() -> Iterator[int]:
    """A file descriptor from which a signal that ends the batch can be read."""
    reading, writing = os.pipe()

    def note(number: signal.Signals) -> None:
        os.write(writing, bytes((number,)))

    try:
        with FirstSignals(note):
            yield reading
    finally:
        os.close(reading)
        os.close(writing)
