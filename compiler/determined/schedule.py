"""Causal order: put the items of a block into a sequence in which everything is computed before it is read.

What only some branches compute is read once no other way to compute it is left. Then it may be unknown in a branch that
nobody thought of, so the machine is told to look. A wrong order can cost a mission its speed, never its truth: the
machine stops at what it does not know, and the general engine takes over.
"""

from dataclasses import dataclass, field

from compiler.determined import code
from compiler.determined.items import Context, Item, Worksheet
from compiler.determined.operations import Instruction, Way
from compiler.determined.reasons import FreeChoice, UndeterminedError

Placed = tuple[Context, Instruction]
AGAIN = -1  # at the end of an instruction: its result is known, and must come out the same
_NOWHERE: Context = ((-1, True),)  # where no instruction stands


@dataclass(eq=False, slots=True)
class _Knowledge:
    """Where each register is known: the contexts that compute it; `closed` ones may be read anywhere, with a look."""

    known: dict[int, list[Context]] = field(default_factory=dict)
    closed: set[int] = field(default_factory=set)

    def is_sure(self, register: int, context: Context) -> bool:
        """Whether a register certainly has a value in a context."""
        return any(set(each) <= set(context) for each in self.known.get(register, ()))

    def is_readable(self, register: int, context: Context) -> bool:
        """Whether a register may be read in a context."""
        return self.is_sure(register, context) or (register in self.closed and register in self.known)

    def copy(self) -> "_Knowledge":
        """The same, to be tried out."""
        return _Knowledge({register: list(contexts) for register, contexts in self.known.items()}, set(self.closed))


@dataclass(frozen=True, slots=True)
class Sequence:
    """The instructions of a block in causal order, the registers that are computed more than once, and all known."""

    placed: list[Placed]
    shared: frozenset[int]
    cleared: frozenset[int]  # what must read as unknown until it is computed
    known: frozenset[int]


def schedule(sheet: Worksheet) -> Sequence:
    """All items as instructions, each under its context; raises `UndeterminedError` where something stays unknown."""
    knowledge = _Knowledge({register: [()] for register in sheet.given})
    for register in sheet.doubtful - sheet.given:
        knowledge.known[register] = [_NOWHERE]
        knowledge.closed.add(register)
    waiting = [item for item in sheet.items if item.rank < 1]
    placed: list[Placed] = []
    checks: list[Item] = []
    looked: dict[int, list[Context]] = {}
    writers: dict[int, int] = {}
    while True:
        _advance(waiting, checks, knowledge, placed, looked, writers)
        if not waiting:
            break
        candidates = [
            register
            for register in knowledge.known
            if register not in knowledge.closed and not knowledge.is_sure(register, sheet.homes.get(register, ()))
        ]
        chosen = next((r for r in candidates if _is_complete(r, candidates, waiting, knowledge)), None)
        if chosen is None:
            if not candidates:
                raise _stuck(waiting, knowledge, sheet)
            chosen = candidates[0]
        knowledge.closed.add(chosen)
    knowledge.closed |= set(knowledge.known)
    for item in checks:
        _check(item, knowledge, placed, looked)
    for register, context in sheet.wanted.items():
        if register in sheet.given or knowledge.is_sure(register, context):
            continue
        if register not in knowledge.known:
            if register in sheet.openable and not _is_named(register, sheet):
                continue
            name, span = sheet.names.get(register, ("a value", None))
            raise UndeterminedError(FreeChoice.OPEN_VALUE, name, span)
        _look(register, context, knowledge, placed, looked)
    for item in sheet.items:
        if item.rank == 1:
            for register in item.needs:
                if register in knowledge.known:
                    _look(register, item.context, knowledge, placed, looked)
            placed += [(item.context, instruction) for instruction in item.check or ()]
    shared = frozenset(register for register, count in writers.items() if count > 1)
    cleared = (shared | looked.keys()) - sheet.given - sheet.doubtful
    return Sequence(placed, shared, frozenset(cleared), frozenset(knowledge.known))


