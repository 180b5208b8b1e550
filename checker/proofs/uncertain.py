"""A flown mission's plan as a network with uncertain durations: those of tokens that a reactor asks others for.

How long such a token may take is the range of what its owner makes of the sampled parameters, over the whole box. The
flight shows one branch of the owner's rules: flights that took others count with what their lines make of the box, too.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import ceil, floor, isinf
from typing import NamedTuple

import z3

from checker.controllability.network import ContingentLink, UncertainNetwork
from checker.proofs.claims import Number
from checker.proofs.dating import Dated
from checker.proofs.demands import Demand
from checker.proofs.distances import POINTS, DistanceReader
from checker.proofs.intervals import Ranges
from checker.proofs.operands import name_of
from checker.proofs.solving import fraction
from checker.proofs.structure import Structure
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.record import BodyRun, MissionRecord, Value


@dataclass(frozen=True, slots=True)
class VehicleDuration:
    """A token of another reactor, and how long it may take; `after`: from the end of that token on.

    `shown` is how long it took in flights, or at least took in those that ended before it did, and what the lines tell
    exactly: between these no value of a parameter is needed twice.
    """

    token: str
    lower: int
    upper: int
    after: str = ""
    shown: tuple[int, int] = (0, 0)


@dataclass(frozen=True, eq=False, slots=True)
class PlanNetwork:
    """The network of one reactor's plan; `left_out` counts demands that are no distances between times.

    `endless` are the requests for which no longest duration is known: nothing stands for them in the network.
    """

    reactor: str
    network: UncertainNetwork
    durations: tuple[VehicleDuration, ...]
    left_out: int
    endless: tuple[str, ...] = ()

    def as_shown(self) -> UncertainNetwork:
        """The network where all takes only as long as flights have shown."""
        return replace(self.network, links=[_as_shown(link) for link in self.network.links])


def _as_shown(link: ContingentLink) -> ContingentLink:
    taken = link.why
    assert isinstance(taken, VehicleDuration)
    lower, upper = taken.shown
    return replace(link, lower=max(lower, link.lower), upper=min(max(lower, upper), link.upper))


class Spell(NamedTuple):
    """When what was asked for began and ends; where that is not known, the first tick after the flight."""

    start: int
    end: int
    is_known: bool


_Arguments = tuple[Value, ...]
_Request = tuple[str, str, _Arguments | None, int]  # reactor, predicate, arguments (None: any), the how manieth
Flown = Mapping[_Request, Spell]


def requests_flown(agent: AgentConfiguration, record: MissionRecord) -> Flown:
    """When the owners of what reactors asked for began and ended it."""
    owners = {name: each.name for each in agent.reactors for name in each.internal}
    done: dict[tuple[str, str, int], Spell] = {}
    for reactor in record.reactors:
        for each in reactor.tokens:
            if each.state == "active" and isinstance(each.start, int) and each.start <= reactor.last_tick:
                is_known = isinstance(each.end, int)  # by its owner, though the flight may have ended before
                end = each.end if isinstance(each.end, int) else reactor.last_tick + 1
                done[reactor.reactor, str(each.object), each.start] = Spell(each.start, end, is_known)
    found: dict[_Request, Spell] = {}
    for configuration, reactor in zip(agent.reactors, record.reactors, strict=True):
        asked = [
            (token.start, token.predicate, token.arguments, str(token.object))
            for token in reactor.tokens
            if token.origin != "observation" and str(token.object) in configuration.external
            if token.state == "active" and isinstance(token.start, int)
        ]
        for requests, start, line in _numbered(configuration.name, asked):
            spell = done.get((owners.get(line, ""), line, start))
            if spell is not None:
                found |= dict.fromkeys(requests, spell)
    return found


def _numbered(
    reactor: str, asked: Iterable[tuple[int, str, _Arguments, str]]
) -> Iterator[tuple[tuple[_Request, _Request], int, str]]:
    """Requests with their starts and what else is told, in the order of time, counted with their arguments and without.

    Two jobs of other arguments may come in another order in another flight.
    """
    counts: Counter[tuple[str, _Arguments | None]] = Counter()
    for start, predicate, arguments, more in sorted(asked, key=lambda one: (one[0], one[1], one[3])):
        names: list[_Request] = []
        for each in (arguments, None):
            counts[predicate, each] += 1
            names.append((reactor, predicate, each, counts[predicate, each]))
        yield (names[0], names[1]), start, more


def branches_flown(record: MissionRecord) -> frozenset[object]:
    """The branches that owners took in their rules for what they were asked for, by request."""
    found: set[object] = set()
    for reactor in record.reactors:
        counts: Counter[tuple[str, _Arguments]] = Counter()
        for token in sorted(reactor.tokens, key=lambda one: one.key):
            if token.origin == "request" and token.state == "active":
                asked = (token.predicate, token.arguments)
                counts[asked] += 1
                taken = tuple(_branches(run) for run in token.runs)
                found.add((reactor.reactor, *asked, counts[asked], taken))
    return frozenset(found)


def _branches(run: BodyRun) -> tuple[object, ...]:
    return (run.rule, *((guard.branch, _branches(guard.run)) for guard in run.guards if guard.run is not None))


def plan_networks(
    structure: Structure,
    found: Dated,
    ranges: Ranges,
    flights: Sequence[Flown] = (),
    others: Sequence[tuple[Structure, Dated]] = (),
) -> Iterator[PlanNetwork]:
    """The network of each reactor that asks others for something.

    `flights` are those of other values, and `others` the structures of those that took other branches.
    """
    for reactor in dict.fromkeys(reactor for reactor, _, _ in structure.asked):
        beside = [_Branch(dates.known, _requests(one, reactor), _chosen(dates)) for one, dates in others]
        yield _Builder(structure, found, ranges, reactor, flights, beside).build()


def _chosen(found: Dated) -> frozenset[str]:
    """The sampled values by which branches and orders of a flight were chosen: others would have led elsewhere."""
    claims = [one.claim for one in found.conditions if one.demand.is_structure]
    return frozenset(name for claim in claims for name in _sampled(claim))


def _sampled(number: Number) -> Iterator[str]:
    """The names of the variables in an expression."""
    waiting, seen = [number], set[int]()
    while waiting:
        one = waiting.pop()
        if one.get_id() not in seen:
            seen.add(one.get_id())
            waiting += one.children()
            if name := name_of(one):
                yield name


def _requests(structure: Structure, reactor: str) -> dict[str, tuple[_Request, _Request]]:
    """How the requests of a reactor are counted, by their variables."""
    begun = []
    for owner, each, name in structure.asked:
        start = structure.values[each + ".start"]
        if owner == reactor and isinstance(start, int):
            begun.append((start, name.partition("#")[0], structure.arguments[each], each))
    return {variable: requests for requests, _, variable in _numbered(reactor, begun)}


@dataclass(frozen=True, eq=False, slots=True)
class _Branch:
    """What another flight knows of the same requests, over the sampled values."""

    known: Mapping[str, Number]
    requests: Mapping[str, tuple[_Request, _Request]]
    chosen: frozenset[str]

    def length(self, asked: tuple[_Request, _Request], origin: tuple[_Request, _Request], point: str) -> Number | None:
        """How long a request takes from a time of another on; None where this flight does not tell."""
        token, other = self._alike(asked), self._alike(origin)
        end, begin = self.known.get(f"{token}.end"), self.known.get(f"{other}{point}")
        return None if token is None or other is None or end is None or begin is None else z3.simplify(end - begin)

    def _alike(self, asked: tuple[_Request, _Request]) -> str | None:
        for name in (0, 1):
            for variable, requests in self.requests.items():
                if requests[name] == asked[name]:
                    return variable
        return None


class _Builder:
    def __init__(
        self,
        structure: Structure,
        found: Dated,
        ranges: Ranges,
        reactor: str,
        flights: Sequence[Flown],
        others: Sequence[_Branch],
    ) -> None:
        self.structure = structure
        self.flights, self.others = flights, others
        self.known = found.known
        self.flown = found.flown
        self.chosen = _chosen(found)
        self.ranges = ranges
        self.reactor = reactor
        self.points: dict[str, int] = {"": 0}  # the beginning of the mission
        for start, end, _ in structure.times:
            for name in (start, end):
                if name.startswith(f"{reactor}:"):
                    self.points.setdefault(name, len(self.points))
        for demand in structure.demands:
            for each in demand.numbers:
                name = name_of(each)
                if name.startswith(f"{reactor}:") and name.endswith(POINTS):
                    self.points.setdefault(name, len(self.points))
        self.network = UncertainNetwork(len(self.points))
        self.left_out = 0
        self.reactors = {start.partition(":")[0] for start, _, _ in structure.times}

    def build(self) -> PlanNetwork:
        """The edges of all demands on the reactor's times, and the links of what it asked for."""
        durations = []
        endless = []
        asked = [
            each for each in self.structure.asked if each[0] == self.reactor and each[1] not in self.structure.lasting
        ]
        self.requests = _requests(self.structure, self.reactor)
        for number, (_, variable, name) in enumerate(asked):
            taken = self._taken(variable, name, asked[:number] + asked[number + 1 :])
            if taken is None:
                endless.append(name)
            else:
                durations.append(taken)
        distances = DistanceReader(self.points, self._value, self.structure.observed)
        for one in distances.read([demand for demand in self.structure.demands if self._is_own(demand)]):
            self.network.between(one.a, one.b, one.lower, one.upper, one.demand)
        self.left_out = distances.left_out
        return PlanNetwork(self.reactor, self.network, tuple(durations), self.left_out, tuple(endless))

    def _is_own(self, demand: Demand) -> bool:
        """Whether a demand speaks of no other reactor."""
        owners = {name_of(each).partition(":")[0] for each in demand.numbers}
        return not any(name in owners and name != self.reactor for name in self.reactors)

    def _flown(self, name: str) -> int:
        value = self.structure.values[name]
        assert isinstance(value, int)
        return value

    def _taken(self, variable: str, name: str, others: Sequence[tuple[str, str, str]]) -> VehicleDuration | None:
        """How long a token takes, from its start or from the end of another on: what is told most exactly."""
        end = self.known.get(variable + ".end")
        if end is None:
            return None
        flown = self.structure.values[variable + ".end"]
        origins = [(variable, ".start", "")]
        origins += [
            (other, ".end", label) for _, other, label in others if self._is_before(other + ".end", flown, variable)
        ]
        best: tuple[float, str, VehicleDuration] | None = None
        for source, point, label in origins:
            origin = source + point
            if origin not in self.known:
                continue
            lengths = [(z3.simplify(end - self.known[origin]), self.chosen)]
            for branch in self.others:
                length = branch.length(self.requests[variable], self.requests[source], point)
                if length is not None:
                    lengths.append((length, branch.chosen))
            told = [(self.ranges.range(each), self._is_attained(each, chosen)) for each, chosen in lengths]
            seen = list(self._seen(variable, source, point))
            whole = [taken for taken, is_known in seen if is_known]
            lower = min([*(ends[0] for ends, _ in told), *whole])
            upper = max([*(ends[1] for ends, _ in told), *(taken for taken, _ in seen)])
            if isinf(lower) or isinf(upper) or lower < 0:
                continue
            own = self._flown(variable + ".end") - self._flown(origin)
            shown = min([own, *whole]), max([own, *(taken for taken, _ in seen)])
            for ends, is_attained in told:
                if is_attained:
                    shown = min(shown[0], ceil(ends[0])), max(shown[1], floor(ends[1]))
            if best is None or upper - lower < best[0]:
                best = (upper - lower, origin, VehicleDuration(name, ceil(lower), floor(upper), label, shown))
        if best is None:
            return None
        _, origin, taken = best
        link = ContingentLink(self.points[origin], self.points[variable + ".end"], taken.lower, taken.upper, taken)
        self.network.links.append(link)
        return taken

    def _is_attained(self, length: Number, chosen: frozenset[str]) -> bool:
        """Whether all of a range is taken: no value stands in it twice, or has led to another branch."""
        return self.ranges.is_attained(length) and chosen.isdisjoint(_sampled(length))

    def _seen(self, variable: str, source: str, point: str) -> Iterator[tuple[int, bool]]:
        """How long a token took in each flight, from a time of another on, and whether that is known exactly."""
        for flight in self.flights:
            token, other = self._alike(flight, variable), self._alike(flight, source)
            if token is not None and other is not None and (point == ".start" or other.is_known):
                yield token.end - other[POINTS.index(point)], token.is_known

    def _alike(self, flight: Flown, variable: str) -> Spell | None:
        """What another flight had of a request: the one of its arguments; where these are drawn, that in its place."""
        with_arguments, in_place = self.requests[variable]
        spell = flight.get(with_arguments)
        alike = (one for one, _ in self.requests.values() if one[:2] == in_place[:2])
        return flight.get(in_place) if spell is None and not any(one in flight for one in alike) else spell

    def _is_before(self, other: str, flown: Value, variable: str) -> bool:
        """Whether another end came before that of a token in the flight, while it lasted."""
        at, start = self.structure.values.get(other), self.structure.values.get(variable + ".start")
        if not (isinstance(at, int) and isinstance(flown, int) and isinstance(start, int)):
            return False
        return start < at < flown

    def _value(self, name: str) -> Fraction | None:
        """The value of a constant of the model, or of an argument that is the same for all values."""
        known = None if name in self.flown else self.known.get(name)
        return None if known is None else fraction(known)
