"""Show why there is no plan, or why a token was rejected: as lines of text, and as plain data."""

from collections.abc import Iterator
from typing import Any

from runtime.solver.learning.failure_log import Attempt, Failure
from runtime.solver.learning.rendering import Line

MOST_LINES = 60
DEEPEST = 12


def story(failure: Failure, depth: int = 0) -> Iterator[str]:
    """A failure as indented text: the flaw, each choice, and the lines of the model that forbid it."""
    margin = "  " * depth
    while len(failure.attempts) == 1 and failure.attempts[0].because is not None:
        yield f"{margin}{failure.flaw}: {failure.attempts[0].choice}"
        failure = failure.attempts[0].because
    yield f"{margin}{failure.flaw}"
    if not failure.attempts:
        yield f"{margin}  there is nothing to choose from"
    for attempt in failure.attempts:
        yield f"{margin}  {attempt.choice}:"
        if attempt.because is None:
            yield from (f"{margin}    {shown(line)}" for line in attempt.lines)
        elif depth < DEEPEST:
            yield from story(attempt.because, depth + 2)
        else:
            yield f"{margin}    ..."


def shortened(lines: Iterator[str]) -> Iterator[str]:
    """The first lines of a long story."""
    for number, line in enumerate(lines):
        if number == MOST_LINES:
            yield "  ... and more of the like"
            return
        yield line


def shown(line: Line) -> str:
    """A line of the model with its place, what it says there, and what it comes to."""
    owner = f", for `{line.owner}`" if line.owner else ""
    if line.span is None:
        return f"({line.how}) {line.text}"
    text = " ".join(line.span.text.split())
    said = f"`{text}`" if len(text) <= 60 else f"`{text[:57]}...`"
    return f"{line.span.source.name}:{line.span.line}: {said}{owner}: {line.text}"


def model_lines(failure: Failure) -> list[Line]:
    """All lines of the model that a story names, by place."""
    found: dict[Line, None] = {}
    waiting = [failure]
    while waiting:
        for attempt in waiting.pop().attempts:
            found.update(dict.fromkeys(line for line in attempt.lines if line.span is not None))
            if attempt.because is not None:
                waiting.append(attempt.because)
    return sorted(found, key=_place)


def _place(line: Line) -> tuple[str, int, str]:
    assert line.span is not None
    return line.span.source.name, line.span.begin, line.text


def as_data(failure: Failure) -> dict[str, Any]:
    """A failure for programs."""
    return {"flaw": failure.flaw, "choices": [_attempt(attempt) for attempt in failure.attempts]}


def _attempt(attempt: Attempt) -> dict[str, Any]:
    lines = [
        {
            "file": line.span.source.name if line.span is not None else None,
            "line": line.span.line if line.span is not None else None,
            "token": line.owner or None,
            "text": line.text,
        }
        for line in attempt.lines
    ]
    because = None if attempt.because is None else as_data(attempt.because)
    return {"choice": attempt.choice, "lines": lines, "because": because}
