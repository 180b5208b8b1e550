"""See braces that are missing or too many while a piece is cut from the text, by what can only follow one.

Elsewhere the parser would find out too late: the piece would end at the wrong `}`, and what belongs to it would come to
stand at the top level. All offsets are absolute, as the piece is not finished yet.
"""

import re
from collections.abc import Callable, Sequence

from nddl_lang.syntax.brackets import Brackets
from nddl_lang.syntax.codes import MISSING, STRAY_BRACE, SUPERFLUOUS, UNCLOSED_BRACE
from nddl_lang.syntax.piece import Piece
from nddl_lang.text.diagnostic import Edit, Fix, Note

_STATEMENT_BEGINS = frozenset(("IDENT", "BASETYPE", "close", "new"))
_TYPES = frozenset(("BASETYPE", "filter"))
_BRANCHES = frozenset(("if", "else", "foreach"))
_OPENS = frozenset(("{", "SET"))
_MEMBERS = _TYPES | {"predicate", "action"}
_LINE = re.compile(r"\n([ \t]*)(//[^\n]*|[^\s])")
# Not possessive: Python up to 3.11.2 misplaces a group behind a possessive one. Each line is read in one way only.
_NEXT_LINE = re.compile(r"(?:[ \t\r\f]*(?://[^\n]*)?\n)*([ \t]*)(\}|(?:predicate|action)(?![A-Za-z0-9_$]))?")
_STRAYS = re.compile(r"((?:[ \t\r\n\f]*\})*)[ \t\r\n\f]*")
_LONGEST = len("predicate") + 1
ELSE_AHEAD = re.compile(r"(?:[ \t\r\n\f]+|//[^\n]*|/\*.*?\*/)*(else(?![A-Za-z0-9_$]))?", re.DOTALL)
# What is given back is read again: without a limit, by each of many pieces inside of each other.
_MOST_GIVEN_BACK = 2000


def open_head(piece: Piece, brackets: Brackets, base: int, head: int, kind: str) -> None:
    """Open the block of the class, predicate, action or enum at the lexeme `head` if its `{` was left out.

    `kind` is that of the next lexeme, a sign or a word that begins a member.
    """
    kinds = piece.kinds
    at = head + (4 if kinds[head + 2 : head + 3] == ["extends"] else 2)
    if at > len(kinds) or kinds[head + 1] != "IDENT" or kinds[at - 1] != "IDENT":
        return
    first = kinds[at] if at < len(kinds) else kind
    match kinds[head]:
        case "class":
            is_constructor = kind == "(" and piece.texts[at:] == [piece.texts[head + 1]]
            is_member = kind == ";" and begins_declaration(kinds, at)
            is_missing = first in _MEMBERS or is_constructor or is_member
        case "enum":
            is_missing = first == "IDENT" and kind == "}"
        case _:
            is_missing = kind == ";" and begins_declaration(kinds, at)
    if is_missing:
        put_in(piece, brackets, base, at)


def begins_declaration(kinds: Sequence[str], at: int) -> bool:
    """Whether the lexemes from `at` on begin with a type, as a variable's declaration does."""
    return not _TYPES.isdisjoint(kinds[at : at + 1]) or kinds[at : at + 2] == ["IDENT", "IDENT"]


def put_in(piece: Piece, brackets: Brackets, base: int, at: int) -> None:
    """Put a missing `{` before the lexeme `at`."""
    brackets.open.append("{")
    piece.mends.append((at, "{"))
    place = piece.ends[at - 1] - base
    fix = Fix("add ` {`", (Edit(piece.span(place, place), " {"),))
    piece.report(MISSING, place, place, text="{", place="here", fixes=(fix,))


def close_body(piece: Piece, brackets: Brackets, base: int, at: int) -> None:
    """Close the predicate or constructor that is still open where another member of a class begins at lexeme `at`."""
    opener = _opener_of(piece.kinds, at)
    while len(brackets.open) > 1:
        if brackets.open.pop() in ("{", "SET"):
            piece.mends.append((at, "}"))
    start = piece.starts[opener] - base
    place = piece.ends[at - 1] - base
    notes = (Note("it should end here", piece.span(place, place)),)
    fixes = (Fix("add `}`", (Edit(piece.span(place, place), " }"),), safe=False),)
    piece.report(UNCLOSED_BRACE, start, start + 1, text="{", notes=notes, fixes=fixes)


