"""Models in, instructions out: what each construct becomes."""

import pytest

from compiler.instructions import all_instructions
from compiler.lower import compile_model
from compiler.program import Child, NewVariable, Program
from nddl_lang.analysis import analyse_text
from nddl_lang.syntax.dialect import Dialect
from tests.compiler.listing import body

WORLD = """
enum Color { red, green }
enum Drawn { WIND }
typedef float [0.5 4.0] Rate;
Rate RATE;
class L { int k; float z; L next; L(int v) { k = v; } L() { } }
class T extends Timeline {
    L ref;
    predicate a { int x; int y; float f; bool g; bool h; Color c; L o; string s; }
    predicate b { int v; }
    action go { }
}
L l1 = new L(1);
L l2 = new L(2);
T t = new T();
int n = [0 9];
"""


def compiled(text: str, dialect: Dialect = Dialect.NDDLC) -> Program:
    """The program of a text, which must be free of errors."""
    analysis = analyse_text("model.nddl", text, dialect)
    assert not analysis.has_errors, [each.message for each in analysis.diagnostics]
    return compile_model(analysis)


def rule(text: str, dialect: Dialect = Dialect.NDDLC) -> list[str]:
    """The lines of a rule on T.a."""
    return list(body(compiled(f"{WORLD}T::a {{ {text} }}\n", dialect).rules[0].body, 0))


def script(text: str, dialect: Dialect = Dialect.NDDLC) -> list[str]:
    """The lines of the script, without those of the world it starts in."""
    known = len(compiled(WORLD).script)
    return list(body(compiled(f"{WORLD}{text}\n", dialect).script[known:], 0))


ENFORCED = [
    ("x == 3;", ["eq(t0.p0, {3} int)"]),
    ("x != y;", ["neq(t0.p0, t0.p1)"]),
    ("x < y;", ["lt(t0.p0, t0.p1)"]),
    ("x > y;", ["lt(t0.p1, t0.p0)"]),
    ("x <= 2.5;", ["leq(t0.p0, {2.5} float)"]),
    ("x >= y;", ["leq(t0.p1, t0.p0)"]),
    ("x == [2 4];", ["eq(t0.p0, [2, 4] int)"]),
    ("x == {2, 4};", ["eq(t0.p0, {2, 4} int)"]),
    ("c == red;", ["eq(t0.p5, {red} Color)"]),
    ("c != Color.green;", ["neq(t0.p5, {green} Color)"]),
    ("g;", ["eq(t0.p3, {True} bool)"]),
    ("false;", ["eq({False} bool, {True} bool)"]),
    ('x == y : "they agree";', ["eq(t0.p0, t0.p1) : they agree"]),
    ("enforce x == y;", ["eq(t0.p0, t0.p1)"]),
    ("x == 3 && g;", ["eq(t0.p0, {3} int)", "eq(t0.p3, {True} bool)"]),
    ("g || h;", ["or(t0.p3, t0.p4)"]),
    ("g == (x == 3);", ["testEq(t0.p3, t0.p0, {3} int)"]),
    ("g == (x > 3);", ["testLessThan(t0.p3, {3} int, t0.p0)"]),
    ("g == (x != y && h);", ["v0: bool -", "testNeq(v0, t0.p0, t0.p1)", "testAnd(t0.p3, v0, t0.p4)"]),
    ("x < y < 2;", ["v0: bool -", "testLessThan(v0, t0.p0, t0.p1)", "lt(v0, {2} int)"]),
    ("o == l1;", ["eq(t0.p6, g1)"]),
    ("o.next.k == object.ref.k;", ["eq(t0.p6.next.k, t0.object.ref.k)"]),
    ("eq(x, y, 3);", ["eq(t0.p0, t0.p1, {3} int)"]),
    ("multEq(x, y, 6);", ["mulEq(t0.p0, t0.p1, {6} int)"]),
    ("max(x, y, 3);", ["allMax(t0.p0, t0.p1, {3} int)"]),
    ("lockCT(x, [2 4]);", ["lockCT(t0.p0, [2, 4] int)"]),
]


@pytest.mark.parametrize(("text", "lines"), ENFORCED)
def test_a_statement_posts_what_makes_it_true(text: str, lines: list[str]) -> None:
    assert rule(text, Dialect.NDDL3) == lines


