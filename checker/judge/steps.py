"""Steps that judge one run of a body against the record."""

from dataclasses import dataclass
from functools import partial

from checker.judge.bench import Bench
from checker.judge.bodies import StepMaker, Written, compile_body
from checker.judge.determined import Determined
from checker.judge.functions import COMPUTED, result_index
from checker.judge.guards import GuardInputs
from checker.judge.meanings import Meaning, equal, is_true
from checker.judge.operands import BodyFrame, Read, VariableNames, domain_value, is_range, reader
from checker.judge.relating import CUT_OFF, LEFT_OPEN, Step, child_step, relate_step
from checker.judge.solving import solver
from checker.judge.values import UNKNOWN, ends_of, is_open, lies_within, may_be_equal
from compiler.program import (
    END,
    START,
    Assign,
    DomainConstant,
    Guard,
    Instruction,
    LocalVariable,
    NewObject,
    NewVariable,
    ObjectLoop,
    Post,
    Sample,
    TokenVariable,
    TypeCode,
)
from nddl_lang.text.source import Span
from runtime.executive.record import OpenValues, Value, ValueRange


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


def _any_of(bench: Bench, class_name: str, names: VariableNames) -> Value:
    """All objects of a class."""
    found = tuple(name for name, (own, _) in bench.members.items() if names.is_kind_of(own, class_name))
    return OpenValues(found) if len(found) > 1 else found[0] if found else UNKNOWN


def _variable(new: NewVariable, names: VariableNames) -> Step:
    slot, name = new.slot, new.name or ""
    test = domain_test(new.type, new.domain, names)
    copied = None if new.copy_of is None else reader(new.copy_of, names)

    def step(frame: BodyFrame) -> None:
        value = next(frame.locals, None)
        bench = frame.bench
        if value is None and frame.choosing is not None:
            if slot not in frame.choosing.known:
                is_object = new.type.kind == "object" and new.domain is None
                frame.slots[slot] = _any_of(bench, new.type.type_name, names) if is_object else UNKNOWN
            value = frame.slots[slot]
            frame.choosing.log.locals.append(value)
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

    return step


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


def _sample(sample: Sample, slot: int | None, names: VariableNames) -> Step:
    parameter, target = sample.parameter, sample.target
    read = reader(target, names)
    name = names.of(target)
    is_own = isinstance(target, LocalVariable) or (isinstance(target, TokenVariable) and target.token == 0)

    def step(frame: BodyFrame) -> None:
        tick = 0 if frame.tok is None else frame.tok.values[START]
        drawn = frame.bench.draw(parameter, tick) if isinstance(tick, int) else UNKNOWN
        if slot is not None:
            frame.slots[slot] = drawn
            return
        value = read(frame)
        holds = equal(value, drawn)
        values = ((name, value), (parameter, drawn))
        if is_own and holds is None and is_open(value) and not is_open(drawn) and frame.choosing is None:
            frame.bench.judged += 1
            _note(frame, "draw", parameter, values, "left open", "the draw of the tick", sample.span)
        elif not frame.bench.weigh(holds):
            _note(frame, "draw", parameter, values, "the value in use", "the draw of the tick", sample.span)

    return step


# ---- constraints ----


def _reads(post: Post, names: VariableNames) -> list[Read]:
    return [reader(each, names) for each in post.operands]


def _use(post: Post, names: VariableNames) -> Step:
    holder, quantity, start, end = _reads(post, names)

    def step(frame: BodyFrame) -> None:
        use = (holder(frame), quantity(frame), start(frame), end(frame), frame.tok, post.span)
        frame.bench.uses.append(use)

    return step


def _define(post: Post, index: int, slot: int, names: VariableNames) -> Step:
    """Compute a part of an expression from the constraint that defines it."""
    solve = solver(post.name, index, len(post.operands))
    others = [reader(each, names) for k, each in enumerate(post.operands) if k != index]
    if solve is None:
        return _blank(slot)

    def step(frame: BodyFrame) -> None:
        frame.slots[slot] = solve(*[read(frame) for read in others])

    return step


def _pass_over(name: str) -> Step:
    return lambda frame: frame.bench.skip(f"constraint `{name}`")


def _check(post: Post, meaning: Meaning, names: VariableNames) -> Step:
    return (_two if len(post.operands) == 2 else _many)(post, meaning, names)


def _two(post: Post, meaning: Meaning, names: VariableNames) -> Step:
    first, second = _reads(post, names)
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