def close_branch(piece: Piece, brackets: Brackets, base: int, start: int) -> None:
    """Close the block of an `if` that is still open where the `else` at `start` begins."""
    kinds = piece.kinds
    if brackets.innermost != "{" or kinds[-1:] != [";"] or kinds[_statement_before(kinds, len(kinds) - 1)] == "if":
        return
    opener = _opener_of(kinds, len(kinds))
    if kinds[_condition_before(kinds, opener) - 1] != "if":
        return
    brackets.open.pop()
    piece.mends.append((len(kinds), "}"))
    at, place = piece.starts[opener] - base, start - base
    notes = (Note("it should end here", piece.span(place, place)),)
    fixes = (Fix("add `}`", (Edit(piece.span(place, place), "} "),), safe=False),)
    piece.report(UNCLOSED_BRACE, at, at + 1, text="{", notes=notes, fixes=fixes)


def open_branch(piece: Piece, brackets: Brackets, text: str, base: int, finish: int, depth: int, indent: int) -> bool:
    """Put in the `{` of an `if`, `else` or `foreach` where its `}`, which ends at `finish`, closed the whole rule.

    It is seen by what cannot follow a rule: an `else`, or, where the `}` stands `depth` blanks deep, alone in its line
    and deeper than the rule at `indent`, another `}`.
    """
    missing = _without_block(piece.kinds)
    if missing < 0:
        return False
    ahead, following = ELSE_AHEAD.match(text, finish), _NEXT_LINE.match(text, finish)
    assert ahead is not None and following is not None
    end = max(ahead.end(), following.end())
    piece.reach = max(piece.reach, len(text) + 1 if text.startswith("/", ahead.end()) else end + _LONGEST)
    is_closed_again = depth > indent >= 0 and (following[2] == "}" or _goes_on(piece, text, finish, indent))
    if ahead[1] is None and not is_closed_again:
        return False
    put_in(piece, brackets, base, missing)
    return True


def _without_block(kinds: Sequence[str]) -> int:
    """What stands behind the last `if (...)`, `else` or `foreach (...)` of a rule's body in place of `{`; else -1."""
    if _BRANCHES.isdisjoint(kinds):
        return -1
    depth = 1  # the `}` at hand is not among the lexemes yet
    for at in range(len(kinds) - 1, 0, -1):
        depth += {"}": 1, "{": -1, "SET": -1}.get(kinds[at], 0)
        if kinds[at] in _BRANCHES and depth == 1:
            behind = at + 1 if kinds[at] == "else" else _behind_condition(kinds, at + 1)
            if kinds[behind : behind + 1] not in (["{"], ["if"], []):
                return behind
    return -1


def _opener_of(kinds: Sequence[str], end: int) -> int:
    """The innermost `{` that is open before the lexeme `end`."""
    depth, at = 0, end - 1
    while at > 0 and (kinds[at] not in _OPENS or depth > 0):
        depth += {"}": 1, "{": -1, "SET": -1}.get(kinds[at], 0)
        at -= 1
    return at


def _statement_before(kinds: Sequence[str], end: int) -> int:
    """Where the statement begins whose `;` is the lexeme `end`."""
    at = end - 1
    while at > 0 and kinds[at] not in (";", "{"):
        if kinds[at] == "}":
            opener = _opener_of(kinds, at)
            if kinds[opener] == "{":
                break
            at = opener
        at -= 1
    return at + 1


def _condition_before(kinds: Sequence[str], end: int) -> int:
    """The `(` of the parentheses that close right before the lexeme `end`; 0 where none do."""
    depth = 0
    for at in range(end - 1, 0, -1):
        depth += {")": 1, "(": -1}.get(kinds[at], 0)
        if depth == 0:
            return at if kinds[at] == "(" else 0
    return 0


def _behind_condition(kinds: Sequence[str], begin: int) -> int:
    """The first lexeme behind the parentheses that the lexeme `begin` opens."""
    depth = 0
    for at in range(begin, len(kinds)):
        depth += {"(": 1, ")": -1}.get(kinds[at], 0)
        if depth == 0:
            return at + 1
    return len(kinds)


def is_surplus(piece: Piece, text: str, finish: int, indent: int, *, is_alone: bool) -> bool:
    """Whether the `}` that ends at `finish` and closes the piece, last in its line, was written once too often.

    It was if a member of the class follows, or a `}` below the place where the piece began, `indent` blanks deep; of a
    rule also if lines follow that are indented like its own, and then such a `}`. If it `is_alone` in its line, only
    this counts: else the next one is too many.
    """
    following = _NEXT_LINE.match(text, finish)
    assert following is not None
    end = following.end()
    # A comment in the last line of all may come to end there.
    piece.reach = max(piece.reach, len(text) + 1 if text.startswith("/", end) else end + _LONGEST)
    if "\n" not in text[piece.starts[0] : finish] or "\n" not in following[0]:
        return False
    if is_alone or following[2] is None:
        return piece.kinds[0] == "IDENT" and _goes_on(piece, text, finish, indent)
    depth = len(following[1])
    return depth == indent if following[2] == "}" else depth > indent and piece.kinds[0] == "class"