def _advance(
    waiting: list[Item],
    checks: list[Item],
    knowledge: _Knowledge,
    placed: list[Placed],
    looked: dict[int, list[Context]],
    writers: dict[int, int],
) -> None:
    """Place whatever can be placed; items of the context that was used last come first, so that branches stay whole."""
    while True:
        ready = [item for item in waiting if _is_ready(item, knowledge)]
        if not ready:
            return
        last = placed[-1][0] if placed else ()
        item = min(ready, key=lambda each: (each.rank, each.context != last))
        waiting.remove(item)
        for register, _ in item.context:
            _look(register, _before(item.context, register), knowledge, placed, looked)
        if item.rank < 0:
            placed += [(item.context, instruction) for instruction in item.check or ()]
            continue
        way = _way(item, knowledge)
        if way is None:
            checks.append(item)
            continue
        for register in way.inputs:
            _look(register, item.context, knowledge, placed, looked)
        placed += [(item.context, instruction) for instruction in way.instructions]
        for register in way.outputs:
            knowledge.known.setdefault(register, []).append(item.context)
            writers[register] = writers.get(register, 0) + 1


def _before(context: Context, register: int) -> Context:
    return context[: [each for each, _ in context].index(register)]


def _is_ready(item: Item, knowledge: _Knowledge) -> bool:
    if not all(knowledge.is_readable(register, _before(item.context, register)) for register, _ in item.context):
        return False
    return item.rank < 0 or _way(item, knowledge) is not None or _all_known(item, knowledge)


def _all_known(item: Item, knowledge: _Knowledge) -> bool:
    return all(knowledge.is_readable(register, item.context) for register in item.needs)


def _way(item: Item, knowledge: _Knowledge) -> Way | None:
    """A way to compute what an item can tell and nobody told yet."""
    for way in item.ways:
        if any(knowledge.is_readable(register, item.context) for register in way.outputs):
            continue
        if all(knowledge.is_readable(register, item.context) for register in way.inputs):
            return way
    return None


def _is_complete(register: int, candidates: list[int], waiting: list[Item], knowledge: _Knowledge) -> bool:
    """Whether nothing else that waits could still compute `register`, were all other candidates known."""
    trial = knowledge.copy()
    trial.closed |= set(candidates) - {register}
    left = list(waiting)
    count = len(trial.known[register])
    while True:
        item = next((each for each in left if _is_ready(each, trial)), None)
        if item is None:
            return len(trial.known[register]) == count
        left.remove(item)
        way = _way(item, trial) if item.rank >= 0 else None
        for output in way.outputs if way else ():
            trial.known.setdefault(output, []).append(item.context)


def _check(item: Item, knowledge: _Knowledge, placed: list[Placed], looked: dict[int, list[Context]]) -> None:
    """Place what must hold once everything is known."""
    for register in item.needs:
        _look(register, item.context, knowledge, placed, looked)
    if item.check is not None:
        placed += [(item.context, instruction) for instruction in item.check]
        return
    # A function of what is known must give what is known: the last operation goes aside and is compared.
    way = item.ways[0]
    placed += [(item.context, instruction) for instruction in way.instructions[:-1]]
    last = way.instructions[-1]
    if last[0] == code.COPY:
        placed.append((item.context, (code.UNIFY, last[1], last[2])))
        return
    placed.append((item.context, (*last, AGAIN)))


def _look(
    register: int, context: Context, knowledge: _Knowledge, placed: list[Placed], looked: dict[int, list[Context]]
) -> None:
    """Have the machine stop if a register that only some branches compute has no value here."""
    if knowledge.is_sure(register, context):
        return
    if any(set(each) <= set(context) for each in looked.get(register, ())):
        return
    looked.setdefault(register, []).append(context)
    placed.append((context, (code.NEED, register, 1)))


def _is_named(register: int, sheet: Worksheet) -> bool:
    return any(register in item.needs for item in sheet.items)


def _stuck(waiting: list[Item], knowledge: _Knowledge, sheet: Worksheet) -> UndeterminedError:
    """The value that is missing, with the constraint that waits for it."""
    for item in waiting:
        for register in (*(each for each, _ in item.context), *item.needs):
            if not knowledge.is_readable(register, item.context):
                name = sheet.names.get(register, ("", None))[0] or item.name.split("\n")[0]
                return UndeterminedError(FreeChoice.OPEN_VALUE, name, item.span)
    return UndeterminedError(FreeChoice.OPEN_VALUE, waiting[0].name.split("\n")[0], waiting[0].span)
