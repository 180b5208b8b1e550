"""Plans by hand for each feature of the language: right ones hold, and a small change of each is noticed."""

import json
from pathlib import Path
from typing import Any

import pytest

from nddlc.main import run

Token = dict[str, Any]
MODEL = """class A extends Timeline {{ predicate p {{ int n; float x; bool b; }} predicate q {{ float y; }} }}
class B extends Timeline {{ predicate r {{ int k; }} predicate idle {{ }} }}
{rules}
A a = new A(); B b = new B(); {objects}
close();
"""


def token(predicate: str, thing: str, begin: int, end: int, **arguments: Any) -> Token:
    return {"predicate": predicate, "object": thing, "start": begin, "end": end, "arguments": arguments}


def event(kind: str, time: int | dict[str, list[int]], quantity: float) -> Token:
    return {"predicate": f"Reservoir.{kind}", "object": "r", "start": time, "arguments": {"quantity": quantity}}


def p(n: int = 1, x: float = 1.5, b: bool = True, end: int = 10, thing: str = "a") -> Token:
    return token("A.p", thing, 0, end, n=n, x=x, b=b)


def r(begin: int, end: int, k: int = 1, thing: str = "b") -> Token:
    return token("B.r", thing, begin, end, k=k)


LATE = "A::p { contains(B.r c); bool f; f == (c.k > 3); if (f == true) { x == 1.0; } else { x == 2.0; } }"
SUM = "A::p { float z; z == n * 0.1; x == z + 0.2; }"
SIDE = "A::p { bool g; g == (x >= 0.3); if (g == true) { n == 1; } else { n == 2; } }"
NESTED = "A::p { if (b == true) { if (n == 1) { meets(A.q s); s.y == x; } else { contains(B.r c); c.k == n; } } }"
TWO = "class C extends A { predicate s { } } C::s { duration == 3; } A::p { duration >= 2; } A::p { n >= 1; }"
EACH = (
    "class P extends Timeline { predicate go { } }\nP::go { B all; foreach (o in all) { contains(o.r c); c.k == 1; } }"
)
NEXT = "A::p { before [1 5] (B.r c); }"
UP, DOWN = (f"A::p {{ int k; k == {name}(x); n == k; }}" for name in ("ceil", "floor"))
TONES = """A home = new A(); enum Tone { low, high }
class T extends Timeline { predicate play { Tone t; A who; } }
T::play { if (t == high) { duration == 4; } else { duration == 2; } who == home; }"""
STORES = "Reservoir r = new Reservoir(10.0, 0.0, 20.0); Reusable u = new Reusable(2.0, 0.0); Unary w = new Unary();"


@pytest.mark.parametrize(
    ("rules", "objects", "tokens", "holds"),
    [
        (LATE, "", [p(x=1.0), r(1, 5, 4)], True),
        (LATE, "", [p(x=2.0), r(1, 5, 3)], True),
        (LATE, "", [p(x=1.0), r(1, 5, 3)], False),
        (LATE, "", [p(x=2.0), r(1, 3, 9), r(4, 6, 1)], True),
        (SUM, "", [p(n=3, x=0.5)], True),
        (SUM, "", [p(n=3, x=0.500005)], True),
        (SUM, "", [p(n=3, x=0.501)], False),
        (SIDE, "", [p(n=1, x=0.1 + 0.2)], True),
        (SIDE, "", [p(n=2, x=0.3 - 5e-6)], True),
        (SIDE, "", [p(n=2, x=0.31)], False),
        (UP, "", [p(n=3, x=2.0000001)], True),
        (UP, "", [p(n=2, x=2.0000001)], True),
        (UP, "", [p(n=2, x=2.001)], False),
        (DOWN, "", [p(n=3, x=2.9999999)], True),
        (DOWN, "", [p(n=3, x=2.999)], False),
        (NESTED, "", [p(), token("A.q", "a", 10, 20, y=1.5)], True),
        (NESTED, "", [p(), token("A.q", "a", 11, 20, y=1.5)], False),
        (NESTED, "", [p(n=7), r(0, 10, 7)], True),
        (NESTED, "", [p(n=7), r(10, 20, 7)], False),
        (NESTED, "", [p(n=7, b=False)], True),
        (NESTED, "", [{**p(), "arguments": {"n": 7, "x": 1.5}}], True),
        (TWO, "C c = new C();", [token("C.s", "c", 0, 3), p(end=2)], True),
        (TWO, "C c = new C();", [p(n=0, end=2)], False),
        (TWO, "C c = new C();", [{**p(end=1, thing="c"), "predicate": "C.p"}], False),
        (EACH, "B b2 = new B(); P g = new P();", [token("P.go", "g", 0, 10), r(1, 2), r(1, 2, thing="b2")], True),
        (EACH, "B b2 = new B(); P g = new P();", [token("P.go", "g", 0, 10), r(1, 2)], False),
        (EACH, "P g = new P();", [token("P.go", "g", 0, 10), r(1, 2)], True),
        (NEXT, "", [p(), r(15, 20)], True),
        (NEXT, "", [p(), r(16, 20)], False),
        (TONES, "T t = new T();", [token("T.play", "t", 0, 4, t="high", who="home")], True),
        (TONES, "T t = new T();", [token("T.play", "t", 0, 4, t="low", who="home")], False),
        (TONES, "T t = new T();", [token("T.play", "t", 0, 4, t="high", who="a")], False),
        ("", STORES, [event("consume", 5, 10.0), event("produce", 6, 20.0)], True),
        ("", STORES, [event("consume", 5, 10.1), event("produce", 6, 20.0)], False),
        ("", STORES, [event("consume", 5, 15.0), event("produce", 5, 15.0)], True),
        ("", STORES, [event("produce", 5, 10.1)], False),
        ("", STORES, [event("consume", 5, 12.0), event("produce", {"between": [3, 9]}, 4.0)], True),
        ("", STORES, [token("Reusable.uses", "u", at, at + 5, quantity=1.0) for at in (0, 3)], True),
        ("", STORES, [token("Reusable.uses", "u", at, at + 5, quantity=1.5) for at in (0, 3)], False),
        ("", STORES, [token("Unary.use", "w", at, at + 5) for at in (0, 5)], True),
        ("", STORES, [token("Unary.use", "w", at, at + 5) for at in (0, 4)], False),
    ],
)
def test_a_plan_is_judged_by_what_its_model_says(
    tmp_path: Path, rules: str, objects: str, tokens: list[Token], holds: bool
) -> None:
    (tmp_path / "m.nddl").write_text(MODEL.format(rules=rules, objects=objects))
    plan = tmp_path / "plan.json"
    plan.write_text(json.dumps({"model": "m.nddl", "last_tick": 20, "tokens": tokens}))
    assert run(["validate", str(plan)]) == (0 if holds else 1)


