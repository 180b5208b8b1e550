"""Random sets of constraints over all operations, searched by the engine and by enumeration."""

import random
from collections.abc import Iterator
from dataclasses import dataclass, field

from runtime.constraints.domains import tags
from runtime.constraints.domains.narrow import is_single
from runtime.constraints.domains.store import Store
from runtime.constraints.engine import Engine
from runtime.constraints.propagators import opcodes
from runtime.constraints.propagators.external import External, argument, never
from tests.constraints import meaning
from tests.constraints.signatures import FORWARD, OTHERS, SIGNATURES, TURNING, draw_values, images

Post = tuple[int, tuple[int, ...]]
MOST_NODES = 20000
TINY = 1e-3
ON_EARTH = (opcodes.OP_WGS_DISPLACE, opcodes.OP_WGS_DISPLACEMENT)


class IsEven(External):
    """The sum of whole numbers is even: a constraint written in Python."""

    def propagate(self, s: Store, c: int) -> bool:
        """Take what is odd from the last number that is not known."""
        variables = [argument(s, c, k) for k in range(s.arity[c])]
        unknown = [v for v in variables if not is_single(s, v)]
        last = unknown[0] if unknown else variables[-1]
        if len(unknown) > 1 or s.ub[last] - s.lb[last] > 100:
            return True
        others = sum(s.lb[v] for v in variables if v != last)
        count = variables.count(last)
        return all((others + count * x) % 2 == 0 or never(s, c, last, x) for x in range(s.lb[last], s.ub[last] + 1))


@dataclass
class Tally:
    """What has been judged."""

    sets: int = 0
    solutions: int = 0
    refuted: int = 0  # sets without a solution
    nodes: int = 0  # of the engine's searches
    conflicts: int = 0
    elements: int = 0
    spare: int = 0  # elements without which an explanation is still inconsistent
    far_elements: int = 0  # the same, where a function takes part that acts once its arguments are known
    far_spare: int = 0
    posts: dict[int, int] = field(default_factory=dict)  # of each operation

    @property
    def minimality(self) -> float:
        """The share of elements without which an explanation would be consistent."""
        return 1.0 - self.spare / max(1, self.elements)


@dataclass
class Problem:
    """Variables by kind and values, and constraints over them; an element constraint has the keys 0, 1, ..."""

    kinds: list[int] = field(default_factory=list)
    values: list[tuple[float, ...]] = field(default_factory=list)
    constants: set[int] = field(default_factory=set)
    posts: list[Post] = field(default_factory=list)


def holds(op: int, x: list[float]) -> bool:
    """Tell whether a constraint holds; what is written in Python and look-ups are known here."""
    if op == opcodes.OP_EXTERNAL:
        return sum(x) % 2 == 0
    if op == opcodes.OP_ELEMENT:
        return 0 <= x[1] < len(x) - 2 and meaning.near(x[0], x[2 + int(x[1])])
    return meaning.holds(op, x)


def draw(chance: random.Random) -> Problem:
    """Draw some constraints, and for each its arguments: among the variables that fit, or new ones."""
    problem = Problem()
    for _ in range(chance.randint(1, 4)):
        op = chance.choice(OTHERS if chance.random() < 0.9 else FORWARD)
        signature = SIGNATURES[op]
        letters = signature.draw(chance)
        arguments: list[int] = []
        given: list[float] = []
        for k, letter in enumerate(letters):
            able = [v for v in range(len(problem.kinds)) if signature.fits(letter, problem.kinds[v])]
            able = [v for v in able if (v in problem.constants) >= (letter in "CK") and v not in arguments]
            if able and (chance.random() < 0.6 or len(problem.kinds) > 7):
                arguments.append(chance.choice(able))
            else:
                kind, values = draw_values(chance, op, letter, k)
                problem.kinds.append(kind)
                problem.values.append(values)
                arguments.append(len(problem.kinds) - 1)
                if letter in "CK" or (len(values) == 1 and chance.random() < 0.5):
                    problem.constants.add(arguments[-1])
            given.append(chance.choice(problem.values[arguments[-1]]))
        spread_result(chance, problem, op, arguments, given)
        if chance.random() < 0.05 and len(arguments) > 1 and not signature.is_strict:
            arguments[-1] = arguments[chance.randrange(len(arguments) - 1)]
            if not signature.fits(letters[-1], problem.kinds[arguments[-1]]):
                continue
        if op in ON_EARTH and any(abs(x) > 80 for v in arguments for x in problem.values[v]):
            continue  # near the poles all longitudes are near
        problem.posts.append((op, tuple(arguments)))
    problem.posts = [each for each in problem.posts if not turns_little(problem, *each)]
    return problem


def turns_little(problem: Problem, op: int, arguments: tuple[int, ...]) -> bool:
    """Tell whether an angle is so small that its sine is near to it, its cosine to 1; what results added counts too."""
    return op in TURNING and any(0 < abs(x) < 20 for x in problem.values[arguments[1]])


