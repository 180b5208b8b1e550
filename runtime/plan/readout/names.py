"""Names of tokens and variables that outlive them: fields to compare and to group by, and a text for people."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class TokenName:
    """A token of one plan: `Class.predicate`, and a number that is never used again there."""

    predicate: str
    key: int

    def __str__(self) -> str:
        return f"{self.predicate}#{self.key}"


@dataclass(frozen=True, slots=True)
class VariableName:
    """A variable of one reactor's plan, with its kind (int, float, bool, symbol, object, string).

    `token` owns it; without one it is a global variable, or a member of an object (`rover.mode`). `is_local`: a rule
    of the token declares it, or needs it for a part of an expression; else it is a parameter or a time of the token.
    """

    name: str
    kind: str
    token: TokenName | None = None
    is_local: bool = False
    reactor: str = ""

    @property
    def is_unnamed(self) -> bool:
        """Whether nobody named it: it stands for a part of an expression, and its name is a number."""
        return self.name[:1] == "_" and self.name[1:].isdecimal()

    def __str__(self) -> str:
        if self.token is None:
            return self.name
        return f"{self.token}{'::' if self.is_local else '.'}{self.name}"
