"""A slow, obviously right judge of the engine: distances between all pairs of points, enumeration of small domains."""

import itertools
import os
import random
from dataclasses import dataclass, field
from math import inf

from runtime.constraints.domains import tags
from runtime.constraints.engine import Engine
from runtime.constraints.propagators import opcodes
from tests.constraints.meaning import holds

RUNS = int(os.environ.get("NDDLC_RANDOM_RUNS", "200"))  # of each property
BATCHES = range(20)

Values = tuple[int, ...]
Post = tuple[int, tuple[int, ...]]  # operation, arguments
Edge = tuple[int, int, int]  # source, target, weight


def seeds(batch: int) -> range:
    """Give the seeds of one of the batches that a property is tested in."""
    return range(batch, RUNS, len(BATCHES))


def shortest_distances(count: int, edges: list[Edge]) -> list[list[float]] | None:
    """Give the shortest path between all pairs of points (Floyd and Warshall); None if there is a negative cycle."""
    d = [[0.0 if i == j else inf for j in range(count)] for i in range(count)]
    for source, target, weight in edges:
        d[source][target] = min(d[source][target], weight)
    for k in range(count):
        for i in range(count):
            for j in range(count):
                d[i][j] = min(d[i][j], d[i][k] + d[k][j])
    return None if any(d[i][i] < 0 for i in range(count)) else d


# How strongly an operation narrows: to the values, or to the bounds, that its solutions have; else it only is sound.
BY_VALUE = (
    opcodes.OP_EQ,
    opcodes.OP_NEQ,
    opcodes.OP_LT,
    opcodes.OP_LEQ,
    opcodes.OP_TEST_EQ,
    opcodes.OP_TEST_NEQ,
    opcodes.OP_TEST_LEQ,
    opcodes.OP_TEST_LT,
    opcodes.OP_TEST_AND,
    opcodes.OP_TEST_OR,
    opcodes.OP_OR,
)
BY_BOUND = (
    opcodes.OP_ADD_EQ,
    opcodes.OP_TEMPORAL_DISTANCE,
    opcodes.OP_EQ_SUM,
    opcodes.OP_EQ_MAXIMUM,
    opcodes.OP_EQ_MINIMUM,
)
ONLY_SOUND = (
    opcodes.OP_ALL_DIFF,
    opcodes.OP_MUL_EQ,
    opcodes.OP_DIV_EQ,
    opcodes.OP_EQ_PRODUCT,
    opcodes.OP_ABS_VAL,
    opcodes.OP_NEG,
    opcodes.OP_DIFF_SQUARE,
    opcodes.OP_COUNT_ZEROES,
    opcodes.OP_COUNT_NON_ZEROES,
    opcodes.OP_COND_ALL_DIFF,
    opcodes.OP_COND_EQ,
    opcodes.OP_MAXF,
    opcodes.OP_ABSF,
)
TRUTH_FIRST = range(opcodes.OP_TEST_EQ, opcodes.OP_TEST_OR + 1)
LENGTHS = {
    opcodes.OP_EQ: (2, 3),
    opcodes.OP_ALL_DIFF: (3, 4),
    opcodes.OP_ADD_EQ: (3, 3),
    opcodes.OP_MUL_EQ: (3, 3),
    opcodes.OP_DIV_EQ: (3, 3),
    opcodes.OP_TEMPORAL_DISTANCE: (3, 3),
    opcodes.OP_DIFF_SQUARE: (3, 3),
    opcodes.OP_EQ_SUM: (3, 4),
    opcodes.OP_EQ_PRODUCT: (3, 4),
    opcodes.OP_EQ_MAXIMUM: (3, 4),
    opcodes.OP_EQ_MINIMUM: (3, 4),
    opcodes.OP_MAXF: (3, 4),
    opcodes.OP_OR: (1, 3),
    opcodes.OP_COUNT_ZEROES: (2, 4),
    opcodes.OP_COUNT_NON_ZEROES: (2, 4),
    opcodes.OP_COND_ALL_DIFF: (3, 4),
    opcodes.OP_COND_EQ: (3, 4),
}


