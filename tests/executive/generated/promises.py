"""What an agent promises beforehand: histories that follow from its description and from what was asked alone."""

from collections.abc import Iterator
from typing import Any

from tests.executive.generated.agents import Coded, Reactor
from tests.executive.generated.oracle import Asked, Held, Oracle, bounds
from tests.executive.generated.timelines import STORE, Child, Line

INFINITE = float("inf")


def broken_promises(oracle: Oracle) -> Iterator[str]:
    """What came out otherwise than it must; the oracle has read the trace."""
    yield from goals_that_are_missing(oracle)
    yield from achieved_without_being_seen(oracle)
    for reactor in oracle.agent.reactors:
        for line in reactor.lines:
            held = oracle.held.get(line.name, [])
            if isinstance(reactor, Coded):
                yield from of_what_is_said(oracle, reactor, held)
            elif line.kind in ("script", "counter"):
                yield from of_what_happens_by_itself(oracle, line, held)
            elif line.kind == "mirror":
                yield from of_a_mirror(oracle, line, held)
            else:
                yield from of_what_is_asked_for(oracle, line, held)
                yield from of_times(oracle, line, held)
            if line.kind == "task":
                yield from of_children(oracle, line, held)
        yield from of_a_store(oracle, reactor)


def goals_that_are_missing(oracle: Oracle) -> Iterator[str]:
    """Each goal is handed out at its tick as long as there is an owner."""
    last = oracle.events[-1]
    for number, goal in enumerate(oracle.agent.goals):
        is_sent = -1 - number in oracle.asked
        is_due = goal.at < min(oracle.killed_at(goal.line.name), last["tick"])
        if is_due and not is_sent:
            yield f"goal {number} of tick {goal.at} was never handed out"
        one = oracle.asked.get(-1 - number)
        if (
            one is not None
            and goal.recall is not None
            and one.recalled is None
            and goal.recall < min(oracle.killed_at(goal.line.name), last["tick"])
        ):
            yield f"goal {number} was to be recalled at {goal.recall}"


def achieved_without_being_seen(oracle: Oracle) -> Iterator[str]:
    """What was achieved has been observed, within all that was asked."""
    for one in oracle.asked.values():
        if one.achieved is None:
            continue
        fitting = [
            held
            for held in oracle.held[one.line]
            if one.takes(held)
            and held.start > one.tick
            and held.end == one.achieved
            and one.end[0] <= held.end <= one.end[1]
            and one.duration[0] <= held.end - held.start <= one.duration[1]
        ]
        if not fitting:
            yield f"request {one.number} on {one.line} is achieved at {one.achieved}, and was not seen"


