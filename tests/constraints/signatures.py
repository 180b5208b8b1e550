"""What arguments random constraints have: kinds, numbers of them, values, and what results follow from inputs."""

import math
import random
from collections.abc import Callable
from dataclasses import dataclass

from runtime.constraints.domains import tags
from runtime.constraints.propagators import opcodes
from tests.constraints import meaning

# Letters: b bool, i int, f float, n any number, s what compares (ints, bools, symbols), y symbol or text, o object,
# C constant set of whole numbers, K constant object. A `*` behind a letter: one to three more of it.
KINDS = {
    "b": (tags.KIND_BOOL,),
    "i": (tags.KIND_INT,),
    "f": (tags.KIND_FLOAT,),
    "n": (tags.KIND_INT, tags.KIND_FLOAT),
    "s": (tags.KIND_INT, tags.KIND_BOOL, tags.KIND_INT),
    "y": (tags.KIND_SYMBOL, tags.KIND_STRING),
    "o": (tags.KIND_OBJECT,),
    "C": (tags.KIND_INT,),
    "K": (tags.KIND_OBJECT,),
}
OBJECTS = tuple(float(k) for k in range(8))


@dataclass(frozen=True)
class Signature:
    """The arguments of one operation: one of some forms, a letter for each."""

    forms: tuple[str, ...]
    is_strict: bool = False  # whether no argument may stand twice

    def draw(self, chance: random.Random) -> str:
        """Choose a form and how many arguments there are."""
        form = chance.choice(self.forms)
        if form.endswith("*"):
            form = form[:-1] + form[-2] * chance.randint(0, 2)
        return form

    def fits(self, letter: str, kind: int) -> bool:
        """Tell whether a variable may stand where a letter does."""
        return kind in KINDS[letter]


def forms(*texts: str, is_strict: bool = False) -> Signature:
    """Make a signature."""
    return Signature(texts, is_strict)


