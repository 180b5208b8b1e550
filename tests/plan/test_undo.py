"""Going back: a rewound plan is the plan that was marked; a retracted one is the plan that never was."""

from random import Random
from typing import Any

import pytest

from runtime.plan.database import PlanDatabase
from runtime.plan.readout.readout import live_tokens, read
from runtime.plan.tags import (
    ACTIVE,
    FLAG_REJECTABLE,
    HEAD_OPEN,
    HEAD_THREAT,
    INACTIVE,
    LIST_OPEN,
    LIST_PREDICATE,
    LIST_THREAT,
    LISTS,
    OBJECT,
    STATE,
    SYMBOL_ACTIVE,
    SYMBOL_MERGED,
    SYMBOL_REJECTED,
)
from tests.plan.models import loaded, token

MODEL = """
enum Mode { slow, fast }
class Site { int place; Site(int v) { place = v; } }
class Rover extends Timeline {
    predicate at { Site site; }
    predicate go { Site to; Mode mode; }
}
class Arm extends Timeline {
    predicate idle { }
    predicate dig { int depth; }
}
Rover::go {
    met_by(object.at here);
    meets(object.at there);
    eq(there.site, to);
    if (mode == fast) { duration <= 5; } else { duration >= 6; }
}
Arm::dig {
    Rover r;
    contained_by(r.at where);
    if (depth > 2) { met_by(object.idle rest); meets(object.idle more); }
    Site s;
    eq(where.site, s);
    if (s.place == 2) { depth <= 3; }
}
Site a = new Site(1);
Site b = new Site(2);
Rover rover = new Rover();
Arm arm = new Arm();
close();
fact(rover.at start);
start.start = 0;
eq(start.site, a);
goal(arm.dig first);
first.start = [10 60];
first.depth = [1 4];
rejectable(arm.dig second);
second.start = [0 80];
goal(rover.go trip);
trip.start = [1 50];
"""


def picture(database: PlanDatabase) -> dict[str, Any]:
    """All that can be seen of a plan, lists included."""
    rows = database.plan.rows
    seen = read(database)
    seen["open"] = listed(database, LIST_OPEN, HEAD_OPEN)
    seen["threats"] = listed(database, LIST_THREAT, HEAD_THREAT)
    seen["rows"] = (rows.live, rows.next_key, database.engine.woken_count, database.plan.queue_length)
    seen["scopes"] = [scopes(database, t) for t in live_tokens(database)]
    seen["guards"] = [
        (t, [database.plan.variable_guards[rows.var0[t] + k] for k in range(rows.width[t])])
        for t in live_tokens(database)
    ]
    return seen


def listed(database: PlanDatabase, kind: int, head: int) -> list[int]:
    """The tokens of a list, read from both ends."""
    rows = database.plan.rows
    forth, back = [], []
    t = rows.head_first[head]
    while t >= 0:
        forth.append(t)
        t = rows.link_after[LISTS * t + kind]
    t = rows.head_last[head]
    while t >= 0:
        back.append(t)
        t = rows.link_before[LISTS * t + kind]
    assert forth == back[::-1]
    assert len(forth) == rows.head_length[head]
    return forth


def scopes(database: PlanDatabase, t: int) -> list[tuple[int, int, int]]:
    """The scopes of a token: what each is, which branch it runs, how much it holds."""
    rows = database.plan.rows
    found = []
    s = rows.scopes[t]
    while s >= 0:
        count = 0
        h = rows.scope_holds[s]
        while h >= 0:
            count += 1
            h = rows.hold_next[h]
        found.append((rows.scope_kind[s], rows.scope_branch[s], count))
        s = rows.scope_next[s]
    return found


