"""What was typed in place of what, and what is to be told of it."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Slip:
    """In `file`, `right` is typed as `wrong`; a line with one of `told` is marked, the message has one of `helps`."""

    kind: str
    file: str
    right: str
    wrong: str
    told: tuple[str, ...]
    helps: tuple[str, ...]
