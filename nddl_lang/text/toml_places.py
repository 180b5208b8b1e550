"""Say where in a TOML text each key and each value stands, which `tomllib` does not."""

import re
import tomllib
from dataclasses import dataclass

# A table's header, in a text that need not be well-formed: whether it is one of several, and its name.
HEADER = re.compile(r"^[ \t]*\[(\[)?[ \t]*([^\]\n]*?)[ \t]*\]", re.MULTILINE)
Path = tuple[str | int, ...]


@dataclass(frozen=True, slots=True)
class Stretch:
    """Offsets of a key and of its value; for a table's header both are the header's name."""

    key: tuple[int, int]
    value: tuple[int, int]


def toml_of(text: str) -> str:
    """A text as readers of TOML want it: with a blank for the byte order mark that some editors write."""
    return " " + text[1:] if text.startswith("\ufeff") else text


def find_places(text: str) -> dict[Path, Stretch]:
    """Every key of `text` by its path; items of an array of tables are numbered. `text` must be well-formed TOML."""
    scan = _Scan(toml_of(text))
    scan.document()
    return scan.places


def _unquoted(key: str) -> str:
    """The name that a quoted key stands for."""
    if key[0] == "'" or "\\" not in key:
        return key[1:-1]
    (name,) = tomllib.loads(f"{key} = 0")
    return name


class _Scan:
    """A reader that knows just enough of TOML's grammar to skip what it does not look for."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.at = 0
        self.places: dict[Path, Stretch] = {}
        self.counts: dict[Path, int] = {}

    def document(self) -> None:
        table: Path = ()
        while True:
            self._skip_blank(lines=True)
            if self.at >= len(self.text):
                return
            table = self._header() if self.text[self.at] == "[" else self.pair(table)

    def _header(self) -> Path:
        is_array = self.text.startswith("[[", self.at)
        self.at += 2 if is_array else 1
        names, stretch = self.key()
        self.at = self.text.index("]", self.at) + (2 if is_array else 1)
        path: Path = ()
        for position, name in enumerate(names):
            path = (*path, name)
            if is_array and position == len(names) - 1:
                self.counts[path] = self.counts.get(path, 0) + 1
                self.places.setdefault(path, Stretch(stretch, stretch))
            if path in self.counts:
                path = (*path, self.counts[path] - 1)
            self.places.setdefault(path, Stretch(stretch, stretch))
        return path

    def pair(self, table: Path) -> Path:
        names, stretch = self.key()
        self.at = self.text.index("=", self.at) + 1
        self._skip_blank()
        begin = self.at
        path = (*table, *names)
        self.value(path)
        for length in range(len(table) + 1, len(path) + 1):
            self.places.setdefault(path[:length], Stretch(stretch, (begin, self.at)))
        return table

    def key(self) -> tuple[tuple[str, ...], tuple[int, int]]:
        """A possibly dotted key; the offsets span all of it."""
        names: list[str] = []
        self._skip_blank()
        begin = finish = self.at
        while True:
            self._skip_blank()
            if self.text[self.at] in "\"'":
                start = self.at
                self._skip_string()
                names.append(_unquoted(self.text[start : self.at]))
            else:
                start = self.at
                while self.at < len(self.text) and (self.text[self.at].isalnum() or self.text[self.at] in "_-"):
                    self.at += 1
                names.append(self.text[start : self.at])
            finish = self.at
            self._skip_blank()
            if self.at >= len(self.text) or self.text[self.at] != ".":
                return tuple(names), (begin, finish)
            self.at += 1

    def value(self, path: Path) -> None:
        match self.text[self.at]:
            case '"' | "'":
                self._skip_string()
            case "[":
                self._array(path)
            case "{":
                self._inline_table(path)
            case _:
                while self.at < len(self.text) and self.text[self.at] not in ",]}#\r\n":
                    self.at += 1
                while self.text[self.at - 1] in " \t":
                    self.at -= 1

    def _array(self, path: Path) -> None:
        self.at += 1
        index = 0
        while True:
            self._skip_blank(lines=True)
            if self.text[self.at] == "]":
                self.at += 1
                return
            begin = self.at
            self.value((*path, index))
            self.places.setdefault((*path, index), Stretch((begin, self.at), (begin, self.at)))
            index += 1
            self._skip_blank(lines=True)
            if self.text[self.at] == ",":
                self.at += 1

    def _inline_table(self, path: Path) -> None:
        self.at += 1
        while True:
            self._skip_blank(lines=True)
            if self.text[self.at] == "}":
                self.at += 1
                return
            if self.text[self.at] == ",":
                self.at += 1
                continue
            self.pair(path)

    def _skip_string(self) -> None:
        quote = self.text[self.at]
        mark = quote * 3 if self.text.startswith(quote * 3, self.at) else quote
        self.at += len(mark)
        while not self.text.startswith(mark, self.at):
            self.at += 2 if quote == '"' and self.text[self.at] == "\\" else 1
        self.at += len(mark)
        while len(mark) == 3 and self.text.startswith(quote, self.at):  # """a"""" ends with a quote of its own
            self.at += 1

    def _skip_blank(self, *, lines: bool = False) -> None:
        blank = " \t\r\n" if lines else " \t"
        while self.at < len(self.text):
            if self.text[self.at] in blank:
                self.at += 1
            elif self.text[self.at] == "#" and lines:
                end = self.text.find("\n", self.at)
                self.at = len(self.text) if end < 0 else end
            else:
                return
