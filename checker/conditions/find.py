"""The condition of a bucket: samples and flights in, what separates failing from passing missions out, measured."""

from collections.abc import Sequence
from dataclasses import replace

from checker.batch.result import MissionResult
from checker.buckets import Bucket
from checker.conditions.condition import (
    Condition,
    Conjunction,
    Extreme,
    Feature,
    Literal,
    Row,
    Unseen,
    axis_feature,
    holds,
)
from checker.conditions.crossings import FINE, find_crossings, mend_crossings
from checker.conditions.edges import find_edges
from checker.conditions.flights import (
    Ended,
    Flights,
    HasTime,
    Refly,
    flight_budget,
    forever,
    fresh_budget,
    label_of,
)
from checker.conditions.measure import Quality, measure, measured_on, parts_that_hold, weighted_on
from checker.conditions.rules import induce, sample_cuts
from checker.conditions.space import Space
from checker.oracle import given_up
from checker.sampling.sampler import MissionRole, SamplePoint
from checker.smt.edges import find_failing_range
from runtime.executive.configuration import AgentConfiguration

_LEAST_PRECISION, _LEAST_RECALL = 0.5, 0.2  # below, a condition is not worth its words
_LEAST_GAIN = 1 / 3  # of what is still open when only the rate of failures is known
_LEAST_HELD_BACK = 4  # failing missions to measure on, where none can be flown
_FIRST_SHARE = 0.6  # of the flights
_ROUNDS = 3  # in which mistakes of the rules are looked into
_WIDE = 0.01  # of a range
_Sampled = tuple[Row, Ended, SamplePoint]  # what a mission of the run drew, how it ended, and why it drew that
_MOST_STEPS = 8  # of a parameter of which each value may be told from the next
_MOST_POINTS = 24  # of the run from which crossings are sought


def find_condition(
    bucket: Bucket,
    results: Sequence[MissionResult],
    agent: AgentConfiguration,
    batch_seed: int,
    refly: Refly | None,
    has_time: HasTime = forever,
    most_weight: float = 1.0,
) -> Condition | None:
    """The condition under which missions fail as those of `bucket`; None where nothing can be claimed.

    Where time is over before the flights are, its edges are coarser, and it is tested on fewer fresh missions. No
    mission of the run has more than `most_weight`.
    """
    example = next(result for result in results if result.number == bucket.example)
    space = Space(agent, results)
    if not space.parameters:
        return None
    sampled = _rows(space, results, bucket)
    if refly is None:
        return _from_samples(space, sampled, most_weight)
    rows = [(row, label) for row, label, _ in sampled]
    flights = Flights(bucket, example, space, refly, flight_budget(example), has_time)
    fails = [space.point(row) for row, label in rows if label is Ended.FAILS]
    passes = [space.point(row) for row, label in rows if label is Ended.PASSES]
    own = space.row(example)
    assert own is not None
    fails = [space.point(own), *fails[:_MOST_POINTS]]
    passes = passes or _corners(space)
    crossings = find_crossings(flights, fails, passes[:_MOST_POINTS], _FIRST_SHARE)
    conjunctions = _induced(space, rows, find_edges(flights, crossings), flights.rows())
    for _ in range(_ROUNDS):
        known = [*rows, *flights.rows()]
        told = [(space.point(row), label, holds(conjunctions, row)) for row, label in known]
        missed = [point for point, label, is_claimed in told if label is Ended.FAILS and not is_claimed]
        wrong = [point for point, label, is_claimed in told if label is Ended.PASSES and is_claimed]
        if not missed and not wrong:
            break
        more = mend_crossings(flights, crossings, missed or fails, wrong or passes)
        if len(more) == len(crossings):
            break
        crossings = more
        conjunctions = _induced(space, rows, find_edges(flights, crossings), flights.rows())
    if not conjunctions:
        return None
    budget = fresh_budget(example)
    measured = measure(conjunctions, space, bucket, batch_seed, refly, budget, has_time)
    kept = conjunctions if measured is None else parts_that_hold(conjunctions, measured)
    if not kept:
        return None
    if kept != conjunctions:  # each part has to hold by itself
        conjunctions = kept
        measured = measure(conjunctions, space, bucket, batch_seed, refly, budget, has_time)
    found = claimed(conjunctions, measured, flights.count, space, _share_of(sampled), has_flown=True)
    if found is None:
        return None
    unseen = _unseen_by(found, [row for row, _ in (*rows, *flights.rows())], space)
    return replace(found, in_terms=_in_terms(found, example, space), unseen=unseen)


def _in_terms(condition: Condition, example: MissionResult, space: Space) -> tuple[Literal, ...]:
    """The edges of one parameter at which z3 finds the conflict of the example to begin."""
    abort = given_up(example.outcome) if example.outcome else None
    row = space.row(example)
    if abort is None or abort.conflict is None or row is None:
        return ()
    axes = {axis.name: axis for axis in space.parameters if not axis.is_redrawn}
    found = []
    for literal in condition.single:
        axis = axes.get(literal.feature.parameters[0])
        if axis is None or not literal.holds(row):
            continue
        box = (axis.lower - axis.width, axis.upper + axis.width)
        failing = find_failing_range(abort.conflict, axis.name, row[axis.name][1], box)
        end = None if failing is None else failing.below if literal.is_above else failing.above
        if end is not None and end.is_proved and abs(float(end.value) - literal.edge) <= FINE * axis.width:
            found.append(literal)
    return tuple(found)


