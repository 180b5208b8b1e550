"""The quantile of the standard normal distribution, the same to the last bit on every machine.

Only `+ - * /`, `sqrt` and `frexp` are used, which IEEE 754 fixes to the last bit; `libm` is not called.
"""

from math import frexp, sqrt

_LN_2_HIGH, _LN_2_LOW = 6.93147180369123816490e-01, 1.90821492927058770002e-10  # ln 2 in two parts


def normal_quantile(share: float) -> float:
    """The inverse of the standard normal distribution function, for 0 < share < 1.

    Wichura's PPND16 (AS 241, Applied Statistics 37, 1988): relative error below 1e-15 in exact arithmetic; here below
    1e-14 for shares from 1e-300 to 1 - 1e-16.
    """
    offset = share - 0.5
    if abs(offset) <= 0.425:
        r = 0.180625 - offset * offset
        return offset * _ratio(r, _CENTRE)
    tail = share if offset < 0.0 else 1.0 - share
    r = sqrt(-natural_logarithm(tail))
    value = _ratio(r - 1.6, _MIDDLE) if r <= 5.0 else _ratio(r - 5.0, _FAR)
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
    return exponent * _LN_2_HIGH + (exponent * _LN_2_LOW + 2.0 * s * total + 2.0 * s)


def _ratio(r: float, coefficients: tuple[tuple[float, ...], tuple[float, ...]]) -> float:
    """A quotient of two polynomials, highest power first, by Horner's rule."""
    above = below = 0.0
    for a, b in zip(*coefficients, strict=True):
        above = above * r + a
        below = below * r + b
    return above / below


_CENTRE = (
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
_MIDDLE = (
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
_FAR = (
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
