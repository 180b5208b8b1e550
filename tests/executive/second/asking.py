"""What a reactor of the second agent asks of owners, what it takes back, and what holds a request back."""

from tests.executive.second.description import FAR
from tests.executive.second.plan import Goal
from tests.executive.second.reactor import Reactor, Request


def dispatch(reactor: Reactor) -> tuple[list[Request], list[Request]]:
    """What is taken back and what is asked for."""
    plan = reactor.plan
    wanted = {one.token for one in reactor.requests if one.token is not None}
    merged = {plan.stands_for(one) for one, state in enumerate(plan.state) if state == "merged"}
    for request in reactor.requests:
        here = plan.current.get(request.goal.timeline)
        if request.token is None and request.is_kept and request.goal.state == "begun" and here in merged:
            request.token = here  # what runs has found it again
    reactor.requests = [one for one in reactor.requests if not _is_over(reactor, one)]
    lost = _come_apart(reactor)
    while more := [one for one in reactor.requests if one not in lost and _is_lost(reactor, one, merged, lost)]:
        lost += more  # and what comes behind what is asked for anew
    for request in lost:
        wanted.discard(request.token)
    reactor.requests = [one for one in reactor.requests if one not in lost]  # that goes on by itself
    asks = []
    for timeline in reactor.part.external:
        for place, one in enumerate(plan.sequence.get(timeline, [])):
            if plan.state[one] != "active" or one in wanted:
                continue
            again = next((old for old in lost if old.token is None and _same(reactor, old, one)), None)
            if again is not None:
                again.token = one
                lost.remove(again)
                reactor.requests.append(again)
            elif _held(reactor, timeline, place, one):
                break
            else:
                request = Request(_goal(reactor, one), one)
                asks.append(request)
                wanted.add(one)
                reactor.requests.append(request)
    return lost, asks


def _is_over(reactor: Reactor, request: Request) -> bool:
    token, plan = request.token, reactor.plan
    return token is not None and plan.state[token] == "begun" and plan.ends(token)[1] <= reactor.tick


def _is_loose(reactor: Reactor, token: int, merged: set[int]) -> bool:
    return reactor.plan.tokens[token].parent is None and token not in merged


def _is_lost(reactor: Reactor, request: Request, merged: set[int], lost: list[Request]) -> bool:
    return request.token is None or _is_void(reactor, request, request.token, merged, lost)


def _is_void(reactor: Reactor, request: Request, token: int, merged: set[int], lost: list[Request]) -> bool:
    """Whether its token was cut loose, not met, overtaken, or given up by its owner and has more room now."""
    plan, goal = reactor.plan, request.goal
    if _is_loose(reactor, token, merged) or not request.is_kept:
        return True
    if plan.state[token] != "active":
        return False
    if goal.state in ("begun", "over"):
        return True
    asked = {one.token for one in reactor.requests if one not in lost}
    line = plan.planned(goal.timeline)
    if any(one not in asked for one in line[: line.index(token)]):
        return True
    if request.refused:
        now = _goal(reactor, token)
        pairs = ((now.start, goal.start), (now.end, goal.end), (now.duration, goal.duration))
        return any(one[0] < other[0] or one[1] > other[1] for one, other in pairs)
    return False


def _same(reactor: Reactor, request: Request, token: int) -> bool:
    goal, mine = request.goal, reactor.plan.tokens[token]
    low, high = reactor.plan.window(token)
    now = reactor.tick + 1  # as time goes on, a request bears later times by itself
    return (
        (goal.timeline, goal.predicate, goal.arguments) == (mine.timeline, mine.predicate, reactor.plan.values(token))
        and (max(goal.start[0], now), goal.start[1]) == (max(low, now), high)
        and request.is_kept
        and goal.state not in ("begun", "over")
    )


