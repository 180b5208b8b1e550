"""Ways to compute: what each constraint can tell of which operand once the others are known, as instructions."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from compiler.determined import code
from compiler.determined.code import RegisterLayout

Instruction = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Cell:
    """A register and the kind of what it holds."""

    register: int
    kind: str

    @property
    def is_real(self) -> bool:
        """Whether it holds a float."""
        return self.kind == "float"


@dataclass(frozen=True, slots=True)
class Way:
    """Instructions that compute `outputs` from `inputs`."""

    outputs: tuple[int, ...]
    inputs: tuple[int, ...]
    instructions: tuple[Instruction, ...]


Ways = list[Way]


def computed(layout: RegisterLayout, operation: int, out: Cell, inputs: Sequence[Cell]) -> Way:
    """One operation; what goes into a whole number is brought to the next one if it is within the tolerance."""
    registers = tuple(cell.register for cell in inputs)
    is_fraction = operation == code.DIV or any(cell.is_real for cell in inputs)
    if out.is_real or not is_fraction:
        return Way((out.register,), registers, ((operation, out.register, *registers),))
    raw = layout.take(1)
    return Way((out.register,), registers, ((operation, raw, *registers), (code.WHOLE, out.register, raw)))


def equal_ways(layout: RegisterLayout, a: Cell, b: Cell) -> Ways:
    """Copy either into the other."""
    return [computed(layout, code.COPY, a, (b,)), computed(layout, code.COPY, b, (a,))]


def _sum(layout: RegisterLayout, cells: Sequence[Cell]) -> Ways:
    a, b, c = cells
    return [
        computed(layout, code.ADD, c, (a, b)),
        computed(layout, code.SUB, a, (c, b)),
        computed(layout, code.SUB, b, (c, a)),
    ]


def _product(layout: RegisterLayout, cells: Sequence[Cell]) -> Ways:
    a, b, c = cells
    ways = [computed(layout, code.MUL, c, (a, b))]
    if a.is_real or b.is_real or c.is_real:
        ways += [computed(layout, code.DIV, a, (c, b)), computed(layout, code.DIV, b, (c, a))]
    return ways


def _quotient(layout: RegisterLayout, cells: Sequence[Cell]) -> Ways:
    a, b, q = cells
    return [computed(layout, code.DIV, q, (a, b)), computed(layout, code.MUL, a, (q, b))]


def _negative(layout: RegisterLayout, cells: Sequence[Cell]) -> Ways:
    a, b = cells
    return [computed(layout, code.NEG, a, (b,)), computed(layout, code.NEG, b, (a,))]


def _function(operation: int) -> Callable[[RegisterLayout, Sequence[Cell]], Ways]:
    return lambda layout, cells: [computed(layout, operation, cells[0], cells[1:])]


def _chain(operation: int) -> Callable[[RegisterLayout, Sequence[Cell]], Ways]:
    """The first operand is what the operation makes of the others, from left to right."""

    def ways(layout: RegisterLayout, cells: Sequence[Cell]) -> Ways:
        out, so_far, *others = cells
        instructions: list[Instruction] = []
        inputs = tuple(cell.register for cell in cells[1:])
        for other in others:
            kind = "float" if so_far.is_real or other.is_real else so_far.kind
            together = Cell(layout.take(1), kind)
            instructions += computed(layout, operation, together, (so_far, other)).instructions
            so_far = together
        instructions += computed(layout, code.COPY, out, (so_far,)).instructions
        return [Way((out.register,), inputs, tuple(instructions))]

    return ways


def _points(operation: int, outputs: int) -> Callable[[RegisterLayout, Sequence[Cell]], Ways]:
    """Functions of positions: all operands behind the outputs are inputs."""

    def ways(layout: RegisterLayout, cells: Sequence[Cell]) -> Ways:
        registers = tuple(cell.register for cell in cells)
        if outputs == 1:
            return [computed(layout, operation, cells[0], cells[1:])]
        if not all(cell.is_real for cell in cells[:outputs]):
            return []
        return [Way(registers[:outputs], registers[outputs:], ((operation, *registers),))]

    return ways


def _test(
    real: int, whole: int, swapped: bool = False, negated: bool = False
) -> Callable[[RegisterLayout, Sequence[Cell]], Ways]:
    """A comparison as a truth value."""

    def ways(layout: RegisterLayout, cells: Sequence[Cell]) -> Ways:
        out, a, b = cells
        if swapped:
            a, b = b, a
        operation = real if a.is_real or b.is_real else whole
        inputs = (cells[1].register, cells[2].register)
        if not negated:
            return [Way((out.register,), inputs, ((operation, out.register, a.register, b.register),))]
        raw = layout.take(1)
        instructions = ((operation, raw, a.register, b.register), (code.NOT, out.register, raw))
        return [Way((out.register,), inputs, instructions)]

    return ways


def _truth(operation: int) -> Callable[[RegisterLayout, Sequence[Cell]], Ways]:
    def ways(layout: RegisterLayout, cells: Sequence[Cell]) -> Ways:
        registers = tuple(cell.register for cell in cells)
        return [Way(registers[:1], registers[1:], ((operation, *registers),))]

    return ways


FUNCTIONS: dict[str, Callable[[RegisterLayout, Sequence[Cell]], Ways]] = {
    "addEq": _sum,
    "mulEq": _product,
    "divEq": _quotient,
    "neg": _negative,
    "eqSum": _chain(code.ADD),
    "eqProduct": _chain(code.MUL),
    "eqMaximum": _chain(code.MAX),
    "eqMinimum": _chain(code.MIN),
    "allMax": _chain(code.MAX),
    "allMin": _chain(code.MIN),
    "maxf": _chain(code.MAX),
    "minf": _chain(code.MIN),
    "absVal": _function(code.ABS),
    "abs": _function(code.ABS),
    "absf": _function(code.ABS),
    "sqrt": _function(code.SQRT),
    "floor": _function(code.FLOOR),
    "ceil": _function(code.CEIL),
    "mod": _function(code.MOD),
    "calcDistance": _points(code.DISTANCE, 1),
    "towards": _points(code.TOWARDS, 2),
    "travelTime": _points(code.TRAVEL, 1),
    "testEq": _test(code.EQUAL, code.SAME),
    "testNeq": _test(code.EQUAL, code.SAME, negated=True),
    "testLeq": _test(code.LEQ, code.LEQ),
    "testLessThan": _test(code.LESS, code.LESS),
    "testAnd": _truth(code.AND),
    "testOr": _truth(code.OR),
    "testNot": _truth(code.NOT),
}

# Comparisons that are demanded: they compute nothing, they hold or they do not.
DEMANDS: dict[str, tuple[int, int, bool]] = {
    "leq": (code.LEQ, code.LEQ, True),
    "precedes": (code.LEQ, code.LEQ, True),
    "lt": (code.LESS, code.LESS, True),
    "strictlyPrecedes": (code.LESS, code.LESS, True),
    "neq": (code.EQUAL, code.SAME, False),
}


def demand(layout: RegisterLayout, name: str, cells: Sequence[Cell]) -> tuple[Instruction, ...]:
    """Instructions that hold the machine up unless a comparison is true."""
    real, whole, wanted = DEMANDS[name]
    a, b = cells
    operation = real if a.is_real or b.is_real else whole
    result = layout.take(1)
    instructions: tuple[Instruction, ...] = ((operation, result, a.register, b.register),)
    if not wanted:
        other = layout.take(1)
        instructions += ((code.NOT, other, result),)
        result = other
    return (*instructions, (code.HOLD, result))
