"""All instructions of a body, those of its branches and loops included."""

from collections.abc import Iterable, Iterator

from compiler.program import Guard, Instruction, ObjectLoop


def all_instructions(body: Iterable[Instruction]) -> Iterator[Instruction]:
    """Each instruction in the order of the text, a branch or loop before what is in it."""
    for each in body:
        yield each
        if isinstance(each, Guard):
            yield from all_instructions(each.then)
            yield from all_instructions(each.otherwise)
        elif isinstance(each, ObjectLoop):
            yield from all_instructions(each.body)


Branch = tuple[Guard, bool]  # a guard, and whether it is its `else` that is meant


def branched_instructions(
    body: Iterable[Instruction], within: tuple[Branch, ...] = ()
) -> Iterator[tuple[Instruction, tuple[Branch, ...]]]:
    """The same, each with the branches in which it stands, the outermost first."""
    for each in body:
        yield each, within
        if isinstance(each, Guard):
            yield from branched_instructions(each.then, (*within, (each, False)))
            yield from branched_instructions(each.otherwise, (*within, (each, True)))
        elif isinstance(each, ObjectLoop):
            yield from branched_instructions(each.body, within)