ANY = "A::p { any(B.r c); c.start == end; c.k == n; }"
TANK = """class Tank extends Reservoir { Tank() { super(10.0, 0.0, 20.0); } } Tank t = new Tank();
A::p { any(t.consume u); u.time == end; u.quantity == 2.0 * n; }"""


def drain(time: int, quantity: float, owner: str = "Tank") -> Token:
    return event("consume", time, quantity) | {"predicate": f"{owner}.consume", "object": "t"}


@pytest.mark.parametrize(
    ("rules", "tokens", "last", "holds"),
    [
        (ANY, [p(), r(10, 12)], None, True),
        (ANY, [p()], None, False),
        (ANY, [p(), r(11, 12)], None, False),
        (ANY, [p(), r(10, 12, 4)], None, False),
        (ANY, [p()], 20, True),  # it may come later
        (TANK, [p(), drain(10, 2.0)], None, True),
        (TANK, [p(), drain(10, 2.0, "Reservoir")], None, True),
        (TANK, [p()], None, False),
        (TANK, [p(), drain(9, 2.0)], None, False),
        (TANK, [p(), drain(10, 3.0)], None, False),
    ],
)
def test_a_plan_without_a_last_tick_is_whole(
    tmp_path: Path, rules: str, tokens: list[Token], last: int | None, holds: bool
) -> None:
    """What `any` asks for was never missed: it might have come after whatever was told."""
    (tmp_path / "m.nddl").write_text(MODEL.format(rules=rules, objects=""))
    plan = tmp_path / "plan.json"
    ends = {} if last is None else {"last_tick": last}
    plan.write_text(json.dumps({"model": "m.nddl", "tokens": tokens, **ends}))
    assert run(["validate", str(plan)]) == (0 if holds else 1)


TWICE = """A::p { contains(B.r first); first.start == start; first.k == n;
contains(B.r second); first before second; second.k == n + 1; second.end == end; }"""


@pytest.mark.parametrize(
    ("tokens", "said"),
    [
        ([p(), r(0, 4), r(6, 10, 2)], []),
        ([p(), r(0, 4), r(6, 10, 7)], ["`second.k == n + 1` does not hold (A.p#0): n = 1, second.k = 7, computed = 2"]),
        ([p(), r(0, 4), r(6, 9, 2)], ["`second.end == end` does not hold (A.p#0): second.end = 9, end = 10"]),
        ([p(), r(0, 4, 3), r(6, 10, 2)], ["`first.k == n` does not hold (A.p#0): first.k = 3, n = 1"]),
    ],
)
def test_of_two_tokens_that_are_alike_the_wrong_place_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], tokens: list[Token], said: list[str]
) -> None:
    (tmp_path / "m.nddl").write_text(MODEL.format(rules=TWICE, objects=""))
    plan = tmp_path / "plan.json"
    plan.write_text(json.dumps({"model": "m.nddl", "last_tick": 20, "tokens": tokens}))
    assert run(["validate", str(plan)]) == (1 if said else 0)
    told = [line for line in capsys.readouterr().out.splitlines() if line.startswith("plan: ")]
    assert [line.split(": ", 2)[2] for line in told] == said
