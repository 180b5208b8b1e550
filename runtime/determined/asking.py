"""Ask a machine to start a token: a request, an observation, or a fact of the script."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from runtime.determined.machine import Machine
from runtime.determined.tags import (
    FAR,
    LEAST,
    MOST,
    NONE,
    OWN_LEAST,
    OWN_MOST,
    PREDICATE,
    SLOT,
    START,
    WISH,
    WISH_END_FROM,
    WISH_END_UNTIL,
    WISH_FROM,
    WISH_LEAST,
    WISH_MOST,
    WISH_PREDICATE,
    WISH_UNTIL,
)
from runtime.executive.messages import Request

Bounds = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Ask:
    """A token with given values on a timeline, and the bounds of its start, end and duration."""

    line: int
    block: int
    values: Mapping[int, float]
    start: Bounds
    end: Bounds
    duration: Bounds


def ask(machine: Machine, wanted: Ask) -> None:
    """Have a machine start a token as soon as it may."""
    state, n, line = machine.present.state, machine.lines, wanted.line
    state[WISH * n + line] = wanted.block
    state[WISH_PREDICATE * n + line] = machine.tables.block_predicate[wanted.block]
    state[WISH_FROM * n + line], state[WISH_UNTIL * n + line] = _bounds(wanted.start)
    state[WISH_END_FROM * n + line], state[WISH_END_UNTIL * n + line] = _bounds(wanted.end)
    state[WISH_LEAST * n + line], state[WISH_MOST * n + line] = _bounds(wanted.duration)
    if wanted.values:
        registers, first = machine.registers, machine.tables.wished[line]
        for k, value in wanted.values.items():
            registers[first + k] = value


def _bounds(given: Bounds) -> Bounds:
    return max(given[0], 0), min(given[1], FAR)


def ask_instead(machine: Machine, wanted: Sequence[Ask]) -> None:
    """Replace all requests that have not started."""
    state = machine.present.state
    for line in range(WISH * machine.lines, (WISH + 1) * machine.lines):
        state[line] = NONE
    for each in wanted:
        ask(machine, each)


def binds(machine: Machine, line: int, started: int, request: Request) -> bool:
    """Whether the token that began at `started` would end otherwise if it had not been asked for so (T-REX 1.9)."""
    state, n = machine.present.state, machine.lines
    if state[PREDICATE * n + line] < 0 or state[START * n + line] != started:
        return False
    slot, (shortest, longest), (earliest, latest) = state[SLOT * n + line], request.duration, request.end
    most, least = min(started + longest, latest), max(started + shortest, earliest)
    if most == state[MOST * n + slot] and most < state[OWN_MOST * n + line]:
        return True
    return bool(least == state[LEAST * n + slot] and least > max(state[OWN_LEAST * n + line], machine.present.now + 1))
