"""What a token may lead to: the predicates that rules ask for, and those below these, also in cycles."""

import random

import pytest

from runtime.build_form import build_form
from compiler.lower import compile_model
from nddl_lang.analysis import analyse_text
from runtime.solver.flaws.supports import Supports

assert build_form()
COUNT = 9


@pytest.mark.parametrize("seed", range(12))
def test_a_predicate_leads_to_all_that_can_be_asked_for_step_by_step(seed: int) -> None:
    draw = random.Random(seed)
    asked = [set(draw.sample(range(COUNT), draw.choice((0, 1, 1, 2)))) for _ in range(COUNT)]
    predicates = " ".join(f"predicate p{each} {{ }}" for each in range(COUNT))
    rules = "".join(
        f"A::p{each} {{ {' '.join(f'any(object.p{other} q{other});' for other in sorted(others))} }}\n"
        for each, others in enumerate(asked)
    )
    analysis = analyse_text("m.nddl", f"class A extends Timeline {{ {predicates} }}\n{rules}A a = new A();\nclose();\n")
    assert not analysis.has_errors
    program = compile_model(analysis)
    numbers = {code.name: number for number, code in enumerate(program.predicates)}
    supports = Supports(program)
    for each in range(COUNT):
        met, pending = {each}, [each]
        while pending:
            new = asked[pending.pop()] - met
            met |= new
            pending += new
        found = {other for other in range(COUNT) if supports.leads_to(numbers[f"A.p{each}"], numbers[f"A.p{other}"])}
        assert found == met
