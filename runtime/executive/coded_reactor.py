"""A reactor written in Python, among the others: what it does wrong ends it, and nothing else (F7, F9)."""

import sys
from collections.abc import Callable, Iterable, Mapping
from math import inf, isnan
from pathlib import Path

from compiler.program import DomainConstant
from runtime.executive.commands import Commands
from runtime.executive.configuration import CodeConfiguration
from runtime.executive.messages import Arguments, Observation, Request, make_domain, make_tuple
from runtime.executive.outcome import EventKind, OpenGoal, Reason, ReasonKind, SourcePlace, TimeBounds
from runtime.executive.reactor import Failure, Refusal, TeleoReactor
from runtime.executive.trace import Trace
from runtime.executive.turns import Said, is_due, turns_of
from runtime.plan.tags import INFINITY
from runtime.user.fault import UserCodeError, failed
from runtime.user.limit import WATCH, Plain
from runtime.user.reactor import Argument, Now, Published, Reactor, Seen, Ticks

_NEVER = 2**62
_MOST_CAUSES = 3
_NOBODY: frozenset[int] = frozenset()
_SYS = vars(sys)
_NAMED = ("symbol", "enum", "string", "object")  # kinds whose values are written as texts
_Kind = tuple[str, str, tuple[str, ...]]  # of a parameter: its kind and type, and the values of an enum
_Kinds = Callable[[str, str], "Mapping[str, _Kind] | None"]  # timeline, predicate: parameters; None: unknown


