"""Pathological inputs: each command ends soon, within its memory, and with an exit code that says what is wrong."""

import os
import shutil
import sqlite3
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.cli.measured import ROOT, Commands

pytestmark = pytest.mark.once

BLANK = ROOT / "models" / "templates" / "blank"
MISSION = (BLANK / "mission.toml").read_text(encoding="utf-8")
SECONDS, MEBIBYTES = 5, 1000
TIMELINE = "class A extends Timeline { predicate p { int n; } }\n"
OBJECT = "A a = new A();\nclose();\n"
BYTES = bytes(range(256)) * 1000


def ancestors(count: int) -> str:
    classes = "".join(f"class C{each + 1} extends C{each} {{ }}\n" for each in range(count))
    return f"class C0 {{ }}\n{classes}C{count} c = new C{count}();\nclose();\n"


# Texts of models.
MODELS: dict[str, str | bytes] = {
    "parentheses": f"int a = {'(' * 20000}1{')' * 20000};\n",
    "open parentheses": "int a = " + "(" * 20000,
    "guards in guards": TIMELINE + "A::p {" + "if (n > 0) {" * 5000 + "}" * 5000 + "}\n",
    "opening braces": "{" * 50000,
    "closing braces": "}" * 50000,
    "arguments parted by semicolons": "f(" + "a;" * 20000 + ");\n",
    "loops": "for (;;) { a; } " * 5000,
    "words of prose": "this is no model but a text of words " * 10000,
    "prefix notation": "(= (+ a b) c) " * 5000,
    "typographic quotes": "“" * 8000,
    "signs": "int a = " + "-" * 20000 + "1;\n",
    "a long sum": "int a = " + "+".join("1" * 10000) + ";\n",
    "a huge line": "int a = 1; " * 5000,
    "a huge name": "int " + "a" * 10**6 + " = 1;\n",
    "a huge string": "string s = '" + "x" * 10**6 + "';\n",
    "an open string": 'string s = "' + "x\n" * 5000,
    "an open comment": "/*" + "* /" * 10**5,
    "members on one line": "class A { " + " ".join(f"int m{i};" for i in range(10**4)) + " }\n",
    "predicates": "class A extends Timeline {\n" + "".join(f"predicate p{i} {{ }}\n" for i in range(10**4)) + "}\n",
    "classes": "".join(f"class C{i} extends Timeline {{ predicate p {{ }} }}\n" for i in range(5000)),
    "rules of a predicate": TIMELINE + "A::p { n > 0; }\n" * 3000,
    "times of a chain": TIMELINE
    + OBJECT
    + "".join(f"goal(a.p g{i});\n" for i in range(1000))
    + "".join(f"g{i + 1}.start < g{i}.start;\n" for i in range(999)),
    "ancestors": ancestors(300),
    "ancestors in a cycle": "class A extends C { }\nclass B extends A { }\nclass C extends B { }\nA a = new A();\n",
    "types in a cycle": "typedef a b;\ntypedef b a;\na x;\n",
    "mistakes on a line": "Foo x; " * 4000,
    "mistakes": "Foo x;\n" * 4000,
    "an endless rule": TIMELINE + "A::p { any(object.p q); q.start > start; }\n" + OBJECT + "goal(a.p g);\n",
    "a rule that doubles": TIMELINE
    + "A::p { any(object.p q); any(object.p r); q.n == n + 1; r.n == n + 1; }\n"
    + OBJECT
    + "goal(a.p g);\ng.n == 0;\n",
    "an endless constructor": "class A { A b; A() { b = new A(); } }\nA a = new A();\nclose();\n",
    "constructors in a cycle": "class A { A() { B b = new B(); } }\nclass B { B() { A a = new A(); } }\n"
    + "A c = new A();\n",
    "nul": b"int a = 1;\n\0\0 int b = \0 2;\n" * 100,
    "a lone surrogate": b"int a = \xed\xa0\x80;\n",
    "byte order marks": b"\xef\xbb\xbfint a = 1;\n\xef\xbb\xbfint b;\n",
    "UTF-16": "int a = 1;\n".encode("utf-16"),
    "Latin-1": "// café\nint a = 1;\n".encode("latin-1"),
    "line ends": b"int a = 1;\r\nint b = 2;\rint c = 3;\n\rint d = x;\x0b\x0cint e;\r",
    "writing from the right": "int a\u202e = 1; /* \u2066 */\nint \u200bb;\u2028int c;\n",
    "no text": BYTES,
    "an enormous integer": "int a = " + "9" * 10**5 + ";\nint b = -" + "9" * 5000 + ";\n",
    "enormous numbers": f"float a = {'9' * 5000}.0;\nfloat b = 1e999999999;\nfloat d = [-1e308 1e308]; d * d == d;\n",
    "enormous domains": "int a = [-9007199254740993 9007199254740993];\nint b = [1 9223372036854775807];\n"
    + "a * b == 17;\n",
    "infinity": "float a = inff; float b = -inff; float c; c == a + b; int i = inf; int j; j == i - i;\n",
    "division by zero": "int a = 5; int b = 0; float c; c == a / b; float d = 1.0 / 0.0; int e = 5 / 0;\n",
    "slow convergence": "int x = [0 1000000000]; int y = [0 1000000000]; x < y; y < x;\n",
    "values of an enum": "enum E { " + ", ".join(f"v{i}" for i in range(10**4)) + " }\nE e; E f; e != f;\n",
    "variables": "".join(f"int a{i} = [0 {i}];\n" for i in range(3000))
    + "".join(f"a{i} <= a{i + 1};\n" for i in range(2999)),
    "goals": TIMELINE + OBJECT + "".join(f"goal(a.p g{i});\n" for i in range(1000)),
    "a file that includes itself": '#include "m.nddl"\nint a;\n',
    "odd includes": '#include ""\n#include "/"\n#include "."\n#include "~"\n#include "'
    + "a" * 5000
    + '"\n#include "a\n',
    "devices": "".join(f'#include "/{each}"\n' for each in ("dev/zero", "dev/urandom", "dev/stdin", "proc/self/mem")),
}


