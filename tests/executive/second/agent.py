"""The second agent: a mission in, its events out, by the text of the specification and slowly."""

from dataclasses import dataclass, field
from typing import Any

from tests.executive.second.asking import dispatch
from tests.executive.second.description import FAR, Description, Part
from tests.executive.second.plan import Draw, Goal
from tests.executive.second.present import News, PresentError
from tests.executive.second.reactor import Owner, Reactor


@dataclass(slots=True)
class Flight:
    """A mission in the air."""

    description: Description
    draw: Draw
    events: list[dict[str, Any]] = field(default_factory=list)
    tick: int = 0
    numbers: int = 0
    ended: bool = False
    late: list[News] = field(default_factory=list)  # of who was killed while it planned
    cost: int = 1  # steps that a decision takes

    def tell(
        self,
        kind: str,
        reactor: str = "",
        timeline: str = "",
        predicate: str = "",
        arguments: dict[str, int] | None = None,
        request: int | None = None,
        **more: Any,
    ) -> None:
        """An event."""
        told = {"tick": self.tick, "kind": kind, "reactor": reactor, "timeline": timeline, "predicate": predicate}
        told |= {"arguments": dict(arguments or {}), **more}
        if request is not None:
            told["of"] = request
        self.events.append(told)

    def number(self) -> int:
        """The number of a request."""
        self.numbers += 1
        return self.numbers


def in_order(parts: tuple[Part, ...]) -> list[Part]:
    """Owners before users, otherwise as the file has them."""
    found: list[Part] = []

    def visit(part: Part) -> None:
        if part in found:
            return
        for timeline in (*part.external, *part.observed):
            visit(next(one for one in parts if timeline in one.internal))
        found.append(part)

    for part in parts:
        visit(part)
    return found


def execution_latency(part: Part, parts: tuple[Part, ...]) -> int:
    """Its own and the largest of those it depends on."""
    used = [one for one in parts if set(one.internal) & {*part.external, *part.observed}]
    return part.latency + max([execution_latency(one, parts) for one in used], default=0)


def fly(description: Description, draw: Draw, cost: int = 1) -> tuple[list[dict[str, Any]], int]:
    """The events of a mission, and how many places a planner could have chosen otherwise.

    A decision takes `cost` steps: the text says that a step is one decision, and not what all is one.
    """
    flight = Flight(description, draw, cost=cost)
    parts = description.parts
    owner_of = {timeline: part for part in parts for timeline in part.internal}
    owners = {timeline: Owner(execution_latency(part, parts), part.lookahead) for timeline, part in owner_of.items()}
    reactors = [
        Reactor(description, part, execution_latency(part, parts), owners, flight.tell, draw, flight.number)
        for part in in_order(parts)
    ]
    goals = _goals(description)
    dead: set[str] = set()
    for tick in range(description.final + 1):
        flight.tick = tick
        news: dict[str, News] = {one.timeline: one for one in flight.late}
        flight.late = []
        for reactor in reactors:
            if reactor.part.name in dead:
                continue
            seen = {name: news[name] for name in (*reactor.part.external, *reactor.part.observed) if name in news}
            try:
                published = reactor.synchronise(tick, seen)
            except PresentError as failure:
                published = _failed(flight, reactor, failure, reactors, dead, owner_of)
                if flight.ended:
                    return flight.events, _choices(reactors)
            _note_refused(reactors, "cut")  # who asked for it may be over now, too
            for one in published:
                if one.predicate != "Failed":
                    flight.tell("observation", reactor.part.name, one.timeline, one.predicate, one.arguments)
                news[one.timeline] = one
        if len(dead) == len(reactors):
            flight.tell("end")
            return flight.events, _choices(reactors)
        _post(flight, goals, reactors, owner_of, dead)
        if tick < description.final:
            _deliberate(flight, reactors, owner_of, dead)
        if flight.ended:
            return flight.events, _choices(reactors)
    flight.tell("end")
    return flight.events, _choices(reactors)


def _choices(reactors: list[Reactor]) -> int:
    return sum(reactor.plan.choices for reactor in reactors)


def _goals(description: Description) -> list[tuple[int, Goal]]:
    found = []
    for place, wish in enumerate(description.wishes):
        goal = Goal(
            -1 - place, wish.timeline, wish.predicate, dict(wish.arguments), wish.start, (-FAR, FAR),
            wish.duration or (1, FAR), recall=wish.recall,
        )  # fmt: skip
        found.append((wish.at, goal))
    return found


