"""A constant of the models, by name: the value nearest to its own with which no value of the box breaks the mission."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import z3

from checker.mutation.variant import Overlay
from checker.proofs.certify import Certifier
from checker.proofs.claims import Claim
from checker.proofs.dating import dated
from compiler.program import Assign, GlobalVariable, NewGlobal, Program
from nddl_lang.text.read import real_path
from nddl_lang.text.source import Span

_MOST_STEP = 2**20
_VALUE = re.compile(r"(=\s*)([-+]?\d+)(\s*;?)$")


@dataclass(frozen=True, slots=True)
class SafeConstant:
    """`value` is safe, the next one towards `own` (or beyond it) is not; larger values are safer if `is_least`."""

    name: str
    own: int
    value: int
    is_least: bool


def places_of(name: str, programs: Sequence[Program]) -> tuple[Span, ...]:
    """Where the models give a constant its value."""
    found: dict[tuple[str, int], Span] = {}
    for program in programs:
        for made in program.script:
            match made:
                case Assign(target=GlobalVariable(index=index), domain=domain) if domain is not None:
                    is_it = program.globals[index][0] == name
                case NewGlobal(domain=domain) if domain is not None:
                    is_it = made.name == name
                case _:
                    continue
            if is_it and domain.values is not None and len(domain.values) == 1:
                found.setdefault((made.span.source.name, made.span.begin), made.span)
    return tuple(found.values())


def with_value(span: Span, value: int) -> Overlay | None:
    """The models with another value of a constant; None where it is not written as `NAME = number;`."""
    source = span.source
    text, count = _VALUE.subn(rf"\g<1>{value}\g<3>", span.text.rstrip())
    if count != 1:
        return None
    whole = source.text[: span.begin] + text + source.text[span.begin + len(span.text.rstrip()) :]
    return ((str(real_path(Path(source.name))), whole),)


def safe_constant(certifier: Certifier, name: str) -> SafeConstant | None:
    """The safe value of a constant, proved for the structures of the flights; None: none, or z3 cannot tell."""
    freed = [
        frozenset(key for each in certifier.agent.reactors if (key := f"{each.name}:{name}") in structure.variables)
        for structure in certifier.structures
    ]
    values = {
        structure.values[key] for structure, keys in zip(certifier.structures, freed, strict=True) for key in keys
    }
    if len(values) != 1:
        return None
    (own,) = values
    if not isinstance(own, int) or isinstance(own, bool):
        return None
    claims = [
        [each.claim for each in dated(structure, keys).conditions]
        for structure, keys in zip(certifier.structures, freed, strict=True)
    ]
    variables = [z3.Int(key) for key in sorted(set().union(*freed))]

    def is_safe(value: int) -> bool:
        pairs = [(each, z3.IntVal(value)) for each in variables]
        conditions = [[_substituted(claim, pairs) for claim in found] for found in claims]
        return certifier.broken(certifier.box.sides, conditions=conditions) == ()

    return _tightened(name, own, is_safe) if is_safe(own) else _widened(name, own, is_safe)


def _substituted(claim: Claim, pairs: Sequence[tuple[object, object]]) -> Claim:
    return z3.simplify(z3.substitute(claim, *pairs))


def _widened(name: str, own: int, is_safe: Callable[[int], bool]) -> SafeConstant | None:
    """The safe value nearest to an unsafe one, upwards if there is one."""
    for sign in (1, -1):
        step = 1
        while step <= _MOST_STEP and not is_safe(own + sign * step):
            step *= 2
        if step <= _MOST_STEP:
            value = _between(own + sign * step, own + sign * (step // 2), is_safe)
            return SafeConstant(name, own, value, sign > 0)
    return None


def _tightened(name: str, own: int, is_safe: Callable[[int], bool]) -> SafeConstant | None:
    """How far a safe value may be tightened: the side on which it stops being safe."""
    for sign in (-1, 1):
        step = 1
        while step <= _MOST_STEP and is_safe(own + sign * step):
            step *= 2
        if step <= _MOST_STEP:
            value = _between(own + sign * (step // 2), own + sign * step, is_safe)
            return SafeConstant(name, own, value, sign < 0)
    return None


def _between(safe: int, unsafe: int, is_safe: Callable[[int], bool]) -> int:
    """The last safe value on the way to an unsafe one."""
    while abs(safe - unsafe) > 1:
        middle = (safe + unsafe) // 2
        safe, unsafe = (middle, unsafe) if is_safe(middle) else (safe, middle)
    return safe
