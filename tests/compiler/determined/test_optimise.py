"""Optimised register code stops where the plain code stops, and leaves the same values."""

import random
from array import array
from math import isnan, nan

import pytest

from compiler.determined import code
from compiler.determined.code import BlockToken, RegisterLayout
from compiler.determined.items import Context
from compiler.determined.linear import linear
from compiler.determined.optimise import BlockFacts, optimise, packed
from compiler.determined.schedule import Placed
from compiler.program import ParameterCode, PredicateCode, TypeCode
from runtime.determined.machine import Machine
from runtime.determined.tables import CodeTables

FLOAT = TypeCode("float", "float", None)
PARAMETERS = range(1, 6)  # of the token that begins
SHARED = range(6, 9)  # what branches compute
OUTER = range(9, 13)  # of a token that holds already
CONSTANTS = {13: 0.0, 14: 1.0, 15: 2.0}
OWN = range(16, 60)
HUGE = 2.0**33


def known(given: frozenset[int], passing: frozenset[int]) -> BlockFacts:
    """A block of one token with five parameters."""
    parameters = tuple(ParameterCode(f"p{k}", FLOAT, None, None, None) for k in PARAMETERS)
    predicate = PredicateCode("Arm.Act", "Arm", parameters, (), 0, 0, False, False, (), (), None)
    layout = RegisterLayout((), [])
    layout.presets.update(CONSTANTS)
    token = BlockToken("root", 0, predicate, -1, -1, 0, ())
    return BlockFacts(layout, (token,), (PARAMETERS[0],), given, frozenset(SHARED), passing)


def random_block(chance: random.Random, given: frozenset[int]) -> tuple[list[Placed], frozenset[int]]:
    """Instructions as the schedule places them, and the registers that nobody reads afterwards."""
    placed: list[Placed] = []
    fresh = iter(OWN)
    told = [*given, *OUTER, *CONSTANTS]
    contexts: list[Context] = [()]
    passing: set[int] = set()
    for _ in range(chance.randint(5, 25)):
        context = chance.choice(contexts)
        a, b, c = (chance.choice(told) for _ in range(3))
        # Nothing is read that may be unknown.
        placed += [(context, (code.NEED, each, 1)) for each in (a, b, c) if each in OUTER]
        kind = chance.randrange(9)
        if kind == 0:
            placed.append((context, (code.NEED, chance.choice([*OUTER, *PARAMETERS, *SHARED]), 1)))
        elif kind < 4:
            placed.append((context, (code.UNIFY, chance.choice([*PARAMETERS, *SHARED]), a)))
        elif kind == 4:
            out = next(fresh)
            placed.append((context, (code.SAME, out, a, chance.choice(list(CONSTANTS)))))
            if len(contexts) < 8:
                contexts += [(*context, (out, True)), (*context, (out, False))]
        else:
            operation = chance.choice([code.ADD, code.MUL, code.SUB, code.MIN, code.COPY])
            out = next(fresh)
            operands = (a,) if operation == code.COPY else (a, b)
            placed.append((context, (operation, out, *operands)))
            if chance.random() < 0.5:
                passing.add(out)
                wanted = chance.choice([*PARAMETERS, *SHARED])
                following = (code.ADD, next(fresh), out, c) if chance.random() < 0.5 else (code.UNIFY, wanted, out)
                placed.append((context, following))
            else:
                told.append(out)
    return placed, frozenset(passing)


def carried_out(placed: list[Placed], registers: list[float], is_sure: bool) -> list[float] | None:
    """The registers behind a block, or nothing if it stops, or the log refuses its parameters."""
    tables = CodeTables(1)
    tables.code = array("i", [number for instruction in linear(placed) for number in instruction])
    machine = Machine(1, tables, None)
    machine.registers = array("d", registers)
    if not machine.carry_out(0):
        return None
    found = list(machine.registers)
    logged = [found[k] for k in PARAMETERS]
    if any(abs(value) >= 2.0**32 or (is_sure and isnan(value)) for value in logged):
        return None
    return found


