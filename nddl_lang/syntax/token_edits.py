"""The small edits of a line that may mend it: its lexemes in; edits of one lexeme, or of two, cheapest first, out.

What a slip of the hand or of another language costs least: a sign for another, a name misspelt, a blank too many. To
leave out a word costs most, for what is left out can no longer be wrong.
"""

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from nddl_lang.syntax.expectation import accepts, states_after
from nddl_lang.syntax.words import BASE_TYPES, KINDS, RELATIONS
from nddl_lang.text.nearest import nearest

_CLOSERS = {"(": ")", "[": "]", "{": "}", "SET": "}"}
_BRACKETS = (("(", ")"), ("[", "]"), ("{", "}"))
_OPERATORS = ("==", "<=", ">=")
_STRICT = ("!=", "<", ">")
_BOUNDS = frozenset(("<=", ">=", *_STRICT))  # nobody who gives a value means one of these
_ARITHMETIC = ("*", "+", "-", "/")
_SEPARATORS = (",", ";", ".", "::", ":", "=")
_WORDS = frozenset(("IDENT", "BASETYPE", "RELATION", "GOAL", "BOOL", "this")) | (
    frozenset(KINDS.values()) - {"INT", "FLOAT"}
)
_NUMBERS = frozenset(("INT", "FLOAT"))
_VALUES = _NUMBERS | {"STRING"}
_STOPS = frozenset((";", "{", "}", ")", ","))
_UNNAMED = ["RELATION", "(", "IDENT", ".", "IDENT", ")"]
_COMPARING = frozenset((*_OPERATORS, *_STRICT, "="))
_ENDS = frozenset((")", "]", "}", "IDENT", "this")) | _VALUES
_NAME = re.compile(r"[A-Za-z_$][A-Za-z0-9_$]*")
_NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
_LEXEME = re.compile(
    r"""([A-Za-z_$][A-Za-z0-9_$]*)|([+-]?\d+(?:\.\d+)?|\.\d+)|("[^"]*")|//.*|::|==|!=|<=|>=|&&|\|\||[^\s]"""
)
_OPERANDS = frozenset(("IDENT", "INT", "FLOAT", "STRING", "BOOL", "this", ")", "]"))
_FOLLOWING = 2  # lexemes behind a line that must fit, too
_MOST_NAMES = 12  # of a statement
_SHORTEST = 3  # letters of a name that may be misspelt

# What each kind of edit costs, in tenths of a misspelt letter.
_MISSPELT, _QUOTES, _CAPITALS, _BRACKET, _SIGN, _JOINED = 10, 11, 9, 12, 12, 11
_DOUBLED, _MISSING_SIGN, _SWAPPED, _ENCLOSED, _NEW, _OWNER = 10, 14, 15, 14, 15, 17
_NO_OWNER, _MISSING_TIMES, _MISSING_OPERATOR, _EXTRA_SIGN, _TYPE, _MEMBER = 16, 18, 18, 16, 20, 19
_OTHER_NAME, _OTHER_WORD, _EXTRA_WORD, _ARITHMETIC_SIGN, _MISSING_NAME, _COMMENT = 24, 24, 22, 23, 14, 13


@dataclass(frozen=True, slots=True)
class TokenEdit:
    """Put texts in place of stretches of a text, from and to; `cost` is higher the less likely that was meant."""

    cost: int
    edits: tuple[tuple[int, int, str], ...]

    def applied(self, text: str, offset: int = 0) -> str:
        """`text`, which begins at `offset`, after the edit."""
        parts: list[str] = []
        at = 0
        for begin, finish, put in sorted(self.edits):
            parts += (text[at : begin - offset], put)
            at = finish - offset
        return "".join(parts) + text[at:]


@dataclass(frozen=True, slots=True)
class Lexemes:
    """Some lexemes of a `text` in a row, with the offsets at which they stand there."""

    text: str
    kinds: Sequence[str]
    texts: Sequence[str]
    starts: Sequence[int]
    ends: Sequence[int]

    def group_end(self, first: int) -> int:
        """The lexeme after the value that begins at `first`: a path, with its call; brackets with all inside."""
        kinds = self.kinds
        at = first
        if kinds[at] in _CLOSERS:
            return self.closer(at) + 1 if self.closer(at) >= 0 else first
        if kinds[at] not in _WORDS and kinds[at] not in _VALUES:
            return first
        at += 1
        while at + 1 < len(kinds) and kinds[at] == "." and kinds[at + 1] in _WORDS:
            at += 2
        return at

    def closer(self, opener: int) -> int:
        """The lexeme that closes the bracket `opener`, whatever its kind; -1 where none does."""
        depth = 0
        for at in range(opener, len(self.kinds)):
            if self.kinds[at] in _CLOSERS:
                depth += 1
            elif self.kinds[at] in (")", "]", "}"):
                depth -= 1
                if depth == 0:
                    return at
        return -1


