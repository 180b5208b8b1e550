"""Draw claims of rules and scripts: about what will be decided, and about times and floats that are only bounded."""

from dataclasses import dataclass, field
from random import Random

from tests.solver.whole.model import (
    Call,
    Claim,
    Class,
    Compare,
    Junction,
    Predicate,
    Thing,
    Truth,
    Variable,
)

Scope = list[tuple[str, str]]  # names with their types; "time" for times, "span" for durations, "wide" for open floats
COLOURS = ("red", "green", "blue")
ORDERED = ("==", "!=", "<", "<=", ">", ">=")


@dataclass
class Draw:
    """What is drawn so far."""

    random: Random
    end: int
    kinds: list[str]
    predicates: dict[str, Predicate]
    classes: list[Class]
    things: list[Thing]
    globals: list[Variable]
    recursive: list[str] = field(default_factory=list)  # kinds that may ask for themselves, once each
    harm: str = "consume"  # what rules do to reservoirs
    labels: int = 0

    def chance(self, share: float) -> bool:
        return self.random.random() < share

    def label(self) -> str:
        self.labels += 1
        return f"c{self.labels}"


def names(scope: Scope, *types: str) -> list[str]:
    """The names in scope that have one of some types."""
    return [name for name, type_ in scope if type_ in types]


def constant(draw: Draw, type_: str) -> str:
    """A constant of a type."""
    match type_:
        case "bool":
            return draw.random.choice(("true", "false"))
        case "E":
            return draw.random.choice(COLOURS)
        case "float" | "wide":
            return draw.random.choice(("0.0", "0.5", "1.0", "1.5"))
        case "int" | "field":
            return str(draw.random.randint(-1, 3))
        case _:
            return draw.random.choice([thing.name for thing in draw.things if thing.class_name == type_])


def claim(draw: Draw, scope: Scope) -> Claim:
    """Something about times or about what is decided."""
    wide = names(scope, "wide")
    if wide and draw.chance(0.3):
        return wide_claim(draw, scope, wide)
    if draw.chance(0.4):
        return time_claim(draw, scope)
    return decided_claim(draw, scope, is_guard=False) or time_claim(draw, scope)


def wide_claim(draw: Draw, scope: Scope, wide: list[str]) -> Claim:
    """An order between floats, one of them open."""
    one = draw.random.choice(wide)
    other = draw.random.choice([name for name in names(scope, "wide", "float") if name != one] or ["1.0"])
    other = constant(draw, "wide") if draw.chance(0.4) else other
    if other not in wide and draw.chance(0.3):
        return Compare("<", one, other)
    return draw.random.choice((Call("eq", (one, other)), Call("leq", (one, other)), Compare(">=", one, other)))


def time_claim(draw: Draw, scope: Scope) -> Claim:
    """A difference between times."""
    random = draw.random
    times, spans, ints = names(scope, "time"), names(scope, "span"), names(scope, "int")
    small = random.choice([*ints, str(random.randint(0, 3)), str(random.randint(0, 3))])
    match random.randrange(6):
        case 0:
            return Compare(random.choice(("==", "<=", ">=", "<")), random.choice(spans), small)
        case 1:
            return Call("leq", (str(random.randint(0, 5)), random.choice(times)))
        case 2 if len(times) > 1:
            return Call(random.choice(("leq", "lt", "eq")), tuple(random.sample(times, 2)))
        case 3 if len(times) > 1:
            one, other = random.sample(times, 2)
            return Call(random.choice(("temporalDistance", "addEq")), (one, small, other))
        case 4 if len(times) > 1:
            one, other = random.sample(times, 2)
            return Compare(random.choice(("<=", "==", ">=", "<")), f"{one} + {small}", other)
        case _:
            return Call("leq", (random.choice(times), str(random.randint(2, draw.end))))


def decided_claim(draw: Draw, scope: Scope, is_guard: bool = True) -> Claim | None:
    """Something about what is decided; a guard does not test fields of objects, as these may be known too late."""
    random = draw.random
    if draw.chance(0.15):
        parts = [decided_claim(draw, scope, is_guard) for _ in range(random.randint(2, 3))]
        op = random.choice(("&&", "||"))
        fit = tuple(part for part in parts if isinstance(part, Compare))
        return Junction(op, fit) if len(fit) > 1 else parts[0]
    types = [
        type_ for _, type_ in scope if type_ in ("int", "bool", "E", "T", "float", *(() if is_guard else ("field",)))
    ]
    if not types:
        return None
    type_ = random.choice(types)
    like = names(scope, "int", "field") if type_ in ("int", "field") and not is_guard else names(scope, type_)
    one = random.choice(names(scope, type_))
    rest = [name for name in like if name != one]
    other = random.choice(rest) if rest and draw.chance(0.5) else constant(draw, type_)
    if type_ == "bool" and draw.chance(0.3):
        return Truth(one)
    if type_ not in ("int", "field", "float"):
        return Compare(random.choice(("==", "!=")), one, other)
    if type_ == "int" and len(rest) > 1 and draw.chance(0.3):
        a, b = random.sample(rest, 2)
        if is_guard or draw.chance(0.4):
            return Compare(random.choice(ORDERED), f"{a} {random.choice('+-*')} {b}", one)
        return Call(random.choice(("addEq", "mulEq", "allDiff")), (a, b, one))
    if is_guard or draw.chance(0.6):
        return Compare(random.choice(ORDERED), one, other)
    return Call(random.choice(("eq", "neq", "lt", "leq")), (one, other))
