"""The models of a mission in, warnings out: one timeline that its owner makes with other numbers than a user of it.

The lengths and limits of a timeline stand in each model that makes it, and nothing keeps them the same.
"""

from collections.abc import Iterator, Mapping

from checker.codes import OTHER_NUMBER
from checker.mission import Mission
from checker.named_objects import made_as
from checker.single_values import numbers_of, single_value
from compiler.program import Constant, NewObject, Program
from nddl_lang.text.diagnostic import Diagnostic, Note
from nddl_lang.text.source import Span

_HELP = "give both models the same number, or let both include the file that says it"


def shared_misfits(mission: Mission, programs: Mapping[str, Program]) -> Iterator[Diagnostic]:
    """Complain of each timeline whose owner and user make objects of one class with other numbers."""
    owners = {timeline: one for one in mission.agent.reactors for timeline in one.internal}
    told: set[tuple[str, str]] = set()
    for reactor in mission.agent.reactors:
        for timeline in reactor.external:
            owner = owners.get(timeline)
            if owner is None or (place := (reactor.model, timeline)) in told:
                continue
            told.add(place)
            mine, theirs = (made_as(programs[one.model], timeline) for one in (reactor, owner))
            if mine is None or theirs is None or _place(mine.span) == _place(theirs.span):
                continue
            here, there = (_numbers(programs[one.model], made) for one, made in ((reactor, mine), (owner, theirs)))
            differing = [at for at in here.keys() & there.keys() if here[at] != there[at]]
            if mine.class_name == theirs.class_name and differing:
                yield OTHER_NUMBER.at(
                    mine.span,
                    timeline=timeline,
                    mine=", ".join(f"{here[at]:g}" for at in sorted(differing)),
                    owner=owner.name,
                    theirs=", ".join(f"{there[at]:g}" for at in sorted(differing)),
                    help=_HELP,
                    notes=(Note("made here by its owner", theirs.span),),
                )


def _numbers(program: Program, made: NewObject) -> dict[int, float]:
    """The numbers that an object is made of, by their places."""
    known = dict(numbers_of(program))
    found: dict[int, float] = {}
    for at, one in enumerate(made.arguments):
        value = None
        if not isinstance(one, NewObject):
            value = single_value(one.domain) if isinstance(one, Constant) else known.get(one)
        if isinstance(value, int | float) and not isinstance(value, bool):
            found[at] = float(value)
    return found


def _place(span: Span) -> tuple[str, int]:
    return span.source.name, span.begin
