"""Bodies of rules, predicates and the script, read for a judge: instructions in, its steps out.

Both judges, that of single runs and that of many runs at once, are given the same questions in the same order.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar, assert_never

from checker.judge.meanings import MEANINGS, SILENT, Meaning
from checker.judge.operands import VariableNames, is_range
from compiler.program import (
    Assign,
    Call,
    Child,
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
)

Written = dict[str, Meaning]  # constraints of the project, by name
_S = TypeVar("_S")


@dataclass(frozen=True, eq=False, slots=True)
class StepMaker(Generic[_S]):
    """Makes the step that judges each kind of instruction."""

    variable: Callable[[NewVariable, VariableNames], _S]  # one with a name
    blank: Callable[[int], _S]  # a slot of which nothing is known
    assign: Callable[[Assign, VariableNames], _S]
    sample: Callable[[Sample, int | None, VariableNames], _S]  # a draw, and the slot that it defines, if any
    child: Callable[[Child, VariableNames], _S]
    relate: Callable[[Relate], _S]
    use: Callable[[Post, VariableNames], _S]  # of a resource
    define: Callable[[Post, int, int, VariableNames], _S]  # index and slot of the argument that a constraint defines
    pass_over: Callable[[str], _S]  # a constraint that the judge does not know
    check: Callable[[Post, Meaning, VariableNames], _S]
    check_loose: Callable[[Post, Meaning, VariableNames], _S]  # a range in the text stands for any of its values
    guard: Callable[[Guard, list[_S], list[_S], VariableNames], _S]
    loop: Callable[[ObjectLoop, list[_S], VariableNames], _S]


def compile_body(
    body: tuple[Instruction, ...],
    names: VariableNames,
    written: Written,
    make: StepMaker[_S],
    undefined: set[int] | None = None,
) -> list[_S]:
    """The steps of a body; `undefined` are slots of expressions that nothing has defined yet."""
    undefined = set() if undefined is None else undefined
    steps: list[_S] = []
    for instruction in body:
        match instruction:
            case NewVariable(name=None, slot=slot):
                undefined.add(slot)
            case NewVariable(name=str(name), slot=slot):
                names.locals[slot] = name
                names.types[slot] = instruction.type
                steps.append(make.variable(instruction, names))
            case Post():
                steps += _post(instruction, names, written, make, undefined)
            case Sample(target=LocalVariable(slot=slot)) if slot in undefined:
                undefined.discard(slot)
                steps.append(make.sample(instruction, slot, names))
            case Sample():
                steps.append(make.sample(instruction, None, names))
            case Child():
                names.tokens[instruction.slot] = (instruction.label or "", instruction.predicate)
                steps.append(make.child(instruction, names))
            case Relate():
                steps.append(make.relate(instruction))
            case Guard():
                branches = (instruction.then, instruction.otherwise)
                then, otherwise = (compile_body(each, names, written, make, set(undefined)) for each in branches)
                steps.append(make.guard(instruction, then, otherwise, names))
            case ObjectLoop():
                inner = compile_body(instruction.body, names, written, make, set(undefined))
                steps.append(make.loop(instruction, inner, names))
            case Assign():
                steps.append(make.assign(instruction, names))
            case NewObject(slot=int(slot)):
                steps.append(make.blank(slot))
            case NewVariable() | NewObject() | NewGlobal() | NewToken() | Call():
                pass  # of the script, which `script` reads
            case _:
                assert_never(instruction)
    return steps


def _post(post: Post, names: VariableNames, written: Written, make: StepMaker[_S], undefined: set[int]) -> list[_S]:
    """The steps of a constraint."""
    name = post.name
    if name in SILENT:
        return []
    if name == "uses":
        return [make.use(post, names)]
    for index, operand in enumerate(post.operands):
        if isinstance(operand, LocalVariable) and operand.slot in undefined:
            undefined.discard(operand.slot)
            names.parts[operand.slot] = tuple([each for each in post.operands if each is not operand])
            return [make.define(post, index, operand.slot, names)]
    meaning = MEANINGS.get(name) or written.get(name)
    if meaning is None:
        return [make.pass_over(name)]
    is_loose = any(is_range(each) for each in post.operands)
    return [(make.check_loose if is_loose else make.check)(post, meaning, names)]
