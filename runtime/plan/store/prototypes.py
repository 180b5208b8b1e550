"""Prototypes: variables that others copy, one per type and restriction, per constant, per class."""

from collections.abc import Iterable
from math import inf

from compiler.program import DomainConstant, Program, TypeCode
from runtime.constraints.domains.tags import (
    INF,
    KIND_BOOL,
    KIND_FLOAT,
    KIND_INT,
    KIND_OBJECT,
    KIND_STRING,
    KIND_SYMBOL,
)
from runtime.constraints.engine import Engine
from runtime.plan.store.names import Names
from runtime.plan.tags import NONE, STATE_SYMBOLS

_KINDS = {
    "bool": KIND_BOOL,
    "int": KIND_INT,
    "float": KIND_FLOAT,
    "string": KIND_STRING,
    "symbol": KIND_SYMBOL,
    "enum": KIND_SYMBOL,
    "object": KIND_OBJECT,
}
STATES = "TokenStates"


class Prototypes:
    """Prototypes and constants, made when they are first asked for; symbols and texts as numbers."""

    def __init__(self, engine: Engine, program: Program) -> None:
        self.engine = engine
        self.symbols = Names()
        self.symbol_enum: list[str] = []
        self.enum_values: dict[str, tuple[float, ...]] = {}
        self.texts = Names()
        self.class_numbers = {code.name: number for number, code in enumerate(program.classes)}
        self.base = [NONE if code.base is None else self.class_numbers.get(code.base, NONE) for code in program.classes]
        self.heirs_of: list[list[int]] = [[] for _ in program.classes]  # the classes that extend each directly
        for number, base in enumerate(self.base):
            if base != NONE:
                self.heirs_of[base].append(number)
        self.made: dict[tuple[TypeCode, DomainConstant | None], int] = {}
        self.class_of: dict[int, int] = {}  # prototype of an object variable -> class
        self.openings: list[list[int]] = [[] for _ in program.classes]  # open variables of each class
        self.objects: list[list[float]] = [[] for _ in program.classes]  # of each class, subclasses included
        self.is_closed = [False for _ in program.classes]
        for symbol in STATE_SYMBOLS:
            self._add_symbol(symbol, STATES)
        self.enum_values[STATES] = tuple(range(len(STATE_SYMBOLS)))
        for name, values in program.enums:
            if name != STATES:
                self.enum_values[name] = tuple(self._add_symbol(value, name) for value in values)

    def _add_symbol(self, name: str, enum: str) -> int:
        """Give a value of an enum its number."""
        number = self.symbols.number(name)
        if number == len(self.symbol_enum):
            self.symbol_enum.append(enum)
        return number

    def ancestry(self, number: int) -> list[int]:
        """A class, its base, and so on."""
        chain = []
        while number >= 0:
            chain.append(number)
            number = self.base[number]
        return chain

    def heirs(self, number: int) -> list[int]:
        """A class and all that extend it, directly or not."""
        found = [number]
        for heir in found:
            found += self.heirs_of[heir]
        return found

    def with_ancestors(self, numbers: Iterable[int]) -> set[int]:
        """These classes and all that they are derived from."""
        found: set[int] = set()
        for number in numbers:
            while number >= 0 and number not in found:
                found.add(number)
                number = self.base[number]
        return found

    def value(self, value: float | int | bool | str, kind: str) -> float:
        """A value as the engine keeps it."""
        if isinstance(value, str):
            return self.texts.number(value) if kind == "string" else self.symbols.number(value)
        return value

    def of(self, type_: TypeCode, domain: DomainConstant | None) -> int:
        """The prototype of a type with an optional further restriction."""
        key = (type_, domain)
        v = self.made.get(key, NONE)
        if v < 0:
            restrictions = [each for each in (type_.domain, domain) if each is not None]
            if type_.kind == "string" and restrictions:
                texts = [self.value(each, "string") for each in restrictions.pop(0).values or ()]
                v = self.engine.new_values(KIND_STRING, texts, NONE, NONE)
            else:
                v = self._full(type_.kind, type_.type_name)
            for restriction in restrictions:
                restrict_constant(self, v, restriction, NONE, NONE)
            self.made[key] = v
            number = self.class_numbers.get(type_.type_name, NONE) if type_.kind == "object" else NONE
            if number >= 0:
                self.class_of[v] = number
                self.note(v, v)
        return v

    def note(self, v: int, prototype: int) -> None:
        """Remember an open variable that is like a prototype: later objects of its class are added to it."""
        number = self.class_of.get(prototype, NONE)
        if number >= 0:
            self.openings[number].append(v)

    def still_open(self, number: int) -> list[int]:
        """The variables of a class that are open, each once; others are forgotten."""
        engine = self.engine
        kept = dict.fromkeys(v for v in self.openings[number] if engine.kind[v] == KIND_OBJECT and engine.is_open[v])
        self.openings[number] = list(kept)
        return self.openings[number]

    def of_domain(self, domain: DomainConstant) -> int:
        """The prototype whose domain is a constant."""
        return self.of(TypeCode(domain.kind, domain.type_name, None), domain)

    def constant(self, domain: DomainConstant) -> int:
        """The shared variable of a constant with a single value."""
        value = domain.values[0] if domain.values is not None else domain.interval[0] if domain.interval else 0
        number = self.value(value, domain.kind)
        return self.engine.new_constant(_KINDS[domain.kind], number, number)

    def _full(self, kind: str, name: str) -> int:
        """A variable with all values of a type."""
        engine = self.engine
        match kind:
            case "int":
                return engine.new_interval(KIND_INT, -inf, inf, NONE, NONE)
            case "float":
                return engine.new_interval(KIND_FLOAT, -inf, inf, NONE, NONE)
            case "bool":
                return engine.new_interval(KIND_BOOL, 0, 1, NONE, NONE)
            case "enum":
                return engine.new_values(KIND_SYMBOL, [*self.enum_values[name]], NONE, NONE)
            case "symbol":
                return engine.new_open(KIND_SYMBOL, [], NONE, NONE)
            case "object":
                number = self.class_numbers.get(name, NONE)
                objects = [] if number < 0 else self.objects[number]
                if number >= 0 and self.is_closed[number]:
                    return engine.new_values(KIND_OBJECT, objects, NONE, NONE)
                return engine.new_open(KIND_OBJECT, objects, NONE, NONE)
            case _:
                return engine.new_open(KIND_STRING, [], NONE, NONE)


def restrict_constant(prototypes: Prototypes, v: int, domain: DomainConstant, span: int, owner: int) -> bool:
    """Intersect the base domain of a variable with a constant."""
    engine = prototypes.engine
    if domain.values is not None:
        values = [prototypes.value(value, domain.kind) for value in domain.values]
        return engine.restrict_base_values(v, values, span, owner)
    if domain.interval is not None:
        lower, upper = domain.interval
        return engine.restrict_base(v, _limit(lower), _limit(upper), span, owner)
    return True


def _limit(bound: float) -> float:
    """A bound as the engine takes it."""
    if bound >= INF:
        return inf
    return -inf if bound <= -INF else bound
