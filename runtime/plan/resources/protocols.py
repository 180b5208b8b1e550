"""What the check of resources asks of others: the order of uses, and what may still relieve a level."""

from typing import Protocol


class UseOrder(Protocol):
    """The order of uses: what `envelope` knows beyond bounds of times."""

    is_low: int
    at: int

    def find_certain(self, o: int) -> bool:
        """Whether the order of uses makes certain what their times alone leave open."""

    def note_orders(self, edges: list[int], read: list[int]) -> None:
        """Add the edges and bounds by which it is certain."""


class OpenRelief(Protocol):
    """What is open in a plan and may yet change levels."""

    def may_come(self, o: int, sign: int) -> bool:
        """Whether something may yet give to resource `o` (1), or take from it (-1)."""
