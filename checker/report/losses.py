"""What a batch cost, in words and as data: goals lost, plans repaired, requests not met."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Any

from checker.batch.result import MissionResult
from checker.excerpts import Excerpts
from checker.explain import place_data
from checker.losses import GoalFate
from checker.rendering import kind_text
from checker.report.sentences import missions
from checker.tally import GoalTally, RepairTally, Tally, UnmetTally
from nddl_lang.text.printable import counted
from runtime.executive.outcome import Reason
from runtime.executive.rendering import reason_text

_MOST_LINES = 4


def loss_lines(tally: Tally, excerpts: Excerpts) -> list[str]:
    """The losses of a batch for a terminal: totals, then what was lost most and where."""
    lines = [goal_line(tally), request_line(tally)]
    for goal in _given_up(tally)[:_MOST_LINES]:
        lines.append(f"  given up: {goal_text(goal, excerpts)}")
    for repair in tally.repairs[:_MOST_LINES]:
        lines.append(f"  repaired: {repair_text(repair, excerpts)}")
    for one in tally.undelivered[:_MOST_LINES]:
        lines.append(f"  undelivered: {unmet_text(one)}")
    for one in tally.given_up[:_MOST_LINES]:
        lines.append(f"  request given up: {unmet_text(one)}")
    return [line for line in lines if line]


def goal_line(tally: Tally) -> str:
    """Goals by their fate, and how many were optional."""
    if not tally.goals:
        return "goals: the mission file has none"
    every = len(tally.goals)
    optional = "all of them optional" if tally.optional == every else f"{tally.optional} of them optional"
    if every == 1:
        optional = "optional" if tally.optional else "mandatory"
    fates = ", ".join(f"{count} {fate}" for fate, count in _told((fate, tally.count(fate)) for fate in GoalFate))
    return f"goals: {fates} ({counted(every, 'goal')} a mission, {optional})"


def request_line(tally: Tally) -> str:
    """Repairs and requests."""
    return (
        f"repairs of plans: {tally.repaired}; requests between reactors: {tally.requests}, "
        f"{tally.lost} undelivered, {tally.dropped} given up"
    )


def damage_words(tally: Tally) -> str:
    """What may not be overlooked beside a verdict; empty where nothing was lost."""
    late, rejected = tally.count(GoalFate.LATE), tally.count(GoalFate.REJECTED)
    parts = [f"{counted(rejected, 'goal')} rejected"] if rejected else []
    parts += [f"{counted(late, 'goal')} late"] if late else []
    parts += [f"{counted(tally.repaired, 'repair')} of plans"] if tally.repaired else []
    parts += [f"{counted(tally.lost, 'request')} undelivered"] if tally.lost else []
    parts += [f"{counted(tally.dropped, 'request')} given up"] if tally.dropped else []
    return ", ".join(parts)


def goal_text(goal: GoalTally, excerpts: Excerpts) -> str:
    """A goal that was given up: which, where it is written, how often, and why."""
    reasons = ", ".join(
        f"{count} × {reason_text(reason)}{' (and the like)' if are_several else ''}"
        for reason, count, are_several in _sorts(goal.reasons)
    )
    kind = "mandatory" if goal.goal.mandatory else "optional"
    what = f"{goal.goal.predicate} on `{goal.goal.timeline}` ({kind})"
    return f"{what}, {excerpts.path(goal.place)}, in {missions(goal.given_up)}: {reasons}; first in {goal.example}"


def _sorts(reasons: Sequence[tuple[Reason, int]]) -> list[tuple[Reason, int, bool]]:
    """Reasons by sort, whatever ticks and numbers of tokens: the first, how often, and whether there are several."""
    groups: dict[Reason, list[tuple[Reason, int]]] = {}
    for reason, count in reasons:
        groups.setdefault(_sort_of(reason), []).append((reason, count))
    found = [(each[0][0], sum(count for _, count in each), len(each) > 1) for each in groups.values()]
    return sorted(found, key=lambda one: -one[1])


def _sort_of(reason: Reason) -> Reason:
    token = None if reason.token is None else replace(reason.token, key=0)
    repair = None if reason.repair is None else _sort_of(reason.repair)
    return replace(reason, token=token, tick=None, since=None, repair=repair)


def repair_text(repair: RepairTally, excerpts: Excerpts) -> str:
    """Repairs at a line of the model."""
    where = "" if repair.place is None else f" at {excerpts.path(repair.place)} `{excerpts.line(repair.place).strip()}`"
    many = f"{counted(repair.count, 'time')} in {missions(repair.missions)}"
    return f"{repair.reactor}{where}, {many}: {kind_text(repair.kind)}; first in {repair.example}"


def unmet_text(one: UnmetTally) -> str:
    """Requests that were not met."""
    many = f"{counted(one.count, 'time')} in {missions(one.missions)}"
    what = f"{one.predicate} on `{one.timeline}`"
    return f"{one.sender} asked for {what}, {many}: {kind_text(one.kind)}; first in {one.example}"


def _given_up(tally: Tally) -> list[GoalTally]:
    return sorted((goal for goal in tally.goals if goal.given_up), key=lambda goal: -goal.given_up)


def tally_data(tally: Tally, excerpts: Excerpts) -> dict[str, Any]:
    """The losses of a batch as data."""
    return {
        "goals": dict(_told((fate, tally.count(fate)) for fate in GoalFate)),
        "optional_goals": tally.optional,
        "mandatory_goals": len(tally.goals) - tally.optional,
        "repairs": tally.repaired,
        "requests": tally.requests,
        "undelivered": tally.lost,
        "given_up": tally.dropped,
        "by_goal": [_goal(number, goal, excerpts) for number, goal in enumerate(tally.goals, 1)],
        "by_repair": [
            {
                "reactor": one.reactor,
                "reason": kind_text(one.kind),
                "place": place_data(one.place, excerpts),
                "count": one.count,
                "missions": one.missions,
                "example": one.example,
            }
            for one in tally.repairs
        ],
        "by_request": [
            _unmet(one, fate)
            for fate, many in (("undelivered", tally.undelivered), ("given up", tally.given_up))
            for one in many
        ],
    }


def _told(counts: Iterable[tuple[GoalFate, int]]) -> Iterator[tuple[str, int]]:
    """How many goals ended in each way; a mission file that takes none back need not tell of that."""
    yield from ((fate.value, count) for fate, count in counts if count or fate is not GoalFate.RECALLED)


def _goal(number: int, goal: GoalTally, excerpts: Excerpts) -> dict[str, Any]:
    return {
        "goal": number,
        "timeline": goal.goal.timeline,
        "predicate": goal.goal.predicate,
        "mandatory": goal.goal.mandatory,
        "place": place_data(goal.place, excerpts),
        **dict(_told(goal.counts)),
        "reasons": [{"reason": reason_text(reason), "count": count} for reason, count in goal.reasons],
        "example": goal.example,
    }


def _unmet(one: UnmetTally, fate: str) -> dict[str, Any]:
    return {
        "sender": one.sender,
        "timeline": one.timeline,
        "predicate": one.predicate,
        "fate": fate,
        "reason": kind_text(one.kind),
        "count": one.count,
        "missions": one.missions,
        "example": one.example,
    }


def mission_losses(result: MissionResult, tally: Tally) -> dict[str, Any]:
    """The losses of one mission as data; goals that were never sent count as open."""
    losses = result.losses
    fates = dict(_told((fate, losses.count(fate)) for fate in GoalFate))
    fates[GoalFate.OPEN.value] = len(tally.goals) - sum(losses.count(fate) for fate in GoalFate if fate != "open")
    given_up = [one for one in losses.goals if one.fate in (GoalFate.LATE, GoalFate.REJECTED)]
    return {
        "goals": fates,
        "rejected": [
            {
                "goal": one.number + 1,
                "fate": one.fate.value,
                "tick": one.tick,
                "line": tally.goals[one.number].place.line,
                "reason": reason_text(one.reason) if one.reason is not None else "",
            }
            for one in given_up
        ],
        "repairs": losses.repaired,
        "undelivered": losses.lost,
        "given_up": losses.dropped,
    }
