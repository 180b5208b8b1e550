"""A bucket of failures in, the parameter values that separate it from passing missions out.

Three witnesses, each stronger than the one before: the samples (a cut between passing and failing draws), flights (the
example mission flown again with one value changed: the paper's "parameter-subset re-runs", section 6) and z3 (the exact
edge in the conflict's own terms).
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from fractions import Fraction

from checker.batch.result import MissionResult
from checker.buckets import Bucket, bucket_key
from checker.oracle import Verdict
from checker.simplest import shortest_decimal
from checker.smt.edges import RangeEnd, find_failing_range
from runtime.executive.configuration import AgentConfiguration, ParameterConfiguration
from runtime.executive.distributions import DISTRIBUTIONS

Refly = Callable[[AgentConfiguration, int, int], MissionResult]  # agent, number, seed
_HALVINGS = 30
_NARROW = 1e-5  # of the parameter's range: flights stop there, for floats of the engine are no sharper
_LUCK = 0.01  # a cut of samples alone is believed when chance would bring it less often


class Witness(StrEnum):
    """What tells where failing begins."""

    Z3 = "z3"
    FLIGHTS = "flights"
    SAMPLES = "samples"


@dataclass(frozen=True, slots=True)
class Cut:
    """The best cut between passing and failing samples: failures lie `above` (or below) it.

    `passing` and `failing` are the samples on either side of it; `purity` is the share of failures among the missions
    on the failing side, `coverage` the share of the bucket that lies there, `merit` the mean of coverage and the share
    of passing missions on the passing side.
    """

    is_above: bool
    passing: float
    failing: float
    purity: float
    coverage: float
    merit: float
    luck: float  # how likely so clean a cut is by chance: 1 unless no sample lies on the wrong side


@dataclass(frozen=True, slots=True)
class Threshold:
    """What a bucket has to do with one parameter.

    `is_causal`: the example passes when this value alone is changed; None where that was not tried. `edge` is where
    failing begins, found by `witnesses`; `edge_fails` tells whether it fails at `edge` itself.
    """

    parameter: str
    example_value: float
    cut: Cut | None
    is_causal: bool | None
    is_above: bool
    edge: float
    edge_fails: bool
    witnesses: tuple[Witness, ...]
    flights: int

    @property
    def method(self) -> str:
        """How the edge was found, in words."""
        return " and ".join(self.witnesses)

    @property
    def condition(self) -> str:
        """The condition under which missions fail, such as `GPS_HIT_RATE > 3.8`."""
        sign = (">=" if self.edge_fails else ">") if self.is_above else ("<=" if self.edge_fails else "<")
        return f"{self.parameter} {sign} {_plain(self.edge)}"


def find_thresholds(
    bucket: Bucket, results: Sequence[MissionResult], agent: AgentConfiguration, refly: Refly | None
) -> tuple[Threshold, ...]:
    """The thresholds of a bucket, the one that explains most first; parameters that explain nothing are left out."""
    by_number = {result.number: result for result in results}
    example = by_number[bucket.example]
    found: list[Threshold] = []
    for parameter in agent.parameters:
        if DISTRIBUTIONS[parameter.distribution].is_determined:
            continue
        failing = [_in_force(by_number[number], parameter.name) for number in bucket.missions]
        passing = [
            value
            for result in results
            if result.verdict is Verdict.PASS
            for value in _all_values(result, parameter.name)
        ]
        own = _in_force(example, parameter.name)
        if own is None:
            continue
        cut = find_cut([value for value in failing if value is not None], passing)
        threshold = _sharpen(parameter, example, own, cut, agent, refly)
        if threshold is not None:
            found.append(threshold)
    return tuple(sorted(found, key=lambda one: (one.is_causal is not True, -(one.cut.merit if one.cut else 0.0))))


def find_cut(failing: Sequence[float], passing: Sequence[float]) -> Cut | None:
    """The cut of greatest merit; None without samples of both sorts. O(n log n)."""
    if not failing or not passing:
        return None
    cuts = [cut for is_above in (True, False) if (cut := _one_sided_cut(failing, passing, is_above)) is not None]
    return max(cuts, key=lambda cut: (cut.merit, cut.purity), default=None)


def _one_sided_cut(failing: Sequence[float], passing: Sequence[float], is_above: bool) -> Cut | None:
    sign = 1.0 if is_above else -1.0
    marked = sorted([(sign * value, True) for value in failing] + [(sign * value, False) for value in passing])
    best: Cut | None = None
    passed = failed = 0
    for position, (value, fails) in enumerate(marked):
        if position and value > marked[position - 1][0]:
            beyond_fail, beyond_pass = len(failing) - failed, len(passing) - passed
            if beyond_fail:
                merit = (beyond_fail / len(failing) + passed / len(passing)) / 2.0
                if best is None or merit > best.merit:
                    purity = beyond_fail / (beyond_fail + beyond_pass)
                    before = marked[position - 1][0]
                    coverage = beyond_fail / len(failing)
                    is_clean = beyond_pass == 0 and failed == 0
                    luck = min(1.0, 2.0 / math.comb(len(marked), len(failing))) if is_clean else 1.0
                    best = Cut(is_above, sign * before, sign * value, purity, coverage, merit, luck)
        passed, failed = passed + (not fails), failed + fails
    return best


def _sharpen(
    parameter: ParameterConfiguration,
    example: MissionResult,
    own: float,
    cut: Cut | None,
    agent: AgentConfiguration,
    refly: Refly | None,
) -> Threshold | None:
    """The strongest threshold that can be had for the example; None where the parameter has no part in the failure."""
    proved = _from_terms(parameter, example, own)
    is_causal, flown, flights = None, None, 0
    if refly is not None and parameter.mode == "inter":
        search = _Flights(parameter, example, agent, refly)
        is_causal, flown = search.find_edge(own, cut)
        flights = search.count
    name = parameter.name
    if flown is not None:
        agrees = proved is not None and proved[0] == flown[0] and abs(float(proved[1].value) - flown[1]) < 1e-4
        witnesses = (Witness.Z3, Witness.FLIGHTS) if agrees else (Witness.FLIGHTS,)
        return Threshold(name, own, cut, is_causal, *flown, witnesses, flights)
    if proved is not None and is_causal is None:
        is_above, edge = proved
        return Threshold(name, own, cut, None, is_above, float(edge.value), not edge.is_safe, (Witness.Z3,), flights)
    if is_causal is None and cut is not None and cut.luck * len(agent.parameters) < _LUCK:
        between = shortest_decimal(min(cut.passing, cut.failing), max(cut.passing, cut.failing))
        return Threshold(name, own, cut, None, cut.is_above, between, False, (Witness.SAMPLES,), 0)
    return None


def _from_terms(parameter: ParameterConfiguration, example: MissionResult, own: float) -> tuple[bool, RangeEnd] | None:
    """The edge on the side of the parameter's range that z3 finds in the conflict's terms."""
    abort = example.outcome.abort if example.outcome else None
    if abort is None or abort.conflict is None:
        return None
    width = max(parameter.upper - parameter.lower, 1e-9)
    box = (min(parameter.lower, own) - width, max(parameter.upper, own) + width)
    found = find_failing_range(abort.conflict, parameter.name, own, box)
    if found is None:
        return None
    edges = [(True, found.below), (False, found.above)]
    inside = [(is_above, edge) for is_above, edge in edges if edge is not None]
    nearest = sorted(inside, key=lambda one: abs(one[1].value - Fraction(own)))
    return nearest[0] if nearest else None


class _FlightError(Exception):
    """The tool failed in a flight: it says nothing about the model."""


class _Flights:
    """Fly the example again with another value of one parameter, until it is known where it stops to fail."""

    def __init__(
        self, parameter: ParameterConfiguration, example: MissionResult, agent: AgentConfiguration, refly: Refly
    ) -> None:
        self.parameter = parameter
        self.example = example
        self.agent = agent
        self.refly = refly
        self.count = 0
        self.key = bucket_key(example)

    def find_edge(self, own: float, cut: Cut | None) -> tuple[bool | None, tuple[bool, float, bool] | None]:
        """Whether the parameter alone decides; if so: whether values above fail, the edge, whether it fails itself.

        None where a flight could not be flown to its end.
        """
        middle = (self.parameter.lower + self.parameter.upper) / 2.0
        try:
            for safe in dict.fromkeys((cut.passing, middle) if cut is not None else (middle,)):
                if safe != own and not self._fails(safe):
                    edge = self._halve(own, safe)
                    return True, (own > safe, edge, self._fails(edge))
        except _FlightError:
            return None, None
        return False, None

    def _halve(self, failing: float, passing: float) -> float:
        width = max(self.parameter.upper - self.parameter.lower, 1e-9)
        for _ in range(_HALVINGS):
            if abs(failing - passing) <= _NARROW * width:
                break
            middle = (failing + passing) / 2.0
            if self.parameter.is_whole:
                middle = float(round(middle))
                if middle in (failing, passing):
                    break
            if self._fails(middle):
                failing = middle
            else:
                passing = middle
        if self.parameter.is_whole:
            return passing
        slack = _NARROW * width
        return shortest_decimal(min(failing, passing) - slack, max(failing, passing) + slack)

    def _fails(self, value: float) -> bool:
        self.count += 1
        changed = replace(self.parameter, distribution="fixed", values=(value,), weights=(), clip=None, share=None)
        parameters = tuple(changed if one.name == changed.name else one for one in self.agent.parameters)
        result = self.refly(replace(self.agent, parameters=parameters), self.example.number, self.example.seed)
        if result.verdict is Verdict.ERROR:
            raise _FlightError
        return result.verdict is Verdict.FAIL and bucket_key(result) == self.key


def _in_force(result: MissionResult, name: str) -> float | None:
    """The value of a parameter when the mission ended."""
    assert result.outcome is not None
    values = [draw.value for draw in result.outcome.draws if draw.parameter == name]
    return values[-1] if values else None


def _all_values(result: MissionResult, name: str) -> list[float]:
    assert result.outcome is not None
    return [draw.value for draw in result.outcome.draws if draw.parameter == name]


def _plain(value: float) -> str:
    """A threshold as people write it: up to nine significant digits."""
    return f"{value:.9g}"
