"""Linear code: placed instructions become one list, of equal lengths, and their branches jumps."""

from compiler.determined import code
from compiler.determined.code import STRIDE
from compiler.determined.operations import Instruction
from compiler.determined.schedule import Placed


def linear(placed: list[Placed]) -> list[Instruction]:
    """Instructions with jumps over the branches that are not taken."""
    done: list[list[int]] = []
    open_branches: list[tuple[tuple[int, bool], int]] = []
    for context, instruction in [*placed, ((), (code.HALT,))]:
        common = 0
        while common < min(len(open_branches), len(context)) and open_branches[common][0] == context[common]:
            common += 1
        while len(open_branches) > common:
            opened = done[open_branches.pop()[1]]
            opened[code.TARGET[opened[0]]] = len(done)
        for condition in context[common:]:
            before = done[-1] if done else [code.HALT]
            if condition[1] and before[0] == code.SAME and before[1] == condition[0]:
                done[-1] = [code.UNLESS_SAME, *before[1:], 0]
            else:
                done.append([code.WHEN_FALSE if condition[1] else code.WHEN_TRUE, condition[0], 0])
            open_branches.append((condition, len(done) - 1))
        done.append(list(instruction))
    assert all(len(each) <= STRIDE for each in done)
    return [(*each, *(0,) * (STRIDE - len(each))) for each in done]
