"""Functions, angles, positions and dates: text-book values, both directions, and no value of a solution lost."""

import math
import random
from collections.abc import Callable
from math import inf

import pytest

from runtime.constraints.domains import tags
from runtime.constraints.domains.narrow import high, is_single, low
from runtime.constraints.domains.store import Store
from runtime.constraints.engine import Engine
from runtime.constraints.propagators import earth, opcodes
from runtime.constraints.propagators.external import External, argument, at_least, refuse
from tests.constraints.reference import RUNS

Interval = tuple[float, float]
FREE: Interval = (-inf, inf)


def run(op: int, *intervals: Interval, kinds: str = "") -> list[Interval] | None:
    """Post one constraint on floats (or ints, where `kinds` has an i) and give the bounds; None on a conflict."""
    engine = Engine()
    variables = []
    for k, (lo, hi) in enumerate(intervals):
        kind = tags.KIND_INT if kinds[k : k + 1] == "i" else tags.KIND_FLOAT
        variables.append(engine.new_interval(kind, lo, hi, k, -1))
    engine.post(op, variables, 9, -1)
    return [(engine.lower(v), engine.upper(v)) for v in variables] if engine.propagate() else None


def known(x: float) -> Interval:
    """Give the interval of one value."""
    return (x, x)


@pytest.mark.parametrize(
    ("op", "arguments", "result"),
    [
        (opcodes.OP_ABS, [-2.5], 2.5),
        (opcodes.OP_SQRT, [9.0], 3.0),
        (opcodes.OP_FLOOR, [2.7], 2.0),
        (opcodes.OP_FLOOR, [-2.1], -3.0),
        (opcodes.OP_CEIL, [2.1], 3.0),
        (opcodes.OP_MAX, [2.0, 5.0], 5.0),
        (opcodes.OP_MIN, [2.0, 5.0], 2.0),
        (opcodes.OP_POW, [2.0, 10.0], 1024.0),
        (opcodes.OP_MOD, [7.0, 4.0], 3.0),
        (opcodes.OP_MOD, [-7.0, 4.0], -3.0),
        (opcodes.OP_SIN, [30.0], 0.5),
        (opcodes.OP_SINF, [-30.0], -0.5),
        (opcodes.OP_COSF, [60.0], 0.5),
        (opcodes.OP_COSF, [180.0], -1.0),
        (opcodes.OP_SQRTF, [2.25], 1.5),
        (opcodes.OP_EXPF, [0.0], 1.0),
        (opcodes.OP_LOGF, [1.0], 0.0),
        (opcodes.OP_DEG_TO_RAD, [180.0], math.pi),
        (opcodes.OP_CIRCLE_MOD, [270.0], -90.0),
        (opcodes.OP_CIRCLE_MOD, [-190.0], 170.0),
        (opcodes.OP_MAXF, [1.0, 7.0, 3.0], 7.0),
    ],
)
def test_a_function_of_known_arguments_gives_its_value(op: int, arguments: list[float], result: float) -> None:
    bounds = run(op, FREE, *(known(x) for x in arguments))
    assert bounds is not None
    assert bounds[0] == pytest.approx((result, result), abs=3e-5)


@pytest.mark.parametrize(
    ("op", "arguments"),
    [
        (opcodes.OP_SIN, [120.0]),
        (opcodes.OP_SQRT, [-1.0]),
        (opcodes.OP_MOD, [1.0, 0.0]),
        (opcodes.OP_POW, [-8.0, 0.5]),
        (opcodes.OP_POW, [0.0, -1.0]),
        (opcodes.OP_LOGF, [0.0]),
        (opcodes.OP_LOGF, [-1.0]),
    ],
)
def test_a_function_without_a_value_is_a_conflict(op: int, arguments: list[float]) -> None:
    assert run(op, FREE, *(known(x) for x in arguments)) is None


def test_the_sine_narrows_its_result_and_holds_the_angle_within_a_quarter_turn() -> None:
    assert run(opcodes.OP_SIN, FREE, FREE) == [pytest.approx((-1.0, 1.0), abs=1e-8), (-90.0, 90.0)]
    assert run(opcodes.OP_SIN, FREE, (0.0, 30.0)) == [pytest.approx((0.0, 0.5), abs=1e-8), (0.0, 30.0)]
    assert run(opcodes.OP_SIN, known(0.5), (0.0, 60.0)) == [known(0.5), (0.0, 60.0)]


