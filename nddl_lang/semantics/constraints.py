"""The named constraints: what each takes and means, and where EUROPA differs, as data."""

from dataclasses import dataclass
from enum import Enum

from nddl_lang.semantics.signature import Signature, signature


class Origin(Enum):
    """Who brings a constraint or function along."""

    EUROPA = "EUROPA"
    TREX = "T-REX"
    NDDLC = "nddlc"
    USER = "a Python module of this project"


@dataclass(frozen=True, slots=True)
class ConstraintRow:
    """One named constraint.

    `result` is the place of the argument that the others determine (-1 the last one, None where there is no such);
    `forward_only`: it waits until all other arguments are known. `is_reified`: the first argument is the truth value.
    `europa` says where EUROPA behaves otherwise. `since` and `until` are the years of EUROPA's history, where known.
    """

    name: str
    signature: Signature
    result: int | None
    meaning: str
    origin: Origin = Origin.EUROPA
    alias_of: str | None = None
    forward_only: bool = False
    is_reified: bool = False
    europa: str | None = None
    since: str | None = "2015"


_LITERAL_ONLY = "EUROPA takes only the literals `true` and `false` as the truth value."


def _row(name: str, places: str, result: int | None, meaning: str, europa: str | None = None) -> ConstraintRow:
    return ConstraintRow(name, signature(places), result, meaning, europa=europa)


def _forward(name: str, places: str, result: int | None, meaning: str) -> ConstraintRow:
    return ConstraintRow(name, signature(places), result, meaning, forward_only=True)


def _reified(name: str, places: str, meaning: str) -> ConstraintRow:
    return ConstraintRow(name, signature(places), 0, meaning, is_reified=True, europa=_LITERAL_ONLY)


def _alias(name: str, other: ConstraintRow) -> ConstraintRow:
    return ConstraintRow(
        name,
        other.signature,
        other.result,
        other.meaning,
        other.origin,
        other.name,
        other.forward_only,
        other.is_reified,
        other.europa,
    )


def _added(origin: Origin, name: str, places: str, result: int | None, meaning: str, forward: bool) -> ConstraintRow:
    return ConstraintRow(name, signature(places), result, meaning, origin, forward_only=forward, since=None)


_ADD = _row("addEq", "a:number b:number sum:number", -1, "a + b = sum")
_MUL = _row("mulEq", "a:number b:number product:number", -1, "a × b = product")
_MAXIMUM = _row("eqMaximum", "result:number x:number y:number rest*:number", 0, "result is the greatest of the rest")
_MINIMUM = _row("eqMinimum", "result:number x:number y:number rest*:number", 0, "result is the least of the rest")
_ALL_MAX = _row(
    "allMax", "x:number y:number result:number rest*:number", -1, "the last one is the greatest of the others"
)
_ALL_MIN = _row("allMin", "x:number y:number result:number rest*:number", -1, "the last one is the least of the others")

_ARITHMETIC = (
    _ADD,
    _MUL,
    _alias("multEq", _MUL),
    _row(
        "divEq",
        "a:number b:number quotient:number",
        -1,
        "a ÷ b = quotient; whole numbers must divide without rest, and b is not 0",
    ),
    _row("eqSum", "result:number x:number y:number rest*:number", 0, "result is the sum of the rest"),
    _row("eqProduct", "result:number x:number y:number rest*:number", 0, "result is the product of the rest"),
    _MINIMUM,
    _MAXIMUM,
    _ALL_MIN,
    _alias("min", _ALL_MIN),
    _ALL_MAX,
    _alias("max", _ALL_MAX),
    _row("absVal", "result:number x:number", 0, "result is the absolute value of x"),
    _row("neg", "x:number y:number", -1, "x = -y"),
    _forward("abs", "result:number x:number", 0, "result is the absolute value of x, once x is known"),
    _forward("sqrt", "result:number x:number", 0, "result is the square root of x, once x is known"),
    _forward("floor", "result:number x:number", 0, "result is x rounded down, once x is known"),
    _forward("ceil", "result:number x:number", 0, "result is x rounded up, once x is known"),
    _forward("maxf", "result:number a:number b:number", 0, "result is the greater of a and b, once both are known"),
    _forward("minf", "result:number a:number b:number", 0, "result is the smaller of a and b, once both are known"),
    _forward("pow", "result:number a:number b:number", 0, "result is a to the power of b, once both are known"),
    _forward("mod", "result:number a:number b:number", 0, "result is the rest of a ÷ b, once both are known"),
    _row("sin", "result:number angle:number", 0, "result is the sine of the angle in degrees, within -90 to 90"),
    _row("rand", "result:number", 0, "result is a random whole number from 0 to 32767, fixed once"),
    _row(
        "calcDistance",
        "distance:number x1:number y1:number x2:number y2:number",
        0,
        "distance is that of the points (x1, y1) and (x2, y2)",
    ),
    _forward("distanceSquares", "a:number b:number r:number", -1, "r is the root of a + b, once both are known"),
    _forward("diffSquare", "a:number b:number r:number", -1, "r is the square of a - b, once both are known"),
    _row("withinBounds", "x:number lower:number upper:number", None, "least value of lower <= x <= greatest of upper"),
)

