"""See, while a piece is cut from the text, a `;` that was meant as `,`, a `:` meant as `{` and a `)` meant as `}`.

Taken as they stand, the piece would end too early, or a block would never begin or end. All offsets are absolute.
"""

import re

from nddl_lang.syntax.braces import lacks_brace
from nddl_lang.syntax.brackets import Brackets
from nddl_lang.syntax.codes import EXPECTED
from nddl_lang.syntax.piece import Piece
from nddl_lang.text.diagnostic import Edit, Fix

_UPPER_BOUND = re.compile(r"[ \t]{0,40}([-+]?[\d.]{1,40}|inff?)[ \t]{0,40}\]")
_LOOPS = ("for", "while")
_REST = re.compile(r'[^\n;(){}="]*(?:;[^\n;(){}="]*)*+(\))?')
_REST_OF_LOOP = re.compile(r"[^\n{}]*(\))?")
_REST_OF_LINE = re.compile(r"[ \t]*(?://[^\n]*)?(?:\n|\Z)\s*+([{\"])?")
_BEHIND = re.compile(r"([ \t]*(?://[^\n]*)?(?:\n|\Z))?([ \t\n]*)(\})?")
# A sign that may be meant as another one where one of these brackets is the innermost.
INSTEAD = {";": ("(", "["), ")": ("{",), "]": ("{",)}
_MOST_LEXEMES, _FARTHEST = 200, 1000  # of one call, so that a long line stays quick to read
_HEADS = ("if", "foreach", "while", "for")


def meant_sign(kind: str, piece: Piece, brackets: Brackets, text: str, base: int, start: int) -> tuple[str, bool]:
    """The sign that was meant by the one at `start`, and whether that is all there is to it."""
    if kind == ";" and brackets.innermost == "[":
        return (",", True) if _parts_bounds(piece, text, base, start) else (kind, False)
    if kind == ";":
        return (",", True) if _separates(piece, text, base, start) else (kind, False)
    if kind == ":":
        return "{" if _opens_block(piece, brackets, text, base, start) else kind, True
    return "}" if _closes_block(piece, kind, text, base, start) else kind, False


def _separates(piece: Piece, text: str, base: int, start: int) -> bool:
    """Whether the `;` at `start`, in parentheses, stands between arguments, `f(a; b);`, or in the head of a loop."""
    head = _before_parenthesis(piece.kinds)
    if head is None or piece.kinds[head] not in ("IDENT", "foreach", "super"):
        return False
    is_loop = piece.texts[head] in _LOOPS
    rest = (_REST_OF_LOOP if is_loop else _REST).match(text, start + 1, start + 1 + _FARTHEST)
    assert rest is not None
    piece.reach = max(piece.reach, rest.end() + 1)
    if is_loop:
        return text.rfind(")", start, rest.end()) >= 0
    if rest[1] is None:
        return False
    if ";" in piece.texts[head:]:
        return True  # told with the first of them
    at = start - base
    signs = [place - base for place in range(start, rest.end()) if text[place] == ";"]
    fix = Fix("write `,`", tuple(Edit(piece.span(place, place + 1), ",") for place in signs))
    help_ = "arguments are separated by commas: write `,`"
    piece.report(EXPECTED, at, at + 1, expected="`,`", found="`;`", help=help_, fixes=(fix,))
    return True


def _parts_bounds(piece: Piece, text: str, base: int, start: int) -> bool:
    """Whether the `;` at `start` stands between the bounds of an interval."""
    upper = _UPPER_BOUND.match(text, start + 1)
    piece.reach = max(piece.reach, (start if upper is None else upper.end()) + 2)
    if upper is None or piece.kinds[-1] not in ("INT", "FLOAT"):
        return False
    at = start - base
    written = f"[{piece.texts[-1]} {upper[1]}]"
    fix = Fix("remove `;`", (Edit(piece.span(at, at + 1), ""),), safe=False)
    help_ = f"an interval is written `{written}`"
    piece.report(EXPECTED, at, at + 1, expected="a number", found="`;`", help=help_, fixes=(fix,))
    return True


def _opens_block(piece: Piece, brackets: Brackets, text: str, base: int, start: int) -> bool:
    """Whether the `:` at `start` ends the head of a block as in Python; then it counts as a `{`.

    Nothing may follow it in its line, and a `}` must end the lines after it.
    """
    kinds = piece.kinds
    head = _before_parenthesis(kinds[:-1]) if kinds[-1:] == [")"] else None
    is_condition = head is not None and kinds[head] in _HEADS
    is_class = kinds[:1] == ["class"] and len(brackets.open) == 0
    if not is_condition and not is_class and kinds[-1:] != ["else"] and kinds[1:] != ["::", "IDENT"]:
        return False
    following = _REST_OF_LINE.match(text, start + 1)
    line = text.rfind("\n", 0, start) + 1
    if following is None or following[1] is not None:
        return False
    piece.reach = max(piece.reach, following.end() + 1)
    before = text[line:start]
    if not lacks_brace(piece, text, start + 1, len(before) - len(before.lstrip(" \t"))):
        return False
    brackets.open.append("{")
    if not (is_class and ")" in kinds):  # what stands in parentheses is told first
        at = start - base
        fix = Fix("write `{`", (Edit(piece.span(at, at + 1), " {"),))
        help_ = "a block stands in braces"
        piece.report(EXPECTED, at, at + 1, expected="`{`", found="`:`", help=help_, fixes=(fix,))
    return True


def _closes_block(piece: Piece, kind: str, text: str, base: int, start: int) -> bool:
    """Whether the `)` or `]` at `start`, with no partner in its block, stands for the `}` of that block.

    It ends the one line of the block, or stands alone in its line, as deep as that in which the block begins, and
    behind a whole statement; no `}` follows there.
    """
    kinds = piece.kinds
    before = text[text.rfind("\n", 0, start) + 1 : start]
    if kinds[-1:] not in ([";"], ["}"], ["{"]):
        return False
    following = _BEHIND.match(text, start + 1)
    assert following is not None
    piece.reach = max(piece.reach, following.end() + len("//"))
    opener = _open_brace(kinds)
    line = text.rfind("\n", 0, piece.starts[opener]) + 1
    head = text[line : piece.starts[opener]]
    is_closed_again = following[3] is not None and following[2].rpartition("\n")[2] == before
    is_one_line = "\n" not in text[piece.starts[opener] : start]
    is_aligned = before == head[: len(head) - len(head.lstrip(" \t"))] and not is_closed_again
    if following[1] is None or line < base or not (is_one_line or is_aligned):
        return False
    at = start - base
    fix = Fix("write `}`", (Edit(piece.span(at, at + 1), "}"),))
    piece.report(EXPECTED, at, at + 1, expected="`}`", found=f"`{kind}`", help="a block ends with `}`", fixes=(fix,))
    return True


def _open_brace(kinds: list[str]) -> int:
    """The innermost `{` that is open at the end of `kinds`."""
    depth = 0
    for at in range(len(kinds) - 1, 0, -1):
        depth += {"}": 1, "{": -1, "SET": -1}.get(kinds[at], 0)
        if depth < 0:
            return at
    return 0


def _before_parenthesis(kinds: list[str]) -> int | None:
    """The lexeme before the parenthesis that is still open at the end of `kinds`, if it is near."""
    depth = 0
    for at in range(len(kinds) - 1, max(0, len(kinds) - _MOST_LEXEMES), -1):
        depth += {")": 1, "(": -1}.get(kinds[at], 0)
        if depth < 0:
            return at - 1
    return None
