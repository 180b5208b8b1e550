"""Where somebody types in a statement: its words up to the cursor in; what kind of thing may stand there out."""

from enum import Enum

from nddl_lang.syntax.piece import Piece


class Situation(Enum):
    """What may stand at a place."""

    TOP = "a statement of the script"
    MEMBER = "a member of a class"
    PARAMETER = "a statement of a predicate"
    RULE = "a statement of a rule"
    BUILDING = "a statement of a constructor"
    INSTANCE = "a token that is asked for"
    CLASS = "a class"
    NEW = "a class of which an object is made"
    VALUE = "a value"
    RELATION = "what follows the name of a token"
    TOKEN = "the token that a relation leads to"
    NOTHING = "a name that is being given"
    ANYTHING = "whatever there is"


_ENDS = frozenset({";", "{", "}"})
_OPERATORS = frozenset({"=", "==", "!=", "<", "<=", ">", ">=", "+", "-", "*", "/", "&&", "||", "!", "[", "in"})
_OF_BLOCK = {"class": Situation.MEMBER, "predicate": Situation.PARAMETER, "action": Situation.PARAMETER}


def situation_at(piece: Piece | None, offset: int) -> Situation:
    """What may stand at `offset`, where a word is begun or was."""
    if piece is None:
        return Situation.TOP
    at = offset - piece.anchor.offset
    count = sum(1 for end in piece.ends if end < at)  # what ends at the cursor is being typed
    if count < len(piece.ends) and piece.ends[count] == at and not _is_word(piece.texts[count]):
        count += 1
    blocks: list[Situation] = [Situation.TOP]
    brackets: list[Situation] = []
    begin = 0
    for index in range(count):
        text = piece.texts[index]
        if text == "{":
            blocks.append(_block(piece.texts[begin:index], blocks[-1]))
        elif text == "}":
            blocks = blocks[:-1] or [Situation.TOP]
        elif text == "(":
            brackets.append(_bracket(piece, begin, index))
        elif text == ")" and brackets:
            brackets.pop()
        if text in _ENDS:
            begin, brackets = index + 1, []
    return _situation(piece, begin, count, blocks[-1], brackets)


def _is_word(text: str) -> bool:
    return text[-1:].isalnum() or text[-1:] in ("_", "$")


def _situation(piece: Piece, begin: int, count: int, block: Situation, brackets: list[Situation]) -> Situation:
    if block is Situation.NOTHING:
        return block
    if begin == count:
        return block
    last, kind = piece.texts[count - 1], piece.kinds[count - 1]
    if last == "new":
        return Situation.NEW
    if last == "extends":
        return Situation.CLASS
    if kind == "RELATION" or (last == "]" and "RELATION" in piece.kinds[begin:count]):
        return Situation.TOKEN
    if last in _OPERATORS:
        return Situation.VALUE
    if brackets and last in ("(", ","):
        return brackets[-1]
    if brackets and brackets[-1] is Situation.INSTANCE and kind == "IDENT":
        return Situation.NOTHING
    if last == ")":
        return block  # of `if (...)` and `foreach (...)`
    if last == "else":
        return Situation.RULE
    if last in ("class", "enum", "predicate", "action", "typedef", "#include") or kind == "BASETYPE":
        return Situation.NOTHING if last != "typedef" else Situation.CLASS
    if kind == "IDENT" and count - begin == 1:
        return Situation.RELATION if block in (Situation.RULE, Situation.TOP) else Situation.NOTHING
    return Situation.ANYTHING


def _block(header: list[str], outer: Situation) -> Situation:
    """What stands inside the braces after these words."""
    for word in header:
        if word in _OF_BLOCK:
            return _OF_BLOCK[word]
    if "enum" in header:
        return Situation.NOTHING
    if "::" in header or outer is Situation.RULE:
        return Situation.RULE
    return Situation.BUILDING if outer is Situation.MEMBER else Situation.ANYTHING


def _bracket(piece: Piece, begin: int, index: int) -> Situation:
    """What stands inside the parenthesis at `index`."""
    words = piece.kinds[begin:index]
    if "RELATION" in words or "GOAL" in words:
        return Situation.INSTANCE
    return Situation.VALUE
