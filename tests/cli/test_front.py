"""What a first user meets: models of odd sizes, and files that are no models."""

from pathlib import Path

import pytest

from nddlc.main import run

Captured = pytest.CaptureFixture[str]


@pytest.mark.parametrize("count", [10, 242, 300, 1500])
@pytest.mark.parametrize("options", [[], ["--explain"], ["--strategy", "europa"]])
def test_many_classes_without_an_object_have_a_plan(count: int, options: list[str], tmp_path: Path) -> None:
    path = tmp_path / "m.nddl"
    path.write_text("".join(f"class C{number} {{ }}\n" for number in range(count)), encoding="utf-8")
    assert run(["plan", str(path), *options]) == 0


def test_lint_reads_a_mission_file_as_one(tmp_path: Path, capsys: Captured) -> None:
    (tmp_path / "m.nddl").write_text("int x;\n", encoding="utf-8")
    mission = tmp_path / "mission.toml"
    text = '# a mission\n[mission]\nname = "m"\nfinal_tick = 5\n[[reactor]]\nname = "r"\nmodel = "m.nddl"\n'
    mission.write_text(text, encoding="utf-8")
    assert run(["lint", str(mission)]) == 0
    mission.write_text(text.replace("final_tick", "final_tock"), encoding="utf-8")
    assert run(["lint", str(mission)]) == 1
    told = capsys.readouterr().out
    assert "NDDL702" in told and "NDDL1" not in told
    assert run(["lint", "--fix", str(mission)]) == 0
    assert mission.read_text(encoding="utf-8") == text


def test_lint_reads_a_configuration_as_one(tmp_path: Path, capsys: Captured) -> None:
    path = tmp_path / "nddlc.toml"
    path.write_text('ignore = ["NDDL501"]\n', encoding="utf-8")
    assert run(["lint", str(path)]) == 0
    assert "nothing wrong" in capsys.readouterr().out


ENDLESS = """class A extends Timeline { predicate P { } }
A::P { meets(P q); }
A a = new A();
close();
goal(a.P g);
g.start = [0 10];
g.end = [1 20];
"""


@pytest.mark.parametrize("options", [[], ["--json"], ["--explain"], ["--strategy", "europa"]])
def test_an_endless_rule_ends_at_the_memory_budget(options: list[str], tmp_path: Path, capsys: Captured) -> None:
    path = tmp_path / "m.nddl"
    path.write_text(ENDLESS, encoding="utf-8")
    assert run(["plan", str(path), "--horizon", "0", "inf", "--max-memory", "20", "--max-seconds", "50", *options]) == 1
    told = capsys.readouterr()
    assert "memory" in told.out and "bug" not in told.err


def test_a_zero_is_printed_as_one(tmp_path: Path, capsys: Captured) -> None:
    path = tmp_path / "m.nddl"
    text = "float x = [0.0 5.0];\nfloat y = [-3.0 0.0];\nfloat z;\nz == x * y;\nz >= 0.0;\nx > 1.0;\n"
    path.write_text(text, encoding="utf-8")
    for options in (["load"], ["load", "--json"], ["plan"]):
        run([*options, str(path)])
        assert "e-3" not in capsys.readouterr().out