class CodedReactor(TeleoReactor):
    """Calls a user's reactor, and speaks for it; it decides nothing, and only the code knows its reasons."""

    def __init__(
        self,
        configuration: CodeConfiguration,
        make: Callable[[], Reactor],
        kinds: _Kinds,
        trace: Trace,
        wakes_on: tuple[str, ...] | None = None,
        root: str = "",
    ) -> None:
        super().__init__(
            configuration.name,
            configuration.internal,
            configuration.external,
            configuration.latency,
            configuration.lookahead,
        )
        self.commands = Commands(self.name, trace) if self.lookahead > 0 else None
        self.told: dict[int, Mapping[str, Argument]] = {}  # arguments of commands, as users read them
        self.folder = Path(root)
        self.files = (str(self.folder / configuration.file) if configuration.file else "",)  # as its module is compiled
        self.call = (Plain(f"the reactor `{self.name}`", self.files), None, 0)
        self.watch = WATCH
        self.make = make
        self.kinds = kinds
        self.trace = trace
        self.code: Reactor | None = None
        self.seen: dict[str, Seen] = {}
        self.events: dict[str, int] = {}
        self.news: dict[str, Observation] = {}
        self.wakes_on = self.external if wakes_on is None else tuple(wakes_on)
        self.told_sets: dict[tuple[str, ...], frozenset[str]] = {}  # what was news at once
        self.is_stirred = False  # something has begun to hold on one of these
        self.refused_numbers: list[int] = []
        self.wakes = {0}  # the ticks at which the code wants to be called
        self.wake = 0  # the earliest of them
        self.published: list[tuple[Published, Arguments, tuple[int, ...]]] = []  # with the request that it answers
        self.turns: list[Said] = []  # what it asks and takes back, each at once
        self.numbers: dict[int, int] = {}  # of what was asked for, as the code and as the agent counts
        self.count = 0
        self.given_up: list[Refusal] = []

    def next_tick(self, tick: int) -> int:
        """When the code wants to be called."""
        if self.refused_numbers:
            return tick + 1
        wake = self.wake if self.commands is None else min(self.wake, self.commands.next_call(tick))
        return max(tick + 1, wake)

    def is_asleep(self) -> bool:
        """Whether nothing will call the code any more, unless it is asked for something."""
        is_asked = self.commands is not None and (bool(self.commands.waiting) or self.commands.has_news)
        return self.wake >= _NEVER and not self.wakes_on and not self.refused_numbers and not is_asked

    def notify(self, observation: Observation) -> None:
        """Take note of what an owner published."""
        news = observation
        self.news[news.timeline] = news
        if news.timeline in self.wakes_on:
            self.is_stirred = True
            self.due = news.tick

    def synchronise(self, tick: int) -> Failure | None:
        """Let the code speak, if there is anything new."""
        commands = self.commands
        if commands is not None:
            commands.expire(tick)
        is_called = self.is_stirred or self.refused_numbers or self.wake <= tick
        if not is_called and (commands is None or not commands.calls(tick)):
            return None
        told: list[str] = []
        for timeline, observation in self.news.items():
            arguments = _shown_arguments(observation)
            self.seen[timeline] = make_tuple(Seen, (observation.predicate, arguments, observation.tick))
            self.events[timeline] = observation.event
            if observation.tick == tick or timeline in self.wakes_on:
                told.append(timeline)
        refused = frozenset(self.refused_numbers) if self.refused_numbers else _NOBODY
        names = tuple(told)
        news = self.told_sets.get(names)
        if news is None:
            news = self.told_sets[names] = frozenset(told)
        if commands is None:
            now = Now(tick, dict(self.seen), news, refused, self.count)
        else:
            now = Now(tick, dict(self.seen), news, refused, self.count, *commands.told(self.told))
        self.news.clear()
        self.is_stirred = False
        if self.refused_numbers:
            self.refused_numbers = []
        if self.wake <= tick:
            self._wake_after(tick, ())
        is_first = self.code is None
        try:
            answer = self._call(now)
        except BaseException as problem:
            if isinstance(problem, KeyboardInterrupt) and WATCH.was_pressed:
                raise
            fault = failed(f"the reactor `{self.name}`", problem, self.files)
            said = str(fault).removeprefix(f"{self.folder.as_posix()}/")  # the same from wherever it is flown
            what = Reason(ReasonKind.RAISED, tick=tick, message=said, raised=self._place_of(fault))
            read = tuple(sorted(self.events.values()))
            return Failure("F7", what, self.internal, None, 0, causes=read)
        try:
            if is_first:
                self._check_wakes()
            if answer is not None:
                raise ValueError(f"its `tick` gave back a {type(answer).__name__}, and must give back nothing")
            self._take(now)
        except Exception as problem:
            what = Reason(ReasonKind.RAISED, tick=tick, message=str(problem))
            return Failure("F9", what, self.internal, None, 0)
        return None

    def _place_of(self, fault: UserCodeError) -> SourcePlace | None:
        """The line of its module that raised."""
        if fault.raised is None:
            return None
        name, line, text = fault.raised
        return SourcePlace(Path(name).as_posix().removeprefix(f"{self.folder.as_posix()}/"), line, 1, text)

    def _call(self, now: Now) -> object:
        """Call the code under watch; what it prints goes to standard error, since programs read standard output."""
        if self.code is None:
            WATCH.start()
        before, output = self.watch.begin(self.call), _SYS["stdout"]
        try:
            _SYS["stdout"] = _SYS["stderr"]
            if self.code is None:
                self.code = self.make()
            answer: object = self.code.tick(now)  # type: ignore[func-returns-value]  # so it says, and may not do
        finally:
            _SYS["stdout"] = output
            self.watch.end(self.call, before)
        return answer

    def _check_wakes(self) -> None:
        for name in self.wakes_on:
            if name not in self.external:
                raise ValueError(f"it wants to be woken by `{name}`, which it does not use")

    def _take(self, now: Now) -> None:
        """Check what the code has said; raises ValueError and its like for what makes no sense."""
        if not now.published and not now.asked and not now.recalled and not now.wakes and not now.declined:
            return
        said: dict[str, tuple[Published, Arguments]] = {}  # the last word on each timeline
        for one in now.published:
            if one.timeline not in self.internal:
                raise ValueError(f"it published on `{one.timeline}`, which it does not own")
            said[one.timeline] = one, self._arguments(one.timeline, one.predicate, one.arguments)
        for asked in now.asked:
            if asked.timeline not in self.external:
                raise ValueError(f"it asked for a token on `{asked.timeline}`, which it does not use")
            self._arguments(asked.timeline, asked.predicate, asked.arguments)
            _bounds(asked.start), _bounds(asked.end), _bounds(asked.duration)
        for number in now.recalled:
            if not 0 <= number < self.count + len(now.asked):
                raise ValueError(f"it took back request {number!r}, which it never made")
        for tick in now.wakes:
            if not isinstance(tick, int) or tick <= now.tick:
                raise ValueError(f"it wants to be woken at {tick!r}, which is not later than {now.tick}")
        for number, why in now.declined:
            if self.commands is None or number not in self.commands.waiting or not isinstance(why, str):
                raise ValueError(f"it declines command {number!r}, which does not wait")
            self.commands.decline(number, why, now.tick)
        if now.wakes:
            self._wake_after(now.tick, [min(tick, _NEVER) for tick in now.wakes])
        self.published = [(*each, self._begun(now.tick, *each)) for each in said.values()]
        self.turns = turns_of(now)
        self.count += len(now.asked)

    def _begun(self, tick: int, one: Published, arguments: Arguments) -> tuple[int, ...]:
        """The event of the command that has begun with what was published, if there is one."""
        return () if self.commands is None else self.commands.begin(tick, one.timeline, one.predicate, arguments)

    def _wake_after(self, tick: int, added: Iterable[int]) -> None:
        self.wakes = {wake for wake in self.wakes if wake > tick}.union(added)
        self.wake = min(self.wakes, default=_NEVER)

    def observations(self, tick: int) -> list[Observation]:
        """What the code has published."""
        found: list[Observation] = []
        if not self.published:
            return found
        causes = tuple(sorted(sorted(set(self.events.values()), reverse=True)[:_MOST_CAUSES]))
        for one, arguments, answered in self.published:
            behind = answered or causes
            event = self.trace.record(EventKind.OBSERVATION, self.name, one.timeline, one.predicate, arguments, behind)
            found.append(Observation(tick, one.timeline, one.predicate, arguments, event, self.name))
        self.published = []
        return found

    def _arguments(self, timeline: str, predicate: str, given: Mapping[str, Argument]) -> Arguments:
        kinds = self.kinds(timeline, predicate) or {}
        return tuple((name, _domain(name, value, kinds.get(name))) for name, value in given.items())

    def requests(self, tick: int) -> list[Request]:
        """What the code has asked for in this tick."""
        found: list[Request] = []
        if not self.turns:
            return found
        for one in self.turns.pop(0).asked:
            arguments = self._arguments(one.timeline, one.predicate, one.arguments)
            bounds = TimeBounds(_bounds(one.start), _bounds(one.end), _bounds(one.duration))
            number = len(self.trace.events)
            event = self.trace.record(
                EventKind.REQUEST, self.name, one.timeline, one.predicate, arguments, request=number, bounds=bounds
            )
            self.numbers[one.number] = number
            found.append(
                Request(
                    number,
                    one.timeline,
                    one.predicate,
                    arguments,
                    bounds.start,
                    bounds.end,
                    bounds.duration,
                    self.name,
                    event,
                )
            )
        return found

    def urgency(self, tick: int) -> float:
        """It decides nothing, and so comes last; whose place in the tick is on record comes there."""
        if not self.turns or self.turns[0].others < 0:
            return 0.0
        return inf if is_due(self.turns[0], self.trace, self.name) else -1.0

    def has_turns(self) -> bool:
        """Whether it has more to ask or take back in this tick."""
        return bool(self.turns)

    def open_requests(self) -> list[int]:
        """Numbers of the requests that were made and not taken back."""
        return list(self.numbers.values())

    def recalls(self) -> list[int]:
        """Numbers of the requests that the code takes back."""
        found: list[int] = []
        if not self.turns:
            return found
        for own in self.turns[0].recalled:
            number = self.numbers.pop(own, None)
            if number is not None:
                request = self.trace.events[number]
                self.trace.record(
                    EventKind.RECALL, self.name, request.timeline, request.predicate, request.arguments, request=number
                )
                found.append(number)
        return found

    def refusals(self) -> list[Refusal]:
        """What it was asked for and does not do."""
        found = self.given_up
        if found:
            self.given_up = []
        if self.commands is not None and self.commands.given_up:
            found = [*found, *self.commands.given_up]
            self.commands.given_up = []
        return found

    def open_goals(self) -> list[OpenGoal]:
        """Mandatory goals that were not achieved."""
        return [] if self.commands is None else self.commands.open_goals()

    def refused(self, refusal: Refusal) -> None:
        """Tell the code at the next tick."""
        for own, number in self.numbers.items():
            if number == refusal.request.number:
                self.refused_numbers.append(own)
                self.due = self.trace.tick + 1

    def recall(self, number: int) -> None:
        """Tell the code at the next tick."""
        if self.commands is not None:
            self.commands.recall(number)

    def accept(self, request: Request) -> None:
        """Keep a command for the next tick; who does not look ahead takes none."""
        if self.commands is not None:
            self.told[request.number] = {name: _shown(domain) for name, domain in request.arguments}
            self.commands.add(request)
            return
        event = self.trace.record(
            EventKind.REFUSE,
            self.name,
            request.timeline,
            request.predicate,
            request.arguments,
            (request.event,),
            request=request.number,
            reason=Reason(ReasonKind.NO_LOOKAHEAD),
        )
        self.given_up.append(Refusal(request, event))


