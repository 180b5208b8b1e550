"""Outlines: what the bodies of a program leave in their frames, read once per program for the recorder.

A body is read by its outline: which slots of a frame hold named locals and children, and which guards it reaches, in
the order of execution. A body with a loop fills slots anew; there the variables and children that its scope made count.
"""

from typing import NamedTuple

from compiler.program import Child, Guard, Instruction, NewVariable, ObjectLoop, Program, TypeCode
from runtime.executive.look_back import looked_back

SHAPE_INT, SHAPE_FLOAT, SHAPE_BOOL, SHAPE_SYMBOL, SHAPE_STRING, SHAPE_OBJECT = range(6)
_SHAPES = {
    "int": SHAPE_INT,
    "float": SHAPE_FLOAT,
    "bool": SHAPE_BOOL,
    "string": SHAPE_STRING,
    "object": SHAPE_OBJECT,
}


def _shape(type_: TypeCode) -> int:
    """The shape of the values of a type."""
    return _SHAPES.get(type_.kind, SHAPE_SYMBOL)


class Outline(NamedTuple):
    """What a body leaves in a frame: (slot, shape) of named locals, slots of children, the branches of its guards."""

    locals: tuple[tuple[int, int], ...]
    children: tuple[int, ...]
    guards: tuple[tuple["Outline", "Outline"], ...]
    has_loop: bool


LOOSE = Outline((), (), (), True)  # of what stands in or beside a loop


def _outline(body: tuple[Instruction, ...]) -> Outline:
    """The outline of a rule's body or of a branch."""
    named: list[tuple[int, int]] = []
    children: list[int] = []
    guards: list[tuple[Outline, Outline]] = []
    for step in body:
        match step:
            case NewVariable(name=str(), slot=slot, type=type_):
                named.append((slot, _shape(type_)))
            case Child(slot=slot):
                children.append(slot)
            case Guard(then=then, otherwise=otherwise):
                guards.append((_outline(then), _outline(otherwise)))
            case ObjectLoop():
                return LOOSE
            case _:
                pass
    return Outline(tuple(named), tuple(children), tuple(guards), False)


class Forms(NamedTuple):
    """What is the same for all tokens of a program: outlines of its rules, shapes of parameters, globals, members.

    `looked_back` are the predicates of which rules may ask for tokens that are over.
    """

    program: Program
    rules: tuple[Outline, ...]
    parameters: tuple[tuple[int, ...], ...]
    globals: tuple[int, ...]
    members: tuple[tuple[int, ...], ...]
    looked_back: tuple[int, ...]


_FORMS: dict[int, Forms] = {}


def forms_of(program: Program) -> Forms:
    """The forms of `program`, kept as long as the program is."""
    known = _FORMS.get(id(program))
    if known is None or known.program is not program:
        if len(_FORMS) > 64:
            _FORMS.clear()
        known = _FORMS[id(program)] = Forms(
            program,
            tuple(_outline(rule.body) for rule in program.rules),
            tuple(tuple(_shape(p.type) for p in code.parameters) for code in program.predicates),
            tuple(_shape(type_) for _, type_ in program.globals),
            tuple(tuple(_shape(m.type) for m in code.members) for code in program.classes),
            looked_back(program),
        )
    return known
