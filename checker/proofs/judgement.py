"""A record in, z3's judgement of it out: the demands of the model that its values do not satisfy.

What the model demands is read off its text (`structure`); nothing of the engine is asked, nor of the judge's
evaluation. Whole numbers, names and truth values are those of the record, a real lies within the tolerance of it.
Demands that share an open value, or a part of an expression, are asked about together.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import PurePath
from typing import Any

import z3

from checker.judge.rendering import place_text, statement_of, value_text
from checker.judge.values import slack
from checker.proofs.claims import Claim, Number
from checker.proofs.demands import Demand
from checker.proofs.operands import name_of, rational, variables_of
from checker.proofs.structure import Structure, structure_of
from compiler.program import Program
from runtime.executive.configuration import AgentConfiguration
from runtime.executive.record import MissionRecord, Value

_EFFORT = 20_000_000  # of one question, in z3's own unit; a second or two


@dataclass(frozen=True, slots=True)
class BrokenDemand:
    """Demands of one place of a model that the values of a record do not satisfy together."""

    demand: Demand
    values: tuple[tuple[str, Value], ...]


@dataclass(frozen=True, slots=True)
class ProvedJudgement:
    """What z3 found: `holds` demands hold, `undecided` ones it gave up; `untold` counts what has no translation."""

    broken: tuple[BrokenDemand, ...]
    holds: int
    undecided: int
    untold: tuple[tuple[str, int], ...]


def prove_record(
    agent: AgentConfiguration, programs: Sequence[Program], record: MissionRecord, draws: Mapping[str, float]
) -> ProvedJudgement:
    """Have z3 judge the values of a record; `draws` are those of sampled parameters, by name."""
    ends = [one.end for each in record.reactors for one in each.tokens if isinstance(one.end, int)]
    # What holds when a mission ends may have its end later: no line of a model says when that is.
    timeless = replace(agent, final_tick=max([agent.final_tick, *ends]))
    return _judge(structure_of(timeless, programs, record), draws)


def _judge(structure: Structure, draws: Mapping[str, float]) -> ProvedJudgement:
    known = dict(structure.values) | {f"sampled {name}": value for name, value in draws.items()}
    asked = _Asked(structure, known)
    left = [demand for demand in structure.demands if not asked.is_plain(demand)]
    holds, undecided = len(structure.demands) - len(left), 0
    broken: list[BrokenDemand] = []
    for part in asked.parts(left):
        answer, core = asked.check(part)
        if answer == z3.sat:
            holds += len(part)
        elif answer == z3.unsat:
            broken.append(BrokenDemand(_shown(core), asked.values_of(core)))
            holds += len(part) - len(core)
        else:
            undecided += len(part)
    return ProvedJudgement(tuple(broken), holds, undecided, tuple(sorted(structure.untold.items())))


def _shown(core: Sequence[Demand]) -> Demand:
    """The demand that stands for a core: the last one that a line of the model says."""
    return next((each for each in reversed(core) if each.span is not None), core[-1])


class _Asked:
    """The values of a record, and what z3 is asked about them."""

    def __init__(self, structure: Structure, known: Mapping[str, Value]) -> None:
        self.symbols = structure.symbols
        self.known = known
        self._variables: dict[int, tuple[Claim, tuple[Number, ...]]] = {}  # by claim, which is kept alive

    def variables(self, demand: Demand) -> tuple[Number, ...]:
        """The variables of a demand."""
        found = self._variables.get(id(demand.claim))
        if found is None:
            found = self._variables[id(demand.claim)] = (demand.claim, variables_of(demand.claim))
        return found[1]

    def exact(self, variable: Number) -> Number | None:
        """The value of a variable as a number; None where it is open."""
        value = self.known.get(name_of(variable))
        if value is None or isinstance(value, tuple):
            return None
        if z3.is_real(variable):
            return None if isinstance(value, str) else rational(float(value))
        number = self.symbols.constant(value, "int")
        return number if z3.is_int(number) else None

    def is_plain(self, demand: Demand) -> bool:
        """Whether a demand holds with the very values of the record."""
        pairs = [(each, value) for each in self.variables(demand) if (value := self.exact(each)) is not None]
        return bool(z3.is_true(z3.simplify(z3.substitute(demand.claim, *pairs))))

    def parts(self, demands: Sequence[Demand]) -> list[list[Demand]]:
        """Demands that share a variable whose value is not known, together."""
        leader: dict[str, str] = {}

        def find(name: str) -> str:
            while leader.setdefault(name, name) != name:
                leader[name] = name = leader[leader[name]]
            return name

        firsts = []
        for number, demand in enumerate(demands):
            own = f"demand {number}"
            for each in self.variables(demand):
                if self.exact(each) is None:
                    leader[find(name_of(each))] = find(own)
            firsts.append(own)
        found: dict[str, list[Demand]] = {}
        for own, demand in zip(firsts, demands, strict=True):
            found.setdefault(find(own), []).append(demand)
        return list(found.values())

    def check(self, demands: Sequence[Demand]) -> "tuple[z3.CheckSatResult, list[Demand]]":
        """Whether demands can hold together, and where they cannot, those of them that cannot."""
        solver = z3.Solver()
        solver.set("rlimit", _EFFORT)
        bounded: dict[str, Claim] = {}
        marks = {}
        for number, demand in enumerate(demands):
            whole = []
            for each in self.variables(demand):
                value = self.exact(each)
                if value is not None and z3.is_int(each):
                    whole.append((each, value))
                elif value is not None:
                    bounded[name_of(each)] = self._near(each)
            mark = z3.Bool(f"demand {number}")
            marks[str(mark)] = demand
            solver.add(z3.Implies(mark, z3.substitute(demand.claim, *whole)))
        solver.add(*bounded.values())
        kept = [z3.Bool(name) for name in marks]
        answer = solver.check(*kept)
        if answer != z3.unsat:
            return answer, []
        core = {str(each) for each in solver.unsat_core()}
        return answer, [demand for name, demand in marks.items() if name in core]

    def _near(self, variable: Number) -> Claim:
        """That a real lies within the tolerance of its value."""
        value = self.known[name_of(variable)]
        assert isinstance(value, (int, float))
        margin = slack(float(value))
        return z3.And(variable >= rational(float(value) - margin), variable <= rational(float(value) + margin))

    def values_of(self, demands: Sequence[Demand]) -> tuple[tuple[str, Value], ...]:
        """The known values in some demands, by variable."""
        names = dict.fromkeys(name_of(each) for demand in demands for each in self.variables(demand))
        return tuple((name, self.known[name]) for name in names if name in self.known)


# ---- in words ----


def judgement_text(judgement: ProvedJudgement) -> str:
    """A judgement in lines: what is broken, then how much was asked."""
    lines = []
    for one in judgement.broken:
        demand = one.demand
        what = f"{place_text(demand.span)}: `{statement_of(demand.span)}`" if demand.span is not None else "the record"
        who = f" ({demand.token})" if demand.token else ""
        values = ", ".join(f"{name} = {value_text(value)}" for name, value in one.values)
        lines.append(f"z3: {what} cannot hold{who}{f': {values}' if values else ''}")
    count = f"{judgement.holds} demands of the model hold, {len(judgement.broken)} broken"
    lines.append(f"z3: {count}, {judgement.undecided} undecided")
    lines += [f"not told to z3: {times} x `{name}`" for name, times in judgement.untold]
    return "\n".join(lines)


def judgement_data(judgement: ProvedJudgement) -> dict[str, Any]:
    """A judgement as JSON."""
    return {
        "holds": judgement.holds,
        "broken": [_broken_data(one) for one in judgement.broken],
        "undecided": judgement.undecided,
        "untold": dict(judgement.untold),
    }


def _broken_data(one: BrokenDemand) -> dict[str, Any]:
    span = one.demand.span
    place = None if span is None else {"file": PurePath(span.source.name).name, "line": span.line}
    values = {name: value_text(value) for name, value in one.values}
    return {"token": one.demand.token, "place": place, "values": values}
