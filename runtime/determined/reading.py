"""Readings: where the registers of a determined reactor show what the rules of a block did; made once per block."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import inf

from compiler.determined.code import BlockToken, RegisterBlock
from compiler.determined.relations import FOLLOWING, MERGED, PREVIOUS
from compiler.program import Child, Guard, Instruction, NewVariable, RuleCode
from runtime.executive.columns import GuardOutline, RunOutline
from runtime.executive.record import BodyRun, GuardRun, Value, ValueRange

Named = tuple[tuple[int, str], ...]  # registers and kinds
Names = Callable[[int], str]


@dataclass(frozen=True, eq=False, slots=True)
class BodyReading:
    """The body of a rule or a branch: registers of its named locals, child slots, and its guards."""

    rule: int
    named: Named
    children: tuple[tuple[int, int, int], ...]  # number of the parent in its block, rule, slot
    guards: tuple["_GuardReading", ...]

    def registers(self) -> Iterator[int]:
        """All registers that are read, in whatever branch."""
        yield from (register for register, _ in self.named)
        for guard in self.guards:
            yield guard.register
            for branch in (guard.then, guard.otherwise):
                if branch is not None:
                    yield from branch.registers()


@dataclass(frozen=True, eq=False, slots=True)
class _GuardReading:
    """A guard: the register of its condition, and both branches, None where one is empty."""

    register: int
    then: BodyReading | None
    otherwise: BodyReading | None


def outlines_of(readings: tuple["TokenReading", ...], places: Mapping[int, int]) -> tuple[tuple[RunOutline, ...], ...]:
    """Where the tokens of a block show what their rules did; `places` are those of the registers that it shows."""
    numbers = {(each.token.parent, each.token.rule, each.token.slot): each.number for each in readings}
    return tuple([tuple([_outline(body, places, numbers) for body in each.bodies]) for each in readings])


def _outline(body: BodyReading, places: Mapping[int, int], numbers: dict[tuple[int, int, int], int]) -> RunOutline:
    guards = []
    for guard in body.guards:
        then, otherwise = (
            None if branch is None else _outline(branch, places, numbers) for branch in (guard.then, guard.otherwise)
        )
        guards.append(GuardOutline(places[guard.register], then, otherwise))
    return RunOutline(
        body.rule,
        tuple([(places[register], kind) for register, kind in body.named]),
        tuple([numbers[child] for child in body.children]),
        tuple(guards),
    )


def run_of(outline: RunOutline, shown: Sequence[float], keys: Sequence[int], first: int, names: Names) -> BodyRun:
    """What one run of a body did, by what it has `shown`; from `first` on are the keys of the tokens of its block."""
    guards = []
    for guard in outline.guards:
        is_true = shown[guard.place] != 0.0
        branch = guard.then if is_true else guard.otherwise
        inner = None if branch is None else run_of(branch, shown, keys, first, names)
        guards.append(GuardRun("then" if is_true else "else", True, inner))
    return BodyRun(
        outline.rule,
        values(shown, outline.locals, names),
        tuple([int(keys[first + number]) for number in outline.children]),
        tuple(guards),
    )


@dataclass(frozen=True, eq=False, slots=True)
class TokenReading:
    """A token of a block, by its number there; `bodies` are those of its rules, if they run with the block."""

    number: int
    token: BlockToken
    bodies: tuple[BodyReading, ...]


def readings_of(block: RegisterBlock, rules: tuple[RuleCode, ...]) -> tuple[TokenReading, ...]:
    """All tokens of a block."""
    return tuple(
        TokenReading(
            number,
            token,
            ()
            if token.how in (MERGED, PREVIOUS, FOLLOWING)
            else tuple(_body(block, number, rule, rules[rule].body) for rule in token.predicate.rules),
        )
        for number, token in enumerate(block.tokens)
    )


def _body(block: RegisterBlock, token: int, rule: int, body: tuple[Instruction, ...]) -> BodyReading:
    shown = {each.slot: each.shown for each in block.locals if each.token == token and each.rule == rule}
    registers = {each.span: each.register for each in block.guards if each.token == token and each.rule == rule}
    named: list[tuple[int, str]] = []
    children: list[tuple[int, int, int]] = []
    guards: list[_GuardReading] = []
    for step in body:
        match step:
            case NewVariable(name=str(), slot=slot):
                named.append((shown[slot].register, shown[slot].kind))
            case Child(slot=slot):
                children.append((token, rule, slot))
            case Guard(then=then, otherwise=otherwise, span=span):
                branches = [_body(block, token, rule, branch) if branch else None for branch in (then, otherwise)]
                guards.append(_GuardReading(registers[span], *branches))
            case _:
                pass
    return BodyReading(rule, tuple(named), tuple(children), tuple(guards))


def values(registers: Sequence[float], where: Named, names: Names) -> tuple[Value, ...]:
    """What registers say of variables; NaN leaves one open."""
    found: list[Value] = []
    for register, kind in where:
        number = registers[register]
        if number != number:
            found.append(ValueRange(-inf, inf))
        elif kind == "float":
            found.append(number + 0.0)  # no negative zero
        elif kind == "int":
            found.append(int(number))
        else:
            found.append(bool(number) if kind == "bool" else names(int(number)))
    return tuple(found)
