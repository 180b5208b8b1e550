"""The slips of `slips_at_the_telescope.txt`: what stands there, what was typed, and what must be told of it."""

from pathlib import Path

from tests.cli.slip import Slip


def _read(block: str) -> Slip:
    """`-` stands before the right text, `+` before the wrong one, `@` before the line told of, `?` before its help."""
    file, *lines = block.strip("\n").split("\n")
    parts = {sign: [line[2:].replace("\\n", "\n") for line in lines if line[0] == sign] for sign in "-+@?"}
    (right,), (wrong,) = parts["-"], parts["+"]
    told = parts["@"] or [wrong.strip().split("\n")[0].strip()]
    return Slip(" ".join(wrong.split()), file, right, wrong, tuple(told), tuple(parts["?"]))


_TEXT = Path(__file__).with_suffix(".txt").read_text(encoding="utf-8")
AT_THE_TELESCOPE = tuple(map(_read, _TEXT.split("\n\n")[1:]))
