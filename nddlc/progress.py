"""Show how far a batch has come: a bar on a terminal, else a plain line now and then, on standard error."""

import sys
import time
from types import TracebackType

import click
from rich.console import Console
from rich.progress import BarColumn, TextColumn
from rich.progress import Progress as Bar

from checker.batch.progress import Progress
from checker.report.sentences import percent
from checker.statistics import confidence_sequence
from nddlc.fitting import columns, fitted
from nddlc.seeking import BAR_SECONDS, LINE_SECONDS


class Display:
    """A call shows the progress of a batch, unless that was done just now."""

    def __init__(self, confidence: float) -> None:
        self._confidence = confidence
        self._is_terminal = sys.stderr.isatty()
        self._shown = time.monotonic()
        self._bar: Bar | None = None

    def __enter__(self) -> "Display":
        if self._is_terminal:
            columns = (BarColumn(bar_width=24), TextColumn("{task.description}"))
            self._bar = Bar(*columns, console=Console(stderr=True), transient=True, auto_refresh=False)
            self._bar.start()
            self._bar.add_task("")
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None, at: TracebackType | None) -> None:
        if self._bar is not None:
            self._bar.stop()

    def __call__(self, progress: Progress) -> None:
        now = time.monotonic()
        if now - self._shown < (LINE_SECONDS if self._bar is None else BAR_SECONDS):
            return
        self._shown = now
        text = _progress_text(progress, self._confidence)
        if self._bar is None:
            click.echo(fitted(text, columns()), err=True)
        else:
            task = self._bar.task_ids[0]
            self._bar.update(task, total=progress.planned, completed=progress.done, description=text, refresh=True)


def _progress_text(progress: Progress, confidence: float) -> str:
    """Missions, rate, time left, failures with the interval of their rate so far."""
    parts = [f"{progress.done} of {progress.planned} missions"]
    if progress.kept:
        parts[0] += f" ({progress.kept} from the store)"
    if progress.rate:
        rate = progress.rate
        parts.append(f"{rate:.0f}/s" if rate >= 10.0 else f"{rate:.2g}/s" if rate >= 0.1 else f"{60 * rate:.2g}/min")
    if (left := progress.seconds_left) is not None:
        parts.append(f"{_duration(left)} left")
    failed = f"{progress.failures} failed"
    if (counted := progress.done - progress.errors) > 0 and progress.has_interval:
        lower, upper = confidence_sequence(progress.failures, counted, confidence)
        failed += f" ({percent(lower)} to {percent(upper)})"
    parts.append(failed)
    if progress.errors:
        parts.append(f"{progress.errors} errors")
    return ", ".join(parts)


def _duration(seconds: float) -> str:
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60} s"
    return f"{whole // 3600} h {whole % 3600 // 60} min"
