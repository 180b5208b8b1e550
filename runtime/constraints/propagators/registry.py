"""The registry: one row per constraint, and the tables by opcode that compiled code reads.

The language has a table of its own (`nddl_lang/semantics/constraints.py`: types, documentation); a test holds the two
together. A constraint is carried out by the compiled file of its opcode's family, or, where its row has `propagate`, by
a call of that.
"""

from array import array
from collections.abc import Callable
from dataclasses import replace
from functools import partial

from runtime.constraints.domains.store import Store
from runtime.constraints.domains.tags import (
    EVENT_ANY,
    EVENT_HOLES,
    EVENT_LOWER,
    EVENT_UPPER,
    PRIORITY_DEAR,
    PRIORITY_WATCH,
)
from runtime.constraints.propagators import claims, positions, relational
from runtime.constraints.propagators import opcodes as op
from runtime.constraints.propagators.arguments import Arguments
from runtime.constraints.propagators.row import (
    CALLED_ALWAYS,
    CALLED_BESIDE,
    CALLED_NEVER,
    CALLED_RELATIONAL,
    OWN_ALWAYS,
    OWN_AT_ONE,
    OWN_NEVER,
    READS_DISTANCE,
    READS_SAME_SIDE,
    READS_SUM_FIRST,
    READS_SUM_LAST,
    Claim,
    Propagate,
    Propagator,
)

_BOUNDS = (EVENT_LOWER | EVENT_UPPER, EVENT_LOWER | EVENT_UPPER)
_order = partial(Propagator, wakes=(EVENT_LOWER, EVENT_UPPER), edges_up_to=2, reads=READS_SAME_SIDE)
_arithmetic = partial(Propagator, wakes=_BOUNDS, reads_own=OWN_NEVER)
_function = partial(Propagator, reads_own=OWN_NEVER, waits=True)
_of_domains = partial(Propagator, is_of_domains=True)
_called = partial(Propagator, -1)
_beside = partial(Propagator, waits=True, is_beside=True)


def _test(op: int, name: str, claim: Claim, arguments: str = "truth x y") -> Propagator:
    """Make the row of a constraint whose first argument tells whether the others fulfil a claim."""
    return Propagator(op, name, arguments, lambda z, x: (x[0] != 0) == claim(z, x[1:]))


def _call_external(s: Store, c: int) -> bool:
    """Have the object decide that was posted with the constraint."""
    return bool(s.externals[c].propagate(s, c))


_COMPARISON = (
    Propagator(
        op.OP_EQ,
        "eq concurrent",
        "x y rest*",
        claims.all_equal,
        infix="{0} == {1}",
        wakes_beside_edges=EVENT_HOLES,
        edges_up_to=2,
        idempotent_up_to=2,
        reads=READS_SAME_SIDE,
    ),
    Propagator(op.OP_NEQ, "neq", "x y", lambda _, x: x[0] != x[1], infix="{0} != {1}", idempotent_up_to=2),
    _order(op.OP_LT, "lt strictlyPrecedes", "x y", lambda _, x: x[0] < x[1], infix="{0} < {1}"),
    _order(op.OP_LEQ, "leq precedes", "x y", lambda _, x: x[0] <= x[1], infix="{0} <= {1}"),
    Propagator(op.OP_ALL_DIFF, "allDiff", "x y rest*", claims.all_different),
    Propagator(
        op.OP_TEMPORAL_DISTANCE,
        "temporalDistance",
        "a distance b",
        lambda _, x: x[2] - x[0] == x[1],
        infix="{2} - {0} == {1}",
        wakes=_BOUNDS,
        idempotent_up_to=3,
        reads=READS_DISTANCE,
    ),
    Propagator(
        op.OP_WITHIN_BOUNDS, "withinBounds", "x lower upper", lambda z, x: z.every([x[1] <= x[0], x[0] <= x[2]])
    ),
    Propagator(op.OP_PLUS, arguments="a constant sum", shown="addEq"),  # `post` makes it of addEq
)

