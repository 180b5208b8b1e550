"""Conflicts and failed searches leave the engine as typed data, with the places of the model that they come from."""

import json
import pickle
from collections.abc import Iterator

from runtime.executive.outcome import ConflictElement, Deadlock, Event, EventKind, Phase
from runtime.executive.rendering import choice_text, deadlock_text, element_text, trace_json
from runtime.executive.story import SearchLog, conflict_of
from runtime.executive.workbench import Workbench
from runtime.plan.database import PlanDatabase
from runtime.plan.readout.names import TokenName, VariableName
from runtime.solver.configuration.configuration import default_configuration
from runtime.solver.learning.attempts import Attempt, FailedFlaw, Flaw, Resolver, ResolverKind
from runtime.solver.search import Solver
from tests.executive.flying import program

CLASS = """
enum Colour { red, green, blue }
class Lamp extends AgentTimeline { predicate Off { } predicate On { Colour c; } Lamp(Mode m) { super(m, "Off"); } }
"""


def bench(text: str) -> Workbench:
    """The plan of a model, before any decision."""
    database = PlanDatabase(program("m.nddl", CLASS + text), None)
    assert database.run_script() is None
    return Workbench(database, "sim")


def test_a_conflict_over_symbols_names_them() -> None:
    rules = "Lamp::On { c != blue; } Lamp lamp = new Lamp(Internal); close();"
    text = f"{rules} fact(Lamp.On on); on.c.specify(red); eq(on.c, blue);"
    found = conflict_of(bench(text))
    assert found is not None
    operands = {one for element in found.elements for term in element.terms for one in term.arguments}
    names = {one for one in operands if isinstance(one, VariableName)}
    assert any(name.kind == "symbol" and name.name == "c" and name.reactor == "sim" for name in names)
    said = [element_text(element) for element in found.elements]
    assert any("red" in text for text in said) and any("blue" in text for text in said)


def test_what_a_foreach_has_gone_through_is_told_by_its_objects() -> None:
    rules = "Lamp::On { Lamp one; foreach (each in one) { contains(each.Off rest); } one != other; }"
    lamps = "Lamp lamp = new Lamp(Internal); Lamp other = new Lamp(Internal); close();"
    found = conflict_of(bench(f"{lamps} {rules} fact(lamp.On on); on.activate();"))
    assert found is not None
    assert any(
        text.endswith("::one may not lose a value any more: `foreach` has gone through {lamp, other}")
        for text in map(element_text, found.elements)
    )


def test_a_search_that_fails_says_what_it_tried() -> None:
    rules = "Lamp::On { meets(Off rest); rest.duration >= 5; rest.duration <= 3; }"
    plan = bench(f"{rules} Lamp lamp = new Lamp(Internal); close(); goal(Lamp.On on); on.start == 8;")
    solver = Solver(plan.database, default_configuration(), 0, 20, False)
    log = SearchLog(plan, solver)
    solver.failure_log = log.log
    solver.solve(100, 100)
    deadlock = log.deadlock()
    assert deadlock is not None and deadlock.tried
    assert "is not in the plan yet" in deadlock_text(deadlock)
    elements = list(found_in(deadlock))
    assert {element.place.text for element in elements if element.place} >= {
        "rest.duration >= 5",
        "rest.duration <= 3",
    }
    assert TokenName("Lamp.On", 0) in {element.token for element in elements}
    assert all(choice_text(one.choice) for one in deadlock.tried)
    event = Event(0, Phase.DELIBERATE, EventKind.ABORT, "sim", code="F4", deadlock=deadlock)
    assert json.loads(trace_json(event))["tried"]["choices"]


def found_in(deadlock: Deadlock) -> Iterator[ConflictElement]:
    """All elements of conflicts, however deep."""
    for one in deadlock.tried:
        if one.conflict is not None:
            yield from one.conflict.elements
        if one.leads_to is not None:
            yield from found_in(one.leads_to)


def test_a_search_that_failed_deep_down_is_told_as_far_as_it_can_be_handed_on() -> None:
    """A result goes from a worker to its parent by pickle, which calls itself for each level."""
    failed = FailedFlaw(Flaw(1, "the last"), (Attempt(Resolver(ResolverKind.SPECIFY, ("7",)), ()),))
    for level in range(5_000):
        failed = FailedFlaw(Flaw(1, f"level {level}"), (Attempt(Resolver(ResolverKind.ACTIVATE), (), failed),))
    plan = bench("Lamp lamp = new Lamp(Internal); close();")
    log = SearchLog(plan, Solver(plan.database, default_configuration(), 0, 1, False))
    log.log.end = failed
    told = log.deadlock()
    assert told is not None
    assert pickle.loads(pickle.dumps(told)) == told
    depth = 0
    while told.tried and told.tried[0].leads_to is not None:
        told, depth = told.tried[0].leads_to, depth + 1
    assert depth == 40
    assert [one.choice for one in told.tried] == [Resolver(ResolverKind.SPECIFY, ("7",))]
