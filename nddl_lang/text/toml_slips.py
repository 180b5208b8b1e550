"""What is wrong with a text that is no TOML: the place, what the reader says, and what was probably meant."""

import re
from collections.abc import Callable

from nddl_lang.text.diagnostic import Code, Diagnostic, Edit, Fix
from nddl_lang.text.source import Anchor, Source, Span
from nddl_lang.text.toml_places import HEADER

_PLACE = re.compile(r" \(at (?:line (\d+), column (\d+)|end of document)\)")
_NAMES = re.compile(r"\((?:'[^']*',? ?)+\)")
_PART = re.compile(r"'([^']*)'")
_WORD = re.compile(r"[A-Za-z_/][^\s,;#\]}\"']*")
_LIST_BEGINS = re.compile(r"^[^#\n=\"']*=[ \t]*\[", re.MULTILINE)
_NO_VALUE = re.compile(r"\s*(?:\Z|\[[\[ \t]*[A-Za-z_]|[\w.\"'-]+[ \t]*=)")
_DIGITS = re.compile(r"[0-9]+(?:\.[0-9]+)?\Z")
_TRUTHS = {"true": "true", "yes": "true", "on": "true", "false": "false", "no": "false", "off": "false"}
_OPEN_TEXT = "the quotes of a text close in its line"
_COMMENT = "a comment begins with `#`"
_LIST = "a list stands in brackets: `[5, 60]`"

_Advice = tuple[str, tuple[Fix, ...]]


def not_toml(code: Code, source: Source, problem: str) -> Diagnostic:
    """The diagnostic of `code`, which takes a `reason`, for what `tomllib` says of a text."""
    reason, at = _split(source, problem)
    twice = _single_header(source, at) if "overwrite" in reason or "twice" in reason else None
    if twice is not None:
        span, name = twice
        fix = Fix(f"write `[[{name}]]`", (Edit(span, f"[[{name}]]"),))
        return code.at(span, reason=reason, help=f"each of several begins with `[[{name}]]`", fixes=(fix,))
    for begin, advise in _SLIPS:
        if reason.startswith(begin) and (found := advise(source, at)) is not None:
            place = _opened(source, at) if advise is _array else at
            return code.at(_span(source, place, place + 1), reason=reason, help=found[0], fixes=found[1])
    return code.at(_span(source, at, at + 1), reason=reason)


def _split(source: Source, message: str) -> tuple[str, int]:
    """What is wrong, and the offset that it is said of."""
    place = _PLACE.search(message)
    offset = len(source.text) if place else 0
    if place and place[1]:
        offset = source.line_starts[min(int(place[1]), len(source.line_starts)) - 1] + int(place[2]) - 1
    reason = _NAMES.sub(_dotted, message[: place.start()] if place else message)
    return reason[:1].lower() + reason[1:], offset


def _dotted(names: re.Match[str]) -> str:
    """The name of a table, whose parts `tomllib` tells as Python has them."""
    return f"`{'.'.join(_PART.findall(names[0]))}`"


def _span(source: Source, begin: int, finish: int) -> Span:
    end = len(source.text)
    return Span(Anchor(source), min(begin, end), min(finish, end))


def _single_header(source: Source, at: int) -> tuple[Span, str] | None:
    """A header `[name]` where another is `[[name]]`, for the name of the last header before `at`."""
    headers = list(HEADER.finditer(source.text, 0, at + 2))
    name = headers[-1][2] if headers else ""
    alike = [each for each in headers if each[2] == name]
    single = [each for each in alike if each[1] is None]
    if not single or len(single) == len(alike):
        return None
    begin = source.text.index("[", single[0].start())
    return _span(source, begin, single[0].end()), name


def _instead(source: Source, begin: int, finish: int, text: str, help_: str) -> _Advice:
    return help_, (Fix(f"write `{text.strip()}`", (Edit(_span(source, begin, finish), text),)),)


def _without(source: Source, at: int) -> Fix:
    return Fix(f"remove `{source.text[at]}`", (Edit(_span(source, at, at + 1), ""),))