_ARITHMETIC = (
    _arithmetic(
        op.OP_ADD_EQ,
        "addEq",
        "a b sum",
        lambda _, x: x[0] + x[1] == x[2],
        infix="{2} == {0} + {1}",
        idempotent_up_to=3,
        reads=READS_SUM_LAST,
    ),
    _arithmetic(
        op.OP_MUL_EQ,
        "mulEq multEq",
        "a b product",
        lambda _, x: x[0] * x[1] == x[2],
        infix="{2} == {0} * {1}",
        reads_own=OWN_AT_ONE,
    ),
    _arithmetic(
        op.OP_DIV_EQ,
        "divEq",
        "a b quotient",
        lambda z, x: z.every([x[1] != 0, x[0] == x[1] * x[2]]),
        reads_own=OWN_AT_ONE,
    ),
    _arithmetic(
        op.OP_EQ_SUM, "eqSum", "result x y rest*", lambda _, x: x[0] == claims.total(x[1:]), reads=READS_SUM_FIRST
    ),
    _arithmetic(op.OP_EQ_PRODUCT, "eqProduct", "result x y rest*", lambda _, x: x[0] == claims.product(x[1:])),
    _arithmetic(op.OP_EQ_MINIMUM, "eqMinimum", "result x y rest*", lambda z, x: claims.least(z, x[0], x[1:])),
    _arithmetic(op.OP_EQ_MAXIMUM, "eqMaximum", "result x y rest*", lambda z, x: claims.greatest(z, x[0], x[1:])),
    _arithmetic(
        op.OP_ALL_MIN,
        "allMin min",
        "x y rest* result",
        lambda z, x: claims.least(z, x[-1], x[:-1]),
        posted_as=op.OP_EQ_MINIMUM,
    ),
    _arithmetic(
        op.OP_ALL_MAX,
        "allMax max",
        "x y rest* result",
        lambda z, x: claims.greatest(z, x[-1], x[:-1]),
        posted_as=op.OP_EQ_MAXIMUM,
    ),
    _arithmetic(op.OP_ABS_VAL, "absVal", "result x", claims.absolute, reads_own=OWN_ALWAYS),
    _arithmetic(op.OP_NEG, "neg", "x y", lambda _, x: x[0] == -x[1]),
    _arithmetic(
        op.OP_DIFF_SQUARE,
        "diffSquare",
        "a b r",
        lambda _, x: x[2] == (x[0] - x[1]) * (x[0] - x[1]),
        relation=relational.square_difference,
        is_beside=True,
    ),
    _arithmetic(
        op.OP_CALC_DISTANCE, "calcDistance", "distance x1 y1 x2 y2", claims.distance, relation=relational.distance
    ),
    _arithmetic(
        op.OP_DISTANCE_SQUARES,
        "distanceSquares",
        "a b r",
        lambda z, x: claims.root(z, x[2], x[0] + x[1]),
        waits=True,
        relation=relational.root_of_sum,
    ),
)

_LOGIC = (
    Propagator(op.OP_OR, "or", "x rest*", lambda z, x: z.some([a != 0 for a in x])),
    Propagator(
        op.OP_COUNT_ZEROES, "countZeroes", "count x rest*", lambda z, x: x[0] == claims.count(z, x[1:], of_zeroes=True)
    ),
    Propagator(
        op.OP_COUNT_NON_ZEROES,
        "countNonZeroes",
        "count x rest*",
        lambda z, x: x[0] == claims.count(z, x[1:], of_zeroes=False),
    ),
    _test(op.OP_TEST_EQ, "testEq", lambda _, x: x[0] == x[1]),
    _test(op.OP_TEST_NEQ, "testNeq", lambda _, x: x[0] != x[1]),
    _test(op.OP_TEST_LEQ, "testLeq", lambda _, x: x[0] <= x[1]),
    _test(op.OP_TEST_LT, "testLessThan", lambda _, x: x[0] < x[1]),
    _test(op.OP_TEST_AND, "testAnd", lambda z, x: z.every([a != 0 for a in x])),
    _test(op.OP_TEST_OR, "testOr", lambda z, x: z.some([a != 0 for a in x])),
    _test(op.OP_COND_ALL_DIFF, "condAllDiff", claims.all_different, "truth x y rest*"),
    _test(op.OP_COND_EQ, "condEq", claims.all_equal, "truth x y rest*"),
    _of_domains(op.OP_TEST_SINGLETON, "testSingleton", "truth x"),
    _of_domains(op.OP_TEST_SPECIFIED, "testSpecified", "truth x", wakes=(EVENT_ANY, EVENT_ANY)),
)

