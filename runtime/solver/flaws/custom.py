"""Let others add a kind of flaw to the search: what is to be mended, how urgent that is, and the choices in order."""

from runtime.solver.tags import NO_CHOICE, NONE


class CustomManager:
    """A flaw manager of somebody else's; it stands before all others of equal priority.

    A flaw is any number that its manager understands. Choices are carried out inside a mark, by calls of the database
    that are undone by going back; the search does so after a failure, and asks for the next choice.
    """

    def priority(self) -> float:
        """How urgent the next flaw is: smaller first, 0 before everything else. Asked after `select`."""
        return 0.0

    def select(self) -> int:
        """The next flaw; NONE if there is none now."""
        return NONE

    def attempt(self, flaw: int, number: int) -> int:
        """Carry out choice `number` (from 0) for a flaw: APPLIED, FAILED_CHOICE, or NO_CHOICE if there are no more."""
        return NO_CHOICE

    def has_choice(self, flaw: int, number: int) -> bool:
        """Whether there is a choice `number`; asked only when a limit forbids to carry it out."""
        return False