# Larger than a model may be: each is one message that says where.
LARGE: dict[str, str] = {
    "declarations on a line": "".join(f"int x{i} = 0; " for i in range(200_000)),
    "declarations": "".join(f"int x{i} = 0;\n" for i in range(200_000)),
    "one statement": "int " + ", ".join(f"x{i}" for i in range(300_000)) + ";\n",
    "one rule": TIMELINE + "A::p {\n" + "int x; x == n;\n" * 200_000 + "}\n",
    "one class": "class A { " + "int m; " * 100_000 + "}\n",
    "semicolons": ";" * 300_000,
    "signs that mean nothing": "@ " * 300_000,
    "quotes": "'a' " * 300_000,
    "comments": "/* a */ // b\n" * 100_000,
    "doc comments": "/// a\nint b;\n" * 60_000,
    "braces": "{}" * 200_000,
    "words": "word " * 300_000,
    "long words beyond ASCII": "größe " * 300_000,
    "missing includes": "".join(f'#include "f{i}.nddl"\n' for i in range(100_000)),
    "goals": TIMELINE + OBJECT + "goal(a.p); " * 50_000,
}


def in_mission(old: str, new: str) -> str:
    assert old in MISSION
    return MISSION.replace(old, new)


OWN = '\n[constraints]\nmodules = ["own.py"]\n'
# Mission files.
MISSIONS: dict[str, str | bytes] = {
    "empty": "",
    "wrong types": in_mission('name = "blank"', "name = 5").replace('["task"]', "{ a = 1 }"),
    "dates": in_mission("final_tick = 200", "final_tick = 1979-05-27T07:32:00Z").replace("[5, 60]", "[07:32:00, 1]"),
    "a huge integer": in_mission("final_tick = 200", "final_tick = " + "9" * 400),
    "an integer of a page": in_mission("final_tick = 200", "final_tick = " + "9" * 10**5),
    "an endless mission": in_mission("final_tick = 200", "final_tick = 9007199254740992"),
    "no numbers": in_mission("tick = 1.0", "tick = nan").replace("[5.0, 40.0]", "[-inf, nan]"),
    "an infinite range": in_mission("[5.0, 40.0]", "[5.0, inf]"),
    "negative": in_mission("final_tick = 200", "final_tick = -200").replace("latency = 1", "latency = -1"),
    "a tiny tick": in_mission("\ntick = 1.0", "\ntick = 5e-324"),
    "a huge tick": in_mission("\ntick = 1.0", "\ntick = 1e308"),
    "a huge latency": in_mission("latency = 1\n", "latency = 9007199254740992\n"),
    "arrays in arrays": "a = " + "[" * 50000,
    "tables in tables": "a = " + "{a=" * 5000 + "1" + "}" * 5000,
    "a long path": "a" + ".a" * 20000 + " = 1\n",
    "unknown tables": MISSION + "".join(f"[x{i}]\na = 1\n" for i in range(3000)),
    "no text": BYTES,
    "UTF-16": MISSION.encode("utf-16"),
    "nul in a name": in_mission('"planner.nddl"', '"plan\\u0000ner.nddl"').replace('"task"', '"ta\\u0000sk"'),
    "a folder as model": in_mission('"planner.nddl"', '"."'),
    "a device as model": in_mission('"planner.nddl"', '"/dev/zero"'),
    "itself as model": in_mission('"planner.nddl"', '"mission.toml"'),
    "a huge name": in_mission('name = "blank"', 'name = "' + "x" * 10**5 + '"'),
    "a module that is a device": MISSION + OWN.replace("own.py", "/dev/zero"),
    "a module that ends the process": MISSION + OWN,
}
LAUGHS = "".join(f'<!ENTITY l{i + 1} "{f"&l{i};" * 10}">' for i in range(9))
# Batch files of T-REX, and configurations of a solver.
XML: dict[str, str | bytes] = {
    "a billion laughs": f'<!DOCTYPE l [<!ENTITY l0 "lol">{LAUGHS}]><Batch>&l9;</Batch>',
    "a long entity": f'<!DOCTYPE l [<!ENTITY a "{"a" * 10**5}">]><Batch>{"&a;" * 20000}</Batch>',
    "a file as entity": '<!DOCTYPE l [<!ENTITY x SYSTEM "file:///etc/passwd">]><Batch>&x;</Batch>',
    "a type from elsewhere": '<!DOCTYPE l SYSTEM "http://127.0.0.1:9/x.dtd"><Batch/>',
    "elements in elements": "<a>" * 10**5 + "</a>" * 10**5,
    "an open element": "<Batch><a>",
    "an unknown encoding": '<?xml version="1.0" encoding="nonsense"?><Batch/>',
    "no text": BYTES,
}
SETTINGS: dict[str, str | bytes] = {
    "wrong types": "dialect = 5\n[lint]\nselect = 7\nignore = { a = 1 }\n[constraints]\nmodules = 3\n",
    "no tables": 'lint = 1\nconstraints = "x"\ninclude = true\n',
    "arrays in arrays": "a=" + "[" * 50000,
    "no text": BYTES,
    "odd modules": '[constraints]\nmodules = ["/dev/zero", "../..", "\\u0000", ".", "gone.py"]\n',
}
TRACES: dict[str, str | bytes] = {
    "empty": "",
    "no text": BYTES,
    "arrays in arrays": "[" * 200000,
    "wrong types": '{"mission": 5, "seed": "x", "events": 7, "plan": null, "version": 1e400}\n' * 3,
    "no objects": 'null\n5\n"x"\n[]\n',
    "a huge number": '{"seed": ' + "9" * 10**4 + "}\n",
}


