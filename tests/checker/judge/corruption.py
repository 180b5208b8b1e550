"""Records and traces that were altered: each alteration makes a right mission break its model."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from random import Random
from typing import Any

from checker.judge.judge import judge_mission
from checker.judge.report import JudgeReport
from runtime.executive.outcome import EventKind
from runtime.executive.record import BodyRun, GuardRun, MissionRecord, ReactorRecord, TokenRecord
from tests.executive.flying import Flown

OTHER = {"red": "blue", "low": "high", "high": "low"}


def again(mission: Flown) -> JudgeReport:
    """Judge a mission anew."""
    return judge_mission(mission.agent, mission.programs, mission.outcome, mission.record)


def executed(record: ReactorRecord) -> list[int]:
    """Places of the tokens that were executed to their end."""
    return [
        k
        for k, one in enumerate(record.tokens)
        if one.state in ("active", "merged")
        and one.fate != "cut"
        and isinstance(one.start, int)
        and isinstance(one.end, int)
        and 0 < one.end <= record.last_tick
    ]


def altered(value: Any, dice: Random) -> Any:
    """Another value of the same kind."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return value + dice.choice((-3, -2, -1, 1, 2, 3))
    if isinstance(value, float):
        return value + dice.choice((-1.0, -0.125, -0.002, 0.002, 0.125, 1.0))
    return OTHER.get(value, "nothing")


def put(mission: Flown, reactor: int, index: int, token: TokenRecord | None) -> Flown:
    """The mission with another token record at an index, or none."""
    old = mission.record.reactors[reactor]
    tokens = list(old.tokens)
    tokens[index : index + 1] = [] if token is None else [token]
    reactors = list(mission.record.reactors)
    reactors[reactor] = old._replace(tokens=tuple(tokens))
    return mission._replace(record=MissionRecord(tuple(reactors)))


def chosen(mission: Flown, dice: Random, accepts: Callable[[TokenRecord], bool]) -> tuple[int, int, TokenRecord] | None:
    """A token that was executed, and its index."""
    found = [
        (r, k, record.tokens[k])
        for r, record in enumerate(mission.record.reactors)
        for k in executed(record)
        if accepts(record.tokens[k])
    ]
    return dice.choice(found) if found else None


def runs(token: TokenRecord) -> Iterator[tuple[BodyRun, Callable[[BodyRun], tuple[BodyRun, ...]]]]:
    """The runs of a token, branches included, each with what puts another in its place."""
    for k, run in enumerate(token.runs):
        yield from _inner(run, lambda new, k=k: (*token.runs[:k], new, *token.runs[k + 1 :]))  # type: ignore[misc]


def _inner(
    run: BodyRun, build: Callable[[BodyRun], tuple[BodyRun, ...]]
) -> Iterator[tuple[BodyRun, Callable[[BodyRun], tuple[BodyRun, ...]]]]:
    yield run, build
    for k, guard in enumerate(run.guards):
        if guard.run is not None:

            def put_back(new: BodyRun, k: int = k, guard: GuardRun = guard) -> tuple[BodyRun, ...]:
                return build(run._replace(guards=(*run.guards[:k], guard._replace(run=new), *run.guards[k + 1 :])))

            yield from _inner(guard.run, put_back)


# ---- alterations ----


def shift(mission: Flown, dice: Random) -> Flown | None:
    """A token that began and ended at other times."""
    if (found := chosen(mission, dice, lambda one: True)) is None:
        return None
    r, k, one = found
    by = dice.choice((-2, -1, 1, 2))
    return put(mission, r, k, one._replace(start=one.start + by, end=one.end + by))  # type: ignore[operator]


def stretch(mission: Flown, dice: Random) -> Flown | None:
    """A token that lasted longer, or not so long."""
    if (found := chosen(mission, dice, lambda one: True)) is None:
        return None
    r, k, one = found
    by = dice.choice((-1, 1, 3))
    return put(mission, r, k, one._replace(end=one.end + by, duration=one.duration + by))  # type: ignore[operator]


def argument(mission: Flown, dice: Random) -> Flown | None:
    """Another argument."""
    if (found := chosen(mission, dice, lambda one: bool(one.arguments))) is None:
        return None
    r, k, one = found
    at = dice.randrange(len(one.arguments))
    values = list(one.arguments)
    values[at] = altered(values[at], dice)
    return put(mission, r, k, one._replace(arguments=tuple(values)))


