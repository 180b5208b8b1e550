"""Constraints on the end of a token: bounds relative to its start, or ties between ends, as instructions."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from compiler.determined import code
from compiler.determined.code import RegisterLayout
from compiler.determined.operations import Cell, Instruction
from compiler.determined.reasons import FreeChoice, UndeterminedError
from compiler.program import DURATION, END, DomainConstant
from nddl_lang.text.source import Span


@dataclass(frozen=True, slots=True)
class Time:
    """The end or the duration of a token of the block."""

    token: int
    variable: int


@dataclass(frozen=True, slots=True)
class Act:
    """Instructions that bound an end, and the registers that they read."""

    needs: tuple[int, ...]
    instructions: tuple[Instruction, ...]


Operands = Sequence["Cell | Time | DomainConstant"]
LineOf = Callable[[Time], int]
SWAPPED = {code.LAST_LEAST: code.LAST_MOST, code.LAST_MOST: code.LAST_LEAST, code.LAST_EXACTLY: code.LAST_EXACTLY}


def is_time_constraint(operands: Operands) -> bool:
    """Whether an end or a duration takes part."""
    return any(isinstance(each, Time) for each in operands)


def demand_time(layout: RegisterLayout, name: str, operands: Operands, line_of: LineOf, span: Span) -> list[Act]:
    """What a constraint says of ends; raises `UndeterminedError` where it says it of what is not known."""
    if name in ("eq", "concurrent"):
        pairs = pairwise(operands)
        return [act for a, b in pairs for act in _pair(layout, code.LAST_EXACTLY, a, b, 0, line_of, span)]
    if name in ("leq", "precedes"):
        return _pair(layout, code.LAST_MOST, operands[0], operands[1], 0, line_of, span)
    if name in ("lt", "strictlyPrecedes"):
        return _pair(layout, code.LAST_MOST, operands[0], operands[1], -1, line_of, span)
    if name == "temporalDistance":
        return _distance(layout, operands, line_of, span)
    raise UndeterminedError(FreeChoice.END, span.text.split("\n")[0], span)


def _pair(
    layout: RegisterLayout,
    relation: int,
    a: "Cell | Time | DomainConstant",
    b: "Cell | Time | DomainConstant",
    step: int,
    line_of: LineOf,
    span: Span,
) -> list[Act]:
    """`a` relation `b` + `step`."""
    if isinstance(a, Time) and isinstance(b, Time):
        if a.variable != END or b.variable != END or step:
            raise UndeterminedError(FreeChoice.END, span.text.split("\n")[0], span)
        tie = code.TIE if relation == code.LAST_EXACTLY else code.WITHIN
        return [Act((), ((tie, line_of(a), line_of(b)),))]
    if isinstance(b, Time):
        a, b, relation, step = b, a, SWAPPED[relation], -step
    assert isinstance(a, Time)
    if isinstance(b, DomainConstant):
        return _bounds(layout, relation, a, b, step, line_of, span)
    assert isinstance(b, Cell)
    if b.is_real and step:
        raise UndeterminedError(FreeChoice.END, span.text.split("\n")[0], span)
    instructions: list[Instruction] = []
    value = b.register
    if b.is_real:
        rounded = layout.take(1)
        rounding = {code.LAST_LEAST: code.CEIL, code.LAST_MOST: code.FLOOR, code.LAST_EXACTLY: code.WHOLE}[relation]
        instructions.append((rounding, rounded, value))
        value = rounded
    if step:
        moved = layout.take(1)
        instructions.append((code.ADD, moved, value, layout.constant(float(step))))
        value = moved
    instructions += _relative(layout, relation, a, value, line_of)
    return [Act((b.register,), tuple(instructions))]


def _relative(layout: RegisterLayout, relation: int, time: Time, value: int, line_of: LineOf) -> list[Instruction]:
    """Bound a duration, or an end: the machine counts from the start of the token."""
    line = line_of(time)
    if time.variable == DURATION:
        return [(relation, line, value)]
    lasting = layout.take(1)
    return [(code.SUB, lasting, value, layout.starts[line]), (relation, line, lasting)]


def _bounds(
    layout: RegisterLayout, relation: int, time: Time, domain: DomainConstant, step: int, line_of: LineOf, span: Span
) -> list[Act]:
    """An end or duration against an interval: what it may be at most, at least, or both."""
    if domain.interval is None:
        raise UndeterminedError(FreeChoice.END, span.text.split("\n")[0], span)
    lower, upper = domain.interval
    acts = []
    if relation != code.LAST_MOST and lower > -code.LARGEST:
        bound = layout.constant(float(lower + step))
        acts.append(Act((), tuple(_relative(layout, code.LAST_LEAST, time, bound, line_of))))
    if relation != code.LAST_LEAST and upper < code.LARGEST:
        bound = layout.constant(float(upper + step))
        acts.append(Act((), tuple(_relative(layout, code.LAST_MOST, time, bound, line_of))))
    return acts


def _distance(layout: RegisterLayout, operands: Operands, line_of: LineOf, span: Span) -> list[Act]:
    """`later - earlier` is `distance`."""
    earlier, distance, later = operands
    if isinstance(distance, Time):
        raise UndeterminedError(FreeChoice.END, span.text.split("\n")[0], span)
    if isinstance(earlier, Time) and isinstance(later, Time):
        if isinstance(distance, DomainConstant) and distance.interval is not None:
            lower, upper = distance.interval
            if earlier.variable == later.variable == END:
                if lower <= -code.LARGEST and upper == 0:
                    return [Act((), ((code.WITHIN, line_of(later), line_of(earlier)),))]
                if lower == 0 and upper >= code.LARGEST:
                    return [Act((), ((code.WITHIN, line_of(earlier), line_of(later)),))]
        raise UndeterminedError(FreeChoice.END, span.text.split("\n")[0], span)
    base = later if isinstance(earlier, Time) else earlier
    time = earlier if isinstance(earlier, Time) else later
    if not isinstance(base, Cell) or not isinstance(time, Time) or time.variable != END:
        raise UndeterminedError(FreeChoice.END, span.text.split("\n")[0], span)
    way = code.SUB if isinstance(earlier, Time) else code.ADD
    if isinstance(distance, Cell):
        value = layout.take(1)
        instructions = ((way, value, base.register, distance.register),)
        return [
            Act(
                (base.register, distance.register),
                (*instructions, *_relative(layout, code.LAST_EXACTLY, time, value, line_of)),
            )
        ]
    if distance.interval is None:
        raise UndeterminedError(FreeChoice.END, span.text.split("\n")[0], span)
    acts = []
    for bound, is_lower in zip(distance.interval, (True, False), strict=True):
        if abs(bound) < code.LARGEST:
            value = layout.take(1)
            relation = code.LAST_LEAST if is_lower == (way == code.ADD) else code.LAST_MOST
            first = (way, value, base.register, layout.constant(float(bound)))
            acts.append(Act((base.register,), (first, *_relative(layout, relation, time, value, line_of))))
    return acts