def other_base(path: Path) -> None:
    with sqlite3.connect(path) as base:
        base.execute("create table runs(a)")


STORES: dict[str, Callable[[Path], object]] = {
    "an empty file": lambda path: path.touch(),
    "text": lambda path: path.write_text("hello\n" * 1000),
    "no text": lambda path: path.write_bytes(BYTES),
    "a folder": Path.mkdir,
    "a pipe": os.mkfifo,
    "a device": lambda path: path.symlink_to("/dev/zero"),
    "a link to itself": lambda path: path.symlink_to(path.name),
    "another data base": other_base,
    "half a head": lambda path: path.write_bytes(b"SQLite format 3\0" + b"\xff" * 4096),
}


@pytest.fixture(scope="module")
def commands() -> Iterator[Commands]:
    found = Commands()
    yield found
    found.close()


def assert_ends(commands: Commands, folder: Path, *lines: str) -> None:
    """Each command line ends with 0, 1 or 2, in time, within its memory, and blames nobody for a bug."""
    for line in lines:
        ended = commands.run(line.split(), folder)
        assert "bug in nddlc" not in ended.text, (line, ended.text[-2000:])
        assert "Traceback" not in ended.text, (line, ended.text[-2000:])
        assert ended.code in (0, 1, 2), (line, ended)
        assert ended.seconds < SECONDS, line
        assert ended.mebibytes < MEBIBYTES, line


def put(path: Path, content: str | bytes) -> None:
    path.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8"))


def begin(folder: Path) -> None:
    for path in BLANK.iterdir():
        shutil.copy(path, folder)


PLAN = "plan --max-seconds 2 --max-memory 400"
CHECK = "check --missions 2 --workers 1 --flights 0"


@pytest.mark.parametrize("name", MODELS)
def test_a_model(name: str, tmp_path: Path, commands: Commands) -> None:
    put(tmp_path / "m.nddl", MODELS[name])
    assert_ends(commands, tmp_path, "lint m.nddl", "fmt --check m.nddl", f"{PLAN} m.nddl")