@dataclass(frozen=True, slots=True)
class Vocabulary:
    """The names that may have been meant.

    `known` are all names of the model, `missing` those that nothing declares, `near` those of the statement, those
    first that stand last, and `owners` those of it with a dot behind them.
    """

    known: Collection[str]
    missing: Sequence[str]
    near: Sequence[str]
    owners: Sequence[str]


def vocabulary(known: Collection[str], missing: Sequence[str], statement: Lexemes) -> Vocabulary:
    """The names for edits of a statement."""
    lexemes = list(zip(statement.texts, statement.kinds, strict=True))
    names = dict.fromkeys(text for text, kind in reversed(lexemes) if kind == "IDENT")
    pairs = pairwise(lexemes)
    owners = dict.fromkeys(text for (text, kind), (_, following) in pairs if kind == "IDENT" and following == ".")
    return Vocabulary(known, missing[:_MOST_NAMES], list(names)[:_MOST_NAMES], list(owners)[:_MOST_NAMES])


def token_edits(line: Lexemes, focus: tuple[int, int], words: Vocabulary) -> list[TokenEdit]:
    """The edits of a line, cheapest first; of equal cost those nearest to the `focus` go first, which is a stretch."""
    edits: dict[tuple[tuple[int, int, str], ...], int] = {}
    if _is_prose(line):
        edits[((line.starts[0], line.starts[0], "// "),)] = _COMMENT * 100
    for at in range(len(line.kinds)):
        near = _steps(line, at, focus)
        for cost, changes in _edits_at(line, at, words):
            key = tuple(sorted(changes))
            whole = cost * 100 + near
            if edits.get(key, whole + 1) > whole:
                edits[key] = whole
    return sorted(
        (TokenEdit(cost, changes) for changes, cost in edits.items()), key=lambda each: (each.cost, each.edits)
    )


def naming_edits(statement: Lexemes, missing: Sequence[str]) -> Iterator[TokenEdit]:
    """A name that nothing declares, for each token that is asked for without one: `contains(Pump.Run)`."""
    kinds = statement.kinds
    for at in range(4, len(kinds) - 1):
        if kinds[at - 4 : at + 2] == _UNNAMED:
            end = statement.ends[at]
            yield from (TokenEdit(_MISSING_NAME * 100, ((end, end, f" {name}"),)) for name in missing)


def _is_prose(line: Lexemes) -> bool:
    """Whether a line reads as a sentence that lacks its `//`: words in a row, and nothing that ends a statement."""
    before = line.text[: line.starts[0]].rpartition("\n")[2]
    words = "".join("w" if kind in _WORDS else " " for kind in line.kinds)
    return not before.strip() and "www" in words and line.kinds[-1] not in _STOPS and _COMPARING.isdisjoint(line.kinds)


def _steps(line: Lexemes, at: int, focus: tuple[int, int]) -> int:
    """How many lexemes lie between the lexeme `at` and the focus."""
    begin, finish = focus
    if line.starts[at] >= max(finish, begin + 1):
        return min(sum(finish <= start for start in line.starts[:at]) + 1, 50)
    if line.ends[at] < begin:
        return min(sum(end < begin for end in line.ends[at + 1 :]) + 1, 50)
    return 0


_Change = tuple[int, int, str]
_Priced = tuple[int, tuple[_Change, ...]]


