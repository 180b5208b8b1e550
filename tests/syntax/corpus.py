"""Texts to mutate: all that the repository holds."""

import random
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

SNIPPETS = [
    *";{}()[]\"'.,=:#/*-+!<>&|@ \n\t",
    "\r\n",
    "\v",
    "\ufeff",
    "\ufffd",
    "ä",
    "//",
    "///",
    "/*",
    "*/",
    "::",
    "==",
    "-1",
    "+inf",
    "1.5",
    '"a\nb"',
    '#include "a.nddl"',
    "class A {",
    "\nclass B;",
    "\nT::p {",
    "predicate p { }",
    " if (x) ",
    " else ",
    "foreach (a in b)",
    "goal(",
    "new A()",
    "meets(",
    "before [1 5]",
    "int x = 3;",
    "private ",
    "switch (x) {",
    "constraint f(int a) ",
    "enum E { a, b }",
    "typedef int [0 1] I;",
    "super(",
    "close();",
]


@cache
def texts() -> tuple[str, ...]:
    """The models, the library, the conformance cases and the fixtures."""
    folders = ("models", "nddl_lang/library", "tests/conformance/cases", "tests/syntax/fixtures")
    paths = sorted(path for folder in folders for path in (ROOT / folder).rglob("*.nddl"))
    return tuple(path.read_bytes().decode("utf-8", errors="replace") for path in paths)


def mutated(chance: random.Random) -> str:
    """One of the texts after a few small changes."""
    text: str = chance.choice(texts())
    for _ in range(chance.randrange(1, 4)):
        text = edited(text, chance)
    return text


def edited(text: str, chance: random.Random) -> str:
    """`text` after one small change."""
    at = chance.randrange(len(text) + 1)
    until = min(len(text), at + chance.choice((0, 0, 1, 1, 2, 10, 80)))
    if chance.random() < 0.15:
        other: str = chance.choice(texts())
        start = chance.randrange(len(other) + 1)
        return text[:at] + other[start : start + chance.randrange(60)] + text[until:]
    snippet: str = chance.choice((*SNIPPETS, "", ""))
    return text[:at] + snippet + text[until:]
