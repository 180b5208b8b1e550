"""Tell what a constraint determines: a value that it leaves no choice for must have been fixed in an executed plan."""

from checker.judge.functions import result_index
from checker.judge.operands import BodyFrame, VariableNames
from checker.judge.solving import PartRange, solver
from checker.judge.values import ENDLESS, UNKNOWN, is_open
from compiler.program import Constant, GlobalVariable, LocalVariable, Operand, Post, TokenVariable
from runtime.executive.record import Value

_OWN, _CHILD, _OTHER = range(3)
_EQUALITIES = ("eq", "concurrent")


class Determined:
    """Which argument of one constraint the others determine."""

    def __init__(self, post: Post, names: VariableNames) -> None:
        self.owners = [_owner(operand, names) for operand in post.operands]
        self.tokens = [operand.token if isinstance(operand, TokenVariable) else -1 for operand in post.operands]
        self.slots = [operand.slot if isinstance(operand, LocalVariable) else -1 for operand in post.operands]
        self.solvers = [solver(post.name, k, len(post.operands)) for k in range(len(post.operands))]
        self.is_equality = post.name in _EQUALITIES
        self.index = result_index(post.name, len(post.operands))

    def infer(self, frame: BodyFrame, values: list[Value]) -> None:
        """Give a local variable that nobody knows the value that the others determine."""
        unfixed = [k for k, value in enumerate(values) if value == UNKNOWN]
        if len(unfixed) != 1 or self.slots[unfixed[0]] < 0:
            return
        solve = self.solvers[unfixed[0]]
        if solve is not None:
            value = solve(*[each for k, each in enumerate(values) if k != unfixed[0]])
            if not is_open(value):
                frame.slots[self.slots[unfixed[0]]] = value
                frame.choosing.known.add(self.slots[unfixed[0]])

    def is_left_open(self, frame: BodyFrame, values: list[Value]) -> bool:
        """Whether the value that the others determine was never fixed.

        A token may leave the plan before the children that its rule speaks of are decided; so an open variable of its
        own counts only where all others are its own too.
        """
        unfixed = [k for k, value in enumerate(values) if is_open(value)]
        if len(unfixed) != 1 or (unfixed[0] != self.index and not self.is_equality):
            return False
        if any(isinstance(value, (int, float)) and abs(value) >= ENDLESS for value in values):
            return False  # what lies beyond the bounds of numbers is never fixed
        k = unfixed[0]
        if isinstance(values[k], PartRange):
            return False
        is_of_script = frame.tok is None and self.tokens[k] >= 0  # which has no token of its own
        if self.owners[k] == _CHILD or is_of_script:
            return frame.tokens[self.tokens[k]] is not None
        return self.owners[k] == _OWN and _CHILD not in self.owners


def _owner(operand: Operand, names: VariableNames) -> int:
    """Whose variable an operand is."""
    match operand:
        case TokenVariable(token=token):
            return _CHILD if token else _OWN
        case GlobalVariable(index=index):
            return _OTHER if index == names.clock else _OWN
        case LocalVariable():
            return _OWN
        case Constant(domain=domain) if domain.values is not None and len(domain.values) == 1:
            return _OWN
        case _:
            return _OTHER
