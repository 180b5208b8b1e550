"""`nddlc lint` from the outside: what is chosen, silenced and mended, how it is printed, and how it ends."""

import json
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

from nddlc.main import run
from tests.sarif import check_sarif

Captured = pytest.CaptureFixture[str]
ODD = "int a; int b; int c;\na < b < c;\n"
UNUSED = "class Lamp extends Timeline { predicate lit { int level; } }\nLamp::lit {\n  int watts;\n  level >= 3;\n}\n"


def file(directory: Path, text: str, name: str = "m.nddl") -> str:
    """A file with a text, by name."""
    path = directory / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return str(path)


def codes(captured: Captured) -> list[str]:
    """The codes that were printed as JSON."""
    return [each["code"] for each in json.loads(captured.readouterr().out)["diagnostics"]]


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ([], ["NDDL554"]),
        (["--select", "NDDL55"], ["NDDL554"]),
        (["--select", "NDDL501,NDDL6"], []),
        (["--ignore", "NDDL554"], []),
        (["--ignore", "NDDL501", "--ignore", "nddl5"], []),
        (["--level", "error"], []),
    ],
)
def test_what_is_asked_for_is_reported(
    options: list[str], expected: list[str], tmp_path: Path, capsys: Captured
) -> None:
    assert run(["lint", file(tmp_path, ODD), "--format", "json", *options]) == int(bool(expected))
    assert codes(capsys) == expected


@pytest.mark.parametrize(("limit", "code"), [("error", 0), ("warning", 1), ("info", 1), ("never", 0)])
def test_the_threshold_decides_how_it_ends(limit: str, code: int, tmp_path: Path, capsys: Captured) -> None:
    assert run(["lint", file(tmp_path, ODD), "--fail-on", limit]) == code
    assert "1 warning in 1 file" in capsys.readouterr().out


def test_errors_cannot_be_deselected(tmp_path: Path, capsys: Captured) -> None:
    path = file(tmp_path, "int a = b; // nddlc: ignore\n")
    assert run(["lint", path, "--ignore", "NDDL", "--format", "json"]) == 1
    assert codes(capsys) == ["NDDL201"]


def test_a_code_that_cannot_be_one_is_refused(tmp_path: Path, capsys: Captured) -> None:
    assert run(["lint", file(tmp_path, ODD), "--select", "E501"]) == 2
    assert "`E501` in --select is no code" in capsys.readouterr().err


def test_statistics_count_codes(tmp_path: Path, capsys: Captured) -> None:
    assert run(["lint", file(tmp_path, ODD + "b < a < c;\n"), "--statistics"]) == 1
    assert "     2  NDDL554" in capsys.readouterr().out


def test_of_a_directory_the_models_are_linted_and_not_their_parts(tmp_path: Path, capsys: Captured) -> None:
    file(tmp_path, '#include "sub/part.nddl"\n' + ODD, "main.nddl")
    file(tmp_path, "a < a < b;\n", "sub/part.nddl")
    file(tmp_path, ODD, ".hidden/other.nddl")
    assert run(["lint", str(tmp_path), "--format", "json"]) == 1
    shown = json.loads(capsys.readouterr().out)
    assert shown["files"] == [str(tmp_path / "main.nddl")]
    assert {each["code"] for each in shown["diagnostics"]} == {"NDDL202"}


PART = """class Lamp extends Timeline { predicate lit { } predicate dark { } }
int SPARE; int USED;
enum Colour { red }
"""
MODEL = """#include "part.nddl"
Lamp lamp = new Lamp();
close();
goal(lamp.lit g);
g.duration == USED;
"""


def codes_in(part: str, output: str) -> list[tuple[str, int]]:
    found = json.loads(output)["diagnostics"]
    return [(each["code"], each["line"]) for each in found if Path(each["file"]).name == part]


def test_of_a_directory_what_no_model_uses_of_a_part_is_told(tmp_path: Path, capsys: Captured) -> None:
    file(tmp_path, PART, "part.nddl")
    one = file(tmp_path, MODEL, "one.nddl")
    assert run(["lint", one, "--format", "json"]) == 1
    assert codes_in("part.nddl", capsys.readouterr().out) == [("NDDL540", 1), ("NDDL504", 2), ("NDDL507", 3)]
    assert run(["lint", str(tmp_path), "--format", "json"]) == 1
    assert codes_in("part.nddl", capsys.readouterr().out) == [("NDDL540", 1), ("NDDL504", 2), ("NDDL507", 3)]
    file(tmp_path, MODEL + "int mine = [0 9];\nmine >= SPARE;\nColour c = red;\ngoal(lamp.dark h);\n", "two.nddl")
    run(["lint", str(tmp_path), "--format", "json"])
    assert codes_in("part.nddl", capsys.readouterr().out) == []
    assert run(["lint", one, "--format", "json"]) == 0  # another model includes the part too
    assert codes_in("part.nddl", capsys.readouterr().out) == []