def of_what_happens_by_itself(oracle: Oracle, line: Line, held: list[Held]) -> Iterator[str]:
    """Scripts and counters run as they are written, until somebody fails."""
    last = oracle.events[-1]
    end = min(last["tick"], oracle.killed_at(line.name))
    wanted: list[tuple[int, str, dict[str, float]]] = []
    tick = 0
    if line.kind == "counter":
        step = line.steps[0]
        ticks = range(0, oracle.agent.final_tick + 1, step)
        wanted = [(at, "At", {"v": of_sum(line.step, at // step)}) for at in ticks]
    else:
        for number, length in enumerate((*line.steps, 0)):
            if not (line.breaks and number == len(line.steps)):
                wanted.append((tick, f"S{number}", {}))
            tick += length
    got = [(one.start, one.predicate, one.arguments) for one in held if one.predicate != "Failed"]
    sure = [one for one in wanted if one[0] < end]
    if got[: len(sure)] != sure or any(one not in wanted for one in got):
        yield f"{line.name} is to be {wanted} until {end}, and was {got}"
    breaks_at = sum(line.steps)
    if line.kind == "script" and line.breaks and end > breaks_at:
        yield f"{line.name} goes on after {breaks_at}"


def of_sum(step: float, count: int) -> float:
    """What `count` additions of a number give, each rounded as the processor rounds it."""
    total = 0.0 if step != 1 else 0
    for _ in range(count):
        total += step
    return total


def of_what_is_said(oracle: Oracle, reactor: Coded, held: list[Held]) -> Iterator[str]:
    """A reactor in Python says what is in its text."""
    last = oracle.events[-1]["tick"]
    wanted = [one for one in reactor.says if one[0] <= last]
    got = [(one.start, one.arguments.get("v", 0)) for one in held if one.predicate != "Failed"]
    sure = [one for one in wanted if one[0] < min(last, oracle.lost.get(reactor.name, last))]
    if got[: len(sure)] != sure or any(one not in wanted for one in got):
        yield f"{reactor.name} is to say {wanted}, and said {got}"


def of_a_mirror(oracle: Oracle, line: Line, held: list[Held]) -> Iterator[str]:
    """A mirror shows at the very tick what it copies; at the final tick nothing new is begun."""
    assert line.copied is not None
    owner = oracle.owner(line.name)
    if owner.name in oracle.relaxed or owner.max_steps is not None:
        return
    end = min(oracle.events[-1]["tick"], oracle.killed_at(line.name), oracle.killed_at(line.copied.name))
    shown = {"script": "S1", "horn": "Loud"}.get(line.copied.kind, "At")
    for one in oracle.held[line.copied.name]:
        if one.start >= end:
            break
        now = next((each for each in reversed(held) if each.start <= one.start), None)
        value = one.arguments.get("v", 7)
        wanted = ("Lit", {"v": value}) if one.predicate == shown else ("Dark", {})
        if now is None or (now.predicate, now.arguments) != wanted or (wanted[0] == "Lit" and now.start != one.start):
            yield f"{line.name} does not show {one}: {now}"


def of_what_is_asked_for(oracle: Oracle, line: Line, held: list[Held]) -> Iterator[str]:
    """Nothing begins that nobody has asked for, and what is asked for once is done once."""
    asked = sorted((one for one in oracle.asked.values() if one.line == line.name), key=lambda one: one.start[1])
    used: set[int] = set()
    if (line.kind == "command" and line.rest) or line.planned[0]:
        return  # anything else may come where nothing has no room (the last choice of a present)
    for one in (one for one in held if one.predicate == "Do"):
        fitting = [each for each in asked if each.number not in used and each.takes(one) and each.is_open(one.start)]
        if not fitting:
            yield f"{line.name} begins {one}, and nobody has asked for it"
            continue
        meant = [each for each in fitting if each.achieved == one.end]
        used.add((meant or fitting)[0].number)
        if (
            len(fitting) == 1
            and len([each for each in asked if each.is_open(one.start) or each.is_open(each.tick + 1)]) == 1
        ):
            yield from of_one_alone(oracle, line, fitting[0], one)


def of_one_alone(oracle: Oracle, line: Line, asked: Asked, held: Held) -> Iterator[str]:
    """What is the only thing that was ever asked for begins as soon as it may, and lasts as long as it may."""
    owner = oracle.owner(line.name)
    if (
        any(line.used())
        or line.latest is not None
        or oracle.agent.steps
        or owner.max_steps is not None
        or owner.name in oracle.relaxed
    ):
        return
    soonest = max(asked.start[0], asked.tick + 1, line.rest if line.kind == "command" else 0)
    if held.start != soonest:
        yield f"{line.name} could begin at {soonest}, and began at {held.start}"
    if held.end is None or oracle.killed_at(line.name) <= held.end:
        return
    most = (ends(held.arguments["n"])[1] + line.extra) if line.kind == "command" else (line.lasts[1] or INFINITE)
    longest = min(most, asked.duration[1], asked.end[1] - held.start)
    if asked.recalled is not None and asked.recalled < held.start + longest:
        longest = most  # who has taken back what runs binds it no more
    if not longest <= held.end - held.start <= longest + line.slack:
        yield f"{line.name} was to last {longest}, and lasted from {held.start} to {held.end}"


def of_times(oracle: Oracle, line: Line, held: list[Held]) -> Iterator[str]:
    """How long something lasts, and what it is asked to be."""
    last = oracle.events[-1]["tick"]
    for one in held:
        end = one.end if one.end is not None else last
        is_over = one.end is not None and one.end < oracle.killed_at(line.name)
        length = end - one.start
        least: float
        most: float
        if one.predicate == "Rest":
            least, most = (line.rest if line.kind == "command" else 0), INFINITE
        elif one.predicate == "Do" and line.kind == "command":
            lowest, highest = ends(one.arguments["n"])
            least, most = lowest + line.extra, highest + line.extra + line.slack
            if line.most is not None and lowest > line.most:
                yield f"{line.name} takes no n above {line.most}: {one}"
        elif one.predicate == "Do":
            least, most = line.lasts[0], line.lasts[1] or INFINITE
        else:
            continue
        if (is_over and length < least) or length > most:
            yield f"{line.name} lasts from {least} to {most}: {one}"


def of_children(oracle: Oracle, line: Line, held: list[Held]) -> Iterator[str]:
    """What a task asks of others is seen, unless something was repaired or lost."""
    owner = oracle.owner(line.name)
    owners = {oracle.owner(child.line.name).name for child in line.children}
    if owner.name in oracle.relaxed or oracle.lost.keys() & {owner.name, *owners}:
        return
    for one in (one for one in held if one.predicate == "Do" and one.end is not None):
        for child in line.children:
            if (child.least is not None and ends(one.arguments["n"])[0] < child.least) or child.above is not None:
                continue
            found = [each for each in oracle.held[child.line.name] if fits(child, one, each)]
            if not found and not may_still_come(child, one, oracle.events[-1]["tick"]):
                yield f"{line.name} {one} has no {child.relation} {child.line.name}"
        if line.within is not None:
            around = [each for each in oracle.held[line.within.name] if each.predicate == "S1"]
            if not any(each.start <= one.start and (each.end or INFINITE) >= (one.end or 0) for each in around):
                yield f"{line.name} {one} is outside of {line.within.name}"


def of_a_store(oracle: Oracle, reactor: Reactor) -> Iterator[str]:
    """What tasks use together is there."""
    changes = []
    for line in reactor.lines:
        for one in oracle.held.get(line.name, []):
            if line.uses and one.predicate == "Do":
                changes.append((one.start, -line.uses))
                if line.returns and one.end is not None and one.end < oracle.killed_at(line.name):
                    changes.append((one.end, line.uses))
    level = STORE
    for tick in sorted({tick for tick, _ in changes}):
        level += sum(change for at, change in changes if at == tick)
        if level < 0:
            yield f"the store of {reactor.name} holds {level} at {tick}"


def fits(child: Child, parent: Held, seen: Held) -> bool:
    """Whether what was seen is what a task asks for."""
    assert parent.end is not None
    if seen.predicate != "Do":
        return False
    (low, high), (least, most) = ends(seen.arguments["n"]), ends(parent.arguments["n"])
    if low > most + child.plus or high < least + child.plus:
        return False
    if child.relation == "beside":
        return parent.start == seen.start
    if child.relation == "contains":
        return parent.start <= seen.start and seen.end is not None and seen.end <= parent.end
    if child.relation == "meets":
        return seen.start == parent.end
    if child.relation == "met_by":
        return seen.end == parent.start
    return parent.end + 2 <= seen.start <= parent.end + 9


def ends(value: Any) -> tuple[float, float]:
    """The least and the largest value of a number that may be open."""
    return bounds(value if isinstance(value, list) else [value, value])


def may_still_come(child: Child, parent: Held, last: int) -> bool:
    """Whether the mission ended before it had to begin."""
    assert parent.end is not None
    return parent.end + {"meets": 0, "follows": 9}.get(child.relation, -1) >= last
