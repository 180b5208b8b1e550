"""Register code: what a determined reactor does when one of its tokens starts, as integers for a compiled loop."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from compiler.program import PredicateCode
from nddl_lang.text.source import Span

# Operations, by number; registers hold doubles, NaN where a value is not known. The machine has the same numbers.
HALT, COPY, ADD, SUB, MUL, DIV, NEG, ABS, MIN, MAX, SQRT, FLOOR, CEIL, MOD, WHOLE = range(15)
LEQ, LESS, EQUAL, SAME, NOT, AND, OR = range(15, 22)
DISTANCE, TOWARDS, TRAVEL = range(22, 25)
UNIFY, NEED, HOLD, CLEAR, WHEN_FALSE, WHEN_TRUE, DRAW = range(25, 32)
MOVE, MUL_ADD, UNLESS_SAME = range(32, 35)  # several copies; a product and a sum, each rounded; SAME and WHEN_FALSE
BEGIN, MERGE, PREVIOUS, FOLLOW, LAST_EXACTLY, LAST_LEAST, LAST_MOST, TIE, WITHIN, MEMBER, ORDER, PLANNED = range(35, 47)
COPIES = 47  # three copies, one after the other: results and sources in turn
TARGET = {WHEN_FALSE: 2, WHEN_TRUE: 2, UNLESS_SAME: 4}  # where a jump has the number of an instruction
_NEVER_STOP = {HALT, COPY, ADD, SUB, MUL, NEG, ABS, MIN, MAX, FLOOR, CEIL, LEQ, LESS, EQUAL, SAME, NOT, AND, OR, CLEAR}
_NEVER_STOP |= {WHEN_FALSE, WHEN_TRUE, UNLESS_SAME, DRAW, MOVE, COPIES, MUL_ADD}
_BOUNDS = {LAST_EXACTLY, LAST_LEAST, LAST_MOST}
STRIDE = 8  # numbers of an instruction: operation, result, up to six operands

_FLOAT_TOLERANCE = 1e-5  # that of the engine
LARGEST = 2.0**51  # what is larger counts as infinite


@dataclass(frozen=True, slots=True)
class Line:
    """A timeline as the analysis needs it: global name, class, default predicate (short, or empty), who owns it."""

    name: str
    class_name: str
    default: str
    role: str  # own, used, or other: of the model, but not of the reactor


@dataclass(frozen=True, slots=True)
class Shown:
    """A register of a block with its name in the model: for the record of what was executed."""

    name: str
    register: int
    kind: str
    type_name: str


@dataclass(frozen=True, slots=True)
class BlockToken:
    """A token that a block knows: how it came (root, together, merged, previous, following), by which child slot."""

    how: str
    line: int
    predicate: PredicateCode
    parent: int  # number of the token whose rule asked for it; -1 for the root
    rule: int
    slot: int
    context: tuple[tuple[int, bool], ...]


def begun_with(tokens: Sequence[BlockToken], token: BlockToken) -> Iterator[BlockToken]:
    """The tokens by whose rules a token begins, one after the other, up to the root of the block."""
    while token.parent >= 0:
        token = tokens[token.parent]
        yield token


@dataclass(frozen=True, slots=True)
class GuardRecord:
    """A guard of a rule instance and the register of its condition."""

    token: int
    rule: int
    register: int
    context: tuple[tuple[int, bool], ...]
    span: Span


@dataclass(frozen=True, slots=True)
class LocalRecord:
    """A local variable of a rule instance."""

    token: int
    rule: int
    slot: int
    shown: Shown
    context: tuple[tuple[int, bool], ...]


@dataclass(frozen=True, slots=True)
class RegisterBlock:
    """What happens when a token of `predicate` starts on timeline `line`, the parameters in `mask` being given."""

    line: int
    predicate: PredicateCode
    mask: int
    instructions: tuple[tuple[int, ...], ...]
    tokens: tuple[BlockToken, ...]
    guards: tuple[GuardRecord, ...]
    locals: tuple[LocalRecord, ...]
    draws: tuple[int, ...]
    is_sure: bool  # whether all parameters of the tokens that begin must have a value

    def always_begins(self, layout: "RegisterLayout") -> bool:
        """Whether it begins at any time, by code that cannot stop: it bounds no end but by one known length."""
        told = layout.current[self.line] + layout.widths[self.line] - 1 if layout.tells_lengths else -1
        lengths = 0
        for operation, *operands in self.instructions:
            if operation in _BOUNDS:
                lengths += 1
                if lengths > 1 or not (operands[1] == told or layout.presets.get(operands[1], 0.0) >= 1.0):
                    return False
            elif operation not in _NEVER_STOP and (operation != FOLLOW or operands[0] != self.line):
                return False
        return True


@dataclass(eq=False, slots=True)
class RegisterLayout:
    """The registers of a reactor; blocks that are compiled later take more at the end.

    Of each timeline there are banks of parameters: of the current token, of the one that is to follow it, of one that
    is due to start now, of one that somebody asked for, and of the token before (where a rule reads it: `remembered`).
    Where `tells_lengths`, the last register of each bank is how long the token lasts, if the one before it says so.
    """

    lines: tuple[Line, ...]
    widths: list[int]
    current: list[int] = field(default_factory=list)
    following: list[int] = field(default_factory=list)
    incoming: list[int] = field(default_factory=list)
    wished: list[int] = field(default_factory=list)
    previous: list[int] = field(default_factory=list)
    starts: list[int] = field(default_factory=list)
    constants: dict[float, int] = field(default_factory=dict)
    presets: dict[int, float] = field(default_factory=dict)  # register -> value that it has for ever
    symbols: dict[str, int] = field(default_factory=dict)  # texts, enum values and objects by number
    globals: dict[int, int] = field(default_factory=dict)  # global variable -> register
    members: dict[tuple[str, tuple[str, ...]], int] = field(default_factory=dict)  # object, member path -> register
    samples: dict[str, int] = field(default_factory=dict)  # parameter -> number
    remembered: set[int] = field(default_factory=set)
    tells_lengths: bool = False
    top: int = 1  # register 0 holds the tick that is now

    def __post_init__(self) -> None:
        """Give every timeline its banks."""
        for width in self.widths:
            for bank in (self.current, self.following, self.incoming, self.wished, self.previous):
                bank.append(self.take(width))
            self.starts.append(self.take(1))

    def take(self, count: int) -> int:
        """The first of `count` new registers."""
        self.top += count
        return self.top - count

    def constant(self, value: float) -> int:
        """The register that holds a constant."""
        if value not in self.constants:
            self.constants[value] = self.take(1)
            self.presets[self.constants[value]] = value
        return self.constants[value]

    def symbol(self, text: str) -> int:
        """The number of a text, enum value or object."""
        return self.symbols.setdefault(text, len(self.symbols))

    def global_variable(self, index: int) -> int:
        """The register of a global variable."""
        if index not in self.globals:
            self.globals[index] = self.take(1)
        return self.globals[index]

    def member(self, name: str, path: tuple[str, ...]) -> int:
        """The register of a member of an object."""
        if (name, path) not in self.members:
            self.members[name, path] = self.take(1)
        return self.members[name, path]

    def sample(self, name: str) -> int:
        """The number of a sampled parameter."""
        return self.samples.setdefault(name, len(self.samples))
