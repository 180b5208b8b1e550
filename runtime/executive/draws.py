"""Give each token the value that a redrawn parameter has at the tick at which the token begins (T-REX 3.4)."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf

from compiler.program import Program
from runtime.executive.chance import sample, update_index
from runtime.executive.configuration import AgentConfiguration, ParameterConfiguration
from runtime.executive.expression import ExpressionError, parse_expression
from runtime.executive.outcome import Draw, Phase
from runtime.executive.trace import Trace
from runtime.executive.view import PlanView
from runtime.user.fault import UserCodeError

_NOTHING = -1
_NEVER = 2**52
_PLANNING = (Phase.DELIBERATE, Phase.DISPATCH)


class World:
    """What a mission draws from chance; a pure function of seed, parameter and tick, recorded when first used."""

    def __init__(
        self, configuration: AgentConfiguration, seed: int, overrides: Mapping[str, float], trace: Trace
    ) -> None:
        self.parameters = {parameter.name: parameter for parameter in configuration.parameters}
        self.seed = seed
        self.overrides = overrides
        self.trace = trace

    def learn(self, program: Program) -> None:
        """Take note of the parameters of a model; what the mission does not list is uniform over its domain."""
        for site in program.sampled:
            if site.name not in self.parameters and site.default is not None and site.default.interval is not None:
                lower, upper = site.default.interval
                self.parameters[site.name] = ParameterConfiguration(
                    site.name, float(lower), float(upper), is_whole=site.kind == "int"
                )

    def varies(self, name: str) -> bool:
        """Whether a parameter is drawn more than once in a mission."""
        parameter = self.parameters.get(name)
        return parameter is not None and parameter.mode == "intra" and name not in self.overrides

    def draw(self, reactor: str, name: str, tick: int) -> float | None:
        """The value of a parameter that is in force at `tick`."""
        found = self.in_force(name, tick)
        if found is None:
            return None
        self.trace.record_draw(reactor, found[0])
        return found[0].value

    def in_force(self, name: str, tick: int) -> tuple[Draw, int] | None:
        """The draw of a parameter that is in force at `tick`, and the tick of the next one; not recorded."""
        parameter = self.parameters.get(name)
        if parameter is None:
            return None
        if name in self.overrides:
            value = self.overrides[name]
            return Draw(name, 0, value, value), _NEVER
        until = _NEVER if parameter.mode == "inter" else (update_index(parameter, tick) + 1) * parameter.update
        if not parameter.expression:
            return sample(parameter, self.seed, tick), until
        given = {}
        for other in parse_expression(parameter.expression).names:
            found = self.in_force(other, tick)
            if found is None:
                return None
            given[other] = found[0].value
        try:
            return sample(parameter, self.seed, tick, given), until
        except ExpressionError as problem:
            raise UserCodeError(f"the parameter `{name}`: {problem}", "", "mend its `expression`") from problem


@dataclass(frozen=True, slots=True)
class _Drawn:
    """Token `token`, which had `key`, holds the value of `parameter` with update index `index` (NOTHING: none yet)."""

    token: int
    key: int
    predicate: int
    parameter: str
    index: int


class Draws:
    """What one reactor has drawn of parameters that change, for tokens that have not begun."""

    def __init__(self, reactor: str, world: World) -> None:
        self.reactor = reactor
        self.world = world
        self.view: PlanView | None = None
        self.open: list[_Drawn] = []
        self.is_reactive = False  # nothing is planned behind what has not begun: it is drawn for as it begins
        self.begins: dict[int, int] = {}  # when those begin that are drawn for anew: meanwhile they have no place
        self.is_put_off = False  # nothing is drawn for what has not begun: it keeps the range of the parameter
        self.asks_nobody = False  # so it is always put off, unless what is drawn has to be told to an owner in time
        # The keys, by token, of what waits for its draw: nothing else is decided of it.
        self.undrawn: dict[int, int] = {}

    def draw(self, name: str, token: int) -> float | None:
        """What the plan database asks: the value of a parameter for a token (NOTHING: for the script)."""
        world = self.world
        if not world.varies(name):
            return world.draw(self.reactor, name, 0)
        tick = self._begin(token) if token >= 0 and self.view is not None else 0  # what the script makes begins at 0
        if token >= 0 and self.view is not None:
            key, predicate = int(self.view.rows.key[token]), int(self.view.rows.predicate[token])
            if self.is_put_off or (self.asks_nobody and world.trace.phase in _PLANNING):
                self.open.append(_Drawn(token, key, predicate, name, _NOTHING))
                self.undrawn[token] = key
                return None
            self.undrawn.pop(token, None)
            self.open.append(_Drawn(token, key, predicate, name, update_index(world.parameters[name], tick)))
        return world.draw(self.reactor, name, tick)

    def _begin(self, token: int) -> int:
        """When a token begins, as far as is known: what has not begun does so now, or next if now is synchronised."""
        assert self.view is not None
        start = self.view.start(token)
        earliest = max(self.view.lower(start), self.begins.get(token, 0))
        is_synchronised = self.world.trace.phase in _PLANNING
        next_tick = self.world.trace.tick + is_synchronised
        return int(max(earliest, 0 if self.view.upper(start) < next_tick else next_tick))

    def waiting(self, view: PlanView, tick: int) -> list[int]:
        """Tokens in the plan that hold a value and begin after `tick`."""
        return list(
            dict.fromkeys(
                each.token
                for each in self.open
                if each.index != _NOTHING
                and view.is_alive(each.token, each.key)
                and view.is_active(each.token)
                and not view.is_started(each.token, tick)
            )
        )

    def outdated(self, view: PlanView, tick: int) -> list[int]:
        """Tokens that have not begun by `tick` and hold a value that is no longer, or not yet, in force then.

        Until `begins` is emptied, what is drawn for them is what is in force when they begin.
        """
        if not self.open:
            self.begins = {}
            return []
        found: dict[int, int] = {}
        left = []
        for each in self.open:
            if not view.is_alive(each.token, each.key) or view.predicate_of(each.token) != each.predicate:
                continue
            if not view.is_active(each.token) or view.is_started(each.token, tick - 1):
                continue
            begin = max(int(view.lower(view.start(each.token))), tick)
            is_outdated = update_index(self.world.parameters[each.parameter], begin) != each.index
            if is_outdated and not (self.is_reactive and begin > tick):
                found[each.token] = begin
            elif each.token not in found:
                left.append(each)
        self.open, self.begins = left, found
        return list(found)

    def next_change(self, view: PlanView, tick: int) -> float:
        """The first tick after `tick` at which a planned token that has not begun needs another value.

        That is the very next one where the token has been moved since, as when others were put in front of it.
        """
        if not self.open:
            return inf
        times = [inf]
        for each in self.open:
            is_there = view.is_alive(each.token, each.key) and view.is_active(each.token)
            if is_there and not view.is_started(each.token, tick):
                parameter = self.world.parameters[each.parameter]
                begin = max(int(view.lower(view.start(each.token))), tick + 1)
                is_moved = update_index(parameter, begin) != each.index
                soonest = begin if self.is_reactive else tick + 1
                times.append(soonest if is_moved else (each.index + 1) * parameter.update)
        return min(times)