def test_bounds_within_which_a_value_lies_stand_in_order() -> None:
    assert run(opcodes.OP_WITHIN_BOUNDS, (0.0, 9.0), (2.0, 9.0), (1.0, 5.0)) == [(2.0, 5.0), (2.0, 5.0), (2.0, 5.0)]
    assert run(opcodes.OP_WITHIN_BOUNDS, (0.0, 9.0), (6.0, 9.0), (1.0, 5.0)) is None


def test_a_union_and_its_parts_lie_in_each_other() -> None:
    assert run(opcodes.OP_EQ_UNION, (0.0, 5.0), (1.0, 3.0), (4.0, 9.0)) == [(1.0, 5.0), (1.0, 3.0), (4.0, 5.0)]
    assert run(opcodes.OP_EQ_UNION, (0.0, 5.0), (1.0, 3.0), (7.0, 9.0)) is None


@pytest.mark.parametrize("op", [opcodes.OP_LT, opcodes.OP_TEST_LT])
@pytest.mark.parametrize(("a", "b", "holds"), [(1.0, 1.0, False), (1.0, 1.000004, False), (1.0, 1.00003, True)])
def test_a_float_is_not_less_than_what_it_equals_within_the_tolerance(op: int, a: float, b: float, holds: bool) -> None:
    truth = [known(1.0)] if op == opcodes.OP_TEST_LT else []
    assert (run(op, *truth, known(a), known(b)) is not None) == holds
    assert (run(op, *truth, known(a), (0.0, b)) is not None) == holds


@pytest.mark.parametrize(
    ("domains", "fit"),
    [
        ([[1, 2], [1, 2], [1, 2]], False),
        ([[1, 2], [1, 2], [3, 4]], True),
        ([[1, 5], [1, 5], [1, 5], [1, 2, 3, 4, 5, 6, 7]], False),
        ([[1, 2], [2, 3], [1, 2], [2, 3]], False),
        ([[1, 9], [2, 9], [1, 2], [3, 7]], True),
    ],
)
def test_too_many_variables_for_their_values_cannot_all_differ(domains: list[list[float]], fit: bool) -> None:
    for op in (opcodes.OP_ALL_DIFF, opcodes.OP_COND_ALL_DIFF):
        engine = Engine()
        variables = [engine.new_values(tags.KIND_INT, values, 0, -1) for values in domains]
        truth = [engine.new_interval(tags.KIND_BOOL, 0, 1, 0, -1)] if op == opcodes.OP_COND_ALL_DIFF else []
        engine.post(op, truth + variables, 0, -1)
        holds = engine.propagate() and (not truth or engine.upper(truth[0]) == 1)
        assert holds == fit


def test_a_function_waits_for_its_arguments() -> None:
    assert run(opcodes.OP_MAX, FREE, (1.0, 3.0), known(2.0)) == [FREE, (1.0, 3.0), known(2.0)]


GRAPHS: list[tuple[int, float, float, Callable[[float], float]]] = [
    (opcodes.OP_SINF, -180.0, 180.0, lambda x: math.sin(math.radians(x))),
    (opcodes.OP_COSF, -180.0, 180.0, lambda x: math.cos(math.radians(x))),
    (opcodes.OP_SQRTF, 0.0, 50.0, math.sqrt),
    (opcodes.OP_ABSF, -20.0, 20.0, abs),
    (opcodes.OP_FLOORF, -20.0, 20.0, math.floor),
    (opcodes.OP_CEILF, -20.0, 20.0, math.ceil),
    (opcodes.OP_EXPF, -20.0, 5.0, math.exp),
    (opcodes.OP_LOGF, 0.001, 50.0, math.log),
    (opcodes.OP_DEG_TO_RAD, -400.0, 400.0, math.radians),
    (opcodes.OP_CIRCLE_MOD, -900.0, 900.0, lambda x: (x + 180.0) % 360.0 - 180.0),
]


