"""The present of a plan: observations folded in, one current token on each own timeline; and what a repair leaves."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from tests.executive.second.description import FAR
from tests.executive.second.levels import is_possible
from tests.executive.second.network import NOBODY, ContradictionError
from tests.executive.second.plan import Goal, Plan


class PresentError(Exception):
    """The present cannot be synchronised."""

    def __init__(self, code: str, timeline: str = "", missed: int | None = None) -> None:
        super().__init__(code)
        self.code, self.timeline, self.missed = code, timeline, missed


@dataclass(frozen=True, slots=True)
class News:
    """What a timeline begins to hold; the goals that its owner meets by that."""

    timeline: str
    predicate: str
    arguments: dict[str, int]
    answers: tuple[Goal, ...] = ()


@dataclass(slots=True)
class Now:
    """What a reactor sees at a tick."""

    tick: int
    final: int
    news: dict[str, News]
    asked: dict[Goal, int] = field(default_factory=dict)  # own requests, and the tokens that they stand for


def bound(plan: Plan, number: int, goal: Goal) -> None:
    """Hold a token to what was asked of its end and length."""
    plan.net.speaker = goal.speaker
    plan.net.within(plan.tokens[number].end, *goal.end)
    plan.last(number, *goal.duration)
    plan.net.speaker = NOBODY


def repaired(plan: Plan, forgets: bool, asked: Sequence[Goal]) -> tuple[Plan, dict[int, int]]:
    """What has begun (and is not over, where it forgets), with its rules; where each token has gone.

    It is fact; what goals ask of its end and length is not, and is left out but for those in `asked`.
    """
    new = Plan(plan.description, plan.part, plan.draw, plan.now, choices=plan.choices)
    new.spent = plan.spent
    moved: dict[int, int] = {}
    begun = [one for one, state in enumerate(plan.state) if state == "begun"]
    current = plan.current.values()
    kept = [one for one in begun if not forgets or one in current or plan.looks_back(one)]
    for old in sorted(kept, key=lambda one: (plan.window(one)[0], one)):
        token = plan.tokens[old]
        here = new.new(token.timeline, token.predicate)
        moved[old] = here
        for name, value in plan.values(old).items():
            if value is not None:
                new.net.within(new.tokens[here].arguments[name], value, value)
        new.goals_of[here] = plan.goals_of[old]
        if old in plan.bare or (forgets and old not in current):
            new.bare |= {here}
        new.insert(here, len(new.sequence.get(token.timeline, [])))
        new.begin(here, plan.window(old)[0])
        if plan.current[token.timeline] != old:
            new.net.within(new.tokens[here].end, *plan.ends(old))
        for goal in plan.goals_of[old] if goal_binds(plan, old) else ():
            if goal in asked:
                bound(new, here, goal)
    if forgets:
        for one, use in plan.uses:
            if plan.state[one] == "begun" and one not in current and use.when != "all":
                new.spent += (
                    (use.store, use.amount, plan.window(one)[0] if use.when == "start" else plan.ends(one)[0]),
                )
    for (parent, label), child in plan.children.items():
        found = plan.stands_for(child)
        if forgets and plan.tokens[child].timeline not in plan.part.internal:
            continue  # what is observed stands by itself, what is over is found anew
        if parent in moved and found in moved and (moved[parent], label) in new.children:
            mine = new.children[moved[parent], label]
            if new.state[mine] == "open":
                new.merge(mine, moved[found])
    return new, moved


def goal_binds(plan: Plan, number: int) -> bool:
    """Whether it still runs, on an own timeline."""
    timeline = plan.tokens[number].timeline
    return timeline in plan.part.internal and plan.current[timeline] == number


def fold_in(plan: Plan, now: Now) -> Iterator[Plan]:
    """Plans with what is observed at this tick, the likeliest first."""
    tick, others = now.tick, (*plan.part.external, *plan.part.observed)
    for timeline in others:
        news, current = now.news.get(timeline), plan.current.get(timeline)
        if current is None:
            continue
        end = plan.tokens[current].end
        try:
            if news is None:
                plan.net.least(end, tick + 1)
            else:
                plan.net.within(end, tick, tick)
        except ContradictionError:
            if news is not None:
                raise PresentError("F8" if news.predicate == "Failed" else "F2", timeline) from None
            late = [one for one in plan.planned(timeline) if plan.window(one)[1] <= tick]
            raise PresentError("F1", timeline, late[0] if late else None) from None
    first: PresentError | None = None
    for folded in _observed(plan, [now.news[timeline] for timeline in others if timeline in now.news], now):
        try:
            yield _later(folded, others, tick)
        except PresentError as failure:
            first = first or failure
    if first is not None:
        raise first


def _later(plan: Plan, others: tuple[str, ...], tick: int) -> Plan:
    """What has not begun of others' timelines begins later."""
    for timeline in others:
        for one in plan.planned(timeline):
            try:
                plan.net.least(plan.tokens[one].start, tick + 1)
            except ContradictionError:
                raise PresentError("F1", timeline, one) from None
    return plan


