"""Compile the bodies of rules, predicates and the script into steps that judge one run against the record."""

from dataclasses import dataclass
from typing import assert_never

from checker.judge.bench import Bench
from checker.judge.determined import Determined
from checker.judge.meanings import MEANINGS, SILENT, Meaning, equal, is_true
from checker.judge.operands import BodyFrame, Read, VariableNames, domain_value, is_range, reader
from checker.judge.relating import LEFT_OPEN, Step, child_step, relate_step
from checker.judge.solving import solver
from checker.judge.values import UNKNOWN, is_open, lies_within, may_be_equal
from compiler.program import (
    START,
    Assign,
    Call,
    Child,
    DomainConstant,
    Guard,
    Instruction,
    LocalVariable,
    NewGlobal,
    NewObject,
    NewToken,
    NewVariable,
    ObjectLoop,
    Post,
    Relate,
    Sample,
    TypeCode,
)
from nddl_lang.text.source import Span
from runtime.executive.record import OpenValues, Value, ValueRange

Written = dict[str, Meaning]  # constraints of the project, by name


def compile_body(
    body: tuple[Instruction, ...], names: VariableNames, written: Written, undefined: set[int] | None = None
) -> list[Step]:
    """The steps of a body; `undefined` are slots of expressions that nothing has defined yet."""
    undefined = set() if undefined is None else undefined
    steps: list[Step] = []
    for instruction in body:
        match instruction:
            case NewVariable():
                steps += _variable(instruction, names, undefined)
            case Post():
                steps += _post(instruction, names, written, undefined)
            case Sample():
                steps.append(_sample(instruction, names, undefined))
            case Child():
                names.tokens[instruction.slot] = (instruction.label or "", instruction.predicate)
                steps.append(child_step(instruction, names))
            case Relate():
                steps.append(relate_step(instruction))
            case Guard():
                steps.append(_guard(instruction, names, written, undefined))
            case ObjectLoop():
                steps.append(_loop(instruction, names, written, undefined))
            case Assign():
                steps.append(_assign(instruction, names))
            case NewObject(slot=slot):
                if slot is not None:
                    steps.append(_blank(slot))
            case NewGlobal() | NewToken() | Call():
                pass  # of the script, which `script` reads
            case _:
                assert_never(instruction)
    return steps


def _blank(slot: int) -> Step:
    def step(frame: BodyFrame) -> None:
        frame.slots[slot] = UNKNOWN

    return step


# ---- variables ----


@dataclass(frozen=True, eq=False, slots=True)
class Domain:
    """What a declaration allows: values in each of `limits`, objects of `class_name`."""

    limits: tuple[Value, ...]
    class_name: str
    names: VariableNames

    def __call__(self, bench: Bench, value: Value) -> bool | None:
        if self.class_name:
            return _is_of_class(bench, value, self.class_name, self.names)
        for limit in self.limits:
            if not _within(value, limit):
                return False
        return None if is_open(value) else True


def domain_test(type_: TypeCode, domain: DomainConstant | None, names: VariableNames) -> Domain | None:
    """Whether a value is one that a declaration allows; None if it allows all."""
    limits = [domain_value(each) for each in (type_.domain, domain) if each is not None]
    if type_.kind == "object":
        return Domain((), type_.type_name, names)
    if type_.kind == "enum" and not limits:
        values = next((frozenset(given) for name, given in names.program.enums if name == type_.type_name), None)
        if values is not None:
            limits = [OpenValues(tuple(sorted(values)))]
    return Domain(tuple(limits), "", names) if limits else None


def _within(value: Value, limit: Value) -> bool:
    """Whether a value may lie in a set of values."""
    if isinstance(limit, ValueRange):
        return lies_within(value, limit.lower, limit.upper)
    return may_be_equal(value, limit)


def _is_of_class(bench: Bench, value: Value, class_name: str, names: VariableNames) -> bool | None:
    if isinstance(value, tuple):
        return None
    known = bench.members.get(str(value))
    return None if known is None else names.is_kind_of(known[0], class_name)


