"""Certify a mission over its whole box: a proof that no value breaks it, or a point at which it is flown and fails.

Counterexample-guided: a flight gives a structure, and its conditions on the sampled values (checker/proofs/dating.py).
z3 looks for a point of the box that breaks the conditions of every structure seen so far. There is none: certified.
There is one: it is flown. If it fails, that is the refutation; if not, the mission went another way, which is one more
structure. Nothing is refuted without a flight.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import combinations
from pathlib import Path

import z3

from checker.limits import Limits
from checker.losses import losses_of
from checker.names import relative_name
from checker.proofs.box import Box, Point, box_of
from checker.proofs.claims import Claim, Number
from checker.proofs.dating import Dated, Requirement, dated
from checker.proofs.intervals import Ranges
from checker.proofs.operands import decimal, rational
from checker.proofs.solving import fraction
from checker.proofs.structure import Structure, structure_of
from compiler.program import Program
from nddl_lang.text.source import Span
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.outcome import Outcome
from runtime.executive.record import MissionRecord

_Fly = Callable[[Point], tuple[Outcome, MissionRecord, bool]]  # the last one: the mission passes
_EFFORT = 40_000_000  # of one question, in z3's own unit; some seconds
_MOST_STRUCTURES = 24
_MOST_CORNERS = 64
_NUDGES = 3
_MOST_DRAWN = 8
MOST_TOKENS = 10_000  # of a flight that is told to z3; some half a minute
_UNSEEN = "but for points within a billionth of a limit, where doubles round"


class Certainty(Enum):
    """What was found."""

    CERTIFIED = "certified"
    REFUTED = "refuted"
    UNKNOWN = "unknown"


@dataclass(frozen=True, eq=False, slots=True)
class Certificate:
    """The answer, with what it rests on.

    `point` fails when flown, by `outcome`; `lines` are those that z3 finds broken there, `subset` the smallest set of
    parameters that has to leave `base`, a point that passes, for that (`is_smallest`: proved for the structures).
    """

    certainty: Certainty
    structures: int
    conditions: int
    flights: int
    point: Point | None = None
    outcome: Outcome | None = None
    lines: tuple[Span, ...] = ()
    subset: tuple[str, ...] = ()
    is_smallest: bool = False
    base: Point | None = None
    why: str = ""  # it is unknown
    open: int = 0
    untold: tuple[tuple[str, int], ...] = ()
    unproved: tuple[str, ...] = ()  # properties that are no part of the proof
    limits: Limits = ()  # of [check], which the outcome may exceed
    repaired: int = 0  # flights that pass after a plan was repaired


class Certifier:
    """One mission, and the structures of its flights so far."""

    def __init__(
        self,
        agent: AgentConfiguration,
        programs: Sequence[Program],
        fly: _Fly,
        effort: int = _EFFORT,
        limits: Limits = (),
    ) -> None:
        self.agent = agent
        self.programs = programs
        self.fly = fly
        self.effort = effort
        self.limits = limits
        self.box: Box = box_of(agent)
        self.structures: list[Structure] = []
        self.dated: list[Dated] = []
        self.base: Point | None = None
        self.flights = 0
        self.repaired = 0
        self.excess = ""  # why a flight that passes has given no structure

    # ---- the whole box ----

    def certify(self, corners: bool = True, *, rules_only: bool = False) -> Certificate:
        """Prove or refute that the mission passes in the whole box; `rules_only` leaves its properties out."""
        if self.box.computed:
            return self._unknown(f"`{self.box.computed[0]}` is computed from other parameters")
        if self.agent.coded:
            return self._unknown(f"`{self.agent.coded[0].name}` is written in Python")
        for point in self._first_points(corners):
            failed = self._flown(point)
            if failed is not None:
                return self._refuted(point, failed)
        seen: list[Point] = []
        while len(self.structures) <= _MOST_STRUCTURES:
            if self.excess:
                return self._unknown(self.excess)
            answer = self.broken(self.box.sides, avoiding=seen)
            if answer is None:
                return self._unknown("z3 gave up within its limit")
            if not answer:
                return self._held(bool(seen), rules_only)
            point = answer[0]
            if len(answer) > 1:
                return self._unknown("only draws that differ within a mission break a condition; these cannot be given")
            known = len(self.structures)
            failed = self._flown(point)
            if failed is not None:
                return self._refuted(point, failed)
            if self._is_still_broken(point) or len(self.structures) == known:
                seen.append(point)
                if len(seen) > _NUDGES:
                    return self._unknown(
                        "missions pass at points that break a condition: it is no more than sufficient"
                    )
        return self._unknown(f"after {len(self.structures)} structures there are more")

    def _held(self, has_gaps: bool, rules_only: bool) -> Certificate:
        """Every condition holds; is that all that is asked?"""
        for structure in self.structures:
            for name, span in structure.silent.items():
                return self._unknown(f"z3 cannot be told what `{name}` means{self._at(span)}")
            for _, span in structure.lost.items():
                what = f"`{' '.join(span.text.split())}`" if span is not None else "a line"
                why = "is about a token that a flight has no times of, as where a repair cut it off"
                return self._unknown(f"{what}{self._at(span)} {why}; nothing is proved of it")
        unproved = tuple(each.name for each in self.agent.properties)
        if unproved and not rules_only:
            why = "the rules hold, but the mission file's properties are not part of the proof"
            return self._unknown(f"{why} (`--rules-only` leaves them out)")
        return self._answer(Certainty.CERTIFIED, why=_UNSEEN if has_gaps else "", unproved=unproved)

    def _at(self, span: Span | None) -> str:
        """Where a line stands, in brackets."""
        if span is None:
            return ""
        name = relative_name(span.source.name, Path(self.agent.root))
        return f" ({name}:{span.source.locate(span.begin)[0]})"

    def find_structure(self) -> bool:
        """Fly the middle of the box, else points drawn evenly, until a mission passes; whether there is a structure."""
        points = (self.box.middle(), *self.box.drawn(_MOST_CORNERS, 0))
        return any(self._flown(point) is None for point in points) and bool(self.structures)

    def records_over_the_box(self) -> Iterator[tuple[Point, MissionRecord, bool]]:
        """Fly the middle, the corners (up to 64) and 8 points drawn evenly: what was executed, and if it passed."""
        for point in self._first_points(True):
            _, record, passes = self.fly(point)
            self.flights += 1
            yield point, record, passes

    def structure(self, point: Point, record: MissionRecord) -> tuple[Structure, Dated]:
        """The structure of what was executed at a point."""
        structure = structure_of(self.agent, self.programs, record)
        for name, variables in structure.draws.items():
            structure.values.update(dict.fromkeys(variables, point[name]))
        return structure, dated(structure)

    def _first_points(self, corners: bool) -> Iterator[Point]:
        yield self.box.middle()
        if corners and 2 ** len(self.box.sides) <= _MOST_CORNERS:
            yield from self.box.corners()
        if corners:
            yield from self.box.drawn(_MOST_DRAWN, 0)

    def _flown(self, point: Point) -> Outcome | None:
        """Fly a point; the outcome if it fails. What passes gives a structure."""
        outcome, record, passes = self.fly(point)
        self.flights += 1
        if not passes:
            return outcome
        self.repaired += bool(losses_of(outcome).repairs)
        if self.base is None:
            self.base = point
        if self.structures and not self._is_still_broken(point):
            return None
        count = sum(len(each.tokens) for each in record.reactors)
        if count > MOST_TOKENS:
            self.excess = f"a flight has {count} tokens, more than the {MOST_TOKENS} that are followed"
            return None
        structure, found = self.structure(point, record)
        if not any(_same(found, other) for other in self.dated):
            self.structures.append(structure)
            self.dated.append(found)
        return None

    def _is_still_broken(self, point: Point) -> bool:
        """Whether a point breaks a condition of each structure, in exact arithmetic."""
        return all(
            any(self._broken_by(found.conditions, structure, point))
            for structure, found in zip(self.structures, self.dated, strict=True)
        )

    def _broken_by(
        self, conditions: Sequence[Requirement], structure: Structure, point: Point
    ) -> Iterator[Requirement]:
        """The conditions of a structure that a point breaks; z3 is asked only where ranges of one value do not tell."""
        drawn = {name: point[parameter] for parameter, names in structure.draws.items() for name in names}
        ranges = Ranges({name: (decimal(value),) * 2 for name, value in drawn.items()})
        pairs: list[tuple[Number, Number]] = []
        for one in conditions:
            if not ranges.holds(one.claim):
                pairs = pairs or [(z3.Real(name), rational(value)) for name, value in drawn.items()]
                if not z3.is_true(z3.simplify(z3.substitute(one.claim, *pairs))):
                    yield one

    def broken(
        self,
        free: Mapping[str, object],
        *,
        avoiding: Sequence[Point] = (),
        conditions: Sequence[Sequence[Claim]] | None = None,
    ) -> tuple[Point, ...] | None:
        """A point that breaks each structure while only `free` leaves the base; () if there is none, None: unknown.

        Two points where only different draws of one parameter within a mission do. `conditions` stand in place of
        those of the structures.
        """
        claims = conditions or [[each.claim for each in found.conditions] for found in self.dated]
        ranges = self.ranges(free)
        draws: dict[str, dict[str, Number]] = {name: {} for name in self.box.sides}
        solver = z3.Solver()
        solver.set("rlimit", self.effort)
        for structure, found in zip(self.structures, claims, strict=True):
            doubtful = self._doubtful(found, ranges)
            if not doubtful:
                return ()
            solver.add(z3.Or(*[z3.Not(each) for each in doubtful]))
            for name, drawn in structure.draws.items():
                draws[name].update((each, z3.Real(each)) for each in drawn)
        equalities = []
        for name, numbers in draws.items():
            whole = z3.Real(f"sampled {name}")
            for each in numbers.values():
                solver.add(self.box.claim(name, each))
                equalities.append(each == whole)
            solver.add(self.box.claim(name, whole))
            if name not in free and self.base is not None:
                solver.add(whole == rational(self.base[name]))
        for point in avoiding:
            solver.add(z3.Or(*[self._apart(name, value) for name, value in point.items()]))
        apart = solver.check()
        if apart == z3.unsat:
            return ()
        solver.add(*equalities)
        ends = [self.box.ends(name, z3.Real(f"sampled {name}")) for name in free]
        for extra in ([*ends], []):
            answer = solver.check(*extra)
            if answer == z3.sat:
                return (self._point(solver.model()),)
        return None if z3.unknown in (answer, apart) else ({}, {})

    def ranges(self, free: Mapping[str, object] | None = None, others: Sequence[Structure] = ()) -> Ranges:
        """The ranges of the sampled values, also of `others`, while only some parameters (None: all) are free."""
        sides = {}
        for structure in (*self.structures, *others):
            for name, drawn in structure.draws.items():
                lower, upper = self.box.range(name)
                if free is not None and name not in free and self.base is not None:
                    lower = upper = decimal(self.base[name])
                sides.update(dict.fromkeys(drawn, (lower, upper)))
        return Ranges(sides)

    def _doubtful(self, claims: Sequence[Claim], ranges: Ranges) -> list[Claim]:
        """The claims that may fail somewhere in the box, as far as intervals tell; the others hold in all of it."""
        return [each for each in claims if not ranges.holds(each)]

    def _apart(self, name: str, value: float) -> Claim:
        side = self.box.sides[name]
        margin = max(side.upper - side.lower, 1.0) * 1e-9
        number = z3.Real(f"sampled {name}")
        return z3.Or(
            number < z3.Q(*float(value - margin).as_integer_ratio()),
            number > z3.Q(*float(value + margin).as_integer_ratio()),
        )

    def _point(self, model: "z3.ModelRef") -> Point:
        found: Point = {}
        for name in self.box.sides:
            value = model.eval(z3.Real(f"sampled {name}"), model_completion=True)
            exact = fraction(value) if not z3.is_algebraic_value(value) else value.approx(20).as_fraction()
            assert exact is not None
            found[name] = self.box.nearest(name, exact)
        return found

    # ---- the answer ----

    def _refuted(self, point: Point, outcome: Outcome) -> Certificate:
        if self.base is None:
            self.find_structure()
        subset, is_smallest, failing, failed = self._smallest(point, outcome)
        lines = self._lines(failing)
        return self._answer(
            Certainty.REFUTED,
            point=failing,
            outcome=failed,
            lines=lines,
            subset=subset,
            is_smallest=is_smallest,
        )

    def _smallest(self, point: Point, outcome: Outcome) -> tuple[tuple[str, ...], bool, Point, Outcome]:
        """The smallest set of parameters whose values make it fail, the others as in a mission that passes."""
        names = tuple(self.box.sides)
        if self.base is None or not self.structures:
            return names, False, point, outcome
        is_proved = True
        for size in range(1, len(names)):
            for subset in combinations(names, size):
                answer = self.broken(dict.fromkeys(subset))
                if answer == ():
                    continue
                if answer is None or len(answer) > 1:
                    is_proved = False
                    continue
                known = len(self.structures)
                failed = self._flown(answer[0])
                if failed is not None:
                    return subset, is_proved, answer[0], failed
                is_proved = False if len(self.structures) == known else is_proved
        return names, is_proved, point, outcome

    def _lines(self, point: Point) -> tuple[Span, ...]:
        """The lines that a point breaks, in the structure that it breaks least."""
        best: list[Span] | None = None
        for structure, found in zip(self.structures, self.dated, strict=True):
            told = [one for one in found.conditions if one.demand.span is not None and not one.demand.is_structure]
            broken = [one.demand.span for one in self._broken_by(told, structure, point) if one.demand.span is not None]
            if best is None or len(broken) < len(best):
                best = broken
        return tuple(dict.fromkeys(best or ()))

    def _unknown(self, why: str) -> Certificate:
        return self._answer(Certainty.UNKNOWN, why=why)

    def _answer(
        self,
        certainty: Certainty,
        *,
        point: Point | None = None,
        outcome: Outcome | None = None,
        lines: tuple[Span, ...] = (),
        subset: tuple[str, ...] = (),
        is_smallest: bool = False,
        why: str = "",
        unproved: tuple[str, ...] = (),
    ) -> Certificate:
        untold: dict[str, int] = {}
        for structure in self.structures:
            untold |= structure.untold
        return Certificate(
            certainty,
            len(self.structures),
            sum(len(found.conditions) for found in self.dated),
            self.flights,
            point,
            outcome,
            lines,
            subset,
            is_smallest,
            self.base,
            why,
            sum(found.open for found in self.dated),
            tuple(sorted(untold.items())),
            unproved,
            self.limits,
            self.repaired,
        )


def _same(one: Dated, other: Dated) -> bool:
    """Whether two structures have the same conditions."""
    return len(one.conditions) == len(other.conditions) and all(
        a.claim.eq(b.claim) for a, b in zip(one.conditions, other.conditions, strict=True)
    )
