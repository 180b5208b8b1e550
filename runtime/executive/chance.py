"""Draw the values of sampled parameters: seed, parameter name and update index in, number out, nothing remembered.

A draw never depends on how often or in which order anybody asked (reference of T-REX, 3.4: constraints are executed an
unpredictable number of times, and again after backtracking). Only whole-number arithmetic, `+ - * /`, `sqrt` and
`frexp` are used, which IEEE 754 fixes to the last bit, so every machine draws the same values; `libm` is not called.
"""

from functools import lru_cache
from math import floor, frexp, sqrt

from runtime.executive.configuration import ParameterConfiguration
from runtime.executive.outcome import Draw

MASK = (1 << 64) - 1
GOLDEN = 0x9E3779B97F4A7C15  # 2**64 / golden ratio: the increment of SplitMix64 (Steele, Lea, Flood 2014)
SQRT_12 = 3.4641016151377544
BELOW_RANGE = 0.04163225833177522  # Phi(-sqrt(3)): a moment-matched normal lies below its range this often
LN_2_HIGH, LN_2_LOW = 6.93147180369123816490e-01, 1.90821492927058770002e-10  # ln 2 in two parts


def mix(word: int) -> int:
    """The 64-bit finaliser of SplitMix64: a bijection in which every input bit reaches every output bit."""
    word = ((word ^ (word >> 30)) * 0xBF58476D1CE4E5B9) & MASK
    word = ((word ^ (word >> 27)) * 0x94D049BB133111EB) & MASK
    return word ^ (word >> 31)


@lru_cache(maxsize=1024)
def stream(seed: int, name: str) -> int:
    """Where the stream of `name` starts: FNV-1a of its UTF-8 bytes, stirred together with the seed."""
    digest = 0xCBF29CE484222325
    for byte in name.encode("utf-8"):
        digest = ((digest ^ byte) * 0x100000001B3) & MASK
    return mix((mix((seed + GOLDEN) & MASK) + digest) & MASK)


def draw_bits(seed: int, name: str, index: int) -> int:
    """64 random bits: output `index` of SplitMix64 started at `stream(seed, name)`, reached without the ones before."""
    return mix((stream(seed, name) + (index + 1) * GOLDEN) & MASK)


def draw(seed: int, name: str, index: int) -> float:
    """A number in [0, 1), one of 2**53 equally likely ones."""
    return (draw_bits(seed, name, index) >> 11) / 9007199254740992.0


def update_index(parameter: ParameterConfiguration, tick: int) -> int:
    """How often `parameter` has been redrawn by `tick` (reference of T-REX, 3.4)."""
    return 0 if parameter.mode == "inter" else max(tick, 0) // parameter.update


def sample(parameter: ParameterConfiguration, seed: int, tick: int) -> Draw:
    """The value of `parameter` that is in force at `tick`, dated by the tick of its draw.

    `raw` is what the distribution gave, `value` the same rounded (whole parameters) and then clipped.
    """
    index = update_index(parameter, tick)
    raw = quantile(parameter, draw(seed, parameter.name, index))
    value = float(floor(raw + 0.5)) if parameter.is_whole else raw
    if parameter.clip is not None:
        value = min(max(value, parameter.clip[0]), parameter.clip[1])
    return Draw(parameter.name, 0 if parameter.mode == "inter" else index * parameter.update, raw, value)


def quantile(parameter: ParameterConfiguration, share: float) -> float:
    """The value below which `parameter` falls with probability `share`, which is in [0, 1).

    The normal has the mean and variance of the uniform over the same range (founding paper, section 4: "mu=(a+b)/2,
    sigma^2=(b-a)^2/12"), so 4.2 % of its draws lie beyond either end; "truncated_normal" is the same, held inside.
    """
    lower, upper = parameter.lower, parameter.upper
    match parameter.distribution:
        case "uniform":
            if parameter.is_whole:
                return min(lower + floor(share * (upper - lower + 1.0)), upper)
            return lower + share * (upper - lower)
        case "normal":
            return (lower + upper) / 2.0 + (upper - lower) / SQRT_12 * normal_quantile(_inner(share))
        case "truncated_normal":
            inside = BELOW_RANGE + _inner(share) * (1.0 - 2.0 * BELOW_RANGE)
            value = (lower + upper) / 2.0 + (upper - lower) / SQRT_12 * normal_quantile(inside)
            return min(max(value, lower), upper)
        case "discrete":
            return _pick(parameter.values, parameter.weights, share)
        case "fixed":
            return parameter.values[0]


