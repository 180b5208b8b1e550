"""Which rules and branches missions exercise: programs and records in, numbers of features out; unexercised sites out.

A feature below `_EVENTS` is a site of a program: a rule that fired, or a branch of a guard that was taken. Those above
are kinds of events: what held, was asked for, refused or repaired on which timeline.
"""

import zlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from checker.batch.result import MissionResult
from checker.clock_guards import ClockGuards, clock_of
from checker.influence import Branch, branch_of
from checker.models import ModelSet
from checker.names import relative_name
from compiler.program import Guard, Instruction, ObjectLoop, Program, RuleCode
from nddl_lang.text.source import Span
from runtime.executive.columns import GuardOutline, RunColumns, TokenColumns
from runtime.executive.events import single_events
from runtime.executive.outcome import Event, EventKind, SourcePlace
from runtime.executive.record import BodyRun, GuardRun, MissionRecord, ReactorRecord

_EVENTS = 1 << 32
_TROUBLES = 1 << 33
_TOLD = (EventKind.REQUEST, EventKind.REFUSE, EventKind.REJECT, EventKind.RELAX, EventKind.KILL)


@dataclass(frozen=True, slots=True)
class _Branch:
    """A branch of a guard: its site, and the guards inside it, of which some stand in a loop over objects."""

    site: int
    guards: "tuple[_Fork, ...]"
    looped: int


@dataclass(frozen=True, slots=True)
class _Fork:
    """A guard; `is_looped` if it stands in a loop over objects."""

    then: _Branch
    otherwise: _Branch
    is_looped: bool


@dataclass(frozen=True, slots=True)
class Site:
    """A rule (`branch` empty), or the `then` or `else` of a guard; AGENT_CLOCK decides for none that `is_open`."""

    rule: str
    branch: str
    span: Span
    is_open: bool = False


class _Sites:
    """The sites of one program, numbered in the order of its text."""

    def __init__(self, program: Program, first: int) -> None:
        self.first = first
        self.sites: list[Site] = []
        self._clock = clock_of(program)
        self.rules = [self._rule(rule) for rule in program.rules]

    def _rule(self, rule: RuleCode) -> _Branch:
        site = self._add(Site(rule.predicate, "", rule.span))
        return _made(site, self._forks(rule.predicate, rule.body, ClockGuards(self._clock)))

    def _forks(
        self,
        rule: str,
        body: Sequence[Instruction],
        guards: ClockGuards,
        *,
        is_looped: bool = False,
        is_open: bool = False,
    ) -> Iterator[_Fork]:
        for each in body:
            guards.read(each)
            if isinstance(each, ObjectLoop):
                yield from self._forks(rule, each.body, guards, is_looped=True, is_open=is_open)
            elif isinstance(each, Guard):
                values = guards.of(each.condition)
                then, otherwise = (
                    self._branch(Site(rule, name, each.span, is_open or value not in values), part, guards)
                    for name, value, part in (("then", True, each.then), ("else", False, each.otherwise))
                )
                yield _Fork(then, otherwise, is_looped)

    def _branch(self, site: Site, body: Sequence[Instruction], guards: ClockGuards) -> _Branch:
        number = self._add(site)
        return _made(number, self._forks(site.rule, body, guards, is_open=site.is_open))

    def _add(self, site: Site) -> int:
        self.sites.append(site)
        return self.first + len(self.sites) - 1

    def note(self, run: BodyRun | RunColumns, at: _Branch, found: set[int]) -> None:
        """Add the sites that a run of a body, or that runs of it, reached."""
        found.add(at.site)
        forks, loops = at.guards, at.looped
        if not forks:
            return
        guards: Sequence[GuardRun | GuardOutline] = run.guards if isinstance(run, BodyRun) else run.outline.guards
        if loops:  # the guards of the loop stand once per object
            before = next(number for number, fork in enumerate(forks) if fork.is_looped)
            rounds = (len(guards) - (len(forks) - loops)) // loops
            forks = (*forks[:before], *forks[before : before + loops] * max(rounds, 0), *forks[before + loops :])
        for fork, guard in zip(forks, guards, strict=False):
            for branch, inner in _taken(fork, run, guard):
                if inner is None:
                    found.add(branch.site)
                else:
                    self.note(inner, branch, found)


def _made(site: int, forks: Iterator[_Fork]) -> _Branch:
    guards = tuple(forks)
    return _Branch(site, guards, sum(fork.is_looped for fork in guards))


def _taken(
    fork: _Fork, run: BodyRun | RunColumns, guard: GuardRun | GuardOutline
) -> tuple[tuple[_Branch, BodyRun | RunColumns | None], ...]:
    """The branches of a guard that were taken, and what ran there."""
    if isinstance(guard, GuardRun):
        if guard.branch == "then":
            return ((fork.then, guard.run),)
        return ((fork.otherwise, guard.run),) if guard.branch == "else" else ()
    assert isinstance(run, RunColumns)
    is_true = run.came_true(guard)
    sides = ((fork.then, guard.then, is_true), (fork.otherwise, guard.otherwise, ~is_true))
    # Which runs took a branch counts only where it has guards itself.
    return tuple([(at, run.branch(body, taken) if at.guards else None) for at, body, taken in sides if taken.any()])


