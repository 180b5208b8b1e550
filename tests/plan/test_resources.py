"""Levels of resources: what is refused at once, what is a flaw, and what mends it."""

from itertools import product
from math import inf
from random import Random

import pytest

from runtime.plan.database import PlanDatabase
from runtime.plan.readout.level_profile import level_profiles
from runtime.plan.readout.open_levels import open_levels
from runtime.plan.resources.envelope import Envelope
from tests.plan.models import loaded, prepared, token


def consistent(text: str) -> bool:
    """Whether a model is consistent after loading."""
    return loaded(text).is_consistent


def flaw(database: PlanDatabase) -> Envelope | None:
    """The first flaw of the only resource."""
    flaws = Envelope(database.plan.engine, database.plan.resources)
    return flaws if flaws.find(0) else None


RESERVOIR = "Reservoir r = new Reservoir(5.0, 0.0, 10.0); close();"
UNARY = "Unary r = new Unary(); close();"


def test_what_is_consumed_must_be_there() -> None:
    consume = "goal(r.consume c); c.time = 5; c.quantity = "
    assert consistent(RESERVOIR + consume + "5.0;")
    assert not consistent(RESERVOIR + consume + "6.0;")
    assert consistent(RESERVOIR + "goal(r.produce p); p.quantity = 1.0; p.time = [0 5];" + consume + "6.0;")


def test_a_level_that_is_out_of_bounds_at_first_has_to_be_within_them_after_each_use() -> None:
    too_full = "Reservoir r = new Reservoir(20.0, 0.0, 10.0); close(); goal(r.consume c); c.time = 5; c.quantity = "
    assert consistent(too_full + "12.0;")
    assert not consistent(too_full + "5.0;")
    too_empty = "Reservoir r = new Reservoir(0.0, 5.0, 10.0); close(); goal(r.produce p); p.time = 5; p.quantity = "
    assert consistent(too_empty + "6.0;")
    assert not consistent(too_empty + "2.0;")
    assert consistent(too_empty + "2.0; goal(r.produce more); more.quantity = 4.0; more.time = [0 5];")


def test_a_conflict_ends_when_its_reason_goes() -> None:
    text = """
    class P extends Timeline { Reservoir r; P(Reservoir v) { r = v; } predicate a { } }
    P::a { starts(object.r.consume c); c.quantity == 6.0; c.time == 3; }
    Reservoir r = new Reservoir(5.0, 0.0, 10.0);
    P p = new P(r);
    close();
    goal(p.a g);
    g.activate();
    """
    assert not consistent(text)
    assert consistent(text + "g.cancel();")


def test_the_rate_of_consumption_is_limited() -> None:
    text = "Reservoir r = new Reservoir(50.0, 0.0, 90.0, 9.0, 9.0, 4.0, 7.0); close();"
    two = "goal(r.consume c); c.time = 5; c.quantity = {0}; goal(r.consume d); d.time = {1}; d.quantity = {0};"
    assert consistent(text + two.format("2.0", "5"))
    assert not consistent(text + two.format("3.0", "5"))
    assert consistent(text + two.format("3.5", "6"))
    assert not consistent(text + two.format("4.0", "6"))


def test_two_uses_that_may_overlap_are_a_flaw_until_they_are_ordered() -> None:
    text = UNARY + "".join(f"goal(r.use {n}); {n}.start = [0 20]; {n}.duration = 5;" for n in "ab")
    database = loaded(text)
    found = flaw(database)
    assert found is not None
    assert (found.at, found.is_low, found.amount) == (0, 1, 1.0)
    assert flaw(loaded(text + "a before b;")) is None


def test_three_uses_on_a_capacity_of_two() -> None:
    text = "Reusable r = new Reusable(2.0, 0.0); close();"
    text += "".join(f"goal(r.uses {n}); {n}.start = [0 20]; {n}.duration = 5; {n}.quantity = 1.0;" for n in "abc")
    assert flaw(loaded(text)) is not None
    assert flaw(loaded(text + "b before c;")) is None


def test_a_full_reservoir_is_a_flaw_on_the_high_side() -> None:
    text = "Reservoir r = new Reservoir(10.0, 0.0, 10.0); close();"
    text += (
        "goal(r.consume c); c.time = [0 20]; c.quantity = 8.0; goal(r.produce p); p.time = [0 20]; p.quantity = 8.0;"
    )
    found = flaw(loaded(text))
    assert found is not None and not found.is_low
    assert flaw(loaded(text + "c.time <= p.time;")) is None


def test_the_order_of_uses_may_exceed_a_reservoir_for_certain() -> None:
    text = """
    Reservoir r = new Reservoir(0.0, 0.0, 10.0);
    close();
    goal(r.produce p); p.quantity = 6.0; p.time = [0 10];
    goal(r.consume d); d.quantity = 6.0; d.time = 10;
    """
    assert consistent(text)
    assert not consistent(text + "goal(r.consume c); c.quantity = 3.0; c.time = [0 10]; c.time <= p.time;")


