"""The record of a mission: every token that was in a plan, with its times, arguments and runs of rules, as plain data.

A token is recorded when it leaves the plan (archived, or taken away by a repair), the others when the mission ends.
The record stands by itself: names, keys and values, no engine ids; it is what a judge needs beside the programs.
"""

from collections.abc import Sequence
from typing import NamedTuple


class ValueRange(NamedTuple):
    """A number that was never fixed: both ends included, infinite ends are `inf`."""

    lower: float
    upper: float


class OpenValues(NamedTuple):
    """One of several values, never decided."""

    values: tuple[float | int | bool | str, ...]


Value = float | int | bool | str | ValueRange | OpenValues


class GuardRun(NamedTuple):
    """A guard that was reached: `branch` is waiting, then or else; `is_decided` tells whether its inputs are given.

    `run` is what the branch did, None while the guard waits or where the branch is empty.
    """

    branch: str
    is_decided: bool
    run: "BodyRun | None"


class BodyRun(NamedTuple):
    """One run of a rule's body or of a branch, in the order of execution: named locals, children (keys), guards."""

    rule: int  # index into Program.rules
    locals: tuple[Value, ...]
    children: tuple[int, ...]
    guards: tuple[GuardRun, ...]


class TokenRecord(NamedTuple):
    """One token. `key` never names another token of the same reactor; NOBODY stands for none.

    `predicate` is `Class.predicate`, `object` the timeline's name. `state` is active, merged, inactive or rejected.
    `origin` is observation, request, goal or fact (of the script), rule (a child) or own (chosen by the executive).
    `fate` is over (archived), end (in the plan when the mission ended) or cut (taken away by a repair or a recall);
    `tick` is when it was recorded.
    """

    key: int
    predicate: str
    object: Value
    state: str
    duration: Value
    start: Value
    end: Value
    arguments: tuple[Value, ...]
    merged_into: int
    origin: str
    fate: str
    tick: int
    runs: tuple[BodyRun, ...]


class ObjectRecord(NamedTuple):
    """An object of the model, by name, and the values of its members in the order of the class."""

    name: str
    class_name: str
    members: tuple[Value, ...]


class ReactorRecord(NamedTuple):
    """What one reactor's plan held over the mission; `script_tokens` are the keys of the script's tokens by slot."""

    reactor: str
    last_tick: int  # at which its plan last agreed with the present
    globals: tuple[Value, ...]
    objects: tuple[ObjectRecord, ...]
    script_tokens: tuple[int, ...]
    tokens: Sequence[TokenRecord]


class MissionRecord(NamedTuple):
    """The records of all reactors, in the order of the configuration."""

    reactors: tuple[ReactorRecord, ...]


NOBODY = -1
