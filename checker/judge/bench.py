"""The judge's desk for one reactor: tokens by key, values of the model's variables, and what was found so far."""

from collections.abc import Callable, Iterable, Iterator, Sequence

import numpy as np

from checker.judge.columns import Array
from checker.judge.report import Disagreement, Kind, ResourceProfile
from checker.judge.values import UNKNOWN, difference, hull, is_open
from nddl_lang.text.source import Span
from runtime.executive.columns import TokenColumns
from runtime.executive.record import BodyRun, ReactorRecord, TokenRecord, Value, ValueRange

_Draws = Callable[[str, Array], Array | None]  # parameter and ticks in, values out; None where nothing is drawn
_DEEPEST = 64  # merged into what is merged into ...


class Tok:
    """A token under judgement: its record, and its variables as values, in the order of the program."""

    __slots__ = ("is_cut", "key", "record", "standing", "values")

    def __init__(self, record: TokenRecord) -> None:
        key, _, thing, state, duration, start, end, arguments, _, _, fate, _, _ = record
        self.record = record
        self.key = key
        self.standing = self
        self.is_cut = fate == "cut"
        self.values: list[Value] = [state, thing, duration, start, end, *arguments]

    @property
    def name(self) -> str:
        """The token as reports name it."""
        return f"{self.record.predicate}#{self.key}"

    @property
    def is_outdated(self) -> bool:
        """Whether its values are of an earlier plan than those of what was still there when the mission ended."""
        return self.is_cut or self.standing.is_cut

    @property
    def is_planned(self) -> bool:
        """Whether the token is in the plan, by itself or as part of another."""
        return self.record.state in ("active", "merged")


class _Toks:
    """The tokens of a record by key, each made when it is first asked for."""

    def __init__(self, tokens: Sequence[TokenRecord]) -> None:
        self._tokens = tokens
        self._keys: Array | None = tokens.times.keys if isinstance(tokens, TokenColumns) else None  # in order
        self.by_key = {} if self._keys is not None else {one.key: one for one in tokens}  # those listed one by one
        self._on: dict[Value, list[TokenRecord]] | None = None  # by object
        self._made: dict[int, Tok] = {}

    def get(self, key: int) -> Tok | None:
        """The token with a key; None if there is none."""
        known = self._made.get(key)
        if known is None and (record := self._record(key)) is not None:
            known = self._made[key] = Tok(record)
            self._complete(known)
        return known

    def _record(self, key: int) -> TokenRecord | None:
        if self._keys is None:
            return self.by_key.get(key)
        found = int(self._keys.searchsorted(key))
        return self._tokens[found] if found < len(self._keys) and self._keys[found] == key else None

    def records(self) -> Iterator[TokenRecord]:
        """What is on record of all tokens; of several with one key the last."""
        return iter(self._tokens if self._keys is not None else self.by_key.values())

    def named(self, predicate: str) -> Iterator[TokenRecord]:
        """What is on record of the tokens of all predicates of a short name."""
        if isinstance(self._tokens, TokenColumns):
            return map(self._tokens.__getitem__, self._tokens.named(predicate))
        return (one for one in self.records() if one.predicate.rpartition(".")[2] == predicate)

    def on(self, thing: str) -> Iterator[TokenRecord]:
        """What is on record of the tokens of an object."""
        if isinstance(self._tokens, TokenColumns):
            return map(self._tokens.__getitem__, self._tokens.on(thing))
        if self._on is None:
            self._on = {}
            for one in self.records():
                self._on.setdefault(one.object, []).append(one)
        return iter(self._on.get(thing, ()))

    def of(self, records: Iterable[TokenRecord]) -> Iterator[Tok]:
        """Tokens of the record."""
        for record in records:
            tok = self.get(record.key)
            assert tok is not None
            yield tok

    def _complete(self, tok: Tok) -> None:
        """Let a merged token have the values of the one that stands for it; a token that goes on ends later."""
        last = tok.record
        for _ in range(_DEEPEST):
            other = self._record(last.merged_into)
            if other is None:
                break
            last = other
        if last is not tok.record:
            standing = self._made.get(last.key)
            if standing is None:
                standing = self._made[last.key] = Tok(last)
            tok.standing = standing
            tok.values = standing.values


