"""Words for a failure log: as lines of text, and as plain data."""

from collections.abc import Iterator
from typing import Any, assert_never

from runtime.plan.readout.cause_rendering import words
from runtime.solver.learning.attempts import Attempt, FailedFlaw, Flaw, FoundCause, Resolver, ResolverKind
from runtime.solver.tags import OPEN_CONDITION, RESOURCE_THREAT, THREAT, UNBOUND_VARIABLE

_MOST_LINES = 60
_DEEPEST = 12


def story(failed: FailedFlaw) -> Iterator[str]:
    """The first lines of a failure: the flaw, each resolver, and the lines of the model that forbid it."""
    for number, line in enumerate(_story(failed, 1)):
        if number == _MOST_LINES:
            yield "  ... and more of the like"
            return
        yield line


def as_data(failed: FailedFlaw) -> dict[str, Any]:
    """A failure for programs."""
    return {"flaw": flaw_words(failed.flaw), "choices": [_attempt_data(attempt) for attempt in failed.attempts]}


def flaw_words(flaw: Flaw) -> str:
    """What was to be mended."""
    if flaw.kind == OPEN_CONDITION:
        return f"`{flaw.name}` ({flaw.predicate}) is not in the plan yet"
    if flaw.kind == THREAT:
        return f"`{flaw.name}` is not ordered on its timeline yet"
    if flaw.kind == UNBOUND_VARIABLE:
        return f"`{flaw.name}` has no value yet"
    if flaw.kind == RESOURCE_THREAT:
        return _level_words(flaw)
    return "the model contradicts itself"


def _level_words(flaw: Flaw) -> str:
    """How far a resource may get out of bounds, and by whom: at most so much each."""
    level = flaw.level
    if level is None:
        return f"`{flaw.name}` might be used too much at {flaw.at}"
    users = ", ".join(f"{user.token} {user.amount:g}" for user in flaw.users)
    users = f": {users}" if users else ""
    if level.is_low and level.is_lent:
        used, room = level.first - level.level, level.first - level.limit
        return f"`{flaw.name}` might be used too much at {flaw.at}, {used:g} of {room:g} available{users}"
    way, side = ("fall", "least") if level.is_low else ("rise", "greatest")
    return (
        f"the level of `{flaw.name}` might {way} to {level.level:g} at {flaw.at}, its {side} is {level.limit:g}{users}"
    )


def resolver_words(resolver: Resolver) -> str:
    """What was tried."""
    names = resolver.names
    match resolver.kind:
        case ResolverKind.PROPAGATE:
            return "before any decision"
        case ResolverKind.MERGE:
            return f"merge it with `{names[0]}`"
        case ResolverKind.ACTIVATE:
            return "activate it"
        case ResolverKind.SUPPORT:
            return f"have `{names[0]}` bring it about, or activate it"
        case ResolverKind.REJECT:
            return "reject it"
        case ResolverKind.SPECIFY:
            return f"give it the value {names[0]}"
        case ResolverKind.INSERT_ONLY:
            return f"put it on `{names[0]}`"
        case ResolverKind.INSERT_BEFORE:
            return f"put it before `{names[1]}` on `{names[0]}`"
        case ResolverKind.INSERT_AFTER:
            return f"put it after `{names[1]}` on `{names[0]}`"
        case ResolverKind.PRECEDE:
            return f"put {names[0]} before {names[1]}"
        case _:
            assert_never(resolver.kind)


def _story(failed: FailedFlaw, depth: int) -> Iterator[str]:
    margin = "  " * depth
    while len(failed.attempts) == 1 and failed.attempts[0].dead_end is not None:
        yield f"{margin}{flaw_words(failed.flaw)}: {resolver_words(failed.attempts[0].resolver)}"
        failed = failed.attempts[0].dead_end
    yield f"{margin}{flaw_words(failed.flaw)}"
    if not failed.attempts:
        yield f"{margin}  there is nothing to choose from"
    for attempt in failed.attempts:
        yield f"{margin}  {resolver_words(attempt.resolver)}:"
        if attempt.dead_end is None:
            yield from (f"{margin}    {_cause_line(cause)}" for cause in attempt.causes)
        elif depth < _DEEPEST:
            yield from _story(attempt.dead_end, depth + 2)
        else:
            yield f"{margin}    ..."


def _cause_line(cause: FoundCause) -> str:
    """A cause with its source place, what is written there, and what it comes to."""
    if cause.span is None:
        return f"({cause.origin.value}) {words(cause.term)}"
    owner = f", for `{cause.owner}`" if cause.owner else ""
    text = " ".join(cause.span.text.split())
    written = f"`{text}`" if len(text) <= 60 else f"`{text[:57]}...`"
    return f"{cause.span.source.name}:{cause.span.line}: {written}{owner}: {words(cause.term)}"


def _attempt_data(attempt: Attempt) -> dict[str, Any]:
    lines = [
        {
            "file": cause.span.source.name if cause.span is not None else None,
            "line": cause.span.line if cause.span is not None else None,
            "token": cause.owner or None,
            "text": words(cause.term),
        }
        for cause in attempt.causes
    ]
    dead_end = None if attempt.dead_end is None else as_data(attempt.dead_end)
    return {"choice": resolver_words(attempt.resolver), "lines": lines, "because": dead_end}
