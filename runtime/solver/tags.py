"""Name the integer codes of the solver: kinds of flaws, components, orders, results."""

NONE = -1

# ---- kinds of flaws, one per manager ----
THREAT, OPEN_CONDITION, UNBOUND_VARIABLE, RESOURCE_THREAT, CUSTOM = range(5)
MANAGER_NAMES = ("ThreatManager", "OpenConditionManager", "UnboundVariableManager", "ResourceThreatManager")

# ---- filters; all but the first are tested anew at every step ----
(
    FILTER_STATIC,
    FILTER_HORIZON,
    FILTER_HORIZON_VARIABLE,
    FILTER_GUARD,
    FILTER_NOT_GUARD,
    FILTER_PARAMETER,
    FILTER_LOCAL,
    FILTER_NOT_SINGLETON,
    FILTER_INFINITE,
    FILTER_MASTER_LOOSE,
    FILTER_TOKEN_LOOSE,
) = range(11)
POLICY_PARTIAL, POLICY_POSSIBLE, POLICY_TOTAL = range(3)

# ---- handlers ----
(
    HANDLER_MIN,
    HANDLER_MAX,
    HANDLER_RANDOM,
    HANDLER_LISTED,
    HANDLER_SUPPORT,
    HANDLER_BASIC,
    HANDLER_HSTS,
    HANDLER_THREAT,
    HANDLER_HSTS_THREAT,
    HANDLER_RESOURCE,
) = range(10)

# ---- what an HSTS handler offers, and how it sorts ----
MERGE_FIRST, ACTIVATE_FIRST, MERGE_ONLY, ACTIVATE_ONLY = range(4)
ORDER_KEY, ORDER_EARLY, ORDER_LATE, ORDER_NEAR, ORDER_FAR = range(5)

# ---- which flaw of a resource comes first ----
PREFER_LOWER, PREFER_UPPER, PREFER_MOST, PREFER_LEAST, PREFER_EARLIEST, PREFER_LATEST = range(6)

# ---- how pairs of uses are sorted; the same for predecessor (even) and successor (odd), and by impact ----
(
    PAIR_EARLIEST,
    PAIR_LATEST,
    PAIR_LONGEST,
    PAIR_SHORTEST,
    PAIR_KEY_UP,
    PAIR_KEY_DOWN,
) = range(6)
PAIR_IMPACT = 12

# ---- which pairs are kept, and what is posted on them ----
KEEP_ALL, KEEP_LATE_PREDECESSORS, KEEP_PRESENT_SUCCESSORS, KEEP_BOTH = range(4)
PRECEDES_ONLY, PRECEDES_FIRST, CONCURRENT_ONLY, CONCURRENT_FIRST = range(4)
PAIR_FIRST, CONSTRAINT_FIRST = range(2)

# ---- the solver's state after a step ----
MOVED, FAILED, PLAN, EXHAUSTED, TIMEOUT = range(5)
RESULT_NAMES = ("moved", "failed", "plan", "exhausted", "timeout")

# ---- priorities: the best, and what a handler has that names none ----
BEST_PRIORITY = 0.0
WORST_PRIORITY = 99999.0

# ---- a slot that is in no heap; what kind of entry a queue dropped ----
NO_KEY = -(2**62)
DROPPED_TOKEN, DROPPED_VARIABLE, DROPPED_EFFECT = range(3)
NO_PRIORITY = 1.0e9

# ---- what became of a choice; the phases of an open condition ----
APPLIED, FAILED_CHOICE, NO_CHOICE = range(3)
PHASE_MERGE, PHASE_ACTIVATE, PHASE_REJECT, PHASE_DONE = range(4)

# ---- the reasons of a decision: all that came before ----
EVERYTHING = -2

# ---- after all that has happened ----
NOW = 2**62

# ---- restarts: failures before the first one, sizes that are told apart, and how finely weights divide them ----
FEW_FAILURES = 250
LARGEST_SIZE = 2**44
WEIGHT_SCALE = 2**16

# ---- what spreads the numbers of variables over all places (Knuth's multiplicative hashing) ----
SPREAD = 2654435761