def spread_result(chance: random.Random, problem: Problem, op: int, arguments: list[int], given: list[float]) -> None:
    """Add to the values of a result what some inputs give, so that there are solutions."""
    for place, value in images(op, given):
        v = arguments[place]
        if v in problem.constants or not may_have(problem.kinds[v], value) or chance.random() < 0.2:
            continue
        if all(abs(value - other) > 1e-3 for other in problem.values[v]):
            problem.values[v] = tuple(sorted([*problem.values[v], value]))


def may_have(kind: int, value: float) -> bool:
    """Tell whether a variable of a kind may have a value."""
    if kind == tags.KIND_BOOL:
        return value in (0, 1)
    if 0 < abs(value) < TINY:
        return False  # what a product with it is near to, and what exactly, are two things
    return abs(value) <= 1e9 and (kind == tags.KIND_FLOAT or value == int(value))


def solutions(
    posts: list[Post], values: dict[int, tuple[float, ...]], order: list[int], budget: list[int]
) -> Iterator[dict[int, float]]:
    """Enumerate all solutions, one variable after the other; a constraint is looked at once its arguments are known."""
    place = {v: k for k, v in enumerate(order)}
    due: list[list[Post]] = [[] for _ in order]
    for op, arguments in posts:
        due[max(place[v] for v in arguments)].append((op, arguments))
    x: dict[int, float] = {}

    def extend(k: int) -> Iterator[dict[int, float]]:
        if k == len(order):
            yield dict(x)
            return
        v = order[k]
        for value in values[v]:
            budget[0] -= 1
            if budget[0] < 0:
                return
            x[v] = value
            if all(holds(op, [x[u] for u in arguments]) for op, arguments in due[k]):
                yield from extend(k + 1)

    return extend(0)


def build(problem: Problem, chance: random.Random) -> Engine:
    """Make an engine with the variables of a problem: intervals where there are no holes, sets, listings that close."""
    engine = Engine()
    for child, parent in meaning.PARENTS.items():
        engine.set_parent(child, parent)
    for v, (kind, values) in enumerate(zip(problem.kinds, problem.values, strict=True)):
        if v in problem.constants:
            w = engine.new_constant_values(kind, list(values))
            if w != v:  # constants are shared; here each has a variable of its own
                engine.new_values(kind, list(values), v, -1)
        elif kind != tags.KIND_FLOAT and len(values) == values[-1] - values[0] + 1 and chance.random() < 0.8:
            engine.new_interval(kind, values[0], values[-1], v, -1)
        elif chance.random() < 0.1:
            w = engine.new_open(kind, list(values[:-1]), v, -1)
            engine.add_value(w, values[-1])
            assert engine.close(w)
        else:
            engine.new_values(kind, list(values), v, -1)
    assert engine.variables == len(problem.kinds)
    engine.propagate()
    return engine


def post(engine: Engine, op: int, arguments: tuple[int, ...], span: int) -> int:
    """Post one constraint."""
    if op == opcodes.OP_EXTERNAL:
        return engine.post_external(IsEven(), list(arguments), span, -1)
    if op == opcodes.OP_ELEMENT:
        keys = list(range(len(arguments) - 2))
        return engine.post_element(arguments[0], arguments[1], keys, list(arguments[2:]), span, -1)
    return engine.post(op, list(arguments), span, -1)


def search(engine: Engine, problem: Problem, x: list[float], found: list[tuple[float, ...]], tally: Tally) -> None:
    """Find all solutions by deciding one variable after the other, taking back each choice."""
    v = len(x)
    if v == len(problem.kinds):
        found.append(tuple(x))
        return
    domains = [tuple(engine.values_of(w)) for w in range(v, len(problem.kinds))]
    for value in domains[0]:
        tally.nodes += 1
        mark = engine.mark()
        if engine.decide(v, value, 900, -1) and engine.propagate():
            search(engine, problem, [*x, value], found, tally)
        engine.rewind(mark)
        assert [tuple(engine.values_of(w)) for w in range(v, len(problem.kinds))] == domains, "undo left something"


def judge_search(seed: int, tally: Tally) -> None:
    """Compare one random set: nothing pruned that is a solution, and search finds just the solutions."""
    chance = random.Random(seed)
    problem = draw(chance)
    order = list(range(len(problem.kinds)))
    budget = [MOST_NODES]
    expected = {
        tuple(x[v] for v in order) for x in solutions(problem.posts, dict(enumerate(problem.values)), order, budget)
    }
    if budget[0] < 0:
        return
    tally.sets += 1
    tally.solutions += len(expected)
    tally.refuted += not expected
    engine = build(problem, chance)
    for k, (op, arguments) in enumerate(problem.posts):
        tally.posts[op] = tally.posts.get(op, 0) + 1
        post(engine, op, arguments, 100 + k)
    if not engine.propagate():
        assert not expected, "a set with solutions is refuted"
        return
    for x in expected:
        assert all(engine.contains(v, y) for v, y in enumerate(x)), "a solution is pruned"
    found: list[tuple[float, ...]] = []
    search(engine, problem, [], found, tally)
    assert len(found) == len(set(found)) and set(found) == expected, "search finds other solutions"
