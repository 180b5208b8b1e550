"""Every code that anything of nddlc can give has one page, and the examples of the pages are bad and good."""

import ast
import re
from pathlib import Path

import pytest

import runtime.build_form
from checker.mission import parse_mission
from checker.mission_pages import MISSION_PAGES
from checker.rulebook import PAGES
from nddl_lang.lint.configuration import read_configuration
from nddl_lang.lint.pages_settings import SETTINGS_PAGES
from nddl_lang.text.page import RulePage
from nddl_lang.text.source import Source
from runtime.loading import load
from runtime.plan.script.pages import SCRIPT_PAGES
from runtime.solver.configuration.pages import SOLVER_PAGES
from runtime.solver.configuration.read import read_configuration as read_solver

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("nddl_lang", "compiler", "runtime", "checker", "lsp", "nddlc")
# What only a script could do that was never checked: checked ones are refused before they run, by these codes.
CHECKED_BEFORE = {"NDDL654": "NDDL409", "NDDL655": "NDDL410"}


def by_id(page: RulePage) -> str:
    return page.code.id


def declared_codes() -> list[tuple[str, str]]:
    """The id of each code and the name of its file, once for each time that it is declared."""
    found = []
    for path in (path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.py"))):
        for node in ast.walk(ast.parse(path.read_bytes())):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "Code":
                match node.args:
                    case [ast.Constant(value=str(name)), *_]:
                        found.append((name, path.name))
    return found


def test_every_code_is_declared_once_and_has_a_page() -> None:
    assert sorted(name for name, _ in declared_codes()) == list(PAGES)


def test_every_code_stands_in_the_codes_of_its_room() -> None:
    assert [(name, file) for name, file in declared_codes() if file != "codes.py"] == []


@pytest.mark.parametrize("page", SETTINGS_PAGES, ids=by_id)
def test_the_settings_of_a_page_are_bad_and_good(page: RulePage, tmp_path: Path) -> None:
    path = tmp_path / "nddlc.toml"
    path.write_text(page.bad, encoding="utf-8")
    assert [each.code for each in read_configuration(path)[1]] == [page.code]
    path.write_text(page.good, encoding="utf-8")
    assert read_configuration(path)[1] == []


@pytest.mark.parametrize("page", SCRIPT_PAGES, ids=by_id)
def test_the_scripts_of_a_page_are_bad_and_good(page: RulePage, tmp_path: Path) -> None:
    path = tmp_path / "model.nddl"
    path.write_text(page.bad, encoding="utf-8")
    code = CHECKED_BEFORE.get(page.code.id, page.code.id)
    assert [each.code.id for each in load(path, (), None).diagnostics] == [code]
    path.write_text(page.good, encoding="utf-8")
    assert load(path, (), None).diagnostics == ()


@pytest.mark.parametrize("page", SOLVER_PAGES, ids=by_id)
def test_the_configurations_of_a_page_are_bad_and_good(page: RulePage) -> None:
    assert [each.code for each in read_solver(Source("solver.xml", page.bad))[1]] == [page.code]
    assert not read_solver(Source("solver.xml", page.good))[1]


@pytest.mark.parametrize("page", MISSION_PAGES, ids=by_id)
def test_the_examples_of_mission_files_differ_in_what_the_code_is_about(page: RulePage) -> None:
    assert page.bad != page.good
    if page.language == "xml":
        codes = [{one.code for one in parse_mission(Source("agent.xml", t), Path())[1]} for t in (page.bad, page.good)]
        assert page.code in codes[0] - codes[1]
    else:
        assert re.match(r"[\[a-z]", page.bad) and page.language == "toml"
