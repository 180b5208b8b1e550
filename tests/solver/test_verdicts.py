"""Verdicts against trying everything, and of the two strategies against each other."""

from pathlib import Path

import pytest

from runtime.solver.tags import EXHAUSTED, PLAN, RESULT_NAMES
from tests.solver.planning import resources_configuration, solver_for, verdict
from tests.solver.random_models import (
    guards_model,
    loops_model,
    rules_model,
    timelines_puzzle,
    uses_model,
    variables_puzzle,
)


@pytest.mark.parametrize("seed", range(60))
def test_variables_get_values_where_values_exist(tmp_path: Path, seed: int) -> None:
    puzzle = variables_puzzle(seed)
    wanted = "plan" if puzzle.has_plan else "exhausted"
    assert verdict(tmp_path, puzzle.text) == wanted, puzzle.text
    assert verdict(tmp_path, puzzle.text, europa=True) == wanted, puzzle.text


@pytest.mark.parametrize("seed", range(60))
def test_tokens_get_places_where_places_exist(tmp_path: Path, seed: int) -> None:
    puzzle = timelines_puzzle(seed)
    assert verdict(tmp_path, puzzle.text) == ("plan" if puzzle.has_plan else "exhausted"), puzzle.text


@pytest.mark.parametrize("seed", range(60))
def test_backjumping_changes_no_verdict(tmp_path: Path, seed: int) -> None:
    text = rules_model(seed)
    plain = verdict(tmp_path, text, europa=True)
    learned = verdict(tmp_path, text)
    assert plain == "timeout" or learned == plain, text


@pytest.mark.parametrize("seed", range(60))
def test_backjumping_over_guards_changes_no_verdict(tmp_path: Path, seed: int) -> None:
    text = guards_model(seed)
    plain = verdict(tmp_path, text, europa=True, most=3000)
    learned = verdict(tmp_path, text)
    assert plain == "timeout" or learned == plain, text


@pytest.mark.parametrize("seed", range(60))
def test_loops_over_what_is_decided_have_one_verdict(tmp_path: Path, seed: int) -> None:
    text = loops_model(seed)
    plain = verdict(tmp_path, text, europa=True, most=3000)
    assert plain == "timeout" or verdict(tmp_path, text) == plain, text


def test_what_a_guard_of_two_variables_asks_for_rests_on_both(tmp_path: Path) -> None:
    text = """
    class T extends Timeline { predicate p { int x; int y; } }
    T::p {
        leq(0, x); leq(x, 1); leq(0, y); leq(y, 1);
        int k = [0 1];
        if (x == y) { lt(k, 0); }
        if (y == 1) { lt(k, 0); }
    }
    T t = new T();
    close();
    goal(t.p g);
    g.start = [0 9];
    """
    assert verdict(tmp_path, text, europa=True) == "plan"
    assert verdict(tmp_path, text) == "plan"


def test_what_a_loop_asks_for_rests_on_what_narrowed_its_domain(tmp_path: Path) -> None:
    text = """
        class A extends Timeline { int k; A(int v) { k = v; } predicate work { } }
        class S extends Timeline { predicate q { } }
        class T extends Timeline { predicate p { int w; } }
        A::work { object.k == 1; }
        T t = new T();
        S s = new S();
        A a1 = new A(0);
        A a2 = new A(1);
        close();
        A v;
        T::p { int z; if (w == 1) { contains(s.q x); } else { z == 2; z == 1; } }
        S::q { foreach (o in v) { contains(o.work y); } }
        goal(t.p g);
        g.w = {0, 1};
        g.start = 0;
        g.end = 10;
    """
    assert verdict(tmp_path, text, europa=True) == "plan"
    assert verdict(tmp_path, text) == "plan"


@pytest.mark.parametrize("seed", range(40))
def test_backjumping_over_resources_changes_no_verdict(tmp_path: Path, seed: int) -> None:
    text = uses_model(seed)
    results = []
    for europa in (True, False):
        solver = solver_for(tmp_path, text, europa=europa, horizon=(0, 30), how=resources_configuration())
        results.append(RESULT_NAMES[solver.solve(3000, 2**60)])
    assert results[0] == "timeout" or results[0] == results[1], text


