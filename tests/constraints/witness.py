"""Walk to a solution of constraints: values at random, repaired one by one, until all constraints hold."""

import math
import random

from runtime.constraints.domains import tags
from runtime.constraints.propagators import opcodes
from tests.constraints import meaning
from tests.constraints.random_sets import Post, Problem, holds, may_have
from tests.constraints.signatures import OBJECTS, images

Values = dict[int, tuple[float, ...]]
WALKS = 30
STEPS = 15  # of one walk
FAR_TICK = 1e12
ROUNDED = (opcodes.OP_TRAVEL_TIME, opcodes.OP_TOWARDS, opcodes.OP_WGS_DISPLACE, opcodes.OP_WGS_DISPLACEMENT)
EQUATOR = 6378137.0  # metres
WIDE = 90  # a variable of which nothing is stated may start so far from 0
FAR = 1e6  # a vector so long has every direction, to the tolerance


def quick_order(posts: list[Post], values: dict[int, tuple[float, ...]]) -> list[int]:
    """Order variables so that constraints are due early: those with the fewest combinations of values first."""
    order: dict[int, None] = {}
    left = [arguments for _, arguments in posts]
    while left:
        sizes = [math.prod(len(values[v]) for v in set(arguments) if v not in order) for arguments in left]
        order |= dict.fromkeys(sorted(left.pop(sizes.index(min(sizes))), key=lambda v: len(values[v])))
    return list(order)


def anything(problem: Problem, v: int) -> tuple[float, ...]:
    """Give many values of the kind of a variable."""
    kind = problem.kinds[v]
    if kind == tags.KIND_BOOL:
        return (0, 1)
    if kind in (tags.KIND_SYMBOL, tags.KIND_STRING):
        return tuple(range(12))
    if kind == tags.KIND_OBJECT:
        return OBJECTS + meaning.UNBORN
    if kind == tags.KIND_INT:
        return tuple(dict.fromkeys((*problem.values[v], *range(-6, 12))))
    return tuple(dict.fromkeys((*problem.values[v], *(float(k) for k in range(-4, 5)))))


def walks_to_solution(posts: list[Post], kinds: list[int], values: Values, stated: set[int]) -> bool:
    """Tell whether some walk ends at a solution; variables that nothing is stated of may leave their values."""

    def drawn(chance: random.Random, v: int) -> float:
        if v not in stated and kinds[v] in (tags.KIND_INT, tags.KIND_FLOAT) and chance.random() < 0.2:
            return chance.randint(-WIDE, WIDE)
        return chance.choice(values[v])

    chance = random.Random(len(posts))
    names = sorted({v for _, arguments in posts for v in arguments})
    for _ in range(WALKS):
        x = {v: drawn(chance, v) for v in names}
        for _ in range(STEPS):
            wrong = [(op, row) for op, row in posts if not holds(op, [x[v] for v in row])]
            if not wrong:
                return True
            op, row = chance.choice(wrong)
            options = []
            for place, value in repairs(op, [x[v] for v in row]):
                v = row[place]
                value = round(value) if op in ROUNDED and kinds[v] != tags.KIND_FLOAT else value
                if v not in stated:
                    options += [(v, value)] if is_able(kinds[v], value) else []
                else:
                    options += [(v, y) for y in values[v] if y != x[v] and meaning.near(y, value)]
            if options and chance.random() < 0.8:
                v, value = chance.choice(options)
            else:
                v = chance.choice(row)
                value = drawn(chance, v)
            x[v] = value
    return False


def is_able(kind: int, value: float) -> bool:
    """Tell whether a variable of a kind may have a value, however far away."""
    return may_have(kind, value) or (FAR_TICK > abs(value) > 1.0 and kind != tags.KIND_BOOL and value == int(value))