ARITHMETIC = [
    ("x == y + 1;", ["addEq(t0.p1, {1} int, t0.p0)"]),
    ("y + 1 == x;", ["addEq(t0.p1, {1} int, t0.p0)"]),
    ("x == y - 1;", ["addEq(t0.p0, {1} int, t0.p1)"]),
    ("x * 3 == 9;", ["mulEq(t0.p0, {3} int, {9} int)"]),
    ("x == 2 + 3 * 4;", ["eq(t0.p0, {14} int)"]),
    ("x + 1 < y;", ["v0: int -", "addEq(t0.p0, {1} int, v0)", "lt(v0, t0.p1)"]),
    (
        "x + y == x * y;",
        ["v0: int -", "addEq(t0.p0, t0.p1, v0)", "mulEq(t0.p0, t0.p1, v0)"],
    ),
    ("x == mod(y, 4);", ["mod(t0.p0, t0.p1, {4} int)"]),
    ("f == max(2.0, 5.0);", ["maxf(t0.p2, {2.0} float, {5.0} float)"]),
    ("x == mod(7, 4) + 10;", ["v0: int -", "mod(v0, {7} int, {4} int)", "addEq(v0, {10} int, t0.p0)"]),
    ("g == isSingleton(x);", ["testSingleton(t0.p3, t0.p0)"]),
    ("g == isSpecified(x);", ["testSpecified(t0.p3, t0.p0)"]),
]


@pytest.mark.parametrize(("text", "lines"), ARITHMETIC)
def test_arithmetic_computes_straight_into_the_variable_it_is_compared_with(text: str, lines: list[str]) -> None:
    assert rule(text, Dialect.NDDL3) == lines


TIMES = [
    ("start == 3;", ["concurrent(t0.start, {3} int)"]),
    ("start <= end;", ["precedes(t0.start, t0.end)"]),
    ("end >= 3;", ["precedes({3} int, t0.end)"]),
    ("start < 3;", ["lt(t0.start, {3} int)"]),
    ("start < end;", ["strictlyPrecedes(t0.start, t0.end)"]),
    ("start != end;", ["neq(t0.start, t0.end)"]),
    ("start <= 2.5;", ["leq(t0.start, {2.5} float)"]),
    ("start + 3 == end;", ["temporalDistance(t0.start, [3, 3] int, t0.end)"]),
    ("3 + start == end;", ["temporalDistance(t0.start, [3, 3] int, t0.end)"]),
    ("end == start + x;", ["temporalDistance(t0.start, t0.p0, t0.end)"]),
    ("end - start == x;", ["temporalDistance(t0.start, t0.p0, t0.end)"]),
    ("end - x == start;", ["temporalDistance(t0.start, t0.p0, t0.end)"]),
    ("duration == end - start;", ["temporalDistance(t0.start, t0.duration, t0.end)"]),
    ("end - start <= 7;", ["temporalDistance(t0.start, [-4503599627370495, 7] int, t0.end)"]),
    ("end - start > 7;", ["temporalDistance(t0.end, [-4503599627370495, -8] int, t0.start)"]),
    ("start + x <= end;", ["v0: int -", "addEq(t0.start, t0.p0, v0)", "precedes(v0, t0.end)"]),
    ("duration <= f;", ["leq(t0.duration, t0.p2)"]),
]


@pytest.mark.parametrize(("text", "lines"), TIMES)
def test_times_are_compared_in_the_temporal_network(text: str, lines: list[str]) -> None:
    assert rule(text, Dialect.NDDL3) == lines


EXTENSIONS = [
    ("f == x + 2.5;", ["addEq(t0.p0, {2.5} float, t0.p2)"]),
    ("f == x / y;", ["divEq(t0.p0, t0.p1, t0.p2)"]),
    ("x == -y;", ["neg(t0.p0, t0.p1)"]),
    ("x == -3;", ["eq(t0.p0, {-3} int)"]),
    ("x==y-1;", ["addEq(t0.p0, {1} int, t0.p1)"]),
    ("!g;", ["eq(t0.p3, {False} bool)"]),
    ("!(x == 3);", ["neq(t0.p0, {3} int)"]),
    ("!(x < 3);", ["leq({3} int, t0.p0)"]),
    ("g == !h;", ["neq(t0.p3, t0.p4)"]),
    ("eq(x + 1, y);", ["v0: int -", "addEq(t0.p0, {1} int, v0)", "eq(v0, t0.p1)"]),
    ("int i = x + 1;", ["v0: int i", "addEq(t0.p0, {1} int, v0)"]),
    ("int i = 1 + 2;", ["v0: int i = {3} int"]),
    ("f == sampledParameter(RATE);", ["sample t0.p2 from RATE"]),
    ("sampledParameter(WIND) == f;", ["sample t0.p2 from WIND"]),
    ("float r = sampledParameter(RATE);", ["v0: float r", "sample v0 from RATE"]),
    ("f <= sampledParameter(RATE);", ["v0: float -", "sample v0 from RATE", "leq(t0.p2, v0)"]),
    ("before [1 5] (object.b q);", ["t1 = child T.b q on own, t0 before [1, 5]"]),
]


