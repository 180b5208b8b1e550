"""Judge single lexemes: numbers, strings, directives, and characters that mean nothing."""

import re
from unicodedata import category

from nddl_lang.syntax.codes import (
    FORMER_DIRECTIVE,
    FORMER_NUMBER,
    FORMER_STRING,
    GLUED_SIGN,
    INTEGER_RANGE,
    MALFORMED_NUMBER,
    UNCLOSED_STRING,
    UNEXPECTED_CHARACTER,
    UNKNOWN_ESCAPE,
)
from nddl_lang.syntax.piece import Piece
from nddl_lang.text.diagnostic import Edit, Fix
from nddl_lang.text.nearest import nearest

# Infinity of EUROPA on a machine with 64 bits.
INFINITY = 2**52 - 1

_MEASURED = re.compile(r"([+-]?(?:0|[1-9][0-9]{0,8})(?:\.[0-9]{1,9})?)[A-Za-z]\w{0,30}")
_INTEGER = re.compile(r"[+-]?(?:0|[1-9][0-9]*)[lL]?")
_REAL = re.compile(
    r"[+-]?[0-9]+(?:\.[0-9]*(?:[eE][+-]?[0-9]+)?[fFdD]?|[eE][+-]?[0-9]+[fFdD]?|[fFdD])"
    r"|\.[0-9]+(?:[eE][+-]?[0-9]+)?[fFdD]?"
)
_NUMBER = re.compile(r"[+-]?(?:0|[1-9][0-9]{0,8})(?:\.[0-9]{1,9})?")
_LETTERS_LIKE_DIGITS = str.maketrans("OolI", "0011")
_BOUNDS = re.compile(r"([+-]?[0-9]+(?:\.[0-9]+)?)\.{2,3}([+-]?[0-9]+(?:\.[0-9]+)?)")
_HEXADECIMAL = re.compile(r"([+-]?)0[xX]([0-9a-fA-F]{1,16})[lL]?")
_OCTAL = re.compile(r"([+-]?)0+([0-7]{1,22})[lL]?")
_LEADING_DIGITS = re.compile(r"[+-]?[0-9]{1,16}")
_ESCAPE = re.compile(r"\\(?:[btnfr\"'\\]|u[0-9a-fA-F]{4}|[0-7]|(.)|\Z)", re.DOTALL)
_AFTER_STRING = re.compile(r"[ \t\r\n\f]*+(?:[;,)}\]:=!<>&|+\-*/]|\Z)")
_AFTER_PER_CENT = re.compile(r"[ \t]{0,20}[;,)*/+&|<>=!-]")
_INCLUDES = ("include", "import", "use", "using", "require", "load")
_NEARLY_INCLUDE = re.compile(r"(#[ \t]*([A-Za-z]+))[ \t]*\"")
_CONSTANT = re.compile(r"#[ \t]*define[ \t]+([A-Za-z_$][\w$]*)[ \t]+([-+]?[0-9][\w.]*)(?=\s*(?://|/\*|$))")
_EXCERPT = 24

_HELP = {
    "%": "the remainder of a division is the function `mod(a, b)`",
    "^": "a power is the function `pow(a, b)`",
    "?": "a choice between two values is an `if` in a rule: `if (c) { x == a; } else { x == b; }`",
    "~": "write `!`, or compare with `false`: `x == false`",
}
# What begins a line.
_FIRST_HELP = {"@": "NDDL has no annotations", "%": "a comment begins with `//`"}
# Signs as typesetters and other keyboards write them.
_TYPESET = {
    "≤": "<=",
    "≥": ">=",
    "≠": "!=",
    "×": "*",
    "·": "*",
    "÷": "/",
    "−": "-",
    "–": "-",
    "∧": "&&",
    "∨": "||",
    "；": ";",
    "，": ",",
    "（": "(",
    "）": ")",
    "｛": "{",
    "｝": "}",
    "［": "[",
    "］": "]",
    "：": ":",
    "＝": "=",
    "&": "&&",
    "|": "||",
}
LONGEST_INDENT = 200  # characters before the first thing in a line that are looked at
_BLANKS = ("Zs", "Cf", "Cc")  # categories of Unicode
_DIRECTIVE_HELP = {
    "#define": "declare a variable: `int NAME = 5;`",
    "#use_xml": "remove the line: it has no meaning any more",
    "#line": "remove the line: it has no meaning any more",
    **dict.fromkeys(("#if", "#ifdef", "#ifndef", "#else", "#endif"), "remove the line: all text is read"),
}


def excerpt(text: str) -> str:
    """`text` in one short line, characters that cannot be seen by their number."""
    if len(text) <= _EXCERPT and text.isprintable():
        return text
    shown = "".join(letter if letter.isprintable() else f"U+{ord(letter):04X}" for letter in text[: _EXCERPT + 1])
    return shown if len(text) <= _EXCERPT else shown[:_EXCERPT] + "..."


