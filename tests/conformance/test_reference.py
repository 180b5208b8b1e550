"""What the reference says of constraints, relations and expressions, beyond the public cases: small models, domains."""

from collections.abc import Iterator

import pytest

from compiler.lower import compile_model
from nddl_lang.analysis import analyse_text
from nddl_lang.semantics.relations import RELATIONS
from nddl_lang.syntax.dialect import Dialect
from runtime.plan.database import PlanDatabase
from runtime.plan.readout.readout import read
from tests.conformance.judge import Facts, same_domain

INCONSISTENT = {"consistent": "False"}


def loaded(text: str, dialect: Dialect = Dialect.NDDL3) -> Facts:
    """What loading a text without errors leaves behind."""
    analysis = analyse_text("model.nddl", text, dialect)
    assert not analysis.has_errors, [each.message for each in analysis.diagnostics]
    database = PlanDatabase(compile_model(analysis))
    fault = database.run_script()
    assert fault is None, fault.message
    return read(database)


CONSTRAINTS = [
    ("int a = 12; int b = 4; int c; divEq(a, b, c);", {"c": "{3} int"}),
    ("int a; int b = 4; int c = 3; divEq(a, b, c);", {"a": "{12} int"}),
    ("int a = 12; int b = 0; int c; divEq(a, b, c);", INCONSISTENT),
    ("float a = 7.0; float b = 2.0; float c; divEq(a, b, c);", {"c": "{3.5} float"}),
    ("int a; int b = 4; mulEq(a, b, 12);", {"a": "{3} int"}),
    ("int a = [-3 2]; int b = [-1 4]; int c; mulEq(a, b, c);", {"c": "[-12, 8] int"}),
    ("int s = 20; int x = 3; int y; int z = 7; eqSum(s, x, y, z);", {"y": "{10} int"}),
    ("int p = 24; int x = 2; int y; int z = 4; eqProduct(p, x, y, z);", {"y": "{3} int"}),
    ("int a; int b = [2 5]; neg(a, b);", {"a": "[-5, -2] int"}),
    ("float a; float x = 2.2; ceil(a, x);", {"a": "{3.0} float"}),
    ("float a; pow(a, 2.0, 3.0);", {"a": "{8.0} float"}),
    ("float a; float x = -2.5; abs(a, x);", {"a": "{2.5} float"}),
    ("int r = 3; int x; absVal(r, x);", {"x": "<= [-3, 3] int"}),
    ("int m; int x = 3; int y = 5; min(x, y, m);", {"m": "{3} int"}),
    ("int m = 3; int x = [0 9]; int y = [0 9]; eqMaximum(m, x, y);", {"x": "[0, 3] int", "y": "[0, 3] int"}),
    ("float d; calcDistance(d, 0.0, 0.0, 3.0, 4.0);", {"d": "{5.0} float"}),
    ("int a = 3; int b = [0 9]; neq(b, a); b <= 3;", {"b": "[0, 2] int"}),
    ("int a = [0 9]; int b = [5 20]; lt(b, a);", {"a": "[6, 9] int", "b": "[5, 8] int"}),
    ("int a = [1 2]; int b = [1 2]; int c = [1 2]; allDiff(a, b, c); a = 1; b = 2;", INCONSISTENT),
    ("bool a = false; bool b = false; or(a, b);", INCONSISTENT),
    ("int n = 0; int x = [0 3]; int y = [0 3]; countZeroes(n, x, y);", {"x": "[1, 3] int", "y": "[1, 3] int"}),
    ("int n = 2; bool x; bool y; countNonZeroes(n, x, y);", {"x": "{true} bool", "y": "{true} bool"}),
    ("int a; int b = [1 3]; int c = [7 9]; eqUnion(a, b, c);", {"a": "[1, 9] int"}),
    ("bool b; int x = [0 3]; int y = [5 9]; testEq(b, x, y);", {"b": "{false} bool"}),
    ("bool b; int x = [0 3]; testLeq(b, x, 3);", {"b": "{true} bool"}),
    ("bool b; int x = [3 9]; testLessThan(b, x, 3);", {"b": "{false} bool"}),
    ("bool b = false; int x = [0 9]; testLeq(b, x, 3);", {"x": "[4, 9] int"}),
    ("bool b = false; int x = 3; int y = [3 4]; testEq(b, x, y);", {"y": "{4} int"}),
    ("bool c = true; bool a; bool b; testAnd(c, a, b);", {"a": "{true} bool", "b": "{true} bool"}),
    ("bool c = false; bool a; bool b; testOr(c, a, b);", {"a": "{false} bool", "b": "{false} bool"}),
    ("bool b; int x = 1; int y = 2; int z = 1; condAllDiff(b, x, y, z);", {"b": "{false} bool"}),
    ("int x = [0 9]; x == 3 || x == 30;", {"x": "{3} int"}),
    ("int x = [0 9]; int y = [0 9]; x + y == 18;", {"x": "{9} int", "y": "{9} int"}),
    ("int x = [0 9]; int y = [0 9]; x - y == 9;", {"x": "{9} int", "y": "{0} int"}),
    ("int x = [0 9]; x * 2 <= 7;", {"x": "[0, 3] int"}),
    ("bool b; int x = [0 3]; b == (x < 4);", {"b": "{true} bool"}),
    ("bool b; int x = 3; b == (x < 4 && x != 3);", {"b": "{false} bool"}),
    ("float f = 0.1; float g = 0.2; float h; addEq(f, g, h); h == 0.3;", {"h": "{0.3} float"}),
    ("enum E { a, b, c } E x; E y; x != a; eq(x, y); y != b;", {"x": "{c} E", "y": "{c} E"}),
    ('string s = "a"; string r; eq(s, r);', {"r": '{"a"} string'}),
    ("int x = {1, 5, 9}; x > 1; x < 9;", {"x": "{5} int"}),
    ("bool b; b != true;", {"b": "{false} bool"}),
]


