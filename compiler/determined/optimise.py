"""Optimise the instructions of a block: the same values and the same stops, in fewer and wider operations.

Each pass takes placed instructions and returns others. A block that stops has done nothing, so demands may move as long
as they see the same values; only what is read outside the block has to be in its register when the block ends.
"""

from collections import Counter
from collections.abc import Callable, Collection
from dataclasses import dataclass

from compiler.determined import code
from compiler.determined.code import BlockToken, RegisterLayout
from compiler.determined.items import Context
from compiler.determined.operations import Instruction
from compiler.determined.relations import ROOT, TOGETHER
from compiler.determined.schedule import Placed

_OPERANDS: dict[int, slice] = {
    **dict.fromkeys((code.COPY, code.NEG, code.ABS, code.SQRT, code.FLOOR, code.CEIL, code.WHOLE), slice(2, 3)),
    **dict.fromkeys((code.ADD, code.SUB, code.MUL, code.DIV, code.MIN, code.MAX, code.MOD), slice(2, 4)),
    **dict.fromkeys((code.LEQ, code.LESS, code.EQUAL, code.SAME, code.AND, code.OR), slice(2, 4)),
    **dict.fromkeys((code.NOT, code.LAST_EXACTLY, code.LAST_LEAST, code.LAST_MOST), slice(2, 3)),
    **dict.fromkeys((code.UNIFY, code.ORDER), slice(1, 3)),
    **dict.fromkeys((code.HOLD, code.MEMBER), slice(1, 2)),
    code.DISTANCE: slice(2, 6),
    code.TOWARDS: slice(3, 7),
    code.TRAVEL: slice(2, 7),
    code.MUL_ADD: slice(2, 5),
}
_ONE_RESULT = frozenset(
    {
        *(code.COPY, code.ADD, code.SUB, code.MUL, code.DIV, code.NEG, code.ABS, code.MIN, code.MAX, code.SQRT),
        *(code.FLOOR, code.CEIL, code.MOD, code.WHOLE, code.LEQ, code.LESS, code.EQUAL, code.SAME, code.NOT),
        *(code.AND, code.OR, code.DISTANCE, code.TRAVEL, code.UNIFY, code.DRAW, code.MUL_ADD),
    }
)


def _reads(instruction: Instruction) -> Collection[int]:
    """The registers that an instruction reads."""
    operation = instruction[0]
    if operation in (code.NEED, code.MOVE):
        first = instruction[1 if operation == code.NEED else 2]
        return range(first, first + instruction[-1])
    where = _OPERANDS.get(operation)
    return () if where is None else instruction[where]


def _writes(instruction: Instruction) -> Collection[int]:
    """The registers that an instruction writes; those of a token that begins are the machine's."""
    operation = instruction[0]
    if operation in _ONE_RESULT:
        return instruction[1:2]
    if operation == code.TOWARDS:
        return instruction[1:3]
    if operation in (code.CLEAR, code.MOVE):
        return range(instruction[1], instruction[1] + instruction[-1])
    return ()


@dataclass(frozen=True, slots=True)
class BlockFacts:
    """What is known of a block besides its instructions."""

    layout: RegisterLayout
    tokens: tuple[BlockToken, ...]
    banks: tuple[int, ...]  # of the parameters of each token
    given: frozenset[int]  # parameters that have a value when the block begins
    unknown: frozenset[int]  # registers without a value until the block computes one
    passing: frozenset[int]  # registers that nobody reads once the block is over


def optimise(placed: list[Placed], known: BlockFacts) -> tuple[list[Placed], bool]:
    """The instructions, optimised, and whether all parameters of the tokens that begin must have a value."""
    placed = _written_once(placed, known)
    placed = _in_place(placed, known)
    is_sure = _has_all(placed, known)
    if is_sure:
        placed = _logged(placed, known)
    placed = _multiplied(placed, known)
    placed = _needed_together(placed)
    placed = _moved_together(placed)
    return _compared_late(placed), is_sure


# ---- one value, one register ----


def _written_once(placed: list[Placed], known: BlockFacts) -> list[Placed]:
    """Write what certainly has no value yet, instead of comparing."""
    apart = _Apart(placed, known.layout)
    begun: set[int] = {token.line for token in known.tokens if token.how == ROOT}
    unknown = {register: token.line for register, token in _begun(known).items()}
    done: list[Placed] = []
    writers: dict[int, list[Context]] = {}
    for context, instruction in placed:
        if instruction[0] == code.BEGIN:
            begun.add(instruction[1])
        if instruction[0] == code.UNIFY and instruction[1] not in known.given:
            out = instruction[1]
            is_open = unknown[out] in begun if out in unknown else out in known.unknown
            if is_open and all(apart.never_both(context, other) for other in writers.get(out, ())):
                instruction = (code.COPY, *instruction[1:])
        if instruction[0] != code.CLEAR:
            for register in _writes(instruction):
                writers.setdefault(register, []).append(context)
        done.append((context, instruction))
    return done


