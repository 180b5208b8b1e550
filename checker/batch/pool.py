"""Fly missions on worker processes: tasks in, results out as they come, whatever happens to a worker.

A worker that dies or overruns costs exactly the mission it was flying; the rest of its chunk goes to others. Ctrl-C,
SIGTERM and a hang-up end the batch at once and keep what is finished. The order in which results come may vary; their
content does not.
"""

import contextlib
import math
import multiprocessing
import os
import signal
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from types import FrameType
from typing import Protocol

import runtime.build_form
from checker.batch.result import MissionResult
from checker.batch.worker import READY, LastWords, Load, LoadFailure, Task, error_result, work
from checker.oracle import USER_CODE
from runtime.executive.configuration import AgentConfiguration
from runtime.user.fault import UserCodeError

_LARGEST_CHUNK = 16
_SAFE_PATH = "PYTHONSAFEPATH"
_START_LIMIT = 120.0  # seconds for a worker to load the models
_FAILED_STARTS = 3  # workers in a row that may die before they are ready
_MOST_QUIET = 0.25  # seconds without a look at the clock
_ENDING = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))


class Supervisor(Protocol):
    """Takes the results of a batch, and says when there are enough."""

    def take(self, result: MissionResult) -> None:
        """Have one more result."""

    def is_enough(self) -> bool:
        """Asked after results, and several times a second: whether to end the batch now."""


def nothing_more() -> Sequence[Task]:
    """There is no further generation of tasks."""
    return ()


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


class WorkerError(Exception):
    """No worker can be started: a bug of the tool, or a machine that lets no process live."""


def fly_all(batch: Batch, supervisor: Supervisor) -> signal.Signals | None:
    """Fly a batch and give each result to `supervisor`; the signal that ended it before all were flown."""
    tasks = batch.tasks or batch.more()
    if not tasks:
        return None
    with _signal_pipe() as signalled:
        count = batch.workers if batch.more is not nothing_more else min(batch.workers, len(tasks))
        pool = _Pool(replace(batch, tasks=tasks, workers=count), supervisor)
        try:
            ended_by = pool.run(signalled)
            if ended_by is None:
                pool.spare()
            return ended_by
        finally:
            pool.stop()


@contextlib.contextmanager
def keeping_a_worker() -> Iterator[None]:
    """Within this, a worker that has nothing left to do waits for who needs one next: starting one takes a second."""
    _SPARE.is_wanted = True
    try:
        yield
    finally:
        _SPARE.is_wanted = False
        _SPARE.dismiss()


class Flyer:
    """Flies single missions, each with an agent of its own, in one process that may die or hang without harm."""

    def __init__(self, load: Load, agent: AgentConfiguration, time_limit: float) -> None:
        self._load, self._agent, self._time_limit = load, agent, time_limit
        self._worker: _Worker | None = None

    def __enter__(self) -> "Flyer":
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        if kind is not None or self._worker is None:
            self.dismiss()
        else:
            _SPARE.keep(self._load, self._agent, self._worker)

    def dismiss(self) -> None:
        """End the process."""
        if self._worker is not None:
            self._worker.kill()
            self._worker = None

    def fly(
        self,
        agent: AgentConfiguration,
        number: int,
        seed: int,
        load: Load | None = None,
        *,
        keeps_trace: bool = False,
        most_seconds: float = math.inf,
    ) -> MissionResult:
        """The result of one mission; an ERROR where the process died or took too long.

        `load` loads the models where they are others than those that the process was started with.
        """
        return self.fly_task(Task(number, seed, agent, keeps_trace=keeps_trace, load=load), most_seconds)

    def fly_task(self, task: Task, most_seconds: float = math.inf) -> MissionResult:
        """The result of one mission; an ERROR where the process died or took too long."""
        limit = min(self._time_limit, most_seconds)
        if self._worker is None:
            self._worker = _SPARE.take(self._load, self._agent)
        if self._worker is None:
            self._worker = _Worker(self._load, self._agent)
            if not self._worker.connection.poll(_START_LIMIT):
                return self._lost(task, "the process did not start")
            message = self._heard()
            if isinstance(message, LoadFailure):
                raise _unloaded(message)
            if message != READY:
                return self._lost(task, "the process did not start")
        self._worker.give([task], limit)
        if not self._worker.connection.poll(limit):
            return self._lost(task, f"took longer than {limit:g} s")
        result = self._heard()
        if isinstance(result, LastWords):
            return self._lost(task, result.reason, USER_CODE)
        return result if isinstance(result, MissionResult) else self._lost(task, "the process died")

    def _heard(self) -> object:
        assert self._worker is not None
        try:
            return self._worker.connection.recv()
        except (EOFError, OSError):
            return None

    def _lost(self, task: Task, reason: str, code: str = "") -> MissionResult:
        assert self._worker is not None
        self._worker.kill()
        self._worker = None
        return error_result(task, reason, code=code)


