"""What z3 proves of rules: no false alarm on the conformance suite, minimal notes, witnesses, and the command."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from checker.proofs.codes import IMPOSSIBLE_RULE
from checker.proofs.pages import PROOF_PAGES
from checker.proofs.rules import Witness, prove_rules
from compiler.lower import compile_model
from nddl_lang.analysis import analyse_file
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.page import RulePage
from nddlc.lint import command

ROOT = Path(__file__).parents[2]
MODELS = [*(ROOT / "models").rglob("*.nddl")]
CASES = [*(ROOT / "tests" / "conformance").rglob("*.nddl")]


def proved(path: Path) -> tuple[list[Diagnostic], list[Witness]]:
    analysis = analyse_file(path)
    return ([], []) if analysis.has_errors else prove_rules(compile_model(analysis))


def of_text(text: str, folder: Path) -> tuple[list[Diagnostic], list[Witness]]:
    path = folder / "model.nddl"
    path.write_text(text)
    return proved(path)


@pytest.mark.once
def test_nothing_that_has_a_plan_is_called_impossible() -> None:
    checked = 0
    for path in (*MODELS, *CASES):
        found, witnesses = proved(path)
        assert [str(each) for each in found] == [], path
        checked += bool(witnesses)
    assert checked > 150


@pytest.mark.parametrize("page", PROOF_PAGES, ids=lambda page: page.code.id)
def test_the_examples_of_a_page_are_bad_and_good(page: RulePage, tmp_path: Path) -> None:
    assert [each.code for each in of_text(page.bad, tmp_path)[0]] == [page.code]
    assert of_text(page.good, tmp_path)[0] == []


def test_the_notes_are_the_lines_that_contradict_each_other(tmp_path: Path) -> None:
    text = PROOF_PAGES[0].bad.replace("{ way <= 3;", "{ way > 0; way <= 3;")
    (found,), _ = of_text(text, tmp_path)
    assert found.code is IMPOSSIBLE_RULE
    assert found.span.text == "duration >= 200"
    assert [note.span.text for note in found.notes if note.span] == [
        "LEG = 60",
        "way <= 3",
        "duration <= way * LEG",
        "way * LEG",
    ]


def test_a_witness_satisfies_the_rule(tmp_path: Path) -> None:
    _, (witness,) = of_text(PROOF_PAGES[0].good, tmp_path)
    values = dict(witness.values)
    assert 200 <= int(values["this.end"]) - int(values["this.start"]) <= 280


def test_two_tokens_of_one_name_are_two(tmp_path: Path) -> None:
    text = "class T extends Timeline { predicate a {} predicate b {} }\nT t = new T();\nclose();\n"
    assert of_text(text + "T::a { meets(object.b q); met_by(object.b q); }\n", tmp_path)[0] == []


def test_the_command_tells_what_is_proved_and_not_what_is_known(tmp_path: Path) -> None:
    path = tmp_path / "model.nddl"
    path.write_text(PROOF_PAGES[0].bad)
    silent = CliRunner().invoke(command, ["--format", "json", str(path)], standalone_mode=False)
    told = CliRunner().invoke(command, ["--prove", "--format", "json", str(path)], standalone_mode=False)
    codes = [each["code"] for each in json.loads(told.output)["diagnostics"]]
    assert [each for each in codes if each.startswith("NDDL73")] == ["NDDL730"]
    assert "NDDL730" not in silent.output
    path.write_text(PROOF_PAGES[0].bad.replace("way * LEG;", "3 * LEG;"))
    known = CliRunner().invoke(command, ["--prove", "--format", "json", str(path)], standalone_mode=False)
    codes = [each["code"] for each in json.loads(known.output)["diagnostics"]]
    assert "NDDL530" in codes
    assert "NDDL730" not in codes