def _variable(new: NewVariable, names: VariableNames, undefined: set[int]) -> list[Step]:
    slot, name = new.slot, new.name
    if name is None:
        undefined.add(slot)
        return []
    names.locals[slot] = name
    test = domain_test(new.type, new.domain, names)
    copied = None if new.copy_of is None else reader(new.copy_of, names)

    def step(frame: BodyFrame) -> None:
        value = next(frame.locals, None)
        bench = frame.bench
        if value is None and frame.choosing is not None:
            if slot not in frame.choosing.known:
                frame.slots[slot] = UNKNOWN
            value = frame.slots[slot]
        if value is None:
            bench.skip("a local variable is not on record")
            frame.slots[slot] = UNKNOWN
            return
        frame.slots[slot] = value
        if test is not None and not bench.weigh(test(bench, value)):
            _note(frame, "domain", name, ((name, value),), "its value", "outside of its declaration", new.span)
        # The base domain of what is copied may be larger than the value that it came to have.
        if copied is not None and may_be_equal(value, copied(frame)):
            bench.judged += 1

    return [step]


def _note(
    frame: BodyFrame, kind: str, name: str, values: tuple[tuple[str, Value], ...], held: str, found: str, span: Span
) -> None:
    tokens = () if frame.tok is None else (frame.tok,)
    frame.bench.report(kind, name, tokens, values, held, found, span)  # type: ignore[arg-type]


def _assign(given: Assign, names: VariableNames) -> Step:
    target = reader(given.target, names)
    name = names.of(given.target)
    limit = None if given.domain is None else domain_value(given.domain)
    source = reader(given.value, names) if given.value is not None and not isinstance(given.value, NewObject) else None

    def step(frame: BodyFrame) -> None:
        value = target(frame)
        if limit is not None and not frame.bench.weigh(_within(value, limit)):
            _note(frame, "domain", name, ((name, value),), "assigned", "another value", given.span)
        if source is not None and may_be_equal(value, source(frame)):
            frame.bench.judged += 1

    return step


def _sample(sample: Sample, names: VariableNames, undefined: set[int]) -> Step:
    parameter, target = sample.parameter, sample.target
    slot = target.slot if isinstance(target, LocalVariable) and target.slot in undefined else None
    if slot is not None:
        undefined.discard(slot)
    read = reader(target, names)
    name = names.of(target)

    def step(frame: BodyFrame) -> None:
        tick = 0 if frame.tok is None else frame.tok.values[START]
        drawn = frame.bench.draw(parameter, tick) if isinstance(tick, int) else UNKNOWN
        if slot is not None:
            frame.slots[slot] = drawn
            return
        value = read(frame)
        if not frame.bench.weigh(equal(value, drawn)):
            values = ((name, value), (parameter, drawn))
            _note(frame, "draw", parameter, values, "the value in use", "the draw of the tick", sample.span)

    return step


# ---- constraints ----


def _post(post: Post, names: VariableNames, written: Written, undefined: set[int]) -> list[Step]:
    name = post.name
    if name in SILENT:
        return []
    reads = [reader(each, names) for each in post.operands]
    if name == "uses":
        return [_use(post, reads)]
    unknown = [k for k, each in enumerate(post.operands) if isinstance(each, LocalVariable) and each.slot in undefined]
    if unknown:
        return [_define(post, unknown[0], reads, undefined)]
    meaning = MEANINGS.get(name) or written.get(name)
    if meaning is None:
        return [lambda frame: frame.bench.skip(f"constraint `{name}`")]
    is_loose = any(is_range(each) for each in post.operands)
    if len(reads) == 2 and not is_loose:
        return [_two(post, meaning, reads, names)]
    return [_many(post, meaning, reads, is_loose, names)]


def _use(post: Post, reads: list[Read]) -> Step:
    holder, quantity, start, end = reads

    def step(frame: BodyFrame) -> None:
        use = (holder(frame), quantity(frame), start(frame), end(frame), frame.tok, post.span)
        frame.bench.uses.append(use)

    return step


def _define(post: Post, place: int, reads: list[Read], undefined: set[int]) -> Step:
    """Compute a part of an expression from the constraint that defines it."""
    target = post.operands[place]
    assert isinstance(target, LocalVariable)
    slot = target.slot
    undefined.discard(slot)
    solve = solver(post.name, place, len(reads))
    others = [read for k, read in enumerate(reads) if k != place]
    if solve is None:
        return _blank(slot)

    def step(frame: BodyFrame) -> None:
        frame.slots[slot] = solve(*[read(frame) for read in others])

    return step


