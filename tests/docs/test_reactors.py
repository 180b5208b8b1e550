"""The page on the agent names all that a reactor in Python may use."""

import inspect
import re
from pathlib import Path

from runtime.user.reactor import Command, Now, Seen

PAGE = Path(__file__).resolve().parents[2] / "docs/agent.md"
INNER = {
    "published",
    "asked",
    "recalled",
    "wakes",
    "declined",
    "turns",
    "first_number",
}  # what the agent reads and sets


def test_every_member_of_now_is_told_with_its_arguments() -> None:
    rows = dict(re.findall(r"^\| `now\.(\w+)([^`]*)` \|", PAGE.read_text(), re.MULTILINE))
    now = Now(0, {}, frozenset(), frozenset())
    assert set(rows) == {name for name in dir(now) if not name.startswith("_")} - INNER
    for name, told in rows.items():
        if callable(member := getattr(now, name)):
            names = [
                ("**" if one.kind is one.VAR_KEYWORD else "") + one.name + ("" if one.default is one.empty else "=")
                for one in inspect.signature(member).parameters.values()
            ]
            found = [re.sub(r"=.*", "=", one) for one in told.strip("()").split(", ")]
            assert found == names


def test_the_fields_of_what_it_sees_and_is_asked_for_are_told() -> None:
    text = PAGE.read_text()
    for fields, member in ((Seen._fields, "seen"), (Command._fields, "commands")):
        row = next(line for line in text.splitlines() if line.startswith(f"| `now.{member}`"))
        assert set(fields) <= set(re.findall(r"`(\w+)`", row))