class _Worker:
    """A process, the way to it, and the missions that it still owes; the first of them is in flight."""

    def __init__(self, load: Load, agent: AgentConfiguration) -> None:
        context = multiprocessing.get_context("spawn")
        self.connection, other = context.Pipe()
        self.process: BaseProcess = context.Process(target=work, args=(other, load, agent), daemon=True)
        with _signals_held_back(), _safe_path(), _children_allowed():
            self.process.start()
        other.close()
        self.owed: deque[Task] = deque()
        self.is_ready = False
        self.deadline = time.monotonic() + _START_LIMIT

    def give(self, chunk: list[Task], time_limit: float) -> None:
        self.owed.extend(chunk)
        self.deadline = time.monotonic() + time_limit
        self.connection.send(chunk)

    def kill(self) -> None:
        """End the process, whatever it is doing."""
        self.process.kill()
        self.process.join()
        self.connection.close()


class _Spare:
    """A worker without missions, with what it has loaded; the latest one."""

    def __init__(self) -> None:
        self.is_wanted = False
        self._kept: tuple[Load, AgentConfiguration, _Worker] | None = None

    def keep(self, load: Load, agent: AgentConfiguration, worker: _Worker) -> None:
        """Keep a worker, or end it where none is wanted."""
        self.dismiss()
        if self.is_wanted:
            self._kept = (load, agent, worker)
        else:
            worker.kill()

    def take(self, load: Load, agent: AgentConfiguration) -> _Worker | None:
        """The worker that has loaded this."""
        if self._kept is None or self._kept[0] is not load or self._kept[1] != agent:
            return None
        worker, self._kept = self._kept[2], None
        return worker

    def dismiss(self) -> None:
        """End the one that is kept."""
        if self._kept is not None:
            self._kept[2].kill()
            self._kept = None


_SPARE = _Spare()


