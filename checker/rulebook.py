"""The pages of all codes, as files: `python -m checker.rulebook docs/rules` writes them."""

import sys
from collections.abc import Iterator
from pathlib import Path

import runtime.build_form
from checker.mission_pages import MISSION_PAGES
from checker.proofs.pages import PROOF_PAGES
from compiler.determined.pages import DETERMINED_PAGES
from nddl_lang.rulebook import PAGES as LANGUAGE_PAGES
from nddl_lang.rulebook import index, markdown
from nddl_lang.text.page import RulePage
from runtime.plan.script.pages import SCRIPT_PAGES
from runtime.solver.configuration.pages import SOLVER_PAGES

_OTHERS = sorted(
    (*DETERMINED_PAGES, *SCRIPT_PAGES, *MISSION_PAGES, *SOLVER_PAGES, *PROOF_PAGES), key=lambda page: page.code.id
)
PAGES: dict[str, RulePage] = LANGUAGE_PAGES | {page.code.id: page for page in _OTHERS}


def files() -> Iterator[tuple[str, str]]:
    """The names and texts of all files."""
    yield "README.md", index(PAGES.values())
    for name, page in PAGES.items():
        yield f"{name}.md", markdown(page)


def _main(directory: Path) -> None:
    """Write the files, and remove pages of codes that are gone."""
    directory.mkdir(parents=True, exist_ok=True)
    for path in directory.glob("NDDL*.md"):
        if path.stem not in PAGES:
            path.unlink()
    for name, text in files():
        (directory / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    _main(Path(sys.argv[1]))
