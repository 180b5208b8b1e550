"""Texts of others in, what may be printed out: nothing of a model or a mission file commands a terminal."""

import re

# Controls of a terminal (ESC, BEL, C1), and marks that turn the direction of writing; tabs and line ends may stay.
_COMMANDS = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u200e\u200f\u202a-\u202e\u2066-\u2069]")
_BUT_COLOURS = re.compile(f"\x1b\\[[0-9;]*m|{_COMMANDS.pattern}")
_SIGN = "\N{REPLACEMENT CHARACTER}"


def printable(text: str) -> str:
    """A text of others, with a sign for each character that is none."""
    return text if text.isascii() and text.isprintable() else _COMMANDS.sub(_SIGN, text)


def but_colours(text: str) -> str:
    """A page that may have colours, with a sign for each other command to a terminal."""
    return _BUT_COLOURS.sub(lambda found: found[0] if len(found[0]) > 1 else _SIGN, text)


def counted(count: int, word: str, words: str | None = None) -> str:
    """`1 goal`, `2 goals`; `words` is what several are called where an `s` does not do."""
    return f"{count} {word if count == 1 else words or f'{word}s'}"
