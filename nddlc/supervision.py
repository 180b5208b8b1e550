"""Supervision: a command runs in a copy of the process, and this one waits; it says what took the copy with it.

A modeler's code can hold the interpreter (`sum(range(10**12))`) or end the process (a segmentation fault, `SIGKILL`):
the copy cannot tell of that. Signals that are meant for the command are passed on, and it ends as the command does.
"""

import ctypes
import os
import signal
import sys
from collections.abc import Callable
from contextlib import suppress

from runtime.user.black_box import HERE, BlackBox, new_box, signal_name
from runtime.user.fault import UserCodeError

_PASSED_ON = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGUSR1)
_FATAL = {signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS, signal.SIGFPE, signal.SIGILL}
_LOOK = 0.5  # seconds from one look to the next
_FROM_KERNEL = 128  # `si_code` of what a terminal sends, which it sends to the copy too
_SIGNALLED = 128  # and the number of the signal: the exit code of a process that a signal ended
_END_WITH_PARENT = 1  # PR_SET_PDEATHSIG
_UNUSABLE, _BUG = 2, 3


def supervise(tell: Callable[[UserCodeError], None], report: Callable[[Exception], int]) -> None:
    """Return in a copy of this process; this one ends with the copy.

    `tell` says what a modeler's code did; `report` tells of a death for which no such code is to blame, and gives the
    exit code. Where processes cannot be copied, or somebody steps through this one, nothing happens.
    """
    if not hasattr(signal, "sigtimedwait") or sys.gettrace() is not None or sys.getprofile() is not None:
        return
    box = new_box()
    if box is None:
        return
    watched = {*_PASSED_ON, signal.SIGCHLD}
    before = signal.pthread_sigmask(signal.SIG_BLOCK, watched)
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):
            stream.flush()
    waiting = os.getpid()
    try:
        copy = os.fork()
    except OSError:  # no more processes: the command runs without
        copy = None
    if not copy:
        if copy == 0:
            _end_with(waiting)
            HERE.open(box.path)
        box.close()
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        return
    try:
        code = _wait(copy, box, watched, tell, report)
    except BaseException:
        os.kill(copy, signal.SIGKILL)
        raise
    os._exit(code)


def _end_with(parent: int) -> None:
    """Have the kernel end this process when the one that waits for it is killed."""
    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).prctl(_END_WITH_PARENT, signal.SIGKILL, 0, 0, 0)
    if os.getppid() != parent:
        os._exit(_SIGNALLED + signal.SIGKILL)


def _wait(
    copy: int,
    box: BlackBox,
    watched: set[signal.Signals],
    tell: Callable[[UserCodeError], None],
    report: Callable[[Exception], int],
) -> int:
    """Pass signals on until the copy ends or hangs; the exit code."""
    while True:
        got = signal.sigtimedwait(watched, _LOOK)
        if got is not None and got.si_signo in _PASSED_ON and got.si_code != _FROM_KERNEL:
            os.kill(copy, got.si_signo)
        process, status = os.waitpid(copy, os.WNOHANG)
        if process == copy:
            return _ended(os.waitstatus_to_exitcode(status), box, tell, report)
        if box.is_stuck(_LOOK if got is None else 0.0):
            tell(box.hung(copy))
            os.kill(copy, signal.SIGKILL)
            os.waitpid(copy, 0)
            return _UNUSABLE


def _ended(code: int, box: BlackBox, tell: Callable[[UserCodeError], None], report: Callable[[Exception], int]) -> int:
    """Say what there is to say of the end of the copy; the exit code."""
    if box.is_leaving:
        return code if code >= 0 else _SIGNALLED - code
    how = f"exit code {code}" if code >= 0 else f"signal {signal_name(-code)}"
    blamed = box.died(how)
    if blamed is not None:
        tell(blamed)
        return _UNUSABLE
    if code >= 0:
        return code
    if -code in _FATAL:
        return report(RuntimeError(f"the process died ({how})\n{box.last_words()}"))
    _end_by(-code)
    return _SIGNALLED - code


def _end_by(number: int) -> None:
    """End by the same signal, so that whoever waits sees that."""
    with suppress(OSError, ValueError):
        signal.signal(number, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {number})
    os.kill(os.getpid(), number)