RuleUse = tuple[Value, Value, Value, Value, Tok | None, Span]  # resource, quantity, start, end, user, line


class Bench:
    """Everything that is judged of one reactor."""

    def __init__(self, record: ReactorRecord, final_tick: int, draws: _Draws, has_failed: bool = False) -> None:
        self.reactor = record.reactor
        self.record = record
        self.last_tick = record.last_tick
        self.final_tick = final_tick
        self.has_failed = has_failed  # what was undecided when the reactor failed is its failure, not an error
        self.draws = draws
        self.globals = record.globals
        self.members: dict[str, tuple[str, tuple[Value, ...]]] = {}
        self.by_class: dict[str, list[str]] = {}
        for thing in record.objects:
            self.members[thing.name] = (thing.class_name, thing.members)
        self.tokens = _Toks(record.tokens)
        self.uses: list[RuleUse] = []
        self.leaves_variables = False  # whether a solver's table may leave variables undecided
        self.last_repair = -1  # the tick of the last one
        self.infers = False  # whether runs that are not on record are found out
        self.runs: dict[int, list[BodyRun]] = {}  # those that were
        self.told: frozenset[str] | None = None  # the classes of whose objects all tokens are known; None: all
        self.is_whole = False  # whether nothing comes after what is known
        self.found: list[Disagreement] = []
        self.profiles: list[ResourceProfile] = []
        self.judged = 0
        self.open = 0
        self.skipped: dict[str, int] = {}

    def draw(self, parameter: str, tick: int) -> Value:
        """The value of a parameter for a token that begins at `tick`; UNKNOWN where nothing is drawn."""
        values = self.draws(parameter, np.array([tick]))
        return UNKNOWN if values is None else float(values[0])

    def skip(self, reason: str, count: int = 1) -> None:
        """Count something that is not judged."""
        self.skipped[reason] = self.skipped.get(reason, 0) + count

    def weigh(self, answer: bool | None) -> bool:
        """Count one judgement; False where it is a disagreement, which the caller reports."""
        if answer is None:
            self.open += 1
        else:
            self.judged += 1
        return answer is not False

    def report(
        self,
        kind: Kind,
        name: str,
        tokens: tuple[Tok, ...],
        values: tuple[tuple[str, Value], ...],
        held: str,
        found: str,
        span: Span | None = None,
        is_breach: bool = False,
    ) -> None:
        """Note a disagreement."""
        named = tuple(tok.name for tok in tokens)
        self.found.append(Disagreement(kind, self.reactor, name, named, values, held, found, span, is_breach))

    def is_over(self, tok: Tok) -> bool:
        """Whether a token had ended when the mission did."""
        ends = hull(tok.values[4])
        return ends is not None and ends[1] <= self.last_tick

    def has_begun(self, tok: Tok) -> bool:
        """Whether a token had begun before the last tick."""
        starts = hull(tok.values[3])
        return starts is not None and starts[1] < self.last_tick


def _lasting(tok: Tok) -> Value:
    """How long a token lasts, from its times."""
    return difference(tok.values[4], tok.values[3])


def duration_of(tok: Tok) -> Value:
    """The duration of a token: from its times where these are fixed, else as it is on record."""
    length = _lasting(tok)
    return tok.values[2] if is_open(length) and not is_open(tok.values[2]) else length


def clock(bench: Bench, tok: Tok) -> Value:
    """What AGENT_CLOCK reads: now or later."""
    return ValueRange(tok.record.tick, bench.final_tick) if bench.final_tick > tok.record.tick else bench.final_tick
