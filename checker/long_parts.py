"""A mission that broke on how long a token lasted in, the story's steps out: its parts that took most of that time.

Each part with the line that says how long it lasts, those that this hangs on, and the lines by which the rule of the
whole asked for the arguments that these read.
"""

from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import replace
from itertools import chain
from pathlib import Path

from checker.counterfactual.time_spent import limited_token, parts_of_limited
from checker.influence import Branch, branch_name, branch_of, line_of
from checker.names import relative_name
from checker.proofs.places import ModelText
from checker.requested import lines_of_argument
from checker.steps import Step, StepKind
from compiler.instructions import all_instructions, branched_instructions
from compiler.program import (
    DURATION,
    FIRST_PARAMETER,
    Child,
    Guard,
    LocalVariable,
    Operand,
    Post,
    Program,
    TokenVariable,
)
from runtime.executive.outcome import Outcome, SourcePlace

_MOST, _MOST_LINES = 2, 3


def with_parts(
    steps: Iterable[Step], outcome: Outcome, text: ModelText | None, taken: Container[Branch] | None
) -> Iterator[Step]:
    """The steps of a conflict, with what the time of a token went on before the line that it lasted too long for."""
    for step in steps:
        if step.kind is StepKind.FAULT and text is not None:
            yield from _long_parts(outcome, text.programs, text.root, taken)
        yield step


def _long_parts(
    outcome: Outcome, programs: Mapping[str, Program], root: Path, taken: Container[Branch] | None
) -> Iterator[Step]:
    """The steps of the largest parts, in the order in which they began."""
    whole = limited_token(outcome)
    asking = [program for program in programs.values() for rule in program.rules if rule.predicate == whole]
    children = _children(asking[0], whole) if asking else {}
    parts = sorted(parts_of_limited(outcome, children), key=lambda one: -one.ticks)[:_MOST]
    for part in sorted(parts, key=lambda one: one.since):
        predicate = children[part.predicate]
        for program in programs.values():
            lines, read = _lasting(program, predicate, root, taken)
            if not lines:
                continue
            asked = (lines_of_argument(asking[0], whole, (predicate, name), root) for name in read)
            part = replace(part, asked=tuple(dict.fromkeys(chain.from_iterable(asked))))
            yield Step(StepKind.PART, part.since, part, lines[0], tuple(lines[1 : 1 + _MOST_LINES]))
            break


def _children(program: Program, predicate: str) -> dict[str, str]:
    """The predicates that the rules of one ask for, by their names without classes."""
    rules = (rule for rule in program.rules if rule.predicate == predicate)
    steps = (step for rule in rules for step in all_instructions(rule.body) if isinstance(step, Child))
    return {step.predicate.rpartition(".")[2]: step.predicate for step in steps}


def _lasting(
    program: Program, predicate: str, root: Path, taken: Container[Branch] | None
) -> tuple[list[SourcePlace], list[str]]:
    """The lines of the rules that say how long a token lasts, and its own parameters that these read.

    Of those under a condition only such as have held in all tokens of the mission.
    """
    lines: dict[SourcePlace, None] = {}
    read: dict[str, None] = {}
    names = next(([one.name for one in each.parameters] for each in program.predicates if each.name == predicate), [])
    for rule in (one for one in program.rules if one.predicate == predicate):
        reached: set[Operand] = {TokenVariable(0, DURATION)}
        placed = branched_instructions(rule.body)
        posts = [one for one, within in placed if isinstance(one, Post) and _was_taken(within, taken)]
        while new := [one for one in posts if reached & set(one.operands)]:
            posts = [one for one in posts if one not in new]
            for operand in (one for post in new for one in post.operands):
                match operand:
                    case LocalVariable():
                        reached.add(operand)
                    case TokenVariable(token=0, variable=at) if 0 <= at - FIRST_PARAMETER < len(names):
                        read[names[at - FIRST_PARAMETER]] = None
                    case _:
                        pass
            places = (line_of(one.span) for one in new)
            lines |= {replace(one, file=relative_name(one.file, root), column=1): None for one in places}
    return list(lines), list(read)


def _was_taken(within: Iterable[tuple[Guard, bool]], taken: Container[Branch] | None) -> bool:
    """Whether a mission took the branches in which a line stands, and never the others."""
    return all(
        taken is not None
        and branch_of(guard.span, branch_name(is_else)) in taken
        and branch_of(guard.span, branch_name(not is_else)) not in taken
        for guard, is_else in within
    )