@pytest.mark.parametrize("kind", ["Unary", "Reusable"])
def test_a_total_that_does_not_fit_is_proved_after_the_first_failure(tmp_path: Path, kind: str) -> None:
    count = 8
    room = count * 3
    name, made = ("use", "new Unary()") if kind == "Unary" else ("uses", "new Reusable(1.0, 0.0)")
    text = f"{kind} r = {made}; close();"
    for i in range(count):
        text += f"goal(r.{name} u{i}); eq(u{i}.duration, 3); leq(0, u{i}.start); leq(u{i}.end, {{}});"
        text += f"eq(u{i}.quantity, 1.0);" if kind == "Reusable" else ""
    for limit, wanted in ((room, PLAN), (room - 1, EXHAUSTED)):
        bounded = text.replace("{}", str(limit))
        solver = solver_for(tmp_path, bounded, horizon=(0, 100), how=resources_configuration())
        assert solver.solve(20000, 2**60) == wanted
        assert wanted == PLAN or solver.failures < 5 * count


def test_a_conflict_over_a_resource_goes_back_past_what_has_no_part_in_it(tmp_path: Path) -> None:
    text = "Unary r = new Unary(); close();"
    for i in range(3):
        text += f"goal(r.use u{i}); eq(u{i}.duration, 3); leq(0, u{i}.start); leq(u{i}.end, 8);"
    free = "class F extends Timeline { predicate p { int x; } } F f = new F(); "
    text = (
        free + text + "".join(f"goal(f.p g{i}); leq(1, g{i}.x); leq(g{i}.x, 3); g{i}.start = [1 5];" for i in range(4))
    )
    steps = [solver_for(tmp_path, text, europa=europa, how=resources_configuration()) for europa in (False, True)]
    assert steps[0].solve(2000, 2**60) == EXHAUSTED
    assert steps[0].steps < 60
    steps[1].solve(500, 2**60)
    assert steps[1].steps == 500


@pytest.mark.parametrize("europa", [False, True])
def test_what_was_known_of_a_token_that_was_undone_is_forgotten(tmp_path: Path, europa: bool) -> None:
    text = """
    class T extends Timeline { predicate p { leq(0, start); leq(end, 6); } predicate q { leq(0, start); leq(end, 6); } }
    T t0 = new T();
    T t1 = new T();
    Unary r = new Unary();
    close();
    T::p { duration <= 1; starts_during(t1.q c); contains(Unary.use u); }
    T::q { meets(Unary.use u); }
    goal(T.p a);
    goal(t0.q b);
    goal(T.q c);
    c.start = [5 6];
    """
    solver = solver_for(tmp_path, text, europa=europa, horizon=(-10, 1000), how=resources_configuration())
    assert solver.solve(2000, 2**60) == PLAN


@pytest.mark.parametrize("europa", [False, True])
def test_an_order_that_only_distances_imply_mends_a_flaw(tmp_path: Path, europa: bool) -> None:
    text = """
    class T extends Timeline { predicate p { leq(0, start); leq(end, 11); } }
    T t = new T();
    T s = new T();
    Reusable r = new Reusable(1.0, 0.0);
    close();
    T::p { ends(Reusable.uses u); u.duration == 1; u.quantity == 1.0; }
    goal(t.p a);
    goal(s.p b);
    a ends_after b;
    """
    solver = solver_for(tmp_path, text, europa=europa, how=resources_configuration())
    assert solver.solve(2000, 2**60) == PLAN


@pytest.mark.parametrize("europa", [False, True])
def test_a_model_may_have_thousands_of_objects(tmp_path: Path, europa: bool) -> None:
    lamps = "\n".join(f"Lamp l{k} = new Lamp();" for k in range(3000))
    model = "class Lamp extends Timeline { predicate Lit { } }\n" + lamps + "\ngoal(l2999.Lit g);\neq(g.duration, 5);"
    assert verdict(tmp_path, model, europa=europa) == "plan"


def test_tokens_whose_reals_differ_are_not_merged(tmp_path: Path) -> None:
    model = """
    class T extends Timeline { predicate p { float x = [0.0 1.0]; } }
    T t = new T();
    close();
    goal(t.p a);
    goal(t.p b);
    a.start = [0 5];
    b.start = [0 5];
    a.x < b.x;
    """
    assert verdict(tmp_path, model) == "plan"
    assert verdict(tmp_path, model + "a.start == b.start;") == "exhausted"
