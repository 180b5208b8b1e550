"""Judge timelines: one token at a time, nothing left out, and what the owner published is what its users hold."""

from math import inf

from checker.judge.bench import Bench, Tok
from checker.judge.bulk_timelines import BulkTimelines, History, Publications
from checker.judge.operands import domain_value
from checker.judge.plain_timelines import PlainTimelines
from checker.judge.tables import Tables
from checker.judge.tokens import ProgramJudge
from checker.judge.values import hull, may_be_equal
from compiler.program import END, FIRST_PARAMETER, START
from runtime.executive.outcome import Event
from runtime.executive.record import Value

_UNDEFINED = "undefined"
_GAPLESS = "something holds at every tick"


def _sequences(judge: ProgramJudge, bench: Bench, timelines: set[str]) -> dict[str, list[Tok]]:
    """The tokens that have begun on some timelines, in order."""
    found: dict[str, list[Tok]] = {}
    active = (one for line in sorted(timelines) for one in bench.tokens.on(line) if one.state == "active")
    for tok in bench.tokens.of(active):
        start, thing = tok.record.start, tok.record.object
        if not isinstance(start, int) or start > bench.last_tick:
            continue
        if start < 0 and (ends := hull(tok.values[END])) is not None and ends[1] <= 0:
            continue  # what the script tells of the time before the mission
        if isinstance(thing, str) and bench.members.get(thing, ("",))[0] in judge.timelines:
            found.setdefault(thing, []).append(tok)
    for timeline, tokens in found.items():
        found[timeline] = sorted(_not_replaced(tokens), key=_when)
    return found


def _not_replaced(tokens: list[Tok]) -> list[Tok]:
    """Without what a repair took away and was put back as another token, which a later repair may have taken, too."""
    if not any(tok.is_cut for tok in tokens):
        return tokens
    last: dict[Value, float] = {}  # by start: when the last of the tokens left the plan, infinite if none took it
    for tok in tokens:
        left = tok.record.tick if tok.is_cut else inf
        last[tok.record.start] = max(left, last.get(tok.record.start, left))
    return [tok for tok in tokens if not tok.is_cut or tok.record.tick == last[tok.record.start]]


def _when(tok: Tok) -> tuple[int, float, int]:
    start, last = tok.record.start, tok.record.end
    assert isinstance(start, int)
    if isinstance(last, int):
        return start, last, tok.key
    end = hull(last)
    return start, end[1] if end is not None else start, tok.key


def judge_timelines(
    judge: ProgramJudge,
    bench: Bench,
    tables: Tables | None,
    history: History,
    internal: tuple[str, ...],
    external: tuple[str, ...],
) -> None:
    """Judge all timelines of a reactor; those that plainly are right at once."""
    shared = (*internal, *external)
    past = {line: history.get(line, Publications()) for line in shared}
    bulk = PlainTimelines(bench, judge.timelines) if tables is None else BulkTimelines(bench, tables, judge.timelines)
    in_order = {timeline for timeline in bulk.rows if bulk.is_in_order(timeline, timeline in shared)}
    told = {line for line in shared if bulk.is_told(line, past[line], judge.codes, line in internal)}
    left = {*(set(bulk.rows) - in_order), *(set(shared) - told)}
    if not left:
        return
    found = _sequences(judge, bench, left)
    published = {line: past[line].events(bench.last_tick) for line in shared if line in left}
    for timeline, events in published.items():
        ticks = {one.tick for one in events}
        found[timeline] = [tok for tok in found.get(timeline, ()) if not _is_only_planned(tok, ticks)]
    for timeline, tokens in found.items():
        if timeline not in in_order:
            _judge_order(bench, timeline, tokens, timeline in shared)
    for timeline in shared:
        if timeline not in told:
            _judge_observations(judge, bench, timeline, found[timeline], published[timeline], timeline in internal)


def _is_only_planned(tok: Tok, published: set[int]) -> bool:
    """Whether a repair took a token out of the plan by the tick at which it was to begin, and nobody began it."""
    start = tok.record.start
    assert isinstance(start, int)
    return tok.is_cut and (tok.record.tick < start or (tok.record.tick == start and start not in published))