SAME = ("ss", "yy", "oo", "nn", "ff")
MANY = ("sss*", "yyy*", "ooo*", "nn*", "ff*")
TESTS = ("bss", "byy", "boo", "bnn", "bff")
SIGNATURES: dict[int, Signature] = {
    opcodes.OP_EQ: forms(*SAME, *MANY),
    opcodes.OP_NEQ: forms(*SAME),
    opcodes.OP_LT: forms("ii", "nn", "ff", "ss"),
    opcodes.OP_LEQ: forms("ii", "nn", "ff", "ss"),
    opcodes.OP_ALL_DIFF: forms(*MANY),
    opcodes.OP_TEMPORAL_DISTANCE: forms("iii", "ifi"),
    opcodes.OP_WITHIN_BOUNDS: forms("nnn", "iii"),
    opcodes.OP_ADD_EQ: forms("iii", "nnn", "fff", "iCi"),
    opcodes.OP_MUL_EQ: forms("iii", "nnn", "fff"),
    opcodes.OP_DIV_EQ: forms("iii", "nnn", "fff"),
    opcodes.OP_EQ_SUM: forms("iii*", "nnn*", "ibb*"),
    opcodes.OP_EQ_PRODUCT: forms("iii*", "nnn*"),
    opcodes.OP_EQ_MINIMUM: forms("iii*", "nnn*"),
    opcodes.OP_EQ_MAXIMUM: forms("iii*", "nnn*"),
    opcodes.OP_ALL_MIN: forms("iii*", "nnn*"),
    opcodes.OP_ALL_MAX: forms("iii*", "nnn*"),
    opcodes.OP_ABS_VAL: forms("ii", "nn"),
    opcodes.OP_NEG: forms("ii", "nn"),
    opcodes.OP_DIFF_SQUARE: forms("iii", "nnn", "fff"),
    opcodes.OP_CALC_DISTANCE: forms("fiiii", "fnnnn"),
    opcodes.OP_DISTANCE_SQUARES: forms("iif", "nnf"),
    opcodes.OP_TEST_EQ: forms(*TESTS),
    opcodes.OP_TEST_NEQ: forms(*TESTS),
    opcodes.OP_TEST_LEQ: forms("bss", "bnn", "bff"),
    opcodes.OP_TEST_LT: forms("bss", "bnn", "bff"),
    opcodes.OP_TEST_AND: forms("bbb", "bss"),
    opcodes.OP_TEST_OR: forms("bbb", "bss"),
    opcodes.OP_OR: forms("bb*", "s*"),
    opcodes.OP_COUNT_ZEROES: forms("ibb*", "iss*", "inn*"),
    opcodes.OP_COUNT_NON_ZEROES: forms("ibb*", "iss*", "inn*"),
    opcodes.OP_COND_ALL_DIFF: forms("bsss*", "byyy*", "bnn*"),
    opcodes.OP_COND_EQ: forms("bsss*", "byyy*", "bnn*"),
    opcodes.OP_TEST_SINGLETON: forms("bs", "by"),
    opcodes.OP_TEST_SPECIFIED: forms("bs", "by"),
    opcodes.OP_SUBSET_OF: forms("ii", "yy", "oo"),
    opcodes.OP_EQ_UNION: forms("iii*", "nn*"),
    opcodes.OP_ELEMENT: forms("iiiii", "fiff", "yiyy", "oioo"),
    opcodes.OP_HAS_ANCESTOR: forms("oo"),
    opcodes.OP_COMMON_ANCESTOR: forms("ooo"),
    opcodes.OP_ABS: forms("nn", "ii"),
    opcodes.OP_SQRT: forms("fn", "ii"),
    opcodes.OP_FLOOR: forms("in", "ff"),
    opcodes.OP_CEIL: forms("in", "ff"),
    opcodes.OP_MAX: forms("nnn", "iii"),
    opcodes.OP_MIN: forms("nnn", "iii"),
    opcodes.OP_POW: forms("fni", "fii"),
    opcodes.OP_MOD: forms("iii", "fnn"),
    opcodes.OP_SIN: forms("fn"),
    opcodes.OP_SAMPLE: forms("ii", "ff"),
    opcodes.OP_TRAVEL_TIME: forms("iiiiif"),
    opcodes.OP_TOWARDS: forms("ffiiii"),
    opcodes.OP_SINF: forms("fi", "ff"),
    opcodes.OP_COSF: forms("fi", "ff"),
    opcodes.OP_SQRTF: forms("fn", "ii"),
    opcodes.OP_ABSF: forms("nn", "ii"),
    opcodes.OP_FLOORF: forms("in", "ff"),
    opcodes.OP_CEILF: forms("in", "ff"),
    opcodes.OP_MAXF: forms("nnn*", "iii*"),
    opcodes.OP_MINF: forms("nnn*", "iii*"),
    opcodes.OP_EXPF: forms("fn"),
    opcodes.OP_LOGF: forms("fn"),
    opcodes.OP_DEG_TO_RAD: forms("fn"),
    opcodes.OP_CIRCLE_MOD: forms("in", "fn"),
    opcodes.OP_TICK_DATE: forms("iiii"),
    opcodes.OP_LL_DIST: forms("fnnnn"),
    opcodes.OP_WGS_DISPLACE: forms("nnnnff"),
    opcodes.OP_WGS_DISPLACEMENT: forms("nnnnff"),
    opcodes.OP_WATCH: forms("s*", "nn"),
    opcodes.OP_EXTERNAL: forms("ii", "iii"),
    opcodes.OP_NOTHING: forms("nn"),
}
ANGLES = (-180.0, -90.0, -45.0, 0.0, 30.0, 60.0, 90.0, 135.0, 180.0, 270.0, 400.0)
# Functions that act once their arguments are known; drawn more rarely, for a conflict of theirs names all arguments.
FORWARD = (
    opcodes.OP_ABS,
    opcodes.OP_SQRT,
    opcodes.OP_FLOOR,
    opcodes.OP_CEIL,
    opcodes.OP_MAX,
    opcodes.OP_MIN,
    opcodes.OP_POW,
    opcodes.OP_MOD,
    opcodes.OP_SIN,
    opcodes.OP_SAMPLE,
    opcodes.OP_DISTANCE_SQUARES,
    opcodes.OP_CALC_DISTANCE,
    opcodes.OP_TRAVEL_TIME,
    opcodes.OP_TOWARDS,
    opcodes.OP_TICK_DATE,
    opcodes.OP_LL_DIST,
    opcodes.OP_WGS_DISPLACE,
    opcodes.OP_WGS_DISPLACEMENT,
)
OTHERS = tuple(op for op in SIGNATURES if op not in FORWARD)
TURNING = (opcodes.OP_SIN, opcodes.OP_SINF, opcodes.OP_COSF, opcodes.OP_DEG_TO_RAD, opcodes.OP_CIRCLE_MOD)


