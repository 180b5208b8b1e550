"""Test a constraint as the engine would use it: does it ever lose a solution, does it refuse what is wrong?"""

from collections.abc import Iterable, Iterator, Sequence
from math import inf

from nddl_lang.semantics.signature import ArgumentKind
from runtime.constraints.domains.tags import (
    KIND_BOOL,
    KIND_FLOAT,
    KIND_INT,
    KIND_OBJECT,
    KIND_STRING,
    KIND_SYMBOL,
)
from runtime.constraints.engine import Engine
from runtime.user.constraint import Constraint
from runtime.user.library import row_of
from runtime.user.view import Value
from runtime.user.written import Written, has_test

ROUNDS = 100
WIDTHS = (0.0, 0.00000001, 1.0, 7.0, 250.0, 1e6)
WHOLE_WIDTHS = (0, 1, 2, 7, 250, 1000000)


class UnsoundError(AssertionError):
    """A constraint does what it must not; the message shows the smallest case found."""


def check_sound(
    constraint: Constraint,
    samples: Iterable[Sequence[Value]],
    wrong: Iterable[Sequence[Value]] = (),
    rounds: int = ROUNDS,
) -> None:
    """Check a constraint on `samples`, for which it holds, and on values for which it is `wrong`.

    Around each sample `rounds` sets of domains are laid: single values, narrow and wide intervals, half and wholly
    unbounded ones, lists. Propagation must keep the sample in each, and refuse what is wrong. Raises UnsoundError, or
    UserCodeError where the constraint itself fails. A whole number stands for an int, `1.0` for a float; a string for
    a text, an object or a value of an enum, as the signature says.
    """
    row_of(type(constraint).__name__, constraint)
    solutions = [tuple(sample) for sample in samples]
    if not solutions:
        raise ValueError("without samples there is nothing to check")
    bench = _Bench(constraint, [*solutions, *(tuple(each) for each in wrong)])
    for sample in solutions:
        if has_test(constraint) and not constraint.holds(sample):
            raise UnsoundError(f"`{constraint.name}`: `holds` denies the sample {_listed(sample)}")
        bench.keeps(sample, [(value, value) for value in sample], None)
        for number in range(rounds):
            bench.keeps(sample, *bench.domains(sample, number))
    for each in wrong:
        bench.refuses(tuple(each))