def test_what_lies_elsewhere_may_be_used_elsewhere(tmp_path: Path, capsys: Captured) -> None:
    (tmp_path / "shared").mkdir()
    (tmp_path / "project").mkdir()
    file(tmp_path / "shared", PART, "part.nddl")
    one = file(tmp_path / "project", MODEL, "one.nddl")
    assert run(["lint", one, "-I", str(tmp_path / "shared"), "--format", "json"]) == 0
    assert codes_in("part.nddl", capsys.readouterr().out) == []


def test_what_a_model_with_errors_may_use_is_not_told(tmp_path: Path, capsys: Captured) -> None:
    file(tmp_path, PART, "part.nddl")
    file(tmp_path, MODEL, "one.nddl")
    file(tmp_path, MODEL + "int x = ;\n", "two.nddl")
    assert run(["lint", str(tmp_path), "--format", "json"]) == 1
    assert codes_in("part.nddl", capsys.readouterr().out) == []


def test_a_directory_without_models_is_refused(tmp_path: Path, capsys: Captured) -> None:
    assert run(["lint", str(tmp_path)]) == 2
    assert "there is no model" in capsys.readouterr().err


def test_sarif_follows_its_schema(tmp_path: Path, capsys: Captured) -> None:
    path = file(tmp_path, UNUSED + "int a; int b;\na < b < a;\nLmap l;\n", "a name, 100 %.nddl")
    assert run(["lint", path, "--format", "sarif"]) == 1
    check_sarif(json.loads(capsys.readouterr().out))
    assert run(["lint", file(tmp_path, UNUSED), "--format", "sarif"]) == 1
    log = json.loads(capsys.readouterr().out)
    check_sarif(log)
    (result,) = log["runs"][0]["results"]
    assert (result["ruleId"], result["level"]) == ("NDDL501", "warning")
    assert result["locations"][0]["physicalLocation"]["region"] == {
        "startLine": 3,
        "startColumn": 7,
        "endLine": 3,
        "endColumn": 12,
    }
    assert result["fixes"][0]["artifactChanges"][0]["replacements"][0]["insertedContent"] == {"text": ""}


def test_junit_has_one_case_per_file(tmp_path: Path, capsys: Captured) -> None:
    names = [file(tmp_path, ODD), file(tmp_path, "int a;\n", "fine.nddl")]
    assert run(["lint", *names, "--format", "junit"]) == 1
    suites = ElementTree.fromstring(capsys.readouterr().out.split("\n", 1)[1])
    assert (suites.get("tests"), suites.get("failures")) == ("2", "1")
    cases = {str(case.get("name")): case.find("failure") for case in suites.iter("testcase")}
    failure = cases[names[0]]
    assert failure is not None and failure.get("type") == "NDDL554" and "a < b < c;" in str(failure.text)
    assert cases[names[1]] is None


def test_github_gets_one_line_per_finding(tmp_path: Path, capsys: Captured) -> None:
    path = file(tmp_path, ODD)
    assert run(["lint", path, "--format", "github"]) == 1
    line = (
        f"::warning file={path},line=2,endLine=2,col=7,endColumn=7,title=NDDL554::`<` compares the truth of `a < b`\n"
    )
    assert capsys.readouterr().out == line


def test_fixes_are_carried_out(tmp_path: Path, capsys: Captured) -> None:
    path = file(tmp_path, UNUSED + "filter int a;\na >= 3; // nddlc: ignore NDDL501\n")
    assert run(["lint", path, "--fix"]) == 0
    expected = UNUSED.replace("  int watts;\n", "") + "int a;\na >= 3; "
    assert Path(path).read_text(encoding="utf-8").rstrip() == expected.rstrip()
    assert "3 fixes carried out\nnothing wrong in 1 file" in capsys.readouterr().out
    assert list(tmp_path.iterdir()) == [Path(path)]


def test_what_is_mended_in_an_included_file_is_not_told_of_the_one_that_includes_it(
    tmp_path: Path, capsys: Captured
) -> None:
    part = file(tmp_path, UNUSED)
    whole = tmp_path / "a.nddl"
    whole.write_text(f'#include "{Path(part).name}"\n', encoding="utf-8")
    assert run(["lint", str(whole), part]) == 1
    capsys.readouterr()
    assert run(["lint", str(whole), part, "--fix"]) == 0
    assert "nothing wrong in 2 files" in capsys.readouterr().out


def test_unsafe_fixes_are_asked_for(tmp_path: Path, capsys: Captured) -> None:
    path = file(tmp_path, ODD)
    assert run(["lint", path, "--fix"]) == 1
    assert Path(path).read_text(encoding="utf-8") == ODD
    assert run(["lint", path, "--unsafe-fixes"]) == 0
    assert Path(path).read_text(encoding="utf-8") == "int a; int b; int c;\na < b && b < c;\n"
    capsys.readouterr()