@pytest.mark.parametrize("row", range(len(GRAPHS)))
def test_bounds_keep_every_point_of_the_graph(row: int) -> None:
    op, least, most, function = GRAPHS[row]
    chance = random.Random(row)
    for _ in range(RUNS):
        x = chance.uniform(least, most)
        y = function(x)
        lo, hi = x - chance.choice((0.0, 1.0, 40.0)), x + chance.choice((0.0, 2.0, 70.0))
        low_y, high_y = y - chance.choice((0.0, 0.1, 3.0)), y + chance.choice((0.0, 0.2, 9.0))
        bounds = run(op, (low_y, high_y), (lo, hi))
        assert bounds is not None, (x, y, lo, hi, low_y, high_y)
        for (a, b), value in zip(bounds, (y, x), strict=True):
            assert a - 1e-5 <= value <= b + 1e-5, (x, y, lo, hi, low_y, high_y, bounds)


def test_backward_narrowing_of_angles_and_roots() -> None:
    angle = run(opcodes.OP_SINF, (0.5, 1.0), (0.0, 90.0))
    assert angle is not None and angle[1] == pytest.approx((30.0, 90.0), abs=1e-3)
    square = run(opcodes.OP_SQRTF, (2.0, 3.0), FREE)
    assert square is not None and square[1] == pytest.approx((4.0, 9.0), abs=1e-4)


def test_ints_are_rounded_inwards() -> None:
    assert run(opcodes.OP_FLOORF, FREE, (2.3, 4.9), kinds="i") == [(2, 4), (2.3, 4.9)]
    assert run(opcodes.OP_ADD_EQ, (0, 9), known(0.5), (2.0, 4.0), kinds="i") == [(2, 3), known(0.5), (2.5, 3.5)]


def test_travel_takes_whole_ticks_and_at_least_one() -> None:
    line = [FREE, known(0.0), known(0.0), known(3.0), known(4.0), known(2.0)]
    assert (run(opcodes.OP_TRAVEL_TIME, *line, kinds="i") or [])[0] == known(3)
    line[3:5] = [known(0.0), known(0.0)]
    assert (run(opcodes.OP_TRAVEL_TIME, *line, kinds="i") or [])[0] == known(1)
    line[3], line[5] = known(1.0), known(0.0)
    assert run(opcodes.OP_TRAVEL_TIME, *line, kinds="i") is None


def test_towards_is_a_unit_vector() -> None:
    bounds = run(opcodes.OP_TOWARDS, FREE, FREE, known(1.0), known(1.0), known(4.0), known(5.0))
    assert bounds is not None and bounds[:2] == [known(0.6), known(0.8)]
    bounds = run(opcodes.OP_TOWARDS, FREE, FREE, known(1.0), known(1.0), known(1.0), known(1.0))
    assert bounds is not None and bounds[:2] == [known(0.0), known(0.0)]


def test_dates_go_both_ways() -> None:
    forth = run(opcodes.OP_TICK_DATE, known(951_782_400), FREE, FREE, FREE, kinds="iiii")
    assert forth == [known(951_782_400), known(0), known(60), known(2000)]  # the 29th of February
    back = run(opcodes.OP_TICK_DATE, FREE, known(0), known(60), known(2000), kinds="iiii")
    assert back == forth


