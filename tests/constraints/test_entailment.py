"""Constraints that rest in a search: nothing is lost, and all wake when the search goes back or is over."""

from runtime.constraints.domains.tags import KIND_BOOL, KIND_INT, KIND_SYMBOL
from runtime.constraints.engine import Engine
from runtime.constraints.propagators.opcodes import OP_LEQ, OP_TEMPORAL_DISTANCE


def watchers(engine: Engine, v: int) -> list[int]:
    found = []
    slot = engine.watch_head[v]
    while slot >= 0:
        found.append(engine.slot_constraint[slot])
        slot = engine.slot_next[slot]
    return found


def token(engine: Engine, shortest: float, longest: float) -> tuple[int, int, int, int]:
    duration = engine.new_interval(KIND_INT, shortest, longest, 0, -1)
    start = engine.new_interval(KIND_INT, 0, 100, 0, -1)
    end = engine.new_interval(KIND_INT, 0, 100, 0, -1)
    c = engine.post(OP_TEMPORAL_DISTANCE, [start, duration, end], 1, -1)
    return c, start, duration, end


def test_a_known_duration_rests_and_still_ties_its_ends() -> None:
    engine = Engine()
    c, start, duration, end = token(engine, 2, 8)
    other = engine.post(OP_LEQ, [engine.new_constant(KIND_INT, 0, 0), start], 1, -1)
    assert engine.propagate()
    before = [watchers(engine, v) for v in (start, duration, end)]
    assert c in before[0] and other in before[0]
    mark = engine.mark()
    assert engine.restrict_base(duration, 5, 5, 2, -1) and engine.propagate()
    assert c not in watchers(engine, start) + watchers(engine, duration) + watchers(engine, end)
    assert engine.restrict_base(start, 10, 20, 3, -1) and engine.propagate()
    assert (engine.lower(end), engine.upper(end)) == (15, 25)
    assert not (engine.restrict_base(end, 30, 40, 4, -1) and engine.propagate())
    assert {cause.span for cause in engine.explain()} >= {2, 3, 4}
    engine.rewind(mark)
    assert [watchers(engine, v) for v in (start, duration, end)] == before
    assert engine.restrict_base(end, 30, 40, 4, -1) and engine.propagate()
    assert (engine.lower(start), engine.upper(start)) == (22, 38)


def test_what_rested_is_awake_when_the_search_is_over_and_gives_way_to_retraction() -> None:
    engine = Engine()
    c, start, duration, end = token(engine, 2, 8)
    assert engine.propagate()
    engine.mark()
    assert engine.restrict_base(duration, 5, 5, 2, -1) and engine.propagate()
    known = engine.newest_restriction
    assert engine.restrict_base(start, 10, 10, 3, -1) and engine.propagate()
    assert c not in watchers(engine, start)
    engine.commit()
    assert all(c in watchers(engine, v) for v in (start, duration, end))
    assert engine.retract(restrictions=[known])
    assert (engine.lower(end), engine.upper(end)) == (12, 18)
    assert engine.restrict_base(end, 17, 17, 4, -1) and engine.propagate()
    assert (engine.lower(duration), engine.upper(duration)) == (7, 7)


def test_an_order_that_holds_rests_and_one_that_may_not_hold_is_kept() -> None:
    engine = Engine()
    x = engine.new_values(KIND_BOOL, [0, 1], 0, -1)
    y = engine.new_interval(KIND_INT, 0, 9, 0, -1)
    c = engine.post(OP_LEQ, [x, y], 1, -1)
    assert engine.propagate()
    mark = engine.mark()
    assert engine.restrict_base(y, 0, 5, 2, -1) and engine.propagate()
    assert c in watchers(engine, y)
    assert engine.restrict_base(x, 0, 0, 2, -1) and engine.restrict_base(y, 0, 4, 2, -1) and engine.propagate()
    assert c not in watchers(engine, y) and c not in watchers(engine, x)
    engine.rewind(mark)
    assert c in watchers(engine, y) and c in watchers(engine, x)
    assert engine.restrict_base(x, 1, 1, 2, -1) and engine.propagate()
    assert engine.lower(y) == 1


def test_a_variable_like_another_has_its_base_domain_whatever_happens_to_either() -> None:
    engine = Engine()
    model = engine.new_values(KIND_SYMBOL, [3, 5, 6, 90], 0, -1)
    copy = engine.new_like(model, 1, -1)
    assert engine.values_of(copy) == [3, 5, 6, 90] == engine.base_values(copy)
    assert engine.restrict_base_values(copy, [5, 90], 2, -1) and engine.propagate()
    assert (engine.values_of(copy), engine.values_of(model)) == ([5, 90], [3, 5, 6, 90])
    assert engine.restrict_base_values(model, [3, 6, 90], 2, -1) and engine.propagate()
    assert engine.values_of(engine.new_like(model, 1, -1)) == [3, 6, 90]
    assert engine.values_of(engine.new_like(copy, 1, -1)) == [5, 90]


def test_what_wakes_leaves_those_on_the_lists_that_came_meanwhile() -> None:
    engine = Engine()
    c, start, duration, end = token(engine, 1, 9)
    assert engine.propagate()
    engine.mark()
    assert engine.decide(duration, 3, 2, -1) and engine.propagate()
    assert c not in watchers(engine, start)
    other = engine.new_interval(KIND_INT, 3, 200, 3, -1)
    later = engine.post(OP_TEMPORAL_DISTANCE, [start, other, end], 3, -1)
    assert engine.restrict_base(end, 0, 10, 4, -1) and engine.propagate()
    limit = engine.newest_restriction
    engine.commit()
    assert {c, later} <= set(watchers(engine, start)) and {c, later} <= set(watchers(engine, end))
    assert engine.retract(variables=[duration], restrictions=[limit])
    assert (engine.lower(other), engine.upper(other)) == (3, 100)


def test_a_duration_that_is_rounded_over_a_hole_tells_its_ends() -> None:
    engine = Engine()
    duration = engine.new_values(KIND_INT, [-1, 1, 2], 0, -1)
    start = engine.new_interval(KIND_INT, -1, 1, 0, -1)
    end = engine.new_interval(KIND_INT, 1, 1, 0, -1)
    engine.post(OP_TEMPORAL_DISTANCE, [start, duration, end], 1, -1)
    assert engine.propagate()
    assert engine.values_of(duration) == [1, 2]
    assert (engine.lower(start), engine.upper(start)) == (-1, 0)