class Universe:
    """The sites of all programs of an agent, in the order of its reactors; one program counts once."""

    def __init__(self, programs: Sequence[Program]) -> None:
        self.programs = tuple(programs)
        self._of: dict[int, _Sites] = {}
        for program in programs:
            if id(program) not in self._of:
                first = sum(len(each.sites) for each in self._of.values())
                self._of[id(program)] = _Sites(program, first)

    @property
    def sites(self) -> list[Site]:
        """All sites by number."""
        return [site for each in self._of.values() for site in each.sites]

    def features(self, record: MissionRecord, events: Sequence[Event]) -> tuple[int, ...]:
        """What a mission exercised, in order."""
        found: set[int] = set()
        for program, reactor in zip(self.programs, record.reactors, strict=False):
            sites = self._of[id(program)]
            for run in _runs(reactor):
                sites.note(run, sites.rules[run.rule], found)
        told = {
            (event.kind, event.reactor, event.timeline, event.predicate, event.stage)
            for event in single_events(events)
            if event.kind in _TOLD
        }
        numbers = {
            _number(_EVENTS if kind is EventKind.REQUEST else _TROUBLES, (kind.value, *names, str(stage or "")))
            for kind, *names, stage in told
        }
        for reactor in record.reactors:
            numbers |= {_number(_EVENTS, ("token", reactor.reactor, *pair)) for pair in _held(reactor)}
        return (*sorted(found), *sorted(numbers))


def _number(first: int, shape: tuple[str, ...]) -> int:
    """The feature for events of one shape."""
    return first + zlib.crc32("\0".join(shape).encode())


def is_event(feature: int) -> bool:
    """Whether a feature is a kind of event, whose number does not depend on what else the programs have."""
    return feature >= _EVENTS


def is_trouble(feature: int) -> bool:
    """Whether a feature is a refusal, a rejection, a repair or the end of a reactor: nobody asks for these."""
    return feature >= _TROUBLES


def _runs(reactor: ReactorRecord) -> Iterator[BodyRun | RunColumns]:
    """The runs of rules of a reactor; of tokens that are alike, one for all."""
    tokens = reactor.tokens
    bearers = tokens.groups if isinstance(tokens, TokenColumns) else tokens
    for bearer in bearers:
        yield from bearer.runs


def _held(reactor: ReactorRecord) -> set[tuple[str, str]]:
    """Which predicates began on which timelines."""
    tokens = reactor.tokens
    if not isinstance(tokens, TokenColumns):
        last = reactor.last_tick
        begun = {(one.object, one.predicate) for one in tokens if isinstance(one.start, int) and one.start <= last}
        return {(str(thing), predicate) for thing, predicate in begun}
    count = len(tokens.names)
    pairs = tokens.times.objects * count + tokens.times.predicates
    has_begun = tokens.times.starts <= reactor.last_tick
    if not has_begun.all():
        pairs = pairs[has_begun]
    pairs = np.flatnonzero(np.bincount(pairs))
    return {(tokens.names[pair // count], tokens.names[pair % count]) for pair in pairs.tolist()}


def left_out(behaviour: Sequence[int], other: Sequence[int]) -> int:
    """How many rules and branches one mission exercised and another, of the same models, did not."""
    return len({one for one in behaviour if not is_event(one)}.difference(other))


def branches_taken(programs: Sequence[Program], behaviour: Sequence[int]) -> frozenset[Branch]:
    """The branches that a mission took; `programs` are those of its reactors, in order."""
    exercised = set(behaviour)
    sites = enumerate(Universe(programs).sites)
    return frozenset(branch_of(one.span, one.branch) for number, one in sites if one.branch and number in exercised)


_KNOWN: list[Universe] = []  # the last one: a worker flies one set of programs


def universe_of(programs: Sequence[Program]) -> Universe:
    """The universe of these programs; kept for the next mission."""
    for one in _KNOWN:
        if len(one.programs) == len(programs) and all(a is b for a, b in zip(one.programs, programs, strict=True)):
            return one
    _KNOWN[:] = [Universe(programs)]
    return _KNOWN[0]


@dataclass(frozen=True, slots=True)
class SiteCoverage:
    """A site and in how many missions it was exercised; `is_reached`: its rule fired."""

    rule: str
    branch: str
    place: SourcePlace
    missions: int
    is_reached: bool


@dataclass(frozen=True, slots=True)
class Coverage:
    """The sites of the models in the order of their text."""

    missions: int
    sites: tuple[SiteCoverage, ...]

    @property
    def missed(self) -> tuple[SiteCoverage, ...]:
        """Sites that no mission exercised; of a rule that never fired, the rule alone."""
        return tuple(one for one in self.sites if not one.missions and (not one.branch or one.is_reached))


def coverage_of(models: ModelSet, results: Sequence[MissionResult]) -> Coverage:
    """How often each site was exercised in all missions that were flown to their end."""
    programs = [models.programs[reactor.model] for reactor in models.agent.reactors]
    counts: dict[int, int] = {}
    flown = [result.outcome for result in results if result.outcome is not None]
    for outcome in flown:
        for feature in outcome.behaviour:
            counts[feature] = counts.get(feature, 0) + 1
    found: dict[tuple[str, int, str], SiteCoverage] = {}
    fired = 0
    for number, site in enumerate(Universe(programs).sites):
        count = counts.get(number, 0)
        fired = fired if site.branch else count
        if site.is_open and not count:
            continue
        source = site.span.source
        line, column = source.locate(site.span.begin)
        text = site.span.text.split("\n")[0]
        place = SourcePlace(relative_name(source.name, Path(models.agent.root)), line, column, text)
        key = (place.file, site.span.begin, site.branch)  # a file that several models include counts once
        known = found.get(key)
        if known is None or known.missions < count:
            found[key] = SiteCoverage(site.rule, site.branch, place, count, fired > 0)
    return Coverage(len(flown), tuple(found.values()))
