"""Change models as a tired modeler would: names, numbers, operators and statements change places."""

import random
import re

LEXEME = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:[^"\\]|\\.)*"|[A-Za-z_]\w*|\d+(?:\.\d+)?|\s+|::|[<>=!]=|.', re.DOTALL)
NAME = re.compile(r"[A-Za-z_]\w*")
NUMBER = re.compile(r"\d+(?:\.\d+)?")
SIGNS = ("==", "!=", "<", "<=", ">", ">=", "+", "-", "*", "in", ":")
NUMBERS = ("0", "1", "2", "7", "-1", "0.5", "1e3", "100000", "2147483647", "inf", "-inf", "+inf", "true")
RELATIONS = ("meets", "met_by", "before", "after", "contains", "during", "equals", "starts", "ends", "any", "parallels")


def mutant(text: str, chance: random.Random) -> str:
    """`text` after one to three changes that mostly leave it well-formed."""
    for _ in range(chance.randrange(1, 4)):
        text = _with_moved_lines(text, chance) if chance.random() < 0.3 else _with_another_lexeme(text, chance)
    return text


def _with_another_lexeme(text: str, chance: random.Random) -> str:
    lexemes = LEXEME.findall(text)
    places = [place for place, lexeme in enumerate(lexemes) if not lexeme.isspace() and lexeme[:2] not in ("//", "/*")]
    if not places:
        return text
    place = chance.choice(places)
    old = lexemes[place]
    if old in RELATIONS:
        lexemes[place] = chance.choice(RELATIONS)
    elif NUMBER.fullmatch(old):
        lexemes[place] = chance.choice(NUMBERS)
    elif NAME.fullmatch(old):
        lexemes[place] = chance.choice([lexeme for lexeme in lexemes if NAME.fullmatch(lexeme)])
    elif old in SIGNS:
        lexemes[place] = chance.choice(SIGNS)
    return "".join(lexemes)


def _with_moved_lines(text: str, chance: random.Random) -> str:
    lines = text.splitlines(keepends=True)
    if len(lines) < 2:
        return text
    taken, put = chance.randrange(len(lines)), chance.randrange(len(lines))
    line = lines[taken]
    if chance.random() < 0.6:
        del lines[taken]
    if chance.random() < 0.6:
        lines.insert(put, line)
    return "".join(lines)