def change(database: PlanDatabase, chance: Random) -> bool:
    """Some decision that a solver might take; False on a conflict."""
    rows, engine = database.plan.rows, database.engine
    t = chance.choice(live_tokens(database))
    first = rows.var0[t]
    if rows.status[t] == INACTIVE:
        active = listed(database, LIST_PREDICATE, 2 + rows.predicate[t])
        if active and engine.contains(first + STATE, SYMBOL_MERGED) and chance.random() < 0.6:
            return database.merge(t, chance.choice(active))
        if (
            rows.flags[t] & FLAG_REJECTABLE
            and engine.contains(first + STATE, SYMBOL_REJECTED)
            and chance.random() < 0.3
        ):
            return database.reject(t)
        return not engine.contains(first + STATE, SYMBOL_ACTIVE) or database.activate(t)
    if rows.status[t] == ACTIVE and rows.link_head[LISTS * t + LIST_THREAT] >= 0 and chance.random() < 0.7:
        o = int(engine.lower(first + OBJECT))
        head = database.plan.object_head[o]
        other = rows.head_first[head]
        if other < 0:
            return database.order(o, t, t)
        return database.order(o, t, other) if chance.random() < 0.5 else database.order(o, rows.head_last[head], t)
    free = [v for v in range(first, first + rows.width[t]) if engine.is_finite(v) and not engine.is_decided(v)]
    if not free:
        return True
    v = chance.choice(free)
    return database.specify(v, chance.choice(list(engine.values_of(v))))


@pytest.mark.parametrize("seed", range(12))
def test_a_rewound_plan_is_the_plan_that_was_marked(seed: int) -> None:
    chance = Random(seed)
    database = loaded(MODEL)
    pictures: list[dict[str, Any]] = []
    marks: list[int] = []
    for _ in range(60):
        if not marks or chance.random() < 0.6:
            pictures.append(picture(database))
            marks.append(database.mark())
        if not change(database, chance) or chance.random() < 0.2:
            depth = chance.randrange(len(marks))
            if chance.random() < 0.5:
                database.release(marks[depth])
                assert picture(database) == pictures[depth]
                del marks[depth:], pictures[depth:]
            else:
                database.rewind(marks[depth])
                assert picture(database) == pictures[depth]
                del marks[depth + 1 :], pictures[depth + 1 :]


@pytest.mark.parametrize("seed", range(8))
def test_a_plan_taken_apart_is_the_plan_that_was_loaded(seed: int) -> None:
    chance = Random(seed)
    database = loaded(MODEL)
    before = read(database)
    variables, edges = database.engine.variables, database.engine.edges_used
    for _ in range(3):
        for _ in range(25):
            mark = database.mark()
            if change(database, chance):
                database.commit()
            else:
                database.release(mark)
                database.commit()
        for t in live_tokens(database):
            if database.plan.rows.status[t] not in (INACTIVE,) and database.plan.rows.parent[t] < 0:
                assert database.cancel(t)
        for t in live_tokens(database):
            for v in range(database.plan.rows.var0[t], database.plan.rows.var0[t] + database.plan.rows.width[t]):
                assert database.reset(v)
        assert read(database) == before
    assert database.engine.variables <= variables + 400
    assert database.engine.edges_used <= edges + 400


def tables(database: PlanDatabase) -> tuple[int, ...]:
    """How long the tables of plan and engine have become."""
    rows, engine = database.plan.rows, database.engine
    return (
        rows.token_count,
        rows.scope_count,
        rows.hold_count,
        rows.cell_count,
        rows.pair_count,
        engine.variables,
        engine.edges_used,
        engine.constraints_used,
        engine.restrictions_used,
        database.plan.resources.count,
    )


def test_tables_stay_as_long_as_the_longest_plan() -> None:
    database = loaded(MODEL)
    trip = token(database, "trip")
    idle = next(n for n, each in enumerate(database.program.predicates) if each.name == "Arm.idle")
    lengths = []
    for _ in range(60):
        mark = database.mark()
        assert database.activate(trip)
        database.release(mark)
        assert database.activate(trip)
        t = database.new_token(idle, 3, 1, -2)
        assert database.fire() and database.activate(t) and database.order(3, t, t)
        assert database.remove_tokens([t])
        assert database.cancel(trip)
        database.commit()
        lengths.append(tables(database))
    assert lengths[1] == lengths[-1]
