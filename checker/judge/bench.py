"""The judge's desk for one reactor: tokens by key, values of the model's variables, and what was found so far."""

from collections.abc import Callable

from checker.judge.report import Disagreement, Kind
from checker.judge.values import difference, hull
from nddl_lang.text.source import Span
from runtime.executive.record import NOBODY, ReactorRecord, TokenRecord, Value, ValueRange

Draw = Callable[[str, int], Value]  # parameter and tick in, value out; UNKNOWN where nothing is drawn


class Tok:
    """A token under judgement: its record, and its variables as values, in the order of the program."""

    __slots__ = ("is_cut", "key", "record", "standing", "values")

    def __init__(self, record: TokenRecord) -> None:
        self.record = record
        self.key = record.key
        self.standing = self
        self.is_cut = record.fate == "cut"
        self.values: list[Value] = [
            record.state.upper(),
            record.object,
            record.duration,
            record.start,
            record.end,
            *record.arguments,
        ]

    @property
    def name(self) -> str:
        """The token as reports name it."""
        return f"{self.record.predicate}#{self.key}"

    @property
    def is_planned(self) -> bool:
        """Whether the token is in the plan, by itself or as part of another."""
        return self.record.state in ("active", "merged")


class Bench:
    """Everything that is judged of one reactor."""

    def __init__(self, record: ReactorRecord, final_tick: int, draw: Draw, has_failed: bool = False) -> None:
        self.reactor = record.reactor
        self.record = record
        self.last_tick = record.last_tick
        self.final_tick = final_tick
        self.has_failed = has_failed  # what was undecided when the reactor failed is its failure, not an error
        self.draw = draw
        self.globals = record.globals
        self.members: dict[str, tuple[str, tuple[Value, ...]]] = {}
        self.by_class: dict[str, list[str]] = {}
        for thing in record.objects:
            self.members[thing.name] = (thing.class_name, thing.members)
        self.tokens = {one.key: Tok(one) for one in record.tokens}
        for tok in self.tokens.values():
            self._complete(tok)
        self.uses: list[tuple[Value, Value, Value, Value, Tok | None, Span]] = []  # resource, quantity, start, end
        self.infers = False  # whether runs that are not on record are found out
        self.told: frozenset[str] | None = None  # the classes of whose objects all tokens are known; None: all
        self.found: list[Disagreement] = []
        self.judged = 0
        self.open = 0
        self.skipped: dict[str, int] = {}

    def _complete(self, tok: Tok) -> None:
        """Let a merged token have the values of the one that stands for it; a token that goes on ends later."""
        seen = 0
        while tok.standing.record.merged_into != NOBODY and seen < 64:
            other = self.tokens.get(tok.standing.record.merged_into)
            if other is None:
                break
            tok.standing = other
            seen += 1
        if tok.standing is not tok:
            tok.values = tok.standing.values

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


def lasting(tok: Tok) -> Value:
    """How long a token lasts, from its times."""
    return difference(tok.values[4], tok.values[3])


def clock(bench: Bench, tok: Tok) -> Value:
    """What AGENT_CLOCK reads: now or later."""
    return ValueRange(tok.record.tick, bench.final_tick) if bench.final_tick > tok.record.tick else bench.final_tick
