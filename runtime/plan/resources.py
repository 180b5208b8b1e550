"""Keep the levels of resources: who uses them when, and where they are certainly or possibly out of bounds."""


class Resources:
    """All resources of a plan."""

    def enter(self, t: int) -> None:
        """Take the active token `t` into account."""

    def leave(self, t: int) -> None:
        """Forget token `t`."""

    def charge(self, resource: int, quantity: int, start: int, end: int, span: int) -> int:
        """Charge a resource by a constraint; the number of the use."""
        return 0

    def discharge(self, u: int) -> None:
        """Forget a use."""

    def is_quiet(self) -> bool:
        """Whether nothing changed that levels depend on."""
        return True

    def check(self) -> bool:
        """Compute the levels anew; False if one is certainly out of bounds."""
        return True

    def undo(self) -> None:
        """Take note that the plan has gone back in time."""

    def set_capacity(self, o: int, bounds: list[float]) -> None:
        """Change the capacity of a resource from a time on."""
