"""How long a planner sleeps: when the next token comes into its window, or can wait no more."""

from math import inf

from runtime.executive.clock import next_within
from runtime.executive.view import SPAN_REQUEST
from runtime.executive.workbench import Workbench
from runtime.plan.database import PlanDatabase
from runtime.plan.tags import INFINITY
from tests.executive.flying import program

LAMP = """
class Lamp extends AgentTimeline { predicate Off { } predicate On { } Lamp(Mode m) { super(m, "Off"); } }
Lamp lamp = new Lamp(Internal); close();
"""


def with_tokens(*starts: tuple[int, float]) -> tuple[Workbench, list[int]]:
    """A plan with undecided tokens of given earliest and latest starts."""
    database = PlanDatabase(program("lamp.nddl", LAMP), None)
    assert database.run_script() is None
    bench = Workbench(database, "lamp")
    bench.commit()
    line = bench.timeline("lamp", True)
    tokens = [bench.new_token(line.predicates["On"], line.object_id, False) for _ in starts]
    for token, bounds in zip(tokens, starts, strict=True):
        assert bench.within(bench.start(token), bounds, SPAN_REQUEST, token)
    return bench, tokens


def test_the_next_token_comes_into_the_window_so_many_ticks_before_its_start() -> None:
    bench, _ = with_tokens((40, inf), (25, 30), (7, 90))
    assert [next_within(bench, tick, 10, False) for tick in (0, 14, 15, 29, 30)] == [15, 15, 30, 30, INFINITY - 10]


def test_what_has_its_place_comes_into_the_window_where_all_its_variables_count() -> None:
    bench, (token, _) = with_tokens((25, 30), (40, 50))
    o = bench.object_of(token)
    assert bench.activate(token)
    assert next_within(bench, 0, 10, False) == 15  # it has no place yet
    assert bench.place_after(o, token, -1)
    assert (next_within(bench, 0, 10, False), next_within(bench, 0, 10, True)) == (30, 15)


def test_the_first_latest_start_of_what_is_undecided_ends_the_sleep() -> None:
    bench, (_, second, _) = with_tokens((40, inf), (25, 30), (7, 90))
    assert bench.last_start() == 30
    assert bench.activate(second)
    assert bench.last_start() == 90
    assert with_tokens((40, inf))[0].last_start() == with_tokens()[0].last_start() == inf
