"""End a long search when time is over or somebody presses Ctrl-C, and tell meanwhile how far it has come."""

import signal
import sys
import threading
import time
from types import FrameType

import click

from checker.batch.signals import Echo
from nddlc.fitting import terminal_width
from runtime.solver.search import Solver
from runtime.user.limit import WATCH

_SHOWING_SECONDS = 0.0003  # for a token, when the search is over
_PROGRESS_SECONDS = 0.5  # until progress is told, and between two tellings


class Clock:
    """A call says whether to stop: time is over, or Ctrl-C was pressed, which interrupts nothing the first time."""

    def __init__(self, solver: Solver, seconds: float | None) -> None:
        self.solver = solver
        self.seconds = seconds
        self.is_interrupted = False
        self._begun = self._told = time.monotonic()
        self._is_terminal = sys.stderr.isatty()
        self._before: object = None
        self._echo = Echo()

    def __enter__(self) -> "Clock":
        if threading.current_thread() is threading.main_thread():
            self._before = signal.getsignal(signal.SIGINT)
            if self._is_plain:
                signal.signal(signal.SIGINT, self._note)
        return self

    def __exit__(self, *_: object) -> None:
        if self._is_plain:
            signal.signal(signal.SIGINT, self._before)  # type: ignore[arg-type] # it came from there
        if self._told > self._begun:
            self._write("")

    @property
    def _is_plain(self) -> bool:
        return self._before in (signal.default_int_handler, WATCH.interrupt)

    def __call__(self) -> bool:
        now = time.monotonic()
        if self._is_terminal and now - self._told >= _PROGRESS_SECONDS:
            self._told = now
            solver = self.solver
            self._write(
                f"{now - self._begun:.0f} s, {solver.steps} steps, {solver.failures} failed, depth {solver.depth}"
            )
        if self.is_interrupted or self.seconds is None:
            return self.is_interrupted
        # How far the search came must be shown within the limit too.
        showing = min(self.seconds / 2, self.solver.plan.rows.token_count * _SHOWING_SECONDS)
        return now - self._begun + showing >= self.seconds

    def _note(self, number: int, frame: FrameType | None) -> None:
        if self._echo.is_of(number):
            return
        if self.is_interrupted or WATCH.call is not None:
            WATCH.interrupt(number, frame)
        self.is_interrupted = True

    def _write(self, line: str) -> None:
        """Put a line where the last one stood."""
        room = max(terminal_width() - 1, 1)
        click.echo(f"\r{line[:room]:<{min(room, 70)}}\r", err=True, nl=False)
