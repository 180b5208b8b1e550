"""Pathological inputs of a second kind: known words, but far too many of them, or in places nobody thought of."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.cli.measured import Commands
from tests.cli.test_pathological import BLANK, CHECK, OBJECT, PLAN, TIMELINE, assert_ends, begin, put

pytestmark = pytest.mark.once
MISSION = (BLANK / "mission.toml").read_text(encoding="utf-8")

MODELS: dict[str, str | bytes] = {
    "paths": "int a = " + ".".join("a" * 5000) + ";\n",
    "two dots": TIMELINE + "A::p { n == " + "..".join(["object"] * 3000) + "; }\n",
    "a text beside a text": 'string s = "' + "x" * 10**5 + '" "y";\n',
    "calls in calls": "float a = " + "abs(" * 5000 + "1.0" + ")" * 5000 + ";\n",
    "powers": "float a = pow(10.0, pow(10.0, pow(10.0, 10.0)));\n",
    "roots of nothing": "float a = sqrt(-1.0); float b = log(0.0); float c = asin(7.0); float d = tan(1e300);\n",
    "comparisons in a chain": "bool a = " + " < ".join("12345" * 400) + ";\n",
    "conditions": "int x; bool b = " + " && ".join(["x > 1"] * 5000) + ";\n",
    "quotes in quotes": 'string s = "' + "'\\\"" * 20000 + '";\n',
    "comments in comments": "/*" * 50000 + "*/" * 50000,
    "doc comments and nothing": "/// a\n" * 20000,
    "suppressions": "// nddlc: ignore NDDL999\n" * 20000 + "int a;\n",
    "a first line": "// nddlc: dialect " + "x" * 10**5 + "\nint a;\n",
    "both dialects": "// dialect: nddl3\n// dialect: nddlc\nint a = 1 / 2;\n",
    "one name for all": "class a extends Timeline { predicate a { int a; } a() { } }\na a = new a();\n"
    "enum a { a }\na::a { a(a.a a); }\n",
    "reserved words": " ".join(
        ["class", "predicate", "if", "else", "foreach", "enum", "typedef", "new", "extends"] * 3000
    ),
    "super to the end": "class A { A() { " + "super(" * 4000 + " } }\n",
    "elses": TIMELINE + "A::p { if (n > 0) { } " + "else if (n > 1) { } " * 2000 + "}\n",
    "loops in loops": TIMELINE
    + OBJECT
    + "A::p { "
    + "".join(f"foreach (x{i} in a) {{ " for i in range(500))
    + "}" * 501,
    "relations without tokens": TIMELINE + "A::p { " + "meets(); before(); contains(object); " * 1500 + "}\n",
    "bounds of a relation": TIMELINE
    + "A::p { before ["
    + "9" * 3000
    + " -inf] (object.p q); before [5 1] (object.p r); }\n",
    "a token of everything": TIMELINE
    + OBJECT
    + "A::p { "
    + "".join(f"any(object.p q{i}); " for i in range(400))
    + "}\n",
    "goals that meet in a ring": TIMELINE
    + OBJECT
    + "".join(f"goal(a.p g{i});\n" for i in range(60))
    + "".join(f"g{i} meets g{(i + 1) % 60};\n" for i in range(60)),
    "goals in one place": TIMELINE + OBJECT + "".join(f"goal(a.p g{i}); g{i}.start == 5;\n" for i in range(150)),
    "a horizon of nothing": "PlannerConfig c = new PlannerConfig(0, 0, 0);\n" + TIMELINE + OBJECT + "goal(a.p g);\n",
    "objects": "class A { int i; A(int n) { i = n; } }\n"
    + "".join(f"A a{i} = new A({i});\n" for i in range(3000))
    + "close();\nA x;\n",
    "a choice of objects": "class A { int i; A(int n) { i = n; } }\n"
    + "".join(f"A a{i} = new A({i});\n" for i in range(200))
    + "close();\nA x; A y; A z; x.i + y.i + z.i == 597; x != y; y != z;\n",
    "pigeons": "".join(f"int p{i} = [1 9];\n" for i in range(10))
    + f"allDiff({', '.join(f'p{i}' for i in range(10))});\n",
    "a sum of bools": "".join(f"bool b{i};\n" for i in range(300))
    + f"condAllSame({', '.join(f'b{i}' for i in range(300))});\n",
    "a product in a ring": "float a = [1.0 2.0]; float b; float c; a * b == c; b * c == a; c * a == b; a == 1.5;\n",
    "a reservoir of too much": "Reservoir r = new Reservoir(1e300, -1e300, 1e308);\nclose();\n"
    "goal(r.consume c);\nc.quantity == 1e308;\n",
    "a resource without an end": "class T extends Timeline { predicate p { } }\nT t = new T();\n"
    "Reservoir r = new Reservoir(1.0, 0.0, 1.0);\n"
    "T::p { any(r.consume c); c.quantity == 0.5; c.time == end; meets(object.p q); }\nclose();\ngoal(t.p g);\n",
    "events": "Reservoir r = new Reservoir(5.0, 0.0, 10.0);\nclose();\n"
    + "".join(f"goal(r.consume c{i}); c{i}.quantity == 0.01; c{i}.time == {i};\n" for i in range(300)),
    "a type of a type": "".join(f"typedef T{i} T{i + 1};\n" for i in range(2000)),
    "members of members": "".join(f"class C{i} {{ C{i + 1} m; }}\n" for i in range(1500)) + "class C1500 { }\n",
    "an interval the wrong way": "int a = [5 1]; float b = [inff -inff]; int c = [1 1 1]; int d = []; int e = {};\n"
    * 300,
    "a set of everything": "int a = {" + ", ".join(map(str, range(20000))) + "};\na != 5;\n",
    "strings": "string s = {" + ", ".join(f'"{i}"' for i in range(5000)) + "};\nstring t = s;\n",
    "tabs": "\t" * 10**5 + "int a;\n" + "\tx" * 5000,
    "letters of all alphabets": "".join(chr(i) + " " for i in range(0xA0, 0x3000)) + "\n",
    "combining signs": "int a" + "\u0301" * 50000 + ";\n",
    "emoji": "int 🛰 = 1; // " + "👩‍🚀" * 20000 + "\n",
    "the library again": '#include "TREX.nddl"\n' * 2000 + '#include "Resources.nddl"\n' * 2000,
    "a part of the library": "class Timeline { }\nclass Object extends Timeline { }\n"
    "enum bool { true, false }\nint int = 3;\n",
}


def edited(old: str, new: str) -> str:
    assert old in MISSION
    return MISSION.replace(old, new)


MISSIONS: dict[str, str] = {
    "goals": MISSION + '[[goal]]\ntimeline = "task"\npredicate = "Wait"\n' * 3000,
    "reactors": MISSION + '[[reactor]]\nname = "r"\nmodel = "planner.nddl"\n' * 1000,
    "properties": MISSION + '[[property]]\nname = "x"\nkind = "never"\ntimeline = "task"\npredicate = "Idle"\n' * 2000,
    "one property": MISSION
    + '[[property]]\nname = "x"\nkind = "never"\ntimeline = "task"\npredicate = "Idle"\nwhere = "'
    + " and ".join(["start > 1"] * 3000)
    + '"\n',
    "parentheses in a property": MISSION
    + '[[property]]\nname = "x"\nkind = "never"\ntimeline = "task"\npredicate = "Idle"\nwhere = "'
    + "(" * 20000
    + '"\n',
    "parameters": MISSION + "".join(f"[parameters.P{i}]\nrange = [0.0, 1.0]\n" for i in range(3000)),
    "values": MISSION + "[parameters.P]\nvalues = [" + ", ".join(map(str, range(50000))) + "]\n",
    "strings of lines": edited('name = "blank"', 'name = """' + "\n" * 50000 + '"""'),
    "no missions": MISSION + "\n[x]\n" + "#" * 10**5,
    "a parent far away": edited('"planner.nddl"', '"' + "../" * 3000 + 'planner.nddl"'),
}
MODULES: dict[str, str] = {
    "brackets": "(" * 50000,
    "a decorator of itself": "def constraint(f):\n    return constraint(f)\n\n"
    "@constraint\ndef c(a: float) -> None: ...\n",
    "names": "".join(f"def f{i}(a: float) -> float:\n    return a\n" for i in range(3000)),
    "no text": "\0" * 1000,
    "an annotation": "def f(a: " + "list[" * 3000 + "int" + "]" * 3000 + ") -> float:\n    return a\n",
}


@pytest.fixture(scope="module")
def commands() -> Iterator[Commands]:
    found = Commands()
    yield found
    found.close()


@pytest.mark.parametrize("name", MODELS)
def test_a_model(name: str, tmp_path: Path, commands: Commands) -> None:
    put(tmp_path / "m.nddl", MODELS[name])
    assert_ends(commands, tmp_path, "lint m.nddl", "fmt --check m.nddl", f"{PLAN} m.nddl")


@pytest.mark.parametrize("name", MISSIONS)
def test_a_mission_file(name: str, tmp_path: Path, commands: Commands) -> None:
    begin(tmp_path)
    put(tmp_path / "mission.toml", MISSIONS[name])
    assert_ends(commands, tmp_path, "lint mission.toml", CHECK)


@pytest.mark.parametrize("name", MODULES)
def test_a_module_of_constraints(name: str, tmp_path: Path, commands: Commands) -> None:
    begin(tmp_path)
    put(tmp_path / "own.py", MODULES[name])
    put(tmp_path / "nddlc.toml", '[constraints]\nmodules = ["own.py"]\n')
    assert_ends(commands, tmp_path, "lint mission.toml .", CHECK)


def test_there_are_as_many_as_were_promised() -> None:
    assert len(MODELS) + len(MISSIONS) + len(MODULES) >= 57
