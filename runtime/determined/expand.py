"""Expand what a determined reactor executed into the record of the mission, by carrying its inputs out once more.

In flight only inputs are kept. Here a fresh machine goes from event to event, and what the registers hold after each is
read: the locals and guards of a block stay in registers of its own until it runs again.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import inf

from compiler.determined.code import BlockToken
from compiler.determined.relations import FOLLOWING, MERGED, PREVIOUS
from compiler.program import PredicateCode
from runtime.determined.asking import Ask, PendingRequest, ask, ask_instead
from runtime.determined.loading import RegisterProgram
from runtime.determined.machine import Machine
from runtime.determined.reading import TokenReading, values
from runtime.determined.tags import FAR, LEAST, MOST, NONE, ROW, SLOT, WISHED
from runtime.executive.record import NOBODY, BodyRun, ReactorRecord, TokenRecord, Value, ValueRange


@dataclass(eq=False, slots=True)
class _Held:
    """A token under way: what is known of it when it starts; `shares` are the children that are merged into it."""

    key: int
    predicate: PredicateCode
    line: int
    start: int
    arguments: tuple[Value, ...]
    origin: str
    runs: tuple[BodyRun, ...] = ()
    shares: list[tuple[int, str]] = field(default_factory=list)


class _Expansion:
    """The tokens of one reactor; `see` is called after each tick that the machine has carried out."""

    def __init__(self, program: RegisterProgram, machine: Machine) -> None:
        self.program = program
        self.machine = machine
        self.tokens: list[TokenRecord] = []
        self.current: dict[int, _Held] = {}
        self.before: dict[int, _Held] = {}
        self.awaited: dict[int, tuple[int, PredicateCode]] = {}  # the key of what is to follow on a timeline
        self.newest = NOBODY
        self.row = 0
        self.registers: Sequence[float] = ()

    def see(self, tick: int, asked: dict[int, str]) -> None:
        """Read the tokens that have started at `tick`; `asked` tells the origin of what came from outside."""
        log = self.machine.log
        rows = range(self.row, log.row_count)
        self.row = log.row_count
        self.registers = memoryview(self.machine.registers)
        logged = memoryview(log.rows)
        banks = memoryview(self.machine.current)
        for row in rows:
            line, number = logged[ROW * row + 1], logged[ROW * row + 3]
            predicate = self.program.model.program.predicates[logged[ROW * row + 2]]
            followed = self.awaited.get(line)
            origin = "rule" if number < 0 else asked.get(line, "request") if number & WISHED else "own"
            key = self._new_key()
            if origin == "own" and followed is not None and followed[1] is predicate:
                key, origin = self.awaited.pop(line)[0], "rule"
            if line in self.current:
                self._close(self.current[line], tick, "over")
                self.before[line] = self.current[line]
            arguments = self._arguments(predicate, banks[line])
            self.current[line] = _Held(key, predicate, line, tick, arguments, origin)
        for row in rows:
            number = logged[ROW * row + 3]
            if number >= 0:
                self._read(self.program.readings(number & (WISHED - 1)))

    def _read(self, readings: tuple[TokenReading, ...]) -> None:
        """The children and runs of all tokens of a block."""
        registers, names = self.registers, self.program.name_of
        held: list[TokenReading] = []
        children: dict[tuple[int, int, int], int] = {}
        for reading in readings:
            token = reading.token
            if token.context and not all((registers[k] != 0.0) == truth for k, truth in token.context):
                continue
            children[token.parent, token.rule, token.slot] = self._key(token)
            if reading.bodies:
                held.append(reading)
        for reading in held:
            runs = [body.run(registers, children, names) for body in reading.bodies]
            self.current[reading.token.line].runs = tuple(runs)

    def _key(self, token: BlockToken) -> int:
        """The key of a token that a block knows; children that hold already are merged, followers are awaited."""
        if token.how in (MERGED, PREVIOUS):
            key = self._new_key()
            into = (self.current if token.how == MERGED else self.before)[token.line]
            into.shares.append((key, token.predicate.name))
            if token.how == PREVIOUS:
                self._close_shares(into, self.current[token.line].start)
            return key
        if token.how == FOLLOWING:
            self.awaited[token.line] = (self._new_key(), token.predicate)
            return self.awaited[token.line][0]
        return self.current[token.line].key

    def _arguments(self, predicate: PredicateCode, first: int) -> tuple[Value, ...]:
        where = tuple([(first + k, each.type.kind) for k, each in enumerate(predicate.parameters)])
        return values(self.registers, where, self.program.name_of)

    def _new_key(self) -> int:
        self.newest += 1
        return self.newest

    # ---- the ends ----

    def _close(self, held: _Held, end: int, fate: str) -> None:
        """Record a token that ended at a tick, with what is merged into it."""
        self.tokens.append(self._record(held, end, end - held.start, fate, end))
        self._close_shares(held, end)

    def _close_shares(self, held: _Held, tick: int) -> None:
        line = self.program.model.lines[held.line].name
        end: Value = tick
        for key, name in held.shares:
            self.tokens.append(
                TokenRecord(
                    key,
                    name,
                    line,
                    "merged",
                    tick - held.start,
                    held.start,
                    end,
                    held.arguments,
                    held.key,
                    "rule",
                    "over",
                    tick,
                    (),
                )
            )
        held.shares.clear()

    def _record(self, held: _Held, end: Value, duration: Value, fate: str, tick: int) -> TokenRecord:
        line = self.program.model.lines[held.line].name
        return TokenRecord(
            held.key,
            held.predicate.name,
            line,
            "active",
            duration,
            held.start,
            end,
            held.arguments,
            NOBODY,
            held.origin,
            fate,
            tick,
            held.runs,
        )

    def finish(self, tick: int) -> tuple[TokenRecord, ...]:
        """What still holds when the mission ends, its end as far as it is known; and what was still to follow."""
        present, n = self.machine.present, self.machine.lines
        for line, held in sorted(self.current.items()):
            slot = int(present.state[SLOT * n + line])
            least, most = int(present.state[LEAST * n + slot]), int(present.state[MOST * n + slot])
            end: Value = least if least == most else ValueRange(least, inf if most >= FAR else most)
            lasting: Value = least - held.start
            if isinstance(end, ValueRange):
                lasting = ValueRange(end.lower - held.start, end.upper - held.start)
            self.tokens.append(self._record(held, end, lasting, "end", tick))
            name = self.program.model.lines[line].name
            for key, shared in held.shares:
                self.tokens.append(
                    TokenRecord(
                        key,
                        shared,
                        name,
                        "merged",
                        lasting,
                        held.start,
                        end,
                        held.arguments,
                        held.key,
                        "rule",
                        "end",
                        tick,
                        (),
                    )
                )
        for line, (key, predicate) in sorted(self.awaited.items()):
            name = self.program.model.lines[line].name
            arguments = self._arguments(predicate, self.machine.following[line])
            later, lasting = ValueRange(tick + 1, inf), ValueRange(1, inf)
            self.tokens.append(
                TokenRecord(
                    key,
                    predicate.name,
                    name,
                    "inactive",
                    lasting,
                    later,
                    later,
                    arguments,
                    NOBODY,
                    "rule",
                    "end",
                    tick,
                    (),
                )
            )
        return tuple(sorted(self.tokens))


def expand(
    program: RegisterProgram, machine: Machine, asked: Sequence[PendingRequest], reach: int, until: int
) -> tuple[TokenRecord, ...]:
    """Carry out once more, on a fresh machine, what was asked up to tick `until`; all tokens, by key."""
    machine.present.reach = reach
    for fact in program.first:
        ask(machine, Ask(fact.line, fact.block, fact.values, (0, 0), fact.end, (1, FAR), "fact"))
    expansion = _Expansion(program, machine)
    origins = dict.fromkeys((fact.line for fact in program.first), "fact")
    waiting = list(asked)
    tick = NONE
    while tick < until:
        due = max(min([machine.present.next_event(tick), until, *(each.tick for each in waiting[:1])]), tick + 1)
        while waiting and waiting[0].tick == due and waiting[0].is_observed:
            observed = waiting.pop(0)
            ask_instead(machine, observed)
            origins |= {each.line: each.origin for each in observed.asks}
        if machine.present.next_event(due - 1) <= due and not machine.tick(due):
            break
        expansion.see(due, origins)
        origins = {line: origin for line, origin in origins.items() if origin == "observation"}
        while waiting and waiting[0].tick == due:
            ask_instead(machine, waiting.pop(0))
        tick = due
    return expansion.finish(until)


def record_of(frame: ReactorRecord, name: str, tokens: tuple[TokenRecord, ...], tick: int) -> ReactorRecord:
    """The record of a reactor; `frame` is that of its script, whose facts are found again by their timelines."""
    facts = {str(token.object): token.key for token in tokens if token.origin == "fact"}
    lines = {token.key: str(token.object) for token in frame.tokens}
    script = tuple(facts.get(lines.get(key, ""), NOBODY) for key in frame.script_tokens)
    return frame._replace(reactor=name, last_tick=tick, script_tokens=script, tokens=tokens)
