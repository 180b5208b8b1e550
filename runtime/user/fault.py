"""The one exception for what goes wrong in a modeler's Python code: it names the file and the line."""

import linecache
import traceback
from collections.abc import Sequence
from pathlib import Path

HELP = "this is in code of the project, see docs/constraints.md, and docs/agent.md on reactors"


class UserCodeError(Exception):
    """Code that a modeler wrote failed, or is not what nddlc asked for.

    `detail` is the traceback, if there is one; `advice` says what to do about it. `raised` is the line of the project
    that failed, as file, line and text, if one did.
    """

    def __init__(
        self, message: str, detail: str = "", advice: str = HELP, raised: tuple[str, int, str] | None = None
    ) -> None:
        super().__init__(message)
        self.detail = detail
        self.advice = advice
        self.raised = raised


class StoppedError(BaseException):
    """Raised inside code that was away for longer than `seconds`; not to be caught by it."""

    def __init__(self, seconds: float) -> None:
        super().__init__(f"stopped after {seconds:g} s")
        self.seconds = seconds


def failed(
    what: str, problem: BaseException, files: tuple[str, ...], line: int = 1, verb: str = "failed"
) -> UserCodeError:
    """Name the deepest line in one of `files`, or `line` in the first of them, for an exception."""
    frames = [(frame.f_code.co_filename, line) for frame, line in traceback.walk_tb(problem.__traceback__)]
    place, raised = place_in(frames, files, line), _raised_in(frames, files)
    if isinstance(problem, StoppedError):
        return stopped(place, what, problem.seconds)
    if isinstance(problem, SyntaxError) and problem.filename in files:
        place = f"{problem.filename}:{problem.lineno}"
    kind = type(problem).__name__
    said = problem.msg if isinstance(problem, SyntaxError) else str(problem)
    text = f"{kind}: {said}" if said else f"{kind} at `{raised[2]}`" if raised and raised[2] else kind
    detail = "".join(traceback.format_exception(problem))
    return UserCodeError(f"{place}: {what} {verb}: {text.splitlines()[0]}", detail, raised=raised)


def stopped(place: str, what: str, seconds: float) -> UserCodeError:
    """Say that `what` was at `place` when it was stopped."""
    advice = f"`time_limit = {2 * seconds:g}` under [constraints] lets it run longer, see docs/constraints.md"
    return UserCodeError(f"{place}: {what} did not come back within {seconds:g} s and was stopped", advice=advice)


def ended(place: str, what: str, how: str) -> UserCodeError:
    """Say that `what` was at `place` when it took the process with it."""
    return UserCodeError(f"{place}: {what} ended the process ({how})")


def _raised_in(calls: Sequence[tuple[str, int]], files: tuple[str, ...]) -> tuple[str, int, str] | None:
    """The deepest line of `calls` in one of `files`, with its text; None where there is none."""
    own = [each for each in calls if each[0] in files]
    return (*own[-1], linecache.getline(*own[-1]).strip()) if own else None


def place_in(calls: Sequence[tuple[str, int]], files: tuple[str, ...], line: int = 1) -> str:
    """The deepest of `calls`, each a file and a line, in one of `files`, else `line` there; else the deepest one."""
    own = [each for each in calls if each[0] in files] or [(file, line) for file in files] or [*calls]
    return f"{Path(own[-1][0]).as_posix()}:{own[-1][1]}" if own else "?"
