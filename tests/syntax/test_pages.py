"""Every code has a page, whose bad example draws it and whose good one draws nothing."""

import tomllib
from pathlib import Path

import pytest

from nddl_lang.syntax import codes
from nddl_lang.syntax.includes import load_module_graph
from nddl_lang.syntax.pages import PAGES
from nddl_lang.text.diagnostic import Code
from nddl_lang.text.page import RulePage


def test_every_code_has_a_page() -> None:
    assert list(PAGES) == sorted(value.id for value in vars(codes).values() if isinstance(value, Code))


@pytest.mark.parametrize("page", PAGES.values(), ids=PAGES.keys())
def test_the_examples_of_a_page_are_bad_and_good(page: RulePage, tmp_path: Path) -> None:
    bad, good = tmp_path / "bad.nddl", tmp_path / "good.nddl"
    if page.language == "toml":  # of a setting that a large model needs
        bad.write_text("int a;\n" * 1000, encoding="utf-8")
        most = [int(tomllib.loads(text)["max-lexemes"]) for text in (page.bad, page.good)]
        (complaint,) = load_module_graph(bad, most=most[0]).diagnostics
        assert complaint.code == page.code
        assert load_module_graph(bad, most=most[1]).diagnostics == ()
        return
    bad.write_text(page.bad, encoding="utf-8")
    good.write_text(page.good, encoding="utf-8")
    assert {complaint.code for complaint in load_module_graph(bad).diagnostics} == {page.code}
    assert load_module_graph(good).diagnostics == ()
