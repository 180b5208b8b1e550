"""Name the integers that the engine's arrays hold: kinds, supports, events, trail entries, conflicts."""

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
TRAIL_ENTAILED = 14
# The codes of what narrows a domain, as a set of bits.
TRAIL_NARROWING = 1 << TRAIL_LOWER | 1 << TRAIL_UPPER | 1 << TRAIL_REAL_LOWER | 1 << TRAIL_REAL_UPPER | 1 << TRAIL_HOLES

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
MODE_DISTANCE = 3  # carried out by temporal edges whose weights follow the bounds of a variable