def _shown_arguments(observation: Observation) -> dict[str, Argument]:
    """The arguments of an observation as users read them."""
    found: dict[str, Argument] = {}
    source = observation.source
    if source is not None:
        values = source.values_of(observation.token)
        for k, shape in enumerate(source.shapes_of(observation.token)):
            found[shape[0]] = values[k]
        return found
    for name, domain in observation.arguments:
        found[name] = _shown(domain)
    return found


def _shown(domain: DomainConstant) -> Argument:
    """A domain as users read it: a value, two bounds, or a set."""
    if domain.interval is not None:
        lower, upper = domain.interval
        return lower if lower == upper else (lower, upper)
    values = domain.values or ()
    return values[0] if len(values) == 1 else frozenset(values)


def _domain(name: str, value: object, kind: _Kind | None) -> DomainConstant:
    """What users say of an argument, as a domain; ValueError for what is none, or of another type than models have."""
    if isinstance(value, tuple) and len(value) == 2:
        lower, upper = _number(name, value[0]), _number(name, value[1])
        if lower > upper:
            raise ValueError(f"`{name}` is between {value!r}")
        return make_domain(*_typed(name, value, kind, ("float", "int")), (lower, upper), None)
    if isinstance(value, bool):
        return make_domain(*_typed(name, value, kind, ("bool",)), None, (value,))
    if isinstance(value, frozenset) and value:
        kinds: tuple[str, ...] = _NAMED if all(isinstance(each, str) for each in value) else ("int", "float", "bool")
        return make_domain(*_typed(name, value, kind, kinds), None, tuple(sorted(value, key=repr)))
    if isinstance(value, str):
        return make_domain(*_typed(name, value, kind, _NAMED), None, (value,))
    number = _number(name, value)
    of_real = ("float", "int") if number == int(number) else ("float",)
    found = _typed(name, value, kind, ("int", "float") if isinstance(value, int) else of_real)
    exact: int | float = int(number) if found[0] != "float" else number
    return make_domain(*found, (exact, exact), None)


def _typed(name: str, value: object, kind: _Kind | None, kinds: tuple[str, ...]) -> tuple[str, str]:
    """The kind and type of a parameter, which must be one of `kinds`; the first of them where no model tells it."""
    if kind is None:
        return (kinds[0], kinds[0])
    given = value if isinstance(value, frozenset) else (value,)
    if kind[0] not in kinds or (kind[2] and not set(kind[2]).issuperset(given)):
        known = f" ({', '.join(kind[2])})" if kind[2] else ""
        raise ValueError(f"`{name}` is {value!r}, which is no {kind[1]}{known}")
    return kind[:2]


def _number(name: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or isnan(value):
        raise ValueError(f"`{name}` is {value!r}, which is no value of a parameter")
    return float(max(-INFINITY, min(value, INFINITY)))


def _bounds(given: Ticks) -> tuple[int, int]:
    """Bounds of a time; raises ValueError or TypeError for what are none."""
    if given is None:
        return (-INFINITY, INFINITY)
    lower, upper = (given, given) if isinstance(given, int) else given
    if not isinstance(lower, int) or not isinstance(upper, int) or lower > upper:
        raise ValueError(f"{given!r} are no ticks")
    return (lower, upper)