def _post(
    flight: Flight, goals: list[tuple[int, Goal]], reactors: list[Reactor], owner_of: dict[str, Part], dead: set[str]
) -> None:
    for at, goal in goals:
        if at == flight.tick and owner_of[goal.timeline].name not in dead:
            flight.tell("request", "", goal.timeline, goal.predicate, goal.arguments, goal.number)
            _deliver(flight, goal, reactors, owner_of, dead)
        if goal.recall == flight.tick and goal.state != "waiting":
            flight.tell("recall", "", goal.timeline, goal.predicate, goal.arguments, goal.number)
            _take_back(goal, reactors, owner_of, dead, [])


def _reactor(reactors: list[Reactor], part: Part) -> Reactor:
    return next(one for one in reactors if one.part is part)


def _deliver(flight: Flight, goal: Goal, reactors: list[Reactor], owner_of: dict[str, Part], dead: set[str]) -> bool:
    owner = _reactor(reactors, owner_of[goal.timeline])
    why = "killed" if owner.part.name in dead else owner.accept(goal)
    if why:
        goal.state = "refused"
        told = "" if owner.part.name in dead else owner.part.name
        flight.tell("refuse", told, goal.timeline, goal.predicate, goal.arguments, goal.number)
    return not why


def _deliberate(flight: Flight, reactors: list[Reactor], owner_of: dict[str, Part], dead: set[str]) -> None:
    """Whoever is most urgent makes a step; who is done tells owners, who are busy then."""
    busy = [one for one in reactors if one.part.name not in dead]
    for reactor in busy:
        reactor.steps = 0
    while busy:
        reactor = max(busy, key=lambda one: (one.urgency(), -reactors.index(one)))
        try:
            if reactor.step(flight.cost):
                continue
        except PresentError as failure:
            busy.remove(reactor)
            flight.late += _failed(flight, reactor, failure, reactors, dead, owner_of)
            if flight.ended:
                return
            busy += [one for one in reactors if one.asked and one not in busy and one.part.name not in dead]
            continue
        busy.remove(reactor)
        _note_refused(reactors, "rejected", "cut")
        lost, asks = dispatch(reactor)
        for request in lost:
            goal = request.goal
            flight.tell("recall", reactor.part.name, goal.timeline, goal.predicate, goal.arguments, goal.number)
            _take_back(goal, reactors, owner_of, dead, busy)
        for request in asks:
            goal = request.goal
            flight.tell(
                "request", reactor.part.name, goal.timeline, goal.predicate, goal.arguments, goal.number,
                start=list(goal.start),
            )  # fmt: skip
            request.refused = not _deliver(flight, goal, reactors, owner_of, dead)
            owner = _reactor(reactors, owner_of[goal.timeline])
            if not request.refused:
                busy += [owner] * (owner not in busy)
    _note_refused(reactors, "rejected", "cut")


def _note_refused(reactors: list[Reactor], *states: str) -> None:
    for reactor in reactors:
        for request in reactor.requests:
            if request.goal.state in states:
                request.refused = True


def _take_back(
    goal: Goal, reactors: list[Reactor], owner_of: dict[str, Part], dead: set[str], busy: list[Reactor]
) -> None:
    owner = _reactor(reactors, owner_of[goal.timeline])
    if owner.part.name not in dead:
        owner.asked.append(("recall", goal))
        busy += [owner] * (owner not in busy)


def _failed(
    flight: Flight, reactor: Reactor, failure: PresentError, reactors: list[Reactor], dead: set[str],
    owner_of: dict[str, Part],
) -> list[News]:  # fmt: skip
    if not flight.description.kills:
        flight.tell("abort", reactor.part.name, code=failure.code)
        flight.ended = True
        return []
    dead.add(reactor.part.name)
    flight.tell("kill", reactor.part.name, code=failure.code)
    for request in reactor.requests:
        goal, owner = request.goal, _reactor(reactors, owner_of[request.goal.timeline])
        if goal.state not in ("over", "gone") and owner.part.name not in dead:
            flight.tell("recall", reactor.part.name, goal.timeline, goal.predicate, goal.arguments, goal.number)
            owner.asked.append(("recall", goal))
    for other in reactors:
        for request in other.requests:
            request.refused = request.refused or request.goal.timeline in reactor.part.internal
    for timeline in reactor.part.internal:
        flight.tell("observation", reactor.part.name, timeline, "Failed")
    return [News(timeline, "Failed", {}) for timeline in reactor.part.internal]