@dataclass
class Problem:
    """Variables by kind and values, restrictions by variable and values, and constraints over them."""

    kinds: list[int] = field(default_factory=list)
    domains: list[set[int]] = field(default_factory=list)
    posts: list[Post] = field(default_factory=list)

    def solutions(self) -> list[Values]:
        """Enumerate all solutions."""
        return [
            x
            for x in itertools.product(*(sorted(domain) for domain in self.domains))
            if all(holds(op, tuple(x[v] for v in arguments)) for op, arguments in self.posts)
        ]

    def propagated(self) -> list[set[int]] | None:
        """Narrow naively to the fixpoint, each constraint by all of its solutions; None if a domain is empty."""
        domains = [set(domain) for domain in self.domains]
        changed = True
        while changed:
            changed = False
            for op, arguments in self.posts:
                for v, kept in zip(arguments, narrowed(op, arguments, domains), strict=True):
                    if not domains[v] <= kept:
                        domains[v] &= kept
                        changed = True
                if not all(domains):
                    return None
        return domains


def narrowed(op: int, arguments: tuple[int, ...], domains: list[set[int]]) -> list[set[int]]:
    """Give the values that a constraint leaves its arguments, at the strength of its operation."""
    ranges = [domains[v] for v in arguments]
    if op in BY_BOUND:
        ranges = [set(range(min(domain), max(domain) + 1)) for domain in ranges]
    found = [x for x in itertools.product(*ranges) if agrees(arguments, x) and holds(op, x)]
    kept = [{x[k] for x in found} for k in range(len(arguments))]
    if op in BY_BOUND:
        return [set(range(min(k), max(k) + 1)) if k else set() for k in kept]
    return kept


def agrees(arguments: tuple[int, ...], x: Values) -> bool:
    """Tell whether a variable that stands twice has one value."""
    return len(set(arguments)) == len(set(zip(arguments, x, strict=True)))


def random_problem(chance: random.Random, operations: tuple[int, ...], variables: int, posts: int) -> Problem:
    """Draw a problem over bools, ints and symbols with few values."""
    problem = Problem()
    for _ in range(variables):
        kind = chance.choice((tags.KIND_INT, tags.KIND_INT, tags.KIND_SYMBOL, tags.KIND_BOOL))
        if kind == tags.KIND_BOOL:
            domain = {0, 1}
        else:
            lo = chance.randint(-3, 3)
            domain = set(range(lo, lo + chance.randint(1, 6)))
            if chance.random() < 0.3:
                domain = set(chance.sample(sorted(domain), chance.randint(1, len(domain))))
        problem.kinds.append(kind)
        problem.domains.append(domain)
    bools = [v for v in range(variables) if problem.kinds[v] == tags.KIND_BOOL]
    for _ in range(posts):
        op = chance.choice(operations)
        least, most = LENGTHS.get(op, (3, 3) if op in TRUTH_FIRST else (2, 2))
        count = chance.randint(least, most)
        if count > variables:
            continue
        arguments = chance.sample(range(variables), count)
        if op in TRUTH_FIRST or op in (opcodes.OP_COND_ALL_DIFF, opcodes.OP_COND_EQ):
            if not bools:
                continue
            arguments[0] = chance.choice(bools)
            if arguments[0] in arguments[1:]:
                continue
        if op in (opcodes.OP_TEST_AND, opcodes.OP_TEST_OR) and not set(arguments) <= set(bools):
            continue
        if op == opcodes.OP_TEMPORAL_DISTANCE and any(problem.kinds[v] != tags.KIND_INT for v in arguments):
            continue
        problem.posts.append((op, tuple(arguments)))
    return problem


def built(problem: Problem, posts: list[Post] | None = None) -> Engine:
    """Make an engine with the variables of a problem, and its constraints or others."""
    engine = Engine()
    for v, (kind, domain) in enumerate(zip(problem.kinds, problem.domains, strict=True)):
        if len(domain) == max(domain) - min(domain) + 1:
            engine.new_interval(kind, min(domain), max(domain), v, -1)
        else:
            engine.new_values(kind, sorted(domain), v, -1)
    for k, (op, arguments) in enumerate(problem.posts if posts is None else posts):
        engine.post(op, list(arguments), 1000 + k, -1)
    return engine


def domains_of(engine: Engine, count: int) -> list[set[int]]:
    """List the domains of the first variables."""
    return [{int(x) for x in engine.values_of(v)} for v in range(count)]


def undecide(engine: Engine, v: int) -> bool:
    """Take the decisions on a variable back at level 0, and propagate."""
    decisions = [r for r in engine.restrictions_of(v) if engine.restriction_flags[r] & tags.FLAG_DECISION]
    return bool(engine.retract(restrictions=decisions))
