"""Scripts of typing, pasting, joining and moving in a model of two open files, beside a server that then opens them.

    python -m tests.lsp.keystroke_proof [COUNT [FIRST]]    COUNT scripts (100,000) from seed FIRST on (0)

After the last step of a script and one before it, complaints of both files and colours of all names must be those of a
cold start. Exits with 1 if anything differs.
"""

import random
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

from lsp.documents import Documents
from lsp.open_text import Publication
from lsp.semantic_tokens import tokens_between
from tests.constraints.proof import judged
from tests.lint.test_incremental import MODEL as LINTED
from tests.semantics.test_incremental import MODEL as ANALYSED
from tests.syntax.corpus import texts
from tests.syntax.test_keystrokes import joined, moved, pasted, typed

_LIFE = 25  # scripts of one session
_LENGTHS = (100, 200, 200, 300, 900)  # of pieces of texts, in characters
_REPAIRED = 20  # of so many scripts one is looked at with its repairs, which take most time
_BLOCK = 1000  # scripts between two lines that tell how far it is
_INCLUDE = '#include "part.nddl"\n'
_WORDS = [
    "int ",
    "red",
    "Lamp",
    "lit",
    " = 3",
    "g.",
    "Lamp.dark",
    "object.",
    "close();",
    "new ",
    "level <= ",
    "duration",
    "\n)\n",
    ":\n",
]


class Editor:
    """What an editor shows of two files that are open, and has been told."""

    def __init__(self, folder: Path, models: tuple[str, str]) -> None:
        self.uris = (folder / "main.nddl").as_uri(), (folder / "part.nddl").as_uri()
        self.documents = Documents()
        self.shown: dict[str, str] = {}
        self.has_rested = False
        for uri, text in zip(self.uris, models, strict=True):
            self._tell(self.documents.open(uri, 1, text))

    def edit(self, file: int, text: str) -> None:
        """The text of a file is another one now."""
        self._tell(self.documents.change(self.uris[file], 1, [(None, text)]))

    def rest(self) -> None:
        """Nothing is edited until all repairs are looked for; of a model that is not edited then they stay."""
        self._tell(self.documents.repair())
        self.has_rested = True

    def picture(self) -> list[object]:
        """All that is seen."""
        colours = []
        for uri in self.uris:
            view = self.documents.view(uri)
            assert view is not None
            colours.append(tokens_between(view, 0, len(view.document.lines.text)))
        return [{uri: told for uri, told in self.shown.items() if told != "()"}, colours]

    def _tell(self, news: list[Publication]) -> None:
        for each in news:
            self.shown[each.uri] = repr(each.diagnostics)


def worded(chance: random.Random, text: str) -> Iterator[str]:
    """Words of the model typed letter by letter in place of others."""
    for _ in range(chance.randrange(1, 4)):
        at = chance.randrange(len(text) + 1)
        end = at + chance.choice((0, 0, 1, 4))
        word = chance.choice(_WORDS)
        for length in range(1, len(word) + 1):
            yield text[:at] + word[:length] + text[end:]
        text = text[:at] + word + text[end:]


def appended(chance: random.Random, text: str) -> Iterator[str]:
    """A stretch of the text typed once more at its end, letter by letter."""
    at = chance.randrange(len(text) + 1)
    stretch = text[at : at + chance.randrange(1, 60)] or "int a;"
    for length in range(1, len(stretch) + 1):
        yield text + stretch[:length]


_SCRIPTS: list[Callable[[random.Random, str], Iterator[str]]] = [typed, pasted, joined, moved, worded, appended]


class Scripts:
    """Scripts one after the other: some 25 of them in one session."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._editor: Editor | None = None
        self._begun: tuple[str, str] = ("", "")
        for name in ("main.nddl", "part.nddl"):
            (folder / name).write_text("", encoding="ascii")

    def judging(self, first: int) -> Callable[[int], None]:
        """Carries out one after the other from a seed on."""
        return lambda number: self.judge(first + number)

    def judge(self, seed: int) -> None:
        """Carry out one."""
        chance = random.Random(seed)
        if self._editor is None or chance.random() < 1 / _LIFE:
            self._begun = _model(chance)
            self._editor = Editor(self._folder, self._begun)
        editor, self._editor = self._editor, None  # what went wrong once is not used again
        file = chance.randrange(2)
        now = list(self._begun)
        steps = list(chance.choice(_SCRIPTS)(chance, now[file]))
        looks = {chance.randrange(len(steps)), len(steps) - 1}
        for number, step in enumerate(steps):
            editor.edit(file, step)
            if number in looks:
                now[file] = step
                fresh = Editor(self._folder, (now[0], now[1]))
                for each in (editor, fresh) if seed % _REPAIRED == 0 or editor.has_rested else ():
                    each.rest()
                assert editor.picture() == fresh.picture(), (seed, number, file, now)
        if chance.random() < 0.7 or len(now[file]) > 3 * max(_LENGTHS):
            now[file] = self._begun[file]
        editor.edit(file, now[file])
        self._begun = now[0], now[1]
        self._editor = editor


def _model(chance: random.Random) -> tuple[str, str]:
    if chance.random() < 0.2:
        text = chance.choice((ANALYSED, LINTED))
    else:
        text = chance.choice(texts())
        length = chance.choice(_LENGTHS)
        begin = chance.randrange(max(1, len(text) - length // 2))
        text = text[begin : begin + length]
    cut = text.find("\n", chance.randrange(len(text) + 1)) + 1
    return _INCLUDE * (chance.random() < 0.9) + text[cut:], text[:cut]


def main() -> None:
    """Judge all and exit with 1 if anything differs."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    with tempfile.TemporaryDirectory() as folder:
        scripts = Scripts(Path(folder))
        wrong = 0
        for begin in range(first, first + count, _BLOCK):
            seeds = range(begin, min(begin + _BLOCK, first + count))
            wrong += judged(f"scripts from seed {begin} on", len(seeds), scripts.judging(begin))
    print(f"{wrong} differences of {count}", flush=True)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
