"""Publish what a machine has carried out: its log in, events of the trace and observations for users out."""

from collections.abc import Sequence
from dataclasses import dataclass

from runtime.determined.arguments import arguments_of
from runtime.determined.loading import RegisterProgram
from runtime.determined.log import Log
from runtime.determined.tags import ROW, WISHED
from runtime.executive.messages import Observation, Request
from runtime.executive.outcome import Draw, EventKind, Phase
from runtime.executive.trace import Trace
from runtime.plan.readout.names import TokenName

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


class Publisher:
    """Tells the log of one reactor, each row once."""

    def __init__(self, name: str, program: RegisterProgram, trace: Trace) -> None:
        self.name = name
        self.program = program
        self.trace = trace
        self.told = 0  # the tick up to which the log has been told
        self.row = 0
        self.draw_row = 0
        self.events = [_NOTHING] * len(program.layout.lines)  # the latest event of each timeline
        self.draws: dict[tuple[int, int], Draw] = {}
        self.wishes: list[Wish] = []
        self.asked: dict[int, Wish] = {}  # what the machine is to start on each timeline

    def tell(self, log: Log, until: int) -> list[Observation]:
        """Put on record what has started up to tick `until`; the observations of that very tick."""
        trace = self.trace
        now, phase = trace.tick, trace.phase
        published: list[Observation] = []
        logged, values = memoryview(log.rows), memoryview(log.values)
        while self.row < log.row_count and logged[ROW * self.row] <= until:
            tick = logged[ROW * self.row]
            last = self.row
            while last < log.row_count and logged[ROW * last] == tick:
                last += 1
            trace.tick, trace.phase = tick, Phase.SYNCHRONISE
            self._tell_draws(log, tick)
            rows = {logged[ROW * row + 1]: row for row in range(self.row, last)}
            self._tell_achieved(rows, tick)
            trace.phase = Phase.OBSERVE
            found = [
                self._observe(logged, values, line, rows[line], tick) for line in self.program.internal if line in rows
            ]
            if tick == until:
                published = found
            self.row = last
        trace.tick, trace.phase = now, phase
        return published

    def go_back(self, log: Log) -> None:
        """After the log was shortened: what was told stays told, for it will come again."""
        self.row = min(self.row, log.row_count)
        self.draw_row = min(self.draw_row, log.draw_count)

    def _tell_draws(self, log: Log, tick: int) -> None:
        while self.draw_row < log.draw_count and log.draws[2 * self.draw_row] <= tick:
            at, parameter = log.draws[2 * self.draw_row : 2 * self.draw_row + 2]
            self.trace.record_draw(self.name, self.draws[int(parameter), int(at)])
            self.draw_row += 1

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

    def _observe(self, logged: Sequence[int], values: Sequence[float], line: int, row: int, tick: int) -> Observation:
        program = self.program
        predicate = program.model.program.predicates[logged[ROW * row + 2]]
        first = logged[ROW * row + 4]
        arguments = arguments_of(program, predicate, values[first : first + len(predicate.parameters)])
        short = predicate.name.rpartition(".")[2]
        wish = self._answered(line, logged[ROW * row + 3], tick)
        last = self.events[line]
        causes = (wish.request.event,) if wish is not None else (last,) if last >= 0 else ()
        name = program.model.lines[line].name
        event = self.trace.record(
            EventKind.OBSERVATION, self.name, name, short, arguments, causes, token=TokenName(predicate.name, row)
        )
        self.events[line] = event
        return Observation(tick, name, short, arguments, event, self.name, row, tick)

    def _answered(self, line: int, block: int, tick: int) -> Wish | None:
        """The request that a token answers."""
        wish = self.asked.get(line)
        if wish is None or block != wish.block | WISHED:
            return None
        wish.started = tick
        return self.asked.pop(line)
