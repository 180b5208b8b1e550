"""Rules and guards: what fires when, and what is taken back."""

from runtime.plan.database import PlanDatabase
from runtime.plan.readout.readout import live_tokens, token_names
from runtime.plan.tags import FIRST_PARAMETER
from tests.plan.models import OBJECTS, TIMELINES, domains, loaded, token, tokens

SCENE = TIMELINES + OBJECTS
GUARDED = "T::p { if (x == 1) { meets(object.q s); } else if (x == 2) { starts(object.r s); } }"


def states(text: str) -> dict[str, str]:
    """The states of all tokens."""
    return {name: each["state"] for name, each in tokens(loaded(text)).items()}


def test_a_rule_fires_at_activation_and_is_undone_by_cancel() -> None:
    text = TIMELINES + "T::p { meets(object.q s); eq(s.x, x); eq(x, 4); }" + OBJECTS + "goal(t.p g); g.activate();"
    assert domains(loaded(text))["T.q#1.x"] == "{4} int"
    assert set(tokens(loaded(text + "g.cancel();"))) == {"g"}
    assert domains(loaded(text + "g.cancel();"))["g.x"] == "[-inf, +inf] int"
    assert set(tokens(loaded(text + "g.cancel(); g.activate();"))) == {"g", "T.q#1"}


def test_a_guard_waits_until_its_variable_is_decided() -> None:
    start = TIMELINES + GUARDED + OBJECTS + "goal(t.p g); g.activate();"
    assert set(tokens(loaded(start + "g.x >= 1; g.x <= 1;"))) == {"g"}
    assert set(tokens(loaded(start + "g.x = 1;"))) == {"g", "T.q#1"}
    assert set(tokens(loaded(start + "g.x = 2;"))) == {"g", "T.r#1"}


def test_a_guard_follows_its_variable_when_that_is_decided_anew() -> None:
    start = TIMELINES + GUARDED + OBJECTS + "goal(t.p g); g.activate(); g.x.specify(1);"
    assert set(tokens(loaded(start + "g.x.reset();"))) == {"g"}
    assert set(tokens(loaded(start + "g.x.reset(); g.x.specify(2);"))) == {"g", "T.r#1"}
    assert set(tokens(loaded(start + "g.x.reset(); g.x.specify(1);"))) == {"g", "T.q#1"}
    assert set(tokens(loaded(start + "eq(g.x, 1); g.x.reset();"))) == {"g"}


def test_a_guard_on_a_field_is_decided_with_its_object() -> None:
    text = """
    class O { int k; O(int v) { k = v; } }
    class T extends Timeline { predicate a { O o; } predicate yes { } predicate no { } }
    T::a { if (o.k == 1) { starts(object.yes s); } else { starts(object.no s); } }
    O o1 = new O(1); O o2 = new O(2); T t = new T(); close();
    goal(t.a g); g.activate();
    """
    assert set(tokens(loaded(text))) == {"g"}
    assert set(tokens(loaded(text + "g.o.specify(o2);"))) == {"g", "T.no#1"}
    assert set(tokens(loaded(text + "g.o.specify(o2); g.o.reset();"))) == {"g"}


def test_a_guard_in_a_loop_keeps_the_object_of_its_round() -> None:
    text = """
    class L { int k; L(int v) { k = v; } }
    class T extends Timeline { predicate a { int x; } predicate q { int k; } }
    T::a { L all; foreach (v in all) { if (x == 1) { any(object.q s); eq(s.k, v.k); } } }
    L l1 = new L(1); L l2 = new L(2); T t = new T(); close();
    goal(t.a g); g.activate(); g.x = 1;
    """
    assert [domains(loaded(text))[f"T.q#{n}.k"] for n in (1, 2)] == ["{1} int", "{2} int"]


def test_a_branch_inside_a_branch_goes_with_the_outer_one() -> None:
    text = TIMELINES + "T::p { if (x == 1) { meets(object.q s); if (s.x == 5) { any(object.r k); } } }" + OBJECTS
    database = loaded(text + "goal(t.p g); g.activate(); g.x.specify(1);")
    child = next(t for t in range(2) if t != token(database, "g"))
    assert database.specify(database.plan.rows.var0[child] + 5, 5)
    assert set(tokens(database)) == {"g", "T.q#1", "T.r#1"}
    assert database.reset(database.plan.rows.var0[token(database, "g")] + 5)
    assert set(tokens(database)) == {"g"}


def test_rules_of_the_base_class_fire_first() -> None:
    text = """
    class A extends Timeline { predicate p { } predicate q { } predicate r { } }
    class B extends A { }
    A::p { any(object.q s); }
    B::p { any(object.r s); }
    B b = new B(); close();
    goal(b.p g); g.activate();
    """
    assert list(tokens(loaded(text))) == ["g", "B.q#1", "B.r#1"]


def test_a_sampled_parameter_takes_what_the_environment_draws() -> None:
    text = "float RATE = [0.1 4.0]; class T extends Timeline { predicate p { float f; } }"
    text += "T::p { f == sampledParameter(RATE); } T t = new T(); close(); goal(t.p g); g.activate();"
    assert domains(loaded(text, lambda name, _: {"RATE": 2.5}.get(name)))["g.f"] == "{2.5} float"
    assert domains(loaded(text, lambda name, _: {"OTHER": 2.5}.get(name)))["g.f"] == "[0.1, 4.0] float"


