"""Mission files that are open in the editor: their texts, what is wrong with each, and where in one a cursor stands."""

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from lsprotocol.types import Diagnostic as Shown
from lsprotocol.types import Range

from lsp.diagnostics import Conversion
from lsp.positions import Encoding, Lines, replaced
from lsp.uris import path_of
from nddl_lang.lint.configuration import NAME, PROJECT
from nddl_lang.mission_suffixes import AGENT_SUFFIXES
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Source
from nddl_lang.text.toml_places import HEADER
from runtime.solver.configuration.read_toml import is_solver_toml

# All that is wrong with a text of that name in that folder; whether the workspace is trusted.
Examine = Callable[[Source, Path, bool], Iterable[Diagnostic]]
_SUFFIX = ".toml"
_ROOT = re.compile(r"<(?:Agent|Solver)\b")
_BEGUN = re.compile(r"[ \t]*\[\[?(?=[^\]\n]*\Z)")  # a header that is not closed yet
KEY = re.compile(r"""^[ \t]*([A-Za-z0-9_-]+|"[^"\n]*"|'[^'\n]*')[ \t]*=""", re.MULTILINE)
_MODEL = re.compile(r"""^[ \t]*model[ \t]*=[ \t]*["']([^"'\n]+)["']""", re.MULTILINE)
_MISSION = re.compile(r"^[ \t]*\[(?:mission|\[reactor\])\]", re.MULTILINE)
_FIGURES = ("figures",)  # there `samples = "gulper.Firing"` names two things
_WORDS = ("mission", "solver")
_CONFIGURATIONS = (NAME, PROJECT)
FILE_KEYS = ("model", "solver", "batch", "modules", "code")  # whose values name files
STRING = re.compile(r"""(["'])((?:(?!\1)[^\n\\]|\\.)*)\1?""")


@dataclass(slots=True)
class OpenMission:
    """An open mission file."""

    uri: str
    path: Path
    version: int
    lines: Lines

    @property
    def text(self) -> str:
        """Its characters."""
        return self.lines.text

    @property
    def is_agent_file(self) -> bool:
        """Whether it is an agent file of T-REX, or a solver's in XML: of these only what is wrong is told."""
        return self.path.suffix in AGENT_SUFFIXES

    @property
    def models(self) -> list[Path]:
        """The models that its reactors run, in the order of the text, each once."""
        return [self.path.parent / name for name in models_in(self.text)]

    def file_named(self, value: str) -> Path | None:
        """The file that a value names, which may be `file.py:Class`; None where there is none."""
        path = self.path.parent / value.partition(":")[0]
        try:
            return path if path.is_file() else None
        except (OSError, ValueError):  # a name that no file can have
            return None


@dataclass(frozen=True, slots=True)
class MissionPlace:
    """Where a cursor stands: in which table, at which key, and in which string or word, which begins at `begin`.

    `is_value` where that is behind the key's `=`; `table` are the names of its header.
    """

    table: tuple[str, ...]
    key: str | None
    is_value: bool
    word: str
    begin: int
    finish: int


def models_in(text: str) -> list[str]:
    """The models that a mission file names, each once."""
    return list(dict.fromkeys(_MODEL.findall(text)))


def place_at(text: str, offset: int) -> MissionPlace:
    """The place of a cursor; also in text that is no well-formed TOML, as long as it is typed."""
    line = text.rfind("\n", 0, offset) + 1
    if (begun := _BEGUN.match(text, line, _line_end(text, offset))) is not None and begun.end() <= offset:
        names = text[begun.end() : offset].split(".")
        word, start, end = _word(text, offset)
        return MissionPlace(tuple(name.strip(" \t\"'") for name in names[:-1]), None, False, word, start, end)
    header = None
    for header in HEADER.finditer(text, 0, _line_end(text, offset)):
        if header.start() > offset:
            break
    table: tuple[str, ...] = ()
    begin = 0
    if header is not None:
        table = tuple(part.strip(" \t\"'") for part in header[2].split("."))
        begin = header.start()
    if header is not None and header.start(2) <= offset <= header.end(2):
        start = text.rfind(".", header.start(2), offset) + 1 or header.start(2)
        end = text.find(".", offset, header.end(2))
        end = end if end >= 0 else header.end(2)
        depth = text.count(".", header.start(2), start)
        return MissionPlace(table[:depth], None, False, text[start:end].strip(" \"'"), start, end)
    key = None
    for found in KEY.finditer(text, begin, _line_end(text, offset)):
        if found.start(1) > offset:
            break
        key = found
    if key is None or (offset > key.end() and "\n" in text[key.end() : offset] and not _is_open(text, key, offset)):
        return MissionPlace(table, None, False, *_word(text, offset))
    if offset <= key.end(1):
        return MissionPlace(table, None, False, key[1].strip("\"'"), key.start(1), key.end(1))
    for string in STRING.finditer(text, key.end(), _line_end(text, offset)):
        if string.start() < offset <= string.end() - (string[0][-1:] == string[1] and len(string[0]) > 1):
            if key[1] == "where":
                return MissionPlace(table, key[1], True, *_word(text, offset))
            begin, end = _part(text, string, offset) if table == _FIGURES else string.span(2)
            return MissionPlace(table, key[1].strip("\"'"), True, text[begin:end], begin, end)
    return MissionPlace(table, key[1].strip("\"'"), True, *_word(text, offset))


