"""Integer codes of the solver: kinds of flaws, components, orders, results."""

NONE = -1

# ---- kinds of flaws, one per manager ----
THREAT, OPEN_CONDITION, UNBOUND_VARIABLE, RESOURCE_THREAT = range(4)
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
    FILTER_PARENT_NOT_ASSIGNED,
    FILTER_NOT_ASSIGNED,
    FILTER_GOALS,
    FILTER_NOT_GOALS,
) = range(13)
POLICY_PARTIAL, POLICY_POSSIBLE, _POLICY_TOTAL = range(3)

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
_MERGE_FIRST, ACTIVATE_FIRST, MERGE_ONLY, ACTIVATE_ONLY = range(4)
ORDER_EARLY, ORDER_LATE, ORDER_NEAR, ORDER_FAR, ORDER_KEY = range(5)

# ---- which flaw of a resource comes first ----
PREFER_LOWER, PREFER_UPPER, PREFER_MOST, PREFER_LEAST, PREFER_EARLIEST, PREFER_LATEST = range(6)

# ---- which constraint is posted on a pair of uses, and whether pairs or constraints vary first ----
PRECEDES_ONLY, PRECEDES_FIRST, CONCURRENT_ONLY, CONCURRENT_FIRST = range(4)
_PAIR_FIRST, CONSTRAINT_FIRST = range(2)

# ---- the solver's state after a step ----
MOVED, FAILED, PLAN, EXHAUSTED, TIMEOUT = range(5)
RESULT_NAMES = ("moved", "failed", "plan", "exhausted", "timeout")

# ---- priorities: the best, and what a handler has that names none ----
BEST_PRIORITY = 0.0
WORST_PRIORITY = 99999.0

# ---- a slot that is in no heap; the kinds of slots in the undo log of the agenda ----
NO_KEY = -(2**62)
DROPPED_TOKEN, DROPPED_VARIABLE, DROPPED_EFFECT = range(3)
NO_PRIORITY = 1.0e9

# ---- what became of a resolver; the phases of an open condition ----
APPLIED, FAILED_CHOICE, NO_CHOICE = range(3)
PHASE_MERGE, PHASE_ACTIVATE, PHASE_REJECT, PHASE_DONE = range(4)

# ---- a conflict set of all earlier decisions ----
EVERYTHING = -2

# ---- after all that has happened ----
NOW = 2**62

# ---- restarts: failures before the first one; cap and scale of domain sizes over weights ----
FEW_FAILURES = 250
LARGEST_SIZE = 2**44
WEIGHT_SCALE = 2**16

# ---- Knuth's multiplicative hashing of the ids of variables ----
SPREAD = 2654435761