def _observed(plan: Plan, news: list[News], now: Now) -> Iterator[Plan]:
    if not news:
        yield plan
        return
    for folded in observed(plan, news[0], now):
        yield from _observed(folded, news[1:], now)


def observed(plan: Plan, news: News, now: Now) -> Iterator[Plan]:
    """Plans with one observation: of what was planned there, or by itself."""
    fits = plan.description.kind(news.timeline).parameters(news.predicate) is not None
    fits = fits and (news.timeline, news.predicate) not in plan.part.lacks
    for timeline, predicate, name, low, high in plan.part.ranges:
        if (timeline, predicate) == (news.timeline, news.predicate) and not low <= news.arguments[name] <= high:
            fits = False
    predicate = news.predicate if fits else "undefined"
    arguments = news.arguments if fits else {}
    planned = [one for one in plan.planned(news.timeline) if plan.tokens[one].predicate == predicate]
    planned = [one for one in planned if plan.window(one)[0] <= now.tick <= plan.window(one)[1]]
    answered = [one for one in planned if any(now.asked.get(goal) == one for goal in news.answers)]
    for one in answered or planned:
        met = plan.copy()
        try:
            for name, value in arguments.items():
                met.net.within(met.tokens[one].arguments[name], value, value)
            met.begin(one, now.tick)
        except ContradictionError:
            continue
        if is_possible(met, waits=True):
            yield met
    if answered:
        return
    plan = plan.copy()
    here = plan.new(news.timeline, predicate)
    line = plan.sequence.get(news.timeline, [])
    try:
        for name, value in arguments.items():
            plan.net.within(plan.tokens[here].arguments[name], value, value)
        plan.net.within(plan.tokens[here].start, now.tick, now.tick)
        plan.insert(here, sum(plan.state[one] == "begun" for one in line))
        plan.begin(here, now.tick)
        if not is_possible(plan, waits=True):
            raise ContradictionError
    except ContradictionError:
        raise PresentError("F8" if news.predicate == "Failed" else "F2", news.timeline) from None
    yield plan


def completed(plan: Plan, now: Now) -> Plan:
    """The plan with a current token on each own timeline and nothing open of what holds now."""
    found = next(_each(plan, now, tuple(sorted(plan.part.internal, key=lambda one: _rank(plan, now, one)))), None)
    if found is None:
        raise PresentError("F3")
    return found


def _rank(plan: Plan, now: Now, timeline: str) -> tuple[int, int]:
    """Timelines are decided in the order of the asking where what comes next was asked for, then what is early."""
    planned = plan.planned(timeline)
    if not planned or not plan.window(planned[0])[0] <= now.tick <= plan.window(planned[0])[1]:
        return 2, 0
    return (0, planned[0]) if plan.goals_of[planned[0]] else (2 - (timeline in plan.part.early), 0)


