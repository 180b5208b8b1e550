"""Small faults in the text of a model: one of a kind, at one place, both drawn by chance."""

import random
import re
from collections.abc import Callable, Iterator

COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/|#include[^\n]*|\"[^\"\n]*\"", re.DOTALL)
NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d+)?(?![\w.])")
CONSTANT = re.compile(r"\b[A-Z][A-Z0-9_]{2,}\b")
COMPARISON = re.compile(r"<=|>=|==")
RELATIONS = ("contains", "meets", "met_by", "equals", "starts", "ends", "before", "contained_by", "any")
RELATION = re.compile(r"\b(?:" + "|".join(RELATIONS) + r")\b(?=\s*\()")
SIGN = re.compile(r"(?<=[\w)] )[+-](?= [\w(])|(?<![\w.])-(?=\d)")
PAIR = re.compile(r"\((\s*[\w.]+\s*),(\s*[\w.]+\s*)([,)])")
STATEMENT = re.compile(r"(?<=[;{}])\s*(?:[a-z][\w.]*\s*(?:<=|>=|==|!=)|[a-zA-Z_]\w*\()[^;{}]*;")
BRANCH = re.compile(r"\belse\s*\{[^{}]*\}|(?<=\))\s*\{[^{}]*\}")

Change = tuple[int, int, str]  # of the text from one place to another, into that


def changes(text: str, chance: random.Random) -> dict[str, list[Change]]:
    """What could be changed, by the kind of the fault; each place with one change that is drawn."""
    bare = COMMENT.sub(lambda found: " " * len(found.group()), text)
    names = sorted(set(CONSTANT.findall(bare)))

    def spots(pattern: re.Pattern[str], other: Callable[[re.Match[str]], str]) -> Iterator[Change]:
        for found in pattern.finditer(bare):
            new = other(found)
            if new != found.group():
                yield found.start(), found.end(), new

    def constant(found: re.Match[str]) -> str:
        if "." in found.group():
            return repr(float(found.group()) * chance.choice((0.5, 0.9, 1.1, 2.0, 10.0)))
        return str(max(0, int(found.group()) + chance.choice((-20, -5, -3, 2, 5, 30))))

    kinds = {
        "constant": spots(NUMBER, constant),
        "off by one": spots(
            NUMBER, lambda m: m.group() if "." in m.group() else str(max(0, int(m.group()) + chance.choice((-1, 1))))
        ),
        "limit": spots(CONSTANT, lambda m: chance.choice(names)),
        "relation": spots(RELATION, lambda m: chance.choice(RELATIONS)),
        "comparison": spots(COMPARISON, lambda m: chance.choice(("<=", ">=", "=="))),
        "sign": spots(SIGN, lambda m: "-" if m.group() == "+" else "+" if bare[m.end()] == " " else " "),
        "swapped arguments": spots(PAIR, lambda m: f"({m[2].strip()}, {m[1].strip()}{m[3]}"),
        "dropped constraint": spots(STATEMENT, lambda m: " "),
        "dropped branch": spots(BRANCH, lambda m: "" if m.group().lstrip().startswith("else") else " { }"),
    }
    return {kind: found for kind, each in kinds.items() if (found := list(each))}


def mutated(text: str, chance: random.Random) -> tuple[str, str]:
    """The text with one fault, and the kind of the fault; unchanged, of no kind, where there is nothing to change."""
    kinds = changes(text, chance)
    if not kinds:
        return text, ""
    kind = chance.choice(list(kinds))
    begin, end, new = chance.choice(kinds[kind])
    return text[:begin] + new + text[end:], kind
