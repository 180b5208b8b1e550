"""Constructors of the native resource classes: the members that arguments fill, and the values of the others."""

from math import inf

_LEVELS = ("initialCapacity", "levelLimitMin", "levelLimitMax")
_FLOWS = ("productionRateMax", "productionMax", "consumptionRateMax", "consumptionMax")

# (class, number of arguments) -> members in the order of the arguments
FILLED: dict[tuple[str, int], tuple[str, ...]] = {
    ("Reservoir", 0): (),
    ("Reservoir", 3): _LEVELS,
    ("Reservoir", 5): (*_LEVELS, "productionMax", "consumptionMax"),
    ("Reservoir", 7): (*_LEVELS, *_FLOWS),
    ("Reusable", 2): ("capacity", "levelLimitMin"),
    ("Reusable", 3): ("capacity", "levelLimitMin", "consumptionRateMax"),
    ("Reusable", 4): ("capacity", "levelLimitMin", "consumptionMax", "consumptionRateMax"),
    ("CBReusable", 2): ("capacity", "levelLimitMin"),
    ("CBReusable", 3): ("capacity", "levelLimitMin", "consumptionRateMax"),
    ("CBReusable", 4): ("capacity", "levelLimitMin", "consumptionMax", "consumptionRateMax"),
    ("Unary", 0): (),
    ("Unary", 1): ("consumptionMax",),
}

# class -> members that no argument filled, and their values
DEFAULTS: dict[str, dict[str, float]] = {
    "Reservoir": {"initialCapacity": 0.0, "levelLimitMin": -inf, "levelLimitMax": inf, **dict.fromkeys(_FLOWS, inf)},
    "Reusable": dict.fromkeys(("consumptionMax", "consumptionRateMax"), inf),
    "CBReusable": dict.fromkeys(("consumptionMax", "consumptionRateMax"), inf),
    "Unary": {"consumptionMax": inf},
}

# class -> members that hold initial level, minimum, maximum, rate and sum of consumption, rate and sum of production
LIMITS_OF: dict[str, tuple[str, ...]] = {
    "Reservoir": (*_LEVELS, "consumptionRateMax", "consumptionMax", "productionRateMax", "productionMax"),
    "Reusable": ("capacity", "levelLimitMin", "", "consumptionRateMax", "consumptionMax", "", ""),
    "CBReusable": ("capacity", "levelLimitMin", "", "consumptionRateMax", "consumptionMax", "", ""),
    "Unary": ("", "", "", "", "consumptionMax", "", ""),
}
