"""Name the integers that the engine's arrays hold: kinds, supports, events, trail entries, conflicts, operations."""

# Kinds of variables. All but floats live on whole numbers: values, or ids of symbols, objects and texts.
KIND_BOOL = 0
KIND_INT = 1
KIND_FLOAT = 2
KIND_SYMBOL = 3
KIND_OBJECT = 4
KIND_STRING = 5

# EUROPA's infinity. Bounds beyond HALF_INF count as infinite; the temporal network never saturates them.
INF = 2**52 - 1
HALF_INF = 2**51
NEVER = 2**54  # the weight of an edge that restricts nothing

FLOAT_TOLERANCE = 1e-5  # two floats closer than this are equal; a float domain narrower than this is a single value
STRICT_STEP = 1e-5  # `<` between floats moves the bound by this much
ULP = 2.220446049250313e-16  # one unit in the last place of 1.0: outward rounding widens by this fraction

# Words of bit sets.
ALL_BITS = 2**64 - 1
ONE_BIT = 1
EVERY_SECOND_BIT = 0x5555555555555555
TWO_OF_FOUR_BITS = 0x3333333333333333
FOUR_OF_EIGHT_BITS = 0x0F0F0F0F0F0F0F0F
MOST_VALUES = 1024  # an interval of more values gets no holes
WIDEST_SET = 4096  # values farther apart are kept in a table

# A support is `id * 4 + type`; -1 means that nothing supports the bound.
SUPPORT_EDGE = 0
SUPPORT_CONSTRAINT = 1
SUPPORT_RESTRICTION = 2

# Flags of restrictions.
FLAG_DECISION = 1  # it does not belong to the base domain
FLAG_VALUES = 2  # it lists values
FLAG_FROZEN = 4  # it stands for what has been forgotten

# What may change about a domain; a watch is woken by the events in its mask.
EVENT_LOWER = 1
EVENT_UPPER = 2
EVENT_HOLES = 4
EVENT_DECIDED = 8
EVENT_DOMAIN = 7
EVENT_ANY = 15

# Sides of a domain, as conflicts and explanations name them.
SIDE_LOWER = 0
SIDE_UPPER = 1
SIDE_HOLES = 2

# Trail entries: `id * 16 + code`.
TRAIL_LOWER = 0
TRAIL_UPPER = 1
TRAIL_REAL_LOWER = 2
TRAIL_REAL_UPPER = 3
TRAIL_HOLES = 4
TRAIL_WORDS = 5
TRAIL_DECIDED = 6
TRAIL_EDGE = 7
TRAIL_WEIGHT = 8
TRAIL_CONSTRAINT = 9
TRAIL_VARIABLE = 10
TRAIL_RESTRICTION = 11
TRAIL_OPEN = 12
TRAIL_LINK = 13
TRAIL_REST = 14

# Kinds of conflict.
CONFLICT_NONE = 0
CONFLICT_DOMAIN = 1  # a variable has no value left
CONFLICT_CYCLE = 2  # the temporal network has a negative cycle
CONFLICT_CONSTRAINT = 3  # a constraint cannot hold, though each of its variables has values

# How a constraint is scheduled.
PRIORITY_CHEAP = 0
PRIORITY_DEAR = 1
PRIORITY_WATCH = 2

# How a constraint reads its arguments.
MODE_WHOLE = 0  # all of them are whole numbers: exact int64 arithmetic
MODE_REAL = 1  # at least one is a float: doubles, rounded outward
MODE_EDGES = 2  # carried out by temporal edges

# Families of operations: `op // 32`.
FAMILY_COMPARISON = 0
FAMILY_ARITHMETIC = 1
FAMILY_LOGIC = 2
FAMILY_SETS = 3
FAMILY_FUNCTION = 4
FAMILY_GEOMETRY = 5
FAMILY_SPECIAL = 6

# Arguments stand in the order of the language's constraint table.
OP_EQ = 0  # a, b, ...: all equal
OP_NEQ = 1  # a, b
OP_LT = 2  # a, b: a < b
OP_LEQ = 3  # a, b: a <= b
OP_ALL_DIFF = 4  # a, b, ...
OP_TEMPORAL_DISTANCE = 5  # start, distance, end: end - start in distance
OP_WITHIN_BOUNDS = 6  # x, low, high
OP_PLUS = 7  # a, k, b with a constant k: a + k = b; `post` makes it of OP_ADD_EQ

