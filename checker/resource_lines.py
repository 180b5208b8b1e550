"""A resource that might be used too much in, the steps of the story out: by which lines, and how much there is of it.

For each token that may use it the line of its rule that says how much, and the numbers that this line reads; for the
resource the line that makes it, with the numbers of that.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from checker.influence import line_of
from checker.names import relative_name
from checker.requested import lines_of_argument
from checker.single_values import numbers_of
from checker.steps import Step, StepKind
from compiler.instructions import all_instructions
from compiler.program import Assign, Child, GlobalVariable, NewGlobal, NewObject, Operand, Post, Program
from nddl_lang.text.source import Span
from runtime.executive.outcome import Deadlock, LevelChange, SourcePlace
from runtime.plan.readout.open_levels import LevelUser

_MOST_USERS = 4
_QUANTITY = "quantity"  # of what is taken from a resource or given to it


def with_uses(deadlock: Deadlock, programs: Mapping[str, Program], root: Path) -> Iterator[Step]:
    """The step of what had no choice left; where that is a level, behind those of the tokens that use it."""
    flaw = deadlock.flaw
    owners = [each for each in programs.values() for one in _made(each) if flaw is not None and one.name == flaw.name]
    if flaw is None or flaw.level is None or not owners:
        yield Step(StepKind.TRIED, None, deadlock)
        return
    (program, *_) = owners
    for user in flaw.users[:_MOST_USERS]:
        places = _lines_of_event(program, user.rule, user.event, root)
        place = next(iter(places), None)
        yield Step(StepKind.LEVEL, None, user, place, tuple(_numbers_at(program, place, root)))
    made = next(one for one in _made(program) if one.name == flaw.name)
    read = [one for one in made.arguments if not isinstance(one, NewObject)]
    limits = tuple(dict.fromkeys(_placed(span, root) for span in _setting(program, read)))
    yield Step(StepKind.TRIED, None, deadlock, _placed(made.span, root), limits)


def lines_of_amount(change: LevelChange, programs: Mapping[str, Program], root: Path) -> tuple[SourcePlace, ...]:
    """The lines of a rule by which the level of a resource changes: those that say by how much, then the others."""
    program = programs.get(change.reactor)
    if program is None:
        return ()
    amount = abs(change.amount)
    found = (_lines_of_event(program, asker, event, root, amount) for asker, event in change.askers)
    return tuple(dict.fromkeys(place for places in found for place in places))


def _lines_of_event(
    program: Program, asker: str, event: str, root: Path, amount: float | None = None
) -> tuple[SourcePlace, ...]:
    """The lines of a predicate's rules that say how much of a resource an event is of, then those that ask for it.

    Where the `amount` is known, none that says another one.
    """
    rules = (rule for rule in program.rules if rule.predicate == asker)
    steps = (step for rule in rules for step in all_instructions(rule.body) if isinstance(step, Child))
    asking = [
        replace(one, file=relative_name(one.file, root))
        for one in (line_of(step.span) for step in steps if step.predicate == event)
    ]
    return tuple(dict.fromkeys((*lines_of_argument(program, asker, (event, _QUANTITY), root, amount), *asking)))


def _made(program: Program) -> Iterator[NewObject]:
    """The objects that a model's script makes."""
    for one in program.script:
        if isinstance(one, NewObject):
            yield one
        elif isinstance(one, Assign) and isinstance(one.value, NewObject):
            yield one.value


def _numbers_at(program: Program, place: SourcePlace | None, root: Path) -> Iterator[SourcePlace]:
    """The lines that set the numbers which a line of a rule reads."""
    posts = [one for rule in program.rules for one in all_instructions(rule.body) if isinstance(one, Post)]
    read = [
        operand for one in posts if place is not None and _placed(one.span, root) == place for operand in one.operands
    ]
    yield from dict.fromkeys(_placed(span, root) for span in _setting(program, read))


def _setting(program: Program, read: Iterable[Operand]) -> Iterator[Span]:
    """Where the numbers among some operands are set."""
    known = {operand for operand, _ in numbers_of(program)} & {one for one in read if isinstance(one, GlobalVariable)}
    for one in program.script:
        target = (
            GlobalVariable(one.index) if isinstance(one, NewGlobal) else one.target if isinstance(one, Assign) else None
        )
        if target in known and isinstance(one, NewGlobal | Assign) and one.domain is not None:
            yield one.span


def _placed(span: Span, root: Path) -> SourcePlace:
    place = line_of(span)
    return replace(place, file=relative_name(place.file, root))


def user_text(user: LevelUser) -> str:
    """What a token may do to a level."""
    way = f"take up to {user.amount:g} of" if user.is_taken else f"give up to {user.amount:g} to"
    return f"{user.token} may {way} `{user.resource}`"
