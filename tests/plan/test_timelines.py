"""Sequences on timelines: where tokens are put, what that says about their times, how it is taken back."""

from runtime.plan.database import PlanDatabase
from runtime.plan.readout.readout import read
from runtime.plan.tags import LIST_ORDER, LISTS, OBJECT, START
from tests.plan.models import OBJECTS, TIMELINES, domains, loaded, token

SCENE = TIMELINES + OBJECTS


def three() -> tuple[PlanDatabase, int, int, int]:
    """Three active tokens of five ticks each."""
    database = loaded(
        SCENE + "".join(f"goal(t.{p} {p}0); {p}0.start = [0 99]; {p}0.duration = 5; {p}0.activate();" for p in "pqr")
    )
    return database, token(database, "p0"), token(database, "q0"), token(database, "r0")


def test_a_token_is_put_between_its_neighbours() -> None:
    database, a, b, c = three()
    assert database.order(0, a, b)
    assert database.order(0, c, b)
    assert read(database)["order"] == {"t": ["p0", "r0", "q0"]}
    assert domains(database)["q0.start"] == "[10, 99] int"
    assert domains(database)["p0.start"] == "[0, 89] int"


def test_an_order_is_undone_by_free() -> None:
    database, a, b, _ = three()
    before = read(database)
    assert database.order(0, a, b)
    assert database.free(a, b)
    assert read(database) == before
    assert database.plan.rows.head_length[1] == 3


def test_neighbours_of_a_cancelled_token_keep_their_order() -> None:
    database, a, b, c = three()
    assert database.order(0, a, b)
    assert database.order(0, b, c)
    assert database.cancel(b)
    assert read(database)["order"] == {"t": ["p0", "r0"]}
    assert domains(database)["r0.start"] == "[5, 99] int"
    assert domains(database)["p0.start"] == "[0, 94] int"


def test_an_order_that_the_times_exclude_is_a_conflict() -> None:
    database = loaded(SCENE + "goal(t.p a); goal(t.q b); a.start = 10; b.end = 5; a.activate(); b.activate();")
    mark = database.mark()
    assert not database.order(0, token(database, "a"), token(database, "b"))
    database.release(mark)
    assert database.is_consistent
    assert database.order(0, token(database, "b"), token(database, "a"))


def test_ordering_narrows_the_object_without_deciding_it() -> None:
    database = loaded(SCENE + "goal(T.p g); g.activate();")
    g = token(database, "g")
    assert database.order(1, g, g)
    v = database.plan.rows.var0[g] + OBJECT
    assert database.engine.lower(v) == database.engine.upper(v) == 1
    assert not database.engine.is_decided(v)
    assert database.plan.rows.link_head[LISTS * g + LIST_ORDER] == database.plan.object_head[1]


def test_times_observed_from_outside_reach_the_plan() -> None:
    database = loaded(TIMELINES + "T::p { meets(object.q s); s.duration == 3; } T t = new T(); close();")
    predicate = next(n for n, each in enumerate(database.program.predicates) if each.name == "T.p")
    t = database.new_token(predicate, 0, 2, -7)
    assert database.fire()
    assert database.activate(t, -7)
    start = database.plan.rows.var0[t] + START
    assert database.engine.restrict_base(start, 4, 4, -7, t) and database.fire()
    assert database.engine.restrict_base(start + 1, 9, 9, -7, t) and database.fire()
    assert domains(database)["T.q#1.end"] == "{12} int"
    assert database.remove_tokens([t])
    assert database.plan.rows.live == 0
