"""What the pages tell the reader to type exists: commands with their options, targets of make, files, and links."""

import re
from pathlib import Path

import click
import pytest

from nddlc.main import COMMANDS, named, nddlc, run

ROOT = Path(__file__).parents[2]
PAGES = [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").glob("*.md"))]
TEXTS = {page.relative_to(ROOT).as_posix(): page.read_text(encoding="utf-8") for page in PAGES}
FENCES = re.compile(r"^\s*```[^\n]*\n(.*?)^\s*```$", re.M | re.S)
INLINE = re.compile(r"`([^`\n]+)`")
LINK = re.compile(r"\]\(([^)#\s]+)(#[^)\s]*)?\)")


def typed(text: str) -> list[str]:
    """All that stands in code: the lines of blocks, and what is marked inside of lines."""
    code = "\n".join(FENCES.findall(text)).splitlines()
    blocks = [line.split("#", 1)[0].strip().removeprefix("$ ") for line in code]
    return [*blocks, *INLINE.findall(FENCES.sub("", text))]


def lines(first: str) -> list[tuple[str, str]]:
    """The lines that begin with a word, and their pages."""
    return [(page, line) for page, text in TEXTS.items() for line in typed(text) if line.startswith(f"{first} ")]


def options(command: click.Command) -> set[str]:
    return {name for each in command.params for name in (*each.opts, *each.secondary_opts)} | {"-h", "--help"}


@pytest.mark.parametrize(("page", "line"), lines("nddlc"))
def test_commands_have_the_options_that_are_told(page: str, line: str) -> None:
    words = re.sub(r"[\[\]|]|\.\.\.", " ", re.split(r" && | \| ", line)[0]).split()[1:]
    known = options(nddlc)
    while words and words[0] not in COMMANDS:
        word = words.pop(0)
        assert word in known or not word.startswith("-"), f"{page}: {line}"
    if words and words[0] in COMMANDS:
        known |= options(named(f"{COMMANDS[words[0]][0]}:command"))
    assert [word for word in words if word.startswith("-") and word.split("=")[0] not in known] == [], f"{page}: {line}"


def test_options_that_a_page_names_alone_belong_to_some_command() -> None:
    known = set().union(*(options(named(f"{place}:command")) for place, _ in COMMANDS.values()), options(nddlc))
    for page in ("compatibility", "formatting", "lint", "mission", "plan"):
        words = [each for each in INLINE.findall(FENCES.sub("", TEXTS[f"docs/{page}.md"])) if each.startswith("--")]
        assert [each for each in words if re.split(r"[ =|]", each)[0] not in known] == [], page


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_is_told_of(command: str) -> None:
    assert [page for page, line in lines("nddlc") if line.split()[1] == command or f" {command} " in f"{line} "]


@pytest.mark.parametrize(("page", "line"), lines("make"))
def test_make_has_the_targets_that_are_told(page: str, line: str) -> None:
    targets = set(re.findall(r"^([\w.-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.M))
    asked = [word for word in line.split()[1:] if re.fullmatch(r"[a-z-]+", word)]
    assert set(asked) <= targets, f"{page}: {line}"


@pytest.mark.parametrize(("page", "line"), [*lines("python bench/"), *lines("python")])
def test_programs_that_are_told_exist(page: str, line: str) -> None:
    for word in line.split():
        if word.endswith(".py") and "/" in word:
            assert (ROOT / word).is_file(), f"{page}: {line}"


@pytest.mark.parametrize("page", TEXTS)
def test_links_lead_somewhere(page: str) -> None:
    for target, anchor in LINK.findall(TEXTS[page]):
        if not target.startswith("http"):
            path = (ROOT / page).parent / target
            assert path.exists(), f"{page}: {target}"
            if anchor and path.suffix == ".md":
                heads = re.findall(r"^#+ (.*)$", path.read_text(encoding="utf-8"), re.M)
                slugs = {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}
                assert anchor[1:] in slugs, f"{page}: {target}{anchor}"


@pytest.mark.parametrize(
    "line", sorted({line for _, line in lines("nddlc") if re.match(r"nddlc (rule NDDL\d+|check \S+\.nddl)$", line)})
)
def test_commands_that_read_only_run(line: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    assert run(line.split()[1:]) == 0