class _Pool:
    def __init__(self, batch: Batch, supervisor: Supervisor) -> None:
        self.batch, self.supervisor = batch, supervisor
        self.waiting = deque(batch.tasks)
        self.missing = len(batch.tasks)
        self.failed_starts = 0
        self.workers = [self._begun() for _ in range(batch.workers)]

    def _begun(self) -> _Worker:
        return _Worker(self.batch.load, self.batch.agent)

    def run(self, signalled: int) -> signal.Signals | None:
        """Serve workers until every task has its result, or there are enough; a signal ends that at once."""
        while not self.supervisor.is_enough() and (self.missing or self._refill()):
            ends: list[Connection | int] = [worker.connection for worker in self.workers]
            soonest = min(worker.deadline for worker in self.workers if worker.owed or not worker.is_ready)
            ready = wait([*ends, signalled], min(_MOST_QUIET, max(0.0, soonest - time.monotonic())))
            if signalled in ready:
                return signal.Signals(os.read(signalled, 1)[0])
            for worker in list(self.workers):
                if worker.connection in ready:
                    self._listen(worker)
                elif time.monotonic() > worker.deadline and (worker.owed or not worker.is_ready):
                    self._lose(worker, f"took longer than {self.batch.time_limit:g} s")
        return None

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
        if idle is not None and _SPARE.is_wanted:
            self.workers.remove(idle)
            _SPARE.keep(self.batch.load, self.batch.agent, idle)

    def stop(self) -> None:
        """End every worker; idle ones have nothing to lose, busy ones are not waited for."""
        for worker in self.workers:
            worker.process.kill()
        for worker in self.workers:
            worker.kill()

    def _listen(self, worker: _Worker) -> None:
        """Take one thing that a worker has said."""
        try:
            message = worker.connection.recv()
            if isinstance(message, LoadFailure):
                raise _unloaded(message)
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
            worker.deadline = time.monotonic() + self.batch.time_limit
            if not worker.owed:
                self._feed(worker)
        except (EOFError, OSError):
            worker.process.join(1.0)
            self._lose(worker, f"the process died ({_fate(worker.process.exitcode)})")

    def _feed(self, worker: _Worker) -> None:
        """Give a worker a chunk: the fewer missions are left, the smaller, so that all workers end together."""
        size = max(1, min(_LARGEST_CHUNK, len(self.waiting) // (2 * len(self.workers))))
        chunk = [self.waiting.popleft() for _ in range(min(size, len(self.waiting)))]
        if chunk:
            worker.give(chunk, self.batch.time_limit)

    def _lose(self, worker: _Worker, reason: str, code: str = "") -> None:
        """Give up a worker and the mission in flight, and start another one for the rest."""
        worker.kill()
        if worker.owed:
            self.missing -= 1
            self.supervisor.take(error_result(worker.owed.popleft(), reason, code=code))
        elif not worker.is_ready:
            self.failed_starts += 1
            if self.failed_starts >= _FAILED_STARTS:
                raise WorkerError(f"workers end before they are ready: {reason}")
        self.waiting.extendleft(reversed(worker.owed))
        self.workers.remove(worker)
        if self.missing:
            self.workers.append(self._begun())


def _unloaded(failure: LoadFailure) -> Exception:
    """The exception for models that a worker cannot load."""
    if failure.user_error:
        return UserCodeError(failure.user_error, failure.detail, failure.advice)
    return WorkerError(failure.detail)


def _fate(exit_code: int | None) -> str:
    if exit_code is None or exit_code >= 0:
        return f"exit code {exit_code}"
    try:
        return f"signal {signal.Signals(-exit_code).name}"
    except ValueError:  # real-time signals but the first and the last have no names
        return f"signal {-exit_code}"


@contextlib.contextmanager
def _signals_held_back() -> Iterator[None]:
    """Hold back what ends a batch: a process started in here is born with it blocked, and so never dies of it."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, _ENDING)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextlib.contextmanager
def _children_allowed() -> Iterator[None]:
    """Let a process start others though it is a daemon, as workers of Dask are: these end with their pipe."""
    settings = multiprocessing.current_process()._config  # type: ignore[attr-defined]
    before = settings.get("daemon")
    settings["daemon"] = False
    try:
        yield
    finally:
        settings["daemon"] = before


@contextlib.contextmanager
def _safe_path() -> Iterator[None]:
    """Keep the working folder off the path of a new interpreter: a `json.py` that lies there is not to be imported."""
    before = os.environ.get(_SAFE_PATH)
    os.environ[_SAFE_PATH] = "1"
    try:
        yield
    finally:
        if before is None:
            del os.environ[_SAFE_PATH]
        else:
            os.environ[_SAFE_PATH] = before


@contextlib.contextmanager
def _signal_pipe() -> Iterator[int]:
    """A file descriptor from which a signal that ends the batch can be read; the second one does what it always did."""
    reading, writing = os.pipe()
    is_main = threading.current_thread() is threading.main_thread()
    before = {number: signal.getsignal(number) for number in _ENDING}

    def note(number: int, _frame: FrameType | None) -> None:
        os.write(writing, bytes((number,)))
        signal.signal(number, before[number])

    if is_main:
        for number in _ENDING:
            if number != getattr(signal, "SIGHUP", None) or before[number] is not signal.SIG_IGN:  # nohup
                signal.signal(number, note)
    try:
        yield reading
    finally:
        if is_main:
            for number in _ENDING:
                signal.signal(number, before[number])
        os.close(reading)
        os.close(writing)
