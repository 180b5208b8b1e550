"""What a block looks up in the program: whose timeline a child is on, which values a domain allows."""

from compiler.determined.code import LARGEST, Line, RegisterLayout
from compiler.determined.reasons import FreeChoice, UndeterminedError
from compiler.program import Child, DomainConstant, GlobalVariable, PredicateCode, Program, TypeCode
from nddl_lang.semantics.relations import RELATIONS
from nddl_lang.text.source import Span


class ReactorModel:
    """A program and the timelines of one reactor."""

    def __init__(self, program: Program, lines: tuple[Line, ...]) -> None:
        self.program = program
        self.lines = lines
        self.classes = {each.name: each for each in program.classes}
        self.predicates = {each.name: each for each in program.predicates}
        self.numbers = {each.name: number for number, each in enumerate(program.predicates)}
        self.short_names = tuple(each.name.rpartition(".")[2] for each in program.predicates)
        self.line_numbers = {line.name: number for number, line in enumerate(lines)}

    def ancestors(self, class_name: str) -> list[str]:
        """A class and those that it extends."""
        found: list[str] = []
        name: str | None = class_name
        while name is not None and name in self.classes:
            found.append(name)
            name = self.classes[name].base
        return found

    def predicates_of(self, line: int) -> list[PredicateCode]:
        """All predicates that may hold on a timeline."""
        return [each for each in self.program.predicates if each.class_name == self.lines[line].class_name]

    def predicate(self, line: int, short: str) -> PredicateCode | None:
        """A predicate of a timeline by its short name."""
        return self.predicates.get(f"{self.lines[line].class_name}.{short}")

    def number(self, predicate: PredicateCode) -> int:
        """The number of a predicate in the program."""
        return self.numbers[predicate.name]

    def span_of(self, predicate: PredicateCode) -> Span:
        """Where a predicate is declared."""
        assert predicate.span is not None, "what is native has no parameters"
        return predicate.span

    def target(self, child: Child, own: int) -> tuple[int, PredicateCode]:
        """The timeline and predicate of a child."""
        owner, _, short = child.predicate.rpartition(".")
        match child.object:
            case "own":
                line = own
            case "any":
                fitting = [n for n, each in enumerate(self.lines) if owner in self.ancestors(each.class_name)]
                if not fitting:
                    raise UndeterminedError(FreeChoice.RESOURCE, child.predicate, child.span)
                if len(fitting) > 1:
                    raise UndeterminedError(FreeChoice.SEVERAL_OBJECTS, child.predicate, child.span)
                line = fitting[0]
            case GlobalVariable(index=index) if self.program.globals[index][0] in self.line_numbers:
                line = self.line_numbers[self.program.globals[index][0]]
            case _:
                raise UndeterminedError(FreeChoice.SEVERAL_OBJECTS, child.predicate, child.span)
        if self.lines[line].role == "other":
            raise UndeterminedError(FreeChoice.NO_TIMELINE, child.predicate, child.span)
        predicate = self.predicate(line, short)
        if predicate is None:
            raise UndeterminedError(FreeChoice.RESOURCE, child.predicate, child.span)
        return line, predicate

    def are_usual(self, child: Child) -> bool:
        """Whether the bounds written after a relation are those that it has anyway."""
        usual = tuple((each.lower, each.upper) for each in RELATIONS[child.relation].distances)
        return child.bounds == usual

    def may_stay_open(self, type_: TypeCode, given: DomainConstant | None) -> bool:
        """Whether no solver decides a variable that no constraint names: numbers without bounds."""
        return type_.kind in ("int", "float") and all(
            domain is None or (domain.interval is not None and all(abs(bound) >= LARGEST for bound in domain.interval))
            for domain in (type_.domain, given)
        )

    def member_kind(self, name: str, path: tuple[str, ...]) -> str | None:
        """The kind of a member of the object that a global variable names; None where that cannot be told."""
        types = dict(self.program.globals)
        if name not in types:
            return None
        kind, class_name = types[name].kind, types[name].type_name
        for part in path:
            members = {each.name: each.type for each in self.classes[class_name].members} if kind == "object" else {}
            if part not in members:
                return None
            kind, class_name = members[part].kind, members[part].type_name
        return kind


def values_of(domain: DomainConstant, layout: RegisterLayout) -> tuple[float, ...] | None:
    """The values of a domain as registers hold them; None where any value of its kind will do, or an interval."""
    if domain.interval is not None:
        return (float(domain.interval[0]),) if domain.interval[0] == domain.interval[1] else None
    values = domain.values or ()
    if domain.kind == "bool" and len(values) > 1:
        return None
    return tuple(float(layout.symbol(value)) if isinstance(value, str) else float(value) for value in values)
