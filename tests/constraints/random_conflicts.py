"""Bring random sets of constraints into conflict, and judge the explanation whole and without each of its elements.

What is consistent has a witness: values that are allowed and for which all constraints hold. No way of looking for one
is complete, so what counts as inconsistent may have a solution that nobody has met.
"""

import itertools
import math
import random
from dataclasses import dataclass, field

from runtime.constraints.domains import tags
from runtime.constraints.engine import Engine
from runtime.constraints.explanation.cause import Cause, CauseKind
from runtime.constraints.minimisation.minimise import Scratch, minimise
from runtime.constraints.propagators import opcodes
from tests.constraints import meaning
from tests.constraints.random_sets import Post, Problem, Tally, build, draw, holds, may_have, post, solutions
from tests.constraints.signatures import FORWARD, images
from tests.constraints.sufficient import sufficient
from tests.constraints.witness import anything, quick_order, walks_to_solution

MOST_COMBINATIONS = 2000
OF_DOMAINS = (opcodes.OP_TEST_SINGLETON, opcodes.OP_TEST_SPECIFIED)  # they speak of what is known, not of values


@dataclass
class Case:
    """A conflict: the engine that is in it, and what its rows and decisions stand for."""

    problem: Problem
    engine: Engine
    rows: dict[int, Post] = field(default_factory=dict)
    decided: dict[int, float] = field(default_factory=dict)

    def posts(self, causes: list[Cause]) -> list[Post]:
        """Give the constraints among some causes."""
        return [self.rows[cause.id] for cause in causes if cause.kind is CauseKind.CONSTRAINT]

    def values(self, causes: list[Cause]) -> dict[int, tuple[float, ...]]:
        """Give the values that some causes leave those variables of which they say something."""
        constants = [v for v in self.problem.constants if self.engine.constant[v]]  # the others are restricted like any
        values: dict[int, tuple[float, ...]] = {v: self.problem.values[v] for v in constants}
        for cause in causes:
            if cause.kind is CauseKind.RESTRICTION:
                v = self.engine.restriction_variable[cause.id]
                allowed = (self.decided[cause.id],) if cause.id in self.decided else self.problem.values[v]
                values[v] = tuple(x for x in values.get(v, allowed) if any(meaning.near(x, y) for y in allowed))
        return values


def judge_conflict(seed: int, tally: Tally) -> None:
    """Post one random set bit by bit, deciding in between; judge the explanation of the first conflict."""
    chance = random.Random(seed)
    problem = draw(chance)
    engine = build(problem, chance)
    engine.commit()
    case = Case(problem, engine)
    if not go_wrong(case, chance):
        return
    tally.conflicts += 1
    causes = sufficient(engine)
    least = minimise(engine, causes)
    assert set(least) <= set(causes)
    assert not is_consistent(case, least), "an explanation is consistent"
    spare = sum(not is_consistent(case, [other for other in least if other is not one]) for one in least)
    if any(op in FORWARD for op, _ in case.posts(least)):
        tally.far_elements += len(least)
        tally.far_spare += spare
    else:
        tally.elements += len(least)
        tally.spare += spare


def go_wrong(case: Case, chance: random.Random) -> bool:
    """Post and decide in any order until there is a conflict; false if there is none."""
    problem, engine = case.problem, case.engine
    steps = [(k, -1) for k in range(len(problem.posts))] + [(-1, v) for v in range(len(problem.kinds))]
    chance.shuffle(steps)
    for k, v in steps:
        if k >= 0:
            case.rows[post(engine, *problem.posts[k], 100 + k)] = problem.posts[k]
        elif not engine.constant[v] and (values := engine.values_of(v)):
            value = chance.choice(values)
            engine.decide(v, value, 200 + v, -1)
            case.decided[engine.newest_restriction] = value
        if not engine.propagate():
            return True
        if chance.random() < 0.2:
            engine.commit()
    return False


def is_consistent(case: Case, causes: list[Cause]) -> bool:
    """Tell whether some causes have a common solution: one that enumeration meets, or to which the engine points."""
    values = case.values(causes)
    if not all(values.values()):
        return False
    posts = case.posts(causes)
    names = list(dict.fromkeys(v for _, arguments in posts for v in arguments))
    stated = set(values)
    for v in names:
        if v not in values:
            values[v] = anything(case.problem, v)
    asked = [arguments[1] for op, arguments in posts if op in OF_DOMAINS]
    if any(len(values[v]) > 1 and sum(v in arguments for _, arguments in posts) == 1 for v in asked):
        posts = [each for each in posts if each[0] not in OF_DOMAINS]
    for op, arguments in posts:
        choices = {v: values[v][:2] if v in stated else (0.0,) for v in arguments}
        for x in (
            itertools.product(*choices.values()) if len(stated.intersection(arguments)) >= len(arguments) - 1 else ()
        ):
            given = dict(zip(choices, x, strict=True))
            for place, value in images(op, [given[v] for v in arguments]):
                if arguments[place] not in stated and may_have(case.problem.kinds[arguments[place]], value):
                    values[arguments[place]] = (value, *values[arguments[place]])
    if points_to_solution(case, causes, posts, names, values):
        return True
    if next(solutions(posts, values, quick_order(posts, values), [MOST_COMBINATIONS]), None) is not None:
        return True
    return walks_to_solution(posts, case.problem.kinds, values, stated)


def points_to_solution(
    case: Case, causes: list[Cause], posts: list[Post], names: list[int], values: dict[int, tuple[float, ...]]
) -> bool:
    """Let an engine with the causes alone search a little; a solution counts only if every constraint holds for it."""
    scratch = Scratch(case.engine)
    copies = {v: scratch.variable(v) for v in names}
    if not all(scratch.carry_out(cause) for cause in causes) or not scratch.copy.propagate():
        return False
    engine = scratch.copy
    budget = [60]

    def extend() -> bool:
        budget[0] -= 1
        waiting = [v for v in names if not engine.is_singleton(copies[v])]
        if not waiting:
            found = {v: engine.lower(w) for v, w in copies.items()}
            return all(holds(op, [found[v] for v in arguments]) for op, arguments in posts)
        v = min(waiting, key=lambda v: engine.upper(copies[v]) - engine.lower(copies[v]))
        w = copies[v]
        lo, hi = engine.lower(w), engine.upper(w)
        candidates = [x for x in (lo, hi, (lo + hi) / 2) if abs(x) < math.inf]
        for x in dict.fromkeys((*candidates, *values[v])):
            if budget[0] < 0 or (engine.kind[w] != tags.KIND_FLOAT and x != int(x)) or not engine.contains(w, x):
                continue
            mark = engine.mark()
            if engine.decide(w, x, 0, -1) and engine.propagate() and extend():
                return True
            engine.rewind(mark)
        return False

    return extend()
