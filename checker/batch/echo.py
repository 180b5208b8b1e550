"""Echo of a signal: whoever ends a group of processes reaches one of them by several ways; that counts once."""

import time

_MOMENT = 0.2  # seconds; who presses Ctrl-C twice is slower


class Echo:
    """What one handler of signals has seen."""

    def __init__(self) -> None:
        self._last: dict[int, float] = {}

    def is_of(self, number: int) -> bool:
        """Whether this signal has come a moment ago; asked once for each that comes."""
        now = time.monotonic()
        before, self._last[number] = self._last.get(number), now
        return before is not None and now - before < _MOMENT
