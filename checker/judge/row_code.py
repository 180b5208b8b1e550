"""Code for the row evaluator: registers, operations, tables and draws of all that is judged of tokens of one kind."""

from collections.abc import Iterator
from typing import NamedTuple

from checker.judge.bodies import Written
from checker.judge.columns import FLOAT, INT, TEXT, Texts
from checker.judge.operands import VariableNames
from checker.judge.steps import Domain
from compiler.program import Child
from runtime.executive.columns import GuardOutline, RunOutline
from runtime.executive.record import Value, ValueRange
from runtime.rows.operations import COUNT, MOST_TOKENS, STRIDE


class UnwrittenError(Exception):
    """Something for which there is no code; the group is left to other judges."""


class Held(NamedTuple):
    """A value in a register."""

    register: int
    kind: str


class RowCode:
    """What the evaluator needs beside the columns of a record."""

    def __init__(self, texts: Texts) -> None:
        self.texts = texts
        self.numbers: list[int] = []
        self.registers: list[float] = []
        self.globals: list[tuple[int, int, str]] = []  # register, index and kind
        self.tests: list[Domain] = []  # of texts
        self.fittings: list[tuple[Child, VariableNames]] = []  # which predicates may be a child's
        self.tables: list[int] = []  # where in the code the number of a table stands: below 0 that of a fitting
        self.samples: list[str] = []
        self.skipped: list[str] = []
        self.tokens = 1
        self._constants: dict[tuple[str, float], Held] = {}
        self._worlds: dict[int, Held] = {}

    def register(self, kind: str, number: float = 0.0) -> Held:
        """A register of its own."""
        self.registers.append(number)
        return Held(len(self.registers) - 1, kind)

    def constant(self, value: Value) -> Held:
        """A register that always has one value."""
        if isinstance(value, str):
            pair = (TEXT, float(self.texts.number(value)))
        elif isinstance(value, (int, float)):
            pair = (FLOAT if isinstance(value, float) else INT, float(value))
        else:
            raise UnwrittenError
        known = self._constants.get(pair)
        if known is None:
            known = self._constants[pair] = self.register(*pair)
        return known

    def unknown(self) -> Held:
        """A value of which nothing is known."""
        return self.register(FLOAT, float("nan"))

    def world(self, index: int, type_kind: str) -> Held:
        """A global variable."""
        known = self._worlds.get(index)
        if known is None:
            known = self._worlds[index] = self.register(kind_of(type_kind), float("nan"))
            self.globals.append((known.register, index, known.kind))
        return known

    def emit(self, operation: int, *numbers: int) -> int:
        """Add an operation; where it stands."""
        at = len(self.numbers)
        self.numbers += (operation, *numbers, *(0,) * (STRIDE - 1 - len(numbers)))
        return at

    def token(self) -> int:
        """One more token."""
        if self.tokens == MOST_TOKENS:
            raise UnwrittenError
        self.tokens += 1
        return self.tokens - 1

    def test(self, test: Domain) -> int:
        """The table of the texts that a declaration allows."""
        self.tests.append(test)
        return len(self.tests) - 1

    def fitting(self, child: Child, names: VariableNames) -> int:
        """The table of the predicates that a child may have."""
        self.fittings.append((child, names))
        return -len(self.fittings)


def kind_of(type_kind: str) -> str:
    """The kind of the values of a type."""
    return FLOAT if type_kind == "float" else INT if type_kind in ("int", "bool") else TEXT


class RowWriter:
    """Writes the code of one body: what its slots and tokens are there, and what the record shows of its runs."""

    __slots__ = (
        "children",
        "code",
        "depth",
        "guards",
        "locals",
        "names",
        "pending",
        "read",
        "slots",
        "tokens",
        "written",
    )

    def __init__(self, code: RowCode, names: VariableNames, written: Written, outline: RunOutline | None) -> None:
        self.code = code
        self.names = names
        self.written = written
        self.depth = 0  # guards around it
        self.pending = 0  # judged since the last count
        self.slots: dict[int, Held] = {}
        self.tokens: dict[int, tuple[int, str]] = {0: (0, names.tokens[0][1])}  # with their predicates
        self.read: dict[tuple[int, int], Held] = {}  # variables of tokens
        self.locals: Iterator[tuple[int, str]] = iter(())
        self.children: Iterator[int] = iter(())
        self.guards: Iterator[GuardOutline] = iter(())
        if outline is not None:
            self._follow(outline)

    def _follow(self, outline: RunOutline) -> None:
        self.locals = iter(outline.locals)
        self.children = iter(outline.children)
        self.guards = iter(outline.guards)

    def branch(self, outline: RunOutline) -> "RowWriter":
        """The writer of a branch, with slots and tokens of its own."""
        inner = RowWriter(self.code, self.names, self.written, outline)
        inner.depth = self.depth + 1
        inner.slots, inner.tokens, inner.read = dict(self.slots), dict(self.tokens), dict(self.read)
        return inner

    def check(self, operation: int, *numbers: int) -> None:
        """Add an operation that is one judgement."""
        self.code.emit(operation, *numbers)
        self.pending += 1

    def count(self) -> None:
        """Count what was judged."""
        if self.pending:
            self.code.emit(COUNT, 0, self.pending)
            self.pending = 0


def value_in(value: Value, kind: str, texts: Texts) -> float:
    """The number of a value that is known, and of a kind; else NaN."""
    if kind == TEXT:
        return float(texts.number(value)) if isinstance(value, str) else float("nan")
    is_known = isinstance(value, float) if kind == FLOAT else isinstance(value, int)
    return float(value) if is_known and not isinstance(value, (str, ValueRange, tuple)) else float("nan")