def repairs(op: int, x: list[float]) -> list[tuple[int, float]]:
    """Give values of single arguments, by place, with which a constraint may hold."""
    try:
        match op:
            case opcodes.OP_TICK_DATE:
                return [*images(op, x), (0, (meaning.days_before(int(x[3])) + x[2] - 1) * 86400.0 + x[1])]
            case opcodes.OP_TRAVEL_TIME:
                found = images(op, x)
                if x[5] <= 0.0:
                    found += [(0, 1.0), (1, x[3]), (2, x[4]), (3, x[1]), (4, x[2])]
                for part in (0.999, 0.6) if x[5] > 0.0 else ():
                    way = (x[0] - 1.0 + part) * x[5]
                    for k, j in ((1, 3), (3, 1), (2, 4), (4, 2)):
                        other = x[2] - x[4] if k % 2 else x[1] - x[3]
                        if abs(way) >= abs(other):
                            root = math.sqrt(way**2 - other**2)
                            found += [(k, x[j] + root), (k, x[j] - root)]
                    if x[0] > 0:
                        found.append((5, math.hypot(x[3] - x[1], x[4] - x[2]) / (x[0] - 1.0 + part)))
                return found
            case opcodes.OP_TOWARDS:
                found = images(op, x)
                for k, (u, other) in enumerate(((x[0], x[1]), (x[1], x[0]))):
                    rest = math.sqrt(max(0.0, 1.0 - other * other))
                    found += [(k, rest), (k, -rest)]
                    for far in (FAR, abs(x[5 - k] - x[3 - k]) / max(1e-9, abs(other))):
                        found += [(4 + k, x[2 + k] + u * far), (2 + k, x[4 + k] - u * far)]
                return found
            case opcodes.OP_LL_DIST:
                return [*images(op, x), *positions_apart(x)]
            case opcodes.OP_WGS_DISPLACEMENT:
                return [*images(op, x), *displaced(x[:4], x[4:], (0, 1, 2, 3, 4, 5))]
            case opcodes.OP_WGS_DISPLACE:
                return [*images(op, x), *displaced([x[0], x[1], x[4], x[5]], x[2:4], (0, 1, 4, 5, 2, 3))]
    except (ValueError, ZeroDivisionError, OverflowError):
        return []
    return images(op, x)


def positions_apart(x: list[float]) -> list[tuple[int, float]]:
    """Give latitudes and longitudes with which two positions are x[0] apart: where a cosine has a value."""
    share = math.cos(x[0] / 6371008.8)
    found = []
    for k, j in ((1, 3), (3, 1)):
        a = meaning.unit(x[j], x[j + 1])
        toward = math.radians(x[k + 1])
        lat = math.radians(x[k])
        flat = a[0] * math.cos(toward) + a[1] * math.sin(toward)
        found += [(k, y) for y in turns(flat, a[2], share)]
        found += [(k + 1, y) for y in turns(a[0] * math.cos(lat), a[1] * math.cos(lat), share - a[2] * math.sin(lat))]
    return found


def turns(a: float, b: float, c: float) -> list[float]:
    """Give the angles y in degrees with a cos y + b sin y = c."""
    size = math.hypot(a, b)
    if size < 1e-12 or abs(c) > size:
        return []
    middle, aside = math.atan2(b, a), math.acos(c / size)
    return [math.degrees(middle + aside), math.degrees(middle - aside)]


def displaced(place: list[float], way: list[float], places: tuple[int, ...]) -> list[tuple[int, float]]:
    """Give single changes to two positions or to the way between them, so that it is so far north, or so far east."""
    north, east = meaning.displacement(*place)
    found = [(places[4], north), (places[5], east)]
    across = way[1] / (EQUATOR * math.sin(math.radians(place[3] - place[1]))) if place[1] != place[3] else 0.0
    near_pole = math.degrees(math.acos(across)) if 0.0 < across < 1.0 else place[2]
    for k in range(4):
        for wanted in range(2):
            moved = list(place)
            if (k, wanted) == (2, 1):
                moved[2] = math.copysign(near_pole, place[2])
            for _ in range(8):
                wrong = way[wanted] - meaning.displacement(*moved)[wanted]
                beside = list(moved)
                beside[k] += 1e-4
                slope = (meaning.displacement(*beside)[wanted] - meaning.displacement(*moved)[wanted]) / 1e-4
                if abs(slope) > 1e-3:
                    moved[k] += max(-30.0, min(30.0, wrong / slope))
            found.append((places[k], moved[k]))
    return found
