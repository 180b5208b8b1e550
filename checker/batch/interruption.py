"""A signal while something is sought: it ends what is under way, and what was found before is kept."""

import signal
from collections.abc import Callable
from typing import TypeVar

from checker.batch.signals import FirstSignals

_Found = TypeVar("_Found")


class InterruptedSearch(KeyboardInterrupt):
    """Raised where a signal finds a search."""


class Interruption(FirstSignals):
    """Within this, the first Ctrl-C, SIGTERM or hang-up ends a search."""

    def __init__(self) -> None:
        self._is_searching = False
        super().__init__(self._note)

    def __call__(self, search: Callable[[], _Found]) -> _Found | None:
        """What a search finds; None where a signal has ended it, or came before."""
        if self.first is not None:
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

    def _note(self, _number: signal.Signals) -> None:
        if self._is_searching:
            raise InterruptedSearch


def uninterrupted(search: Callable[[], _Found]) -> _Found | None:
    """What a search finds, where nobody waits for a signal."""
    return search()