def _rows(space: Space, results: Sequence[MissionResult], bucket: Bucket) -> list[_Sampled]:
    rows: list[_Sampled] = []
    for result in results:
        label, row = label_of(result, bucket), space.row(result)
        if label is not None and row is not None:
            rows.append((row, label, result.point))
    return rows


def _corners(space: Space) -> list[tuple[float, ...]]:
    """Where to look for a passing mission if none is known: the middle, and the ends of each range."""
    middle = tuple(axis.at(0.5) for axis in space.parameters)
    ends = [
        (*middle[:number], end, *middle[number + 1 :])
        for number, axis in enumerate(space.parameters)
        for end in (axis.lower, axis.upper)
    ]
    return [middle, *ends]


def _induced(
    space: Space,
    rows: Sequence[tuple[Row, Ended]],
    edges: Sequence[Literal],
    flown: Sequence[tuple[Row, Ended]] = (),
) -> tuple[Conjunction, ...]:
    """Rules over the edges that flights found, with cuts of the samples where a parameter has none.

    A parameter of few values may be cut between any two.
    """
    stepped = {axis.name for axis in space.parameters if axis.is_stepped()}
    cuts = sample_cuts(rows, _features(space, {one.feature for one in edges}), stepped)
    steps = [
        Literal(axis_feature(axis.name), True, value, holds_at_edge=True)
        for axis in space.parameters
        if not axis.is_redrawn
        for value in axis.steps(_MOST_STEPS)[1:]
    ]
    return induce(rows, [*edges, *cuts, *steps], flown)


def _features(space: Space, known: set[Feature]) -> list[Feature]:
    found: list[Feature] = []
    for axis in space.parameters:
        extremes = (Extreme.GREATEST, Extreme.LEAST) if axis.is_redrawn else (Extreme.ONLY,)
        found += [axis_feature(axis.name, one) for one in extremes if axis_feature(axis.name, one) not in known]
    return found


def _from_samples(space: Space, sampled: Sequence[_Sampled], most_weight: float) -> Condition | None:
    """From the missions of the run alone: found on some, measured on others, of which no design chose any.

    Those that were plainly drawn are held back by turns. Where weighted ones were chosen, a later one depends on how
    earlier ones ended: then the later half is held back.
    """
    drawn = [one for one in sampled if one[2].role is not MissionRole.DESIGNED]
    designed = [one for one in sampled if one[2].role is MissionRole.DESIGNED]
    fails = [one for one in drawn if one[1] is Ended.FAILS]
    rest = [one for one in drawn if one[1] is not Ended.FAILS]
    is_weighted = any(point.role is MissionRole.WEIGHTED for _, _, point in drawn)
    if is_weighted:
        seen, held_back = drawn[: len(drawn) // 2], drawn[len(drawn) // 2 :]
    else:
        seen, held_back = [*fails[::2], *rest[::2]], [*fails[1::2], *rest[1::2]]
    if sum(label is Ended.FAILS for _, label, _ in held_back) < _LEAST_HELD_BACK:
        return None
    conjunctions = _induced(space, [(row, label) for row, label, _ in (*designed, *seen)], [])
    if not conjunctions:
        return None
    if is_weighted:
        weighted = [(row, label, point.weight) for row, label, point in held_back]
        measured = weighted_on(weighted, conjunctions, most_weight)
    else:
        measured = measured_on([(row, label) for row, label, _ in held_back], conjunctions)
    found = claimed(conjunctions, measured, 0, space, _share_of(sampled), has_flown=False)
    return None if found is None else replace(found, unseen=_unseen_by(found, [one[0] for one in sampled], space))


def _share_of(sampled: Sequence[_Sampled]) -> float:
    """How many missions fail so, as far as those of the run tell."""
    drawn = [one for one in sampled if one[2].role is not MissionRole.DESIGNED] or sampled
    return sum(point.weight for _, label, point in drawn if label is Ended.FAILS) / max(len(drawn), 1)


def _unseen_by(condition: Condition, rows: Sequence[Row], space: Space) -> tuple[Unseen, ...]:
    """Of the edges of one parameter those beside which no mission is known: between which values there is none."""
    axes = {axis.name: axis for axis in space.parameters}
    found = []
    for literal in condition.single:
        (name,) = literal.feature.parameters
        sides: dict[bool, list[float]] = {True: [], False: []}
        for row in rows:
            sides[literal.holds(row) is literal.is_above].append(literal.feature.value(row))
        if all(sides.values()):
            below, above = max(sides[False]), min(sides[True])
            if axes[name].has_between(below, above, _WIDE):
                found.append(Unseen(literal.feature, below, above))
    return tuple(dict.fromkeys(found))


def claimed(
    conjunctions: tuple[Conjunction, ...],
    measured: Quality | None,
    flights: int,
    space: Space,
    share: float,
    *,
    has_flown: bool,
) -> Condition | None:
    """What may be claimed: nothing that holds half the time, and of redrawn parameters only what holds.

    `share` of all missions fail so anyway: a condition that tells hardly more than that is none.
    """
    if measured is None or measured.precision.value < _LEAST_PRECISION or measured.recall.value < _LEAST_RECALL:
        return None
    if measured.precision.value < share + _LEAST_GAIN * (1.0 - share):
        return None
    if measured.outside is None or measured.outside >= measured.precision.value:
        return None  # it holds for every mission, or missions fail as often where it does not
    near = measured.near if has_flown else None
    found = Condition(conjunctions, measured.precision, measured.recall, measured.fresh, near, flights)
    redrawn = {axis.name for axis in space.parameters if axis.is_redrawn}
    return None if found.is_partial and redrawn & set(found.parameters) else found
