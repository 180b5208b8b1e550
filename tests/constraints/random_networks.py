"""Random lives of a temporal network: edges, distances, restrictions and decisions come and go, forth and back."""

import random
from collections.abc import Sequence
from dataclasses import dataclass, field
from math import inf

from runtime.constraints.domains import tags
from runtime.constraints.engine import Engine
from runtime.constraints.explanation.cause import Cause, CauseKind
from runtime.constraints.minimisation.minimise import minimise
from runtime.constraints.propagators import opcodes
from tests.constraints.reference import shortest_distances
from tests.constraints.sufficient import sufficient

Bounds = tuple[float, float]
Key = tuple[CauseKind, int]
Relation = tuple[int, int, float, float]  # source, target: the target lies between so much and so much later
ANY: Bounds = (-inf, inf)


@dataclass
class Tally:
    """What has been judged."""

    networks: int = 0
    comparisons: int = 0  # of all bounds with those of all-pairs distances
    retractions: int = 0
    undone: int = 0
    conflicts: int = 0
    elements: int = 0  # of all shrunk explanations
    spare: int = 0  # those without which the rest is still inconsistent

    @property
    def minimality(self) -> float:
        """The share of elements without which an explanation would be consistent."""
        return 1.0 - self.spare / max(1, self.elements)


@dataclass
class Model:
    """What holds, as relations of points; point 0 is the origin, to which bounds relate."""

    relations: dict[Key, Relation] = field(default_factory=dict)
    lengths: dict[int, tuple[int, int, int]] = field(default_factory=dict)  # constraint: start, length, end
    limits: dict[Key, tuple[int, Bounds]] = field(default_factory=dict)  # restriction: length variable, bounds

    def copy(self) -> "Model":
        """Give the same once more."""
        return Model(dict(self.relations), dict(self.lengths), dict(self.limits))

    def base(self, d: int, wanted: set[Key] | None = None) -> Bounds:
        """Intersect the restrictions of a length, all or the wanted ones."""
        lo, hi = ANY
        for key, (v, (least, most)) in self.limits.items():
            if v == d and (wanted is None or key in wanted):
                lo, hi = max(lo, least), min(hi, most)
        return lo, hi

    def distances(self, count: int, wanted: set[Key] | None = None) -> list[list[float]] | None:
        """Give the distances of all points under all relations, or under the wanted ones; None: they contradict."""
        edges: list[tuple[int, int, int]] = []
        chosen = [each for key, each in self.relations.items() if wanted is None or key in wanted]
        for c, (start, d, end) in self.lengths.items():
            lo, hi = self.base(d, wanted)
            if lo > hi:
                return None
            if wanted is None or (CauseKind.CONSTRAINT, c) in wanted:
                chosen.append((start, end, lo, hi))
        for source, target, lo, hi in chosen:
            if hi < inf:
                edges.append((source, target, int(hi)))
            if lo > -inf:
                edges.append((target, source, -int(lo)))
        return shortest_distances(count, edges)