_SETS = (
    _of_domains(op.OP_SUBSET_OF, "subsetOf", "x y"),
    _of_domains(op.OP_EQ_UNION, "eqUnion", "result x rest*"),
    _of_domains(op.OP_MEMBER_IMPLY, "memberImply", "a b c d"),
    _of_domains(op.OP_LOCK, "lockCT", "x domain"),
    Propagator(op.OP_ELEMENT, arguments="result index rest*", shown="memberOf"),  # see `post_element`
    Propagator(op.OP_HAS_ANCESTOR, "hasAncestor", "x ancestors"),
    Propagator(op.OP_COMMON_ANCESTOR, "commonAncestor", "x y ancestors"),
    Propagator(op.OP_FREEZE, arguments="x domain", shown="foreach"),  # keeps the values; once closed, no others
)

_FUNCTIONS = (
    _function(op.OP_ABS, "abs", "result x", claims.absolute, twin=op.OP_ABSF),
    _function(op.OP_SQRT, "sqrt", "result x", claims.square_root, twin=op.OP_SQRTF),
    _function(op.OP_FLOOR, "floor", "result x", claims.rounded_down, twin=op.OP_FLOORF),
    _function(op.OP_CEIL, "ceil", "result x", claims.rounded_up, twin=op.OP_CEILF),
    _function(op.OP_MAX, "maxf", "result a b", lambda z, x: claims.greatest(z, x[0], x[1:]), twin=op.OP_MAXF),
    _function(op.OP_MIN, "minf", "result a b", lambda z, x: claims.least(z, x[0], x[1:]), twin=op.OP_MINF),
    _function(op.OP_POW, "pow", "result a b", relation=relational.power),
    _function(op.OP_MOD, "mod", "result a b", claims.remainder, relation=relational.remainder),
    _function(op.OP_RAND, "rand", "result", waits=False),  # fixed when it is posted
    _function(op.OP_SAMPLE, "sampledParameter", "value parameter", waits=False),  # a draw; one way
    _function(op.OP_BIND, "bind", "target default", reads_own=OWN_ALWAYS, is_of_domains=True),
    _function(op.OP_TRAVEL_TIME, "travelTime", "ticks xa ya xb yb speed", relation=relational.travel_time),
    _function(op.OP_TOWARDS, "towards", "ux uy x y tx ty", relation=relational.unit_vector),
)

_GEODESY = (
    Propagator(op.OP_SIN, "sin", "result angle", twin=op.OP_SINF),  # within a quarter turn, forward only
    Propagator(op.OP_SINF, "sinf", "result angle"),
    Propagator(op.OP_COSF, "cosf", "result angle"),
    Propagator(op.OP_SQRTF, "sqrtf", "result x", claims.square_root),
    Propagator(op.OP_ABSF, "absf", "result x", claims.absolute),
    Propagator(op.OP_FLOORF, "floorf", "result x", claims.rounded_down),
    Propagator(op.OP_CEILF, "ceilf", "result x", claims.rounded_up),
    Propagator(op.OP_MAXF, arguments="result x rest*", shown="maxf"),
    Propagator(op.OP_MINF, arguments="result x rest*", shown="minf"),
    Propagator(op.OP_EXPF, "expf", "result x"),
    Propagator(op.OP_LOGF, "logf", "result x"),
    Propagator(op.OP_DEG_TO_RAD, "deg_to_rad", "radians degrees"),
    Propagator(op.OP_CIRCLE_MOD, "circle_mod", "angle value"),
    _beside(op.OP_TICK_DATE, "tick_date", "tick seconds day year", relation=positions.tick_date),
    _beside(op.OP_LL_DIST, "ll_dist", "d lat1 lon1 lat2 lon2", relation=positions.great_circle_distance),
    _beside(op.OP_WGS_DISPLACE, "wgsdisplace", "lat lon north east latR lonR", relation=positions.displaced_position),
    _beside(
        op.OP_WGS_DISPLACEMENT,
        "wgsdisplacement",
        "lat lon latR lonR north east",
        relation=positions.displacement_between,
    ),
)