@pytest.mark.parametrize(("text", "lines"), EXTENSIONS)
def test_extensions_of_nddlc_need_no_constraints_of_their_own(text: str, lines: list[str]) -> None:
    assert rule(text) == lines


CHILDREN = [
    ("meets(b q);", ["t1 = child T.b q on own, t0 meets"]),
    ("meets(object.b);", ["t1 = child T.b on own, t0 meets"]),
    ("meets(T.b q);", ["t1 = child T.b q on any, t0 meets"]),
    ("T z; meets(z.b q);", ["v0: T z", "t1 = child T.b q on v0, t0 meets"]),
    ("meets(b q, b r);", ["t1 = child T.b q on own, t0 meets", "t2 = child T.b r on own, t0 meets"]),
    (
        "meets(b q); q before(b r);",
        ["t1 = child T.b q on own, t0 meets", "t2 = child T.b r on own, t1 before"],
    ),
    (
        "any(b q); any(b r); q meets r; r.v == q.v;",
        ["t1 = child T.b q on own, t0 any", "t2 = child T.b r on own, t0 any", "t1 meets t2", "eq(t2.p0, t1.p0)"],
    ),
    ("any(b x); x == 3; x.v == 4;", ["t1 = child T.b x on own, t0 any", "eq(t0.p0, {3} int)", "eq(t1.p0, {4} int)"]),
    ("this.x == 4;", ["eq(t0.p0, {4} int)"]),
]


@pytest.mark.parametrize(("text", "lines"), CHILDREN)
def test_relations_create_children_in_slots_of_their_own(text: str, lines: list[str]) -> None:
    assert rule(text, Dialect.NDDL3) == lines


LOCALS = [
    ("int i;", ["v0: int i"]),
    ("float i = [0 10];", ["v0: float i = [0.0, 10.0] float"]),
    ("int i = x;", ["v0: int i = copy of t0.p0"]),
    ("Color i = {red, green};", ["v0: Color i = {red, green} Color"]),
    ("L i = {l1, l2};", ["v0: L i = copy of union(g1, g2)"]),
    ("L i = new L(3);", ["v0 = new L#0({3} int) i"]),
    ("int x = 3; eq(duration, x);", ["v0: int x = {3} int", "eq(t0.duration, v0)"]),
]


@pytest.mark.parametrize(("text", "lines"), LOCALS)
def test_locals_take_the_base_domain_of_their_initialiser(text: str, lines: list[str]) -> None:
    assert rule(text, Dialect.NDDL3) == lines


GUARDS = [
    ("if (x == 3) { y == 1; }", ["v0: bool -", "testEq(v0, t0.p0, {3} int)", "if v0 decided by (t0.p0)"]),
    ("if (g) { y == 1; }", ["if t0.p3 decided by (t0.p3)"]),
    ("if (true) { y == 1; }", ["if {True} bool decided by ()"]),
    ("if (x == y) { y == 1; }", ["v0: bool -", "testEq(v0, t0.p0, t0.p1)", "if v0 decided by (t0.p0, t0.p1)"]),
    (
        "if (x == {3, 4}) { y == 1; }",
        ["v0: bool -", "testEq(v0, t0.p0, {3, 4} int)", "if v0 decided by (t0.p0, {3, 4} int)"],
    ),
    ("if (o.k == 1) { y == 1; }", ["v0: bool -", "testEq(v0, t0.p6.k, {1} int)", "if v0 decided by (t0.p6.k)"]),
    (
        "if (x + 1 == 4) { y == 1; }",
        ["v0: bool -", "v1: int -", "addEq(t0.p0, {1} int, v1)", "testEq(v0, v1, {4} int)", "if v0 decided by (t0.p0)"],
    ),
    ("if (isSingleton(x)) { y == 1; }", ["v0: bool -", "testSingleton(v0, t0.p0)", "if v0 decided by (t0.p0)"]),
]