def _many(post: Post, meaning: Meaning, names: VariableNames) -> Step:
    reads = _reads(post, names)
    determined = Determined(post, names)

    def step(frame: BodyFrame) -> None:
        values = [read(frame) for read in reads]
        bench = frame.bench
        answer = meaning(*values)
        if answer:
            bench.judged += 1
        elif answer is None:
            bench.open += 1
            if frame.choosing is not None:
                determined.infer(frame, values)
            elif determined.is_left_open(frame, values):
                _refuse(frame, post, values, names, LEFT_OPEN)
        else:
            _refuse(frame, post, values, names)

    return step


def _check_loose(post: Post, meaning: Meaning, names: VariableNames) -> Step:
    reads = _reads(post, names)
    fixed = [k for k, operand in enumerate(post.operands) if not is_range(operand)]
    determined = Determined(post, names)

    def step(frame: BodyFrame) -> None:
        values = [read(frame) for read in reads]
        bench = frame.bench
        answer = meaning(*values)
        if answer is False:
            _refuse(frame, post, values, names)
        elif answer or not any(is_open(values[k]) for k in fixed):
            bench.judged += 1
        else:
            bench.open += 1
            if frame.choosing is not None:
                determined.infer(frame, values)

    return step


def _refuse(
    frame: BodyFrame,
    post: Post,
    values: list[Value],
    names: VariableNames,
    said: tuple[str, str] = ("it holds", "it does not"),
) -> None:
    for tok in [frame.tokens[each] for each in names.tokens_in(post.operands)]:
        if tok is not None and tok is not frame.tok and tok.is_outdated:
            frame.bench.skip(CUT_OFF)
            return
    named = [(names.of(operand), value) for operand, value in zip(post.operands, values, strict=True)]
    frame.bench.judged += 1
    if post.name in COMPUTED:
        index = result_index(post.name, len(values))
        solve = solver(post.name, index, len(values))
        if solve is not None:
            named.append(("computed", solve(*values[:index], *values[index + 1 :])))
    if frame.within:
        named.append(("within", frame.within))
    _note(frame, "constraint", post.name, tuple(named), *said, post.span)


# ---- branches ----


def _guard(guard: Guard, then: list[Step], otherwise: list[Step], names: VariableNames) -> Step:
    condition = reader(guard.condition, names)
    inputs = GuardInputs(guard.condition, names)
    text = guard.span.text.partition("{")[0].strip()

    def step(frame: BodyFrame) -> None:
        bench = frame.bench
        reached = next(frame.guards, None)
        if reached is None and frame.choosing is not None:
            value = condition(frame)
            truth = True if isinstance(value, str) else is_true(value)
            branch = then if truth else otherwise
            if truth is None:
                bench.skip("a branch that is not known")
            frame.choosing.branch(truth, partial(_carry_out, frame, branch, text, truth) if branch else None)
            return
        if reached is None:
            bench.skip("a guard is not on record")
            return
        value = condition(frame)
        truth = True if isinstance(value, str) else is_true(value)
        if reached.branch == "waiting":
            # What a token before the mission would ask for is left open.
            is_before = frame.tok is not None and ends_of(frame.tok.values[END])[1] <= 0
            if truth is None or is_before or not (reached.is_decided or inputs.are_decided(frame)):
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
            inner.within = text if reached.branch == "then" else f"else of {text}"
            for each in then if reached.branch == "then" else otherwise:
                each(inner)

    return step


def _carry_out(frame: BodyFrame, steps: list[Step], text: str, truth: bool | None) -> None:
    """Judge a branch that nobody recorded."""
    inner = BodyFrame(frame.bench, frame.tok, list(frame.slots), list(frame.tokens))
    inner.choosing = frame.choosing
    inner.within = text if truth else f"else of {text}"
    for each in steps:
        each(inner)


def _loop(loop: ObjectLoop, body: list[Step], names: VariableNames) -> Step:
    collection = reader(loop.collection, names)

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


_STEPS = StepMaker(
    _variable,
    _blank,
    _assign,
    _sample,
    child_step,
    relate_step,
    _use,
    _define,
    _pass_over,
    _check,
    _check_loose,
    _guard,
    _loop,
)


def compile_steps(body: tuple[Instruction, ...], names: VariableNames, written: Written) -> tuple[Step, ...]:
    """The steps of a body for one run."""
    return tuple(compile_body(body, names, written, _STEPS))