class Asked:
    """Relief that never comes; whether somebody would have to give (1) or to take (-1) is kept."""

    def __init__(self) -> None:
        self.signs: list[int] = []

    def may_come(self, o: int, sign: int) -> bool:
        self.signs.append(sign)
        return False


@pytest.mark.parametrize(
    ("level", "gives", "takes", "sign"), [(0, "produce", "consume", 1), (10, "consume", "produce", -1)]
)
def test_relief_is_asked_for_on_the_side_that_is_short(level: int, gives: str, takes: str, sign: int) -> None:
    database = prepared(f"""
    Reservoir r = new Reservoir({level}.0, 0.0, 10.0);
    close();
    goal(r.{gives} p); p.quantity = 6.0; p.time = [0 10];
    goal(r.{takes} c); c.quantity = 6.0; c.time = [0 10]; c.time <= p.time;
    goal(r.{gives} late); late.quantity = 9.0; late.time = [8 20];
    goal(r.{takes} d); d.quantity = 4.0; d.time = 5;
    """)
    database.plan.resources.relief = asked = Asked()
    assert database.run_script() is None and not database.is_consistent
    assert asked.signs[-1] == sign


def test_a_grounded_profile_looks_at_the_earliest_schedule() -> None:
    text = """
    class M extends Reusable { string profileType; M() { super(1.0, 0.0); profileType = "GroundedProfile"; } }
    M r = new M();
    close();
    goal(r.uses a); a.start = [0 50]; a.duration = 5; a.quantity = 1.0;
    goal(r.uses b); b.start = [7 50]; b.duration = 5; b.quantity = 1.0;
    """
    assert flaw(loaded(text)) is None
    assert flaw(loaded(text.replace("Grounded", ""))) is not None
    assert flaw(loaded(text.replace("7", "4"))) is not None


@pytest.mark.parametrize("seed", range(30))
def test_the_envelope_is_what_trying_every_order_gives(seed: int) -> None:
    """A flaw is found if and only if some schedule that keeps the known orders leaves the limits."""
    chance = Random(seed)
    count = chance.randrange(2, 5)
    windows = [(low := chance.randrange(4), low + chance.randrange(4)) for _ in range(count)]
    lengths = [chance.randrange(1, 4) for _ in range(count)]
    amounts = [chance.randrange(1, 4) for _ in range(count)]
    pairs = [(i, j) for i in range(count) for j in range(count) if i < j and chance.random() < 0.4]
    capacity = chance.randrange(2, 7)
    text = f"Reusable r = new Reusable({capacity}.0, 0.0); close();"
    for i in range(count):
        low, high = windows[i]
        text += f"goal(r.uses u{i}); u{i}.start = [{low} {high}]; u{i}.duration = {lengths[i]};"
        text += f"u{i}.quantity = {amounts[i]}.0;"
    text = text.replace(f"[{0} {0}]", "0")
    text += "".join(f"u{i} before u{j};" for i, j in pairs)
    database = loaded(text)
    schedules = [
        starts
        for starts in product(*(range(low, high + 1) for low, high in windows))
        if all(starts[i] + lengths[i] <= starts[j] for i, j in pairs)
    ]
    loads = [
        [sum(a for a, s, d in zip(amounts, starts, lengths, strict=True) if s <= t < s + d) for t in range(20)]
        for starts in schedules
    ]
    fits = [max(load) <= capacity for load in loads]
    assert database.is_consistent or not any(fits)
    if schedules and database.is_consistent:
        assert (flaw(database) is not None) == (not all(fits))


def test_why_a_resource_refuses_can_be_asked_in_a_search() -> None:
    text = "class T extends Timeline { predicate p { } } T t = new T(); Reservoir r = new Reservoir(2.0, 0.0, 2.0);"
    text += "close();"
    text += "T::p { contains(r.produce c); c.quantity == 2.0; leq(c.time, 50); } goal(t.p g); g.start = [0 5];"
    database = loaded(text)
    database.mark()
    assert not database.activate(token(database, "g"))
    assert any(cause.owner == token(database, "g") for cause in database.engine.explain())


def test_a_use_of_unbounded_amount_gives_all_of_it_back() -> None:
    plan = loaded("Reusable r = new Reusable(5.0, 0.0); close(); fact(Reusable.uses a); a.start = 3; a.end = 7;")
    assert level_profiles(plan, 0)["r"].steps == ((0, 5.0, 5.0), (3, -inf, 5.0), (7, 5.0, 5.0))
    plan = loaded("Reusable r = new Reusable(5.0, 0.0); close(); fact(Reusable.uses a);")
    (told,) = open_levels(plan)
    assert told.text() == "the level of r may fall to -inf at any tick (limit 0)"
