"""A little oracle: what must be true of the trace of a random agent, read from its JSON Lines and its description.

It takes the rules from the reference of T-REX and knows nothing of the executive: no plan, no reasons, no causes.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from tests.executive.generated.agents import Coded, RandomAgent, Reactor

Data = dict[str, Any]
BOUNDS = {"inf": float("inf"), "-inf": float("-inf")}
STAGES = ("keeping the past", "forgetting the past", "no plan")


def bounds(pair: list[Any]) -> tuple[float, float]:
    """Bounds as numbers."""
    low, high = (BOUNDS[one] if isinstance(one, str) else float(one) for one in pair)
    return low, high


@dataclass(slots=True)
class Asked:
    """A request, and what became of it; `at` are places in the trace, `tick` are ticks."""

    number: int
    sender: str
    line: str
    predicate: str
    arguments: Data
    tick: int
    start: tuple[float, float]
    end: tuple[float, float]
    duration: tuple[float, float]
    refused: int | None = None
    rejected: int | None = None
    recalled: int | None = None
    achieved: int | None = None

    def is_open(self, tick: int) -> bool:
        """Whether its owner has to do with it after this tick has been synchronised."""
        over = (one for one in (self.refused, self.recalled, self.achieved) if one is not None)
        return self.tick < tick and all(one >= tick for one in over)

    def takes(self, held: "Held") -> bool:
        """Whether what was observed can be what was asked for."""
        return (
            held.line == self.line
            and held.predicate == self.predicate
            and self.start[0] <= held.start <= self.start[1]
            and all(_meets(held.arguments.get(name), value) for name, value in self.arguments.items())
        )


def _meets(seen: Any, asked: Any) -> bool:
    """Whether two intervals of numbers, or single ones, have a value in common; or two lists of names."""
    names = [set(one if isinstance(one, list) else [one]) for one in (seen, asked)]
    if any(isinstance(one, str) and one not in BOUNDS for each in names for one in each):
        return bool(names[0] & names[1])
    (low, high), (least, most) = (bounds(one if isinstance(one, list) else [one, one]) for one in (seen, asked))
    return low <= most and least <= high


@dataclass(slots=True)
class Held:
    """What was observed on a timeline, until something else was."""

    line: str
    predicate: str
    arguments: Data
    start: int
    end: int | None = None


@dataclass(slots=True)
class Oracle:
    """One flight and what is wrong about it."""

    agent: RandomAgent
    events: list[Data]
    wrong: list[str] = field(default_factory=list)
    asked: dict[int, Asked] = field(default_factory=dict)
    held: dict[str, list[Held]] = field(default_factory=dict)
    lost: dict[str, int] = field(default_factory=dict)  # reactors that were killed, and when
    relaxed: dict[str, int] = field(default_factory=dict)  # the first repair of a reactor
    order: dict[str, int] = field(default_factory=dict)

    def say(self, event: Data, what: str) -> None:
        """Note what is wrong."""
        told = " ".join(
            str(event.get(key, "")) for key in ("tick", "kind", "reactor", "timeline", "predicate", "request")
        )
        self.wrong.append(f"{what}: {told}")

    def latency(self, reactor: Reactor) -> int:
        """Its execution latency."""
        owners = [self.agent.owner(line) for line in reactor.external()]
        return reactor.latency + max((self.latency(one) for one in owners), default=0)

    def reactor(self, name: str) -> Reactor:
        """A reactor by its name."""
        return next(one for one in self.agent.reactors if one.name == name)

    def owner(self, line: str) -> Reactor:
        """Who owns a timeline."""
        return next(one for one in self.agent.reactors if any(mine.name == line for mine in one.lines))

    # ---- event by event ----

    def read(self) -> None:
        """Go through the trace."""
        final, last = self.agent.final_tick, 0
        for place, event in enumerate(self.events):
            tick, kind, name = event["tick"], event["kind"], event["reactor"]
            if not last <= tick <= final:
                self.say(event, f"a tick between {last} and {final} was due")
            last = tick
            if place + 1 < len(self.events) and kind in ("end", "abort"):
                self.say(event, "something comes after the end")
            if name in self.lost and not self._is_last_will(event):
                self.say(event, f"comes from a reactor that was killed at {self.lost[name]}")
            getattr(self, f"_{kind}")(event)
        if not self.events or self.events[-1]["kind"] not in ("end", "abort"):
            self.wrong.append("the trace has no end")

    def _is_last_will(self, event: Data) -> bool:
        is_failed = event["kind"] == "observation" and event["predicate"] == "Failed"
        is_its_tick: bool = event["tick"] == self.lost[event["reactor"]]
        return is_its_tick and (is_failed or event["kind"] == "recall")

    def _observation(self, event: Data) -> None:
        line, tick, predicate = event["timeline"], event["tick"], event["predicate"]
        if self.owner(line).name != event["reactor"]:
            self.say(event, "only its owner speaks for a timeline")
        before = self.held.setdefault(line, [])
        if not before and tick != 0:
            self.say(event, "each timeline begins at tick 0")
        if before and before[-1].start == tick and predicate != "Failed":
            self.say(event, "two observations of one tick")
        if before and before[-1].predicate == "Failed":
            self.say(event, "what failed stays so")
        if (predicate == "Failed") != (event["reactor"] in self.lost):
            self.say(event, "who was killed has failed, and nobody else")
        if before and before[-1].predicate == predicate == "Rest":
            self.say(event, "nothing has changed")
        if predicate != "Failed":
            self._in_order(event)
        if before:
            before[-1].end = tick
        before.append(Held(line, predicate, event["arguments"], tick))

    def _in_order(self, event: Data) -> None:
        """Owners come before users in each tick."""
        used = {self.agent.owner(line).name for line in self.reactor(event["reactor"]).external()}
        self.order[event["reactor"]] = event["tick"]
        for user in self.agent.reactors:
            owners = {self.agent.owner(line).name for line in user.external()}
            if event["reactor"] in owners and self.order.get(user.name) == event["tick"] and user.name not in used:
                self.say(event, f"its user `{user.name}` has been synchronised before")

    def _sample(self, event: Data) -> None:
        """A draw says nothing of what was asked."""

    def _request(self, event: Data) -> None:
        number, tick, name, line = event["request"], event["tick"], event["reactor"], event["timeline"]
        start, end, duration = (bounds(event[key]) for key in ("start", "end", "duration"))
        one = Asked(number, name, line, event["predicate"], event["arguments"], tick, start, end, duration)
        if number in self.asked:
            self.say(event, "a number twice")
        self.asked[number] = one
        owner = self.owner(line)
        if tick >= self.agent.final_tick:
            self.say(event, "nobody deliberates at the final tick")
        if owner.name in self.lost and self.lost[owner.name] < tick:
            place = self.events.index(event)
            if not any(each["kind"] == "refuse" and each["request"] == number for each in self.events[place:]):
                self.say(event, "its owner was killed, and it was not refused")
        if not name:
            goal = self.agent.goals[-1 - number]
            if goal.at != tick:
                self.say(event, f"a goal of tick {goal.at}")
            return
        sender = self.reactor(name)
        if line not in {each.name for each in sender.external()} - {each.name for each in sender.observed()}:
            self.say(event, "not a timeline that it asks for anything")
        if owner.lookahead == 0:
            self.say(event, "its owner takes no goals")
        reach = tick + self.latency(owner) + owner.lookahead
        if one.start[0] > reach and not isinstance(sender, Coded):
            self.say(event, f"the dispatch window ends at {reach}, it starts at {one.start[0]}")
        if one.start[1] <= tick:
            self.say(event, "it is too late to ask")
        if owner.lookahead <= 1 and (one.end[1], one.duration[1]) != (float("inf"), float("inf")):
            self.say(event, "a command bears no end")

    def _fate(self, event: Data, of_owner: bool) -> Asked | None:
        one = self.asked.get(event["request"])
        if one is None or (one.line, one.predicate) != (event["timeline"], event["predicate"]):
            self.say(event, "nobody has asked for it")
            return None
        if (
            of_owner
            and event["reactor"] != self.owner(one.line).name
            and not (event["kind"] == "refuse" and self.owner(one.line).name in self.lost)
        ):
            self.say(event, "only its owner decides")
        if not of_owner and event["reactor"] != one.sender:
            self.say(event, "only who asked takes back")
        if one.refused is not None:
            self.say(event, "it was refused")
        if one.recalled is not None:
            self.say(event, "it was recalled")
        return one

    def _refuse(self, event: Data) -> None:
        if (one := self._fate(event, True)) is not None:
            if one.rejected is not None or one.achieved is not None:
                self.say(event, "it had been taken")
            one.refused = event["tick"]

    def _reject(self, event: Data) -> None:
        if (one := self._fate(event, True)) is not None:
            if one.achieved is not None:
                self.say(event, "it was achieved")
            one.rejected = event["tick"]

    def _achieved(self, event: Data) -> None:
        if "request" not in event:  # wanted by the model itself
            line = next(each for each in self.reactor(event["reactor"]).lines if each.name == event["timeline"])
            if event["arguments"]["n"] != line.planned[1] or not 0 < line.planned[0] < event["tick"]:
                self.say(event, "its model wants nothing of the sort")
            return
        if (one := self._fate(event, True)) is None:
            return
        if one.achieved is not None:
            self.say(event, "achieved twice")
        one.achieved = event["tick"]

    def _recall(self, event: Data) -> None:
        one = self.asked.get(event["request"])
        if one is None or event["reactor"] != one.sender:
            self.say(event, "only who asked takes back")
        elif one.recalled is not None:
            self.say(event, "recalled twice")
        else:
            is_told = one.sender and not isinstance(self.reactor(one.sender), Coded)
            if is_told and one.achieved is not None and one.achieved < event["tick"]:
                self.say(event, "it was achieved")
            one.recalled = event["tick"]
            if not one.sender and self.agent.goals[-1 - one.number].recall != event["tick"]:
                self.say(event, "not the tick of its recall")

    def _relax(self, event: Data) -> None:
        stage = event.get("stage")
        if stage not in STAGES:
            self.say(event, f"a repair of which there is none: {stage}")
        self.relaxed.setdefault(event["reactor"], event["tick"])

    def _kill(self, event: Data) -> None:
        if self.agent.on_failure != "kill_reactor":
            self.say(event, "this agent aborts")
        self.lost[event["reactor"]] = event["tick"]
        self._code(event)

    def _abort(self, event: Data) -> None:
        if self.agent.on_failure != "abort_agent":
            self.say(event, "this agent goes on")
        self._code(event)

    def _end(self, event: Data) -> None:
        if event["tick"] != self.agent.final_tick and len(self.lost) < len(self.agent.reactors):
            self.say(event, "the end is at the final tick")

    def _code(self, event: Data) -> None:
        """Whether the code of a failure fits what has happened."""
        code, tick, reactor = event.get("code"), event["tick"], self.reactor(event["reactor"])
        used = {line.name for line in reactor.external()}
        stages = [
            one["stage"]
            for one in self.events
            if one["kind"] == "relax" and (one["reactor"], one["tick"]) == (reactor.name, tick)
        ]
        if code in ("F1", "F2", "F3", "F6", "F8") and stages[-2:] != list(STAGES[:2]):
            self.say(event, f"not before both repairs: {stages}")
        if code == "F4" and STAGES[2] not in stages:
            self.say(event, f"not before the plan was relaxed: {stages}")
        if code in ("F1", "F2", "F6", "F8") and not used:
            self.say(event, f"{code} of what uses nothing")
        if code == "F2" and not any(each[-1].start == tick for name, each in self.held.items() if name in used):
            self.say(event, "F2 without an observation")
        failed = any(each[-1].predicate == "Failed" for name, each in self.held.items() if name in used)
        if code == "F8" and not failed:
            self.say(event, "F8, and nothing has failed")
        mine = [one for one in self.asked.values() if one.sender == reactor.name]
        given_up = [one for one in mine if one.refused is not None or one.rejected is not None]
        if code == "F6" and not given_up and not any(self.owner(one.line).name in self.lost for one in mine):
            self.say(event, "F6, and nothing was given up")
        if code == "F5" and reactor.max_steps is None:
            self.say(event, "F5 without a limit")
        if isinstance(reactor, Coded):
            if code != "F7" or reactor.raises != tick:
                self.say(event, "it has no mistake here")
        elif code not in ("F1", "F2", "F3", "F4", "F5", "F6", "F8"):
            self.say(event, f"no code of an agent of models: {code}")

    # ---- the whole ----

    def verdict(self) -> tuple[str, str]:
        """What the mission comes to."""
        last = self.events[-1]
        if last["kind"] == "abort":
            return "FAIL", last["code"]
        for event in self.events:
            if event["kind"] == "kill":
                return "FAIL", event["code"]
        fates = [self.asked.get(-1 - number) for number in range(len(self.agent.goals))]
        done = [one is not None and one.achieved is not None for one in fates]
        wanted = [goal.is_mandatory for goal in self.agent.goals]
        is_kept = all(is_done for is_done, is_wanted in zip(done, wanted, strict=True) if is_wanted)
        return ("PASS", "") if is_kept else ("FAIL", "F10")

    def killed_at(self, line: str) -> float:
        """When the owner of a timeline was killed."""
        return self.lost.get(self.owner(line).name, float("inf"))

    def intervals(self) -> Iterator[Held]:
        """All that was observed."""
        for each in self.held.values():
            yield from each