class _Bench:
    """An engine for each case, and names as numbers."""

    def __init__(self, constraint: Constraint, samples: list[tuple[Value, ...]]) -> None:
        self.constraint = constraint
        self.row = row_of(type(constraint).__name__, constraint)
        self.names = sorted({value for sample in samples for value in sample if isinstance(value, str)})
        for sample in samples:
            if not self.row.signature.accepts(len(sample)):
                expected = self.row.signature.count_text
                raise ValueError(f"`{constraint.name}` takes {expected}; the sample {_listed(sample)} has others")

    # ---- Words ----

    def text(self, kind: int, number: int) -> str:
        """The name that has a number."""
        return self.names[number] if 0 <= number < len(self.names) else f"another name ({number})"

    def number(self, kind: int, text: str) -> int | None:
        """The number of a name; of one that no sample has, none."""
        return self.names.index(text) if text in self.names else None

    def source_place(self, span: int) -> str | None:
        """Nowhere: there is no model."""
        return None

    # ---- checks ----

    def keeps(self, sample: tuple[Value, ...], domains: list[tuple[Value, Value]], listed: int | None) -> None:
        """Propagate over domains that hold the sample; it must still be there."""
        engine, variables = self.engine(sample, domains, listed)
        before = [self.shown(engine, v) for v in variables]
        engine.post_external(Written(self.constraint, self), variables, -1, -1)
        holds = engine.propagate()
        case = f"`{self.constraint.name}` over {', '.join(before)}"
        if not holds:
            raise UnsoundError(f"{case} was refused, but {_listed(sample)} is a solution")
        for place, (v, value) in enumerate(zip(variables, sample, strict=True)):
            if not engine.contains(v, self.coded(value)):
                left = self.shown(engine, v)
                raise UnsoundError(f"{case} left {left} for argument {place}, but {_listed(sample)} is a solution")

    def refuses(self, values: tuple[Value, ...]) -> None:
        """Propagate over single values that are wrong; that must be found."""
        engine, variables = self.engine(values, [(value, value) for value in values], None)
        engine.post_external(Written(self.constraint, self), variables, -1, -1)
        if engine.propagate():
            raise UnsoundError(f"`{self.constraint.name}` accepts {_listed(values)}, which is wrong")

    # ---- cases ----

    def domains(self, sample: tuple[Value, ...], number: int) -> tuple[list[tuple[Value, Value]], int | None]:
        """The bounds of case `number`, and which argument is a list of values (None: none is)."""
        dice = _dice(number + 1)
        chosen: list[tuple[Value, Value]] = []
        for value in sample:
            if isinstance(value, str | bool):
                chosen.append((value, value) if next(dice) % 3 == 0 else (0, 1))
                continue
            widths: Sequence[float] = WIDTHS if isinstance(value, float) else WHOLE_WIDTHS
            below, above = (widths[next(dice) % len(widths)] for _ in range(2))
            low = -inf if next(dice) % 8 == 0 else value - below
            high = inf if next(dice) % 8 == 0 else value + above
            chosen.append((low, high))
        return chosen, next(dice) % len(sample) if next(dice) % 4 == 0 else None

    def engine(
        self, sample: tuple[Value, ...], domains: list[tuple[Value, Value]], listed: int | None
    ) -> tuple[Engine, list[int]]:
        """A fresh engine with a variable for each argument."""
        engine = Engine()
        variables = []
        for place, (value, (low, high)) in enumerate(zip(sample, domains, strict=True)):
            kind = self.kind(place, value)
            code = self.coded(value)
            if kind in (KIND_SYMBOL, KIND_OBJECT, KIND_STRING):
                values = [code] if low == high else [float(each) for each in range(len(self.names))]
                variables.append(engine.new_values(kind, values, -1, -1))
            elif place == listed and kind != KIND_BOOL:
                variables.append(engine.new_values(kind, sorted({code - 3, code, code + 1, code + 40}), -1, -1))
            else:
                variables.append(engine.new_interval(kind, float(low), float(high), -1, -1))
        return engine, variables

    def kind(self, place: int, value: Value) -> int:
        """The kind of variable that a value asks for."""
        if isinstance(value, str):
            argument = self.row.signature.argument(place)
            if argument is not None and argument.kind is ArgumentKind.OBJECT:
                return KIND_OBJECT
            return KIND_STRING if argument is not None and argument.kind is ArgumentKind.STRING else KIND_SYMBOL
        if isinstance(value, bool):
            return KIND_BOOL
        return KIND_INT if isinstance(value, int) else KIND_FLOAT

    def coded(self, value: Value) -> float:
        """A value as the engine keeps it."""
        return float(self.names.index(value)) if isinstance(value, str) else float(value)

    def shown(self, engine: Engine, v: int) -> str:
        """A domain in words."""
        kind = engine.kind[v]
        if kind in (KIND_SYMBOL, KIND_OBJECT, KIND_STRING):
            return "{" + ", ".join(self.text(kind, int(x)) for x in engine.values_of(v)) + "}"
        low, high = engine.lower(v), engine.upper(v)
        return f"{low:.12g}" if low == high else f"[{low:.12g}, {high:.12g}]"


def _dice(seed: int) -> Iterator[int]:
    """Numbers that look random and are the same on every machine (a linear congruence; its high bits)."""
    state = seed * 0x9E3779B97F4A7C15 % (1 << 64)
    while True:
        state = (state * 6364136223846793005 + 1442695040888963407) % (1 << 64)
        yield state >> 40


def _listed(values: Sequence[Value]) -> str:
    return f"({', '.join(repr(value) for value in values)})"