_COMPARISON = (
    _row("eq", "x:same y:same rest*:same", None, "all arguments are equal"),
    _row("neq", "x:same y:same", None, "x and y differ"),
    _row("lt", "x:number y:number", None, "x < y"),
    _row("leq", "x:number y:number", None, "x <= y"),
    _row("allDiff", "x:same y:same rest*:same", None, "all arguments differ from each other"),
    _row("or", "x:number rest*:number", None, "at least one argument is true (not 0)"),
    _row("countZeroes", "count:number x:number rest*:number", 0, "count of the rest are 0 or false"),
    _row("countNonZeroes", "count:number x:number rest*:number", 0, "count of the rest are neither 0 nor false"),
    _row("subsetOf", "x:same y:same", None, "x takes only values that y may take"),
    _row("eqUnion", "result:same x:same rest*:same", 0, "result is the union of the rest (intervals: its hull)"),
    _row("memberImply", "a:any b:any c:any d:any", None, "if b lies within c, then a lies within d"),
    _row("lockCT", "x:same domain:same", None, "x's domain becomes exactly the given one"),
)

_REIFIED = (
    _reified("testEq", "truth:bool x:same y:same", "truth tells whether x == y"),
    _reified("testNeq", "truth:bool x:same y:same", "truth tells whether x != y"),
    _reified("testLeq", "truth:bool x:number y:number", "truth tells whether x <= y"),
    _reified("testLessThan", "truth:bool x:number y:number", "truth tells whether x < y"),
    _reified("testAnd", "truth:bool x:bool y:bool", "truth tells whether both x and y hold"),
    _reified("testOr", "truth:bool x:bool y:bool", "truth tells whether x or y holds"),
    _reified("condAllDiff", "truth:bool x:same y:same rest*:same", "truth tells whether the rest all differ"),
    _reified("condEq", "truth:bool x:same y:same rest*:same", "truth tells whether the rest are all equal"),
    _reified("testSingleton", "truth:bool x:any", "truth tells whether x has a single value"),
    _reified("testSpecified", "truth:bool x:any", "truth tells whether the value of x was given"),
)

_STRUCTURE = (
    _row("commonAncestor", "x:object y:object ancestors:object", None, "x and y lie inside the same one of ancestors"),
    _row("hasAncestor", "x:object ancestors:object", None, "x was created by the constructor of one of ancestors"),
    _row(
        "uses",
        "resource:resource quantity:number start:number end:number",
        None,
        "quantity of the resource is in use from start to end",
    ),
    _row("concurrent", "a:number b:number", None, "both times are equal"),
    _row("precedes", "a:number b:number", None, "a is no later than b"),
    _row("strictlyPrecedes", "a:number b:number", None, "a is earlier than b"),
    _row("temporalDistance", "a:number distance:number b:number", None, "b - a lies in distance"),
)

