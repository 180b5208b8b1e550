"""Let a modeler's code run no longer than a limit: what does not come back is stopped where it is.

A call costs a few assignments. Every half a second a signal looks whether one is under way that was there before; one
that is there too long is interrupted, also where it sleeps, waits or matches a pattern. Beside it a thread looks: a
call that swallows the interruption, or that no signal reaches, takes the process with it, after its place was told.
Looks are counted, no clock is read: a process that was held does not notice. Out of reach from in here is what neither
looks for signals nor lets other threads run, as `sum(range(10**12))`: who has a black box of this process sees that.
"""

import atexit
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stdout
from dataclasses import dataclass
from threading import get_ident
from types import FrameType
from typing import NoReturn

from runtime.constraints.domains.store import Store
from runtime.user.black_box import HERE
from runtime.user.calls import Call, CallSlot
from runtime.user.fault import StoppedError, UserCodeError, place_in, stopped

USUAL = 5.0  # seconds that one call may take
LOOK = 0.5  # seconds from one look to the next
GRACE = 2.0  # seconds from the interruption to the end of the process
UNUSABLE = 2
DEBUGGERS = ("bdb", "pydevd")
_END, _ABORT = os._exit, os.abort  # as they are where no call of a modeler's code is under way
ALARM: int | None = getattr(signal, "SIGALRM", getattr(signal, "SIGBREAK", None))


@dataclass(frozen=True, eq=False, slots=True)
class Plain:
    """A caller of what no model calls."""

    title: str
    files: tuple[str, ...] = ()
    line: int = 1

    def told(self, s: Store | None, c: int) -> str:
        """The same wherever it is."""
        return self.title


def _print_last_words(problem: UserCodeError) -> None:
    """Tell on standard error why the process ends, past any lock that the hanging code may hold."""
    os.write(2, f"nddlc: {problem}\n  help: {problem.advice}\n".encode())


class _Looks:
    """How long the call that is under way has been seen there."""

    def __init__(self) -> None:
        self.seen: Call | None = None
        self.away = 0.0

    def add(self, call: Call | None, step: float) -> float:
        """Look at it another time, `step` seconds after the last one; the seconds that it was there for certain."""
        self.away = self.away + step if call is self.seen and call is not None else 0.0
        self.seen = call
        return self.away


