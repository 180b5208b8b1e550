"""Processes that fly missions: started with the models they load, spared for who needs one, ended with their pipe."""

import contextlib
import math
import multiprocessing
import os
import signal
import sys
import time
from collections import deque
from collections.abc import Callable, Iterator
from multiprocessing.process import BaseProcess
from types import ModuleType

import runtime.build_form
from checker.batch.processor import PATIENCE, processor_seconds
from checker.batch.result import MissionResult
from checker.batch.signals import ENDING
from checker.batch.worker import READY, LastWords, Load, LoadFailure, Task, error_result, reason_of, work
from checker.oracle import HUNG, USER_CODE
from runtime.executive.configuration import AgentConfiguration
from runtime.limits import half_of_the_machine
from runtime.user.black_box import new_box, signal_name
from runtime.user.fault import UserCodeError

_SAFE_PATH = "PYTHONSAFEPATH"
_IMPORTED = ("checker.batch.worker", "checker.models")  # what flies, once for all workers
_LOOK = 0.25  # seconds from one look at a process to the next
GRACE = 5.0  # seconds beyond its limit in which a mission may say where it was
_START_LIMIT = 120.0  # seconds for a worker to load the models
_LEAST_MEMORY = 1024  # MiB that a worker may take on the smallest machine


class WorkerError(Exception):
    """No worker can be started: a bug of the tool, or a machine that lets no process live."""


@contextlib.contextmanager
def keeping_a_worker() -> Iterator[None]:
    """Within this, a worker that has nothing left to do waits for who needs one next: starting one takes a second."""
    SPARE.is_wanted = True
    try:
        yield
    finally:
        SPARE.is_wanted = False
        SPARE.dismiss()


class Flyer:
    """Flies single missions, each with an agent of its own, in one process that may die or hang without harm.

    `progress` is called before each flight with the number of those that were made.
    """

    def __init__(
        self,
        load: Load,
        agent: AgentConfiguration,
        time_limit: float,
        progress: Callable[[int], None] | None = None,
    ) -> None:
        self._load, self._agent, self._time_limit = load, agent, time_limit
        self._progress, self._flights = progress, 0
        self._worker: Worker | None = None
        self._begun, self._before = 0.0, 0.0  # processor time of the worker when it came here; of those before it

    def __enter__(self) -> "Flyer":
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        if kind is not None or self._worker is None:
            self.dismiss()
        else:
            SPARE.keep(self._load, self._agent, self._worker)

    def dismiss(self) -> None:
        """End the process."""
        if self._worker is not None:
            self._before = self.processor_seconds
            self._worker.kill()
            self._worker = None

    @property
    def processor_seconds(self) -> float:
        """What its flights have taken, the start of processes included; where that is not known, by the clock."""
        return self._before + (self._worker.processor_seconds - self._begun if self._worker is not None else 0.0)

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
        """The result of one mission; an ERROR where the process died or took too long: `most_seconds` of the processor.

        `load` loads the models where they are others than those that the process was started with.
        """
        return self.fly_task(Task(number, seed, agent, keeps_trace=keeps_trace, load=load), most_seconds)

    def fly_task(self, task: Task, most_seconds: float = math.inf) -> MissionResult:
        """The result of one mission; an ERROR where the process died or took too long."""
        if self._progress is not None:
            self._progress(self._flights)
        self._flights += 1
        limit = min(self._time_limit, PATIENCE * most_seconds)
        if self._worker is None:
            self._worker = SPARE.take(self._load, self._agent)
            self._begun = self._worker.processor_seconds if self._worker is not None else 0.0
        if self._worker is None:
            self._worker = Worker(self._load, self._agent)
            reason = self._worker.await_words(_START_LIMIT)
            if reason is not None:
                return self._lost(task, reason or "the process did not start", USER_CODE if reason else "")
            message = self._heard()
            if isinstance(message, LoadFailure):
                raise unloaded(message)
            if message != READY:
                return self._lost(task, *self._worker.fate())
        self._worker.give([task], limit)
        reason = self._worker.await_words(limit + GRACE, most_seconds)
        if reason is not None:
            return self._lost(
                task, reason or f"took longer than {min(limit, most_seconds):g} s", USER_CODE if reason else HUNG
            )
        result = self._heard()
        if isinstance(result, LastWords):
            return self._lost(task, result.reason, USER_CODE)
        return result if isinstance(result, MissionResult) else self._lost(task, *self._worker.fate())

    def _heard(self) -> object:
        assert self._worker is not None
        try:
            return self._worker.connection.recv()
        except (EOFError, OSError):
            return None

    def _lost(self, task: Task, reason: str, code: str = "") -> MissionResult:
        self.dismiss()
        return error_result(task, reason, code=code)