def test_what_an_included_file_has_is_mended_with_the_model(tmp_path: Path, capsys: Captured) -> None:
    part = file(
        tmp_path, "enum Light { reef, cape }\nclass Boat extends Timeline { predicate Sail { Lihgt to; } }\n", "p.nddl"
    )
    whole = file(tmp_path, '#include "p.nddl"\nBoat boat = new Boat();\nclose();\ngoal(boat.Sail s);\ns.to == reef;\n')
    assert run(["lint", whole, "--fix"]) == 1
    assert "1 fix left, which may change the meaning" in capsys.readouterr().out
    assert run(["lint", whole, "--unsafe-fixes"]) == 0
    assert "1 fix carried out\nnothing wrong" in capsys.readouterr().out
    assert "{ Light to; }" in Path(part).read_text(encoding="utf-8")


def test_of_fixes_that_are_left_it_is_told_why(tmp_path: Path, capsys: Captured) -> None:
    part = file(tmp_path, "int a = 3 4;\nint b; a == b;\n", "p.nddl")
    file(tmp_path, '#include "p.nddl"\na == 3;\n', "other.nddl")
    whole = file(tmp_path, '#include "p.nddl"\na == 4;\n')
    assert run(["lint", whole, "--unsafe-fixes"]) == 1
    assert f"left in `{part}`, which is not one of the files given: `nddlc lint" in capsys.readouterr().out


def test_what_only_a_mission_tells_of_its_model_is_mended_with_it(tmp_path: Path, capsys: Captured) -> None:
    text = (
        '#include "TREX.nddl"\nclass Rock { int far; Rock(int f) { far = f; } }\nclass Boat extends AgentTimeline {\n'
        'predicate Lie { }\npredicate Sail { int miles; }\nBoat(Mode m) { super(m, "Lie"); }\n}\n'
        "Boat::Sail { Rock rock; rock.far == miles; }\nRock a = new Rock(3);\nBoat boat = new Boat(Internal);\n"
    )
    model = file(tmp_path, text)
    reactor = '[[reactor]]\nname = "o"\nmodel = "m.nddl"\nlatency = 1\nlookahead = 50\ninternal = ["boat"]\n'
    goal = '[[goal]]\ntimeline = "boat"\npredicate = "Sail"\n[goal.parameters]\nmiles = 3\n'
    mission = file(tmp_path, f'[mission]\nname = "x"\nfinal_tick = 50\n{reactor}{goal}', "mission.toml")
    assert run(["lint", model, "--unsafe-fixes"]) == 0
    assert run(["lint", mission, "--unsafe-fixes"]) == 0
    assert Path(model).read_text(encoding="utf-8") == f"{text}close();\n"
    assert "1 fix carried out" in capsys.readouterr().out


def test_a_diff_changes_nothing(tmp_path: Path, capsys: Captured) -> None:
    path = file(tmp_path, UNUSED)
    assert run(["lint", path, "--diff"]) == 1
    assert "\n-  int watts;\n" in capsys.readouterr().out
    assert Path(path).read_text(encoding="utf-8") == UNUSED


def test_what_is_no_text_is_not_mended(tmp_path: Path, capsys: Captured) -> None:
    path = tmp_path / "m.nddl"
    path.write_bytes(b"// \xff\n" + UNUSED.encode())
    assert run(["lint", str(path), "--fix"]) == 1
    assert path.read_bytes() == b"// \xff\n" + UNUSED.encode()
    assert "is not UTF-8 text" in capsys.readouterr().err


def test_the_other_dialect_is_named_with_what_to_write_instead(tmp_path: Path, capsys: Captured) -> None:
    text = (
        "class A { int m = 3; }\nint a = 1;\nint b = a + 1;\nfloat f = -(2.0);\nb == a-1;\nb == a / 2;\n"
        "class T extends Timeline { predicate p { float rate; } }\nT::p {\n  before [1 5] (object.p q);\n"
        "  rate == sampledParameter(f);\n}\n"
    )
    path = file(tmp_path, text)
    assert run(["lint", path, "--fail-on", "error"]) == 0
    capsys.readouterr()
    assert run(["lint", path, "--dialect", "nddl3", "--format", "json"]) == 1
    found = json.loads(capsys.readouterr().out)["diagnostics"]
    assert {each["line"] for each in found} >= {1, 3, 4, 5, 6, 9, 10}
    assert [each["code"] for each in found if not each["help"] and not each["fixes"]] == []


