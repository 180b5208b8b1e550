"""Turns of a reactor in Python within a tick: what it says in, what it asks and takes back at once out."""

from typing import NamedTuple

from runtime.executive.trace import Trace
from runtime.user.log_player import is_done_by_others
from runtime.user.reactor import Asked, Now, Turn


class Said(NamedTuple):
    """What is asked and taken back at once, behind so many events of others in the tick; below 0: behind all."""

    others: int
    asked: list[Asked]
    recalled: list[int]


def turns_of(now: Now) -> list[Said]:
    """What a reactor asks and takes back in a tick; what it takes back at once was never asked."""
    if not now.asked and not now.recalled:
        return []
    if not now.turns:
        return [Said(-1, [one for one in now.asked if one.number not in now.recalled], now.recalled)]
    ends = [*now.turns[1:], Turn(0, len(now.asked), len(now.recalled))]
    return [
        Said(turn.others, now.asked[turn.asked : end.asked], now.recalled[turn.recalled : end.recalled])
        for turn, end in zip(now.turns, ends, strict=True)
    ]


def is_due(said: Said, trace: Trace, name: str) -> bool:
    """Whether others than the reactor of a name have done as much in this tick as was to come before."""
    count = 0
    for index in range(len(trace.events) - 1, -1, -1):
        event = trace.events[index]
        if event.tick < trace.tick or count >= said.others:
            break
        count += is_done_by_others(name, event.reactor, event.kind, event.phase)
    return count >= said.others
