"""Say between which lexemes of a line a blank stands."""

# What separates lexemes; Python's own idea of white space is wider.
BLANKS = " \t\r\n\f"

_NO_BLANK_BEFORE = frozenset((")", "]", ",", ";", ".", "::"))
_NO_BLANK_AFTER = frozenset(("(", "[", "SET", ".", "::", "!"))
_OPERAND_ENDS = frozenset(("IDENT", "INT", "FLOAT", "STRING", "BOOL", "this", ")", "]"))
# A `(` after one of these opens arguments and stands close; after anything else it opens a group.
_TAKES_ARGUMENTS = frozenset(("IDENT", "RELATION", "GOAL", "super", "close"))


def has_blank(kinds: list[str], index: int, bracket: str | None) -> bool:
    """Whether a blank stands before the lexeme `index`; `bracket` is the innermost one that is open before it."""
    before, kind = kinds[index - 1], kinds[index]
    if _is_sign(kinds, index - 1, bracket):
        # `- 1` is an operator and a number, `-1` is one lexeme.
        return kind in ("INT", "FLOAT")
    if kind in _NO_BLANK_BEFORE or before in _NO_BLANK_AFTER:
        return False
    if kind == "(":
        return before not in _TAKES_ARGUMENTS
    return not (kind == "}" and bracket == "SET")


def _is_sign(kinds: list[str], index: int, bracket: str | None) -> bool:
    """Whether the lexeme `index` is a minus with one operand, which stands close to it."""
    if kinds[index] != "-":
        return False
    return bracket == "[" or index == 0 or kinds[index - 1] not in _OPERAND_ENDS