def _two(post: Post, meaning: Meaning, reads: list[Read], names: VariableNames) -> Step:
    first, second = reads
    determined = Determined(post, names)

    def step(frame: BodyFrame) -> None:
        a, b = first(frame), second(frame)
        bench = frame.bench
        answer = meaning(a, b)
        if answer:
            bench.judged += 1
        elif answer is None:
            bench.open += 1
            if frame.choosing is not None:
                determined.infer(frame, [a, b])
            elif determined.is_left_open(frame, [a, b]):
                _refuse(frame, post, [a, b], names, LEFT_OPEN)
        else:
            _refuse(frame, post, [a, b], names)

    return step


def _many(post: Post, meaning: Meaning, reads: list[Read], is_loose: bool, names: VariableNames) -> Step:
    determined = Determined(post, names)
    # An anonymous range in the text stands for any of its values.
    fixed = [k for k, operand in enumerate(post.operands) if not is_range(operand)]

    def step(frame: BodyFrame) -> None:
        values = [read(frame) for read in reads]
        bench = frame.bench
        answer = meaning(*values)
        if answer is None and is_loose:
            answer = None if any(is_open(values[k]) for k in fixed) else True
        if answer:
            bench.judged += 1
        elif answer is None:
            bench.open += 1
            if frame.choosing is not None:
                determined.infer(frame, values)
            elif not is_loose and determined.is_left_open(frame, values):
                _refuse(frame, post, values, names, LEFT_OPEN)
        else:
            _refuse(frame, post, values, names)

    return step


def _refuse(
    frame: BodyFrame,
    post: Post,
    values: list[Value],
    names: VariableNames,
    said: tuple[str, str] = ("it holds", "it does not"),
) -> None:
    named = tuple((names.of(operand), value) for operand, value in zip(post.operands, values, strict=True))
    frame.bench.judged += 1
    _note(frame, "constraint", post.name, named, *said, post.span)


# ---- branches ----


def _guard(guard: Guard, names: VariableNames, written: Written, undefined: set[int]) -> Step:
    condition = reader(guard.condition, names)
    then = compile_body(guard.then, names, written, set(undefined))
    otherwise = compile_body(guard.otherwise, names, written, set(undefined))
    text = guard.span.text.partition("{")[0].strip()

    def step(frame: BodyFrame) -> None:
        bench = frame.bench
        reached = next(frame.guards, None)
        if reached is None and frame.choosing is not None:
            value = condition(frame)
            truth = True if isinstance(value, str) else is_true(value)
            if truth is None:
                bench.skip("a branch that is not known")
                return
            inner = BodyFrame(bench, frame.tok, list(frame.slots), list(frame.tokens))
            inner.choosing = frame.choosing
            for each in then if truth else otherwise:
                each(inner)
            return
        if reached is None:
            bench.skip("a guard is not on record")
            return
        value = condition(frame)
        truth = True if isinstance(value, str) else is_true(value)
        if reached.branch == "waiting":
            if truth is None or not reached.is_decided:
                bench.open += 1
            else:
                found = "then" if truth else "else"
                _note(frame, "guard", text, (("condition", value),), "no branch", found, guard.span)
            return
        if not bench.weigh(None if truth is None else truth == (reached.branch == "then")):
            found = "then" if truth else "else"
            _note(frame, "guard", text, (("condition", value),), reached.branch, found, guard.span)
        if reached.run is not None:
            inner = BodyFrame(bench, frame.tok, list(frame.slots), list(frame.tokens))
            inner.follow(reached.run)
            for each in then if reached.branch == "then" else otherwise:
                each(inner)

    return step


def _loop(loop: ObjectLoop, names: VariableNames, written: Written, undefined: set[int]) -> Step:
    collection = reader(loop.collection, names)
    body = compile_body(loop.body, names, written, set(undefined))

    def step(frame: BodyFrame) -> None:
        things = collection(frame)
        if isinstance(things, ValueRange):
            frame.bench.skip("a loop over objects that are not on record")
            return
        for each in _in_order(frame.bench, things):
            frame.slots[loop.slot] = each
            for inner in body:
                inner(frame)

    return step


def _in_order(bench: Bench, things: Value) -> list[str]:
    """Objects in the order of their making."""
    wanted = {str(each) for each in things.values} if isinstance(things, OpenValues) else {str(things)}
    return [name for name in bench.members if name in wanted]
