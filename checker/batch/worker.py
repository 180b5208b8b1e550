"""What a worker process does: load the models once, then fly the missions it is sent, one answer each."""

import os
import signal
import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from multiprocessing.connection import Connection

import runtime.build_form
from checker.batch.garbage import seldom_collected
from checker.batch.result import MissionResult, condense, packed
from checker.limits import Limit
from checker.losses import losses_of
from checker.oracle import OUT_OF_TIME, USER_CODE, Judgement, Verdict, judge, judge_losses
from checker.sampling.sampler import RANDOM_POINT, SamplePoint
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.outcome import Outcome
from runtime.limits import TIME_LIMIT, LimitError, OutOfTimeError, bounded
from runtime.user.black_box import HERE
from runtime.user.fault import HELP, UserCodeError
from runtime.user.limit import WATCH

Fly = Callable[[int], Outcome]  # a seed in, an outcome out
Load = Callable[[AgentConfiguration], Fly]  # importable by name, so that a fresh process can have it

READY = "ready"


@dataclass(frozen=True, slots=True)
class Task:
    """One mission to fly; `agent` and `load` where they are others than those that the worker was started with.

    Its trace is kept where it fails, also by `limits` of what it may lose, and where it `keeps_trace` in any case.
    """

    number: int
    seed: int
    agent: AgentConfiguration | None = None
    point: SamplePoint = RANDOM_POINT
    keeps_trace: bool = False
    load: Load | None = None
    limits: tuple[tuple[Limit, int], ...] = ()


@dataclass(frozen=True, slots=True)
class LoadFailure:
    """What a worker says when it cannot load the models: a bug of ours, for they were checked before.

    Unless code of the project is to blame, which was not checked in this process; then that is said in `user_error`.
    """

    detail: str
    user_error: str = ""
    advice: str = ""


@dataclass(frozen=True, slots=True)
class LastWords:
    """What a worker says when code of the project does not come back and nothing else can end it."""

    reason: str


def work(
    connection: Connection, load: Load, agent: AgentConfiguration, box: str, memory: int, environment: dict[str, str]
) -> None:
    """Serve missions until None comes or the other end is gone; calls are noted in the black box of that name.

    More than `memory` MiB are not taken: a mission that needs them is an ERROR, and the next one is flown. The process
    may be a copy of one that was started in another `environment`.
    """
    if os.environ != environment:
        os.environ.clear()
        os.environ.update(environment)
    for name in ("SIGINT", "SIGTERM", "SIGHUP"):  # these go to the whole group; the parent decides what they mean
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_IGN)
    if box:
        HERE.open(box)
    WATCH.last_words = partial(_send_last_words, connection)
    with bounded(memory):
        _serve(connection, load, agent)


def _serve(connection: Connection, load: Load, agent: AgentConfiguration) -> None:
    try:
        try:
            fly = load(agent)
        except UserCodeError as problem:
            connection.send(LoadFailure(problem.detail, str(problem), problem.advice))
            return
        except Exception:
            connection.send(LoadFailure(traceback.format_exc()))
            return
        connection.send(READY)
        with seldom_collected():
            while (given := connection.recv()) is not None:
                tasks, seconds = given
                for task in tasks:
                    other = None if task.agent is None else (task.load or load)(task.agent)
                    with TIME_LIMIT.lasting(seconds, time.monotonic):
                        result = fly_one(other or fly, task)
                    connection.send_bytes(packed(result))
    except (EOFError, BrokenPipeError, ConnectionResetError):
        return  # the parent is gone


def _send_last_words(connection: Connection, problem: UserCodeError) -> None:
    connection.send(LastWords(reason_of(problem)))


def reason_of(problem: UserCodeError) -> str:
    """What a mission says that code of the project ended."""
    return str(problem) if problem.advice == HELP else f"{problem}; {problem.advice}"


def fly_one(fly: Fly, task: Task, *, keep_trace: bool = False) -> MissionResult:
    """Fly one mission and judge it; an exception is the tool's failure, not the model's."""
    try:
        outcome = fly(task.seed)
    except UserCodeError as problem:
        return error_result(task, reason_of(problem), problem.detail, USER_CODE)
    except OutOfTimeError as problem:
        return error_result(task, str(problem), code=OUT_OF_TIME)
    except LimitError as problem:
        return error_result(task, str(problem))
    except MemoryError:
        return error_result(task, "there was not enough memory for it")
    except Exception as problem:
        return error_result(task, f"{type(problem).__name__}: {problem}", traceback.format_exc())
    judgement, losses = judge(outcome), losses_of(outcome)
    keep_trace = keep_trace or task.keeps_trace
    if judge_losses(judgement, losses, task.limits).verdict is Verdict.PASS and not keep_trace:
        outcome = condense(outcome)
    else:
        keep_trace = True
    return MissionResult(task.number, task.seed, judgement, outcome, keep_trace, losses=losses, point=task.point)


def error_result(task: Task, message: str, detail: str = "", code: str = "") -> MissionResult:
    """The result of a mission that could not be flown to its end, by a fault of the tool or of code it was given."""
    judgement = Judgement(Verdict.ERROR, code, message=message)
    return MissionResult(task.number, task.seed, judgement, None, False, detail, point=task.point)
