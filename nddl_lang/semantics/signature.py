"""Describe what a constraint, function or method takes: arguments, their kinds, how many."""

from dataclasses import dataclass
from enum import Enum


class ArgumentKind(Enum):
    """What may stand in one place of a call; the value is how users read it."""

    NUMBER = "a number"
    BOOL = "a bool"
    TIME = "a time"
    STRING = "a string"
    OBJECT = "an object"
    TOKEN = "a token"
    RESOURCE = "an object of class `CBReusable`"
    PARAMETER = "a global number or an enum value"
    ANY = "anything"
    SAME = "anything comparable with the others"


@dataclass(frozen=True, slots=True)
class Argument:
    """One place of a call."""

    name: str
    kind: ArgumentKind


@dataclass(frozen=True, slots=True)
class Signature:
    """`required` arguments, then `optional` ones, then any number of `rest`."""

    required: tuple[Argument, ...]
    optional: tuple[Argument, ...] = ()
    rest: Argument | None = None

    @property
    def minimum(self) -> int:
        """The least number of arguments."""
        return len(self.required)

    @property
    def maximum(self) -> int | None:
        """The greatest number of arguments; None without limit."""
        return None if self.rest is not None else len(self.required) + len(self.optional)

    def argument(self, index: int) -> Argument | None:
        """The place of argument number `index`, None past the last."""
        if index < len(self.required):
            return self.required[index]
        index -= len(self.required)
        if index < len(self.optional):
            return self.optional[index]
        return self.rest

    def accepts(self, count: int) -> bool:
        """Whether `count` arguments fit."""
        return count >= self.minimum and (self.maximum is None or count <= self.maximum)

    @property
    def count_text(self) -> str:
        """The number of arguments in words, as in `2 arguments` or `at least 1 argument`."""
        if self.maximum is None:
            return f"at least {_counted(self.minimum)}"
        if self.maximum == self.minimum:
            return _counted(self.minimum) if self.minimum else "no arguments"
        return f"{self.minimum} to {_counted(self.maximum)}"

    @property
    def text(self) -> str:
        """The arguments as a user would write them."""
        names = [argument.name for argument in self.required]
        names += [f"[{argument.name}]" for argument in self.optional]
        if self.rest is not None:
            names.append(f"{self.rest.name}...")
        return ", ".join(names)


def _counted(number: int) -> str:
    return f"{number} argument" if number == 1 else f"{number} arguments"


def signature(text: str) -> Signature:
    """Read a signature from a line such as `b:bool x:same y:same`; `?` marks an optional place, `*` the rest."""
    required: list[Argument] = []
    optional: list[Argument] = []
    rest: Argument | None = None
    for word in text.split():
        name, _, kind = word.partition(":")
        argument = Argument(name.rstrip("?*"), _KINDS[kind])
        if name.endswith("*"):
            rest = argument
        elif name.endswith("?"):
            optional.append(argument)
        else:
            required.append(argument)
    return Signature(tuple(required), tuple(optional), rest)


_KINDS = {kind.name.lower(): kind for kind in ArgumentKind}
