"""Hold what a solver's filters and handlers match against the models that are planned with it."""

from collections.abc import Iterable, Iterator, Sequence

from checker.codes import NO_MATCH
from checker.mission import Mission
from compiler.instructions import all_instructions
from compiler.program import TOKEN_TIMES, NewVariable, Program
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.nearest import nearest
from nddl_lang.text.source import Source
from runtime.solver.configuration.element import Attribute, respelt
from runtime.solver.configuration.read import written_matches

_OF_TOKENS = (*TOKEN_TIMES, "object", "state", "time")


def solver_misfits(
    mission: Mission, programs: dict[str, Program], configured: Iterable[tuple[str, Source]]
) -> Iterator[Diagnostic]:
    """Complain of what a solver's file matches and no model has that is planned with it."""
    for name, source in configured:
        planned = [programs[one.model] for one in mission.agent.reactors if one.solver == name]
        for match in written_matches(source):
            for field, attribute in match.items():
                known = _known(field, match, planned)
                if known and attribute.value not in known:
                    yield _complaint(attribute, field, known)


def _known(field: str, match: dict[str, Attribute], programs: Sequence[Program]) -> set[str]:
    """The names that a field may give; empty where any will do."""
    match field:
        case "class_name" | "parent_class":
            return {code.name for program in programs for code in program.classes}
        case "predicate" | "parent_predicate":
            return _predicates(programs)
        case "variable":
            predicate = match.get("predicate")
            wanted = predicate.value if predicate is not None else ""
            return _variables(wanted if wanted in _predicates(programs) else "", programs)
        case _:
            return set()


def _predicates(programs: Sequence[Program]) -> set[str]:
    """The names of predicates, with and without their class."""
    names = {code.name for program in programs for code in program.predicates}
    return names | {name.rpartition(".")[2] for name in names}


def _variables(wanted: str, programs: Sequence[Program]) -> set[str]:
    """The variables that a token of the wanted predicate may have; without one, any variable of a model."""
    names = set(_OF_TOKENS)
    for program in programs:
        names |= {
            parameter.name
            for code in program.predicates
            if wanted in ("", code.name, code.name.rpartition(".")[2])
            for parameter in code.parameters
        }
        steps = [step for rule in program.rules for step in all_instructions(rule.body)]
        names |= {step.name for step in (*steps, *program.script) if isinstance(step, NewVariable) and step.name}
        if not wanted:
            names |= {name for name, _ in program.globals}
            names |= {member.name for code in program.classes for member in code.members}
    return names


def _complaint(attribute: Attribute, field: str, known: set[str]) -> Diagnostic:
    name, close = attribute.value, nearest(attribute.value, sorted(known))
    advice = f"did you mean `{close}`?" if close is not None else None
    what = field.removesuffix("_name").removeprefix("parent_")
    complaint = NO_MATCH.at(attribute.span, what=what, name=name, help=advice)
    return respelt(complaint, name, close)