class _Apart:
    """Which branches are never taken together: a value is compared with constants that differ."""

    def __init__(self, placed: list[Placed], layout: RegisterLayout) -> None:
        writers: dict[int, list[Instruction]] = {}
        for _, instruction in placed:
            for register in _writes(instruction) if instruction[0] != code.CLEAR else ():
                writers.setdefault(register, []).append(instruction)
        self.compared: dict[int, tuple[int, float]] = {}
        for register, found in writers.items():
            if len(found) == 1 and found[0][0] == code.SAME and found[0][3] in layout.presets:
                value = found[0][2]
                # Once it is known it never changes.
                if sum(one[0] != code.UNIFY for one in writers.get(value, ())) <= 1:
                    self.compared[register] = (value, layout.presets[found[0][3]])

    def never_both(self, one: Context, other: Context) -> bool:
        """Whether at most one of two contexts holds."""
        for register, truth in one:
            for second, wanted in other:
                if register == second and truth != wanted:
                    return True
                a, b = self.compared.get(register), self.compared.get(second)
                if truth and wanted and a is not None and b is not None and a[0] == b[0] and a[1] != b[1]:
                    return True
        return False


def _times_read(placed: list[Placed]) -> Counter[int]:
    """How often each register is read, by instructions and for the branches that they stand in."""
    return Counter(
        register
        for context, instruction in placed
        for register in (*_reads(instruction), *[each for each, _ in context])
    )


def _joined(placed: list[Placed], join: Callable[[Instruction, Instruction], Instruction | None]) -> list[Placed]:
    """Each two that follow each other in one branch become what `join` makes of them, if it makes one."""
    done: list[Placed] = []
    for context, instruction in placed:
        before, made = done[-1] if done else ((), instruction)
        both = join(made, instruction) if done and before == context else None
        if both is None:
            done.append((context, instruction))
        else:
            done[-1] = (context, both)
    return done


def _in_place(placed: list[Placed], known: BlockFacts) -> list[Placed]:
    """Compute where the value is wanted, instead of aside."""
    count = _times_read(placed)

    def join(made: Instruction, copy: Instruction) -> Instruction | None:
        if copy[0] != code.COPY or made[0] not in _ONE_RESULT - {code.COPY, code.UNIFY}:
            return None
        _, out, aside = copy[:3]
        is_aside = made[1] == aside and aside in known.passing and count[aside] == 1
        return (made[0], out, *made[2:]) if is_aside and out not in _reads(made) else None

    return _joined(placed, join)


def _multiplied(placed: list[Placed], known: BlockFacts) -> list[Placed]:
    """A product that is only added to something becomes one operation with the sum; each is rounded by itself."""
    count = _times_read(placed)

    def join(made: Instruction, added: Instruction) -> Instruction | None:
        if made[0] != code.MUL or added[0] != code.ADD:
            return None
        _, out, a, b = added[:4]
        if a == b or made[1] not in (a, b) or made[1] not in known.passing or count[made[1]] != 1:
            return None
        return (code.MUL_ADD, out, made[2], made[3], b if made[1] == a else a)

    return _joined(placed, join)


# ---- what must be known ----


def _begun(known: BlockFacts) -> dict[int, BlockToken]:
    """The parameters of all tokens that begin, with their tokens."""
    return {
        known.banks[number] + k: token
        for number, token in enumerate(known.tokens)
        if token.how in (ROOT, TOGETHER)
        for k in range(len(token.predicate.parameters))
    }


def _has_all(placed: list[Placed], known: BlockFacts) -> bool:
    """Whether the block stops, or all parameters of the tokens that begin have a value."""
    told: dict[int, list[Context]] = {}
    for context, instruction in placed:
        if instruction[0] == code.NEED:
            told.setdefault(instruction[1], []).append(context)
        elif instruction[0] != code.CLEAR:
            for register in _writes(instruction):
                told.setdefault(register, []).append(context)
    return all(
        register in known.given or any(set(one) <= set(token.context) for one in told.get(register, ()))
        for register, token in _begun(known).items()
    )


def _logged(placed: list[Placed], known: BlockFacts) -> list[Placed]:
    """Leave out demands that the log makes of all parameters of a token: they are known, and not too large."""
    begun = _begun(known)
    writers: dict[int, list[int]] = {}
    for k, (_, instruction) in enumerate(placed):
        for register in _writes(instruction):
            writers.setdefault(register, []).append(k)
    goes_to: dict[int, list[Context]] = {register: [token.context] for register, token in begun.items()}
    for context, instruction in placed:
        if instruction[0] != code.COPY:
            continue
        out, source = instruction[1:3]
        if out in begun and len(writers[out]) == 1 and source not in writers:
            goes_to.setdefault(source, []).append((*begun[out].context, *context))
    done: list[Placed] = []
    for k, (context, instruction) in enumerate(placed):
        if instruction[0] == code.NEED and max(writers.get(instruction[1], [k])) <= k:
            if any(set(one) <= set(context) for one in goes_to.get(instruction[1], ())):
                continue
        done.append((context, instruction))
    return done