def draw_values(chance: random.Random, op: int, letter: str, place: int) -> tuple[int, tuple[float, ...]]:
    """Draw the kind and the values of a new variable."""
    kind = chance.choice(KINDS[letter])
    if kind == tags.KIND_BOOL:
        return kind, (0, 1) if chance.random() < 0.8 else (chance.randint(0, 1),)
    if kind == tags.KIND_OBJECT:
        return kind, tuple(sorted(chance.sample(OBJECTS, 1 if letter == "K" else chance.randint(1, 4))))
    if op == opcodes.OP_TICK_DATE and place == 0:
        return kind, tuple(sorted(chance.sample((0, 86399, 86400 * 59, 951_782_400 + 5, 1_735_689_600), 2)))
    if kind == tags.KIND_FLOAT:
        pool = ANGLES if op in TURNING and place else tuple(k / 4.0 for k in range(-8, 13))
        return kind, tuple(sorted(chance.sample(pool, chance.choice((1, 1, 2, 3)))))
    if op in TURNING and place:
        return kind, tuple(sorted(chance.sample(ANGLES, chance.randint(1, 3))))
    lo = chance.randint(-4, 4)
    width = 1 if letter == "C" else chance.randint(1, 5)
    values = [float(x) for x in range(lo, lo + width)]
    if chance.random() < 0.3:
        values = sorted(chance.sample(values, chance.randint(1, len(values))))
    return kind, tuple(x + 4 for x in values) if kind in (tags.KIND_SYMBOL, tags.KIND_STRING) else tuple(values)


def quotient(place: int, x: float, y: float) -> list[tuple[int, float]]:
    """Divide, if that can be done."""
    return [(place, x / y)] if y else []


def remainder(x: list[float]) -> list[tuple[int, float]]:
    """Give the rest of a division, if there is one."""
    return [(0, math.fmod(x[1], x[2]))] if x[2] else []


def roots(place: int, x: float, y: float) -> list[tuple[int, float]]:
    """Give what lies a root away from y."""
    return [(place, y + math.sqrt(x)), (place, y - math.sqrt(x))] if x >= 0 else []


def logarithm(place: int, x: float) -> list[tuple[int, float]]:
    """Give a logarithm, if there is one."""
    return [(place, math.log(x))] if x > 0 else []


def arc(function: Callable[[float], float], x: float) -> list[tuple[int, float]]:
    """Give an angle in degrees, if there is one."""
    return [(1, math.degrees(function(x)))] if -1 <= x <= 1 else []