def _goal(reactor: Reactor, number: int) -> Goal:
    plan, token = reactor.plan, reactor.plan.tokens[number]
    arguments = {name: value for name, value in plan.values(number).items() if value is not None}
    assert len(arguments) == len(token.arguments), "an argument is not determined"
    start, end = plan.window(number), plan.ends(number)
    # The length is a number of its own (EUROPA): what only chains of other tokens say of it is not known.
    low, high = plan.net.low[token.length], plan.net.high[token.length]
    length = (max(low, end[0] - start[1]), min(high, end[1] - start[0]))
    if reactor.owners[token.timeline].lookahead <= 1:
        end, length = (-FAR, FAR), (1, FAR)
    return Goal(
        reactor.number(), token.timeline, token.predicate, arguments, start, end, length, sender=reactor.part.name
    )  # fmt: skip


def _held(reactor: Reactor, timeline: str, place: int, number: int) -> bool:
    plan, owner = reactor.plan, reactor.owners[timeline]
    token, net = plan.tokens[number], plan.net
    low = plan.window(number)[0]
    for other in plan.tokens:
        if plan.state[other.number] == "active" and other.timeline in reactor.part.internal:
            if other.timeline in reactor.part.early or plan.goals_of[other.number]:
                continue
            far = net.distance(token.start, other.start)
            if far <= 0:
                low = max(low, net.high[other.start] - far)
    low = max(low, _late_start(reactor, timeline, place))
    if low > reactor.tick + owner.latency + owner.lookahead or owner.lookahead == 0:
        return True
    if low >= reactor.description.final:
        return True
    return _is_blocked(reactor, timeline, place, number) or any(
        _is_blocked(reactor, *mate) if request is None else request.refused for mate, request in _mates(reactor, number)
    )


def _mates(reactor: Reactor, number: int) -> list[tuple[tuple[str, int, int], Request | None]]:
    """What is to begin on other timelines at its tick, which is still open: its timeline and place, and its request."""
    plan, found = reactor.plan, []
    for timeline in reactor.part.external:
        line = plan.sequence.get(timeline, [])
        for place, one in enumerate(line):
            if plan.state[one] != "active" or plan.tokens[number].timeline == timeline:
                continue
            start, then = plan.tokens[number].start, plan.tokens[one].start
            is_open = plan.window(number)[0] < plan.window(number)[1] and reactor.owners[timeline].lookahead > 0
            if is_open and plan.net.distance(start, then) == 0 == plan.net.distance(then, start):
                request = next((each for each in reactor.requests if each.token == one), None)
                found.append(((timeline, place, one), request))
    return found


def _come_apart(reactor: Reactor) -> list[Request]:
    """What waits for something that runs, when another, which is to begin with it, has begun without it."""
    plan, found = reactor.plan, []
    for request in reactor.requests:
        token = request.token
        if token is None or plan.state[token] != "active" or request.goal.state not in ("begun", "over"):
            continue
        for (timeline, place, _), mate in _mates(reactor, token):
            here = plan.current.get(timeline)
            if mate is None or here is None or mate.goal.state == "begun" or mate.goal.start[0] > reactor.tick:
                continue
            is_default = plan.tokens[here].predicate == reactor.description.kind(timeline).predicates[0][0]
            if plan.sequence[timeline][place - 1] == here and not is_default:
                reactor.lasting[timeline] = here
                found.append(mate)
    return found


