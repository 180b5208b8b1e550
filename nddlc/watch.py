"""`--watch`: carry a command out again whenever a file changes that it may read, until Ctrl-C or SIGTERM.

Each time is a process of its own, so nothing of the last time lasts. Files are polled: no notification of the system is
needed, so network drives and containers do as well.
"""

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path
from types import FrameType
from typing import Any

import click

from nddl_lang.mission_suffixes import MISSION_SUFFIXES
from nddl_lang.text.read import LARGEST

_KINDS = (".nddl", *MISSION_SUFFIXES, ".py", ".csv", ".json")
_NAMED = re.compile(rb'"([^"\n]{1,300}\.(?:nddl|toml|xml|py|csv|json))["|:]')  # as files name others
_OUTPUT = ("nddlc-report", "node_modules", "__pycache__")
_PERIOD = 0.25  # seconds between two looks
_ENDING = 5.0  # seconds that an interrupted run may take to end by itself
_LEFT_BY_SHELLS = 128  # and the number of the signal: how a process ends that one has ended
_GIVEN = "nddlc.watch.arguments"
_ENDING_SIGNALS = tuple(getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name))
Stamps = dict[Path, tuple[int, int]]


class WatchedCommand(click.Command):
    """A command with `--watch`."""

    def __init__(self, *args: Any, **given: Any) -> None:
        super().__init__(*args, **given)
        told = "Do it again whenever a file of the model or mission changes; Ctrl-C ends it."
        self.params.append(click.Option(["--watch", "is_watched"], is_flag=True, help=told))

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Keep the arguments, to give them on."""
        ctx.meta[_GIVEN] = [each for each in args if each != "--watch"]
        return super().parse_args(ctx, args)

    def invoke(self, ctx: click.Context) -> Any:
        """Once, or again and again."""
        if not ctx.params.pop("is_watched"):
            return super().invoke(ctx)
        names = [each.name for each in self.params if isinstance(each, click.Argument)]  # options name what is written
        given = [value for name in names if isinstance(value := ctx.params.get(name or ""), str | Path | tuple)]
        flat = [str(each) for value in given for each in (value if isinstance(value, tuple) else (value,))]
        named = [path for path in map(Path, flat) if path.exists()]
        dialect = [] if ctx.obj is None else ["--dialect", ctx.obj]
        return _watch([*dialect, str(ctx.info_name), *ctx.meta[_GIVEN]], named or [Path()], ctx.params.get("output"))


class _EndedError(BaseException):
    """A signal that ends processes has come: not Ctrl-C, which a job in the background of a script never gets."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


def _end(number: int, frame: FrameType | None) -> None:
    raise _EndedError(number)


def _watch(arguments: list[str], named: list[Path], output: Path | None) -> int:
    """Run, wait for a change, run again; Ctrl-C or another signal ends it in good order."""
    is_deaf = signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    end = f"`kill {os.getpid()}`" if is_deaf else "Ctrl-C"
    before_that = {number: signal.signal(number, _end) for number in _ENDING_SIGNALS if _is_default(number)}
    try:
        while True:
            before = stamps(named, output)
            _run(arguments)
            count = len(before)
            click.echo(f"nddlc: watching {count} file{'' if count == 1 else 's'}; {end} ends it", err=True)
            changed = _changed(before, named, output)
            click.echo(f"nddlc: changed: {', '.join(changed[:3])}{' and more' if len(changed) > 3 else ''}", err=True)
    except KeyboardInterrupt:
        click.echo("\nnddlc: no longer watching", err=True)
        return 0
    except _EndedError as ended:
        click.echo(f"nddlc: no longer watching ({signal.Signals(ended.number).name})", err=True)
        return _LEFT_BY_SHELLS + ended.number
    finally:
        for number, handler in before_that.items():
            signal.signal(number, handler)


def _is_default(number: int) -> bool:
    return signal.getsignal(number) is signal.SIG_DFL


def _run(arguments: list[str]) -> None:
    with subprocess.Popen([sys.executable, "-P", "-m", "nddlc.main", *arguments]) as process:
        try:
            process.wait()
        except KeyboardInterrupt:
            # A terminal has told it as well: it is asked again only if it goes on.
            with suppress(subprocess.TimeoutExpired):
                process.wait(_ENDING)
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
            raise
        except _EndedError:
            process.terminate()
            with suppress(subprocess.TimeoutExpired):
                process.wait(_ENDING)
            if process.poll() is None:
                process.kill()
            raise


def _changed(before: Stamps, named: list[Path], output: Path | None) -> list[str]:
    """Wait until files differ from before, and no longer from one look to the next; which these are."""
    now = before
    while True:
        time.sleep(_PERIOD)
        last, now = now, stamps(named, output)
        if now == last != before:
            both = sorted({*before, *now})
            return [str(path) for path in both if before.get(path) != now.get(path)]


def stamps(named: Iterable[Path], output: Path | None = None) -> Stamps:
    """When the files that may be read were changed, and how large they are.

    These are the files in the folders that are named, in those of the files that are, and what files name in quotes;
    of the folder `output`, where reports are written, none.
    """
    found: Stamps = {}
    written = None if output is None else output.resolve()
    waiting = [path for each in named for path in _files(each, written)]
    while waiting:
        path = waiting.pop()
        try:
            told = path.stat()
        except OSError:
            continue
        if path in found or not path.is_file():
            continue
        found[path] = (told.st_mtime_ns, told.st_size)
        waiting += [other for other in _named_in(path, told.st_size) if other not in found]
    return found


def _files(named: Path, written: Path | None) -> Iterator[Path]:
    """The files of a folder and the folders below but `written`; of a file those beside it."""
    try:
        beside = sorted((named if named.is_dir() else named.parent).iterdir())
    except OSError:
        return
    for path in beside:
        if path.suffix in _KINDS and path.is_file():
            yield path
        elif named.is_dir() and path.is_dir() and not path.is_symlink() and not _is_left_out(path, written):
            yield from _files(path, written)


def _is_left_out(folder: Path, written: Path | None) -> bool:
    return folder.name.startswith(".") or folder.name in _OUTPUT or folder.resolve() == written


def _named_in(path: Path, size: int) -> Iterator[Path]:
    """The files that the text of a file names."""
    if path.suffix not in (".nddl", *MISSION_SUFFIXES) or size > LARGEST:
        return
    with suppress(OSError):
        for match in _NAMED.finditer(path.read_bytes()):
            other = path.parent / match[1].decode(errors="replace")
            with suppress(OSError, ValueError):
                if other.is_file():
                    yield Path(*other.parts) if ".." not in other.parts else other.resolve()
