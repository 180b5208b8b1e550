"""Random solutions of real-valued constraints, with domains laid around them: propagation must never lose one.

Solutions of arithmetic are kept as fractions, so that not even the last bit may be lost; those of other functions are
known to some units in the last place, and of positions on the earth within the stated tolerance.
"""

import math
import random
from collections.abc import Callable
from dataclasses import dataclass, field
from datetime import UTC, datetime
from fractions import Fraction
from typing import Any

from runtime.constraints.domains import tags
from runtime.constraints.engine import Engine
from runtime.constraints.propagators import opcodes
from tests.constraints import meaning

Function = Callable[..., Any]  # of fractions and whole numbers to such a number
WIDTHS = (0.0, 0.0, 1e-12, 1e-7, 9e-6, 0.001, 0.5, 3.0, 40.0, 1e4, math.inf)
FEW_BITS = 4e-15  # what a function of the machine's library may be wrong by, relatively
GROWTH = 1e12  # no larger numbers are drawn


@dataclass
class Tally:
    """What has been judged."""

    solutions: int = 0
    posts: dict[int, int] = field(default_factory=dict)
    narrowed: int = 0  # bounds that propagation moved


def product(*x: Fraction) -> Fraction:
    """Multiply exactly."""
    result = Fraction(1)
    for y in x:
        result *= y
    return result


# The operation, the places of its result and of its inputs, and the result.
EXACT: list[tuple[int, int, tuple[int, ...], Function]] = [
    (opcodes.OP_ADD_EQ, 2, (0, 1), lambda x, y: x + y),
    (opcodes.OP_ADD_EQ, 0, (2, 1), lambda x, y: x - y),
    (opcodes.OP_MUL_EQ, 2, (0, 1), lambda x, y: x * y),
    (opcodes.OP_DIV_EQ, 0, (1, 2), lambda x, y: x * y),
    (opcodes.OP_DIV_EQ, 2, (0, 1), lambda x, y: x / y),
    (opcodes.OP_MUL_EQ, 0, (2, 1), lambda x, y: x / y),
    (opcodes.OP_EQ_SUM, 0, (1, 2, 3, 4), lambda *x: sum(x)),
    (opcodes.OP_EQ_SUM, 2, (1, 0, 3), lambda x, y, z: y - x - z),
    (opcodes.OP_EQ_PRODUCT, 0, (1, 2, 3), product),
    (opcodes.OP_EQ_MAXIMUM, 0, (1, 2, 3), lambda *x: max(x)),
    (opcodes.OP_EQ_MINIMUM, 0, (1, 2), lambda *x: min(x)),
    (opcodes.OP_ALL_MAX, 3, (0, 1, 2), lambda *x: max(x)),
    (opcodes.OP_MAXF, 0, (1, 2, 3), lambda *x: max(x)),
    (opcodes.OP_MINF, 0, (1, 2), lambda *x: min(x)),
    (opcodes.OP_MAX, 0, (1, 2), lambda *x: max(x)),
    (opcodes.OP_MIN, 0, (1, 2), lambda *x: min(x)),
    (opcodes.OP_ABS_VAL, 0, (1,), abs),
    (opcodes.OP_ABSF, 0, (1,), abs),
    (opcodes.OP_ABS, 0, (1,), abs),
    (opcodes.OP_NEG, 0, (1,), lambda x: -x),
    (opcodes.OP_NEG, 1, (0,), lambda x: -x),
    (opcodes.OP_DIFF_SQUARE, 2, (0, 1), lambda x, y: (x - y) ** 2),
    (opcodes.OP_FLOORF, 0, (1,), math.floor),
    (opcodes.OP_CEILF, 0, (1,), math.ceil),
    (opcodes.OP_EQ, 0, (1,), lambda x: x),
    (opcodes.OP_SUBSET_OF, 0, (1,), lambda x: x),
]
# The operation, whether its result stands first (else second), the least and the greatest input, and the function.
CLOSE: list[tuple[int, float, float, Callable[[float], float]]] = [
    (opcodes.OP_SINF, -180.0, 180.0, lambda x: math.sin(math.radians(x))),
    (opcodes.OP_COSF, -180.0, 180.0, lambda x: math.cos(math.radians(x))),
    (opcodes.OP_SIN, -90.0, 90.0, lambda x: math.sin(math.radians(x))),
    (opcodes.OP_SQRTF, 0.0, 1e6, math.sqrt),
    (opcodes.OP_SQRT, 0.0, 1e6, math.sqrt),
    (opcodes.OP_EXPF, -30.0, 20.0, math.exp),
    (opcodes.OP_LOGF, 1e-3, 1e6, math.log),
    (opcodes.OP_DEG_TO_RAD, -720.0, 720.0, math.radians),
    (opcodes.OP_CIRCLE_MOD, -900.0, 900.0, meaning.angle),
]
ROUGHNESS = {opcodes.OP_SINF: 2e-9, opcodes.OP_COSF: 2e-9, opcodes.OP_SIN: 2e-9, opcodes.OP_CIRCLE_MOD: 2e-9}


