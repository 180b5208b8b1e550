"""Steps that write what is judged of a body as code for the row evaluator."""

from collections.abc import Callable

from checker.judge.bodies import StepMaker, Written, compile_body
from checker.judge.columns import FLOAT, INT, TEXT
from checker.judge.functions import COMPUTED, result_index
from checker.judge.meanings import Meaning
from checker.judge.operands import VariableNames, domain_value
from checker.judge.relations import Demand, demands
from checker.judge.row_code import Held, RowWriter, UnwrittenError, kind_of
from checker.judge.row_values import (
    ROW_TRUTHS,
    computed,
    form_of,
    is_exact,
    need_equal,
    need_numbers,
    need_other,
    register_reader,
    variable_of,
    written_truth,
    written_value,
)
from checker.judge.steps import Domain, domain_test
from compiler.program import (
    OBJECT,
    Assign,
    Child,
    Guard,
    Instruction,
    NewObject,
    NewVariable,
    Post,
    Relate,
    Sample,
)
from runtime.executive.columns import RunOutline
from runtime.executive.record import OpenValues, Value, ValueRange
from runtime.rows import operations as op
from runtime.rows.operations import MOST_GUARDS

RowWrite = Callable[[RowWriter], None]


def _unwritten(*_: object) -> RowWrite:
    def step(writer: RowWriter) -> None:
        raise UnwrittenError

    return step


# ---- variables ----


def allowed(writer: RowWriter, test: Domain, held: Held) -> None:
    """Judge that a declaration allows a value."""
    code = writer.code
    if held.kind == TEXT:
        at = code.emit(op.ALLOWED, 0, held.register, code.test(test))
        code.tables.append(at + 3)
    else:
        if test.class_name:
            raise UnwrittenError
        for limit in test.limits:
            _lies_in(writer, limit, held)
    writer.pending += 1


def _lies_in(writer: RowWriter, limit: Value, held: Held) -> None:
    code = writer.code
    if isinstance(limit, ValueRange):
        first = code.register(FLOAT, limit.lower).register
        code.register(FLOAT, limit.upper)
        code.emit(op.WITHIN, 0, held.register, first)
        return
    values = limit.values if isinstance(limit, OpenValues) else (limit,)
    numbers = [each for each in values if not isinstance(each, str)]
    first = len(code.registers)
    for each in numbers:
        code.register(FLOAT, float(each))
    code.emit(op.AMONG, 0, held.register, first, len(numbers))


def _count_equal(writer: RowWriter, a: Held, b: Held) -> None:
    """Count where two values are the same."""
    if (a.kind == TEXT) != (b.kind == TEXT):
        raise UnwrittenError
    writer.code.emit(op.COUNT_NEAR, int(is_exact(a, b)), a.register, b.register)


def _variable(new: NewVariable, names: VariableNames) -> RowWrite:
    test = domain_test(new.type, new.domain, names)
    copied = None if new.copy_of is None else register_reader(new.copy_of, names)

    def step(writer: RowWriter) -> None:
        place, kind = next(writer.locals, (-1, ""))
        if place < 0:
            raise UnwrittenError
        held = writer.slots[new.slot] = writer.code.register(kind_of(kind))
        writer.code.emit(op.LOCAL, held.register, place, form_of(kind))
        if test is not None:
            allowed(writer, test, held)
        if copied is not None:
            _count_equal(writer, held, copied(writer))

    return step


def _assign(given: Assign, names: VariableNames) -> RowWrite:
    target = register_reader(given.target, names)
    limit = None if given.domain is None else domain_value(given.domain)
    source = given.value
    read = register_reader(source, names) if source is not None and not isinstance(source, NewObject) else None

    def step(writer: RowWriter) -> None:
        held = target(writer)
        if limit is not None:
            allowed(writer, Domain((limit,), "", names), held)
        if read is not None:
            _count_equal(writer, held, read(writer))

    return step


def _sample(sample: Sample, slot: int | None, names: VariableNames) -> RowWrite:
    read = register_reader(sample.target, names)

    def step(writer: RowWriter) -> None:
        if writer.depth:  # draws are made for all rows at once
            raise UnwrittenError
        code = writer.code
        drawn = code.register(FLOAT)
        code.emit(op.DRAWN, drawn.register, len(code.samples))
        code.samples.append(sample.parameter)
        if slot is not None:
            writer.slots[slot] = drawn
        else:
            _judge_equal(writer, read(writer), drawn)

    return step


# ---- constraints ----


def _pass_over(name: str) -> RowWrite:
    def step(writer: RowWriter) -> None:
        if writer.depth:
            raise UnwrittenError
        writer.code.skipped.append(f"constraint `{name}`")

    return step


def _judge_equal(writer: RowWriter, a: Held, b: Held) -> None:
    writer.pending += 1
    need_equal(writer, a, b)