class Watch(CallSlot):
    """The call of a modeler's code that is under way in this process, and how long one may take."""

    def __init__(self) -> None:
        super().__init__()
        self.seconds = USUAL
        self.last_words: Callable[[UserCodeError], None] = _print_last_words
        self._thread = 0  # the one that calls
        self._looks = _Looks()
        self._excused: Call | None = None  # the call that somebody steps through
        self._has_alarm = False
        self._is_watching = False
        self._is_copy = False
        self.is_interrupted = False  # by Ctrl-C

    @property
    def step(self) -> float:
        """Seconds from one look to the next."""
        return min(LOOK, self.seconds)

    def start(self) -> None:
        """Watch the calls that this thread makes from now on."""
        self._thread = get_ident()
        if self._thread == threading.main_thread().ident:
            self._set_alarm()
            if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
                signal.signal(signal.SIGINT, self.interrupt)
        os._exit, os.abort = self._exit, self._abort
        self.box = HERE.recorder
        if self.box is not None:
            self.box.limit(self.seconds)
        if not self._is_watching:
            self._is_watching = True
            threading.Thread(target=self._look, name="nddlc limit", daemon=True).start()

    def _set_alarm(self) -> None:
        """Have the kernel call; where it cannot, the thread does. Somebody else's alarm is left alone."""
        if ALARM is not None and signal.getsignal(ALARM) == signal.SIG_DFL:
            signal.signal(ALARM, self._alarm)
            self._has_alarm = True
            if hasattr(signal, "setitimer"):
                atexit.register(signal.setitimer, signal.ITIMER_REAL, 0.0)  # the interpreter lets go of signals earlier
        if self._has_alarm and hasattr(signal, "setitimer"):
            signal.setitimer(signal.ITIMER_REAL, self.step, self.step)

    def interrupt(self, _number: int, _frame: FrameType | None) -> None:
        """Leave by an exception, as Python does on Ctrl-C, and note that no modeler's code raised it."""
        self.is_interrupted = True
        raise KeyboardInterrupt

    @property
    def was_pressed(self) -> bool:
        """Whether an interruption that came out of a call may be Ctrl-C; somebody else's handler may have raised it."""
        handler = signal.getsignal(signal.SIGINT)
        return self.is_interrupted or (callable(handler) and handler != self.interrupt)

    def _exit(self, status: int) -> NoReturn:
        """In place of `os._exit`: the end of the process is not a modeler's to choose, nor its exit code."""
        if self.call is not None and get_ident() == self._thread:
            raise RuntimeError(f"os._exit({status}) is not for a constraint, nor for a reactor: raise an exception")
        _END(status)

    def _abort(self) -> NoReturn:
        """In place of `os.abort`."""
        if self.call is not None and get_ident() == self._thread:
            raise RuntimeError("os.abort() is not for a constraint, nor for a reactor: raise an exception")
        _ABORT()

    def _note_fork(self) -> None:
        """This process is a copy of the one that was here; it has no thread that watches."""
        self._is_watching = False
        self.box = HERE.recorder = None
        if self.call is not None:
            self._is_copy = True
            self.call = None

    def astray(self, call: Call) -> None:
        """A call came back that is not the one under way: in a copy of the process, that is its end."""
        if self._is_copy:
            caller, s, c = call
            what = f"{caller.told(s, c)} copied the process (`fork`), and the copy came back: it was ended"
            self._leave(UserCodeError(f"{place_in((), caller.files)}: {what}"))

    def _look(self) -> None:
        """Look in a thread of its own, until the end of the process."""
        pause = threading.Event()
        looks = _Looks()
        while not pause.wait(step := self.step):
            call = self.call
            away = looks.add(None if call is self._excused else call, step)
            if call is not None and away >= self.seconds + GRACE:
                caller, s, c = call
                place = place_in(_calls_of(sys._current_frames().get(self._thread)), caller.files)
                self._leave(stopped(place, caller.told(s, c), self.seconds))
            elif self._has_alarm and ALARM is not None and not hasattr(signal, "setitimer"):
                signal.raise_signal(ALARM)

    def _alarm(self, _number: int, _frame: FrameType | None) -> None:
        """Look in the main thread, wherever it is, and leave there by an exception."""
        if self._looks.add(self.call, self.step) < self.seconds or self._thread != get_ident():
            return
        if _is_debugged():
            self._excused = self.call
            if self.box is not None:
                self.box.excuse()
        elif self.call is not self._excused:
            raise StoppedError(self.seconds)

    def _leave(self, problem: UserCodeError) -> None:
        try:
            HERE.leave()
            self.last_words(problem)
        finally:
            _END(UNUSABLE)


def _is_debugged() -> bool:
    """Whether somebody steps through this thread, who has all the time in the world."""
    trace = sys.gettrace()
    module = str(getattr(trace, "__module__", None) or type(trace).__module__)
    return any(part.startswith(DEBUGGERS) for part in module.split("."))


def _calls_of(frame: FrameType | None) -> list[tuple[str, int]]:
    """File and line of each call, the outermost first."""
    found: list[tuple[str, int]] = []
    while frame is not None:
        found.append((frame.f_code.co_filename, frame.f_lineno))
        frame = frame.f_back
    return found[::-1]


WATCH = Watch()


@contextmanager
def watched(what: str, files: tuple[str, ...] = ()) -> Iterator[None]:
    """Run what is inside as a call; what it prints goes to standard error, since programs read standard output."""
    call = (Plain(what, files), None, 0)
    WATCH.start()
    before = WATCH.begin(call)
    try:
        with redirect_stdout(sys.stderr):
            yield
    finally:
        WATCH.end(call, before)


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=WATCH._note_fork)