@dataclass
class World:
    """Variables of an engine with the values of a solution, and how far each value may be from what was computed."""

    chance: random.Random
    engine: Engine = field(default_factory=Engine)
    values: list[Fraction] = field(default_factory=list)
    slack: list[float] = field(default_factory=list)

    def variable(self, value: Fraction, slack: float = 0.0) -> int:
        """Make a variable with a domain around a value; an int where the value is whole, now and then."""
        is_whole = value == int(value) and abs(value) < 2**40 and self.chance.random() < 0.4
        below, above = (self.chance.choice(WIDTHS) * self.chance.random() for _ in range(2))
        if is_whole:
            lo, hi = float(value) - math.floor(min(below, 1e9)), float(value) + math.floor(min(above, 1e9))
        else:
            lo = math.nextafter(float(value), -math.inf) - slack - below
            hi = math.nextafter(float(value), math.inf) + slack + above
        kind = tags.KIND_INT if is_whole else tags.KIND_FLOAT
        v = self.engine.new_interval(kind, lo, hi, len(self.values), -1)
        self.values.append(value)
        self.slack.append(slack)
        return v

    def any_value(self) -> Fraction:
        """Draw a value: small whole numbers, dyadic ones, and such with all bits."""
        dice = self.chance.random()
        if dice < 0.3:
            return Fraction(self.chance.randint(-9, 9))
        if dice < 0.5:
            return Fraction(self.chance.randint(-64, 64), 16)
        return Fraction(self.chance.uniform(-1.0, 1.0) * 10 ** self.chance.randint(-2, 4))

    def inputs(self, count: int) -> list[int]:
        """Choose variables that are there, or make new ones."""
        able = [v for v in range(len(self.values)) if self.slack[v] == 0.0]
        return [
            self.chance.choice(able) if able and self.chance.random() < 0.6 else self.variable(self.any_value())
            for _ in range(count)
        ]

    def check(self) -> None:
        """Each value must be within its bounds, but for rounding and for what it was computed with."""
        rounding = max(map(abs, self.values), default=Fraction(0)) * Fraction(2) ** -46
        for v, value in enumerate(self.values):
            lo, hi = self.engine.lower(v), self.engine.upper(v)
            slack = Fraction(self.slack[v]) + rounding
            assert lo == -math.inf or Fraction(lo) - slack <= value, f"{float(value)!r} lies below {lo!r}"
            assert hi == math.inf or value <= Fraction(hi) + slack, f"{float(value)!r} lies above {hi!r}"


def judge_reals(seed: int, tally: Tally) -> None:
    """Draw one solution with its constraints and domains; propagate, then close in on the solution."""
    world = World(random.Random(seed))
    for _ in range(world.chance.randint(1, 6)):
        world.chance.choice((add_exact, add_exact, add_close, add_earth))(world, tally)
    engine = world.engine
    before = [(engine.lower(v), engine.upper(v)) for v in range(len(world.values))]
    assert engine.propagate(), "a set with a solution is refuted"
    world.check()
    tally.solutions += 1
    tally.narrowed += sum(
        (lo < engine.lower(v)) + (hi > engine.upper(v)) for v, (lo, hi) in enumerate(before) if not engine.constant[v]
    )
    for v in world.chance.sample(range(len(world.values)), len(world.values)):
        value = float(world.values[v])
        width = world.chance.choice((0.0, 3e-6, 0.01, 2.0))
        lo = math.nextafter(value - world.slack[v] - width, -math.inf)
        hi = math.nextafter(value + world.slack[v] + width, math.inf)
        assert engine.restrict_base(v, lo, hi, 0, -1) and engine.propagate(), "closing in on a solution is refuted"
        world.check()


