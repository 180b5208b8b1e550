"""Transaction logs of T-REX 2 in (`<reactor>.tr.log`, XML), the same events as in our traces out.

A log is of one reactor: what it provides and uses, and by tick what it published, asked for and took back. Logs of a
mission that crashed break off anywhere; what came before that counts.
"""

import re
from dataclasses import dataclass, field
from math import isfinite
from pathlib import Path
from typing import Any
from xml.parsers import expat

SUFFIX = ".tr.log"
_NUMBERS = ("int", "float")
_CUT_OFF = (
    expat.errors.codes[expat.errors.XML_ERROR_NO_ELEMENTS],
    expat.errors.codes[expat.errors.XML_ERROR_UNCLOSED_TOKEN],
    expat.errors.codes[expat.errors.XML_ERROR_PARTIAL_CHAR],
)
_COMMENT = re.compile(r"<!--.*?(-->|\Z)", re.DOTALL)
_TIMES = ("start", "end", "duration")
_MOST_DECIMALS = 6  # floats with more are written in full


class TransactionLogError(ValueError):
    """The text is no transaction log; the message names the line."""


@dataclass(frozen=True, slots=True)
class TransactionLog:
    """What one reactor did. `events` are as in a trace, `last_tick` is that of the last tick on record.

    `has_all_ticks`: also of ticks at which nothing happened, so that the log ends when the mission did.

    `step` is what one unit of the last decimal of its floats is worth, 0 where they are written in full: a float stands
    for all values that are rounded to it. `failed` is the tick at which T-REX ended the reactor.
    """

    reactor: str
    provided: tuple[str, ...]
    used: tuple[str, ...]
    events: tuple[dict[str, Any], ...]
    last_tick: int
    step: float
    failed: int | None
    is_whole: bool
    has_all_ticks: bool


def read_transaction_log(path: Path) -> TransactionLog:
    """Read a log; raises OSError, or TransactionLogError where it is none."""
    return parse_transaction_log(path.read_text(encoding="utf-8", errors="replace"), path.name.removesuffix(SUFFIX))


def parse_transaction_log(text: str, reactor: str) -> TransactionLog:
    """Read the text of the log of a reactor."""
    reader = _Reader(reactor)
    # T-REX writes messages as comments without a look at what is in them.
    plain = _COMMENT.sub(lambda found: "\n" * found.group().count("\n"), text)
    is_whole = True
    try:
        reader.parser.Parse(plain.encode(), True)
    except expat.ExpatError as problem:
        is_whole = False
        if problem.code not in _CUT_OFF or not reader.is_log:
            raise TransactionLogError(f"line {problem.lineno}: {expat.ErrorString(problem.code)}") from None
    if not reader.is_log:
        raise TransactionLogError("line 1: its root is no <Log>")
    return TransactionLog(
        reactor,
        tuple(dict.fromkeys(reader.provided)),
        tuple(dict.fromkeys(reader.used)),
        tuple(reader.events),
        reader.tick,
        0.0 if reader.decimals is None or reader.decimals > _MOST_DECIMALS else 10.0**-reader.decimals,
        reader.failed,
        is_whole,
        reader.has_work,
    )


@dataclass(slots=True)
class _Goal:
    """What is asked for, or observed, while it is read."""

    timeline: str
    predicate: str
    arguments: dict[str, Any] = field(default_factory=dict)
    variable: str = ""
    names: list[str] = field(default_factory=list)


