"""Supports: the actions whose effects include a predicate, in EUROPA's order."""

from array import array
from collections import Counter
from collections.abc import Iterable, Iterator

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
        self.first = array("q", [sum(map(len, ways[:number])) for number in range(len(ways) + 1)])
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
    reach = [1 << number for number in range(len(program.predicates))]
    bases = {code.name: code.base for code in program.classes}
    for number, code in enumerate(program.predicates):
        for rule in code.rules:
            for name in _children(program.rules[rule].body, code.class_name, index):
                reach[number] |= 1 << index[name]
        for action, _ in ways[number]:
            reach[number] |= 1 << action
        base, suffix = bases[code.class_name], code.name.rpartition(".")[2]
        if (inherited := index.get(f"{base}.{suffix}")) is not None:
            reach[number] |= 1 << inherited  # a token of the subclass's predicate is one of the base's, too
    for middle in range(len(reach)):
        for number in range(len(reach)):
            if (reach[number] >> middle) & 1:
                reach[number] |= reach[middle]
    return reach


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
