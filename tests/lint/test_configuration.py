"""What a project writes into its configuration: what it changes, and what is wrong with it."""

from pathlib import Path

import pytest

from nddl_lang.lint.configuration import find_configuration, read_configuration
from nddl_lang.text.diagnostic import Severity
from nddlc.main import run

Captured = pytest.CaptureFixture[str]
ODD = "int a; int b; int c;\na < b < c;\n"


def project(directory: Path, settings: str, name: str = "nddlc.toml", text: str = ODD) -> str:
    """A project with a model below its configuration; the name of the model."""
    (directory / name).write_text(settings, encoding="utf-8")
    (directory / "models").mkdir(exist_ok=True)
    path = directory / "models" / "m.nddl"
    path.write_text(text, encoding="utf-8")
    return str(path)


@pytest.mark.parametrize(
    ("settings", "ends", "shown"),
    [
        ("", 1, "1 warning"),
        ('ignore = ["NDDL55"]', 0, "nothing wrong"),
        ('select = ["NDDL501"]', 0, "nothing wrong"),
        ('severity.NDDL554 = "off"', 0, "nothing wrong"),
        ('severity.NDDL554 = "info"', 0, "1 remark"),
        ('severity.NDDL554 = "error"', 1, "1 error"),
        ('severity.NDDL5 = "off"\nseverity.NDDL554 = "info"', 0, "1 remark"),
        ('fail-on = "error"', 0, "1 warning"),
        ('fail-on = "never"', 0, "1 warning"),
    ],
)
def test_settings_count(settings: str, ends: int, shown: str, tmp_path: Path, capsys: Captured) -> None:
    assert run(["lint", project(tmp_path, settings)]) == ends
    assert shown in capsys.readouterr().out


def test_settings_may_stand_in_pyproject(tmp_path: Path, capsys: Captured) -> None:
    path = project(tmp_path, '[tool.other]\nx = 1\n[tool.nddlc]\nignore = ["NDDL554"]\n', "pyproject.toml")
    assert run(["lint", path]) == 0
    assert "nothing wrong" in capsys.readouterr().out


def test_the_dialect_and_the_directories_of_includes_are_settings(tmp_path: Path, capsys: Captured) -> None:
    (tmp_path / "shared").mkdir()
    (tmp_path / "shared" / "limits.nddl").write_text("int LIMIT = 3;\n", encoding="utf-8")
    text = '#include "limits.nddl"\nint a = LIMIT + 1;\n'
    assert run(["lint", project(tmp_path, 'include = ["shared"]', text=text)]) == 0
    capsys.readouterr()
    (tmp_path / "two").mkdir()
    assert run(["lint", project(tmp_path / "two", 'dialect = "nddl3"', text="int a = 1 + 2;\n")]) == 1
    assert "NDDL150" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("settings", "code", "text", "message"),
    [
        ('ignroe = ["NDDL501"]', "NDDL596", "ignroe", "there is no setting `ignroe`"),
        ('severity.E501 = "off"', "NDDL596", "severity.E501", "there is no setting `E501`"),
        ('severity.NDDL501 = "loud"', "NDDL597", '"loud"', "`NDDL501` must be"),
        ("severity = 3", "NDDL597", "3", "`severity` must be a table of codes"),
        ('select = ["501"]', "NDDL597", '"501"', "`501` must be a code such as"),
        ('ignore = "NDDL501"', "NDDL597", '"NDDL501"', "`ignore` must be a list of texts"),
        ('include = ["nowhere"]', "NDDL597", '"nowhere"', "`nowhere` must be a directory"),
        ('dialect = "nddl2"', "NDDL597", '"nddl2"', "`dialect` must be `nddl3` or `nddlc`"),
        ('fail-on = "often"', "NDDL597", '"often"', "`fail-on` must be"),
        ("ignore = [", "NDDL595", "", "this is not TOML"),
    ],
)
def test_a_mistake_is_shown_at_its_place(
    settings: str, code: str, text: str, message: str, tmp_path: Path, capsys: Captured
) -> None:
    path = project(tmp_path, settings + "\n")
    _, (complaint,) = read_configuration(tmp_path / "nddlc.toml")
    assert (complaint.code.id, complaint.span.text) == (code, text)
    assert run(["lint", path]) == 2
    assert message in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "codes"),
    [
        ("[project]\nname = 'x'\n", []),
        ("tool = 3\n", []),
        ("[tool]\nnddlc = 3\n", ["NDDL597"]),
        ("[tool.nddlc]\nignroe = []\n", ["NDDL596"]),
    ],
)
def test_a_project_of_python_may_say_nothing_of_nddlc(text: str, codes: list[str], tmp_path: Path) -> None:
    path = tmp_path / "pyproject.toml"
    path.write_text(text, encoding="utf-8")
    assert (find_configuration(tmp_path) == path.resolve()) is bool(codes)
    assert [each.code.id for each in read_configuration(path)[1]] == codes
    path.unlink()
    assert [each.code.id for each in read_configuration(path, text)[1]] == codes


def test_the_nearest_configuration_counts(tmp_path: Path) -> None:
    project(tmp_path, 'severity.NDDL501 = "off"')
    (tmp_path / "models" / "pyproject.toml").write_text("[project]\nname = 'x'\n", encoding="utf-8")
    found = find_configuration(tmp_path / "models")
    assert found == tmp_path.resolve() / "nddlc.toml"
    settings, complaints = read_configuration(found)
    assert (settings.severities, settings.fail_on, complaints) == ((("NDDL501", None),), Severity.WARNING, [])