class _Reader:
    """Takes elements as expat finds them."""

    def __init__(self, reactor: str) -> None:
        self.reactor = reactor
        self.is_log = False
        self.tick = 0
        self.provided: list[str] = []
        self.used: list[str] = []
        self.events: list[dict[str, Any]] = []
        self.failed: int | None = None
        self.has_work = False
        self.decimals: int | None = None
        self.goal: _Goal | None = None
        self.request = ""
        self.numbers: dict[str, int] = {}  # of requests, by the id that T-REX gave them: an address, so used again
        self.asked: dict[int, _Goal] = {}
        self.depth = 0
        self.parser = expat.ParserCreate("utf-8")
        self.parser.StartElementHandler = self._begin
        self.parser.EndElementHandler = self._end
        self.parser.EntityDeclHandler = self._refuse

    def _refuse(self, *_: object) -> None:
        raise TransactionLogError(f"line {self.parser.CurrentLineNumber}: entities have no place in a log")

    def _attribute(self, attributes: dict[str, str], name: str) -> str:
        if name not in attributes:
            raise TransactionLogError(f"line {self.parser.CurrentLineNumber}: an element without `{name}`")
        return attributes[name]

    def _begin(self, tag: str, attributes: dict[str, str]) -> None:
        self.depth += 1
        if self.depth == 1:
            self.is_log = tag == "Log"
        elif tag == "tick":
            self.tick = self._ticks(self._attribute(attributes, "value"))
        elif tag in ("provide", "use"):
            (self.provided if tag == "provide" else self.used).append(self._attribute(attributes, "name"))
        elif tag in ("request", "recall"):
            self.request = self._attribute(attributes, "id")
        elif tag in ("Observation", "Goal"):
            predicate = self._attribute(attributes, "pred").rpartition(".")[2]
            self.goal = _Goal(self._attribute(attributes, "on"), predicate)
        elif tag == "work":
            self.has_work = True
        elif tag == "failed":
            self.failed = self.tick
        elif self.goal is not None:
            self._describe(self.goal, tag, attributes)

    def _describe(self, goal: _Goal, tag: str, attributes: dict[str, str]) -> None:
        """A variable of a goal or an observation, or its domain."""
        if tag == "Variable":
            goal.variable, goal.names = self._attribute(attributes, "name"), []
        elif tag in _NUMBERS:
            low, high = (attributes.get(end, attributes.get("value")) for end in ("min", "max"))
            ends = [self._number(tag, end) for end in (low, high)]
            if ends != [None, None]:
                bounds = ["-inf" if ends[0] is None else ends[0], "inf" if ends[1] is None else ends[1]]
                goal.arguments[goal.variable] = ends[0] if ends[0] == ends[1] else bounds
        elif tag == "bool" and "value" in attributes:
            goal.arguments[goal.variable] = attributes["value"].strip().lower() in ("1", "true")
        elif "value" in attributes:  # names: <enum value="x"/>, or <elem value="x"/> in an <enum>
            goal.names.append(attributes["value"])
            goal.arguments[goal.variable] = goal.names[0] if len(goal.names) == 1 else list(goal.names)

    def _number(self, kind: str, text: str | None) -> int | float | None:
        """A bound; None where there is none."""
        try:
            value = float(text or "inf")
        except ValueError:
            raise TransactionLogError(f"line {self.parser.CurrentLineNumber}: `{text}` is no number") from None
        if not isfinite(value):
            return None
        if kind == "int":
            return int(value)
        decimals = len((text or "").rpartition(".")[2]) if "." in (text or "") else 0
        self.decimals = max(self.decimals or 0, decimals)
        return value

    def _ticks(self, text: str) -> int:
        try:
            return int(text)
        except ValueError:
            raise TransactionLogError(f"line {self.parser.CurrentLineNumber}: `{text}` is no tick") from None

    def _end(self, tag: str) -> None:
        self.depth -= 1
        if tag == "Observation" and self.goal is not None:
            self._note("observation", self.goal)
            self.goal = None
        elif tag == "request" and self.goal is not None:
            number = len(self.asked)
            self.numbers[self.request], self.asked[number] = number, self.goal
            times = {name: self.goal.arguments.pop(name, ["-inf", "inf"]) for name in _TIMES}
            spans = {name: span if isinstance(span, list) else [span, span] for name, span in times.items()}
            self._note("request", self.goal, request=number, **spans)
        elif tag == "recall" and self.request in self.numbers:
            number = self.numbers.pop(self.request)
            self._note("recall", self.asked[number], request=number)
        if tag in ("request", "recall", "token", "cancel"):
            self.goal, self.request = None, ""

    def _note(self, kind: str, goal: _Goal, **more: Any) -> None:
        event = {"tick": self.tick, "kind": kind, "reactor": self.reactor, "timeline": goal.timeline}
        self.events.append(event | {"predicate": goal.predicate, "arguments": dict(goal.arguments)} | more)
