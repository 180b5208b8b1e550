"""Lines of the models: from a source place to the instructions that are written there."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from checker.names import relative_name
from checker.proofs.operands import BodyLayout, ProgramNames, layout_of, names_of
from compiler.instructions import all_instructions
from compiler.program import Instruction, Program
from nddl_lang.semantics.constraints import CONSTRAINTS
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.outcome import SourcePlace
from runtime.user.constraint import Constraint
from runtime.user.library import load_library
from runtime.user.limit import USUAL

_Place = tuple[str, int, int, str]


@dataclass(frozen=True, eq=False, slots=True)
class WrittenLine:
    """An instruction, the body it stands in, and the program."""

    instruction: Instruction
    layout: BodyLayout
    names: ProgramNames
    predicates: frozenset[str]  # on whose tokens it acts; empty: it is of the script


def text_of(agent: AgentConfiguration, programs: Mapping[str, Program]) -> "ModelText":
    """The lines of an agent's models; `programs` by model path as the mission file has it."""
    known = {each.name: programs[each.model] for each in agent.reactors if each.model in programs}
    return ModelText(known, Path(agent.root), agent.constraints, agent.constraint_seconds)


class ModelText:
    """The programs of a mission's reactors, by the places of their lines; `root` is the mission's folder.

    `modules` are the files with constraints in Python, of which a call may take so many `seconds`.
    """

    def __init__(
        self, programs: Mapping[str, Program], root: Path, modules: tuple[str, ...] = (), seconds: float = USUAL
    ) -> None:
        self.programs = programs
        self.root = root
        self.modules = modules
        self.seconds = seconds
        self._constraints: dict[str, Constraint] | None = None
        self._lines: dict[str, dict[_Place, list[WrittenLine]]] = {}
        self._files: dict[str, str] = {}

    def at(self, reactor: str, place: SourcePlace, predicate: str) -> Iterator[WrittenLine]:
        """What is written at a place of a reactor's model and acts on tokens of `predicate`; empty: in the script."""
        program = self.programs.get(reactor)
        if program is None:
            return
        known = self._lines.get(reactor)
        if known is None:
            known = self._lines[reactor] = self._index(program)
        for each in known.get((place.file, place.line, place.column, place.text), ()):
            if predicate in each.predicates if predicate else not each.predicates:
                yield each

    def constraint(self, name: str) -> Constraint | None:
        """The constraint in Python that has a name; raises UserCodeError where its module cannot be loaded."""
        if name in CONSTRAINTS:
            return None
        if self._constraints is None:
            library = load_library(self.root, self.modules, seconds=self.seconds)
            self._constraints = {each.name: each for each in library.constraints}
        return self._constraints.get(name)

    def _index(self, program: Program) -> dict[_Place, list[WrittenLine]]:
        names = names_of(program)
        found: dict[_Place, list[WrittenLine]] = {}
        for number, rule in enumerate(program.rules):
            acting = frozenset(code.name for code in program.predicates if number in code.rules)
            self._add(found, rule.body, layout_of(rule.body, rule.predicate), names, acting)
        for code in program.predicates:
            self._add(found, code.body, layout_of(code.body, code.name), names, frozenset((code.name,)))
        self._add(found, program.script, layout_of(program.script, None), names, frozenset())
        return found

    def _add(
        self,
        found: dict[_Place, list[WrittenLine]],
        body: Sequence[Instruction],
        layout: BodyLayout,
        names: ProgramNames,
        predicates: frozenset[str],
    ) -> None:
        for each in all_instructions(body):
            span = each.span
            line, column = span.source.locate(span.begin)
            key = (self._file(span.source.name), line, column, " ".join(span.text.split()))
            found.setdefault(key, []).append(WrittenLine(each, layout, names, predicates))

    def _file(self, name: str) -> str:
        """A file as outcomes name it."""
        known = self._files.get(name)
        if known is None:
            known = self._files[name] = relative_name(name, self.root)
        return known
