"""The registry of constraints agrees with the language's table, with the opcodes, and with what its rows mean."""

import random
from collections.abc import Sequence

import pytest

from nddl_lang.semantics.constraints import CONSTRAINTS
from runtime.constraints.domains.tags import KIND_INT
from runtime.constraints.engine import Engine
from runtime.constraints.propagators import opcodes
from runtime.constraints.propagators.registry import BY_NAME, BY_OP, NAMES
from runtime.constraints.propagators.row import Propagator
from tests.constraints import meaning

OPCODES = {name: value for name, value in vars(opcodes).items() if name.startswith("OP_")}
ROWS = list(dict.fromkeys([*BY_NAME.values(), *BY_OP.values()]))
NAMED = [row for row in ROWS if row.names]
CLAIMED = [row for row in BY_OP.values() if row.claim is not None and row.op in meaning.MEANINGS]


class Plain:
    """The algebra of whole numbers and truths as Python has them."""

    def every(self, claims: Sequence[bool]) -> bool:
        return all(claims)

    def some(self, claims: Sequence[bool]) -> bool:
        return any(claims)

    def choose(self, claim: bool, x: int, y: int) -> int:
        return x if claim else y

    def floor(self, x: int) -> int:
        return x

    def real(self, x: int) -> int:
        return x

    def is_whole(self, x: int) -> bool:
        return isinstance(x, int)


def test_every_constraint_of_the_language_has_one_row() -> None:
    # Resources carry out `uses`; all other names of either table are in both.
    assert set(BY_NAME) == set(CONSTRAINTS) - {"uses"}
    assert len(BY_NAME) == sum(len(row.names.split()) for row in ROWS), "no name stands in two rows"


def order_of(name: str) -> list[str]:
    """List the arguments of a constraint as the language's table has them, the last one last."""
    row = CONSTRAINTS[name]
    required = [place.name for place in row.signature.required]
    rest = [f"{row.signature.rest.name}*"] if row.signature.rest is not None else []
    if rest and row.result == -1:
        return [*required[:-1], *rest, required[-1]]
    return [*required, *rest]


@pytest.mark.parametrize("row", NAMED, ids=lambda row: row.names)
def test_arguments_stand_in_the_order_of_the_language(row: Propagator) -> None:
    first, *others = row.names.split()
    assert row.arguments.split() == order_of(first)
    count = len([name for name in row.arguments.split() if not name.endswith("*")])
    assert all(CONSTRAINTS[name].signature.accepts(count) for name in others)


def test_every_opcode_has_one_row() -> None:
    assert len(set(OPCODES.values())) == len(OPCODES)
    assert {row.op for row in ROWS if row.propagate is None} == set(OPCODES.values()) - {opcodes.OP_EXTERNAL}
    assert len(BY_OP) == sum(row.op != opcodes.OP_NOTHING for row in ROWS)
    assert all(row.op < opcodes.OPCODES for row in ROWS)


def test_what_waits_is_said_to_wait_and_has_a_relation() -> None:
    waiting = [row for row in ROWS if row.waits]
    assert waiting
    for row in waiting:
        assert CONSTRAINTS[row.names].forward_only, row.names
        assert row.relation is not None or row.twin >= 0 or row.is_of_domains, row.names


def test_a_twin_takes_the_same_arguments_and_does_not_wait() -> None:
    for row in ROWS:
        if row.twin >= 0:
            twin = BY_OP[row.twin]
            assert not twin.waits and twin.twin < 0
            assert len(twin.arguments.split()) == len(row.arguments.split())


@pytest.mark.parametrize("row", CLAIMED, ids=lambda row: row.name)
def test_a_claim_says_of_whole_numbers_what_the_constraint_means(row: Propagator) -> None:
    chance = random.Random(row.op)
    count = len(row.arguments.split())
    found = set()
    for _ in range(3000):
        x = [chance.randint(-4, 4) for _ in range(count + (chance.randint(0, 2) if "*" in row.arguments else 0))]
        assert row.claim is not None
        holds = meaning.holds(row.op, x)
        assert bool(row.claim(Plain(), x)) == holds, x
        found.add(holds)
    assert found == {True, False}


def test_a_claim_is_what_propagation_of_known_values_decides() -> None:
    for row in CLAIMED:
        chance = random.Random(row.op)
        for _ in range(60):
            x = [chance.randint(-3, 3) for _ in row.arguments.split()]
            engine = Engine()
            engine.post(row.op, [engine.new_interval(KIND_INT, value, value, -1, -1) for value in x], -1, -1)
            assert row.claim is not None
            assert engine.propagate() == bool(row.claim(Plain(), x)), (row.name, x)


@pytest.mark.parametrize(
    ("name", "text"), [("leq", "a <= b"), ("addEq", "c == a + b"), ("mulEq", "c == a * b"), ("neq", "a != b")]
)
def test_a_modeler_writes_some_constraints_infix(name: str, text: str) -> None:
    assert BY_NAME[name].infix.format("a", "b", "c") == text


def test_the_name_in_messages_is_the_first_of_the_language() -> None:
    assert NAMES[opcodes.OP_EQ] == "eq"
    assert NAMES[opcodes.OP_PLUS] == "addEq"
    assert NAMES[opcodes.OP_SAMPLE] == "sampledParameter"
    assert opcodes.OP_WATCH not in NAMES