def _judge_order(bench: Bench, timeline: str, tokens: list[Tok], is_shared: bool) -> None:
    """Tokens of a timeline follow each other; on a shared one without a gap."""
    before: Tok | None = None
    for tok in tokens:
        bench.judged += 1
        if before is not None and not is_cut_short(before):
            start = tok.values[START]
            if before.values[END] == start:
                before = tok
                continue
            ends = hull(before.values[END])
            assert isinstance(start, int)
            if ends is not None:
                values = ((f"{before.name}.end", before.values[END]), (f"{tok.name}.start", start))
                if ends[0] > start:
                    bench.report("overlap", timeline, (before, tok), values, "one after the other", "both at once")
                elif is_shared and ends[1] < start:
                    bench.report("gap", timeline, (before, tok), values, _GAPLESS, "nothing does")
        before = tok
    if before is not None and is_shared and not is_cut_short(before):
        ends = hull(before.values[END])
        if ends is not None and ends[1] <= bench.last_tick:
            values = ((f"{before.name}.end", before.values[END]), ("last tick", bench.last_tick))
            bench.report("gap", timeline, (before,), values, _GAPLESS, "nothing does")


def is_cut_short(tok: Tok) -> bool:
    """Whether a repair took a token away before its end, which then is not known."""
    end = tok.record.end
    return tok.is_cut and not (isinstance(end, int) and end <= tok.record.tick)


def _judge_observations(
    judge: ProgramJudge, bench: Bench, timeline: str, tokens: list[Tok], published: list[Event], is_own: bool
) -> None:
    """Every token begins with a publication, and every publication begins a token with what was published."""
    begun: dict[int, Tok] = {}
    for tok in tokens:
        start = tok.record.start
        assert isinstance(start, int)
        if not tok.is_cut or start not in begun:
            begun[start] = tok
    told = {one.tick: one for one in published}
    seen = told if is_own else _observed(bench, timeline)
    for tick, one in told.items():
        bench.judged += 1
        held = begun.get(tick)
        if held is None:
            values: tuple[tuple[str, Value], ...] = (("tick", tick), ("published", one.predicate))
            bench.report("observation", timeline, (), values, "nothing begins", f"{one.reactor} published it")
        elif not _agrees(judge, held, one, is_own):
            values = (("tick", tick), ("published", one.predicate), *_told(one))
            bench.report("observation", timeline, (held,), values, held.record.predicate, one.predicate)
        elif tick not in seen:
            values = (("tick", tick), ("published", one.predicate))
            bench.report("observation", timeline, (held,), values, "it begins", "nobody observed it here")
    for tick, tok in begun.items():
        if tick not in told:
            bench.report("observation", timeline, (tok,), (("tick", tick),), "it begins", "nobody published it")


def _observed(bench: Bench, timeline: str) -> set[int]:
    """The ticks at which a reactor took note of something on a timeline of another."""
    return {
        one.start
        for one in bench.tokens.on(timeline)
        if one.origin == "observation" and one.state in ("active", "merged")
        if isinstance(one.start, int)
    }


def _agrees(judge: ProgramJudge, tok: Tok, one: Event, is_own: bool) -> bool:
    """Whether a token holds what was published; what a user's model has no place for is `undefined` there."""
    held = tok.record.predicate.rpartition(".")[2]
    if held != one.predicate:
        return held == _UNDEFINED and not is_own and not _fits(judge, tok, one)
    if not one.arguments:
        return True
    parameters = judge.predicates[tok.record.predicate].code.parameters
    indices = {parameter.name: k for k, parameter in enumerate(parameters)}
    return all(
        name not in indices or may_be_equal(tok.values[FIRST_PARAMETER + indices[name]], domain_value(domain))
        for name, domain in one.arguments
    )


def _fits(judge: ProgramJudge, tok: Tok, one: Event) -> bool:
    """Whether the user's model certainly has a place for what was published."""
    class_name = tok.record.predicate.rpartition(".")[0]
    known = judge.predicates.get(f"{class_name}.{one.predicate}")
    return known is not None and not one.arguments


def _told(one: Event) -> tuple[tuple[str, Value], ...]:
    return tuple((name, domain_value(domain)) for name, domain in one.arguments)
