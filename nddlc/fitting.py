"""Lines for people in, lines that fit the terminal out: wrapped, excerpts cut around the marks, places as links.

Colours count for nothing; a word that is longer than the line, such as a path, stays whole.
"""

import os
import re
import shutil
import sys
from pathlib import Path

import click

from nddl_lang.text.printable import but_colours

_CODE = re.compile(r"\x1b\[[0-9;]*[A-Za-z]")
_SOURCE = re.compile(r"^\s*(?:\d+ \||\d+ [-+]|\|) ")  # the gutter of an excerpt
_MARKS = re.compile(r"^\s*\| ( *)([-^]+)\s*$")
_HANGING = re.compile(r"^\s*(?:(?:\d+\.?|[=*-]|-->)\s+)?(?:tick \d+: )?(?:(?:note|help): )?")
_PLACE = re.compile(
    r"^(?P<arrow>(?:\x1b\[[0-9;]*m|\s)*-->(?:\x1b\[[0-9;]*m|\s)+)(?P<place>(?P<file>[^\x1b\n]+?):(?P<line>\d+)(?::\d+)?)(?![^\s\x1b])",
    re.MULTILINE,
)
_LEAST = 20  # columns
_AHEAD = 12  # columns shown of what is marked


def columns() -> int | None:
    """How wide the terminal is; None where nobody looks, and lines may be as long as they are."""
    if sys.stdout.isatty() or os.environ.get("COLUMNS", "").isdigit():
        return terminal_width()
    return None


def terminal_width() -> int:
    """How many columns the terminal has, or would have."""
    return shutil.get_terminal_size((100, 24)).columns


def colours() -> bool:
    """Whether to colour: on a terminal, unless NO_COLOR is set."""
    return sys.stdout.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"


def say(text: str) -> None:
    """Print a text that ends with a line end; on a terminal the places that it names are links."""
    page = fitted(text, columns())
    click.echo(linked(page) if colours() else page, nl=False)


def linked(page: str) -> str:
    """A page with each source place behind an arrow as a link to the file (OSC 8), where there is one."""
    return _PLACE.sub(_link, page)


def _link(place: re.Match[str]) -> str:
    path = Path(place["file"])
    if not path.is_file():
        return place[0]
    return f"{place['arrow']}\x1b]8;;{path.resolve().as_uri()}#{place['line']}\x1b\\{place['place']}\x1b]8;;\x1b\\"


def fitted(text: str, width: int | None) -> str:
    """The text in lines of at most so many columns; where there is no width they may be as long as they are."""
    text = but_colours(text)
    if width is None:
        return text
    room = max(width, _LEAST)
    if all(len(line) <= room for line in text.split("\n")):
        return text
    lines = text.split("\n")
    fits: list[str] = []
    shift = 0
    for number, line in enumerate(lines):
        plain = _CODE.sub("", line)
        gutter = _SOURCE.match(plain)
        if gutter is None:
            fits += [line] if len(plain) <= room else _wrapped(line, plain, room)
            continue
        begin = gutter.end()
        marks = _MARKS.match(plain)
        if marks is None or number == 0:
            below = _MARKS.match(_CODE.sub("", lines[number + 1])) if number + 1 < len(lines) else None
            marked = begin + len(below[1]) + min(len(below[2]), _AHEAD) if below is not None else 0
            shift = max(0, marked - room + 1) if len(plain) > room else 0
        fits.append(_cut(line, begin, shift, room, is_marks=marks is not None))
    return "\n".join(fits)


def _wrapped(line: str, plain: str, room: int) -> list[str]:
    """A line as several, the further ones below where its words begin."""
    hanging = _HANGING.match(plain)
    indent = " " * min(hanging.end() if hanging is not None else 0, room // 2)
    if indent == plain[: len(indent)] and not indent.strip() and len(indent) == len(plain) - len(plain.lstrip()):
        indent += "  "
    found: list[str] = []
    at, length = "", 0
    for gap, word in re.findall(r"( *)([^ ]+)", line):
        size = len(_CODE.sub("", word))
        if at.strip() and length + len(gap) + size > room:
            found.append(at)
            at, length = indent, len(indent)
            gap = ""
        at, length = f"{at}{gap}{word}", length + len(gap) + size
    return [*found, at]


def _cut(line: str, begin: int, shift: int, room: int, *, is_marks: bool) -> str:
    """A line of an excerpt, moved to the left behind its gutter and cut at the end; colours stay."""
    end = shift + room
    size = len(_CODE.sub("", line))
    kept: list[str] = []
    column, at = 0, 0
    for code in [*_CODE.finditer(line), None]:
        stop = len(line) if code is None else code.start()
        for letter in line[at:stop]:
            if column < begin or begin + shift <= column < end:
                is_left_out = (shift and column == begin + shift) or (size > end and column == end - 1)
                kept.append("…" if is_left_out and not is_marks else letter)
            column += 1
        if code is not None:
            kept.append(code.group())
            at = code.end()
    return "".join(kept).rstrip(" ")