def _value(source: Source, at: int) -> _Advice | None:
    rest = source.text[at:].partition("\n")[0]
    if word := _WORD.match(rest):
        truth = _TRUTHS.get(word[0].lower())
        if truth is not None:
            return _instead(source, at, at + word.end(), truth, "truth values are `true` and `false`")
        if word[0].lower() in ("null", "none", "nil"):
            return "what has no value is left out", ()
        return _instead(
            source, at, at + word.end(), f'"{word[0]}"', "a text stands in quotes; a number has digits only"
        )
    if rest.startswith("="):
        return "a value is given with one `=`", (_without(source, at),)
    if rest.startswith("("):
        return _LIST, ()
    if re.match(r"\.\d", rest):
        return _instead(source, at, at + 1, "0.", "a number begins with a digit")
    return ("the key has no value", ()) if not rest.strip() or rest.lstrip().startswith("#") else None


def _end(source: Source, at: int) -> _Advice | None:
    before, following = source.text[at - 1 : at], source.text[at : at + 1]
    if following == ";":
        return "a line of TOML ends without `;`", (_without(source, at),)
    if following == ",":
        return _LIST, ()
    if following == "%" and (number := _DIGITS.search(source.text, source.text.rfind("\n", 0, at) + 1, at)):
        share = f"{float(number[0]) / 100:g}"
        return _instead(source, number.start(), at + 1, share, f"a share is a number from 0 to 1: `{share}`")
    if before.isdigit() and following.isalpha():
        return "a number has no unit behind it", ()
    if following == "." and before.isdigit():
        return _instead(source, at, at + 1, ".0", "digits follow the point of a number")
    if following.isdigit() and before == "0":
        return "a number does not begin with 0", ()
    if source.text.startswith(("//", "--"), at):
        return _instead(source, at, at + 2, "#", _COMMENT)
    return None


def _statement(source: Source, at: int) -> _Advice | None:
    line = source.text.rfind("\n", 0, at) + 1
    begin = len(source.text) - len(source.text[line:].lstrip(" \t"))
    if source.text.startswith(("//", "--"), begin):
        return _instead(source, begin, begin + 2, "#", _COMMENT)
    if source.text.startswith(":", at):
        return _instead(source, at, at + 1, " =", "a key and its value stand on both sides of `=`")
    return "a line is a header, as `[mission]`, or a key with its value, as `seed = 1`", ()


def _array(source: Source, at: int) -> _Advice | None:
    if source.text.startswith(";", at):
        return _instead(source, at, at + 1, ",", "values of a list stand between commas")
    opened = _opened(source, at)
    if opened == at:
        return "values of a list stand between commas", ()
    end = len(source.text[:at].rstrip())
    return "the list is not closed: `]` is missing", (Fix("add `]`", (Edit(_span(source, end, end), "]"),)),)


def _opened(source: Source, at: int) -> int:
    """Where the list begins that is not closed before the key, header or end of the text at `at`; else `at`."""
    begun = [each.end() - 1 for each in _LIST_BEGINS.finditer(source.text, 0, at)]
    return begun[-1] if begun and _NO_VALUE.match(source.text, at) else at


_SLIPS: tuple[tuple[str, Callable[[Source, int], _Advice | None]], ...] = (
    ("invalid value", _value),
    ("expected newline or end of document", _end),
    ("expected '=' after a key", _statement),
    ("invalid statement", _statement),
    ("unclosed array", _array),
    ("illegal character '\\n'", lambda source, at: (_OPEN_TEXT, ())),
    ('expected "\'"', lambda source, at: (_OPEN_TEXT, ())),
    ("unescaped '\\'", lambda source, at: ("a `\\` is written `\\\\`; paths take `/` everywhere", ())),
    ("expected ']'", lambda source, at: ("a header is closed by `]`, or `]]` if `[[` opened it", ())),
    ("cannot declare", lambda source, at: ("a table is written once, with all its keys", ())),
    ("cannot overwrite", lambda source, at: ("a key is written once", ())),
)
