"""The pages of all codes of the language in, Markdown out: `python -m nddl_lang.rulebook docs/rules` writes them."""

import re
import sys
from collections.abc import Iterator
from pathlib import Path

from nddl_lang.lint import pages as lint_pages
from nddl_lang.semantics import pages as semantic_pages
from nddl_lang.syntax import pages as syntax_pages
from nddl_lang.text.diagnostic import Code, Severity
from nddl_lang.text.page import RulePage

_FOUND = {**syntax_pages.PAGES, **semantic_pages.PAGES, **lint_pages.PAGES}
PAGES: dict[str, RulePage] = {name: _FOUND[name] for name in sorted(_FOUND)}

GROUPS = {
    "1": "Syntax and includes",
    "2": "Names",
    "3": "Types",
    "4": "Rules and the state of the script",
    "5": "Findings",
}
MARK = "<!-- Made by `make rules`; edit the page beside the pass instead. -->"


def readable(code: Code) -> str:
    """The message with dots where a text's own words come."""
    return re.sub(r"\{\w+\}", "...", code.template)


def configuration(code: Code) -> list[str]:
    """How a project changes what becomes of a code, in paragraphs."""
    if code.severity is Severity.ERROR:
        return ["An error: the model means nothing as it stands, so it cannot be ignored or made lighter."]
    return [
        f'In `nddlc.toml`: `severity.{code.id} = "off"`, or `"hint"`, `"info"`, `"warning"`, `"error"`; in '
        f"`pyproject.toml` the same below `[tool.nddlc]`.",
        f"In a text: `// nddlc: ignore {code.id}` at the end of the line or alone above it, "
        f"`// nddlc: ignore-file {code.id}` for the whole file.",
    ]


def markdown(page: RulePage) -> str:
    """The page of one code."""
    code = page.code
    parts = [
        MARK,
        f"# {code.id}: {readable(code)}",
        f"*{code.severity.value} · {code.kind}*",
        page.what,
        page.why,
        "## Instead of",
        f"```nddl\n{page.bad.rstrip()}\n```",
        "## Write",
        f"```nddl\n{page.good.rstrip()}\n```",
        "## Configuration",
        *configuration(code),
    ]
    return "\n\n".join(parts) + "\n"


def index() -> str:
    """The list of all pages."""
    lines = [MARK, "", "# Codes", "", "What each code means; `nddlc rule CODE` shows the same."]
    lines += ["", "How the catalogue of known traps maps to codes stands in [catalogue.md](catalogue.md)."]
    for digit, caption in GROUPS.items():
        lines += ["", f"## {caption}", "", "| code | weight | message |", "| --- | --- | --- |"]
        for name, page in PAGES.items():
            if name[4] == digit:
                message = readable(page.code).replace("|", "\\|")
                lines.append(f"| [{name}]({name}.md) | {page.code.severity.value} | {message} |")
    return "\n".join(lines) + "\n"


def files() -> Iterator[tuple[str, str]]:
    """The names and texts of all files."""
    yield "README.md", index()
    for name, page in PAGES.items():
        yield f"{name}.md", markdown(page)


def main(directory: Path) -> None:
    """Write the files, and remove pages of codes that are gone."""
    directory.mkdir(parents=True, exist_ok=True)
    for path in directory.glob("NDDL*.md"):
        if path.stem not in PAGES:
            path.unlink()
    for name, text in files():
        (directory / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