def _goes_on(piece: Piece, text: str, finish: int, indent: int) -> bool:
    """Whether indented lines follow that another `}` ends, `indent` blanks deep."""
    for line in _LINE.finditer(text, finish):
        piece.reach = max(piece.reach, line.end() + 1)
        if len(line[1]) > indent:
            continue
        between = text[finish : line.start()]
        is_end = line[2] == "}" and len(line[1]) == indent and between.strip() != ""
        return is_end and between.count("{") == between.count("}")
    piece.reach = max(piece.reach, len(text) + 1)
    return False


def end_of_strays(text: str, finish: int) -> tuple[int, int]:
    """Where a run of `}` ends that begins before `finish` and closes nothing, and how far was looked."""
    following = _STRAYS.match(text, finish)
    assert following is not None
    return following.end(1), following.end()


def leave_out(piece: Piece, brackets: Brackets, start: int, base: int) -> None:
    """Go on as if the `}` at `start`, which closed the piece, were not there."""
    brackets.open.append("{")
    at = start - base
    fix = Fix("remove the `}`", (Edit(piece.span(at, at + 1), ""),), safe=False)
    piece.report(STRAY_BRACE, at, at + 1, text="}", fixes=(fix,))


def watch_opening(piece: Piece, base: int, doubled: int) -> int:
    """Where the `{` that comes next is the second of two, its place, else `doubled`.

    A `;` between the head of an `if`, `else` or `foreach` and its block is left out.
    """
    kinds = piece.kinds
    if kinds[-1:] == ["{"]:
        return len(kinds)
    if kinds[-1:] == [";"] and len(kinds) > 1:
        at = len(kinds) - 1
        head = "else" if kinds[at - 1] == "else" else kinds[_condition_before(kinds, at) - 1]
        if head in _BRANCHES:
            piece.mends.append((at, ""))
            place = piece.starts[at] - base
            fix = Fix("remove `;`", (Edit(piece.span(place, place + 1), ""),))
            help_ = f"the block belongs to the `{head}`"
            piece.report(SUPERFLUOUS, place, place + 1, text=";", help=help_, fixes=(fix,))
    return doubled


def leave_out_doubled(piece: Piece, doubled: int, base: int) -> None:
    """Leave out the second of two `{` when one of them is never closed."""
    piece.mends.append((doubled, ""))
    at = piece.starts[doubled] - base
    fix = Fix("remove `{`", (Edit(piece.span(at, at + 1), ""),))
    piece.report(SUPERFLUOUS, at, at + 1, text="{", fixes=(fix,))


def lacks_brace(piece: Piece, text: str, finish: int, indent: int) -> bool:
    """Whether a rule without braces, whose only statement ends at `finish`, has more of them and a `}` after those."""
    for line in _LINE.finditer(text, finish):
        piece.reach = max(piece.reach, line.end() + 1)
        if line[2].startswith("//") or len(line[1]) > indent:
            continue
        between = text[finish : line.start()]
        return line[2] == "}" and len(line[1]) == indent and between.count("{") == between.count("}")
    piece.reach = max(piece.reach, len(text) + 1)
    return False


def first_outside(piece: Piece, indent_of: Callable[[int], int]) -> int:
    """The first lexeme that stands outside of a rule or class which is never closed; -1 if none does for certain.

    It begins a line and a statement, no deeper than the piece, where the first line of the block stands deeper.
    """
    kinds, starts = piece.kinds, piece.starts
    if (
        piece.is_cut_short
        or piece.is_too_deep
        or "{" not in kinds
        or not (kinds[1:3] == ["::", "IDENT"] or kinds[0] == "class")
    ):
        return -1
    indent, body = indent_of(starts[0]), kinds.index("{") + 1
    if indent < 0 or body >= len(kinds) or indent_of(starts[body]) <= indent:
        return -1
    for at in range(body, len(kinds)):
        if kinds[at] in _STATEMENT_BEGINS and 0 <= indent_of(starts[at]) <= indent:
            is_mended = any(index >= at for index, _ in piece.mends)
            return -1 if is_mended or len(kinds) - at > _MOST_GIVEN_BACK else at
    return -1


def give_back(piece: Piece, at: int, base: int) -> int:
    """Leave the lexemes from `at` on to the next piece; where this one ends."""
    for column in (piece.kinds, piece.texts, piece.starts, piece.ends):
        del column[at:]
    end = piece.ends[-1]
    piece.diagnostics = [each for each in piece.diagnostics if each.span.start < end - base]
    piece.docs = {start: doc for start, doc in piece.docs.items() if start < end - base}
    return end