def test_a_pipe_may_close(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "nddlc.main", "lint", file(tmp_path, ODD)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (1, "")


@pytest.mark.parametrize(
    "content",
    [
        bytes(range(256)) * 8,
        b"\x7fELF\x02\x01\x01" + b"\0" * 60,
        UNUSED.encode("utf-16"),
        UNUSED.encode("utf-16-be"),
        b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x10\0\0",
    ],
    ids=["bytes", "program", "utf-16", "utf-16-be", "image"],
)
def test_what_is_no_text_costs_one_message(content: bytes, tmp_path: Path, capsys: Captured) -> None:
    path = tmp_path / "model.nddl"
    path.write_bytes(content)
    assert run(["lint", str(path), "--format", "json"]) == 1
    assert codes_in("model.nddl", capsys.readouterr().out) == [("NDDL108", 1)]
    assert run(["lint", str(path)]) == 1
    assert ("save it as UTF-8" in capsys.readouterr().out) == (b"c\0l\0a\0s" in content)


@pytest.mark.parametrize("encoding", ["latin-1", "cp1251", "koi8-r", "shift-jis"])
def test_a_text_in_another_encoding_is_a_text(encoding: str, tmp_path: Path, capsys: Captured) -> None:
    comment = "Größe eines Körpers" if encoding == "latin-1" else "大きさ" if encoding == "shift-jis" else "размер тела"
    path = tmp_path / "model.nddl"
    path.write_bytes(f"// {comment}\n{UNUSED}".encode(encoding))
    run(["lint", str(path), "--format", "json"])
    found = codes_in("model.nddl", capsys.readouterr().out)
    assert ("NDDL107", 1) in found
    assert "NDDL108" not in dict(found)


def test_mission_files_of_a_folder_are_looked_at_with_its_models(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Captured
) -> None:
    for name in ("planner.nddl", "simulator.nddl", "vehicle.nddl", "mission.toml"):
        text = Path("models/templates/survey", name).resolve().read_text()
        (tmp_path / name).write_text(text.replace("lookahead = 900", "lookahed = 900"))
    (tmp_path / "solver.toml").write_text("[[manager]]\ncomponent = 5\n")  # no mission
    (tmp_path / ".hidden").mkdir()
    (tmp_path / ".hidden/mission.toml").write_text("[mission]\nnme = 5\n")
    monkeypatch.chdir(tmp_path)
    for words in ([], ["."], ["mission.toml", "."]):
        assert run(["lint", *words]) == 1
        shown = capsys.readouterr().out
        assert shown.startswith("error[NDDL702]: no key `lookahed` in [[reactor]]\n")
        assert shown.endswith("\n1 error in 3 files\n")
    (tmp_path / "mission.toml").write_text((tmp_path / "mission.toml").read_text().replace("lookahed", "lookahead"))
    assert run(["lint", "mission.toml"]) == 0
    told = "nothing wrong in 1 file (of its models only errors are told; `nddlc lint .` has their warnings)\n"
    assert capsys.readouterr().out == told


def test_mission_files_and_their_solvers_are_mended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Captured
) -> None:
    survey = Path("models/templates/survey").resolve()
    for name in ("planner.nddl", "simulator.nddl", "vehicle.nddl"):
        (tmp_path / name).write_text((survey / name).read_text())
    solver = (
        '[[filter]]\ncomponent = "HorizonFilter"\n[[manager]]\n{component} = "OpenConditionManager"\n'
        '[[manager]]\ncomponent = "ThreatManager"\n[[manager]]\ncomponent = "UnboundVariableManager"\n'
    )
    right = (survey / "mission.toml").read_text().replace("lookahead = 900", 'lookahead = 900\nsolver = "plan.toml"')
    mission, plan = tmp_path / "mission.toml", tmp_path / "plan.toml"
    # Behind the misspelt key a goal is seen that does not fit its model: that is no new error of the fix.
    wrong = right.replace('predicate = "Leg"', 'predicate = "Leeg"')
    assert wrong != right
    mission.write_text(wrong.replace("lookahead = 900", "lookahed = 900"))
    plan.write_text(solver.format(component="componnt"))
    monkeypatch.chdir(tmp_path)
    assert run(["lint", "--diff"]) == 1
    assert [line for line in capsys.readouterr().out.splitlines() if line[:2] in ("-l", "+l", "-c", "+c")] == [
        "-lookahed = 900",
        "+lookahead = 900",
        '-componnt = "OpenConditionManager"',
        '+component = "OpenConditionManager"',
    ]
    assert run(["lint", "--fix"]) == 1
    assert (mission.read_text(), plan.read_text()) == (wrong, solver.format(component="component"))
    mission.write_bytes(b"# \xff\n" + right.encode())
    capsys.readouterr()
    run(["lint", "--fix"])
    assert "`mission.toml` is not UTF-8 text and is left as it is" in capsys.readouterr().err