def read_number(piece: Piece, start: int, word: str, strict: bool, *, is_bound: bool = False) -> str:
    """The kind of the number `word`; what is no number is reported and counts as a whole one."""
    if _INTEGER.fullmatch(word):
        if len(word) > 9:
            limit, bits = (2**31, 32) if strict else (INFINITY, 52)
            if len(word) > 20 or abs(int(word.rstrip("lL"))) > limit:
                piece.report(INTEGER_RANGE, start, start + len(word), text=excerpt(word), bits=bits)
        return "INT"
    if _REAL.fullmatch(word) or word.endswith("inff"):
        return "FLOAT"
    if word.endswith("inf"):
        return "INT"
    end = start + len(word)
    former = _HEXADECIMAL.fullmatch(word) or _OCTAL.fullmatch(word)
    if former is not None:
        value = str(integer(word))
        fix = Fix(f"write `{value}`", (Edit(piece.span(start, end), value),))
        piece.report(FORMER_NUMBER, start, end, help=f"write `{value}`", fixes=(fix,))
    else:
        help_text: str | None = None
        fixes: tuple[Fix, ...] = ()
        if (bounds := _BOUNDS.fullmatch(word)) is not None:
            text = " ".join(bounds.groups()) if is_bound else f"[{bounds[1]} {bounds[2]}]"
            help_text = f"an interval is written `[{bounds[1]} {bounds[2]}]`"
            fixes = (Fix(f"write `{text}`", (Edit(piece.span(start, end), text),)),)
        elif ".." in word:
            help_text = "an interval is written `[1 5]`"
        elif word.strip("+-").isdecimal():
            help_text = f"write `{excerpt(word.lstrip('+-').lstrip('0'))}`: numbers have no leading zeros"
        elif not (digits := word.translate(_LETTERS_LIKE_DIGITS)).isalpha() and _NUMBER.fullmatch(digits):
            help_text = f"write `{excerpt(digits)}`: there are letters in it"
            fixes = (Fix(f"write `{excerpt(digits)}`", (Edit(piece.span(start, end), digits),), safe=False),)
        elif (measured := _MEASURED.fullmatch(word)) is not None:
            unit = word[len(measured[1]) :]
            help_text = f"a number has no unit: write `{measured[1]}`; a product is written `{measured[1]} * {unit}`"
            fixes = (Fix(f"write `{measured[1]}`", (Edit(piece.span(start, end), measured[1]),), safe=False),)
        piece.report(MALFORMED_NUMBER, start, end, text=excerpt(word), help=help_text, fixes=fixes)
    return "INT"


def integer(word: str) -> int:
    """The value of a whole number as written, earlier forms included; too large a one counts as infinite."""
    if word.endswith("inf"):
        return -INFINITY if word[0] == "-" else INFINITY
    former = _HEXADECIMAL.fullmatch(word)
    if former is not None:
        value = int(former[1] + former[2], 16)
    elif (former := _OCTAL.fullmatch(word)) is not None:
        value = int(former[1] + former[2], 8)
    else:
        digits = _LEADING_DIGITS.match(word)
        value = int(digits[0]) if digits is not None else 0
    return max(-INFINITY, min(value, INFINITY))


def real(word: str) -> float:
    """The value of a real number as written."""
    if word.endswith("inff"):
        return float(-INFINITY if word[0] == "-" else INFINITY)
    return max(float(-INFINITY), min(float(word.rstrip("fFdD")), float(INFINITY)))


def report_glued_sign(piece: Piece, start: int, word: str, is_glued_left: bool) -> None:
    """Complain about a sign that EUROPA reads as part of the number after it."""
    number = word[1:].lstrip()
    end = start + len(word)
    spaced = f"{' ' if is_glued_left else ''}{word[0]} {number}"
    fix = Fix("put blanks around the operator", (Edit(piece.span(start, end), spaced),))
    help_text = f"write `{word[0]} {excerpt(number)}`"
    piece.report(GLUED_SIGN, start, end, text=excerpt(word), help=help_text, fixes=(fix,))


def string_end(text: str, start: int, end: int, is_path: bool) -> int:
    """Where the string that begins at `start` ends; `end` is after the next quote, or at the end of the text.

    A string may hold line ends, unless it is the path of an include. But where an operand follows at once, the quote
    that was taken for the closing one opens the next string: then the first string has no end, and is taken to end with
    its line.
    """
    line_end = text.find("\n", start, end)
    is_closed = end - start > 1 and text[end - 1] == '"'
    if is_closed and (line_end < 0 or (not is_path and _AFTER_STRING.match(text, end))):
        return end
    if line_end < 0:
        line_end = end
    return start + max(1, len(text[start:line_end].rstrip(" \t\r\f;)}")))


def read_string(piece: Piece, start: int, word: str) -> None:
    """Check the escapes of a string, and that it has a closing quote."""
    is_open = len(word) < 2 or word[-1] != '"' or (word[-2] == "\\" and not _is_escaped_backslash(word))
    if is_open:
        end = start + len(word)
        fix = Fix("close the string", (Edit(piece.span(end, end), '"'),), safe=False)
        piece.report(UNCLOSED_STRING, start, end, fixes=(fix,))
        return
    for match in _ESCAPE.finditer(word, 1, len(word) - 1):
        if match[1] is not None:
            at = start + match.start()
            piece.report(UNKNOWN_ESCAPE, at, at + 2, text=excerpt(match[0]), help="write `\\\\` for a backslash")


