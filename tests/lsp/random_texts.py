"""Random texts: words of the language in any order, and pieces of models with such words put in.

    python -m tests.lsp.random_texts [COUNT]    COUNT texts (100,000)

Each is opened as an editor opens it: the answer must come, and within ten seconds of processor time. Exits with 1 if
one does not.
"""

import random
import signal
import sys
from types import FrameType

from lsp.documents import Documents
from tests.constraints.proof import judged
from tests.syntax.corpus import texts

_SECONDS = 10.0
_LENGTH = 300  # of a piece of a model, in characters
_TEXT = """
    p u l a x :: { } { } ( ) ; , = == != < <= =< > >= . .. + - * / % && || -> [ ] [1 5] 3 -3 0x1 1e9 1..5 true "x"
    #include // /* */ not if else foreach in new any goal rejectable class extends predicate enum typedef action
    constraint int float this object super( eq( close(); contains meets start end duration
"""
_WORDS = [*_TEXT.split(), "\n", "\n ", "\n}\n", "//c\n"]


def text_of(seed: int) -> str:
    """The text of a seed."""
    draw = random.Random(seed)
    if draw.random() < 0.5:
        words = (draw.choice(_WORDS) + draw.choice([" ", "", "\n", " "]) for _ in range(draw.randint(3, 30)))
        return "".join(words)
    text = draw.choice(texts())
    begin = draw.randrange(max(1, len(text) - _LENGTH))
    text = text[begin : begin + _LENGTH]
    for _ in range(draw.randint(1, 6)):
        at = draw.randrange(len(text) + 1)
        last = min(len(text), at + draw.choice([0, 0, 1, 3, 10]))
        text = text[:at] + draw.choice(_WORDS) + draw.choice(["", " ", "\n"]) + text[last:]
    return text


def opened(seed: int) -> None:
    """Open the text of a seed; raises whatever opening it raises, and TimeoutError."""
    text = text_of(seed)

    def too_long(_number: int, _frame: FrameType | None) -> None:
        raise TimeoutError(f"{text!r} is not analysed in {_SECONDS:g} s")

    before = signal.signal(signal.SIGVTALRM, too_long)
    signal.setitimer(signal.ITIMER_VIRTUAL, _SECONDS)
    try:
        Documents().open("untitled:text", 1, text)
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


if __name__ == "__main__":
    sys.exit(judged("random texts", int(sys.argv[1]) if len(sys.argv) > 1 else 100_000, opened) > 0)
