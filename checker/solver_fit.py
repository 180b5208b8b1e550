"""Hold what a solver's filters and handlers match against the models that are planned with it."""

from collections.abc import Iterable, Iterator, Sequence

from checker.codes import NO_MATCH, RESOURCES_FIRST
from checker.mission import Mission
from checker.named_objects import resources_of
from compiler.instructions import all_instructions
from compiler.program import TOKEN_TIMES, NewVariable, Program
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.nearest import nearest
from nddl_lang.text.source import Source
from runtime.solver.configuration.element import Attribute, respelt
from runtime.solver.configuration.read import written_managers, written_matches

_OF_RESOURCES = "ResourceThreatManager"
_OF_TOKENS_FIRST = {"ThreatManager": "tokens have their places", "OpenConditionManager": "what tokens ask for is found"}
_OF_TOKENS = (*TOKEN_TIMES, "object", "state", "time")


def solver_misfits(
    mission: Mission, programs: dict[str, Program], configured: Iterable[tuple[str, Source]]
) -> Iterator[Diagnostic]:
    """Complain of what a solver's file matches and no model has that is planned with it, and of its order."""
    for name, source in configured:
        planned = [programs[one.model] for one in mission.agent.reactors if one.solver == name]
        if any(resources_of(program) for program in planned):
            yield from _resources_first(source)
        for match in written_matches(source):
            for field, attribute in match.items():
                known = _known(field, match, planned)
                if known and attribute.value not in known:
                    yield _complaint(attribute, field, known)


def _resources_first(source: Source) -> Iterator[Diagnostic]:
    """Complain of a manager of resources whose turn comes before tokens are found and have their places."""
    turns = [
        (min(handler.priority for handler in manager.handlers), place, manager.component, span)
        for place, (manager, span) in enumerate(written_managers(source))
        if manager.handlers
    ]
    ours = min((each for each in turns if each[2] == _OF_RESOURCES), default=None)
    if ours is None:
        return
    later = [name for at, place, name, _ in turns if name in _OF_TOKENS_FIRST and ours[:2] < (at, place)]
    if later:
        names = " and ".join(f"`{name}`" for name in later)
        what = " and ".join(_OF_TOKENS_FIRST[name] for name in later)
        advice = f"put it behind {names}; of equal priorities the first in the file counts first"
        yield RESOURCES_FIRST.at(ours[3], what=what, help=advice)


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