def _check(post: Post, meaning: Meaning, names: VariableNames) -> RowWrite:
    reads = [register_reader(each, names) for each in post.operands]
    name = post.name

    def step(writer: RowWriter) -> None:
        values = [read(writer) for read in reads]
        if name in ("eq", "concurrent"):
            for each in values[1:]:
                need_equal(writer, values[0], each)
        elif name in ("neq", "allDiff"):
            for k, each in enumerate(values):
                for other in values[k + 1 :]:
                    need_other(writer, each, other)
        elif name in ("leq", "precedes", "lt", "strictlyPrecedes"):
            need_numbers(values)
            operation = op.AT_MOST if name in ("leq", "precedes") else op.BELOW
            writer.code.emit(operation, 0, values[0].register, values[1].register)
        elif name == "or":
            found = written_truth(writer, "testOr", values)
            writer.code.emit(op.ALIKE, 0, found.register, writer.code.constant(1).register)
        elif name in ROW_TRUTHS:
            need_numbers(values[:1])
            writer.code.emit(op.ALIKE, 0, values[0].register, written_truth(writer, name, values[1:]).register)
        elif name in COMPUTED:
            index = result_index(name, len(values))
            found = written_value(writer, name, [*values[:index], *values[index + 1 :]], is_part=False)
            need_numbers([values[index]])
            need_equal(writer, values[index], found)
        elif name == "temporalDistance":
            need_equal(writer, values[2], written_value(writer, "addEq", values[:2], is_part=False))
        elif name == "towards" and len(values) == 6:
            need_numbers(values)
            writer.code.emit(op.TOWARDS, *[each.register for each in values])
        else:
            raise UnwrittenError
        writer.pending += 1

    return step


def _define(post: Post, index: int, slot: int, names: VariableNames) -> RowWrite:
    """Compute a part of an expression from the constraint that defines it."""
    others = [register_reader(each, names) for k, each in enumerate(post.operands) if k != index]
    name, count = post.name, len(post.operands)

    def step(writer: RowWriter) -> None:
        values = [read(writer) for read in others]
        if name in ROW_TRUTHS and index == 0:
            found = written_truth(writer, name, values)
        elif name in COMPUTED and index == result_index(name, count):
            found = written_value(writer, name, values, is_part=True)
        elif name in ("eq", "concurrent") and count == 2:
            found = values[0]
        elif name == "addEq" and count == 3:
            need_numbers(values)
            kind = INT if values[0].kind == INT and values[1].kind == INT else FLOAT
            found = computed(writer, op.SUBTRACT, kind, values[1], values[0])
        elif name == "neg" and index == 0:
            found = written_value(writer, name, values, is_part=True)
        else:
            raise UnwrittenError
        writer.slots[slot] = found

    return step


# ---- tokens ----


def _child(child: Child, names: VariableNames) -> RowWrite:
    pairs = demands(child.relation, child.bounds)
    given = None if isinstance(child.object, str) else register_reader(child.object, names)

    def step(writer: RowWriter) -> None:
        place = next(writer.children, None)
        if place is None or child.origin not in writer.tokens:
            raise UnwrittenError
        code = writer.code
        number = code.token()
        at = code.emit(op.CHILD, number, place, code.fitting(child, names))
        code.tables.append(at + 3)
        writer.tokens[child.slot] = (number, child.predicate)
        writer.read = {key: held for key, held in writer.read.items() if key[0] != child.slot}
        if child.object == "own" or given is not None:
            holder = variable_of(writer, 0, OBJECT) if given is None else given(writer)
            if holder.kind != TEXT:
                raise UnwrittenError
            _judge_equal(writer, variable_of(writer, child.slot, OBJECT), holder)
        _relate(writer, pairs, child.origin, child.slot)

    return step


def _relation(given: Relate) -> RowWrite:
    pairs = demands(given.relation, given.bounds)

    def step(writer: RowWriter) -> None:
        if given.origin not in writer.tokens or given.target not in writer.tokens:
            raise UnwrittenError
        _relate(writer, pairs, given.origin, given.target)

    return step


def _relate(writer: RowWriter, pairs: tuple[Demand, ...], origin: int, target: int) -> None:
    code = writer.code
    numbers = (writer.tokens[origin][0], writer.tokens[target][0])
    for first, second, lower, upper in pairs:
        bounds = [code.constant(float(each)).register for each in (lower, upper)]
        one, other = numbers[first // 2], numbers[second // 2]
        code.emit(op.RELATED, one, other, first % 2, second % 2, *bounds, numbers[1])


# ---- branches ----


def _guard(guard: Guard, then: list[RowWrite], otherwise: list[RowWrite], names: VariableNames) -> RowWrite:
    condition = register_reader(guard.condition, names)

    def step(writer: RowWriter) -> None:
        reached = next(writer.guards, None)
        held = condition(writer)
        if reached is None or held.kind == TEXT:
            raise UnwrittenError
        if writer.depth == MOST_GUARDS:
            raise UnwrittenError
        code = writer.code
        at = code.emit(op.GUARD, held.register, reached.place)
        _branch(writer, reached.then, then)
        between = code.emit(op.OTHERWISE)
        code.numbers[at + 3] = between
        _branch(writer, reached.otherwise, otherwise)
        code.numbers[between + 2] = code.emit(op.END)

    return step


def _branch(writer: RowWriter, outline: RunOutline | None, steps: list[RowWrite]) -> None:
    if outline is None:
        return
    inner = writer.branch(outline)
    for each in steps:
        each(inner)
    inner.count()


_WRITE = StepMaker(
    _variable,
    _unwritten,
    _assign,
    _sample,
    _child,
    _relation,
    _unwritten,
    _define,
    _pass_over,
    _check,
    _unwritten,
    _guard,
    _unwritten,
)


def compile_writing(body: tuple[Instruction, ...], names: VariableNames, written: Written) -> list[RowWrite]:
    """The steps that write the code of a body."""
    return compile_body(body, names, written, _WRITE)