def _needed_together(placed: list[Placed]) -> list[Placed]:
    """Demands on neighbours that are made anyway become one, where the first of them stands."""
    written = {register for _, instruction in placed for register in _writes(instruction)}
    always = {
        instruction[1]
        for context, instruction in placed
        if instruction[0] == code.NEED and not context and instruction[1] not in written
    }
    left = set(always)
    done: list[Placed] = []
    for context, instruction in placed:
        if instruction[0] != code.NEED or instruction[1] not in always:
            done.append((context, instruction))
        elif not context and instruction[1] in left:
            first = instruction[1]
            while first - 1 in left:
                first -= 1
            count = 0
            while first + count in left:
                left.remove(first + count)
                count += 1
            done.append((context, (code.NEED, first, count)))
    return done


# ---- branches ----


def _compared_late(placed: list[Placed]) -> list[Placed]:
    """Comparisons that open a branch stand right before it, where nothing looks at them in between."""
    done = list(placed)
    for context, instruction in placed:
        if instruction[0] != code.SAME:
            continue
        out, *compared = instruction[1:4]
        at = done.index((context, instruction))
        for k in range(at + 1, len(done)):
            other, later = done[k]
            if other[: len(context) + 1] == (*context, (out, True)):
                done.insert(k - 1, done.pop(at))
                break
            looked = {*_reads(later), *_writes(later), *[register for register, _ in other]}
            if out in looked or not set(_writes(later)).isdisjoint(compared) or later[0] == code.BEGIN:
                break
    return done


# ---- copies ----


def _moved_together(placed: list[Placed]) -> list[Placed]:
    """Copies between neighbours become one: each waits as long as nothing touches what it copies."""
    waiting: list[Placed] = []
    done: list[Placed] = []
    for k, one in enumerate(placed):
        held = [each for each in waiting if _holds_up(each, placed, k)]
        done += _widened(held)
        waiting = [each for each in waiting if each not in held]
        if one[1][0] == code.COPY:
            waiting.append(one)
        else:
            done.append(one)
    return done + _widened(waiting)


def _holds_up(copy: Placed, placed: list[Placed], k: int) -> bool:
    """Whether a copy has to be made before the instruction at `k`, or before the branch that begins there."""
    depth = len(copy[0])
    if placed[k][0][:depth] != copy[0]:
        return True
    _, out, source = copy[1]
    for context, instruction in placed[k:]:
        touched = {*_reads(instruction), *_writes(instruction), *[register for register, _ in context]}
        if out in touched or source in _writes(instruction) or instruction[0] == code.BEGIN:
            return True
        if context == copy[0] or context[:depth] != copy[0]:
            return False
    return False


def _widened(copies: list[Placed]) -> list[Placed]:
    """Copies of which none reads what another writes, those of neighbours to neighbours as one."""
    found: list[Placed] = []
    for context, (_, out, source) in sorted(copies):
        before, last = found[-1] if found else (context, (code.MOVE, 0, 0, 0))
        if before == context and (out, source) == (last[1] + last[3], last[2] + last[3]) and last[3]:
            found[-1] = (context, (code.MOVE, last[1], last[2], last[3] + 1))
        else:
            found.append((context, (code.MOVE, out, source, 1)))
    return [(context, one if one[3] > 1 else (code.COPY, *one[1:3])) for context, one in found]


def packed(placed: list[Placed]) -> list[Placed]:
    """Copies that follow each other in one branch, three to an instruction; long moves stay as they are."""
    done: list[Placed] = []
    pairs: list[tuple[int, int]] = []
    inside: Context = ()

    def give() -> None:
        for k in range(0, len(pairs), 3):
            three = pairs[k : k + 3]
            flat = [each for pair in three for each in pair]
            done.append((inside, (code.COPY, *flat) if len(flat) == 2 else (code.COPIES, *flat, *flat[-2:])[:7]))
        pairs.clear()

    for context, instruction in placed:
        few = _few_copies(instruction)
        if not few or context != inside:
            give()
            inside = context
        pairs += few
        if not few:
            done.append((context, instruction))
    give()
    return done


def _few_copies(instruction: Instruction) -> list[tuple[int, int]]:
    """Result and source of each copy that an instruction makes, if it makes copies, and no more than three."""
    operation, *rest = instruction
    if operation == code.COPY:
        return [(rest[0], rest[1])]
    if operation == code.MOVE and rest[2] <= 3:
        return [(rest[0] + k, rest[1] + k) for k in range(rest[2])]
    return []
