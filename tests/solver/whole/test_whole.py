"""nddlc against the judges of whole models, and the judges against plans and models that were spoilt."""

import re
from collections import Counter
from collections.abc import Callable, Iterator
from copy import deepcopy
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from tests.solver.whole.existence import has_plan
from tests.solver.whole.judging import HORIZON, Tally, judge_model, planned
from tests.solver.whole.model import Child, Local, Model, body_text
from tests.solver.whole.plan_judge import ObjectionError, judge_plan
from tests.solver.whole.random_whole import random_whole

Facts = dict[str, Any]
SEEDS = range(40)


@pytest.mark.parametrize("seed", range(0, 60, 10))
def test_verdicts_and_plans_are_those_that_the_judges_find_right(tmp_path: Path, seed: int) -> None:
    tally = Tally()
    for each in range(seed, seed + 10):
        judge_model(tmp_path, each, tally)
    assert tally.plans + tally.exhausted > 2 * tally.timeouts


# ---- plans that were spoilt ----


def spoilt(told: Facts, spoil: Callable[[Facts], bool]) -> Facts | None:
    """A copy that was spoilt; None where it cannot be."""
    copy = deepcopy(told)
    return copy if spoil(copy) else None


def find(told: Facts, **wanted: Any) -> Facts | None:
    """The last token with some facts."""
    found = [token for token in told["tokens"] if all(token.get(key) == value for key, value in wanted.items())]
    return found[-1] if found else None


def without_a_child(told: Facts) -> bool:
    child = next((token for token in reversed(told["tokens"]) if token["master"] is not None), None)
    if child is None or any(child["id"] in (token["master"], token["merged_into"]) for token in told["tokens"]):
        return False
    told["tokens"].remove(child)
    told["order"] = {name: [each for each in order if each != child["id"]] for name, order in told["order"].items()}
    return True


def with_a_child_twice(told: Facts) -> bool:
    child = next(
        (token for token in told["tokens"] if token["master"] is not None and token["state"] == "MERGED"), None
    )
    if child is not None:
        told["tokens"].append(child | {"id": "again"})
    return child is not None


def left_open(told: Facts) -> bool:
    token = find(told, state="ACTIVE")
    if token is not None:
        token["state"] = "INACTIVE"
    return token is not None


def a_goal_rejected(told: Facts) -> bool:
    token = find(told, state="ACTIVE", id="a0")
    if token is not None:
        token["state"] = "REJECTED"
    return token is not None


def too_early(told: Facts) -> bool:
    token = find(told, state="ACTIVE")
    if token is None or "a0" not in (each["id"] for each in told["tokens"]):
        return False
    token["start"][0] -= 1
    return True


def too_narrow(told: Facts) -> bool:
    token = next(
        (each for each in told["tokens"] if each["state"] == "ACTIVE" and each["end"][0] < each["end"][1]), None
    )
    if token is None:
        return False
    token["end"][1] -= 1
    return True


def out_of_its_place(told: Facts) -> bool:
    line = next((name for name, order in told["order"].items() if order), None)
    if line is not None:
        told["order"][line].pop()
    return line is not None


def in_reverse(told: Facts) -> bool:
    line = next((name for name, order in told["order"].items() if len(order) > 1), None)
    if line is not None:
        told["order"][line].reverse()
    return line is not None


def merged_with_another_kind(told: Facts) -> bool:
    for token in told["tokens"]:
        for other in told["tokens"]:
            if token["state"] == "MERGED" and other["state"] == "ACTIVE" and other["predicate"] != token["predicate"]:
                token["merged_into"] = other["id"]
                return True
    return False


def undecided(told: Facts) -> bool:
    for token in told["tokens"]:
        for name, shown in token.get("params", {}).items():
            if token["state"] == "ACTIVE" and shown == "{0} int":
                told["domains"][f"{token['id']}.{name}"] = "[0, 1] int"
                return True
    return False


