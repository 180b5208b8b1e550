"""Publish what a machine has carried out: its log in, events of the trace and observations for users out."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from runtime.determined.arguments import arguments_at, shapes_of, values_at
from runtime.determined.loading import ParameterShape, RegisterProgram
from runtime.determined.log import Log
from runtime.determined.machine import Machine
from runtime.determined.tags import BLOCK, EVENT, FAR, KIND, LINE, ROW, VALUES, WISHED
from runtime.determined.told import Told
from runtime.executive.messages import Arguments, Observation, Request, make_observation
from runtime.executive.outcome import Draw, EventKind, Phase
from runtime.executive.trace import Trace

_NOTHING = -1


@dataclass(eq=False, slots=True)
class Wish:
    """A request under way; `started` and `ended` are the ticks of its token, as far as they are known."""

    request: Request
    line: int
    block: int
    values: dict[int, float]
    started: int = _NOTHING
    ended: int = _NOTHING
    is_recalled: bool = False


class Samples:
    """What a machine draws."""

    def __init__(self, parameters: list[str], drawn: Callable[[str, int], tuple[Draw, int] | None]) -> None:
        self.parameters = parameters
        self.drawn = drawn
        self.draws: dict[tuple[int, int], Draw] = {}

    def draw(self, machine: Machine, parameter: int, tick: int) -> bool:
        """Give a machine the value of a parameter that is in force at `tick`; false if the mission has none."""
        found = self.drawn(self.parameters[parameter], tick)
        if found is None:
            return False
        draw, until = found
        machine.sample_value[parameter] = draw.value
        machine.sample_until[parameter] = min(until, FAR)
        self.draws[parameter, tick] = draw
        machine.log.note_draw(tick, parameter)
        return True


def row_key(tick: int) -> int:
    """The key under which a row of the log, begun at `tick`, is published: no token of a general reactor has it."""
    return -2 - tick


class Publisher:
    """Tells the log of one reactor, each row once."""

    def __init__(self, name: str, program: RegisterProgram, log: Log, samples: Samples, trace: Trace) -> None:
        self.name = name
        self.program = program
        self.log = log
        self.samples = samples
        self.trace = trace
        self.columns = Told(name, program, log)
        self.line_names = [line.name for line in program.model.lines]
        self.short_names = list(program.model.short_names)
        self.names, self.symbols = program.names, program.layout.symbols
        self.shapes: list[list[ParameterShape] | None] = [None] * len(self.short_names)  # by predicate
        for k, line in enumerate(program.internal):
            log.order[k] = line
        log.shown = len(program.internal)
        self.wishes: list[Wish] = []
        self.asked: dict[int, Wish] = {}  # what the machine is to start on each timeline
        self.busy = 0  # timelines on which something is asked for or under way

    def tell(self, until: int, watched: int) -> list[Observation]:
        """Put on record what has started up to tick `until`; the observations of that very tick, if `watched`."""
        log, trace = self.log, self.trace
        while log.next_tick() <= until:
            first = log.told_count
            count = log.tell(until, self.busy, trace.events.length)
            if count:
                trace.events.extend(self.columns, first, count)
            if log.next_tick() <= until:
                self._tell_tick(log.next_tick())
        return self._seen(until, watched) if watched else []

    def look(self) -> None:
        """Take note of which timelines have requests."""
        self.busy = 0
        for wish in self.wishes:
            if wish.ended < 0 and (wish.started >= 0 or not wish.is_recalled):
                self.busy |= 1 << wish.line
        for line in self.asked:
            self.busy |= 1 << line

    def _seen(self, tick: int, watched: int) -> list[Observation]:
        """What has started at a tick, the last that was told, on timelines that somebody uses."""
        found: list[Observation] = []
        log = self.log
        index = log.told_count - 1
        while index >= 0 and log.rows[ROW * log.told[index]] == tick:
            if watched >> log.rows[ROW * log.told[index] + LINE] & 1:
                found.append(self._observation(log.told[index]))
            index -= 1
        found.reverse()
        return found

    def _observation(self, row: int) -> Observation:
        log, at = self.log, ROW * row
        name, short, tick = self.line_names[log.rows[at + LINE]], self.short_names[log.rows[at + KIND]], log.rows[at]
        return make_observation(tick, name, short, self, log.rows[at + EVENT], self.name, row, row_key(tick))

    def shapes_of(self, token: int) -> list[ParameterShape]:
        """The parameters of the predicate of a row."""
        predicate = self.log.rows[ROW * token + KIND]
        shapes = self.shapes[predicate]
        if shapes is None:
            shapes = self.shapes[predicate] = shapes_of(self.program, self.program.model.program.predicates[predicate])
        return shapes

    def arguments_of(self, token: int) -> Arguments:
        """The arguments of a row."""
        self._name_all()
        return arguments_at(self.shapes_of(token), self.names, self.log, self.log.rows[ROW * token + VALUES])

    def values_of(self, token: int) -> list[Any]:
        """The values of the arguments of a row."""
        self._name_all()
        return values_at(self.shapes_of(token), self.names, self.log, self.log.rows[ROW * token + VALUES])

    def _name_all(self) -> None:
        """Bring the names that numbers stand for up to date."""
        if len(self.names) < len(self.symbols):
            self.program.all_names()

    def _tell_tick(self, tick: int) -> None:
        """Put a tick on record in which something was drawn, or something that was asked for begins or ends."""
        log, trace = self.log, self.trace
        now, phase = trace.tick, trace.phase
        trace.tick, trace.phase = tick, Phase.SYNCHRONISE
        self._tell_draws(tick)
        rows: dict[int, int] = {}
        while log.told_rows < log.row_count and log.rows[ROW * log.told_rows] == tick:
            rows[log.rows[ROW * log.told_rows + LINE]] = log.told_rows
            log.told_rows += 1
        self._tell_achieved(rows, tick)
        for line in self.program.internal:
            if line in rows:
                row = rows[line]
                wish = self._answered(line, log.rows[ROW * row + BLOCK], tick)
                cause = wish.request.event if wish is not None else log.latest[line]
                log.tell_row(row, len(trace.events), cause)
                trace.events.extend(self.columns, log.told_count - 1, 1)
        self.look()
        trace.tick, trace.phase = now, phase

    def _tell_draws(self, tick: int) -> None:
        log = self.log
        while log.told_draws < log.draw_count and log.draws[2 * log.told_draws] <= tick:
            at = 2 * log.told_draws
            self.trace.record_draw(self.name, self.samples.draws[int(log.draws[at + 1]), int(log.draws[at])])
            log.told_draws += 1

    def _tell_achieved(self, rows: dict[int, int], tick: int) -> None:
        """What was asked for is done as soon as something else holds."""
        for wish in self.wishes:
            if wish.line in rows and 0 <= wish.started < tick and wish.ended < 0:
                wish.ended = tick
                request = wish.request
                if not wish.is_recalled:
                    self.trace.record(
                        EventKind.ACHIEVED,
                        self.name,
                        request.timeline,
                        request.predicate,
                        request.arguments,
                        (request.event,),
                        request=request.number,
                    )

    def _answered(self, line: int, block: int, tick: int) -> Wish | None:
        """The request that a token answers."""
        wish = self.asked.get(line)
        if wish is None or block != wish.block | WISHED:
            return None
        wish.started = tick
        return self.asked.pop(line)
