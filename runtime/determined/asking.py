"""Ask a machine to start a token: a request, an observation, or a fact of the script."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from runtime.determined.machine import Machine
from runtime.determined.tags import (
    FAR,
    NONE,
    WISH,
    WISH_END_FROM,
    WISH_END_UNTIL,
    WISH_FROM,
    WISH_LEAST,
    WISH_MOST,
    WISH_UNTIL,
)

Bounds = tuple[int, int]
_SECTIONS = ((WISH_FROM, WISH_UNTIL), (WISH_END_FROM, WISH_END_UNTIL), (WISH_LEAST, WISH_MOST))


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
    for (first, last), (lower, upper) in zip(_SECTIONS, (wanted.start, wanted.end, wanted.duration), strict=True):
        state[first * n + line] = max(lower, 0)
        state[last * n + line] = min(upper, FAR)
    for k, value in wanted.values.items():
        machine.registers[machine.wished[line] + k] = value


def ask_instead(machine: Machine, wanted: Sequence[Ask]) -> None:
    """Replace all requests that have not started."""
    for line in range(machine.lines):
        machine.present.state[WISH * machine.lines + line] = NONE
    for each in wanted:
        ask(machine, each)