def test_displacement_and_displacing_are_inverse() -> None:
    chance = random.Random(4)
    for _ in range(RUNS // 4):
        lat, lon = chance.uniform(-70, 70), chance.uniform(-170, 170)
        north, east = chance.uniform(-5000, 5000), chance.uniform(-5000, 5000)
        assert earth.displacement(lat, lon, *earth.displaced(lat, lon, north, east)) == pytest.approx(
            (north, east), abs=1e-3
        )
        points = [known(lat), known(lon), known(north), known(east), FREE, FREE]
        bounds = run(opcodes.OP_WGS_DISPLACE, *points)
        assert bounds is not None
        (lat_low, lat_high), (lon_low, lon_high) = bounds[4:]
        new_lat, new_lon = earth.displaced(lat, lon, north, east)
        assert lat_low <= new_lat <= lat_high and lon_low <= new_lon <= lon_high
        assert lat_high - lat_low == pytest.approx(1e-6, abs=1e-9)


def test_a_quarter_of_the_equator_is_ten_thousand_kilometres() -> None:
    bounds = run(opcodes.OP_LL_DIST, FREE, known(0.0), known(0.0), known(0.0), known(90.0))
    assert bounds is not None and bounds[0] == pytest.approx((10_007_557, 10_007_558), abs=1)


def test_binding_takes_the_nearest_value() -> None:
    engine = Engine()
    v = engine.new_values(tags.KIND_INT, [1, 4, 9], 0, -1)
    engine.post(opcodes.OP_BIND, [v, engine.new_constant(tags.KIND_FLOAT, 6.2, 6.2)], 1, -1)
    assert engine.propagate() and engine.values_of(v) == [4]


def test_random_numbers_depend_on_the_place_and_not_on_the_order() -> None:
    drawn = []
    for order in ((3, 4), (4, 3)):
        engine = Engine()
        found = {}
        for span in order:
            found[span] = engine.new_interval(tags.KIND_INT, -inf, inf, span, -1)
            engine.post(opcodes.OP_RAND, [found[span]], span, -1)
        assert engine.propagate()
        drawn.append((engine.lower(found[3]), engine.lower(found[4])))
    assert drawn[0] == drawn[1] and drawn[0][0] != drawn[0][1]
    assert all(0 <= x <= 32767 for x in drawn[0])


def test_creeping_cycles_end() -> None:
    engine = Engine()
    x = engine.new_interval(tags.KIND_FLOAT, 0.0, 1e9, 0, -1)
    y = engine.new_interval(tags.KIND_FLOAT, 0.0, 1e9, 0, -1)
    engine.post(opcodes.OP_MUL_EQ, [y, engine.new_constant(tags.KIND_FLOAT, 0.9999, 0.9999), x], 1, -1)
    engine.post(opcodes.OP_EQ, [x, y], 2, -1)
    assert engine.propagate() and engine.contains(x, 0.0)
    a = engine.new_interval(tags.KIND_INT, 0, 10**12, 0, -1)
    b = engine.new_interval(tags.KIND_INT, 0, 10**12, 0, -1)
    one = engine.new_interval(tags.KIND_INT, 1, 1, 0, -1)
    engine.post(opcodes.OP_ADD_EQ, [a, one, b], 3, -1)
    engine.post(opcodes.OP_EQ_SUM, [a, b, one], 4, -1)
    engine.propagate()
    assert engine.runs < 50000


class AtLeastDouble(External):
    """The second argument is at least twice the first: an example of a constraint of a user."""

    def propagate(self, s: Store, c: int) -> bool:
        """Raise the second; refuse a first that is negative."""
        a, b = argument(s, c, 0), argument(s, c, 1)
        if is_single(s, a) and high(s, a) < 0:
            return refuse(s, c)
        return at_least(s, c, b, 2 * low(s, a))


def test_a_constraint_written_in_python_takes_part() -> None:
    engine = Engine()
    a = engine.new_interval(tags.KIND_INT, -5, 9, 0, -1)
    b = engine.new_interval(tags.KIND_INT, 0, 12, 0, -1)
    engine.post_external(AtLeastDouble(), [a, b], 1, -1)
    engine.restrict_base(a, 4, 9, 2, -1)
    assert engine.propagate() and engine.lower(b) == 8
    mark = engine.mark()
    engine.restrict_base(b, 0, 8, 3, -1)
    engine.restrict_base(a, 5, 9, 4, -1)
    assert not engine.propagate()
    assert {1, 3, 4} <= {cause.span for cause in engine.explain()}
    engine.rewind(mark)
    assert engine.lower(b) == 8


def test_after_a_creeping_cycle_small_steps_count_again() -> None:
    engine = Engine()
    x = engine.new_interval(tags.KIND_FLOAT, 0.0, 1e9, 0, -1)
    y = engine.new_interval(tags.KIND_FLOAT, 0.0, 1e9, 0, -1)
    engine.post(opcodes.OP_MUL_EQ, [y, engine.new_constant(tags.KIND_FLOAT, 0.9999, 0.9999), x], 1, -1)
    engine.post(opcodes.OP_EQ, [x, y], 2, -1)
    assert engine.propagate()
    v = engine.new_interval(tags.KIND_INT, 0, 10**6, 0, -1)
    assert engine.restrict_base(v, 1, 10**6, 3, -1) and engine.lower(v) == 1
