"""Supports: the actions whose effects include a predicate, in EUROPA's order."""

from array import array
from collections import Counter
from collections.abc import Iterable, Iterator
from itertools import accumulate

from compiler.program import Child, Guard, Instruction, ObjectLoop, Program


class Supports:
    """Rows `first[p]` to `first[p + 1]` hold the `action` that supports predicate p, and the number of its effect.

    `europa`: an action with several effects of the predicate is listed, with all of them, as often as it has them.
    """

    def __init__(self, program: Program, europa: bool = False) -> None:
        index = {code.name: number for number, code in enumerate(program.predicates)}
        bases = {code.name: code.base for code in program.classes}
        declared = {(code.class_name, code.name.rpartition(".")[2]): code for code in program.predicates}
        ways: list[list[tuple[int, int]]] = [[] for _ in program.predicates]
        for code in sorted(program.predicates, key=lambda code: code.name):
            base = bases.get(code.class_name)
            inherited = declared.get((base, code.name.rpartition(".")[2])) if base is not None else None
            if not code.is_action or (inherited is not None and inherited.span == code.span):
                continue  # a subclass that only inherits an action is no other way to get its effects
            for name, count in Counter(code.effects).items():
                way = [(index[code.name], number) for number in range(count)]
                ways[index[name]] += way * count if europa else way
        self.first = array("q", accumulate(map(len, ways), initial=0))
        self.action = array("q", [action for rows in ways for action, _ in rows])
        self.effect = array("q", [effect for rows in ways for _, effect in rows])
        self.reach = _reachable(program, index, ways)
        self.guarded = 0  # the set, as bits, of predicates below guards
        for code in program.predicates:
            for rule in code.rules:
                for name in _children(program.rules[rule].body, code.class_name, index, False):
                    self.guarded |= self.reach[index[name]]

    def leads_to(self, predicate: int, other: int) -> bool:
        """Whether an active token of one predicate may lead to a token of the other."""
        return (self.reach[predicate] >> other) & 1 != 0

    def is_guarded(self, predicate: int) -> bool:
        """Whether a branch of some guard may lead to a token of a predicate."""
        return (self.guarded >> predicate) & 1 != 0


def _reachable(program: Program, index: dict[str, int], ways: list[list[tuple[int, int]]]) -> list[int]:
    """For each predicate the set, as bits, of all that its rules, and actions that support it, may ask for."""
    asked: list[list[int]] = [[] for _ in program.predicates]
    bases = {code.name: code.base for code in program.classes}
    for number, code in enumerate(program.predicates):
        for rule in code.rules:
            for name in _children(program.rules[rule].body, code.class_name, index):
                asked[number].append(index[name])
        asked[number] += [action for action, _ in ways[number]]
        base, suffix = bases[code.class_name], code.name.rpartition(".")[2]
        if (inherited := index.get(f"{base}.{suffix}")) is not None:
            asked[number].append(inherited)  # a token of the subclass's predicate is one of the base's, too
    order = _bottom_up(asked)
    reach = [1 << number for number in range(len(asked))]
    is_growing = True
    while is_growing:  # twice, and once more for each cycle within a cycle
        is_growing = False
        for number in order:
            grown = reach[number]
            for other in asked[number]:
                grown |= reach[other]
            is_growing = is_growing or grown != reach[number]
            reach[number] = grown
    return reach


def _bottom_up(asked: list[list[int]]) -> list[int]:
    """All predicates, each after those that it asks for, but for cycles (depth first, postorder)."""
    order: list[int] = []
    is_met = [False] * len(asked)
    for root in range(len(asked)):
        pending = [(root, False)]
        while pending:
            number, is_left = pending.pop()
            if is_left:
                order.append(number)
            elif not is_met[number]:
                is_met[number] = True
                pending.append((number, True))
                pending += [(other, False) for other in asked[number]]
    return order


def _children(
    body: Iterable[Instruction], owner: str, index: dict[str, int], with_unguarded: bool = True
) -> Iterator[str]:
    """The predicates that a body asks for, on any branch, when it runs for a token of class `owner`."""
    for instruction in body:
        if isinstance(instruction, Child) and with_unguarded:
            name = f"{owner}.{instruction.predicate.rpartition('.')[2]}"
            yield name if instruction.object == "own" and name in index else instruction.predicate
        elif isinstance(instruction, Guard):
            yield from _children((*instruction.then, *instruction.otherwise), owner, index)
        elif isinstance(instruction, ObjectLoop):
            yield from _children(instruction.body, owner, index, with_unguarded)
