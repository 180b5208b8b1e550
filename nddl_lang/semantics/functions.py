"""The functions of expressions, and the methods of the script: what each takes and gives, as data."""

from dataclasses import dataclass
from enum import Enum

from nddl_lang.semantics.constraints import Origin
from nddl_lang.semantics.signature import Signature, signature


class ResultKind(Enum):
    """What a function gives; `widest` is int over ints and float otherwise (in nddl3 always float)."""

    INT = "int"
    FLOAT = "float"
    BOOL = "bool"
    WIDEST = "widest"
    SAMPLED = "sampled"


@dataclass(frozen=True, slots=True)
class FunctionRow:
    """One function; `constraint` is the row of the constraint table that binds its result, which stands first."""

    name: str
    signature: Signature
    result: ResultKind
    constraint: str
    meaning: str
    origin: Origin = Origin.EUROPA
    # Whether EUROPA passes over arguments beyond those that it needs.
    overlooks_rest: bool = True


def _row(name: str, places: str, result: ResultKind, constraint: str, meaning: str) -> FunctionRow:
    return FunctionRow(name, signature(places), result, constraint, meaning)


def _trex(name: str, places: str, result: ResultKind, constraint: str, meaning: str) -> FunctionRow:
    return FunctionRow(name, signature(places), result, constraint, meaning, Origin.TREX)


_BOOL, _INT, _FLOAT, _WIDEST = ResultKind.BOOL, ResultKind.INT, ResultKind.FLOAT, ResultKind.WIDEST

_ROWS = (
    FunctionRow(
        "isSingleton",
        signature("x:any"),
        _BOOL,
        "testSingleton",
        "whether x has a single value",
        overlooks_rest=False,
    ),
    _row("isSpecified", "x:any", _BOOL, "testSpecified", "whether the value of x was given"),
    _row("max", "a:number b:number", _WIDEST, "maxf", "the greater of a and b"),
    _row("min", "a:number b:number", _WIDEST, "minf", "the smaller of a and b"),
    _row("abs", "x:number", _WIDEST, "abs", "the absolute value of x"),
    _row("pow", "a:number b:number", _FLOAT, "pow", "a to the power of b"),
    _row("sqrt", "x:number", _FLOAT, "sqrt", "the square root of x"),
    _row("mod", "a:number b:number", _INT, "mod", "the rest of a ÷ b"),
    _row("rand", "x:number", _INT, "rand", "a random whole number from 0 to 32767"),
    _row("floor", "x:number", _INT, "floor", "x rounded down"),
    _row("ceil", "x:number", _INT, "ceil", "x rounded up"),
    _trex("external", "timeline:object", _BOOL, "isExternal", "whether the timeline is owned elsewhere"),
    _trex("internal", "timeline:object", _BOOL, "isInternal", "whether the timeline is owned here"),
    _trex("to_tick", "seconds:number day:number year:number", _INT, "tick_date", "the tick of the date"),
    _trex("to_rad", "degrees:number", _FLOAT, "deg_to_rad", "the angle in radians"),
    _trex("in_circle", "value:number", _FLOAT, "circle_mod", "the value brought within one turn, in degrees"),
    _trex("sin", "angle:number", _FLOAT, "sinf", "the sine of the angle in degrees"),
    _trex("cos", "angle:number", _FLOAT, "cosf", "the cosine of the angle in degrees"),
    _trex("exp", "x:number", _FLOAT, "expf", "e to the power of x"),
    _trex("log", "x:number", _FLOAT, "logf", "the natural logarithm of x"),
    _trex(
        "ll_distance",
        "lat1:number lon1:number lat2:number lon2:number",
        _FLOAT,
        "ll_dist",
        "the distance of two positions on the earth, in metres",
    ),
    _trex("empty", "path:any", _BOOL, "is_empty", "whether the path has no point"),
    FunctionRow(
        "sampledParameter",
        signature("parameter:parameter"),
        ResultKind.SAMPLED,
        "sampledParameter",
        "what the mission draws for the parameter",
        Origin.NDDLC,
    ),
)

FUNCTIONS: dict[str, FunctionRow] = {row.name: row for row in _ROWS}


class Receiver(Enum):
    """What a method is called on; the value is how users read it."""

    VARIABLE = "a variable"
    TOKEN = "a token"
    OBJECT = "an object"
    CLASS = "a class"
    NOTHING = "nothing"


@dataclass(frozen=True, slots=True)
class MethodRow:
    """One method of the script."""

    name: str
    receiver: Receiver
    signature: Signature
    meaning: str
    europa: str | None = None


_METHODS = (
    MethodRow("specify", Receiver.VARIABLE, signature("value:any"), "decide the variable"),
    MethodRow("reset", Receiver.VARIABLE, signature(""), "undo the decision, and what followed from it"),
    MethodRow("close", Receiver.VARIABLE, signature(""), "no further value or object joins the domain"),
    MethodRow("activate", Receiver.TOKEN, signature(""), "put the token into the plan; its rules run"),
    MethodRow("merge", Receiver.TOKEN, signature("active:token"), "let an active token stand for this one"),
    MethodRow("reject", Receiver.TOKEN, signature(""), "drop a rejectable token"),
    MethodRow("cancel", Receiver.TOKEN, signature(""), "make the token inactive again"),
    MethodRow(
        "constrain",
        Receiver.OBJECT,
        signature("token:token next?:token"),
        "order the first token before the second on the object; one token alone is assigned to it",
    ),
    MethodRow("free", Receiver.OBJECT, signature("token:token next?:token"), "undo `constrain`"),
    MethodRow(
        "set_capacity", Receiver.OBJECT, signature("time:number lower:number upper:number"), "change the capacity"
    ),
    MethodRow(
        "set_limit",
        Receiver.OBJECT,
        signature("time:number lower:number upper:number"),
        "change the limits of the level",
        "EUROPA changes the capacity instead.",
    ),
    MethodRow("close", Receiver.CLASS, signature(""), "no further objects of the class"),
    MethodRow("close", Receiver.NOTHING, signature(""), "no further objects of any class"),
)

METHODS: dict[tuple[Receiver, str], MethodRow] = {(row.receiver, row.name): row for row in _METHODS}

_WIDE = "an interval is written `[1 5]`"
# What other languages have for a function, and NDDL otherwise.
OTHER_FUNCTIONS = {
    "round": "round up by `ceil(x)`, down by `floor(x)`, to the nearest by `floor(x + 0.5)`",
    "trunc": "round down by `floor(x)`",
    "range": _WIDE,
    "interval": _WIDE,
    "between": f"{_WIDE}: `x == y` with `float y = [1 5];`, or `1 <= x; x <= 5;`",
    "random": "what chance decides is `sampledParameter(NAME)`, of a global variable",
    "uniform": "what chance decides is `sampledParameter(NAME)`, and the mission file says how it is drawn",
    "normal": "what chance decides is `sampledParameter(NAME)`, and the mission file says how it is drawn",
    "power": "a power is the function `pow(a, b)`",
    "absolute": "a number without its sign is `abs(x)`",
    "maximum": "the larger of two is `max(a, b)`",
    "minimum": "the smaller of two is `min(a, b)`",
    "ceiling": "round up by `ceil(x)`",
}
