"""The pages of the codes of the language; pages in, Markdown out."""

import re
from collections.abc import Iterable

from nddl_lang.lint import pages as lint_pages
from nddl_lang.lint.pages_settings import SETTINGS_PAGES, TRUST_PAGES
from nddl_lang.semantics import pages as semantic_pages
from nddl_lang.syntax import pages as syntax_pages
from nddl_lang.text.diagnostic import Code, Severity
from nddl_lang.text.page import RulePage

_FOUND = {**syntax_pages.PAGES, **semantic_pages.PAGES, **lint_pages.PAGES}
_FOUND |= {page.code.id: page for page in (*SETTINGS_PAGES, *TRUST_PAGES)}
PAGES: dict[str, RulePage] = {name: _FOUND[name] for name in sorted(_FOUND)}

_GROUPS = {
    "1": "Syntax and includes",
    "2": "Names",
    "3": "Types",
    "4": "Rules and the state of the script",
    "5": "Findings and settings",
    "6": "Running the script",
    "7": "Missions and solvers",
}
_MARK = "<!-- Made by `make rules`; edit the page beside the pass instead. -->"


def readable(code: Code) -> str:
    """The message with dots where a text's own words come."""
    return re.sub(r"\{\w+\}", "...", code.template)


def configuration(code: Code) -> list[str]:
    """How a project changes what becomes of a code, in paragraphs."""
    if code.severity is Severity.ERROR:
        return ["An error: nothing can be done with what was written as it stands, so it cannot be ignored."]
    if code.id >= "NDDL6":
        return ["It cannot be changed."]
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
        _MARK,
        f"# {code.id}: {readable(code)}",
        f"*{code.severity.value} · {code.kind}*",
        page.what,
        page.why,
        "## Instead of",
        f"```{page.language}\n{page.bad.rstrip()}\n```",
        "## Write",
        f"```{page.language}\n{page.good.rstrip()}\n```",
        "## Configuration",
        *configuration(code),
    ]
    return "\n\n".join(parts) + "\n"


def index(pages: Iterable[RulePage]) -> str:
    """The list of `pages`, which come in the order of their codes."""
    known = list(pages)
    lines = [_MARK, "", "# Codes", "", "What each code means; `nddlc rule CODE` shows the same."]
    lines += ["", "How the catalogue of known traps maps to codes stands in [catalogue.md](catalogue.md)."]
    for digit, caption in _GROUPS.items():
        lines += ["", f"## {caption}", "", "| code | weight | message |", "| --- | --- | --- |"]
        for page in known:
            name = page.code.id
            if name[4] == digit:
                message = readable(page.code).replace("|", "\\|")
                lines.append(f"| [{name}]({name}.md) | {page.code.severity.value} | {message} |")
    return "\n".join(lines) + "\n"