def images(op: int, x: list[float]) -> list[tuple[int, float]]:
    """Give results that follow from the other arguments, by place; the given values at these places do not matter."""
    try:
        match op:
            case opcodes.OP_ADD_EQ:
                return [(2, x[0] + x[1]), (0, x[2] - x[1]), (1, x[2] - x[0])]
            case opcodes.OP_TEMPORAL_DISTANCE:
                return [(2, x[0] + x[1]), (0, x[2] - x[1]), (1, x[2] - x[0])]
            case opcodes.OP_MUL_EQ:
                return [(2, x[0] * x[1]), *quotient(0, x[2], x[1]), *quotient(1, x[2], x[0])]
            case opcodes.OP_DIV_EQ:
                return [(0, x[1] * x[2]), *quotient(1, x[0], x[2]), *quotient(2, x[0], x[1])]
            case opcodes.OP_EQ_SUM:
                return [(0, sum(x[1:])), (1, x[0] - sum(x[2:]))]
            case opcodes.OP_EQ_PRODUCT:
                others = math.prod(x[2:])
                return [(0, x[1] * others), *quotient(1, x[0], others)]
            case opcodes.OP_NEG:
                return [(0, -x[1]), (1, -x[0])]
            case opcodes.OP_DIFF_SQUARE:
                return [(2, (x[0] - x[1]) ** 2), *roots(0, x[2], x[1]), *roots(1, x[2], x[0])]
            case opcodes.OP_CALC_DISTANCE:
                found = [(0, math.hypot(x[1] - x[3], x[2] - x[4]))]
                for k, j in ((1, 3), (3, 1), (2, 4), (4, 2)):
                    other = x[2] - x[4] if k % 2 else x[1] - x[3]
                    found += roots(k, x[0] ** 2 - other**2, x[j])
                return found
            case opcodes.OP_DISTANCE_SQUARES:
                return [(0, x[2] ** 2 - x[1]), (1, x[2] ** 2 - x[0]), *roots(2, x[0] + x[1], 0.0)]
            case opcodes.OP_SQRT | opcodes.OP_SQRTF:
                return [(1, x[0] * x[0]), *roots(0, x[1], 0.0)]
            case opcodes.OP_ABS | opcodes.OP_ABSF | opcodes.OP_ABS_VAL:
                return [(0, abs(x[1])), (1, x[0]), (1, -x[0])]
            case opcodes.OP_MAX | opcodes.OP_MIN:
                return [(1, x[0]), (2, x[0])]
            case opcodes.OP_SAMPLE:
                return [(0, x[1]), (1, x[0])]
            case opcodes.OP_POW:
                root = abs(x[0]) ** (1.0 / x[2])
                return [(0, float(x[1] ** x[2])), (1, root), (1, -root)]
            case opcodes.OP_MOD:
                return [(1, x[0]), (2, x[1] - x[0]), (2, x[0] - x[1]), *remainder(x)]
            case opcodes.OP_FLOOR | opcodes.OP_FLOORF:
                return [(0, math.floor(x[1])), (1, x[0])]
            case opcodes.OP_CEIL | opcodes.OP_CEILF:
                return [(0, math.ceil(x[1])), (1, x[0])]
            case opcodes.OP_SIN:
                return [(0, math.sin(math.radians(min(max(x[1], -90), 90)))), *arc(math.asin, x[0])]
            case opcodes.OP_SINF:
                return [(0, math.sin(math.radians(x[1]))), *arc(math.asin, x[0])]
            case opcodes.OP_COSF:
                return [(0, math.cos(math.radians(x[1]))), *arc(math.acos, x[0])]
            case opcodes.OP_EXPF:
                return [(0, math.exp(x[1])), *logarithm(1, x[0])]
            case opcodes.OP_LOGF:
                return [(1, math.exp(x[0])), *logarithm(0, x[1])]
            case opcodes.OP_DEG_TO_RAD:
                return [(0, math.radians(x[1])), (1, math.degrees(x[0]))]
            case opcodes.OP_CIRCLE_MOD:
                return [(0, meaning.angle(x[1])), (1, x[0])]
            case opcodes.OP_TRAVEL_TIME:
                return [(0, max(1.0, math.ceil(math.hypot(x[3] - x[1], x[4] - x[2]) / x[5])))]
            case opcodes.OP_TOWARDS:
                distance = math.hypot(x[4] - x[2], x[5] - x[3]) or 1.0
                return [(0, (x[4] - x[2]) / distance), (1, (x[5] - x[3]) / distance)]
            case opcodes.OP_LL_DIST:
                return [(0, meaning.sphere_distance(*x[1:]))]
            case opcodes.OP_WGS_DISPLACEMENT:
                north, east = meaning.displacement(*x[:4])
                return [(4, north), (5, east)]
            case opcodes.OP_WGS_DISPLACE:
                return [(4, x[0] + x[2] / 110_574.0), (5, x[1] + x[3] / 111_320.0 / math.cos(math.radians(x[0])))]
            case opcodes.OP_TICK_DATE:
                days = int(x[0]) // 86400
                return [(1, x[0] % 86400), (2, days % 365 + 1), (3, 1970 + days // 365)]
    except (ValueError, ZeroDivisionError, OverflowError):
        return []
    return []
