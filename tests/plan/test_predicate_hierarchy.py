"""Classes that inherit predicates: which predicate a child has, and which tokens may merge."""

from pathlib import Path

from runtime.solver.tags import PLAN
from tests.plan.models import loaded, stopped, token, tokens
from tests.solver.planning import solver_for, verdict

BEES = """
class Insect extends Timeline { predicate Fly { int height; } predicate Rest { } }
class Bee extends Insect { predicate Rest { int flower; } predicate Dance { } }
Insect::Fly { meets(object.Rest r); }
Insect::Rest { meets(Fly f); }
"""
HIVE = "Bee maja = new Bee(); Insect moth = new Insect(); close();"


def test_an_inherited_rule_asks_for_the_predicate_of_the_tokens_own_class() -> None:
    text = BEES + HIVE + "goal(maja.Fly a); goal(moth.Fly b); a.activate(); b.activate();"
    made = {each["master"]: each["predicate"] for each in tokens(loaded(text)).values() if each["master"]}
    assert made == {"a": "Bee.Rest", "b": "Insect.Rest"}


def test_an_unqualified_child_is_of_the_tokens_own_class_too() -> None:
    text = BEES + HIVE + "goal(maja.Rest a); a.activate();"
    assert [each["predicate"] for each in tokens(loaded(text)).values() if each["master"]] == ["Bee.Fly"]


def test_a_token_merges_into_one_of_a_subclass() -> None:
    text = BEES + HIVE + "goal(Insect.Fly some); goal(maja.Fly a); a.activate(); some.merge(a); some.height = 3;"
    found = tokens(loaded(text))
    assert found["some"]["state"] == "MERGED"
    assert found["a"]["params"]["height"] == "{3} int"


def test_a_token_does_not_merge_into_one_of_the_base_class() -> None:
    text = BEES + HIVE + "goal(Insect.Fly some); goal(maja.Fly a); some.activate(); a.merge(some);"
    assert stopped(text).code.id == "NDDL654"


def test_search_merges_into_tokens_of_subclasses_in_the_order_of_their_making(tmp_path: Path) -> None:
    scene = BEES.replace("Insect::Fly { meets(object.Rest r); }", "").replace("Insect::Rest { meets(Fly f); }", "")
    goals = "goal(maja.Dance d); goal(maja.Fly a); goal(moth.Fly b); goal(Insect.Fly some); "
    times = "d.start = 0; a.start = [0 50]; b.start = [0 50]; some.start = [0 50]; some.height = 2; a.height = 1;"
    for europa in (True, False):
        solver = solver_for(tmp_path, scene + HIVE + goals + times, europa=europa)
        assert solver.solve(100, 100) == PLAN
        plan = solver.database
        assert plan.plan.rows.merged_into[token(plan, "some")] == token(plan, "b")


def test_an_inherited_chain_of_rules_ends_at_the_horizon(tmp_path: Path) -> None:
    text = BEES + "Bee maja = new Bee(); close(); goal(maja.Fly a); a.start = 0; a.duration >= 30;"
    assert verdict(tmp_path, text, europa=True) == verdict(tmp_path, text) == "plan"
