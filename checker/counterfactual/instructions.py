"""A compiled rule in; out: all its instructions, and the predicates of the tokens that it relates in time."""

from collections.abc import Iterator

from compiler.instructions import all_instructions
from compiler.program import Child, Program, Relate, RuleCode

_SHARED = "AgentTimeline"


def is_shared(owner: str | None, program: Program) -> bool:
    """Whether a class is that of a timeline that reactors share, so that what holds there is observed."""
    bases = {each.name: each.base for each in program.classes}
    while owner is not None and owner != _SHARED:
        owner = bases.get(owner)
    return owner is not None


def pairs_in(rule: RuleCode) -> Iterator[tuple[str, str]]:
    """The predicates of the tokens that a rule relates in time, in pairs."""
    steps = list(all_instructions(rule.body))
    tokens = {0: rule.predicate} | {step.slot: step.predicate for step in steps if isinstance(step, Child)}
    for step in steps:
        match step:
            case Child(slot=target, origin=origin) | Relate(target=target, origin=origin):
                if origin in tokens and target in tokens:
                    yield tokens[origin], tokens[target]
            case _:
                pass
