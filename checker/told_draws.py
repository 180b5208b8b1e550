"""A failed mission in, the steps of its draws out: what was drawn, the lines that pass it on, where it shows."""

from collections.abc import Container, Iterable, Iterator, Sequence

from checker.influence import Branch, Influence, InfluenceLine
from checker.steps import Step, StepKind
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.events import heads_of, single_events
from runtime.executive.outcome import Conflict, Outcome, SourcePlace


def acting_lines(
    influence: Influence,
    outcome: Outcome,
    until: int,
    taken: Container[Branch] | None,
    conflicts: Sequence[Conflict],
) -> Influence:
    """Lines that a mission came to up to a tick, on branches that it took, and those of which its conflicts speak.

    Of branches that hang on an argument it is the last token of the rule that counts: that one is told. Where a draw
    acts through rules of which the conflicts speak, others by which it acts as well have no part in them.
    """
    begun = {predicate: index for index, tick, _, predicate in heads_of(outcome.events) if tick <= until}
    places = [one.place for conflict in conflicts for one in conflict.elements if one.place is not None]
    spoken = {(place.file, place.line) for place in places}

    def acts(line: InfluenceLine) -> bool:
        if _is_at(line.place, spoken):
            return True
        if line.predicate not in begun or (taken is not None and any(one not in taken for one in line.branches)):
            return False
        arguments = outcome.events[begun[line.predicate]].arguments if line.tests else ()
        return not any(test.fails(arguments) for test in line.tests)

    found = {name: tuple(line for line in lines if acts(line)) for name, lines in influence.items()}
    told = {name: {one.rule for one in lines if _is_at(one.place, spoken)} for name, lines in found.items()}
    return {
        name: tuple(one for one in lines if one.rule in (told[name] or {one.rule})) for name, lines in found.items()
    }


def _is_at(place: SourcePlace, lines: Container[tuple[str, int]]) -> bool:
    return (place.file, place.line) in lines


def shown_tokens(
    outcome: Outcome, influence: Influence, parameters: tuple[str, ...], until: int, conflicts: Sequence[Conflict]
) -> list[int]:
    """The last observations, up to a tick, of the tokens whose rules the draws act through.

    There a draw shows outside its reactor. Of one that a conflict speaks of it is that on its timeline.
    """
    seen = {one.observed for conflict in conflicts for one in conflict.elements if one.observed is not None}
    spoken = {predicate for predicate, _ in seen}
    last = {
        predicate: index
        for index, tick, timeline, predicate in heads_of(outcome.events)
        if tick <= until and (predicate not in spoken or (predicate, timeline) in seen)
    }
    wanted = dict.fromkeys(line.predicate for name in parameters for line in influence.get(name, ()))
    return [last[predicate] for predicate in wanted if predicate in last]


def draws_of(
    outcome: Outcome,
    agent: AgentConfiguration,
    influence: Influence,
    parameters: tuple[str, ...],
    until: int,
    conflicts: Sequence[Conflict],
) -> list[list[Step]]:
    """What was drawn, each with the lines that pass it on: that of which the conflicts speak, or the last up to a tick.

    Of what is drawn for anew the last one is told as well if what it acts on still holds then. A value that is in force
    since a tick may be read for the first time later: before that it has done nothing.
    """
    by_name = {parameter.name: parameter for parameter in agent.parameters}
    spoken = dict(drawn for conflict in conflicts for drawn in conflict.drawn)
    holding = {line: predicate for _, tick, line, predicate in heads_of(outcome.events) if tick <= until}
    read = {event.draw: event.tick for event in single_events(outcome.events) if event.draw is not None}
    found: list[list[Step]] = []
    for name in parameters:
        drawn = [one for one in outcome.draws if one.parameter == name and read.get(one, one.tick) <= until]
        told = [draw for draw in drawn if draw.value == spoken.get(name)][-1:] or drawn[-1:]
        lines = influence.get(name, ())
        place = lines[0].place if lines else _sampled_at(conflicts, name)
        is_redrawn = name in by_name and by_name[name].mode == "intra"
        if is_redrawn and any(line.predicate in holding.values() for line in lines):
            told = list(dict.fromkeys((*told, *drawn[-1:])))
        for draw in told:
            first = Step(StepKind.DRAW, draw.tick if is_redrawn else None, (draw, by_name.get(name)), place)
            found.append([first, *(Step(StepKind.LINE, None, line.rule, line.place) for line in lines[1:])])
    return found


def _sampled_at(conflicts: Sequence[Conflict], name: str) -> SourcePlace | None:
    """The line that samples a parameter, if a conflict knows it."""
    for element in (element for conflict in conflicts for element in conflict.elements):
        if any(term.name == "sampledParameter" and term.arguments[1] == name for term in element.terms):
            return element.place
    return None


def in_time(groups: Sequence[list[Step]], events: Iterable[Step], *, is_behind: bool = False) -> Iterator[Step]:
    """Groups of steps, as a draw with its lines, each before what came at its tick or later; or behind its own tick.

    What holds for good comes first.
    """
    left = sorted(dict.fromkeys(map(tuple, groups)), key=lambda one: -1 if one[0].tick is None else one[0].tick)
    for event in events:
        while left and event.tick is not None and (left[0][0].tick or 0) + is_behind <= event.tick:
            yield from left.pop(0)
        yield event
    for each in left:
        yield from each
