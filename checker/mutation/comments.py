"""A statement in; out: the numbers that comments name beside it, in its line, right above it and above its rule, and
whether they say that it is so much per something.
"""

import re
from collections.abc import Iterator

from nddl_lang.text.source import Source, Span

_NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d+)?")
_WORD = re.compile(r"[a-z]+")
_PER = re.compile(r"\bper\b", re.IGNORECASE)
_COMMENT = re.compile(r"\s*///?(.*)")
# Without `one`, which counts nothing in `one value per mission`.
_NAMED = {
    "two": 2,
    "three": 3,
    "four": 4,
    "five": 5,
    "six": 6,
    "seven": 7,
    "eight": 8,
    "nine": 9,
    "ten": 10,
    "twelve": 12,
    "fifteen": 15,
    "twenty": 20,
    "thirty": 30,
    "forty": 40,
    "fifty": 50,
    "sixty": 60,
    "ninety": 90,
    "hundred": 100,
}


def numbers_beside(statement: Span, whole: Span) -> frozenset[float]:
    """The numbers that comments name which speak of a statement, or of the rule that is `whole`."""
    said = [*_beside(statement), *_above(whole.source, whole.line)]
    found = {one for text in said for one in numbers_in(text)}
    return frozenset(
        found | {float(_NAMED[one]) for text in said for one in _WORD.findall(text.lower()) if one in _NAMED}
    )


def numbers_in(text: str) -> set[float]:
    """The numbers that a text names in digits."""
    return set(map(float, _NUMBER.findall(text)))


def tells_rate(statement: Span) -> bool:
    """Whether a comment beside a statement speaks of so much per something: `Tonnes per tick`."""
    return any(_PER.search(text) is not None for text in _beside(statement))


def _beside(statement: Span) -> Iterator[str]:
    """The comments in the first line of a statement, and right above it."""
    source = statement.source
    yield source.line(statement.line).partition("//")[2]
    yield from _above(source, statement.line)


def _above(source: Source, line: int) -> Iterator[str]:
    """The comments that stand right above a line."""
    at = line - 1
    while at > 0 and (comment := _COMMENT.fullmatch(source.line(at))) is not None:
        yield comment.group(1)
        at -= 1
