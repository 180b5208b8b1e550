"""Executed tokens of a determined reactor: its log in, columns for the record out, expanded to tokens when read."""

from collections.abc import Iterable, Iterator
from math import inf

import numpy as np

from compiler.program import PredicateCode
from runtime.determined.loading import RegisterProgram
from runtime.determined.machine import Machine
from runtime.determined.reading import Named, run_of, values
from runtime.determined.tags import BLOCK, FAR, FOLLOWER, LEAST, MOST, ROW, SHOWN, SLOT, WISHED
from runtime.determined.token_columns import WalkColumns
from runtime.determined.token_walk import TokenWalk
from runtime.executive.columns import (
    ORIGINS,
    Array,
    RunColumns,
    TokenColumns,
    TokenGroup,
    TokenTimes,
)
from runtime.executive.record import NOBODY, BodyRun, ReactorRecord, TokenRecord, Value, ValueRange


class _Expansion:
    """The log of one reactor up to a tick, walked over: its rows, then what was merged, then what is awaited."""

    def __init__(self, program: RegisterProgram, machine: Machine, tick: int) -> None:
        self.program = program
        self.machine = machine
        self.tick = tick
        self.walk = TokenWalk(machine.log, program.tokens, machine.lines, _rows_until(machine, tick))
        for fact in program.first:
            self.walk.is_fact[fact.line] = 1
        for line in range(machine.lines):
            self.walk.is_used[line] = machine.present.is_used[line]
        self.walk.run()
        self.rows = np.asarray(machine.log.rows)[: ROW * self.walk.count].reshape(-1, ROW)
        self.values = np.asarray(machine.log.values)
        self.keys = np.asarray(self.walk.keys)[: self.walk.count]
        self.merged = np.asarray(self.walk.merged)[: 3 * self.walk.merged_count].reshape(-1, 3)
        self.found = WalkColumns(self.walk)
        self.indices = np.asarray(self.found.index_of)[: self.walk.count]  # of rows
        self.order = np.asarray(self.found.order)  # the row of each index
        self.all_keys = np.asarray(self.found.keys)[: self.found.count]
        self._slots: Array | None = None
        self._where: dict[str, Named] = {}  # by predicate: its parameters

    @property
    def slots(self) -> Array:
        """Where each row stands among the tokens of the blocks that were run."""
        if self._slots is None:
            self._slots = np.full(self.walk.count, -1)
            rows = np.asarray(self.walk.child_rows)
            slots = np.flatnonzero(rows >= 0)
            self._slots[rows[slots]] = slots
        return self._slots

    # ---- times ----

    def columns(self) -> TokenColumns:
        """All tokens, as they are read from what is noted here."""
        program = self.program
        predicates = program.model.program.predicates
        names = [each.name for each in predicates] + [each.name for each in program.model.lines]
        kinds = [tuple([parameter.type.kind for parameter in each.parameters]) for each in predicates]
        return TokenColumns(self.times(), names, kinds, self.values, program.all_names(), self.groups, self.token)

    def times(self) -> TokenTimes:
        """What all tokens have."""
        found = self.found
        for line in range(self.machine.lines):
            found.least[line], found.most[line] = self._bounds(line)
        found.fill(self.tick)
        shift = len(self.program.model.program.predicates)  # names of timelines come behind those of predicates

        def told(column: Iterable[float]) -> Array:
            return np.asarray(column)[: found.count]

        return TokenTimes(
            self.all_keys,
            told(found.predicates),
            told(found.objects) + shift,
            told(found.states),
            told(found.starts),
            told(found.ends),
            told(found.latest),
            told(found.merged_into),
            told(found.origins),
            told(found.is_over).view(bool),
            told(found.ticks),
            told(found.values),
        )

    def _bounds(self, line: int) -> tuple[int, int]:
        """The bounds of the end of what holds on a timeline when the mission ends."""
        present, n = self.machine.present, self.machine.lines
        slot = int(present.state[SLOT * n + line])
        return int(present.state[LEAST * n + slot]), int(present.state[MOST * n + slot])

    # ---- single tokens ----

    def token(self, index: int) -> TokenRecord:
        """One token of the record."""
        row, count = int(self.order[index]), self.walk.count
        if row < count:
            return self._started(row)
        if row < count + len(self.merged):
            return self._merged(row - count)
        return self._awaited(row - count - len(self.merged))

    def _started(self, row: int) -> TokenRecord:
        start, line, predicate, _, first = self.rows[row, :5].tolist()
        code = self.program.model.program.predicates[predicate]
        end, duration, fate, tick = self._end(row, start)
        return TokenRecord(
            int(self.keys[row]),
            code.name,
            self.program.model.lines[line].name,
            "active",
            duration,
            start,
            end,
            self._arguments(code, first),
            NOBODY,
            ORIGINS[self.walk.origins[row]],
            fate,
            tick,
            self._runs(row),
        )

    def _end(self, row: int, start: int) -> tuple[Value, Value, str, int]:
        """End and duration of a token, as far as they are known; its fate, and when it was recorded."""
        end = int(self.walk.ends[row])
        if end < FAR:
            return end, end - start, "over", end
        least, most = self._bounds(int(self.rows[row, 1]))
        if least == most:
            return least, least - start, "end", self.tick
        latest = inf if most >= FAR else most
        return ValueRange(least, latest), ValueRange(least - start, latest - start), "end", self.tick

    def _arguments(self, code: PredicateCode, first: int) -> tuple[Value, ...]:
        where = self._where.get(code.name)
        if where is None:
            where = self._where[code.name] = tuple([(k, each.type.kind) for k, each in enumerate(code.parameters)])
        return values(self.machine.log.values_from(first, len(where)), where, self.program.name_of)

    def _runs(self, row: int) -> tuple[BodyRun, ...]:
        program = self.program
        root, number = self._block_of(row)
        logged = self.rows[root].tolist()
        block = logged[BLOCK] & (WISHED - 1)
        outlines = program.outlines[block][number]
        if not outlines:
            return ()
        width = program.shown_first[block + 1] - program.shown_first[block]
        shown = self.machine.log.values_from(logged[SHOWN], width)
        base = self.walk.children[root]
        return tuple([run_of(each, shown, self.walk.child_keys, base, program.name_of) for each in outlines])

    def _block_of(self, row: int) -> tuple[int, int]:
        """The row that began a token's block, and the number of the token there."""
        block = int(self.rows[row, 3])
        root = row if block >= 0 else -1 - block
        return root, int(self.slots[row]) - int(self.walk.children[root])

    def _merged(self, number: int) -> TokenRecord:
        key, token, row = self.merged[number].tolist()
        start, line, predicate, _, first = self.rows[row, :5].tolist()
        end, duration, fate, tick = self._end(row, start)
        codes = self.program.model.program.predicates
        return TokenRecord(
            key,
            codes[self.program.tokens.predicate[token]].name,
            self.program.model.lines[line].name,
            "merged",
            duration,
            start,
            end,
            self._arguments(codes[predicate], first),
            int(self.keys[row]),
            "rule",
            fate,
            tick,
            (),
        )

    def _awaited(self, line: int) -> TokenRecord:
        """What was still to follow when the mission ended."""
        code = self.program.model.program.predicates[self.walk.follower[line]]
        later = ValueRange(self.tick + 1, inf)
        first = self.program.tables.following[line]
        where = tuple([(first + k, each.type.kind) for k, each in enumerate(code.parameters)])
        return TokenRecord(
            int(self.walk.awaited[line]),
            code.name,
            self.program.model.lines[line].name,
            "inactive",
            self._lasting(line, first),
            later,
            later,
            values(memoryview(self.machine.registers), where, self.program.name_of),
            NOBODY,
            "rule",
            "end",
            self.tick,
            (),
        )

    def _lasting(self, line: int, first: int) -> Value:
        """How long what was still to follow would have lasted, where the token before it says so."""
        layout, present = self.program.layout, self.machine.present
        block = int(present.state[FOLLOWER * self.machine.lines + line])
        last = layout.widths[line] - 1
        if not layout.tells_lengths or block < 0 or not self.program.tables.block_mask[block] >> last & 1:
            return ValueRange(1, inf)
        return values(memoryview(self.machine.registers), ((first + last, "int"),), self.program.name_of)[0]

    # ---- tokens that are alike ----

    def groups(self) -> tuple[TokenGroup, ...]:
        """All tokens that have begun, by the block that began them."""
        roots = np.flatnonzero(np.asarray(self.walk.children)[: self.walk.count] >= 0)
        blocks = self.rows[:, 3].take(roots) & (WISHED - 1)
        found: list[TokenGroup] = []
        for block in np.flatnonzero(np.bincount(blocks)).tolist():
            found += self._groups_of(block, roots[blocks == block])
        return tuple(found)

    def _groups_of(self, block: int, roots: Array) -> Iterator[TokenGroup]:
        """The tokens of one block."""
        first, shown = np.asarray(self.walk.children).take(roots), self.rows[:, SHOWN].take(roots)
        started, keys = np.asarray(self.walk.child_rows), np.asarray(self.walk.child_keys)
        for reading, bodies in zip(self.program.readings(block), self.program.outlines[block], strict=True):
            rows = started.take(first + reading.number)
            of_first, of_shown = first, shown
            if len(rows) and rows.min() < 0:
                begun = np.flatnonzero(rows >= 0)
                rows, of_first, of_shown = rows.take(begun), first.take(begun), shown.take(begun)
            if len(rows):
                yield TokenGroup(
                    reading.token.predicate.name,
                    self.program.model.lines[reading.token.line].name,
                    self.indices.take(rows),
                    tuple([RunColumns(each, self.values, of_shown, keys, of_first) for each in bodies]),
                )


def _rows_until(machine: Machine, tick: int) -> int:
    """How many rows of the log there are up to a tick."""
    count = int(machine.log.row_count)
    while count and machine.log.rows[ROW * (count - 1)] > tick:
        count -= 1
    return count


def expand(program: RegisterProgram, machine: Machine, tick: int) -> TokenColumns:
    """The tokens that a machine has executed up to `tick`, where it stands."""
    return _Expansion(program, machine, tick).columns()


def record_of(frame: ReactorRecord, name: str, tokens: TokenColumns, tick: int) -> ReactorRecord:
    """The record of a reactor; `frame` is that of its script, whose facts are found again by their timelines."""
    fact = ORIGINS.index("fact")
    found = np.flatnonzero(tokens.times.origins == fact).tolist()
    facts = {tokens.names[tokens.times.objects[index]]: int(tokens.times.keys[index]) for index in found}
    lines = {token.key: str(token.object) for token in frame.tokens}
    script = tuple(facts.get(lines.get(key, ""), NOBODY) for key in frame.script_tokens)
    return frame._replace(reactor=name, last_tick=tick, script_tokens=script, tokens=tokens)
