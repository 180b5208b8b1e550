"""A line of a model in, the conditions out under which it stands, and where the object is made that it is about.

A conflict names lines of the branches that were taken, and of constructors; that these were taken, or called with such
numbers, is often what is wrong.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from checker.influence import line_of
from checker.named_objects import made_as
from checker.names import relative_name
from compiler.instructions import branched_instructions
from compiler.program import Guard, Program
from runtime.executive.outcome import ConflictElement, ElementKind, SourcePlace

_Lines = dict[tuple[str, int, int], "tuple[Standing, ...]"]


@dataclass(frozen=True, slots=True)
class Standing:
    """A condition, at its line, and whether what stands there is its `else`."""

    place: SourcePlace
    is_else: bool


class StandingLines:
    """The conditions of a mission's models by the places that stand under them; `root` is the mission's folder."""

    def __init__(self, programs: Mapping[str, Program], root: Path) -> None:
        self.programs = programs
        self.root = root
        self._lines: dict[str, _Lines] = {}

    def of(self, element: ConflictElement) -> tuple[Standing, ...]:
        """The conditions under which the line of an element stands, the outermost first."""
        reactor = next((one.reactor for one in element.variables if one.reactor in self.programs), "")
        if element.place is None or not reactor:
            return ()
        if reactor not in self._lines:
            self._lines[reactor] = dict(self._standing(self.programs[reactor]))
        place = element.place
        return self._lines[reactor].get((place.file, place.line, place.column), ())

    def made(self, element: ConflictElement) -> SourcePlace | None:
        """The line that makes the object of which an element says what a member is; None for other elements."""
        if element.kind is not ElementKind.ASSIGNMENT or len(element.variables) != 1:
            return None
        (variable,) = element.variables
        program = self.programs.get(variable.reactor)
        name = variable.name.rpartition(".")[0]
        if variable.token is not None or not name or program is None:
            return None
        made = made_as(program, name)
        return None if made is None else self._placed(line_of(made.span))

    def _standing(self, program: Program) -> Iterator[tuple[tuple[str, int, int], tuple[Standing, ...]]]:
        for rule in program.rules:
            for instruction, branches in branched_instructions(rule.body):
                if branches and (span := getattr(instruction, "span", None)) is not None:
                    file = relative_name(span.source.name, self.root)
                    yield (file, span.line, span.column), tuple(self._standing_in(*one) for one in branches)

    def _standing_in(self, guard: Guard, is_else: bool) -> Standing:
        return Standing(self._placed(line_of(guard.span)), is_else)

    def _placed(self, place: SourcePlace) -> SourcePlace:
        """A place as the story names it: relative to the mission's folder."""
        return replace(place, file=relative_name(place.file, self.root))