OP_ADD_EQ = 32  # a, b, sum
OP_MUL_EQ = 33  # a, b, product
OP_DIV_EQ = 34  # a, b, quotient
OP_EQ_SUM = 35  # result, x, ...
OP_EQ_PRODUCT = 36  # result, x, ...
OP_EQ_MINIMUM = 37  # result, x, ...
OP_EQ_MAXIMUM = 38  # result, x, ...
OP_ABS_VAL = 39  # result, x
OP_NEG = 40  # x, y: x = -y
OP_DIFF_SQUARE = 41  # a, b, result: (a - b)^2
OP_CALC_DISTANCE = 42  # d, x1, y1, x2, y2
OP_DISTANCE_SQUARES = 43  # a, b, result: sqrt(a + b), once both are known
OP_ALL_MIN = 44  # x, ..., result
OP_ALL_MAX = 45  # x, ..., result

OP_TEST_EQ = 64  # truth, a, b
OP_TEST_NEQ = 65
OP_TEST_LEQ = 66
OP_TEST_LT = 67
OP_TEST_AND = 68
OP_TEST_OR = 69
OP_OR = 70  # x, ...: one of them is not zero
OP_COUNT_ZEROES = 71  # n, x, ...
OP_COUNT_NON_ZEROES = 72  # n, x, ...
OP_COND_ALL_DIFF = 73  # truth, x, ...
OP_COND_EQ = 74  # truth, x, ...
OP_TEST_SINGLETON = 75  # truth, x
OP_TEST_SPECIFIED = 76  # truth, x
OP_TEST_NOT = 77  # truth, x

OP_SUBSET_OF = 96  # a, b: a's domain within b's
OP_EQ_UNION = 97  # a, b, ...: a is the union of the others
OP_MEMBER_IMPLY = 98  # a, b, c, d: if b within c then a within d
OP_LOCK = 99  # a, d: a becomes exactly d
OP_ELEMENT = 100  # result, index, v1, ...: with the table of `post_element`, result = the v of index' value
OP_HAS_ANCESTOR = 101  # x, p: the object x lies inside p
OP_COMMON_ANCESTOR = 102  # a, b, p: a and b lie inside one object out of p
OP_FREEZE = 103  # a, d: a keeps the values of d, and once it is closed no others

OP_ABS = 128  # result, x; functions act forward only, once their arguments are known
OP_SQRT = 129
OP_FLOOR = 130
OP_CEIL = 131
OP_MAX = 132  # result, a, b
OP_MIN = 133
OP_POW = 134  # result, a, b
OP_MOD = 135  # result, a, b
OP_RAND = 137  # result: a whole number, fixed when the constraint is posted
OP_SAMPLE = 138  # x, value: the environment's draw; one way
OP_BIND = 139  # target, default: the value of target nearest to the default
OP_TRAVEL_TIME = 140  # ticks, xa, ya, xb, yb, speed
OP_TOWARDS = 141  # ux, uy, x, y, tx, ty

OP_SINF = 160  # result, angle in degrees within [-180, 180]; these propagate bounds
OP_COSF = 161
OP_SQRTF = 162
OP_ABSF = 163
OP_FLOORF = 164
OP_CEILF = 165
OP_MAXF = 166  # result, x, ...
OP_MINF = 167
OP_EXPF = 168
OP_LOGF = 169
OP_DEG_TO_RAD = 170
OP_CIRCLE_MOD = 171  # degrees, value
OP_TICK_DATE = 172  # tick, seconds, day, year
OP_LL_DIST = 173  # distance, lat1, lon1, lat2, lon2
OP_WGS_DISPLACE = 174  # lat, lon, north, east, lat', lon'
OP_WGS_DISPLACEMENT = 175  # lat, lon, lat', lon', north, east
OP_SANE_POS = 176  # lat, lon, ...: the position lies on the earth
OP_SIN = 177  # result, angle in degrees within [-90, 90]; narrows the result only

OP_WATCH = 192  # x, ...: narrows nothing; joins `woken` when one of its variables changes or is decided
OP_EXTERNAL = 193  # an object decides, see `post_external`
OP_NOTHING = 194  # no effect
