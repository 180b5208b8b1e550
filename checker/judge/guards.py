"""Guards that wait: whether the record decides what their condition reads, so that a branch must have run.

A guard waits until the variables that its condition reads are decided. In an executed mission they are, once the tokens
to which they belong have begun, but for what a solver never decides: a length, and what has no finite domain.
"""

from dataclasses import dataclass
from math import isfinite

from checker.judge.operands import BodyFrame, Read, VariableNames, reader
from checker.judge.values import ends_of, is_open
from compiler.program import (
    DURATION,
    END,
    START,
    STATE,
    Constant,
    Field,
    GlobalVariable,
    LocalVariable,
    Operand,
    TokenVariable,
    UnionOf,
)
from runtime.executive.record import OpenValues, Value, ValueRange

_WHOLE = ("int", "bool", "enum", "object")


@dataclass(frozen=True, eq=False, slots=True)
class _Input:
    """A variable that a condition reads."""

    read: Read
    token: int  # whose it is; -1 for none
    variable: int
    is_whole: bool  # whether its type has finitely many values between two bounds


class GuardInputs:
    """What the condition of one guard reads, directly or in its parts."""

    def __init__(self, condition: Operand, names: VariableNames) -> None:
        self._names = names
        self._inputs = tuple(self._of(condition))

    def _of(self, operand: Operand) -> list[_Input]:
        names = self._names
        match operand:
            case LocalVariable(slot=slot) if slot in names.parts:
                return [each for part in names.parts[slot] for each in self._of(part)]
            case UnionOf(operands=operands):
                return [each for part in operands for each in self._of(part)]
            case Constant():
                return []
            case GlobalVariable(index=index) if index == names.clock:
                return []  # it counts as decided
            case TokenVariable(token=token, variable=variable):
                return [_Input(reader(operand, names), token, variable, names.kind_of(operand) in _WHOLE)]
            case Field(base=base) if base is not None:
                return [*self._of(base), _Input(reader(operand, names), -1, -1, False)]
            case _:
                return [_Input(reader(operand, names), -1, -1, names.kind_of(operand) in _WHOLE)]

    def are_decided(self, frame: BodyFrame) -> bool:
        """Whether a mission that was executed must have decided all of them by its last tick."""
        bench = frame.bench
        if bench.has_failed or bench.leaves_variables:
            return False
        return all(self._is_decided(frame, each) for each in self._inputs)

    def _is_decided(self, frame: BodyFrame, one: _Input) -> bool:
        if one.variable in (DURATION, STATE):
            return False
        if one.token >= 0:
            tok, bench = frame.tokens[one.token], frame.bench
            if tok is None or not tok.is_planned or tok.is_outdated or not bench.has_begun(tok):
                return False
            if ends_of(tok.values[END])[1] <= 0 or (one.variable == END and not bench.is_over(tok)):
                return False  # nothing is settled before the mission
        value = one.read(frame)
        return not is_open(value) or (one.is_whole and one.variable not in (START, END) and _is_finite(value))


def _is_finite(value: Value) -> bool:
    """Whether an open value is one of finitely many, if it is whole."""
    if isinstance(value, OpenValues):
        return True
    return isinstance(value, ValueRange) and isfinite(value.lower) and isfinite(value.upper)
