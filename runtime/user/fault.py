"""The one exception for what goes wrong in a modeler's Python code: it names the file and the line."""

import traceback
from pathlib import Path
from types import TracebackType


class UserCodeError(Exception):
    """Code that a modeler wrote failed, or is not what nddlc asked for; `detail` is the traceback, if there is one."""

    def __init__(self, message: str, detail: str = "") -> None:
        super().__init__(message)
        self.detail = detail


def failed(what: str, problem: BaseException, files: tuple[str, ...]) -> UserCodeError:
    """Blame the deepest line in one of `files` (else the deepest one at all) for an exception."""
    place = _place(problem.__traceback__, files)
    if isinstance(problem, SyntaxError) and problem.filename in files:
        place = f"{problem.filename}:{problem.lineno}"
    kind = type(problem).__name__
    said = problem.msg if isinstance(problem, SyntaxError) else str(problem)
    text = f"{kind}: {said}" if said else kind
    detail = "".join(traceback.format_exception(problem))
    return UserCodeError(f"{place}: {what}: {text.splitlines()[0]}", detail)


def _place(trace: TracebackType | None, files: tuple[str, ...]) -> str:
    frames = [(frame.f_code.co_filename, line) for frame, line in traceback.walk_tb(trace)]
    own = [each for each in frames if each[0] in files] or frames
    return f"{own[-1][0]}:{own[-1][1]}" if own else Path(files[0]).as_posix() if files else "?"