@pytest.mark.parametrize(("text", "lines"), GUARDS)
def test_a_guard_waits_for_every_variable_of_its_expression(text: str, lines: list[str]) -> None:
    assert rule(text, Dialect.NDDL3) == [*lines, "  eq(t0.p1, {1} int)"]


def test_a_guard_on_a_computed_local_waits_for_what_computes_it() -> None:
    assert "if v1 decided by (t0.p0, t0.p1)" in rule("int i = x * y; if (i == 4) { g; }")


def test_a_guard_on_a_computed_parameter_waits_for_what_computes_it() -> None:
    text = (
        "class T extends Timeline { predicate p { int x; int y = x * 2; } }\n"
        "T::p { meets(p q); if (q.y == 4) { q.x == x; } }\n"
    )
    assert "if v0 decided by (t1.p0)" in list(body(compiled(text).rules[0].body, 0))


def test_else_if_nests() -> None:
    assert rule("if (g) { x == 1; } else if (h) { x == 2; } else { x == 3; }") == [
        "if t0.p3 decided by (t0.p3)",
        "  eq(t0.p0, {1} int)",
        "else",
        "  if t0.p4 decided by (t0.p4)",
        "    eq(t0.p0, {2} int)",
        "  else",
        "    eq(t0.p0, {3} int)",
    ]


def test_foreach_puts_each_object_in_a_slot() -> None:
    assert rule("L all; foreach (v in all) { any(object.b s); eq(s.v, v.k); }") == [
        "v0: L all",
        "foreach v1 in v0",
        "  t1 = child T.b s on own, t0 any",
        "  eq(t1.p0, v1.k)",
    ]


SCRIPT = [
    ("int i = 3;", ["g5: int i = {3} int"]),
    ("float i = 3;", ["g5: float i = {3.0} float"]),
    ("int i = n;", ["g5: int i = copy of g4"]),
    ("n = [2 3];", ["g4 = [2, 3] int"]),
    ("L i;", ["g5: L i"]),
    ("L i = new L(7);", ["g5 = new L#0({7} int) i"]),
    ("new L(7);", ["new L#0({7} int)"]),
    ("L i; i = new L();", ["g5: L i", "g5 = new L#1() i"]),
    ("l1.z = 4;", ["g1.z = {4.0} float"]),
    ("goal(t.a q);", ["t0 = goal T.a q on g3"]),
    ("fact(T.a);", ["t0 = fact T.a on any"]),
    ("rejectable(t.a q, t.b r);", ["t0 = rejectable T.a q on g3", "t1 = rejectable T.b r on g3"]),
    ("goal(t.a q); q.x = [0 5];", ["t0 = goal T.a q on g3", "t0.p0 = [0, 5] int"]),
    ("goal(t.a q); q.activate();", ["t0 = goal T.a q on g3", "t0.activate()"]),
    ("goal(t.a q); q.state = ACTIVE;", ["t0 = goal T.a q on g3", "t0.activate()"]),
    (
        "goal(t.a q, t.a r); r.activate(); q.merge(r);",
        ["t0 = goal T.a q on g3", "t1 = goal T.a r on g3", "t1.activate()", "t0.merge(t1.state)"],
    ),
    ("goal(t.a q); q meets (t.b r);", ["t0 = goal T.a q on g3", "t1 = goal T.b r on g3", "t0 meets t1"]),
    (
        "goal(t.a q); q.activate(); t.constrain(q);",
        ["t0 = goal T.a q on g3", "t0.activate()", "g3.constrain(t0.state)"],
    ),
    ("n.specify(4);", ["g4.specify({4} int)"]),
    ("n.specify([4 7]);", ["g4 = [4, 7] int"]),
    ("goal(t.a q); q.x.reset();", ["t0 = goal T.a q on g3", "t0.p0.reset()"]),
    ("close();", ["close()"]),
    ("L.close();", ["L.close()"]),
    ("n + 1 < 4;", ["v0: int -", "addEq(g4, {1} int, v0)", "lt(v0, {4} int)"]),
]


@pytest.mark.parametrize(("text", "lines"), SCRIPT)
def test_statements_of_the_script_are_executed_in_order(text: str, lines: list[str]) -> None:
    assert script(text, Dialect.NDDL3) == lines