def local(mission: Flown, dice: Random) -> Flown | None:
    """Another value of a local variable."""
    found = chosen(mission, dice, lambda one: any(run.locals for run, _ in runs(one)))
    if found is None:
        return None
    r, k, one = found
    run, build = dice.choice([each for each in runs(one) if each[0].locals])
    at = dice.randrange(len(run.locals))
    values = list(run.locals)
    values[at] = altered(values[at], dice)
    return put(mission, r, k, one._replace(runs=build(run._replace(locals=tuple(values)))))


def branch(mission: Flown, dice: Random) -> Flown | None:
    """The other branch, or none."""
    found = chosen(mission, dice, lambda one: any(run.guards for run, _ in runs(one)))
    if found is None:
        return None
    r, k, one = found
    run, build = dice.choice([each for each in runs(one) if each[0].guards])
    at = dice.randrange(len(run.guards))
    old = run.guards[at]
    new = dice.choice([name for name in ("then", "else", "waiting") if name != old.branch])
    guards = (*run.guards[:at], GuardRun(new, True, None), *run.guards[at + 1 :])
    return put(mission, r, k, one._replace(runs=build(run._replace(guards=guards))))


def child(mission: Flown, dice: Random) -> Flown | None:
    """Another token in the place of a child."""
    found = chosen(mission, dice, lambda one: any(run.children for run, _ in runs(one)))
    if found is None:
        return None
    r, k, one = found
    run, build = dice.choice([each for each in runs(one) if each[0].children])
    at = dice.randrange(len(run.children))
    keys = [each.key for each in mission.record.reactors[r].tokens if each.key != run.children[at]]
    tokens = {each.key: each for each in mission.record.reactors[r].tokens}
    alike = {run.children[at], tokens[run.children[at]].merged_into}
    alike |= {each.key for each in tokens.values() if each.merged_into in alike - {-1}}
    keys = [key for key in keys if key not in alike]
    children = (*run.children[:at], dice.choice(keys), *run.children[at + 1 :])
    return put(mission, r, k, one._replace(runs=build(run._replace(children=children))))


def matters(one: TokenRecord) -> bool:
    """Whether a token is in the plan by itself, is asked for by a rule, or was observed."""
    return one.state == "active" or one.origin in ("rule", "observation")


def lost(mission: Flown, dice: Random) -> Flown | None:
    """A token without a record that others name, or that was published."""
    if (found := chosen(mission, dice, matters)) is None:
        return None
    return put(mission, found[0], found[1], None)


def unfired(mission: Flown, dice: Random) -> Flown | None:
    """A rule that did not run."""
    if (found := chosen(mission, dice, lambda one: bool(one.runs) and one.origin not in ("goal", "fact"))) is None:
        return None
    r, k, one = found
    return put(mission, r, k, one._replace(runs=one.runs[1:]))


def twin(mission: Flown, dice: Random) -> Flown | None:
    """A token merged into another one of its predicate."""
    if (found := chosen(mission, dice, lambda one: one.state == "merged")) is None:
        return None
    r, k, one = found
    others = [
        each.key
        for each in mission.record.reactors[r].tokens
        if each.state == "active" and each.key != one.merged_into and each.start != one.start
    ]
    return put(mission, r, k, one._replace(merged_into=dice.choice(others))) if others else None


def undone(mission: Flown, dice: Random) -> Flown | None:
    """A token that was never put into the plan."""
    if (found := chosen(mission, dice, matters)) is None:
        return None
    r, k, one = found
    return put(mission, r, k, one._replace(state="inactive", runs=(), merged_into=-1))


def silence(mission: Flown, dice: Random) -> Flown | None:
    """An observation that nobody published."""
    events = list(mission.outcome.events)
    indices = [k for k, event in enumerate(events) if event.kind is EventKind.OBSERVATION]
    del events[dice.choice(indices)]
    return mission._replace(outcome=replace(mission.outcome, events=tuple(events)))


def rumour(mission: Flown, dice: Random) -> Flown | None:
    """An observation that came at another time."""
    events = list(mission.outcome.events)
    indices = [k for k, event in enumerate(events) if event.kind is EventKind.OBSERVATION]
    at = dice.choice(indices)
    events[at] = replace(events[at], tick=max(0, events[at].tick + dice.choice((-1, 1))))
    return mission._replace(outcome=replace(mission.outcome, events=tuple(events)))


ALTERATIONS = (shift, stretch, argument, local, branch, child, lost, unfired, twin, undone, silence, rumour)
