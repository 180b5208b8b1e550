"""What the slots of a body stand for, taken from the variables that the engine names in a line's term."""

from collections.abc import Sequence

from checker.proofs.claims import Number
from checker.proofs.operands import BodyLayout, ProgramNames, Symbols, variable_name
from checker.proofs.places import WrittenLine
from compiler.program import Field, LocalVariable, Operand, TokenVariable
from runtime.plan.readout.names import TokenName, VariableName
from runtime.plan.readout.statements import Term


class TermBinding:
    """What the slots of a body stand for, from the variables that the engine names in the line's term."""

    def __init__(
        self,
        line: WrittenLine,
        symbols: Symbols,
        variables: Sequence[VariableName],
        own: TokenName | None,
        reactor: str,
    ) -> None:
        self.names: ProgramNames = line.names
        self.symbols = symbols
        self.layout: BodyLayout = line.layout
        self.variables = variables
        self.own = own
        self.reactor = reactor
        self.tokens: dict[int, TokenName] = {} if own is None else {0: own}
        self.slots: dict[int, VariableName] = {}
        self.members: dict[tuple[Operand | None, tuple[str, ...]], VariableName] = {}

    def align(self, operands: Sequence[Operand], term: Term) -> bool:
        """Take the variables of a term that has the operands' order for them; False where it has not."""
        if len(operands) != len(term.arguments):
            return False
        for operand, named in zip(operands, term.arguments, strict=True):
            if not isinstance(named, VariableName):
                continue
            match operand:
                case TokenVariable(token=slot, variable=variable) if named.token is not None and not named.is_local:
                    asked = self.layout.predicates.get(slot, "")
                    if not self.names.fits(named.token.predicate, asked):
                        return False
                    if named.name != variable_name(asked, variable, self.names):
                        return False
                    if self.tokens.setdefault(slot, named.token) != named.token:
                        return False
                case LocalVariable(slot=slot):
                    self.slots[slot] = named
                case Field(base=base, members=members):
                    self.members[base, members] = named
                case _:
                    pass
        return True

    def token(self, slot: int) -> tuple[str, str] | None:
        """The only token that the engine names and that fits the slot."""
        known = self.tokens.get(slot)
        if known is None:
            asked = self.layout.predicates.get(slot)
            named = {one.token for one in self.variables if one.token is not None and not one.is_local}
            fitting = [
                one
                for one in sorted(named, key=str)
                if asked is not None and one not in self.tokens.values() and self.names.fits(one.predicate, asked)
            ]
            if len(fitting) != 1:
                return None
            known = self.tokens[slot] = fitting[0]
        return f"{self.reactor}:{known}", known.predicate

    def local(self, slot: int) -> Number | None:
        """A local by the name that the engine gives it, or the text."""
        named, name = self.slots.get(slot), self.layout.locals.get(slot)
        if named is not None:
            return self.symbols.variable(f"{named.reactor}:{named}", named.kind)
        if name is None or self.own is None:
            return None
        return self.symbols.variable(f"{self.reactor}:{self.own}::{name}", self.layout.types[slot].kind)

    def world(self, index: int) -> Number | None:
        """A global variable by its name."""
        name, code = self.names.program.globals[index]
        return self.symbols.variable(f"{self.reactor}:{name}", code.kind)

    def member(self, base: Operand | None, members: Sequence[str]) -> Number | None:
        """A member, where the engine names it, or one only that is called so and is no other's."""
        if (known := self.members.get((base, tuple(members)))) is not None:
            return self.symbols.variable(f"{known.reactor}:{known}", known.kind)
        ends = "." + members[-1] if members else "."
        others = self.members.values()
        found = [one for one in self.variables if one.token is None and one.name.endswith(ends) and one not in others]
        return self.symbols.variable(f"{self.reactor}:{found[0]}", found[0].kind) if len(found) == 1 else None
