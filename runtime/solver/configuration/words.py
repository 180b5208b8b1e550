"""Words of a configuration and their codes; of the tuples the index is the code, and the first word the default."""

from runtime.solver.tags import (
    FILTER_GOALS,
    FILTER_GUARD,
    FILTER_HORIZON,
    FILTER_HORIZON_VARIABLE,
    FILTER_INFINITE,
    FILTER_LOCAL,
    FILTER_NOT_ASSIGNED,
    FILTER_NOT_GOALS,
    FILTER_NOT_GUARD,
    FILTER_NOT_SINGLETON,
    FILTER_PARAMETER,
    FILTER_PARENT_NOT_ASSIGNED,
    FILTER_STATIC,
    HANDLER_BASIC,
    HANDLER_HSTS,
    HANDLER_HSTS_THREAT,
    HANDLER_LISTED,
    HANDLER_MAX,
    HANDLER_MIN,
    HANDLER_RANDOM,
    HANDLER_RESOURCE,
    HANDLER_SUPPORT,
    HANDLER_THREAT,
    OPEN_CONDITION,
    RESOURCE_THREAT,
    THREAT,
    UNBOUND_VARIABLE,
)

FILTERS = {
    "FlawFilter": FILTER_STATIC,
    "HorizonFilter": FILTER_HORIZON,
    "HorizonVariableFilter": FILTER_HORIZON_VARIABLE,
    "GuardFilter": FILTER_GUARD,
    "NotGuardFilter": FILTER_NOT_GUARD,
    "ParameterFilter": FILTER_PARAMETER,
    "LocalVariableFilter": FILTER_LOCAL,
    "Singleton": FILTER_NOT_SINGLETON,
    "InfiniteDynamicFilter": FILTER_INFINITE,
    "MasterMustBeInsertedFilter": FILTER_PARENT_NOT_ASSIGNED,
    "TokenMustBeAssignedFilter": FILTER_NOT_ASSIGNED,
    "ParentMustBeInsertedFilter": FILTER_NOT_ASSIGNED,
    "goals": FILTER_GOALS,  # this and the next are T-REX's: each leaves out what it names
    "notGoals": FILTER_NOT_GOALS,
    "NoGoals": FILTER_GOALS,  # T-REX 1's names for the same
    "GoalsOnly": FILTER_NOT_GOALS,
}
WINDOW_FILTERS = ("DeliberationFilter",)  # T-REX 1's; a reactor here plans inside its window anyway
HANDLERS = {  # the kind of flaw that each mends, and its code; the first of a kind is its default
    "StandardVariableHandler": (UNBOUND_VARIABLE, HANDLER_MIN),
    "Min": (UNBOUND_VARIABLE, HANDLER_MIN),
    "Max": (UNBOUND_VARIABLE, HANDLER_MAX),
    "Random": (UNBOUND_VARIABLE, HANDLER_RANDOM),
    "ValEnum": (UNBOUND_VARIABLE, HANDLER_LISTED),
    "StandardOpenConditionHandler": (OPEN_CONDITION, HANDLER_SUPPORT),
    "SupportedOpenConditionHandler": (OPEN_CONDITION, HANDLER_SUPPORT),
    "BasicOpenConditionHandler": (OPEN_CONDITION, HANDLER_BASIC),
    "HSTSOpenConditionDecisionPoint": (OPEN_CONDITION, HANDLER_HSTS),
    "StandardThreatHandler": (THREAT, HANDLER_THREAT),
    "HSTSThreatDecisionPoint": (THREAT, HANDLER_HSTS_THREAT),
    "ResourceThreatHandler": (RESOURCE_THREAT, HANDLER_RESOURCE),
    "TrexOpenConditionHandler": (OPEN_CONDITION, HANDLER_SUPPORT),  # what these two add to the standard ones, that
    "TrexThreatHandler": (THREAT, HANDLER_THREAT),  # nothing is planned for the past, holds for every reactor here
}
MANAGERS = {"EarliestFirst": "OpenConditionManager"}  # other names: T-REX's takes the earliest start first
STANDARD = {kind: name for name, (kind, _) in reversed(HANDLERS.items())}
POLICIES = ("PartiallyContained", "PossiblyContained", "TotallyContained")
CHOICES = ("mergeFirst", "activateFirst", "mergeOnly", "activateOnly")
TOKEN_ORDERS = ("early", "late", "near", "far", "ascendingKey")
RESOURCE_ORDERS = ("lower", "upper", "most", "least", "earliest", "latest")
_PAIR_WORDS = ("earliest", "latest", "longest", "shortest", "ascendingKey", "descendingKey")
PAIR_ORDERS = (*(word + end for word in _PAIR_WORDS for end in ("Predecessor", "Successor")), "leastImpact")
KEEPS = ("none", "predecessorNot", "successor", "both")
CONSTRAINTS = ("precedesOnly", "precedesFirst", "concurrentOnly", "concurrentFirst")
ITERATIONS = ("pairFirst", "constraintFirst")
