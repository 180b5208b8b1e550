"""Of several children of a rule that one is found for which a request was made, by what the rule says of each."""

import pytest

from checker.asked_children import children_asked_for, left_out, may_ask
from checker.influence import line_of
from checker.single_values import numbers_of, single_value
from compiler.instructions import all_instructions
from compiler.program import Child
from runtime.executive.configuration import GoalConfiguration
from runtime.executive.outcome import Event, EventKind
from tests.executive.flying import fly, planner, program, simulator

DEV = """
class Dev extends AgentTimeline { predicate Off { } predicate On { int n; int m; } Dev(Mode m) { super(m, "Off"); } }
"""
PLAN = (
    DEV
    + """
int FAR = 100;
class Task extends AgentTimeline {
    predicate Idle { } predicate Do { int n; bool split; }
    Task(Mode m) { super(m, "Idle"); }
}
Task::Do {
    if (split == true) {
        contains(Dev.On one); one.n == n;
        contains(Dev.On two); two.n == n + FAR;
        one before two; two.end == end; one.m == 1; two.m == 1;
    } else {
        contains(Dev.On only); only.n == n; only.end == end; only.m == 1;
    }
}
Task task = new Task(Internal);
Dev dev = new Dev(External);
close();
"""
)


@pytest.mark.parametrize(
    ("n", "split", "asked"),
    [(2, True, {2: {"one"}, 102: {"two"}}), (2, False, {2: {"only"}}), (102, False, {102: {"only"}})],
)
def test_the_child_is_found_by_values_and_branches(n: int, split: bool, asked: dict[int, set[str]]) -> None:
    world = simulator("sim", f"{DEV} Dev::On {{ duration == 5; }} Dev dev = new Dev(Internal); close();", "dev")
    arguments: tuple[tuple[str, float | bool], ...] = (("n", n), ("split", split))
    goal = GoalConfiguration("task", "Do", start=(3, 9), parameters=arguments)
    outcome = fly(planner("plan", PLAN, "task", "dev", latency=1), world, until=40, goals=(goal,))
    plan = program("plan.nddl", PLAN)
    (rule,) = plan.rules
    labels = {one.slot: one.label for one in all_instructions(rule.body) if isinstance(one, Child)}
    tokens = [one for one in outcome.events if one.predicate == "Do"]
    names = ("n", "split"), ("n", "m")
    numbers = dict(numbers_of(plan))
    found: dict[int, set[str | None]] = {}
    for request in outcome.events:
        if request.kind is EventKind.REQUEST and request.predicate == "On":
            slots, token = children_asked_for(rule, labels, names, request, tokens, numbers)
            assert token is not None
            value = single_value(dict(request.arguments)["n"])
            assert isinstance(value, (int, float))
            found[int(value)] = {labels[slot] for slot in slots}
            out = left_out(rule, slots, names, request, token, numbers)
            assert any("On only" in line_of(one.span).text for one in out) is split
    assert found == asked


def asked_of_dev(n: int, m: int) -> list[Event]:
    goal = GoalConfiguration("dev", "On", start=(3, 9), parameters=(("n", n), ("m", m)))
    world = simulator("sim", f"{DEV} Dev::On {{ duration == 5; }} Dev dev = new Dev(Internal); close();", "dev")
    return [one for one in fly(world, until=9, goals=(goal,)).events if one.kind is EventKind.REQUEST]


@pytest.mark.parametrize(("m", "may"), [(1, True), (2, False)])
def test_a_rule_that_gives_another_argument_in_any_case_did_not_ask(m: int, may: bool) -> None:
    plan = program("plan.nddl", PLAN)
    (rule,) = plan.rules
    (request,) = asked_of_dev(n=7, m=m)
    children = [one.slot for one in all_instructions(rule.body) if isinstance(one, Child)]
    numbers = dict(numbers_of(plan))
    assert [may_ask(rule, one, ("n", "m"), request, numbers) for one in children] == [may] * 3


def test_where_no_child_fits_all_count() -> None:
    plan = program("plan.nddl", PLAN)
    (rule,) = plan.rules
    (request,) = asked_of_dev(n=7, m=1)
    children = [one.slot for one in all_instructions(rule.body) if isinstance(one, Child)]
    slots, token = children_asked_for(rule, children, (("n", "split"), ("n", "m")), request, (), {})
    assert len(slots) == 3
    assert token is None