def post(world: World, tally: Tally, op: int, arguments: list[int]) -> None:
    """Post a constraint."""
    world.engine.post(op, arguments, 99, -1)
    tally.posts[op] = tally.posts.get(op, 0) + 1


def add_exact(world: World, tally: Tally) -> None:
    """Add a constraint whose result is a fraction."""
    op, place, inputs, function = world.chance.choice(EXACT)
    given = world.inputs(len(inputs))
    x = [world.values[v] for v in given]
    if op == opcodes.OP_DIV_EQ and (x[1] == 0 if place else x[0] == 0 or x[1] == 0):
        return
    if op == opcodes.OP_MUL_EQ and place == 0 and x[1] == 0:
        return
    value = Fraction(function(*x))
    if abs(value) > GROWTH or 0 < abs(value) < 1e-6 or value.denominator > 2**400:
        return
    if op in (opcodes.OP_FLOORF, opcodes.OP_CEILF) and abs(x[0] - round(x[0])) < 1e-4:
        return  # within the tolerance it counts as the whole number
    row = dict(zip((place, *inputs), (world.variable(value), *given), strict=True))
    post(world, tally, op, [row[k] for k in sorted(row)])


def add_close(world: World, tally: Tally) -> None:
    """Add a function of the machine's library."""
    op, least, most, function = world.chance.choice(CLOSE)
    x = world.chance.uniform(least, most)
    if world.chance.random() < 0.2:
        x = float(round(x / 30.0) * 30) if op != opcodes.OP_LOGF else 1.0
        x = min(max(x, least), most)
    if op == opcodes.OP_CIRCLE_MOD and abs(abs(function(x)) - 180.0) < 1e-3:
        return  # where one turn ends and the next begins
    value = function(x)
    slack = abs(value) * FEW_BITS + ROUGHNESS.get(op, 1e-15)
    post(world, tally, op, [world.variable(Fraction(value), slack), world.variable(Fraction(x))])


def add_earth(world: World, tally: Tally) -> None:
    """Add a date, a distance or a displacement on the earth, within what is stated of them."""
    chance = world.chance
    if chance.random() < 0.3:
        tick = chance.randint(0, 4_000_000_000)
        at = datetime.fromtimestamp(tick, UTC)
        date = (at.hour * 3600 + at.minute * 60 + at.second, at.timetuple().tm_yday, at.year)
        post(world, tally, opcodes.OP_TICK_DATE, [world.variable(Fraction(x)) for x in (tick, *date)])
        return
    here = (chance.uniform(-80, 80), chance.uniform(-170, 170))
    there = (here[0] + chance.uniform(-0.05, 0.05), here[1] + chance.uniform(-0.05, 0.05))
    north, east = meaning.displacement(*here, *there)
    a, b = ([world.variable(Fraction(x)) for x in place] for place in (here, there))
    match chance.randrange(3):
        case 0:
            d = world.variable(Fraction(meaning.sphere_distance(*here, *there)), meaning.METRES)
            post(world, tally, opcodes.OP_LL_DIST, [d, *a, *b])
        case 1:
            way = [world.variable(Fraction(x), meaning.METRES) for x in (north, east)]
            post(world, tally, opcodes.OP_WGS_DISPLACEMENT, [*a, *b, *way])
        case _:
            to = [world.variable(Fraction(x), meaning.DEGREES) for x in there]
            way = [world.variable(Fraction(x)) for x in (north, east)]
            post(world, tally, opcodes.OP_WGS_DISPLACE, [*a, *way, *to])
