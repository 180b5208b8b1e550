"""Show how many flights were made to find out why missions fail, on standard error."""

import sys
import time
from types import TracebackType

import click

from nddlc.fitting import terminal_width

BAR_SECONDS = 0.2  # between two looks on a terminal
LINE_SECONDS = 4.0  # between two plain lines
_PATIENCE = 30.0  # seconds after which it is said how to do without conditions


class SeekingDisplay:
    """A call shows how many flights were made to find out why missions fail, unless that was done just now.

    Causes are sought for `most` seconds, where that is said; for conditions no flights are made with `--no-conditions`.
    What is `done` may be something else.
    """

    def __init__(self, most: float | None = None, done: str = "seeking causes and conditions") -> None:
        self._done = done
        self._is_terminal = sys.stderr.isatty()
        self._begun = self._shown = time.monotonic()
        self._most = "" if most is None else f" (causes: at most {most:.0f} s)"
        self._is_shown = False

    def __enter__(self) -> "SeekingDisplay":
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None, at: TracebackType | None) -> None:
        if self._is_shown and self._is_terminal:
            click.echo("\r\x1b[K", nl=False, err=True)

    def __call__(self, flights: int) -> None:
        now = time.monotonic()
        if now - self._shown < (BAR_SECONDS if self._is_terminal else LINE_SECONDS):
            return
        self._shown, self._is_shown = now, True
        text = f"{self._done}: {flights} flights in {now - self._begun:.0f} s"
        is_long = self._most and now - self._begun > _PATIENCE
        hint = " (quicker: --no-conditions)" if is_long else self._most
        if len(text + hint) < terminal_width():
            text += hint
        if self._is_terminal:
            click.echo(f"\r\x1b[K{text}", nl=False, err=True)
        else:
            click.echo(text, err=True)