@pytest.mark.parametrize("seed", range(40))
def test_optimised_code_does_what_plain_code_does(seed: int) -> None:
    chance = random.Random(seed)
    shorter = 0
    for _ in range(10):
        given = frozenset(k for k in PARAMETERS if chance.random() < 0.4)
        placed, passing = random_block(chance, given)
        optimised, is_sure = optimise(placed, known(given, passing))
        optimised = packed(optimised)
        shorter += len(linear(placed)) - len(linear(optimised))
        for _ in range(8):
            registers = [chance.choice([0.0, 1.0, 2.0, -1.5]) for _ in range(OWN.stop)]
            for k in (*PARAMETERS, *SHARED):
                registers[k] = registers[k] if k in given else nan
            for k in OUTER:
                registers[k] = chance.choice([0.0, 1.0, 2.0, 2.0, nan, HUGE, HUGE**2])
            for k, value in CONSTANTS.items():
                registers[k] = value
            expected = carried_out(placed, registers, False)
            found = carried_out(optimised, registers, is_sure)
            assert (found is None) == (expected is None), (placed, optimised)
            if found is not None and expected is not None:
                left = [k for k in range(OWN.stop) if k not in passing]
                assert repr([found[k] for k in left]) == repr([expected[k] for k in left]), (placed, optimised)
    assert shorter > 0


def test_neighbours_are_copied_together_once_the_last_is_known() -> None:
    placed: list[Placed] = [
        ((), (code.NEED, 9, 1)),
        ((), (code.COPY, 1, 9)),
        ((), (code.MUL, 16, 1, 14)),
        ((), (code.ADD, 17, 16, 15)),
        ((), (code.NEED, 10, 1)),
        ((), (code.COPY, 2, 10)),
        ((), (code.COPY, 3, 11)),
    ]
    optimised, is_sure = optimise(placed, known(frozenset(), frozenset({16})))
    assert not is_sure
    assert [instruction for _, instruction in optimised] == [
        (code.NEED, 9, 2),
        (code.COPY, 1, 9),
        (code.MUL_ADD, 17, 1, 14, 15),
        (code.MOVE, 2, 10, 2),
    ]


def test_what_the_log_demands_is_not_demanded_twice() -> None:
    placed: list[Placed] = [((), (code.COPY, k, 15)) for k in PARAMETERS if k > 2]
    placed += [((), (code.NEED, 9, 1)), ((), (code.COPY, 1, 9)), ((), (code.NEED, 2, 1))]
    optimised, is_sure = optimise(placed, known(frozenset(), frozenset()))
    assert is_sure
    assert code.NEED not in [instruction[0] for _, instruction in optimised]


@pytest.mark.parametrize(("other", "left"), [(14, code.UNIFY), (15, code.COPY)])
def test_a_value_is_compared_only_where_two_branches_may_both_tell_it(other: int, left: int) -> None:
    placed: list[Placed] = [
        ((), (code.SAME, 16, 9, 14)),
        ((), (code.SAME, 17, 9, other)),
        (((16, True),), (code.UNIFY, 6, 10)),
        (((17, True),), (code.UNIFY, 6, 11)),
    ]
    optimised, _ = optimise(placed, known(frozenset(), frozenset()))
    assert optimised[-1][1] == (left, 6, 11)
    assert code.UNLESS_SAME in [instruction[0] for instruction in linear(optimised)]


def test_copies_that_follow_each_other_are_three_to_an_instruction() -> None:
    inner: Context = ((16, True),)
    plain: list[Placed] = [
        ((), (code.COPY, 1, 9)),
        ((), (code.MOVE, 2, 10, 2)),
        ((), (code.COPY, 4, 1)),
        (inner, (code.COPY, 5, 9)),
        (inner, (code.MOVE, 20, 30, 9)),
    ]
    found = packed(plain)
    assert [instruction for _, instruction in found] == [
        (code.COPIES, 1, 9, 2, 10, 3, 11),
        (code.COPY, 4, 1),
        (code.COPY, 5, 9),
        (code.MOVE, 20, 30, 9),
    ]
    registers = [float(k) for k in range(60)]
    assert carried_out(found[:2], registers, True) == carried_out(plain[:3], registers, True)
