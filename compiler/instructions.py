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