@pytest.mark.parametrize(("text", "domains"), CONSTRAINTS, ids=[text for text, _ in CONSTRAINTS])
def test_a_constraint_narrows_as_the_reference_says(text: str, domains: dict[str, str]) -> None:
    facts = loaded(text.replace("; ", ";\n") + "\n")
    if domains is INCONSISTENT:
        assert facts["consistent"] is False
        return
    assert facts["consistent"] is True
    assert {
        name: facts["domains"][name]
        for name, domain in domains.items()
        if not same_domain(domain, facts["domains"][name], {"E"})
    } == {}


# ---- relations: the bounds of one token while the other lies from 10 to 20 ----

Constraint = tuple[str, int, str]  # a - b <= n as (b, n, a): a is no later than n after b
MEANING = {
    "any": "",
    "before": "oe<=ts",
    "after": "te<=os",
    "meets": "oe=ts",
    "met_by": "te=os",
    "starts": "os=ts",
    "ends": "oe=te",
    "equals": "os=ts oe=te",
    "contains": "os<=ts te<=oe",
    "contained_by": "ts<=os oe<=te",
    "parallels": "os<=ts oe<=te",
    "paralleled_by": "ts<=os te<=oe",
    "starts_before": "os<ts",
    "starts_after": "ts<os",
    "starts_before_end": "os<te",
    "starts_during": "ts<=os os<te",
    "ends_before": "oe<te",
    "ends_after": "te<oe",
    "ends_after_start": "ts<oe",
    "ends_during": "ts<oe oe<=te",
    "contains_start": "os<=ts ts<oe",
    "contains_end": "os<te te<=oe",
}


def edges(relation: str, fixed: str) -> Iterator[Constraint]:
    """All that is known of the four times, with the origin (o) or the target (t) from 10 to 20."""
    for token in ("o", "t"):
        yield f"{token}e", -1, f"{token}s"  # the start is at least one before the end
    for point, time in ((f"{fixed}s", 10), (f"{fixed}e", 20)):
        yield "zero", time, point
        yield point, -time, "zero"
    for word in MEANING[relation].split():
        first, sign, second = word[:2], word[2:-2], word[-2:]
        yield second, -1 if sign == "<" else 0, first
        if sign == "=":
            yield first, 0, second


def bounds(relation: str, fixed: str, point: str) -> tuple[float, float]:
    """The tightest bounds of a time, by shortest paths."""
    points = ["zero", "os", "oe", "ts", "te"]
    distance = {(a, b): 0.0 if a == b else float("inf") for a in points for b in points}
    for source, weight, target in edges(relation, fixed):
        distance[source, target] = min(distance[source, target], weight)
    for via in points:
        for a in points:
            for b in points:
                distance[a, b] = min(distance[a, b], distance[a, via] + distance[via, b])
    return -distance[point, "zero"], distance["zero", point]


def test_every_relation_is_known() -> None:
    assert set(MEANING) == set(RELATIONS)


@pytest.mark.parametrize(
    ("in_rule", "fixed"), [(False, "o"), (False, "t"), (True, "o")], ids=["target", "origin", "child"]
)
@pytest.mark.parametrize("relation", MEANING)
def test_a_relation_bounds_the_other_token(relation: str, in_rule: bool, fixed: str) -> None:
    text = (
        "class U extends Timeline { predicate q { } }\n"
        "class T extends Timeline { predicate p { } }\n"
        f"{f'T::p {{ {relation} (U.q); }}' if in_rule else ''}\n"
        "T s = new T();\nU u = new U();\nclose();\ngoal(s.p o);\n"
        f"{'o.activate();' if in_rule else f'goal(u.q t); o {relation} t;'}\n"
    )
    if fixed == "o":
        text += "o.start = 10;\no.end = 20;\n"
    else:
        text += "t.start = 10;\nt.end = 20;\n"
    facts = loaded(text)
    other = "t" if fixed == "o" else "o"
    (token,) = (token for token in facts["tokens"] if token["predicate"] == ("U.q" if other == "t" else "T.p"))
    for name, point in (("start", f"{other}s"), ("end", f"{other}e")):
        assert tuple(float(bound) for bound in token[name]) == bounds(relation, fixed, point), name