def _each(plan: Plan, now: Now, timelines: tuple[str, ...]) -> Iterator[Plan]:
    if not timelines:
        yield from _flawless(plan, now)
        return
    for choice in _choices(plan, now, timelines[0]):
        if is_possible(choice, waits=True):
            yield from _each(choice, now, timelines[1:])


def _flawless(plan: Plan, now: Now) -> Iterator[Plan]:
    """Plans in which what must hold now is found among what does."""
    for one in plan.open():
        token = plan.tokens[one]
        left = token.timeline not in plan.part.internal and plan.window(one)[0] >= now.final
        if token.goal is None and not left and (plan.window(one)[1] <= now.tick or plan.ends(one)[1] <= now.tick):
            for target in plan.resolved(one, makes=False):
                yield from _flawless(target, now)
            return
    if is_possible(plan):
        yield plan


def _choices(plan: Plan, now: Now, timeline: str) -> Iterator[Plan]:
    tick = now.tick
    current = plan.current.get(timeline)
    names = [name for name, _ in plan.description.kind(timeline).predicates]
    nexts = list(_next(plan, now, timeline))
    asked = bool(nexts) and nexts[0][1]
    default = list(_new(plan, now, timeline, names[0]))
    extended: list[Plan] = []
    if current is not None:
        plan_on = plan.copy()
        try:
            plan_on.net.least(plan_on.tokens[current].end, tick + 1)
            extended = [plan_on]
        except ContradictionError:
            pass
    following = [one for one, _ in nexts]
    if asked or timeline in plan.part.early:
        yield from [*following, *extended]
        yield from default
    elif timeline in plan.part.late:
        yield from [*extended, *default, *following]
    else:
        yield from [*extended, *following, *default]
    for name in names[1:]:
        yield from _new(plan, now, timeline, name)


def _cut(plan: Plan, timeline: str, tick: int) -> Plan | None:
    """The plan whose current token there is over."""
    plan = plan.copy()
    current = plan.current.get(timeline)
    try:
        if current is not None:
            plan.net.within(plan.tokens[current].end, tick, tick)
            plan.settle()
    except ContradictionError:
        return None
    return plan


def _next(plan: Plan, now: Now, timeline: str) -> Iterator[tuple[Plan, bool]]:
    """What may begin next: what is planned first, else what must begin now; whether somebody asked for it."""
    cut = _cut(plan, timeline, now.tick)
    if cut is None:
        return
    planned = cut.planned(timeline)
    if planned:
        asked = bool(cut.goals_of[planned[0]])
        if not (asked and now.tick >= now.final):
            try:
                begun = cut.copy()
                begun.begin(planned[0], now.tick)
                yield begun, asked
            except ContradictionError:
                pass
    for one in cut.open():
        token = cut.tokens[one]
        if token.timeline != timeline or token.goal is not None or not cut.window(one)[1] <= now.tick <= FAR:
            continue
        if cut.window(one)[0] > now.tick or cut.ends(one)[1] <= now.tick:
            continue
        try:
            begun = cut.copy()
            begun.net.within(token.start, now.tick, now.tick)
            begun.insert(one, sum(begun.state[other] == "begun" for other in begun.sequence.get(timeline, [])))
            begun.begin(one, now.tick)
            yield begun, False
        except ContradictionError:
            pass


def _new(plan: Plan, now: Now, timeline: str, predicate: str) -> Iterator[Plan]:
    cut = _cut(plan, timeline, now.tick)
    if cut is None or (timeline, predicate) in plan.part.lacks:
        return
    here = cut.new(timeline, predicate)
    try:
        cut.net.within(cut.tokens[here].start, now.tick, now.tick)
        cut.insert(here, sum(cut.state[one] == "begun" for one in cut.sequence.get(timeline, [])))
        cut.begin(here, now.tick)
        yield cut
    except ContradictionError:
        pass
