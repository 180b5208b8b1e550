"""Signals that end what is under way: Ctrl-C, SIGTERM, a hang-up."""

import signal
import threading
import time
from collections.abc import Callable
from types import FrameType, TracebackType
from typing import Any, Self

ENDING = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))
_MOMENT = 0.2  # seconds; who presses Ctrl-C twice is slower


class Echo:
    """What one handler of signals has seen: whoever ends a group of processes reaches one of them by several ways."""

    def __init__(self) -> None:
        self._last: dict[int, float] = {}

    def is_of(self, number: int) -> bool:
        """Whether this signal has come a moment ago; asked once for each that comes."""
        now = time.monotonic()
        before, self._last[number] = self._last.get(number), now
        return before is not None and now - before < _MOMENT


class FirstSignals:
    """Within this, the first signal of each kind that ends things goes to `take`; the second does what it always did.

    `first` is the first of all. A hang-up that is ignored stays so (nohup). Outside the main thread, where no signal
    arrives, nothing changes.
    """

    def __init__(self, take: Callable[[signal.Signals], None] | None = None) -> None:
        self.first: signal.Signals | None = None
        self._take = take
        self._before: dict[int, Any] = {}
        self._taken: set[int] = set()
        self._echo = Echo()

    def __enter__(self) -> Self:
        if threading.current_thread() is threading.main_thread():
            for number in ENDING:
                before = signal.getsignal(number)
                if number != getattr(signal, "SIGHUP", None) or before is not signal.SIG_IGN:
                    self._before[number] = before
                    signal.signal(number, self._come)
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None, at: TracebackType | None) -> None:
        for number, before in self._before.items():
            signal.signal(number, before)

    def _come(self, number: int, _frame: FrameType | None) -> None:
        if self._echo.is_of(number):
            return
        if number in self._taken:
            signal.signal(number, self._before[number])
            signal.raise_signal(number)
            return
        self._taken.add(number)
        self.first = self.first or signal.Signals(number)
        if self._take is not None:
            self._take(signal.Signals(number))
