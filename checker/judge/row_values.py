"""Values as the code for the row evaluator has them: operands, comparisons and functions in, registers out.

The meanings are those of `bulk_meanings`; kinds are known when the code is written.
"""

from collections.abc import Callable

from checker.judge.columns import FLOAT, INT, TEXT
from checker.judge.operands import VariableNames, domain_value
from checker.judge.row_code import Held, RowWriter, UnwrittenError, kind_of
from compiler.program import (
    DURATION,
    END,
    FIRST_PARAMETER,
    OBJECT,
    START,
    STATE,
    Constant,
    GlobalVariable,
    LocalVariable,
    Operand,
    TokenVariable,
)
from runtime.rows import operations as op

RegisterRead = Callable[[RowWriter], Held]


def register_reader(operand: Operand, names: VariableNames) -> RegisterRead:
    """The function that brings `operand` into a register."""
    match operand:
        case Constant(domain=domain):
            value = domain_value(domain)
            return lambda writer: writer.code.constant(value)
        case GlobalVariable(index=index) if index != names.clock:
            type_kind = names.program.globals[index][1].kind
            return lambda writer: writer.code.world(index, type_kind)
        case LocalVariable(slot=slot):
            return lambda writer: writer.slots.get(slot) or writer.code.unknown()
        case TokenVariable(token=token, variable=variable) if variable != STATE:
            return lambda writer: variable_of(writer, token, variable)
        case _:
            return _refuse


def _refuse(writer: RowWriter) -> Held:
    raise UnwrittenError


def variable_of(writer: RowWriter, token: int, variable: int) -> Held:
    """A variable of a token, which is read once."""
    if token not in writer.tokens:
        return writer.code.unknown()
    known = writer.read.get((token, variable))
    if known is None:
        known = writer.read[(token, variable)] = _read_variable(writer, token, variable)
    return known


def _read_variable(writer: RowWriter, token: int, variable: int) -> Held:
    code = writer.code
    number, predicate = writer.tokens[token]
    if variable == DURATION:
        end, start = (variable_of(writer, token, each) for each in (END, START))
        return computed(writer, op.SUBTRACT, INT, end, start)
    if variable in (START, END):
        found = code.register(INT)
        code.emit(op.TIME, found.register, number, int(variable == END))
    elif variable == OBJECT:
        found = code.register(TEXT)
        code.emit(op.OBJECT, found.register, number)
    else:
        parameters = writer.names.predicates[predicate].parameters
        if not 0 <= variable - FIRST_PARAMETER < len(parameters):
            raise UnwrittenError
        kind = parameters[variable - FIRST_PARAMETER].type.kind
        found = code.register(kind_of(kind))
        code.emit(op.PARAMETER, found.register, number, variable - FIRST_PARAMETER, form_of(kind))
    return found


def form_of(type_kind: str) -> int:
    """How the record has values of a type."""
    return {"float": 0, "int": 1, "bool": 2}.get(type_kind, 3)


def computed(writer: RowWriter, operation: int, kind: str, *inputs: Held) -> Held:
    found = writer.code.register(kind)
    first, second = inputs[0].register, inputs[-1].register
    writer.code.emit(operation, found.register, first, second, int(kind == INT))
    return found


def is_exact(*values: Held) -> bool:
    """Whether values are equal only if they are the same: names, and whole numbers."""
    return all(each.kind == TEXT for each in values) or all(each.kind == INT for each in values)


def need_equal(writer: RowWriter, a: Held, b: Held) -> None:
    if (a.kind == TEXT) != (b.kind == TEXT):
        raise UnwrittenError
    writer.code.emit(op.SAME if is_exact(a, b) else op.NEAR, 0, a.register, b.register)


def need_other(writer: RowWriter, a: Held, b: Held) -> None:
    if (a.kind == TEXT) != (b.kind == TEXT):
        raise UnwrittenError
    writer.code.emit(op.OTHER if is_exact(a, b) else op.APART, 0, a.register, b.register)


def need_numbers(values: list[Held]) -> None:
    if any(each.kind == TEXT for each in values):
        raise UnwrittenError


ROW_TRUTHS = {
    "testEq": op.EQUAL,
    "testNeq": op.UNEQUAL,
    "testLeq": op.IS_AT_MOST,
    "testLessThan": op.IS_BELOW,
    "testAnd": op.BOTH,
    "testOr": op.EITHER,
    "testNot": op.NEITHER,
}


def written_truth(writer: RowWriter, name: str, inputs: list[Held]) -> Held:
    """The truth of a comparison, or of what truths make together."""
    code = writer.code
    is_text = [each.kind == TEXT for each in inputs]
    if any(is_text) and not (name in ("testEq", "testNeq") and all(is_text)):
        raise UnwrittenError
    if len(inputs) != 2 and not (name == "testNot" and len(inputs) == 1) and not (name == "testOr" and len(inputs) > 2):
        raise UnwrittenError
    found = inputs[0]
    for each in inputs[1:] or inputs:
        pair = (found, each)
        found = code.register(INT)
        code.emit(ROW_TRUTHS[name], found.register, pair[0].register, pair[1].register, int(is_exact(*pair)))
    return found


# By name: the operation, and the kind of its value; empty: that of its inputs.
_FUNCTIONS = {
    "addEq": (op.ADD, ""),
    "eqSum": (op.ADD, ""),
    "mulEq": (op.MULTIPLY, ""),
    "eqProduct": (op.MULTIPLY, ""),
    "eqMinimum": (op.LEAST, ""),
    "allMin": (op.LEAST, ""),
    "minf": (op.LEAST, ""),
    "eqMaximum": (op.GREATEST, ""),
    "allMax": (op.GREATEST, ""),
    "maxf": (op.GREATEST, ""),
    "absVal": (op.SIZE, ""),
    "abs": (op.SIZE, ""),
    "absf": (op.SIZE, ""),
    "neg": (op.NEGATIVE, ""),
    "sqrt": (op.ROOT, FLOAT),
    "sqrtf": (op.ROOT, FLOAT),
    "floor": (op.FLOOR, INT),
    "floorf": (op.FLOOR, INT),
    "ceil": (op.CEILING, INT),
    "ceilf": (op.CEILING, INT),
    "mod": (op.REST, FLOAT),
    "diffSquare": (op.SQUARE, ""),
}
_OF_ONE = {op.SIZE, op.NEGATIVE, op.ROOT, op.FLOOR, op.CEILING}
_OF_MANY = {op.ADD, op.MULTIPLY, op.LEAST, op.GREATEST}


def written_value(writer: RowWriter, name: str, inputs: list[Held], *, is_part: bool) -> Held:
    """The value of a function; of a part of an expression only where it is rounded in one way."""
    need_numbers(inputs)
    if name == "calcDistance" and len(inputs) == 4:
        found = writer.code.register(FLOAT)
        writer.code.emit(op.DISTANCE, found.register, *[each.register for each in inputs])
        return found
    if name not in _FUNCTIONS:
        raise UnwrittenError
    operation, kind = _FUNCTIONS[name]
    kind = kind or (FLOAT if any(each.kind == FLOAT for each in inputs) else INT)
    is_one = operation in _OF_ONE
    if len(inputs) != (1 if is_one else 2) and not (operation in _OF_MANY and len(inputs) > 2):
        raise UnwrittenError
    if operation in (op.FLOOR, op.CEILING):
        found = writer.code.register(INT)
        writer.code.emit(operation, found.register, inputs[0].register, int(is_part))
        return found
    result = inputs[0]
    for each in inputs[1:] or inputs:
        result = computed(writer, operation, kind, result, each)
    return result
