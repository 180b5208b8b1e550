"""Mission files: outline, folding ranges and document links; a text in, its tables and the files that it names out."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

from lsprotocol.types import DocumentLink, DocumentSymbol, FoldingRange, FoldingRangeKind, SymbolKind

from lsp.mission_texts import FILE_KEYS, KEY, STRING, OpenMission
from lsp.positions import Lines
from lsp.uris import uri_of
from nddl_lang.text.toml_places import HEADER

_COMMENT = re.compile(r"#.*")
_NAMING = ("name", "timeline", "predicate", "model")  # of these keys an entry of the outline is made
_KINDS = {"reactor": SymbolKind.Class, "goal": SymbolKind.Event, "parameters": SymbolKind.Variable}


@dataclass(slots=True)
class _Section:
    """A table: its name, the lines from its header to the last that says something, and what names it."""

    name: str
    is_array: bool
    first: int
    begin: int  # columns of the name
    finish: int
    last: int
    end: int  # how long the last line is
    names: dict[str, str]


def mission_outline(mission: OpenMission) -> list[DocumentSymbol]:
    """The tables, those inside a reactor or goal below it."""
    found: list[DocumentSymbol] = []
    above: list[tuple[_Section, DocumentSymbol]] = []
    for section in _sections(mission.lines):
        symbol = _symbol(mission, section)
        while above and not (above[-1][0].is_array and section.name.startswith(f"{above[-1][0].name}.")):
            above.pop()
        if above:
            parent = above[-1][1]
            parent.children = [*(parent.children or ()), symbol]
            for _, each in above:
                each.range.end = symbol.range.end
        else:
            found.append(symbol)
        above.append((section, symbol))
    return found


def mission_folds(mission: OpenMission) -> list[FoldingRange]:
    """Tables, values of several lines, and comments that follow each other."""
    lines = list(_depths(mission.lines))
    found = {(each.first, each.last): FoldingRange(each.first, each.last) for each in _sections(mission.lines)}
    comment: int | None = None
    opened: int | None = None
    for number, (line, is_inside) in enumerate(lines):
        if opened is None and is_inside:
            opened = number - 1
        elif opened is not None and not is_inside:
            found.setdefault((opened, number - 1), FoldingRange(opened, number - 1))
            opened = None
        if line.lstrip().startswith("#") and not is_inside:
            comment = number if comment is None else comment
            if number + 1 == len(lines) or not lines[number + 1][0].lstrip().startswith("#"):
                found.setdefault((comment, number), FoldingRange(comment, number, kind=FoldingRangeKind.Comment))
        else:
            comment = None
    return [found[place] for place in sorted(found) if place[1] > place[0]]


def mission_links(mission: OpenMission) -> list[DocumentLink]:
    """One link per file that is named and is there."""
    return list(_links(mission))


def _links(mission: OpenMission) -> Iterator[DocumentLink]:
    starts = mission.lines.starts
    key = ""
    for number, (line, is_inside) in enumerate(_depths(mission.lines)):
        begun = KEY.match(line) if not is_inside else None
        if not is_inside:
            key = begun[1].strip("\"'") if begun is not None else ""
        if key not in FILE_KEYS:
            continue
        for string in _strings(line, begun.end() if begun is not None else 0):
            path = mission.file_named(string[2])
            if path is not None:
                place = mission.lines.range(*(starts[number] + each for each in string.span(2)))
                yield DocumentLink(place, uri_of(path))


def _symbol(mission: OpenMission, section: _Section) -> DocumentSymbol:
    starts = mission.lines.starts
    start = starts[section.first]
    whole = mission.lines.range(start, starts[section.last] + section.end)
    name = mission.lines.range(start + section.begin, start + section.finish)
    names = section.names
    given = names.get("name") or ".".join(names[each] for each in ("timeline", "predicate") if each in names)
    kind = _KINDS.get(section.name.partition(".")[0], SymbolKind.Namespace)
    label = f"{section.name} {given}" if given else section.name
    return DocumentSymbol(label, kind, whole, name, detail=names.get("model"))


def _sections(lines: Lines) -> Iterator[_Section]:
    """The tables with a header and a name, in the order of the text."""
    section: _Section | None = None
    for number, (line, is_inside) in enumerate(_depths(lines)):
        table = HEADER.match(line) if not is_inside else None
        if table is not None and table[2]:
            if section is not None:
                yield section
            section = _Section(table[2], table[1] is not None, number, *table.span(2), number, len(line), {})
        elif section is not None and (is_inside or _COMMENT.sub("", line, count=1).strip()):
            section.last, section.end = number, len(line)
            key = KEY.match(line) if not is_inside else None
            if key is not None and key[1] in _NAMING:
                string = next(_strings(line, key.end()), None)
                if string is not None:
                    section.names[key[1]] = string[2]
    if section is not None:
        yield section


def _depths(lines: Lines) -> Iterator[tuple[str, bool]]:
    """The lines, and of each whether it begins inside an array."""
    depth = 0
    for begin, end in pairwise((*lines.starts, len(lines.text))):
        line = lines.text[begin:end].rstrip("\r\n")
        yield line, depth > 0
        plain = _COMMENT.sub("", STRING.sub("", line))
        if depth > 0 or KEY.match(line):
            depth = max(0, depth + plain.count("[") - plain.count("]"))


def _strings(line: str, begin: int) -> Iterator[re.Match[str]]:
    """The strings of a line before its comment."""
    for string in STRING.finditer(line, begin):
        if "#" in STRING.sub("", line[begin : string.start()]):
            return
        yield string