@pytest.mark.parametrize("name", LARGE)
def test_a_model_too_large(name: str, tmp_path: Path, commands: Commands) -> None:
    put(tmp_path / "m.nddl", LARGE[name])
    others = ("load m.nddl", f"{PLAN} m.nddl", "check m.nddl") if name == "one statement" else ()
    for line in ("lint m.nddl", "fmt --check m.nddl", *others):
        assert_ends(commands, tmp_path, line)
        told = (tmp_path / "said.txt").read_text(encoding="utf-8")
        assert told.count("[NDDL") == 1 and "[NDDL109]" in told and "m.nddl:" in told


@pytest.mark.parametrize("part", [2, 300])
def test_a_model_too_large_by_its_includes(part: int, tmp_path: Path, commands: Commands) -> None:
    for number in range(part):
        put(tmp_path / f"p{number}.nddl", "int a;\n" * (10**5 // part + 1))
    put(tmp_path / "m.nddl", "".join(f'#include "p{number}.nddl"\n' for number in range(part)))
    assert_ends(commands, tmp_path, "lint m.nddl", "load m.nddl")
    assert "[NDDL109]" in (tmp_path / "said.txt").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", MISSIONS)
def test_a_mission_file(name: str, tmp_path: Path, commands: Commands) -> None:
    begin(tmp_path)
    put(tmp_path / "mission.toml", MISSIONS[name])
    put(tmp_path / "own.py", "import os\nos._exit(0)\n")
    assert_ends(commands, tmp_path, "lint mission.toml", CHECK, f"{PLAN} mission.toml")


@pytest.mark.parametrize("name", XML)
def test_an_xml_file(name: str, tmp_path: Path, commands: Commands) -> None:
    put(tmp_path / "b.xml", XML[name])
    put(tmp_path / "m.nddl", "int a;\n")
    assert_ends(commands, tmp_path, "convert b.xml", "run b.xml", f"{PLAN} --config b.xml m.nddl")


@pytest.mark.parametrize("name", SETTINGS)
def test_settings(name: str, tmp_path: Path, commands: Commands) -> None:
    put(tmp_path / "nddlc.toml", SETTINGS[name])
    put(tmp_path / "m.nddl", "int a = b;\n")
    assert_ends(commands, tmp_path, "lint m.nddl nddlc.toml", "load m.nddl", "fmt --check .")


@pytest.mark.parametrize("name", TRACES)
def test_a_trace(name: str, tmp_path: Path, commands: Commands) -> None:
    begin(tmp_path)
    for file in ("t.jsonl", "p.json"):
        put(tmp_path / file, TRACES[name])
    explain = "explain t.jsonl --mission mission.toml"
    assert_ends(commands, tmp_path, "replay t.jsonl", "validate p.json", explain, "compare p.json p.json")


@pytest.mark.parametrize("name", STORES)
def test_a_store(name: str, tmp_path: Path, commands: Commands) -> None:
    begin(tmp_path)
    STORES[name](tmp_path / "s")
    lines = ("store check s", "explain --store s latest", f"{CHECK} --store s", "store salvage s")
    assert_ends(commands, tmp_path, *lines)


def test_a_class_with_thousands_of_ancestors(tmp_path: Path, commands: Commands) -> None:
    put(tmp_path / "m.nddl", ancestors(3000))
    assert_ends(commands, tmp_path, "lint m.nddl", "fmt --check m.nddl")


def test_many_files_that_include_each_other(tmp_path: Path, commands: Commands) -> None:
    for number in range(30):
        put(tmp_path / f"c{number}.nddl", f'#include "c{number + 1}.nddl"\n#include "./c{number + 1}.nddl"\n')
    put(tmp_path / "m.nddl", '#include "c0.nddl"\n')
    assert_ends(commands, tmp_path, "lint m.nddl", "lint .", f"{PLAN} m.nddl")


def test_folders_full_of_traps(tmp_path: Path, commands: Commands) -> None:
    os.mkfifo(tmp_path / "pipe.nddl")
    (tmp_path / "a.nddl").symlink_to("b.nddl")
    (tmp_path / "b.nddl").symlink_to("a.nddl")
    (tmp_path / "again").symlink_to(".")
    with (tmp_path / "large.nddl").open("wb") as file:
        file.truncate(10**11)
    put(tmp_path / "m.nddl", "".join(f'#include "{each}.nddl"\n' for each in ("pipe", "a", "large")))
    assert_ends(commands, tmp_path, "lint .", "fmt --check .", f"{PLAN} m.nddl", "fmt large.nddl")
