"""Steps that write what is judged of a body as straight code for single tokens."""

from collections.abc import Callable

from checker.judge.bodies import StepMaker, Written, compile_body
from checker.judge.columns import FLOAT, INT, TEXT
from checker.judge.functions import COMPUTED, result_index
from checker.judge.meanings import Meaning
from checker.judge.operands import VariableNames, domain_value
from checker.judge.relations import Demand, demands
from checker.judge.row_code import UnwrittenError
from checker.judge.solving import solver
from checker.judge.steps import Domain, domain_test
from checker.judge.straight_code import OPEN, Named, StraightWriter, equal_text, is_exact
from compiler.program import (
    OBJECT,
    START,
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

StraightWrite = Callable[[StraightWriter], None]


def _unwritten(*_: object) -> StraightWrite:
    def step(writer: StraightWriter) -> None:
        raise UnwrittenError

    return step


# ---- variables ----


def _count_equal(writer: StraightWriter, a: Named, b: Named) -> None:
    """Count where two values are the same."""
    writer.emit(f"if {equal_text(a, b)}: j += 1")


def _variable(new: NewVariable, names: VariableNames) -> StraightWrite:
    test = domain_test(new.type, new.domain, names)

    def step(writer: StraightWriter) -> None:
        held = writer.slots[new.slot] = writer.local(new.type)
        if test is not None:
            writer.need_allowed(test, held)
        if new.copy_of is not None:
            _count_equal(writer, held, writer.operand(new.copy_of))

    return step


def _assign(given: Assign, names: VariableNames) -> StraightWrite:
    limit = None if given.domain is None else domain_value(given.domain)
    source = given.value

    def step(writer: StraightWriter) -> None:
        held = writer.operand(given.target)
        if limit is not None:
            writer.need_allowed(Domain((limit,), "", names), held)
        if source is not None and not isinstance(source, NewObject):
            _count_equal(writer, held, writer.operand(source))

    return step


def _sample(sample: Sample, slot: int | None, names: VariableNames) -> StraightWrite:
    def step(writer: StraightWriter) -> None:
        tick = writer.variable(0, START)
        drawn = writer.plain(f"bench.draw({sample.parameter!r}, {tick.text})", "float")
        if slot is not None:
            writer.slots[slot] = drawn
        else:
            writer.need_equal(writer.operand(sample.target), drawn)
            writer.judged += 1

    return step


# ---- constraints ----

_KINDS = {"sqrt": FLOAT, "floor": INT, "ceil": INT}  # of values that are not of the kind of what they are computed from
_SUMS = {"addEq": " + ", "eqSum": " + ", "mulEq": " * ", "eqProduct": " * "}
_NUMERIC = {*COMPUTED, "temporalDistance", "divEq"}
_COMPARED = {"testLeq": "<=", "testLessThan": "<"}
_JOINED = {"testAnd": " and ", "testOr": " or "}


def _pass_over(name: str) -> StraightWrite:
    def step(writer: StraightWriter) -> None:
        if writer.indent > 1:  # in a branch
            raise UnwrittenError
        writer.text.skipped.append(f"constraint `{name}`")

    return step


def _need_numbers(values: list[Named]) -> None:
    if any(each.kind in (TEXT, OPEN) for each in values):
        raise UnwrittenError


def _need_finite(writer: StraightWriter, values: list[Named]) -> None:
    """Functions are asked of numbers alone, and of no infinite ones."""
    _need_numbers(values)
    for each in values:
        if each.kind == FLOAT:
            writer.refuse_if(f"{each.text} - {each.text} != 0")


def _truth(writer: StraightWriter, name: str, values: list[Named]) -> Named | None:
    """The truth of a comparison, or of what truths make together; None where it is asked of its meaning."""
    if any(each.kind == OPEN for each in values):
        return None
    if name in ("testEq", "testNeq") and len(values) == 2:
        a, b = values
        if name == "testNeq" and not is_exact(a, b):
            writer.refuse_if(f"{a.text} != {b.text} and is_near({a.text}, {b.text})")
        same = equal_text(a, b)
        return writer.named(same if name == "testEq" else f"not ({same})", INT)
    if name in _COMPARED and len(values) == 2:
        _need_numbers(values)
        a, b = values
        sign = _COMPARED[name]
        if not is_exact(a, b):
            apart = f"{a.text} != {b.text}" if name == "testLessThan" else f"{a.text} > {b.text}"
            writer.refuse_if(f"{apart} and is_near({a.text}, {b.text})")
        return writer.named(f"{a.text} {sign} {b.text}", INT)
    if name in _JOINED and len(values) > 1:
        _need_numbers(values)
        return writer.named(_JOINED[name].join([f"{each.text} != 0" for each in values]), INT)
    if name == "testNot" and len(values) == 1:
        _need_numbers(values)
        return writer.named(f"{values[0].text} == 0", INT)
    return None


def _check(post: Post, meaning: Meaning, names: VariableNames) -> StraightWrite:
    name, count = post.name, len(post.operands)
    index = result_index(name, count)

    def step(writer: StraightWriter) -> None:
        values = [writer.operand(each) for each in post.operands]
        writer.judged += 1
        rest = [*values[:index], *values[index + 1 :]]
        if any(each.kind == OPEN for each in values):
            writer.need(meaning, values)
        elif name in ("eq", "concurrent"):
            for each in values[1:]:
                writer.need_equal(values[0], each)
        elif name in ("leq", "precedes", "lt", "strictlyPrecedes") and count == 2:
            _need_numbers(values)
            sign = "<=" if name in ("leq", "precedes") else "<"
            writer.refuse_if(f"not {values[0].text} {sign} {values[1].text}")
        elif name in _SUMS and count > 2:
            _need_numbers(values)
            kind = INT if all(each.kind == INT for each in rest) else FLOAT
            found = writer.named(_SUMS[name].join([each.text for each in rest]), kind)
            writer.need_equal(values[index], found)
        elif name.startswith("test") and (found_truth := _truth(writer, name, values[1:])) is not None:
            _need_numbers(values[:1])
            writer.refuse_if(f"({values[0].text} != 0) != {found_truth.text}")
        else:
            if name in _NUMERIC:
                _need_finite(writer, values)
            writer.need(meaning, values)

    return step


def _define(post: Post, index: int, slot: int, names: VariableNames) -> StraightWrite:
    """Compute a part of an expression from the constraint that defines it."""
    others = [each for k, each in enumerate(post.operands) if k != index]
    name, count = post.name, len(post.operands)
    solve = solver(name, index, count)

    def step(writer: StraightWriter) -> None:
        values = [writer.operand(each) for each in others]
        writer.slots[slot] = _defined(writer, values)

    def _defined(writer: StraightWriter, values: list[Named]) -> Named:
        truth = _truth(writer, name, values) if name.startswith("test") and index == 0 else None
        if truth is not None:
            return truth
        if name in ("eq", "concurrent") and count == 2:
            return values[0]
        if solve is None:
            raise UnwrittenError
        if any(each.kind == OPEN for each in values):
            return writer.named(writer.call(solve, values), OPEN)
        _need_finite(writer, values)
        kind = _KINDS.get(name.removesuffix("f"), FLOAT if any(each.kind == FLOAT for each in values) else INT)
        if name in _SUMS and index == result_index(name, count):
            return writer.named(_SUMS[name].join([each.text for each in values]), kind)
        found = writer.named(writer.call(solve, values), kind)
        wanted = "not in (int, bool)" if kind == INT else "not in (float, int)"
        writer.refuse_if(f"{found.text}.__class__ {wanted}")
        return found

    return step


# ---- tokens ----


def _child(child: Child, names: VariableNames) -> StraightWrite:
    pairs = demands(child.relation, child.bounds)
    kind, _, suffix = child.predicate.rpartition(".")
    heirs = [
        name
        for name in names.predicates
        if name.rpartition(".")[2] == suffix and names.is_kind_of(name.rpartition(".")[0], kind)
    ]
    fitting = frozenset(heirs) if child.object == "own" else frozenset((child.predicate,))

    def step(writer: StraightWriter) -> None:
        if child.origin not in writer.tokens:
            raise UnwrittenError
        record, stands = writer.text.fresh("c"), writer.text.fresh("s")
        fits = writer.text.value(fitting)
        writer.emit(f"{record} = by_key.get({writer.take(1)})")
        writer.refuse_if(f"{record} is None or {record}[1] not in {fits} or {record}[10] == 'cut'")
        writer.refuse_if(f"{record}[3] != 'active' and {record}[3] != 'merged'")
        writer.emit(f"{stands} = {record} if {record}[8] == -1 else standing_for(by_key, {record})")
        writer.refuse_if(f"{stands}[1] not in {fits} or {stands}[10] == 'cut'")
        many = len(names.predicates[child.predicate].parameters)
        if len(fitting) > 1:
            writer.refuse_if(f"len({stands}[7]) < {many}")
        writer.tokens[child.slot] = (stands, child.predicate)
        writer.read = {key: held for key, held in writer.read.items() if key[0] != child.slot}
        asked = child.object
        if asked == "own" or not isinstance(asked, str):
            holder = writer.variable(0, OBJECT) if isinstance(asked, str) else writer.operand(asked)
            writer.need_equal(writer.variable(child.slot, OBJECT), holder)
            writer.judged += 1
        _relate(writer, pairs, child.origin, child.slot)

    return step


def _relation(given: Relate) -> StraightWrite:
    pairs = demands(given.relation, given.bounds)

    def step(writer: StraightWriter) -> None:
        if given.origin not in writer.tokens or given.target not in writer.tokens:
            raise UnwrittenError
        _relate(writer, pairs, given.origin, given.target)

    return step


def _relate(writer: StraightWriter, pairs: tuple[Demand, ...], origin: int, target: int) -> None:
    """A relation; where a time is open, whether it can hold."""
    value = writer.text.value
    times = [f"{writer.tokens[token][0]}[{place}]" for token in (origin, target) for place in (5, 6)]
    for first, second, lower, upper in pairs:
        a, b = (writer.named(times[each], INT).text for each in (first, second))
        writer.emit(f"if {a}.__class__ is int is {b}.__class__:")
        writer.emit(f"    if not {value(lower)} <= {b} - {a} <= {value(upper)}: return None")
        writer.emit("    j += 1")
        writer.emit("else:")
        writer.emit(f"    if not may_relate({a}, {b}, {value(lower)}, {value(upper)}): return None")
        writer.emit("    o += 1")


# ---- branches ----


def _guard(
    guard: Guard, then: list[StraightWrite], otherwise: list[StraightWrite], names: VariableNames
) -> StraightWrite:
    def step(writer: StraightWriter) -> None:
        held = writer.operand(guard.condition)
        if held.kind == TEXT:
            raise UnwrittenError
        truth = writer.named(f"is_true({held.text})" if held.kind == OPEN else f"{held.text} != 0", "")
        reached = writer.named(writer.take(2), "")
        writer.emit(f"if {truth.text} is None: o += 1")
        writer.emit("else: j += 1")
        for word, branch, steps in (("if", "then", then), ("elif", "else", otherwise)):
            writer.emit(f"{word} {reached.text}[0] == {branch!r}:")
            writer.emit(f"    if {truth.text} is {branch != 'then'}: return None")
            if steps:
                inner = writer.branch()
                run = inner.named(f"{reached.text}[2]", "")
                inner.emit(f"if {run.text} is not None:")
                inner.indent += 1
                inner.follow(run.text, in_turn(steps))
        writer.emit("else: return None")

    return step


def in_turn(steps: list[StraightWrite]) -> StraightWrite:
    """All steps, one after the other."""

    def write(writer: StraightWriter) -> None:
        for step in steps:
            step(writer)

    return write


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


def compile_straight(body: tuple[Instruction, ...], names: VariableNames, written: Written) -> list[StraightWrite]:
    """The steps that write the code of a body."""
    return compile_body(body, names, written, _WRITE)