def _edits_at(line: Lexemes, at: int, words: Vocabulary) -> Iterator[_Priced]:
    kind, text, start, end = line.kinds[at], line.texts[at], line.starts[at], line.ends[at]
    if kind in _WORDS:
        yield from _word_edits(line, at, words)
    elif kind == "STRING":
        inner = text[1:-1]
        if _NAME.fullmatch(inner) or _NUMBER.fullmatch(inner):
            yield _QUOTES, ((start, end, inner),)
    elif kind in _VALUES:
        if text.strip(".") != text:
            yield _QUOTES, ((start, end, text.rstrip(".")),)
        if kind in _NUMBERS and line.kinds[at + 1 : at + 2] and line.kinds[at + 1] in _NUMBERS:
            yield _JOINED, ((start, line.ends[at + 1], text + line.texts[at + 1]),)
    else:
        yield from _sign_edits(line, at)
    yield from _enclosing_edits(line, at)
    yield from _swaps(line, at)
    before = line.kinds[at - 1] if at else ""
    if at and line.texts[at - 1] == text and kind not in _CLOSERS and kind not in (")", "]", "}"):
        yield _DOUBLED, ((line.ends[at - 1], end, ""),)
    gap = line.ends[at - 1] if at else start
    for sign in (".", "::") if before in _WORDS and kind in _WORDS else ():
        yield _MISSING_SIGN, ((gap, start, sign),)
    for sign in (",", ";", ")", "]", "}", ":"):
        yield _MISSING_SIGN, ((gap, gap, f" {sign}" if sign == "}" else sign),)
    if at == len(line.kinds) - 1:
        for sign in (";", ")", "]", "}", ");", "];", "};", " {"):
            yield _MISSING_SIGN, ((end, end, sign),)
    for sign in ("(", "[", "{ "):
        yield _MISSING_SIGN, ((start, start, sign),)
    is_compared = not set(line.kinds).isdisjoint((*_OPERATORS, *_STRICT))
    if before == "new" and kind == "(":
        for name in words.near:
            yield _NEW, ((gap, start, f" {name}"),)
    if before in _ENDS:
        yield _MISSING_SIGN, ((start, start, "= "),)
        if kind in _WORDS or kind in _VALUES or kind == "(":
            for sign in () if is_compared else _OPERATORS:
                yield _MISSING_OPERATOR, ((start, start, f"{sign} "),)
            is_factor = before in ("INT", "FLOAT")
            for sign in _ARITHMETIC:
                cost = _MISSING_TIMES if sign in "*+" else _ARITHMETIC_SIGN
                yield cost - (is_factor and sign == "*"), ((start, start, f"{sign} "),)


def _word_edits(line: Lexemes, at: int, words: Vocabulary) -> Iterator[_Priced]:
    kinds = line.kinds
    kind, text, start, end = kinds[at], line.texts[at], line.starts[at], line.ends[at]
    before = kinds[at - 1] if at else ""
    folded = text.casefold()
    for name in words.known:
        if name != text and name.casefold() == folded:
            yield _CAPITALS, ((start, end, name),)
    if len(text) >= _SHORTEST:
        left = [name for name in words.known if name.casefold() != folded]
        for _ in range(2):
            if (meant := nearest(text, left)) is not None:
                yield _MISSPELT, ((start, end, meant),)
                left.remove(meant)
    for name in words.missing:
        if name != text:
            yield _JOINED, ((start, end, name),)
            yield _MISSING_NAME, ((end, end, f" {name}"),)
    if kind == "IDENT":
        yield _QUOTES, ((start, end, f'"{text}"'),)
        for name in words.near:
            if name not in (text, before):
                yield _OTHER_NAME, ((start, end, name),)
        if before != ".":
            yield _NEW, ((start, start, "new "),)
            for owner in (*words.owners, "object"):
                yield _OWNER, ((start, start, f"{owner}."),)
            for name in BASE_TYPES:
                yield _TYPE, ((start, start, f"{name} "),)
    for word in ("super", "end", "start", "duration", *RELATIONS):
        if word != text and before != ".":
            yield _OTHER_WORD, ((start, end, word),)
    if kinds[at + 1 : at + 2] == ["."]:
        yield _NO_OWNER, ((start, line.ends[at + 1], ""),)
    if at + 2 < len(kinds) and kinds[at + 2] in _WORDS:
        between = kinds[at + 1]
        for joint in ("_", ""):
            if between in ("-", ".", "::") and (joined := f"{text}{joint}{line.texts[at + 2]}") in words.known:
                yield _JOINED, ((start, line.ends[at + 2], joined),)
    if at + 1 < len(kinds) and kinds[at + 1] in _WORDS:
        for joint in ("_", ""):
            if (joined := f"{text}{joint}{line.texts[at + 1]}") in words.known:
                yield _JOINED, ((start, line.ends[at + 1], joined),)
        yield _EXTRA_WORD, ((start, line.starts[at + 1], ""),)
    if kinds[at + 1 : at + 2] != ["."]:
        for name in words.near:
            yield _MEMBER, ((end, end, f".{name}"),)
    if kinds[at + 1 : at + 2] == ["::"] and at + 2 < len(kinds):
        yield _SWAPPED, ((start, line.ends[at + 2], f"{line.texts[at + 2]}::{text}"),)