def _part(text: str, string: re.Match[str], offset: int) -> tuple[int, int]:
    """The half of `timeline.predicate` that a cursor stands in."""
    dot = text.find(".", *string.span(2))
    if dot < 0:
        return string.span(2)
    return (dot + 1, string.end(2)) if offset > dot else (string.start(2), dot)


def _is_open(text: str, key: re.Match[str], offset: int) -> bool:
    """Whether an array that begins at a key is still open."""
    value = STRING.sub("", text[key.end() : offset])
    return value.count("[") > value.count("]")


def _line_end(text: str, offset: int) -> int:
    end = text.find("\n", offset)
    return end if end >= 0 else len(text)


def _word(text: str, offset: int) -> tuple[str, int, int]:
    begin = finish = offset
    while begin > 0 and (text[begin - 1].isalnum() or text[begin - 1] in "_-"):
        begin -= 1
    while finish < len(text) and (text[finish].isalnum() or text[finish] in "_-"):
        finish += 1
    return text[begin:finish], begin, finish


class MissionTexts:
    """The open mission files."""

    def __init__(self, examine: Examine, encoding: Encoding = Encoding.UTF16, *, is_trusted: bool = False) -> None:
        self._examine = examine
        self._encoding = encoding
        self._is_trusted = is_trusted
        self._open: dict[str, OpenMission] = {}
        self._found: dict[str, tuple[Diagnostic, ...]] = {}  # by URI, what was told last

    @staticmethod
    def is_mission(uri: str) -> bool:
        """Whether a file may be a mission file, by its name."""
        return uri.endswith((_SUFFIX, *AGENT_SUFFIXES)) and path_of(uri) is not None

    def find(self, uri: str) -> OpenMission | None:
        """The open mission file that the editor calls `uri`."""
        return self._open.get(uri)

    def all(self) -> list[OpenMission]:
        """The open mission files, in order of opening."""
        return list(self._open.values())

    def open(self, uri: str, version: int, text: str) -> OpenMission | None:
        """A text is open now; None where it is a TOML or XML that is none of nddlc's, as far as name and head tell."""
        path = path_of(uri)
        if path is None:
            return None
        has_name = path.name in _CONFIGURATIONS or any(word in path.name.lower() for word in _WORDS)
        if path.suffix in AGENT_SUFFIXES:
            if _ROOT.search(text) is None:
                return None
        elif not has_name and _MISSION.search(text) is None and not is_solver_toml(text):
            return None
        found = self._open[uri] = OpenMission(uri, path, version, Lines(text, self._encoding))
        return found

    def change(self, uri: str, version: int, edits: list[tuple[Range | None, str]]) -> OpenMission | None:
        """A text was edited."""
        mission = self._open.get(uri)
        if mission is None:
            return None
        for place, text in edits:
            whole = text if place is None else replaced(mission.lines, place, text)
            mission.lines = Lines(whole, self._encoding)
        mission.version = version
        return mission

    def close(self, uri: str) -> bool:
        """A text is no longer open; whether it was."""
        self._found.pop(uri, None)
        return self._open.pop(uri, None) is not None

    def complaints(self, mission: OpenMission, conversion: Conversion) -> tuple[Shown, ...]:
        """What is wrong with a mission file and with what it asks of its models."""
        self._found[mission.uri] = told = self.probe(mission, mission.text)
        return tuple(map(conversion.shown, told))

    def probe(self, mission: OpenMission, text: str) -> tuple[Diagnostic, ...]:
        """What would be wrong with a mission file if `text` stood there."""
        source = Source(str(mission.path), text)
        found = self._examine(source, mission.path.parent, self._is_trusted)
        return tuple(each for each in found if each.span.source.name == source.name)

    def told(self, mission: OpenMission) -> tuple[Diagnostic, ...]:
        """What `complaints` found last."""
        return self._found.get(mission.uri, ())
