"""The files for editors agree with the language and with the server."""

import json
import re
import subprocess
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from nddl_lang.syntax.words import RESERVED

VSCODE = Path(__file__).resolve().parents[2] / "editors" / "vscode"
FILES = ["package.json", "language-configuration.json", "syntaxes/nddl.tmLanguage.json"]


def read(name: str) -> Any:
    return json.loads((VSCODE / name).read_text(encoding="utf-8"))


def patterns(node: Any) -> Iterator[tuple[str, str]]:
    """All regular expressions of a grammar with the kind of text that they find."""
    if isinstance(node, dict):
        for key in ("match", "begin", "end"):
            if isinstance(node.get(key), str):
                yield str(node.get("name", "")), node[key]
        for value in node.values():
            yield from patterns(value)
    elif isinstance(node, list):
        for value in node:
            yield from patterns(value)


def test_every_reserved_word_is_coloured() -> None:
    grammar = read("syntaxes/nddl.tmLanguage.json")
    words = [re.compile(pattern) for name, pattern in patterns(grammar["repository"]["words"])]
    assert [word for word in sorted(RESERVED) if not any(each.fullmatch(word) for each in words)] == []


def test_every_include_of_the_grammar_leads_somewhere() -> None:
    grammar = read("syntaxes/nddl.tmLanguage.json")
    names = {each["include"].removeprefix("#") for each in grammar["patterns"]}
    assert names == set(grammar["repository"])


@pytest.mark.parametrize("name", FILES)
def test_the_regular_expressions_can_be_read(name: str) -> None:
    for _, pattern in patterns(read(name)):
        re.compile(pattern)


def test_the_extension_names_files_that_are_there() -> None:
    package = read("package.json")
    contributed = package["contributes"]
    names = [package["icon"], *(each["configuration"] for each in contributed["languages"])]
    names += [each["path"] for each in (*contributed["grammars"], *contributed["snippets"])]
    names += ["LICENSE", "README.md"]
    assert all((VSCODE / name).is_file() for name in names)
    texts = "".join(path.read_text(encoding="utf-8") for path in sorted((VSCODE / "src").glob("*.ts")))
    for setting in contributed["configuration"]["properties"]:
        name = setting.removeprefix("nddlc.")
        assert name == "trace.server" or f'"{name}"' in texts
    assert all(f'"{each["command"]}"' in texts for each in contributed["commands"])


def test_the_licence_of_the_extension_is_that_of_the_project() -> None:
    assert (VSCODE / "LICENSE").read_bytes() == (VSCODE.parents[1] / "LICENSE").read_bytes()


@pytest.mark.parametrize("name", ["neovim/syntax/nddl.vim", "emacs/nddl-mode.el"])
def test_other_editors_know_the_same_words(name: str) -> None:
    text = (VSCODE.parent / name).read_text(encoding="utf-8")
    found = set(re.findall(r"\w+", text))
    assert [word for word in sorted(RESERVED) if word not in found] == []


def test_helix_and_zed_start_the_server_and_find_the_grammar() -> None:
    editors = VSCODE.parent
    helix = tomllib.loads((editors / "helix/languages.toml").read_text(encoding="utf-8"))
    assert helix["language-server"]["nddlc"]["args"] == ["lsp"]
    extension = tomllib.loads((editors / "zed/extension.toml").read_text(encoding="utf-8"))
    language = tomllib.loads((editors / "zed/languages/nddl/config.toml").read_text(encoding="utf-8"))
    assert language["name"] in extension["language_servers"]["nddlc"]["languages"]
    assert language["grammar"] in extension["grammars"] and language["grammar"] == helix["grammar"][0]["name"]
    folder = extension["grammars"]["nddl"]["path"]
    assert helix["grammar"][0]["source"]["path"].endswith(folder)
    assert (editors.parent / folder / "src" / "parser.c").is_file()


@pytest.mark.skipif(not (VSCODE / "node_modules").is_dir(), reason="`make vsix` fetches the tools")
def test_the_extension_is_sound_typescript_and_its_grammar_colours(tmp_path: Path) -> None:
    for command in (["npx", "tsc", "--noEmit"], ["npm", "test"]):
        subprocess.run(command, cwd=VSCODE, check=True, capture_output=True, timeout=300)