def with_a_strange_value(told: Facts) -> bool:
    for token in told["tokens"]:
        for name, shown in token.get("params", {}).items():
            if token["state"] == "ACTIVE" and shown.endswith(" int"):
                told["domains"][f"{token['id']}.{name}"] = "{77} int"
                return True
    return False


SPOILERS = (
    without_a_child,
    with_a_child_twice,
    left_open,
    a_goal_rejected,
    too_early,
    too_narrow,
    out_of_its_place,
    in_reverse,
    merged_with_another_kind,
    undecided,
    with_a_strange_value,
)


@pytest.fixture(scope="module")
def plans(tmp_path_factory: pytest.TempPathFactory) -> list[tuple[Model, Facts]]:
    """Models with a plan each, that the judge finds right."""
    found = []
    for seed in SEEDS:
        model = random_whole(seed)
        model = replace(model, aims=tuple(replace(aim, how="goal") for aim in model.aims))
        result, told = planned(tmp_path_factory.getbasetemp(), model, europa=False)
        if result == "plan":
            judge_plan(model, told, HORIZON)
            found.append((model, told))
    return found


@pytest.mark.parametrize("spoil", SPOILERS)
def test_the_judge_objects_to_every_spoilt_plan(
    plans: list[tuple[Model, Facts]], spoil: Callable[[Facts], bool]
) -> None:
    count = 0
    for model, told in plans:
        wrong = spoilt(told, spoil)
        if wrong is not None:
            count += 1
            with pytest.raises(ObjectionError):
                judge_plan(model, wrong, HORIZON)
    assert count > 0


# ---- models of which something was left out before nddlc saw them ----


def weakened(model: Model) -> Iterator[tuple[str, Model]]:
    """The model without one of its statements, and what that is."""
    for k, (kind, body) in enumerate(model.rules):
        for j, statement in enumerate(body):
            rest = body[:j] + body[j + 1 :]
            if isinstance(statement, Local) or (
                isinstance(statement, Child) and re.search(rf"\b{statement.label}\b", body_text(rest))
            ):
                continue  # others speak of it
            rules = (*model.rules[:k], (kind, rest), *model.rules[k + 1 :])
            yield type(statement).__name__, replace(model, rules=rules)
    for k in range(len(model.assigned)):
        yield "assignment", replace(model, assigned=model.assigned[:k] + model.assigned[k + 1 :])
    for k in range(len(model.claims)):
        yield "script", replace(model, claims=model.claims[:k] + model.claims[k + 1 :])


def test_the_judge_objects_to_plans_of_models_that_lack_something(tmp_path: Path) -> None:
    objections: Counter[str] = Counter()
    for seed in range(16):
        model = random_whole(seed, with_resources=seed % 3 == 2)
        exists = has_plan(model)
        for what, weaker in weakened(model):
            result, told = planned(tmp_path, weaker, europa=False)
            if result != "plan":
                continue
            try:
                judge_plan(model, told, HORIZON)
            except ObjectionError:
                objections[what] += 1
            else:
                assert exists is not False, f"seed {seed} without {what}: a plan of what has none"
    assert {"Child", "Compare", "If", "assignment", "script"} <= set(objections)


def test_the_judge_objects_to_plans_that_exceed_a_resource(tmp_path: Path) -> None:
    objections: Counter[str] = Counter()
    for seed in range(100):
        model = random_whole(seed, with_resources=True)
        ample = tuple(
            replace(each, limits=(each.limits[0] + 9.0, *each.limits[1:])) for each in model.things if each.limits
        )
        if not ample:
            continue
        others = tuple(each for each in model.things if not each.limits)
        result, told = planned(tmp_path, replace(model, things=(*others, *ample)), europa=False)
        if result == "plan":
            try:
                judge_plan(model, told, HORIZON)
            except ObjectionError:
                objections.update({each.class_name for each in ample})
    assert set(objections) == {"Reusable", "CBReusable", "Reservoir"}