def normal_quantile(share: float) -> float:
    """The inverse of the standard normal distribution function, for 0 < share < 1.

    Wichura's PPND16 (AS 241, Applied Statistics 37, 1988): relative error below 1e-15 in exact arithmetic; here below
    1e-14 for shares from 1e-300 to 1 - 1e-16.
    """
    offset = share - 0.5
    if abs(offset) <= 0.425:
        r = 0.180625 - offset * offset
        return offset * _ratio(r, CENTRE)
    tail = share if offset < 0.0 else 1.0 - share
    r = sqrt(-natural_logarithm(tail))
    value = _ratio(r - 1.6, MIDDLE) if r <= 5.0 else _ratio(r - 5.0, FAR)
    return -value if offset < 0.0 else value


def natural_logarithm(x: float) -> float:
    """ln x for a positive normal x, to 2 ulp: x = m * 2**e, ln m = 2 artanh((m - 1) / (m + 1)) as a series."""
    mantissa, exponent = frexp(x)
    if mantissa < 0.7071067811865476:
        mantissa, exponent = mantissa * 2.0, exponent - 1
    s = (mantissa - 1.0) / (mantissa + 1.0)  # |s| <= 0.1716, so the term after s**21/21 is below 2**-53
    square = s * s
    total = 0.0
    for odd in range(21, 1, -2):
        total = (total + 1.0 / odd) * square
    return exponent * LN_2_HIGH + (exponent * LN_2_LOW + 2.0 * s * total + 2.0 * s)


def _inner(share: float) -> float:
    """`share` moved to the middle of its cell of width 2**-52, so that 0 and 1 never occur."""
    return (floor(share * 4503599627370496.0) + 0.5) / 4503599627370496.0


def _pick(values: tuple[float, ...], weights: tuple[float, ...], share: float) -> float:
    """The value whose slice of [0, 1) holds `share`; slices are in the written order."""
    if not weights:
        return values[floor(share * len(values))]
    total = 0.0
    for weight in weights:
        total += weight
    reached = 0.0
    for value, weight in zip(values, weights, strict=True):
        reached += weight
        if share * total < reached:
            return value
    return values[-1]


def _ratio(r: float, coefficients: tuple[tuple[float, ...], tuple[float, ...]]) -> float:
    """A quotient of two polynomials, highest power first, by Horner's rule."""
    above = below = 0.0
    for a, b in zip(*coefficients, strict=True):
        above = above * r + a
        below = below * r + b
    return above / below


CENTRE = (
    (
        2509.0809287301226727,
        33430.575583588128105,
        67265.770927008700853,
        45921.953931549871457,
        13731.693765509461125,
        1971.5909503065514427,
        133.14166789178437745,
        3.387132872796366608,
    ),
    (
        5226.495278852545925,
        28729.085735721942674,
        39307.89580009271061,
        21213.794301586595867,
        5394.1960214247511077,
        687.1870074920579083,
        42.313330701600911252,
        1.0,
    ),
)
MIDDLE = (
    (
        7.7454501427834140764e-4,
        0.0227238449892691845833,
        0.24178072517745061177,
        1.27045825245236838258,
        3.64784832476320460504,
        5.7694972214606914055,
        4.6303378461565452959,
        1.42343711074968357734,
    ),
    (
        1.05075007164441684324e-9,
        5.475938084995344946e-4,
        0.0151986665636164571966,
        0.14810397642748007459,
        0.68976733498510000455,
        1.6763848301838038494,
        2.05319162663775882187,
        1.0,
    ),
)
FAR = (
    (
        2.01033439929228813265e-7,
        2.71155556874348757815e-5,
        0.0012426609473880784386,
        0.026532189526576123093,
        0.29656057182850489123,
        1.7848265399172913358,
        5.4637849111641143699,
        6.6579046435011037772,
    ),
    (
        2.04426310338993978564e-15,
        1.4215117583164458887e-7,
        1.8463183175100546818e-5,
        7.868691311456132591e-4,
        0.0148753612908506148525,
        0.13692988092273580531,
        0.59983220655588793769,
        1.0,
    ),
)