def _is_blocked(reactor: Reactor, timeline: str, place: int, number: int) -> bool:
    """Whether something that is still to be seen, or that begins as late as it may, comes first."""
    plan, token, net = reactor.plan, reactor.plan.tokens[number], reactor.plan.net
    if plan.window(number)[1] <= reactor.tick + 1:
        return False
    asked = {one.token for one in reactor.requests}
    if place > 0:
        before = plan.sequence[timeline][place - 1]
        refused = any(one.token == before and one.refused for one in reactor.requests)
        if plan.state[before] == "active" and before not in asked:
            return True
        if _keeps_next(reactor, before) and (refused or not _is_tied(reactor, plan.tokens[before].end, token.start)):
            return True
    for other in plan.tokens:
        here = other.number
        if other.timeline in reactor.part.internal and plan.state[here] == "active":
            is_late = other.timeline not in reactor.part.early and not plan.goals_of[here]
            is_before = net.follows(token.start, other.start) and net.distance(token.start, other.start) < 0
            if is_late and is_before and net.high[other.start] < net.high[token.start]:
                return True
        if other.timeline in reactor.part.internal and _lasts(reactor, here):
            starts = {one.start for one in plan.tokens if one.timeline in reactor.part.internal}
            near = net.follows(token.start, other.end, starts)
            if near and net.distance(token.start, other.end) < 0:
                return True
        if other.timeline == timeline or other.timeline in reactor.part.internal:
            continue
        over = plan.state[here] == "begun" and plan.current[other.timeline] != here
        follows = net.follows(token.start, other.end) and not _is_tied(reactor, other.end, token.start)
        if plan.state[here] in ("active", "begun") and not over and follows:
            line = plan.sequence[other.timeline]
            after = line[line.index(here) + 1] if here != line[-1] else None
            if after is not None and not _keeps_next(reactor, here):
                if net.distance(plan.tokens[after].start, token.start) == 0:
                    if net.distance(token.start, plan.tokens[after].start) == 0:
                        continue
            return True
    return False


def _lasts(reactor: Reactor, number: int) -> bool:
    """Whether an own token that is not over may last longer or less."""
    plan, token, net = reactor.plan, reactor.plan.tokens[number], reactor.plan.net
    if plan.state[number] != "active" and plan.current.get(token.timeline) != number:
        return False
    return net.low[token.end] < net.high[token.end] and net.low[token.length] < net.high[token.length]


def _keeps_next(reactor: Reactor, number: int) -> bool:
    """Whether what comes next waits for the end of what was asked for, or has gone on; not of what holds by default."""
    plan, token = reactor.plan, reactor.plan.tokens[number]
    if reactor.lasting.get(token.timeline) != number and all(one.token != number for one in reactor.requests):
        return False
    default = reactor.description.kind(token.timeline).predicates[0][0]
    return plan.state[number] != "begun" or token.predicate != default


def _wanting(reactor: Reactor, number: int, met: set[int]) -> list[int]:
    """The tokens from outside of its timeline that want one, or what comes later there and asked for it."""
    plan = reactor.plan
    met.add(number)
    found, line = [], plan.sequence[plan.tokens[number].timeline]
    for one in plan.tokens:
        if plan.state[one.number] == "dropped" or plan.stands_for(one.number) != number:
            continue
        asking = one.parent if one.parent is None else plan.stands_for(one.parent)
        if asking is None or plan.tokens[asking].timeline != one.timeline:
            found.append(one.number)
        elif line.index(asking) > line.index(number) and asking not in met:
            found += _wanting(reactor, asking, met)
    return found


def _waits(reactor: Reactor, number: int) -> bool:
    """Whether it follows from an own token that begins as late as it may."""
    plan, here = reactor.plan, reactor.plan.tokens[number].parent
    while here is not None:
        token = plan.tokens[plan.stands_for(here)]
        if plan.goals_of[token.number] or plan.state[token.number] == "begun":
            return False
        if token.timeline in reactor.part.internal and token.timeline not in reactor.part.early:
            return True
        here = token.parent
    return False


def _late_start(reactor: Reactor, timeline: str, place: int) -> int:
    """The latest start of what only follows what holds there, such that nothing wanted behind it is delayed."""
    plan, line = reactor.plan, reactor.plan.sequence[timeline]
    here = line[place]
    for there in line[place:]:
        wanting = _wanting(reactor, there, set())
        if not wanting:
            continue
        if there == here:
            return -FAR
        trial = plan.net.copy()
        if not _waits(reactor, wanting[0]):
            trial.most(plan.tokens[there].start, trial.low[plan.tokens[there].start])
        return trial.high[plan.tokens[here].start]
    return plan.window(here)[1]


def _is_tied(reactor: Reactor, end: int, start: int) -> bool:
    """Whether something has to start at the very tick of an end."""
    net = reactor.plan.net
    return net.distance(end, start) == 0 or net.high[start] <= net.low[end]