def test_a_merged_token_decides_for_the_one_that_stands_for_it() -> None:
    text = TIMELINES + GUARDED + OBJECTS + "goal(t.p g); goal(t.p h); h.x = 1; g.activate();"
    assert states(text + "h.merge(g);") == {"g": "ACTIVE", "h": "MERGED", "T.q#1": "INACTIVE"}
    assert states(text + "h.merge(g); h.cancel();") == {"g": "ACTIVE", "h": "INACTIVE"}


WITH_CHILD = TIMELINES + "T::p { equals(object.q c); if (c.x == 3) { meets(object.r s); } }" + OBJECTS


def with_merged_child(text: str) -> PlanDatabase:
    """The child of `g` is merged with `h`."""
    database = loaded(WITH_CHILD + "goal(t.p g); goal(t.q h); h.activate(); g.activate();" + text)
    child = next(t for t, name in token_names(database, live_tokens(database)).items() if name == "T.q#1")
    assert database.merge(child, token(database, "h"), -1)
    return database


def test_a_guard_on_a_merged_child_is_decided_by_the_token_that_stands_for_it() -> None:
    assert set(tokens(with_merged_child("h.x = 3;"))) == {"g", "h", "T.q#1", "T.r#1"}
    assert set(tokens(with_merged_child("h.x = 4;"))) == {"g", "h", "T.q#1"}
    database = with_merged_child("eq(h.x, 3);")
    assert set(tokens(database)) == {"g", "h", "T.q#1"}
    x = database.plan.rows.var0[token(database, "h")] + FIRST_PARAMETER
    assert database.specify(x, 3, -1)
    assert set(tokens(database)) == {"g", "h", "T.q#1", "T.r#1"}
    assert database.reset(x)
    assert set(tokens(database)) == {"g", "h", "T.q#1"}


def test_a_guard_on_a_child_that_is_merged_no_more_waits_again() -> None:
    database = with_merged_child("h.x = 3;")
    x = database.plan.rows.var0[token(database, "h")] + FIRST_PARAMETER
    assert database.plan.variable_guards[x] == 1
    child = next(t for t, name in token_names(database, live_tokens(database)).items() if name == "T.q#1")
    assert database.cancel(child)
    assert set(tokens(database)) == {"g", "h", "T.q#1"}
    assert database.plan.variable_guards[x] == 0


def test_going_back_undoes_what_a_merge_let_a_guard_do() -> None:
    database = loaded(WITH_CHILD + "goal(t.p g); goal(t.q h); h.x = 3; h.activate(); g.activate();")
    child = next(t for t, name in token_names(database, live_tokens(database)).items() if name == "T.q#1")
    mark = database.mark()
    for _ in range(2):
        assert database.merge(child, token(database, "h"), -1)
        assert set(tokens(database)) == {"g", "h", "T.q#1", "T.r#1"}
        database.rewind(mark)
        assert set(tokens(database)) == {"g", "h", "T.q#1"}


def test_cancelling_a_token_splits_those_merged_into_it() -> None:
    text = SCENE + "goal(t.p g); goal(t.p h); h.x = [2 5]; g.x = [0 3]; g.activate(); h.merge(g); g.cancel();"
    assert states(text) == {"g": "INACTIVE", "h": "INACTIVE"}
    assert domains(loaded(text))["g.x"] == "[0, 3] int"


def test_a_chain_of_children_is_no_recursion() -> None:
    text = (
        "class T extends Timeline { predicate p { } } T::p { meets(object.p s); } T t = new T(); close(); goal(t.p g);"
    )
    database = loaded(text)
    t = token(database, "g")
    for _ in range(200):
        assert database.activate(t)
        t = database.plan.rows.children[t]
    assert database.plan.rows.live == 201
    assert database.remove_tokens([token(database, "g")])
    assert database.plan.rows.live == 0


def test_a_field_of_an_undecided_object_has_the_type_that_its_class_gives_it() -> None:
    text = """
    class Road { string end_point; Road(string g) { end_point = g; } }
    class Town { }
    class Rail { Town end_point; float fare; Rail(Town t, float f) { end_point = t; fare = f; } }
    class Ticket { int fare; Ticket(int f) { fare = f; } }
    class T extends Timeline { predicate ride { Rail by; Town to; float paid; } }
    T::ride { eq(by.end_point, to); eq(by.fare, paid); }
    Ticket ticket = new Ticket(3);
    Town ulm = new Town(); Town jena = new Town(); Town kiel = new Town();
    Rail south = new Rail(ulm, 2.5);
    Rail east = new Rail(jena, 7.25);
    T t = new T(); close();
    goal(t.ride g); g.activate();
    """
    assert domains(loaded(text))["g.to"] == "{jena, ulm} Town"
    assert domains(loaded(text + "g.to.specify(jena);"))["g.paid"] == "{7.25} float"


def test_an_object_holds_as_a_guard_once_it_is_decided_be_it_the_first_or_not() -> None:
    text = """
    class Buoy { }
    class T extends Timeline { predicate tie { Buoy buoy; } predicate wait { } predicate go { } }
    T::tie { if (buoy) { meets(object.wait w); } else { meets(object.go g); } }
    Buoy near = new Buoy(); Buoy far = new Buoy();
    T t = new T(); close();
    goal(t.tie a); a.activate();
    """
    assert set(tokens(loaded(text))) == {"a"}
    assert set(tokens(loaded(text + "a.buoy = near;"))) == {"a", "T.wait#1"}
    assert set(tokens(loaded(text + "a.buoy = far;"))) == {"a", "T.wait#1"}
