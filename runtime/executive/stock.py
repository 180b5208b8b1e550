"""Stock: reactors loaded once per process, handed out again and again as they were when loaded."""

from collections.abc import Callable
from dataclasses import dataclass
from types import TracebackType

from compiler.program import Program
from runtime.constraints.domains.arrays import Growth, note_growth
from runtime.executive.configuration import AgentConfiguration, ReactorConfiguration
from runtime.executive.loaded_state import LoadedState
from runtime.executive.planning import Planner
from runtime.executive.workbench import Workbench
from runtime.plan.database import Environment
from runtime.solver.configuration.configuration import Configuration
from runtime.user.constraint import Constraint

_MOST = 16  # kinds of reactors in stock
Parts = tuple[Program, Configuration, tuple[Constraint, ...]]
Key = tuple[int, int, int, ReactorConfiguration, float, int]


@dataclass(eq=False, slots=True)
class Stocked:
    """A plan database after its script, and its planner; `snapshot` is how they were then."""

    bench: Workbench
    planner: Planner
    snapshot: LoadedState | None


@dataclass(eq=False, slots=True)
class _Shelf:
    """What is idle of one kind; `parts` are kept, for the key names them by their identity."""

    parts: Parts
    idle: list[Stocked]


SHELVES: dict[Key, _Shelf] = {}


class Loans:
    """The reactors that one mission has borrowed; at its end they go back, unless it was broken off."""

    def __init__(self) -> None:
        self._borrowed: list[tuple[_Shelf, Stocked]] = []
        self._growth: list[Growth] = []
        self._outer: list[Growth] | None = None

    def __enter__(self) -> "Loans":
        self._outer = note_growth(self._growth)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: object, trace: TracebackType | None) -> None:
        note_growth(self._outer)
        if self._outer is not None:
            self._outer += self._growth
        if kind is None:
            for shelf, loaded in self._borrowed:
                assert loaded.snapshot is not None
                loaded.snapshot.restore(self._growth)
                loaded.bench.database.environment = None  # nothing of the mission stays
                shelf.idle.append(loaded)
        self._borrowed.clear()
        self._growth.clear()

    def borrow(
        self,
        configuration: AgentConfiguration,
        number: int,
        parts: Parts,
        draw: Environment,
        make: Callable[[Environment], tuple[Workbench, Planner]],
    ) -> Stocked:
        """Reactor `number` as it was loaded; `make` loads it, `draw` is the environment of its database.

        A script that draws is run in each mission; a reactor that is loaded for the first time may be the last.
        """
        each = configuration.reactors[number]
        program, solver, constraints = parts
        key = (id(program), id(solver), id(constraints), each, configuration.tick, configuration.final_tick)
        shelf = SHELVES.get(key)
        if shelf is None:
            while len(SHELVES) >= _MOST:
                SHELVES.pop(next(iter(SHELVES)))
            SHELVES[key] = _Shelf(parts, [])
            return Stocked(*make(draw), None)
        if shelf.idle:
            loaded = shelf.idle.pop()
        else:
            asked: list[str] = []

            def noted(parameter: str, token: int) -> float | None:
                asked.append(parameter)
                return draw(parameter, token)

            bench, planner = make(noted)
            bench.database.environment = None
            table = planner.solver.agenda.table  # whose rows are the same in every mission, once they were asked for
            loaded = Stocked(bench, planner, None if asked else LoadedState((bench, planner), kept=(table,)))
        loaded.bench.database.environment = draw
        if loaded.snapshot is not None:
            self._borrowed.append((shelf, loaded))
        return loaded