class Worker:
    """A process, the way to it, and the missions that it still owes; the first of them is in flight.

    It is one of `workers`, which share half of the machine's memory.
    """

    def __init__(self, load: Load, agent: AgentConfiguration, workers: int = 1) -> None:
        self.connection, other = multiprocessing.Pipe()
        self._box = new_box()
        self._looked = self._started = time.monotonic()
        box = "" if self._box is None else self._box.path
        memory = max(half_of_the_machine() // workers, _LEAST_MEMORY)
        self.process = _copy_or_new(other, load, agent, box, memory, dict(os.environ))
        with _signals_held_back(), _safe_path(), _children_allowed(), _main_hidden():
            self.process.start()
        other.close()
        self.owed: deque[Task] = deque()
        self.is_ready = False
        self.deadline = time.monotonic() + _START_LIMIT

    def give(self, chunk: list[Task], time_limit: float) -> None:
        self.owed.extend(chunk)
        self.deadline = time.monotonic() + time_limit + GRACE
        self.connection.send((chunk, time_limit))

    def hung(self) -> str | None:
        """Look whether a modeler's code holds the process for longer than it may: what to say of it then."""
        now = time.monotonic()
        step, self._looked = min(now - self._looked, _LOOK), now  # a process that was held does not notice
        if self._box is None or self.process.pid is None or not self._box.is_stuck(step):
            return None
        return reason_of(self._box.hung(self.process.pid))

    @property
    def processor_seconds(self) -> float:
        """What it has used; where the system does not tell, how long it has lived."""
        used = processor_seconds(self.process.pid) if self.process.pid is not None else None
        return time.monotonic() - self._started if used is None else used

    def await_words(self, seconds: float, processor: float = math.inf) -> str | None:
        """Wait until it says something; why it does not: a modeler's code, or "" where nobody knows more.

        Not longer than so many seconds by the clock, and so many of the `processor`.
        """
        end, most = time.monotonic() + seconds, self.processor_seconds + processor
        while not self.connection.poll(min(_LOOK, max(0.0, end - time.monotonic()))):
            reason = self.hung()
            if reason is not None or time.monotonic() >= end or self.processor_seconds >= most:
                return reason or ""
        return None

    def fate(self) -> tuple[str, str]:
        """How it died, and the code of the judgement."""
        self.process.join(1.0)
        code = self.process.exitcode
        how = f"signal {signal_name(-code)}" if code is not None and code < 0 else f"exit code {code}"
        blamed = None if self._box is None else self._box.died(how)
        return (reason_of(blamed), USER_CODE) if blamed is not None else (f"the process died ({how})", "")

    def kill(self) -> None:
        """End the process, whatever it is doing."""
        self.process.kill()
        self.process.join()
        self.connection.close()
        if self._box is not None:
            self._box.close()


class _Spare:
    """A worker without missions, with what it has loaded; the latest one."""

    def __init__(self) -> None:
        self.is_wanted = False
        self._kept: tuple[Load, AgentConfiguration, Worker] | None = None

    def keep(self, load: Load, agent: AgentConfiguration, worker: Worker) -> None:
        """Keep a worker, or end it where none is wanted."""
        self.dismiss()
        if self.is_wanted:
            self._kept = (load, agent, worker)
        else:
            worker.kill()

    def take(self, load: Load, agent: AgentConfiguration) -> Worker | None:
        """The worker that has loaded this."""
        if self._kept is None or self._kept[0] != load or self._kept[1] != agent:
            return None
        worker, self._kept = self._kept[2], None
        return worker

    def dismiss(self) -> None:
        """End the one that is kept."""
        if self._kept is not None:
            self._kept[2].kill()
            self._kept = None


SPARE = _Spare()


def unloaded(failure: LoadFailure) -> Exception:
    """The exception for models that a worker cannot load."""
    if failure.user_error:
        return UserCodeError(failure.user_error, failure.detail, failure.advice)
    return WorkerError(failure.detail)


def _copy_or_new(*given: object) -> BaseProcess:
    """A process that will work with what is given: a copy of one that has imported what flies, where that can be."""
    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn").Process(target=work, args=given, daemon=True)
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(list(_IMPORTED))
    return context.Process(target=work, args=given, daemon=True)


@contextlib.contextmanager
def _main_hidden() -> Iterator[None]:
    """Hide the program from a new process, which else runs it again: nothing that it is sent stands in there."""
    program = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = program


@contextlib.contextmanager
def _signals_held_back() -> Iterator[None]:
    """Hold back what ends a batch: a process started in here is born with it blocked, and so never dies of it."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ENDING)
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
