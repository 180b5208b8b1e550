"""Guards that read AGENT_CLOCK in, the values out that their conditions cannot come to have while a mission goes on.

AGENT_CLOCK reads "now or later" up to the final tick: `start <= AGENT_CLOCK` comes to be true, and is never false.
"""

from compiler.program import GlobalVariable, Instruction, LocalVariable, NewVariable, Operand, Post, Program

_BOTH = frozenset((True, False))


class ClockGuards:
    """Which truth values the conditions of one rule may come to have, its instructions read in order."""

    def __init__(self, clock: Operand | None) -> None:
        self._rising: set[Operand] = set() if clock is None else {clock}  # "what it is now, or more"
        self._falling: set[Operand] = set()
        self._values: dict[Operand, frozenset[bool]] = {}
        self._made: list[Operand] = []  # what holds results, in order

    def read(self, step: Instruction) -> None:
        """Take in an instruction that stands before others."""
        if isinstance(step, NewVariable) and step.name is None:
            self._made.append(LocalVariable(step.slot))
        if not isinstance(step, Post):
            return
        match step.name, step.operands:
            case "addEq", (a, b, total):
                self._add(a, b, total)
            case "neg", (result, a):
                if a in self._falling:
                    self._rising.add(result)
                elif a in self._rising:
                    self._falling.add(result)
            case (("testLeq" | "testLessThan"), (result, a, b)):
                is_later = b in self._rising or a in self._falling
                is_earlier = a in self._rising or b in self._falling
                if is_later != is_earlier:
                    self._values[result] = frozenset((is_later,))
            case ("testEq" | "testNeq") as name, (result, a, b):
                if {a, b} & (self._rising | self._falling):
                    self._values[result] = frozenset((name == "testNeq",))
            case "neq", (result, a) if a in self._values:
                self._values[result] = frozenset(not one for one in self._values[a])
            case ("testAnd" | "testOr") as name, (result, a, b):
                whole = all if name == "testAnd" else any
                pairs = ((left, right) for left in self.of(a) for right in self.of(b))
                self._values[result] = frozenset(whole(pair) for pair in pairs)

    def of(self, condition: Operand) -> frozenset[bool]:
        """The values that a condition may come to have."""
        return self._values.get(condition, _BOTH)

    def _add(self, a: Operand, b: Operand, total: Operand) -> None:
        """`a + b == total`: of a sum `total` is computed, of a difference `a`; a result is made before its operands."""
        made = min((one for one in (a, total) if one in self._made), key=self._made.index, default=None)
        if made == total:
            rising, falling = {a, b} & self._rising, {a, b} & self._falling
        elif made == a:
            rising = ({total} & self._rising) | ({b} & self._falling)
            falling = ({total} & self._falling) | ({b} & self._rising)
        else:
            return
        if rising and not falling:
            self._rising.add(made)
        elif falling and not rising:
            self._falling.add(made)


def clock_of(program: Program) -> GlobalVariable | None:
    """AGENT_CLOCK, where a program has it."""
    return next((GlobalVariable(k) for k, (name, _) in enumerate(program.globals) if name == "AGENT_CLOCK"), None)
