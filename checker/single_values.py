"""What is known of an argument or a constant in, its one value out."""

from collections.abc import Iterator

from compiler.constants import single
from compiler.instructions import all_instructions
from compiler.program import Assign, Constant, DomainConstant, GlobalVariable, NewGlobal, Operand, Post, Program


def single_value(domain: DomainConstant | None) -> float | int | bool | str | None:
    """The one value that a domain leaves; None where it leaves several, or nothing is known."""
    if domain is None or domain.interval is None:
        return single(domain)
    lower, upper = domain.interval
    return lower if lower == upper else None


def numbers_of(program: Program) -> Iterator[tuple[Operand, float | str]]:
    """The global variables and constants of which one value is known."""
    for step in program.script:
        if isinstance(step, NewGlobal | Assign) and (value := single_value(step.domain)) is not None:
            yield GlobalVariable(step.index) if isinstance(step, NewGlobal) else step.target, value
    for rule in program.rules:
        for each in all_instructions(rule.body):
            for one in each.operands if isinstance(each, Post) else ():
                if isinstance(one, Constant) and (value := single_value(one.domain)) is not None:
                    yield one, value