def _per_cent(piece: Piece, at: int) -> float | None:
    """The share that a number with the `%` at `at`, which no operand follows, was meant to be."""
    text = piece.anchor.source.text
    following = _AFTER_PER_CENT.match(text, at + 1)
    piece.reach = max(piece.reach, (following.end() if following is not None else at) + 2)
    if following is None or piece.kinds[-1:] not in (["INT"], ["FLOAT"]) or piece.ends[-1] > at:
        return None
    if _NUMBER.fullmatch(piece.texts[-1]) is None:  # it is told already what is wrong with it
        return None
    return real(piece.texts[-1]) / 100.0 if text[piece.ends[-1] : at].strip(" ") == "" else None


def _is_escaped_backslash(word: str) -> bool:
    """Whether the backslashes before the last quote of `word` pair up."""
    stem = word[:-1]
    return (len(stem) - len(stem.rstrip("\\"))) % 2 == 0


def read_quoted(piece: Piece, start: int, word: str) -> str:
    """The kind of a string in single quotes: a string, after a complaint."""
    end = start + len(word)
    fixes: tuple[Fix, ...] = ()
    if '"' not in word and "\\" not in word:
        fixes = (Fix("use double quotes", (Edit(piece.span(start, end), f'"{word[1:-1]}"'),)),)
    piece.report(FORMER_STRING, start, end, fixes=fixes)
    return "STRING"


def misspelt_include(word: str) -> str | None:
    """The beginning of a directive that was meant to be `#include`; None where it is another one."""
    found = _NEARLY_INCLUDE.match(word)
    return found[1] if found is not None and (found[2] in _INCLUDES or nearest(found[2], ["include"])) else None


def read_directive(piece: Piece, start: int, word: str) -> None:
    """Complain about a directive of earlier dialects; it is a comment from now on."""
    word = word.rstrip()
    name = re.match(r"#\s*\w*", word)
    assert name is not None
    text = name[0]
    fixes: tuple[Fix, ...] = ()
    help_text = _DIRECTIVE_HELP.get(text)
    constant = _CONSTANT.match(word)
    if constant is not None:
        type_name = "int" if _INTEGER.fullmatch(constant[2]) else "float"
        written = f"{type_name} {constant[1]} = {constant[2]};"
        help_text = f"declare a variable: `{written}`"
        fixes = (Fix(f"write `{written}`", (Edit(piece.span(start, start + constant.end()), written),), safe=False),)
    elif text.replace(" ", "").replace("\t", "") == "#include":
        fixes = (Fix("write `#include`", (Edit(piece.span(start, start + len(text)), "#include"),)),)
    elif text not in _DIRECTIVE_HELP:
        fixes = (Fix("write `//`", (Edit(piece.span(start, start + 1), "//"),), safe=False),)
    piece.report(
        FORMER_DIRECTIVE,
        start,
        start + len(text),
        text=excerpt(text),
        help=help_text,
        fixes=fixes,
    )


def read_other(piece: Piece, start: int, word: str) -> str | None:
    """The kind that was meant by characters which mean nothing; None of those that cannot be seen."""
    end = start + len(word)
    if (sign := _TYPESET.get(word)) is not None:
        fix = Fix(f"write `{sign}`", (Edit(piece.span(start, end), sign),))
        piece.report(UNEXPECTED_CHARACTER, start, end, text=word, help=f"write `{sign}`", fixes=(fix,))
        return sign
    if word != "\ufeff" and all(category(letter) in _BLANKS for letter in word):
        fix = Fix("write a blank", (Edit(piece.span(start, end), " "),))
        piece.report(UNEXPECTED_CHARACTER, start, end, text=excerpt(word), help="write a blank", fixes=(fix,))
        return None
    help_text = _HELP.get(word)
    at = piece.anchor.offset + start
    if word in _FIRST_HELP:
        before = piece.anchor.source.text[max(0, at - LONGEST_INDENT) : at]
        if not before[before.rfind("\n") + 1 :].strip():
            help_text = _FIRST_HELP[word]
    if word == "%" and (share := _per_cent(piece, at)) is not None:
        written = f"{share:g}"
        span = piece.span(piece.starts[-1] - piece.anchor.offset, end)
        fix = Fix(f"write `{written}`", (Edit(span, written),), safe=False)
        help_text = f"there is no per cent: write `{written}`"
        piece.report(UNEXPECTED_CHARACTER, start, end, text=word, help=help_text, fixes=(fix,))
        return "UNKNOWN"
    if any(letter.isalpha() for letter in word):
        help_text = "names are made of the letters a to z and A to Z, digits, `_` and `$`"
    piece.report(UNEXPECTED_CHARACTER, start, end, text=excerpt(word), help=help_text)
    return "UNKNOWN"
