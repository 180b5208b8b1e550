"""A signal while something is sought: it ends what is under way, and what was found before is kept."""

import signal
import threading
from collections.abc import Callable
from types import FrameType, TracebackType
from typing import Any, TypeVar

from checker.batch.echo import Echo
from checker.batch.process import ENDING

_Found = TypeVar("_Found")


class InterruptedSearch(KeyboardInterrupt):
    """Raised where a signal finds a search."""


class Interruption:
    """Within this, the first Ctrl-C, SIGTERM or hang-up ends a search; the second one does what it always did."""

    def __init__(self) -> None:
        self.ended_by: signal.Signals | None = None
        self._is_searching = False
        self._before: dict[int, Any] = {}
        self._echo = Echo()

    def __enter__(self) -> "Interruption":
        if threading.current_thread() is threading.main_thread():
            for number in ENDING:
                before = signal.getsignal(number)
                if number != getattr(signal, "SIGHUP", None) or before is not signal.SIG_IGN:  # nohup
                    self._before[number] = before
                    signal.signal(number, self._note)
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None, at: TracebackType | None) -> None:
        for number, before in self._before.items():
            signal.signal(number, before)

    def __call__(self, search: Callable[[], _Found]) -> _Found | None:
        """What a search finds; None where a signal has ended it, or came before."""
        if self.ended_by is not None:
            return None
        try:
            self._is_searching = True
            found = search()
            self._is_searching = False
        except InterruptedSearch:
            return None
        finally:
            self._is_searching = False
        return found

    def _note(self, number: int, _frame: FrameType | None) -> None:
        if self._echo.is_of(number):
            return
        if self.ended_by is not None:
            signal.signal(number, self._before[number])
            signal.raise_signal(number)
            return
        self.ended_by = signal.Signals(number)
        if self._is_searching:
            raise InterruptedSearch


def uninterrupted(search: Callable[[], _Found]) -> _Found | None:
    """What a search finds, where nobody waits for a signal."""
    return search()