_TREX = tuple(
    _added(Origin.TREX, *row)
    for row in (
        ("isExternal", "truth:bool timeline:object", 0, "truth tells whether the timeline is owned elsewhere", True),
        ("isInternal", "truth:bool timeline:object", 0, "truth tells whether the timeline is owned here", True),
        ("tick_date", "tick:number seconds:number day:number year:number", 0, "tick is that of the date", True),
        ("circle_mod", "angle:number value:number", 0, "angle is value brought within one turn, in degrees", True),
        ("deg_to_rad", "radians:number degrees:number", 0, "radians is the angle given in degrees", False),
        ("cosf", "result:number angle:number", 0, "result is the cosine of the angle in degrees", False),
        ("sinf", "result:number angle:number", 0, "result is the sine of the angle in degrees", False),
        ("absf", "result:number x:number", 0, "result is the absolute value of x", False),
        ("sqrtf", "result:number x:number", 0, "result is the square root of x", False),
        ("ceilf", "result:number x:number", 0, "result is x rounded up", False),
        ("floorf", "result:number x:number", 0, "result is x rounded down", False),
        ("expf", "result:number x:number", 0, "result is e to the power of x", False),
        ("logf", "result:number x:number", 0, "result is the natural logarithm of x", False),
        (
            "bind",
            "target:same default:same",
            None,
            "target takes the value nearest to default",
            True,
        ),
        ("ll_offset", "lat:number lon:number north:number east:number rest*:number", None, "no effect", True),
        ("ll_dist", "d:number lat1:number lon1:number lat2:number lon2:number", 0, "d is their distance", True),
        ("sane_pos", "lat:number lon:number rest*:number", None, "the position lies on the earth", True),
        (
            "wgsdisplace",
            "lat:number lon:number north:number east:number latR:number lonR:number",
            None,
            "(latR, lonR) is (lat, lon) moved by north and east",
            True,
        ),
        (
            "wgsdisplacement",
            "lat:number lon:number latR:number lonR:number north:number east:number",
            None,
            "north and east lead from (lat, lon) to (latR, lonR)",
            True,
        ),
        ("is_empty", "truth:bool path:any", 0, "truth tells whether the path has no point", True),
        ("car", "point:any path:any", 0, "point is the first of the path", True),
        ("cdr", "rest:any path:any", 0, "rest is the path without its first point", True),
    )
)

_OURS = tuple(
    _added(Origin.NDDLC, *row)
    for row in (
        (
            "sampledParameter",
            "value:number parameter:parameter",
            0,
            "value is what the mission draws for the parameter",
            True,
        ),
        (
            "travelTime",
            "ticks:number xa:number ya:number xb:number yb:number speed:number",
            0,
            "ticks is the time from (xa, ya) to (xb, yb) at the speed, rounded up, at least 1",
            True,
        ),
        (
            "towards",
            "ux:number uy:number x:number y:number tx:number ty:number",
            None,
            "(ux, uy) is the unit vector from (x, y) to (tx, ty), (0, 0) where they coincide",
            True,
        ),
    )
)

CONSTRAINTS: dict[str, ConstraintRow] = {
    row.name: row for rows in (_ARITHMETIC, _COMPARISON, _REIFIED, _STRUCTURE, _TREX, _OURS) for row in rows
}

# Names that other languages have, in lower case and without `_`, for constraints with the same arguments.
CONSTRAINTS_ELSEWHERE: dict[str, str] = {
    "equals": "eq",
    "isequal": "eq",
    "notequal": "neq",
    "notequals": "neq",
    "different": "neq",
    "less": "lt",
    "lessequal": "leq",
    "lessthanequal": "leq",
    "lessthaneq": "leq",
    "noteq": "neq",
    "lessorequal": "leq",
    "lessthanorequal": "leq",
    "alldifferent": "allDiff",
}

# Names of earlier EUROPAs, with what to write today where that is the same; None where it has to be rewritten.
FORMER_CONSTRAINTS: dict[str, str | None] = {
    "testEQ": "testEq",
    "testNEQ": "testNeq",
    "testLEQ": "testLeq",
    "testLT": "testLessThan",
    "testAND": "testAnd",
    "testOR": "testOr",
    "Equal": "eq",
    "equal": "eq",
    "asame": "eq",
    "fasame": "eq",
    "fneq": "neq",
    "lessThan": "lt",
    "leqf": "leq",
    "CondAllSame": "condEq",
    "condAllSame": "condEq",
    "condasame": "condEq",
    "condasameff": "condEq",
    "CondAllDiff": "condAllDiff",
    "condalldiff": "condAllDiff",
    "adiff": "allDiff",
    "fadiff": "allDiff",
    "fallDiff": "allDiff",
    "mulEQ": "mulEq",
    "multEQ": "mulEq",
    "addEQ": "addEq",
    "divEQ": "divEq",
    "sum": "eqSum",
    "eqsum": "eqSum",
    "product": "eqProduct",
    "eqproduct": "eqProduct",
    "maximum": "eqMaximum",
    "minimum": "eqMinimum",
    "card": "countNonZeroes",
    "negate": "neg",
    "subset": "subsetOf",
    "addMulEq": None,
    "addleq": None,
    "addlt": None,
}
