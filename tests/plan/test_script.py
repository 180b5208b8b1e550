"""Statements of the script: what each leaves behind, and what stops it."""

from tests.plan.models import OBJECTS, TIMELINES, domains, loaded, prepared, stopped, tokens

SCENE = TIMELINES + OBJECTS


def test_an_object_made_by_a_constructor_is_named_after_its_member() -> None:
    database = loaded(
        "class B { int k; B(int v) { k = v; } } class A { B b; A(int v) { b = new B(v); } } A a = new A(4);"
    )
    assert domains(database)["a.b"] == "{a.b} B"
    assert domains(database)["a.b.k"] == "{4} int"


def test_the_script_stops_at_the_first_fault_and_keeps_what_was_done() -> None:
    database = prepared("int a = [1 3]; a = 7; int b = 2;")
    fault = database.run_script()
    assert fault is not None
    assert (fault.code.kind, fault.span.text) == ("domain", "a = 7;")
    assert domains(database) == {"a": "[1, 3] int"}


def test_an_inconsistent_statement_does_not_stop_the_script() -> None:
    database = loaded("int a = 5; int b = 6; eq(a, b); int c = 7;")
    assert not database.is_consistent
    assert "c" in domains(database)


def test_a_goal_needs_an_object() -> None:
    fault = stopped(TIMELINES + "goal(T.p g);")
    assert fault.code.kind == "state"
    assert "`T`" in fault.message


def test_a_child_needs_an_object_too() -> None:
    text = TIMELINES + "class U extends Timeline { predicate m { } } T::p { any(U.m s); }" + OBJECTS
    fault = stopped(text + "goal(t.p g); g.activate();")
    assert (fault.code.kind, fault.span.text) == ("state", "U.m s")


def test_deciding_that_a_token_is_active_activates_it() -> None:
    text = TIMELINES + "T::p { meets(object.q s); }" + OBJECTS + "goal(t.p g); g.state.specify(ACTIVE);"
    assert set(tokens(loaded(text))) == {"g", "T.q#1"}


def test_merging_needs_an_active_token_of_the_same_predicate() -> None:
    assert "inactive" in stopped(SCENE + "goal(t.p g); goal(t.p h); h.merge(g);").message
    assert "`T.q`" in stopped(SCENE + "goal(t.p g); goal(t.q h); g.activate(); h.merge(g);").message


def test_only_rejectable_tokens_are_rejected() -> None:
    assert stopped(SCENE + "goal(t.p g); g.reject();").code.kind == "state"
    assert tokens(loaded(SCENE + "rejectable(t.p g); g.reject();"))["g"]["state"] == "REJECTED"


def test_objects_within_objects_come_to_an_end() -> None:
    fault = stopped("class A { A a; A() { a = new A(); } }\nA x = new A();")
    assert (fault.code.kind, fault.span.text) == ("rule", "new A()")
    assert "`A`" in fault.message
    two = "class B; class A { B b; A() { b = new B(); } } class B { A a; B() { a = new A(); } }"
    assert stopped(f"{two} A x = new A();").code.kind == "rule"
    deep = "".join(f"class C{k} {{ C{k - 1} c; C{k}() {{ c = new C{k - 1}(); }} }}\n" for k in range(1, 400))
    loaded(f"class C0 {{ }}\n{deep}C399 c = new C399();")


def test_the_constructor_of_the_farthest_ancestor_is_run() -> None:
    count = 1200  # more than Python's stack has
    heirs = "".join(f"class C{k} extends C{k - 1} {{ C{k}(int v) {{ super(v); }} }}\n" for k in range(1, count))
    database = loaded(f"class C0 {{ int k; C0(int v) {{ k = v; }} }}\n{heirs}C{count - 1} c = new C{count - 1}(4);")
    assert domains(database)["c.k"] == "{4} int"


def test_nothing_is_made_of_a_closed_class() -> None:
    assert stopped("class A { } A.close(); A a = new A();").code.kind == "state"
    text = "class A { } class T extends Timeline { predicate p { } } T::p { A a = new A(); } T t = new T(); close();"
    assert stopped(text + "goal(t.p g); g.activate();").span.text == "new A()"


def test_open_variables_grow_with_the_objects_of_their_class() -> None:
    database = loaded("class A { } class B extends A { } A v; A a = new A(); B b = new B(); int x;")
    assert domains(database)["v"] == "{a, b} A open"


def test_a_decision_is_undone_by_reset() -> None:
    database = loaded("int a = [1 9]; int b; addEq(a, 1, b); a.specify(5); a.reset();")
    assert domains(database) == {"a": "[1, 9] int", "b": "[2, 10] int"}


def test_a_thousand_objects_outgrow_the_first_tables() -> None:
    text = "class A { int k; A(int v) { k = v; } }" + "".join(f"A a{i} = new A({i});" for i in range(300))
    assert domains(loaded(text))["a299.k"] == "{299} int"
