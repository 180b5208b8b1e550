"""A reactor of the second agent: it synchronises, plans, asks owners, and takes back what it asked for."""

from collections.abc import Callable
from dataclasses import dataclass, field

from tests.executive.second.description import Description, Part
from tests.executive.second.network import ContradictionError
from tests.executive.second.plan import Draw, Goal, Plan
from tests.executive.second.present import News, Now, PresentError, bound, completed, fold_in, repaired
from tests.executive.second.searching import Found, Search

Tell = Callable[..., None]
KEEPING, FORGETTING, PLANLESS = "keeping the past", "forgetting the past", "no plan"


@dataclass(eq=False, slots=True)
class Request:
    """What was asked of an owner, and the own token that it stands for."""

    goal: Goal
    token: int | None
    refused: bool = False
    is_kept: bool = True  # in a repair: who needs it has begun


@dataclass(slots=True)
class Owner:
    """What a user knows of the owner of a timeline."""

    latency: int  # of execution
    lookahead: int


@dataclass(slots=True)
class Reactor:
    """One reactor in flight."""

    description: Description
    part: Part
    latency: int  # of execution
    owners: dict[str, Owner]
    tell: Tell
    draw: Draw
    number: Callable[[], int]
    plan: Plan = field(init=False)
    found: Plan | None = None  # the plan whose decisions are being made, and what it makes of goals
    states: dict[Goal, str] = field(default_factory=dict)
    left: int = 0  # steps until it is made
    steps: int = 0  # since there was work
    asked: list[tuple[str, Goal]] = field(default_factory=list)  # or recalled, and not taken in
    order: int = 0
    needed: dict[Goal, list[Goal]] = field(default_factory=dict)  # of what runs: what was asked of owners for it
    goals: list[Goal] = field(default_factory=list)
    requests: list[Request] = field(default_factory=list)
    lasting: dict[str, int] = field(default_factory=dict)  # what has gone on against a command
    tick: int = 0

    def __post_init__(self) -> None:
        self.plan = Plan(self.description, self.part, self.draw)
        for first in self.part.firsts:
            here = self.plan.new(first.timeline, first.predicate)
            self.plan.net.within(self.plan.tokens[here].start, 0, 0)
            for name, value in first.arguments:
                self.plan.net.within(self.plan.tokens[here].arguments[name], value, value)
            self.plan.insert(here, 0)

    @property
    def simulates(self) -> bool:
        """It looks one tick ahead at most."""
        return self.part.lookahead <= 1

    # The present

    def synchronise(self, tick: int, news: dict[str, News]) -> list[News]:
        """Settle the present; what own timelines begin to hold."""
        self.tick = tick
        for request in self.requests:
            request.refused = request.refused and request.goal.state != "begun"
        before, first = self.plan, None
        tokens, states = [one.token for one in self.requests], [one.state for one in self.goals]
        self.needed = {goal: self._needs(before, goal) for goal in self.goals if goal.state == "begun"}
        attempts = (("", True), (KEEPING, True), (KEEPING, False), (FORGETTING, True), (FORGETTING, False))
        told = ""
        for stage, binds in attempts:
            for request, token in zip(self.requests, tokens, strict=True):
                request.token = token
            for goal, state in zip(self.goals, states, strict=True):
                goal.state = state
            try:
                plan = before.copy()
                plan.now = tick
                if stage:
                    if stage != told:
                        self.tell("relax", self.part.name, stage=stage)
                    told = stage
                    plan = self._relax(before, stage == FORGETTING, binds)
                plan.settle()
                asked = {one.goal: one.token for one in self.requests if one.token is not None}
                now = Now(tick, self.description.final, news, asked)
                plan = self._settled(plan, now, places=bool(stage))
            except (PresentError, ContradictionError) as failure:
                if first is None:
                    first = self._coded(failure, before)
                    self._blame(before, news)
                continue
            found = self._committed(plan, tick, news)
            if not binds:
                self._bind()
            return found
        for request, token in zip(self.requests, tokens, strict=True):
            request.token = token
        assert first is not None
        raise first

    def _settled(self, plan: Plan, now: Now, places: bool) -> Plan:
        """The present, as the first way of taking in what is observed allows it."""
        first: PresentError | None = None
        try:
            for folded in fold_in(plan, now):
                found = None
                if places and self.simulates and now.tick < self.description.final:
                    found = self._searched(folded, now.tick)
                for placed in (found[0], folded) if found is not None else (folded,):
                    try:
                        settled = completed(placed, now)
                    except PresentError as failure:  # what a command needs may be what cannot be: that is given up last
                        first = first or failure
                        continue
                    if found is not None and placed is found[0]:
                        self._take_over(found[1], reports=False)
                    return settled
        except PresentError as failure:
            first = first or failure
        raise first or PresentError("F2")

    def _blame(self, plan: Plan, news: dict[str, News]) -> None:
        """Count failures of the present in which what a goal had asked for began; the second gives it up."""
        begun = [one for told in news.values() for one in told.answers]
        for goal in self.goals:
            if goal.state == "placed" and any(one in begun for one in self._needs(plan, goal)):
                goal.failures += 1

    def _needs(self, plan: Plan, goal: Goal) -> list[Goal]:
        """What was asked of owners for a goal."""
        found = []
        for request in self.requests:
            if request.token is None:
                continue
            agenda = [one.number for one in plan.tokens if plan.stands_for(one.number) == request.token]
            while agenda:
                here = agenda.pop()
                if goal in plan.goals_of[plan.stands_for(here)]:
                    found.append(request.goal)
                    break
                parent = plan.tokens[here].parent
                agenda += [] if parent is None else [parent]
        return found

    def _coded(self, failure: Exception, plan: Plan) -> PresentError:
        if not isinstance(failure, PresentError):
            return PresentError("F3")
        if failure.code == "F1" and failure.missed is not None:
            token = plan.tokens[failure.missed] if failure.missed < len(plan.tokens) else None
            if any(one.refused and token is not None and one.token == token.number for one in self.requests):
                return PresentError("F6", failure.timeline, failure.missed)
        return failure

    def _bind(self) -> None:
        """Hold what runs to what a goal asked of it, where all of that can still be; else who asked is told."""
        for here in self.plan.current.values():
            for goal in self.plan.goals_of[here]:
                if goal not in self.goals or goal.is_late:
                    continue
                trial = self.plan.copy()
                try:
                    bound(trial, here, goal)
                    self.plan = trial
                except ContradictionError:
                    goal.is_late = True
                    self.tell("reject", self.part.name, goal.timeline, goal.predicate, goal.arguments, goal.number)

    def _relax(self, plan: Plan, forgets: bool, binds: bool = True) -> Plan:
        asked = [goal for goal in self.goals if binds and not goal.is_late]
        relaxed, moved = repaired(plan, forgets, asked)
        self.lasting = {timeline: moved[one] for timeline, one in self.lasting.items() if one in moved}
        for request in self.requests:
            token = request.token
            parents = [one.parent for one in plan.tokens if plan.stands_for(one.number) == token]
            if token is not None and plan.state[token] == "active":  # it is who asked first that counts
                parents = [plan.tokens[token].parent]
            request.is_kept = any(parent in moved for parent in parents)
            request.token = None if request.token is None else moved.get(request.token)
        for goal in self.goals:
            if goal.state in ("placed", "rejected") and goal.start[1] >= self.tick:
                goal.state = "open"
                if goal.failures >= 2:
                    self._reject(goal)
        relaxed.now = self.tick
        return relaxed

    def _committed(self, plan: Plan, tick: int, news: dict[str, News]) -> list[News]:
        self.plan = plan
        found, is_over = [], False
        for timeline in self.part.internal:
            here = plan.current[timeline]
            if plan.window(here)[0] != tick:
                continue
            for goal in self.goals:
                if goal.timeline == timeline and goal.state == "begun":
                    old = next(one for one in plan.sequence[timeline] if goal in plan.goals_of[one])
                    length = tick - plan.window(old)[0]
                    is_timely = goal.end[0] <= tick <= goal.end[1] and goal.duration[0] <= length <= goal.duration[1]
                    is_cut = self._is_cut_off(goal, news) or not (goal.is_late or is_timely)
                    goal.state, is_over = "cut" if is_cut else "over", True
                    if is_cut or not goal.is_late:
                        what = (goal.timeline, goal.predicate, goal.arguments, goal.number)
                        self.tell("reject" if is_cut else "achieved", self.part.name, *what)
            for goal in plan.goals_of[here]:
                goal.state = "begun"
            token = plan.tokens[here]
            arguments = {name: value for name, value in plan.values(here).items() if value is not None}
            assert len(arguments) == len(token.arguments), "an argument is not determined"
            found.append(News(timeline, token.predicate, arguments, plan.goals_of[here]))
        for goal in self.goals:
            if goal.state in ("open", "placed") and goal.start[1] <= tick:
                self._reject(goal)
            elif goal.state == "open":
                goal.is_told = False  # that it comes back and is rejected again is told anew
        if is_over:
            self._reopen()
        return found

    def _reopen(self) -> None:
        """What was rejected may have room now that something else has left the plan."""
        for goal in self.goals:
            if goal.state == "rejected" and goal.start[1] > self.tick and goal.failures < 2:
                goal.state = "open"

    def _is_cut_off(self, goal: Goal, news: dict[str, News]) -> bool:
        """Whether an owner has given up what a goal needs, or has failed while it did it."""
        for request in self.requests:
            told = news.get(request.goal.timeline)
            if request.refused or (told is not None and told.predicate == "Failed"):
                if request.goal in self.needed[goal]:
                    return True
        return False

    def _reject(self, goal: Goal) -> None:
        goal.state = "rejected"
        if goal.is_told:
            return
        goal.is_told = True
        self.tell("reject", self.part.name, goal.timeline, goal.predicate, goal.arguments, goal.number)

    # The future

    def accept(self, goal: Goal) -> str:
        """Take in what somebody asks for; why it is refused, if it is."""
        kind = self.description.kind(goal.timeline)
        names = kind.parameters(goal.predicate)
        if self.part.lookahead == 0:
            return "no lookahead"
        if names is None or (goal.timeline, goal.predicate) in self.part.lacks:
            return "no such predicate"
        for timeline, predicate, name, low, high in self.part.ranges:
            if (timeline, predicate) == (goal.timeline, goal.predicate):
                if not low <= goal.arguments.get(name, low) <= high:
                    return "an argument does not fit"
        if goal.start[1] <= self.tick:
            return "too late"
        self.order += 1
        goal.state, goal.order = "open", self.order
        self.asked.append(("ask", goal))
        return ""

    def take_back(self, goal: Goal) -> None:
        """A goal is recalled: what has begun goes on."""
        if goal in self.goals:
            self.goals.remove(goal)
        if goal.state == "begun":
            self.plan = self.plan.copy()
            self.plan.net = self.plan.net.without({goal.speaker})
        if goal.state == "placed":
            plan = self.plan
            here = next(one.number for one in plan.tokens if one.goal is goal and plan.state[one.number] != "dropped")
            gone = {here} if plan.state[here] == "merged" else plan.descendants(here)
            self.plan = self.plan.removed(gone)
            for request in self.requests:
                request.token = None if request.token in gone else request.token
            self._reopen()
        goal.state = "gone"

    def _present_again(self, plan: Plan) -> Plan:
        for here in plan.current.values():
            plan.net.least(plan.tokens[here].end, self.tick + 1)
        return plan

    @property
    def horizon(self) -> int:
        """Up to where it plans."""
        return min(self.tick + self.latency + max(1, self.part.lookahead), self.description.final)

    def step(self, cost: int) -> bool:
        """Take in what was asked and plan, or make one decision of that plan; whether there is more to do.

        Each decision takes `cost` steps, and so does a goal that is tried in vain; who looks one tick ahead makes all
        its decisions in one.
        """
        if self.found is None:
            for what, goal in self.asked:
                if what == "recall":
                    self.take_back(goal)
            self.goals += [goal for what, goal in self.asked if what == "ask" and goal.state == "open"]
            self.asked = []
            self.found, self.states = self._planned()
            vain = sum(state == "rejected" and goal.state != state for goal, state in self.states.items())
            self.left = 0 if self.simulates else cost * (self.found.decisions - self.plan.decisions + vain)
        if self.left > 0:
            self.left -= 1
            self.steps += 1
            return True
        self.plan, self.found, self.steps = self.found, None, 0
        self._take_over(self.states)
        return bool(self.asked)

    def urgency(self) -> float:
        """How soon it should be given a step."""
        return 1.0 / ((self.part.latency + 2) * (self.steps + 1))

    def _planned(self) -> Found:
        """A plan of what is open; PresentError if something has no place that cannot be given up."""
        found = self._searched(self.plan, self.tick + 1)
        if found is None:
            self.tell("relax", self.part.name, stage=PLANLESS)
            self.plan = self._present_again(self._relax(self.plan, False))
            found = self._searched(self.plan, self.tick + 1)
            if found is None:
                raise PresentError("F4")
        return found

    def _take_over(self, states: dict[Goal, str], reports: bool = True) -> None:
        for goal, state in states.items():
            if goal.state == "gone":
                continue
            goal.state = state
            if state == "placed":
                goal.is_told = False
            elif reports:
                self._reject(goal)

    def _searched(self, plan: Plan, earliest: int) -> Found | None:
        search = Search(self.part, self.tick, earliest, self.horizon, self.description.final)
        return search.found(plan, [goal for goal in self.goals if goal.state == "open"])
