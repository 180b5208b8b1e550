"""What every model knows without declaring it: the native classes, the states of tokens, the built-in variables."""

from nddl_lang.semantics.schema import (
    INFINITY,
    Class,
    Constructor,
    Enumeration,
    EnumValue,
    Interval,
    Kind,
    Predicate,
    Type,
    Variable,
)
from nddl_lang.semantics.types import FLOAT, INT, STATE, TOKEN_STATES, object_type

ROOT_CLASS = "Object"
TIMELINE = "Timeline"
_STATES = ("INACTIVE", "ACTIVE", "MERGED", "REJECTED")

_STEP_TYPES: dict[str, Type] = {"state": STATE, "duration": INT}
_TOKEN_TYPES: dict[str, Type] = {**_STEP_TYPES, "start": INT, "end": INT}
_EVENT_TYPES: dict[str, Type] = {**_STEP_TYPES, "time": INT}
# What other languages, and people, call the variables of a token.
_OTHER_NAMES = {
    **dict.fromkeys(("begin", "begins", "start_time", "startTime", "starttime", "beginning"), "start"),
    **dict.fromkeys(("finish", "finishes", "stop", "end_time", "endTime", "endtime", "ending"), "end"),
    **dict.fromkeys(("length", "dur", "lasts", "timespan", "period"), "duration"),
    **dict.fromkeys(("owner", "timeline", "instance"), "object"),
}
TIME_NAMES = frozenset({"start", "end", "time"})
LEAST_DURATION = Interval(1, INFINITY)

_QUANTITY = Type(Kind.FLOAT, "float", "float", Interval(0.0, float(INFINITY)))
_ONE = Type(Kind.FLOAT, "float", "float", Interval(1.0, 1.0))


def builtin_type(name: str, predicate: Predicate) -> Type | None:
    """The type of the built-in variable `name` of the tokens of `predicate`, None where they have none of that name."""
    if name == "object":
        return object_type(predicate.class_name)
    return (_EVENT_TYPES if predicate.is_event else _TOKEN_TYPES).get(name)


def builtin_names(is_event: bool) -> tuple[str, ...]:
    """The built-in variables of a token, or of an event."""
    return ("state", "object", *(name for name in (_EVENT_TYPES if is_event else _TOKEN_TYPES) if name != "state"))


def other_name(name: str, predicate: Predicate) -> str | None:
    """The built-in variable of the tokens of `predicate` that other languages call `name`."""
    meant = _OTHER_NAMES.get(name)
    if predicate.is_event and meant in ("start", "end"):
        return "time"
    return meant


def _constructor(class_name: str, *names: str) -> Constructor:
    return Constructor(class_name, tuple(Variable(name, FLOAT, None) for name in names), None, None)


def _predicate(class_name: str, name: str, quantity: Type, is_event: bool) -> Predicate:
    parameters = (Variable("quantity", quantity, None),)
    return Predicate(class_name, name, parameters, False, is_event, (), (class_name,), None)


def _resource(
    name: str, members: tuple[str, ...], constructors: tuple[tuple[str, ...], ...], predicates: tuple[Predicate, ...]
) -> Class:
    return Class(
        name,
        ROOT_CLASS,
        members={member: Variable(member, FLOAT, None) for member in members},
        constructors=[_constructor(name, *parameters) for parameters in constructors],
        predicates={predicate.name: predicate for predicate in predicates},
        is_native=True,
    )


_LEVELS = ("initialCapacity", "levelLimitMin", "levelLimitMax")
_FLOWS = ("productionRateMax", "productionMax", "consumptionRateMax", "consumptionMax")
_USE = ("capacity", "levelLimitMin", "consumptionMax", "consumptionRateMax")
_USE_CONSTRUCTORS = (_USE[:2], (*_USE[:2], "consumptionRateMax"), _USE)


def _native_classes() -> dict[str, Class]:
    root = Class(ROOT_CLASS, None, constructors=[_constructor(ROOT_CLASS)], is_native=True)
    timeline = Class(TIMELINE, ROOT_CLASS, constructors=[_constructor(TIMELINE)], is_native=True)
    reservoir = _resource(
        "Reservoir",
        (*_LEVELS, *_FLOWS),
        (_LEVELS, (*_LEVELS, "productionMax", "consumptionMax"), (*_LEVELS, *_FLOWS), ()),
        (
            _predicate("Reservoir", "produce", _QUANTITY, is_event=True),
            _predicate("Reservoir", "consume", _QUANTITY, is_event=True),
        ),
    )
    reusable = _resource(
        "Reusable", _USE, _USE_CONSTRUCTORS, (_predicate("Reusable", "uses", _QUANTITY, is_event=False),)
    )
    counted = _resource("CBReusable", _USE, _USE_CONSTRUCTORS, ())
    unary = _resource(
        "Unary", ("consumptionMax",), ((), ("consumptionMax",)), (_predicate("Unary", "use", _ONE, is_event=False),)
    )
    return {native.name: native for native in (root, timeline, reservoir, reusable, counted, unary)}


NATIVE_CLASSES = _native_classes()
NATIVE_ENUM = Enumeration(TOKEN_STATES, _STATES, None, None)
NATIVE_ENUM_VALUES = {value: EnumValue(TOKEN_STATES, value) for value in _STATES}

# Tokens of these classes are active from the moment they are made.
SELF_ACTIVATING = frozenset({"Reservoir", "Reusable", "CBReusable", "Unary"})
