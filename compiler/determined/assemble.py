"""Assemble a block: what starts together, put into causal order and optimised, becomes one list of integers."""

from compiler.determined import code
from compiler.determined.code import RegisterBlock, RegisterLayout
from compiler.determined.elaborate import Elaboration
from compiler.determined.linear import linear
from compiler.determined.model import ReactorModel
from compiler.determined.operations import Instruction
from compiler.determined.optimise import BlockFacts, optimise, packed
from compiler.determined.relations import FOLLOWING, ROOT, TOGETHER
from compiler.determined.schedule import AGAIN, Placed, Sequence, schedule
from compiler.program import PredicateCode

_WITHOUT_RESULT: frozenset[int] = frozenset(
    {
        *(code.NEED, code.HOLD, code.CLEAR, code.BEGIN, code.MERGE, code.PREVIOUS, code.FOLLOW, code.LAST_EXACTLY),
        *(code.LAST_LEAST, code.LAST_MOST, code.TIE, code.WITHIN, code.MEMBER, code.ORDER, code.PLANNED),
    }
)


def compile_block(
    model: ReactorModel, layout: RegisterLayout, line: int, predicate: PredicateCode, mask: int
) -> RegisterBlock:
    """The block of a predicate on a timeline, with the parameters in `mask` given; raises `UndeterminedError`."""
    first = layout.top
    work = Elaboration(model, layout, line, predicate, mask)
    sequence = schedule(work.sheet)
    placed, is_sure = optimise(_compared(sequence, layout), _known(work, layout, sequence, first))
    placed = [*_clearing(work, sequence), *placed]
    placed = [(context, _following(instruction, work, layout, sequence)) for context, instruction in placed]
    return RegisterBlock(
        line,
        predicate,
        mask,
        tuple(linear(packed(placed))),
        tuple(work.tokens),
        tuple(work.guards),
        tuple(work.locals),
        tuple(work.draws),
        is_sure,
    )


def _known(work: Elaboration, layout: RegisterLayout, sequence: Sequence, first: int) -> BlockFacts:
    """What is known of a block whose own registers are those from `first` on."""
    shown = {each.shown.register for each in work.locals} | {each.register for each in work.guards}
    return BlockFacts(
        layout,
        tuple(work.tokens),
        tuple(work.banks),
        frozenset(work.sheet.given),
        sequence.cleared,
        frozenset(range(first, layout.top)) - shown,
    )


def _clearing(work: Elaboration, sequence: Sequence) -> list[Placed]:
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
        if operation in _WITHOUT_RESULT or operation == code.UNIFY:
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
    lasting = layout.widths[line] - 1
    if layout.tells_lengths and work.banks[number] + lasting in sequence.known:
        known.append(lasting)
    mask = sum(1 << k for k in known)
    return (code.FOLLOW, line, owner, work.model.number(token.predicate), mask & 0xFFFFFFFF, mask >> 32)
