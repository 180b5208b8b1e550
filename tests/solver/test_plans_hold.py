"""Plans of random models against a checker that knows the models as data: children, choices, times, order."""

import operator
import re
from itertools import pairwise
from math import inf
from pathlib import Path
from typing import Any

import pytest

from runtime.plan.readout.readout import read
from runtime.solver.tags import RESULT_NAMES
from tests.solver.model_data import RELATIONS, Model, Wish, random_model, written
from tests.solver.planning import solver_for

HORIZON = (0, 100)
LINK_TESTS = {"eq": operator.eq, "neq": operator.ne, "lt": operator.lt, "leq": operator.le}
Facts = dict[str, Any]
Point = tuple[str, str]  # token, s or e
ZERO: Point = ("", "")


class Plan:
    """The final state: tokens by name, merged ones with the token that stands for them."""

    def __init__(self, model: Model, state: Facts) -> None:
        self.model = model
        self.tokens: dict[str, Facts] = {token["id"]: token for token in state["tokens"]}
        self.order: dict[str, list[str]] = state["order"]
        self.gaps: dict[tuple[Point, Point], float] = {}  # (a, b): b - a is at least this

    def actual(self, name: str) -> Facts:
        """The token that stands for one."""
        merged = self.tokens[name]["merged_into"]
        return self.tokens[merged] if merged is not None else self.tokens[name]

    def value(self, name: str) -> int:
        """The parameter of a token that is in the plan."""
        found = re.fullmatch(r"\{(\d)\} int", self.actual(name)["params"]["x"])
        assert found is not None, f"x of {name} is not decided"
        return int(found[1])

    def keep(self, a: Point, b: Point, gap: float) -> None:
        self.gaps[a, b] = max(self.gaps.get((a, b), -inf), gap)

    def relate(self, relation: str, origin: str, target: str) -> None:
        """The times of two tokens, by the table of relations."""
        names = {"o": self.actual(origin)["id"], "t": self.actual(target)["id"]}
        for a, b, gap in RELATIONS[relation]:
            self.keep((names[a[0]], a[1]), (names[b[0]], b[1]), gap)

    def bounds(self) -> dict[Point, tuple[float, float]]:
        """Longest paths from and to zero."""
        points = {ZERO} | {point for pair in self.gaps for point in pair}
        far = dict(self.gaps)
        for middle in points:
            for a in points:
                for b in points:
                    longer = far.get((a, middle), -inf) + far.get((middle, b), -inf)
                    if longer > far.get((a, b), -inf):
                        far[a, b] = longer
        assert all(far.get((point, point), 0) <= 0 for point in points), "no times fit"
        return {point: (far.get((ZERO, point), -inf), -far.get((point, ZERO), -inf)) for point in points}


def wishes_of(plan: Plan, name: str) -> list[Wish]:
    """What an active token asks for."""
    behaviour = plan.model.behaviours[plan.tokens[name]["predicate"].removeprefix("T.")]
    wishes = list(behaviour.wishes)
    if behaviour.guarded is not None and plan.value(name) == behaviour.guarded[0]:
        wishes.append(behaviour.guarded[1])
    return wishes


def check_children(plan: Plan, name: str) -> None:
    """Each wish has its child, in the order of the text; each child is where and how it was wished."""
    children = [token["id"] for token in plan.tokens.values() if token["master"] == name]
    wishes = wishes_of(plan, name)
    assert [(plan.tokens[child]["relation"], plan.tokens[child]["predicate"]) for child in children] == [
        (wish.relation, f"T.{wish.predicate}") for wish in wishes
    ]
    for child, wish in zip(children, wishes, strict=True):
        plan.relate(wish.relation, name, child)
        if wish.is_own:
            assert plan.actual(child)["object"] == plan.tokens[name]["object"]
        if wish.link is not None and plan.tokens[child]["state"] != "INACTIVE":
            assert LINK_TESTS[wish.link](plan.value(name), plan.value(child)), (name, wish, child)


def check_aims(plan: Plan) -> None:
    """Only what need not be in the plan is rejected; windows and timelines are kept."""
    for i, aim in enumerate(plan.model.aims):
        token = plan.tokens[f"a{i}"]
        assert token["state"] != "REJECTED" or aim.kind == "rejectable"
        if token["state"] in ("ACTIVE", "MERGED"):
            stands = plan.actual(f"a{i}")
            plan.keep(ZERO, (stands["id"], "s"), aim.earliest)
            plan.keep((stands["id"], "s"), ZERO, -aim.latest)
            assert aim.timeline is None or stands["object"] == f"{{{aim.timeline}}} T"


def check_times(plan: Plan) -> None:
    """The times are exactly those that durations, relations, windows and the order on timelines leave."""
    for name, token in plan.tokens.items():
        if token["state"] in ("ACTIVE", "INACTIVE"):
            behaviour = plan.model.behaviours[token["predicate"].removeprefix("T.")]
            ran = token["state"] == "ACTIVE"
            plan.keep((name, "s"), (name, "e"), behaviour.shortest if ran else 1)
            if ran:
                plan.keep((name, "e"), (name, "s"), -behaviour.longest)
    for sequence in plan.order.values():
        for before, after in pairwise(sequence):
            plan.keep((before, "e"), (after, "s"), 0)
    bounds = plan.bounds()
    for name, token in plan.tokens.items():
        if token["state"] == "ACTIVE":
            for key, point in (("start", "s"), ("end", "e")):
                assert tuple(map(float, token[key])) == bounds[name, point], (name, key)


def check(model: Model, state: Facts) -> None:
    """Raise unless a final state is a plan of the model."""
    plan = Plan(model, state)
    for name, token in plan.tokens.items():
        if token["state"] == "ACTIVE":
            check_children(plan, name)
            where = re.fullmatch(r"\{(\w+)\} T", token["object"])
            is_inside = float(token["end"][0]) > HORIZON[0] and float(token["start"][1]) < HORIZON[1]
            assert not is_inside or (where is not None and name in plan.order[where[1]]), name
        elif token["state"] == "MERGED":
            assert plan.actual(name)["state"] == "ACTIVE"
            assert plan.actual(name)["predicate"] == token["predicate"]
        elif token["state"] == "INACTIVE":
            assert float(token["end"][0]) <= HORIZON[0] or float(token["start"][1]) >= HORIZON[1], name
    check_aims(plan)
    check_times(plan)


@pytest.mark.parametrize("seed", range(80))
@pytest.mark.parametrize("europa", [False, True])
def test_a_plan_is_one(tmp_path: Path, seed: int, europa: bool) -> None:
    model = random_model(seed)
    solver = solver_for(tmp_path, written(model), europa=europa, horizon=HORIZON)
    if RESULT_NAMES[solver.solve(2000, 2**60)] == "plan":
        check(model, read(solver.database))


def test_the_checker_sees_what_is_wrong(tmp_path: Path) -> None:
    seed = next(seed for seed in range(80) if len(random_model(seed).aims) > 2)
    model = random_model(seed)
    solver = solver_for(tmp_path, written(model), horizon=HORIZON)
    assert RESULT_NAMES[solver.solve(2000, 2**60)] == "plan"
    state = read(solver.database)
    late = next(token for token in state["tokens"] if token["state"] == "ACTIVE")
    late["start"][0] += 1
    with pytest.raises(AssertionError):
        check(model, state)