def _sign_edits(line: Lexemes, at: int) -> Iterator[_Priced]:
    kind, text, start, end = line.kinds[at], line.texts[at], line.starts[at], line.ends[at]
    if kind in _CLOSERS:
        closer = line.closer(at)
        if closer >= 0:
            for opening, closing in _BRACKETS:
                change = (start, end, opening)
                if opening != text or closing != line.texts[closer]:
                    yield _BRACKET, (change, (line.starts[closer], line.ends[closer], closing))
            yield _EXTRA_SIGN + 2, ((start, end, " "), (line.starts[closer], line.ends[closer], ""))
    elif kind in (")", "]", "}"):
        for closing in (")", "]", "}"):
            if closing != kind:
                yield _BRACKET, ((start, end, closing),)
    else:
        for sign in _SEPARATORS if kind == ";" else (*_SEPARATORS, *_OPERATORS, *_STRICT, *_ARITHMETIC, "&&", "||"):
            if sign != text and not (text == "=" and sign in _BOUNDS):
                put = sign if sign in _SEPARATORS or text not in _SEPARATORS else _spaced(line.text, start, end, sign)
                is_alike = sign[0] == text[0] or (text in ",;.:" and sign in ",;.:") or "=" in (sign, text)
                yield _SIGN + 4 * (not is_alike) + 2 * (sign in _STRICT), ((start, end, put),)
    yield _EXTRA_SIGN, ((start, end, ""),)
    if at and at + 1 < len(line.kinds) and line.ends[at - 1] < start:  # the blanks around it are left out too
        yield _EXTRA_SIGN + 1, ((line.ends[at - 1], line.starts[at + 1], " "),)


def _spaced(text: str, start: int, end: int, sign: str) -> str:
    """An operator in place of a stretch of `text`, with a blank on either side."""
    return f"{' ' * (text[start - 1 : start] != ' ')}{sign}{' ' * (text[end : end + 1] != ' ')}"


def _enclosing_edits(line: Lexemes, at: int) -> Iterator[_Priced]:
    """Brackets around a value, around two, and around what is left of the line."""
    start = line.starts[at]
    first = line.group_end(at)
    if first == at:
        return
    blank = line.ends[at - 1] if at and line.kinds[at - 1] in _WORDS else start
    yield _ENCLOSED, ((blank, start, "("), (line.ends[first - 1], line.ends[first - 1], ")"))
    second = line.group_end(first) if first < len(line.kinds) else first
    if second > first:
        for opening, closing in _BRACKETS:
            yield _ENCLOSED, ((start, start, opening), (line.ends[second - 1], line.ends[second - 1], closing))
    if line.kinds[-1] in (";", "}"):
        yield _ENCLOSED + 1, ((start, start, "{ "), (line.ends[-1], line.ends[-1], " }"))


def _swaps(line: Lexemes, at: int) -> Iterator[_Priced]:
    """The value that begins here and the one behind it, each in the other's place."""
    first = at + 1 if line.kinds[at] in _SEPARATORS else line.group_end(at)
    if first == at or first >= len(line.kinds):
        return
    is_sign = line.kinds[first] in _SEPARATORS and first == at + 1
    second = first + 1 if is_sign else line.group_end(first)
    if second > first:
        begin, end = line.starts[at], line.ends[first - 1]
        start, finish = line.starts[first], line.ends[second - 1]
        if line.kinds[at] in _SEPARATORS:
            yield _SWAPPED, ((begin, finish, f" {line.text[start:finish]}{line.texts[at]}"),)
        else:
            yield _SWAPPED, ((begin, end, line.text[start:finish]), (start, finish, line.text[begin:end]))


class LineGrammar:
    """Tells of edits of a line, at little cost, whether the parser could go on behind it: most lead nowhere.

    `kinds` are those of the whole piece, in which the line has the lexemes from `first` on.
    """

    def __init__(self, kinds: Sequence[str], first: int, line: Lexemes) -> None:
        last = first + len(line.kinds)
        self._line = line
        self._following = kinds[last : last + _FOLLOWING]
        is_plain = "SET" not in line.kinds and line.kinds == _kinds_of(line.text[line.starts[0] : line.ends[-1]])
        self._states = states_after([0], kinds[:first]) if is_plain else None

    def may_fit(self, edit: TokenEdit) -> bool:
        """Whether the line after the edit may fit; where that is not known it may."""
        if self._states is None or any("{" in put or "}" in put for _, _, put in edit.edits):
            return True
        begin, finish = self._line.starts[0], self._line.ends[-1]
        text = edit.applied(self._line.text[begin:finish], begin)
        return accepts(self._states, [*_kinds_of(text), *self._following])


def _kinds_of(text: str) -> list[str]:
    """The kinds of the lexemes of a line, but for those of which the scanner has to know more."""
    kinds: list[str] = []
    for match in _LEXEME.finditer(text):
        word, number, string = match.groups()
        if word is not None:
            kinds.append(KINDS.get(word, "IDENT"))
        elif number is not None:
            is_operator = number[0] in "+-" and kinds and kinds[-1] in _OPERANDS
            kinds += [number[0]] if is_operator else []
            kinds.append("FLOAT" if "." in number else "INT")
        elif string is not None:
            kinds.append("STRING")
        elif not match[0].startswith("//"):
            kinds.append(match[0])
    return ["IDENT" if kind == "FORMER" else kind for kind in kinds]
