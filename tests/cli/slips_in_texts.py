"""The slips of the texts beside this file: what stands there, what was typed, and what must be told of it."""

from pathlib import Path

from tests.cli.slip import Slip


def _read(block: str) -> Slip:
    """`-` stands before the right text, `+` before the wrong one, `@` before the line told of, `?` before its help."""
    file, *lines = block.strip("\n").split("\n")
    parts = {sign: [line[2:].replace("\\n", "\n") for line in lines if line[0] == sign] for sign in "-+@?"}
    (right,), (wrong,) = parts["-"], parts["+"]
    told = parts["@"] or [wrong.strip().split("\n")[0].strip()]
    return Slip(" ".join(wrong.split()), file, right, wrong, tuple(told), tuple(parts["?"]))


def _read_all(name: str) -> tuple[Slip, ...]:
    text = Path(__file__).with_name(name).read_text(encoding="utf-8")
    return tuple(map(_read, text.split("\n\n")[1:]))


AT_THE_TELESCOPE = _read_all("slips_at_the_telescope.txt")
AT_THE_BAKERY = _read_all("slips_at_the_bakery.txt")
AT_THE_BREWERY = _read_all("slips_at_the_brewery.txt")
