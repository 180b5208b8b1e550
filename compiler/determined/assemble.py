"""Assemble a block: instructions in causal order become one list of integers, branches become jumps."""

from compiler.determined import code
from compiler.determined.code import STRIDE, RegisterBlock, RegisterLayout
from compiler.determined.elaborate import Elaboration
from compiler.determined.model import ReactorModel
from compiler.determined.operations import Instruction
from compiler.determined.relations import FOLLOWING, ROOT, TOGETHER
from compiler.determined.schedule import AGAIN, Placed, Sequence, schedule
from compiler.program import PredicateCode

WITHOUT_RESULT: frozenset[int] = frozenset(
    {
        *(code.NEED, code.HOLD, code.CLEAR, code.BEGIN, code.MERGE, code.PREVIOUS, code.FOLLOW, code.LAST_EXACTLY),
        *(code.LAST_LEAST, code.LAST_MOST, code.TIE, code.WITHIN, code.MEMBER, code.ORDER, code.PLANNED),
    }
)


def compile_block(
    model: ReactorModel, layout: RegisterLayout, line: int, predicate: PredicateCode, mask: int
) -> RegisterBlock:
    """The block of a predicate on a timeline, with the parameters in `mask` given; raises `UndeterminedError`."""
    work = Elaboration(model, layout, line, predicate, mask)
    sequence = schedule(work.sheet)
    placed = [*_clearing(work, layout, sequence), *_compared(sequence, layout)]
    placed = [(context, _following(instruction, work, layout, sequence)) for context, instruction in placed]
    return RegisterBlock(
        line,
        predicate,
        mask,
        tuple(_padded(each) for each in linear(placed)),
        tuple(work.tokens),
        tuple(work.guards),
        tuple(work.locals),
        tuple(work.draws),
    )


def linear(placed: list[Placed]) -> list[Instruction]:
    """Instructions with jumps over the branches that are not taken."""
    done: list[list[int]] = []
    open_branches: list[tuple[tuple[int, bool], int]] = []
    for context, instruction in [*placed, ((), (code.HALT,))]:
        common = 0
        while common < min(len(open_branches), len(context)) and open_branches[common][0] == context[common]:
            common += 1
        while len(open_branches) > common:
            done[open_branches.pop()[1]][2] = len(done)
        for condition in context[common:]:
            open_branches.append((condition, len(done)))
            done.append([code.WHEN_FALSE if condition[1] else code.WHEN_TRUE, condition[0], 0])
        done.append(list(instruction))
    return [tuple(each) for each in done]


def _clearing(work: Elaboration, layout: RegisterLayout, sequence: Sequence) -> list[Placed]:
    """Make unknown what branches compute; tokens that start have their parameters cleared by the machine."""
    banks = {
        work.banks[number] + k
        for number, token in enumerate(work.tokens)
        if token.how in (ROOT, TOGETHER)
        for k in range(len(token.predicate.parameters))
    }
    registers = sorted(sequence.cleared - banks)
    placed: list[Placed] = []
    first = 0
    while first < len(registers):
        last = first
        while last + 1 < len(registers) and registers[last + 1] == registers[last] + 1:
            last += 1
        placed.append(((), (code.CLEAR, registers[first], last - first + 1)))
        first = last + 1
    return placed


def _compared(sequence: Sequence, layout: RegisterLayout) -> list[Placed]:
    """Have what is computed more than once come out the same."""
    placed: list[Placed] = []
    for context, instruction in sequence.placed:
        operation = instruction[0]
        if operation in WITHOUT_RESULT or operation == code.UNIFY:
            placed.append((context, instruction))
            continue
        is_again = instruction[-1] == AGAIN
        if is_again:
            instruction = instruction[:-1]
        count = 2 if operation == code.TOWARDS else 1
        results = instruction[1 : 1 + count]
        if not is_again and not sequence.shared & set(results):
            placed.append((context, instruction))
        elif operation == code.COPY:
            placed.append((context, (code.UNIFY, instruction[1], instruction[2])))
        else:
            aside = tuple(layout.take(1) for _ in results)
            placed.append((context, (operation, *aside, *instruction[1 + count :])))
            placed += [(context, (code.UNIFY, out, raw)) for out, raw in zip(results, aside, strict=True)]
    return placed


def _following(instruction: Instruction, work: Elaboration, layout: RegisterLayout, sequence: Sequence) -> Instruction:
    """Tell a successor by its predicate and the parameters that this block gives it."""
    if instruction[0] != code.FOLLOW:
        return instruction
    _, line, owner, number = instruction
    token = work.tokens[number]
    assert token.how == FOLLOWING
    known = [k for k in range(len(token.predicate.parameters)) if work.banks[number] + k in sequence.known]
    mask = sum(1 << k for k in known)
    return (code.FOLLOW, line, owner, work.model.number(token.predicate), mask & 0xFFFFFFFF, mask >> 32)


def _padded(instruction: Instruction) -> Instruction:
    assert len(instruction) <= STRIDE
    return (*instruction, *(0,) * (STRIDE - len(instruction)))