class Life:
    """One network, the model of what it should be, and the marks to go back to."""

    def __init__(self, seed: int, tally: Tally) -> None:
        self.chance = random.Random(seed)
        self.tally = tally
        self.engine = Engine()
        self.model = Model()
        self.count = self.chance.randint(2, 8)
        self.variable: list[int] = []  # of each point but the origin
        self.point: dict[int, int] = {}
        self.marks: list[tuple[int, Model]] = []
        for p in range(1, self.count + 1):
            lo = self.chance.choice((-inf, -inf, float(self.chance.randint(-20, 5))))
            hi = self.chance.choice((inf, inf, float(self.chance.randint(5, 30))))
            v = self.engine.new_interval(tags.KIND_INT, lo, hi, p, -1)
            self.variable.append(v)
            self.point[v] = p
            self.model.relations[(CauseKind.RESTRICTION, self.engine.restrictions_of(v)[0])] = (0, p, lo, hi)
        self.engine.commit()
        self.fixed = set(self.model.relations)

    def live(self) -> None:
        """Take some steps and compare after each."""
        self.tally.networks += 1
        for _ in range(self.chance.randint(4, 16)):
            self.step()
            while not self.compare():
                self.mend()

    def step(self) -> None:
        """Add something, or go back, or take something out."""
        dice = self.chance.random()
        if dice < 0.15 and self.marks:
            self.go_back()
            return
        if dice < 0.3:
            self.take_out()
            return
        if self.chance.random() < 0.5:
            self.marks.append((self.engine.mark(), self.model.copy()))
        if dice < 0.6:
            self.add_edge()
        elif dice < 0.75:
            self.add_constraint()
        elif dice < 0.85:
            self.add_length()
        else:
            self.restrict()
        self.engine.propagate()

    def go_back(self) -> None:
        """Rewind to a mark, sometimes twice to the same one; the marks after it are void."""
        k = self.chance.randrange(len(self.marks))
        mark, model = self.marks[k]
        self.engine.rewind(mark)
        self.model = model.copy()
        del self.marks[k + (self.chance.random() < 0.5) :]
        self.tally.undone += 1

    def pair(self) -> tuple[int, int]:
        """Choose two points; rarely the same."""
        if self.chance.random() < 0.05:
            return (1, 1)
        source, target = self.chance.sample(range(1, self.count + 1), 2)
        return source, target

    def add_edge(self) -> None:
        """Add a plain edge."""
        source, target = self.pair()
        weight = self.chance.randint(-4, 9)
        self.engine.add_edge(self.variable[source - 1], self.variable[target - 1], weight, 100, -1)
        self.model.relations[(CauseKind.EDGE, self.engine.newest_edge)] = (source, target, -inf, weight)

    def add_constraint(self) -> None:
        """Post a comparison, or a sum with a constant."""
        source, target = self.pair()
        if source == target:
            return
        a, b = self.variable[source - 1], self.variable[target - 1]
        x = self.chance.randint(-5, 9)
        k = self.engine.new_constant(tags.KIND_INT, x, x)
        op, arguments, lo, hi = self.chance.choice(
            [
                (opcodes.OP_LEQ, [a, b], 0.0, inf),
                (opcodes.OP_LT, [a, b], 1.0, inf),
                (opcodes.OP_EQ, [a, b], 0.0, 0.0),
                (opcodes.OP_ADD_EQ, [a, k, b], float(x), float(x)),
                (opcodes.OP_ADD_EQ, [k, a, b], float(x), float(x)),
            ]
        )
        c = self.engine.post(op, arguments, 100, -1)
        self.model.relations[(CauseKind.CONSTRAINT, c)] = (source, target, lo, hi)

    def add_length(self) -> None:
        """Post a distance whose length is a variable."""
        source, target = self.pair()
        if source == target:
            return
        lo = self.chance.choice((-inf, 0.0, 1.0, 3.0))
        hi = self.chance.choice((inf, 4.0, 9.0))
        d = self.engine.new_interval(tags.KIND_INT, lo, hi, 100, -1)
        self.model.limits[(CauseKind.RESTRICTION, self.engine.restrictions_of(d)[0])] = (d, (lo, hi))
        arguments = [self.variable[source - 1], d, self.variable[target - 1]]
        c = self.engine.post(opcodes.OP_TEMPORAL_DISTANCE, arguments, 100, -1)
        self.model.lengths[c] = (source, d, target)

    def restrict(self) -> None:
        """Restrict or decide a point or a length."""
        is_decision = self.chance.random() < 0.5
        lengths = [d for _, d, _ in self.model.lengths.values()]
        x = float(self.chance.randint(-6, 12))
        lo, hi = self.chance.choice(((x, x), (x, inf), (-inf, x), (x, x + 6)))
        v = self.chance.choice(lengths if lengths and self.chance.random() < 0.3 else self.variable)
        if is_decision:
            lo = hi = x
            self.engine.decide(v, x, 100, -1)
        else:
            self.engine.restrict_base(v, lo, hi, 100, -1)
        key = (CauseKind.RESTRICTION, self.engine.newest_restriction)
        if v in self.point:
            self.model.relations[key] = (0, self.point[v], lo, hi)
        else:
            self.model.limits[key] = (v, (lo, hi))

    def take_out(self) -> None:
        """Retract some of all that is not declared, at level 0."""
        self.engine.commit()
        self.marks.clear()
        able = [key for key in self.model.relations if key not in self.fixed]
        able += [(CauseKind.CONSTRAINT, c) for c in self.model.lengths]
        if able:
            self.retract(self.chance.sample(able, self.chance.randint(1, min(3, len(able)))))

    def retract(self, gone: Sequence[Key]) -> None:
        """Take some elements out; a distance goes with its length."""
        self.tally.retractions += 1
        chosen: dict[CauseKind, list[int]] = {kind: [] for kind in CauseKind}
        variables = []
        for kind, k in dict.fromkeys(gone):
            if kind is CauseKind.CONSTRAINT and k in self.model.lengths:
                d = self.model.lengths.pop(k)[1]
                variables.append(d)
                self.model.limits = {key: limit for key, limit in self.model.limits.items() if limit[0] != d}
            else:
                chosen[kind].append(k)
                if self.model.relations.pop((kind, k), None) is None:
                    del self.model.limits[(kind, k)]
        limits = [r for r in chosen[CauseKind.RESTRICTION] if self.engine.restriction_variable[r] not in variables]
        self.engine.retract(chosen[CauseKind.CONSTRAINT], chosen[CauseKind.EDGE], limits, variables)
        self.engine.commit()

    def compare(self) -> bool:
        """Compare all bounds with the distances; false on a conflict, which both must see."""
        self.tally.comparisons += 1
        d = self.model.distances(self.count + 1)
        engine = self.engine
        assert engine.consistent == (d is not None), "the verdicts differ"
        if d is None:
            return False
        for p, v in enumerate(self.variable, 1):
            assert (engine.lower(v), engine.upper(v)) == (-d[p][0], d[0][p]), f"the bounds of point {p} differ"
        for start, v, end in self.model.lengths.values():
            lo, hi = self.model.base(v)
            bounds = (max(lo, -d[end][0] - d[0][start]), min(hi, d[0][end] + d[start][0]))
            assert (engine.lower(v), engine.upper(v)) == bounds, "the bounds of a length differ"
        return True

    def mend(self) -> None:
        """Judge the explanation of a conflict; go back, or retract one of its elements, until all is well."""
        causes = self.judge()
        if self.marks and self.chance.random() < 0.8:
            self.go_back()
            return
        self.engine.commit()
        self.marks.clear()
        able = [key for key in causes if key not in self.fixed and not self.is_declaration(key)]
        able += [
            (CauseKind.CONSTRAINT, c) for c, (_, d, _) in self.model.lengths.items() if self.is_bound_by(causes, d)
        ]
        assert able, "what is declared is consistent"
        self.retract([self.chance.choice(able)])

    def is_declaration(self, key: Key) -> bool:
        """Tell whether a restriction of a length goes only with the length."""
        kind, r = key
        if kind is not CauseKind.RESTRICTION or key in self.model.relations:
            return False
        return self.engine.restrictions_of(self.model.limits[key][0])[-1] == r

    def is_bound_by(self, causes: list[Key], d: int) -> bool:
        """Tell whether a length is among the causes."""
        return any(key in self.model.limits and self.model.limits[key][0] == d for key in causes)

    def judge(self) -> list[Key]:
        """Have all-pairs distances judge the explanation of a conflict, whole and without each of its elements."""
        causes = sufficient(self.engine)
        assert self.is_inconsistent(causes), "an explanation is consistent"
        least = minimise(self.engine, causes)
        assert set(least) <= set(causes) and self.is_inconsistent(least), "a shrunk explanation is consistent"
        self.tally.conflicts += 1
        self.tally.elements += len(least)
        self.tally.spare += sum(self.is_inconsistent([other for other in least if other is not one]) for one in least)
        return [(cause.kind, cause.id) for cause in least]

    def is_inconsistent(self, causes: list[Cause]) -> bool:
        """Tell whether some elements alone contradict each other."""
        return self.model.distances(self.count + 1, {(cause.kind, cause.id) for cause in causes}) is None


def judge_network(seed: int, tally: Tally) -> None:
    """Live through one random network."""
    Life(seed, tally).live()
