"""The call of a modeler's code that is under way; a call costs a few assignments."""

from typing import Protocol

from runtime.constraints.domains.store import Store
from runtime.user.black_box import CallRecorder, UserCode


class Caller(UserCode, Protocol):
    """Who calls a modeler's code."""

    def told(self, s: Store | None, c: int) -> str:
        """What is called, by constraint `c` of an engine, in words."""


Call = tuple[Caller, Store | None, int]  # who calls, and from which constraint of which engine


class CallSlot:
    """What is called; None between calls."""

    def __init__(self) -> None:
        self.call: Call | None = None
        self.box: CallRecorder | None = None

    def begin(self, call: Call) -> Call | None:
        """A call begins; the one that was under way before, for `end`."""
        before = self.call
        self.call = call
        if self.box is not None:
            self.box.begin(call[0])
        return before

    def end(self, call: Call, before: Call | None) -> None:
        """It ends, in whichever way."""
        if self.call is not call:
            self.astray(call)
        self.call = before
        if self.box is not None:
            self.box.end()

    def astray(self, call: Call) -> None:
        """A call came back that is not the one under way."""