def test_a_global_may_be_computed() -> None:
    assert script("int i = n + 1;") == ["g5: int i", "addEq(g4, {1} int, g5)"]


def test_a_rule_knows_how_much_of_the_script_stands_above_it() -> None:
    program = compiled(f"{WORLD}goal(t.a q);\nT::a {{ x == 3; }}\nq.activate();\n")
    assert program.rules[0].declared_at == len(program.script) - 1


def test_rules_of_ancestors_fire_first() -> None:
    text = f"{WORLD}class U extends T {{ }}\nU::a {{ x == 1; }}\nT::a {{ x == 2; }}\nU::a {{ x == 3; }}\n"
    rules = {predicate.name: predicate.rules for predicate in compiled(text).predicates}
    assert rules["U.a"] == (1, 0, 2)
    assert rules["T.a"] == (1,)


def test_a_redeclared_predicate_runs_the_constraints_of_all_levels() -> None:
    text = (
        "class T extends Timeline { predicate p { int x; x <= 5; } }\n"
        "class U extends T { predicate p { int y; y == x; duration = 3; } }\n"
    )
    predicates = {predicate.name: predicate for predicate in compiled(text).predicates}
    assert [parameter.name for parameter in predicates["U.p"].parameters] == ["x", "y"]
    assert list(body(predicates["U.p"].body, 0)) == [
        "leq(t0.p0, {5} int)",
        "eq(t0.p1, t0.p0)",
        "t0.duration = {3} int",
    ]


def test_what_an_action_yields_in_any_case_is_listed_in_order_of_appearance() -> None:
    text = (
        f"{WORLD}T::go {{ meets(effect b q); if (true) {{ any(effect a r); }} any(effect b s); any(condition a z); }}\n"
    )
    predicates = {predicate.name: predicate for predicate in compiled(text).predicates}
    assert predicates["T.go"].effects == ("T.b", "T.b")


def test_constructors_call_the_base_class_first() -> None:
    text = (
        "class A { int x; A(int v) { x = v; } A() { } }\n"
        "class B extends A { int y; B(int v) { super(v); y = 2; } B() { y = 3; } }\n"
    )
    classes = {class_.name: class_ for class_ in compiled(text, Dialect.NDDL3).classes}
    assert [member.name for member in classes["B"].members] == ["x", "y"]
    assert [list(body(constructor.body, 0)) for constructor in classes["B"].constructors] == [
        ["super A#0(v0)", "this.y = {2} int"],
        ["super A#1()", "this.y = {3} int"],
    ]


def test_a_constructor_may_pass_and_make_objects() -> None:
    text = "class P;\nclass Q { P p; Q(P v) { p = v; } }\nclass P { Q q; P() { q = new Q(this); } }\n"
    classes = {class_.name: class_ for class_ in compiled(text, Dialect.NDDL3).classes}
    assert list(body(classes["P"].constructors[0].body, 1))[-1].strip() == "this.q = new Q#0(this) q"


def test_a_member_is_initialised_unless_the_constructor_does_it() -> None:
    text = "class A { int x = 3; int y = 4; A(int v) { x = v; } }\n"
    constructor = compiled(text).classes[-1].constructors[0]
    assert list(body(constructor.body, 0)) == ["super Object#0()", "this.y = {4} int", "this.x = copy of v0"]


def test_sampled_parameters_are_listed_with_range_and_uses() -> None:
    text = f"{WORLD}T::a {{ f == sampledParameter(RATE); float w = sampledParameter(RATE); }}\n"
    (site,) = compiled(text).sampled
    assert (site.name, site.kind, len(site.uses)) == ("RATE", "float", 2)
    assert site.default is not None
    assert site.default.interval == (0.5, 4.0)


def test_slots_are_dense_and_belong_to_one_thing_each() -> None:
    program = compiled(
        f"{WORLD}T::a {{ int i; if (x + i == 3) {{ any(b q); int j = q.v; }} else {{ any(b q); int k = x * 2; }} }}\n"
    )
    code = program.rules[0]
    variables = [each.slot for each in all_instructions(code.body) if isinstance(each, NewVariable)]
    tokens = [each.slot for each in all_instructions(code.body) if isinstance(each, Child)]
    assert sorted(variables) == list(range(code.slots))
    assert sorted(tokens) == list(range(1, code.tokens))