_SPECIAL = (
    # Narrows nothing; joins `woken` when one of its variables changes or is decided.
    Propagator(op.OP_WATCH, arguments="x rest*", wakes=(EVENT_ANY, EVENT_ANY), priority=PRIORITY_WATCH),
    Propagator(op.OP_EXTERNAL, arguments="x rest*", propagate=_call_external, priority=PRIORITY_DEAR),
    Propagator(op.OP_NOTHING, "isExternal", "truth timeline"),
    Propagator(op.OP_NOTHING, "isInternal", "truth timeline"),
    Propagator(op.OP_NOTHING, "ll_offset", "lat lon north east rest*"),
    Propagator(op.OP_NOTHING, "sane_pos", "lat lon rest*"),
    Propagator(op.OP_NOTHING, "is_empty", "truth path"),
    Propagator(op.OP_NOTHING, "car", "point path"),
    Propagator(op.OP_NOTHING, "cdr", "rest path"),
)

# Constraints without a compiled file, each `_called(names, arguments, claim, propagate=...)`; opcodes follow.
_CALLED: tuple[Propagator, ...] = ()
_NUMBERED = tuple(replace(row, op=op.FIRST_CALLED + number) for number, row in enumerate(_CALLED))

_ROWS = (*_COMPARISON, *_ARITHMETIC, *_LOGIC, *_SETS, *_FUNCTIONS, *_GEODESY, *_SPECIAL, *_NUMBERED)
BY_NAME: dict[str, Propagator] = {name: row for row in _ROWS for name in row.names.split()}
BY_OP: dict[int, Propagator] = {row.op: row for row in _ROWS if row.op != op.OP_NOTHING}
# The name of a constraint in messages, where it has one.
NAMES: dict[int, str] = {row.op: row.name for row in BY_OP.values() if row.name}
# Functions that stand for their twins to the last bit where all arguments are known.
EXACT_TWINS = {code: BY_OP[code].twin for code in (op.OP_ABS, op.OP_FLOOR, op.OP_CEIL, op.OP_MAX, op.OP_MIN)}


def _table(column: Callable[[Propagator], int], otherwise: int = 0) -> "array[int]":
    """Lay a column out by opcode, for compiled code."""
    rows = map(BY_OP.get, range(op.OPCODES))
    return array("h", [otherwise if row is None else column(row) for row in rows])


def _when_called(row: Propagator) -> int:
    """Tell when the registry's function runs."""
    if row.propagate is not None:
        return CALLED_ALWAYS
    if row.relation is None:
        return CALLED_NEVER
    return CALLED_BESIDE if row.is_beside else CALLED_RELATIONAL


def _call_of(row: Propagator) -> Propagate:
    """Give the function that the registry runs: `propagate`, or the relation on the arguments' intervals."""
    if row.propagate is not None:
        return row.propagate
    relation = row.relation
    return _never_called if relation is None else lambda s, c: relation(Arguments(s, c))


def _never_called(s: Store, c: int) -> bool:
    raise AssertionError(f"the registry has no function for {s.op[c]}")


WAKES_FIRST = _table(lambda row: row.wakes[0])
WAKES_OTHERS = _table(lambda row: row.wakes[1])
WAKES_BESIDE_EDGES = _table(lambda row: row.wakes_beside_edges)
PRIORITIES = _table(lambda row: row.priority)
EDGES_UP_TO = _table(lambda row: row.edges_up_to)
IDEMPOTENT_UP_TO = _table(lambda row: row.idempotent_up_to)
POSTED_AS = _table(lambda row: row.posted_as, -1)
TWINS = _table(lambda row: row.twin, -1)
READS = _table(lambda row: row.reads)
READS_OWN = _table(lambda row: row.reads_own)
CALLED = _table(_when_called)
CALLS = [_call_of(BY_OP[code]) if code in BY_OP else _never_called for code in range(op.OPCODES)]
