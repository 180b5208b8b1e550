"""The site of docs/ shows what the pages say, and loads nothing from elsewhere."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGES = sorted((ROOT / "docs").rglob("*.md"))
_FENCE = re.compile(r"^ *```+(.*)$", re.MULTILINE)
_CODE_IN_TABLE = re.compile(r"`[^`\n]*\\\|[^`\n]*`")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_a_page_is_read_alike_by_the_site_and_by_code_hosts(page: Path) -> None:
    """Two words behind a fence make it text on the site; a bar in code is shown with its backslash there."""
    text = page.read_text(encoding="utf-8")
    assert [each for each in _FENCE.findall(text) if " " in each.strip()] == []
    assert _CODE_IN_TABLE.findall(text) == []


def test_the_site_brings_the_script_by_which_a_page_from_a_file_is_searched() -> None:
    """The theme's plugin for sites without a server loads one from elsewhere, unless the configuration names one."""
    named = re.findall(r"^  polyfills: \[(.*)\]", (ROOT / "mkdocs.yml").read_text(encoding="utf-8"), re.MULTILINE)
    assert named == ["javascripts/iframe-worker.js"]
    assert "http" not in (ROOT / "docs" / named[0]).read_text(encoding="utf-8")
