"""Write families of hard planning problems as text, each in a variant that has a plan and one that has none.

`model(family, n, feasible)` gives the text; `SIZES` the sizes that `bench_search.py` prints.
"""

from collections.abc import Callable, Iterable
from random import Random

SIZES = {
    "capacity": (6, 10, 20),
    "unary": (6, 10, 20),
    "reservoir": (3, 4, 5),
    "pigeons": (5, 6, 7),
    "survey": (4, 5, 6),
    "instrument": (3, 5, 8),
    "merging": (4, 6, 8),
    "rejecting": (6, 9, 12),
    "thrashing": (4, 8, 16),
    "knot": (6, 10, 20),
}
LANE = "class Lane extends Timeline { predicate run { } }"


def capacity(n: int, feasible: bool) -> Iterable[str]:
    """Jobs on a machine of capacity 2, each needs 1 for 3 ticks: one tick too little room in the bad variant."""
    room = (n + 1) // 2 * 3 if feasible else (3 * n - 1) // 2
    yield "Reusable machine = new Reusable(2.0, 0.0); close();"
    for i in range(n):
        yield f"goal(machine.uses u{i}); u{i}.quantity = 1.0; eq(u{i}.duration, 3);"
        yield f"leq(0, u{i}.start); leq(u{i}.end, {room});"


def unary(n: int, feasible: bool) -> Iterable[str]:
    """Uses of different lengths on a unary resource: all of its time, or one tick less."""
    lengths = [1 + (7 * i) % 5 for i in range(n)]
    room = sum(lengths) - (0 if feasible else 1)
    yield "Unary tool = new Unary(); close();"
    for i, length in enumerate(lengths):
        yield f"goal(tool.use u{i}); eq(u{i}.duration, {length}); leq(0, u{i}.start); leq(u{i}.end, {room});"


def reservoir(n: int, feasible: bool) -> Iterable[str]:
    """Drains that come each before its own refill, and a tank that is full at first; or empty: none can be first."""
    yield f"Reservoir tank = new Reservoir({2.0 if feasible else 0.0}, 0.0, 2.0); close();"
    for i in range(n):
        for name, kind in (("p", "produce"), ("c", "consume")):
            yield f"goal(tank.{kind} {name}{i}); {name}{i}.quantity = 2.0;"
            yield f"leq(0, {name}{i}.time); leq({name}{i}.time, {4 * n});"
        yield f"lt(c{i}.time, p{i}.time);"


def pigeons(n: int, feasible: bool) -> Iterable[str]:
    """Tokens that choose one of some holes each; a guard per pair forbids to share one."""
    holes = n if feasible else n - 1
    yield f"int {', '.join(f'h{i}' for i in range(n))};"
    yield from (f"leq(1, h{i}); leq(h{i}, {holes});" for i in range(n))
    yield "class Nest extends Timeline { predicate check { int a; int b; } }"
    yield "Nest::check { int same = [0 9]; if (a == b) { lt(same, 0); } }"
    pairs = [(i, j) for i in range(n) for j in range(i + 1, n)]
    yield from (f"Nest n{k} = new Nest();" for k in range(len(pairs)))
    yield "close();"
    for k, (i, j) in enumerate(pairs):
        yield f"goal(n{k}.check c{k}); eq(c{k}.a, h{i}); eq(c{k}.b, h{j}); c{k}.start = [1 9];"


def survey(n: int, feasible: bool) -> Iterable[str]:
    """A rover that visits sites in any order before a deadline: with each leg it needs, or one tick less."""
    legs = 3 * n
    stays = 2 * n
    yield "class Site { int place; Site(int p) { place = p; } }"
    yield "class Rover extends Timeline { predicate visit { Site site; } predicate drive { Site to; } }"
    yield "Rover::visit { eq(duration, 2); met_by(object.drive d); eq(d.to, site); }"
    yield "Rover::drive { eq(duration, 3); }"
    yield from (f"Site s{i} = new Site({i});" for i in range(n))
    yield "Rover rover = new Rover(); close();"
    for i in range(n):
        yield f"goal(rover.visit v{i}); eq(v{i}.site, s{i}); leq(0, v{i}.start);"
        yield f"leq(v{i}.end, {legs + stays - (0 if feasible else 1)}); leq(3, v{i}.start);"


def instrument(n: int, feasible: bool) -> Iterable[str]:
    """Two rovers whose samples share one instrument; each sample also chooses a mode that changes how long it lasts."""
    yield "class Rover extends Timeline { predicate sample { int mode; int number; } }"
    yield "Unary lens = new Unary();"
    yield "Rover::sample { leq(1, mode); leq(mode, 2); if (mode == 1) { eq(duration, 2); } else { eq(duration, 3); }"
    yield "  equals(Unary.use u); }"
    yield "Rover a = new Rover(); Rover b = new Rover(); close();"
    room = 2 * 2 * n - (0 if feasible else 1)
    for name in "ab":
        for i in range(n):
            goal = f"{name}{i}"
            yield f"goal({name}.sample {goal}); eq({goal}.number, {i});"
            yield f"leq(0, {goal}.start); leq({goal}.end, {room});"


def merging(n: int, feasible: bool) -> Iterable[str]:
    """Visits that ask for a beacon each; there is power for some beacons, and visits far apart cannot share one."""
    yield "class Power extends Timeline { predicate beacon { int c; } }"
    yield "class Ship extends Timeline { predicate visit { } }"
    yield "Power power = new Power();"
    yield "Ship::visit { eq(duration, 2); contained_by(Power.beacon b); eq(b.duration, 6); }"
    yield from (f"Ship s{i} = new Ship();" for i in range(n))
    yield "close();"
    end = 3 * n + 3 if feasible else 3 * n
    for i in range(n):
        yield f"goal(s{i}.visit v{i}); v{i}.start = [{3 * i + 1} {3 * i + 2}];"
    if not feasible:
        yield "goal(power.beacon last); eq(last.c, 1);"
        yield f"last.start = [{end - 4} {end - 4}]; eq(last.duration, 7);"
        yield f"fact(power.beacon first); eq(first.c, 2); first.start = [{end - 8} {end - 8}]; eq(first.duration, 3);"


def rejecting(n: int, feasible: bool) -> Iterable[str]:
    """Rejectable wishes on one timeline, and two goals that need all of it; one tick too little in the bad variant."""
    yield LANE
    yield "Lane lane = new Lane(); close();"
    for i in range(n):
        yield f"rejectable(lane.run r{i}); eq(r{i}.duration, 3); leq(0, r{i}.start); leq(r{i}.end, {2 * n});"
    for name, length in (("one", n), ("other", n + 1)):
        yield f"goal(lane.run {name}); eq({name}.duration, {length}); leq(0, {name}.start);"
        yield f"leq({name}.end, {2 * n + (1 if feasible else 0)});"


def thrashing(n: int, feasible: bool) -> Iterable[str]:
    """A knot of variables that has no values, behind independent choices that have nothing to do with it."""
    yield "typedef int [1 3] Few;"
    random = Random(n)
    yield "".join(f"Few free{i};" for i in range(n))
    yield from (f"neq(free{i}, free{random.randrange(i)});" for i in range(1, n))
    size = 5
    yield f"typedef int [1 {size if feasible else size - 1}] Hole;"
    yield "".join(f"Hole hole{i};" for i in range(size))
    yield from (f"neq(hole{i}, hole{j});" for i in range(size) for j in range(i + 1, size))


def knot(n: int, feasible: bool) -> Iterable[str]:
    """A map that three colours do not suffice for, hidden behind countries that touch few others; or all but a border.

    Hajós puts maps of four countries together so that each border is needed for that (Mizuno, Nishihara 2008).
    """
    random = Random(n)
    borders = {(i, j) for j in range(4) for i in range(j)}
    count = 4
    for _ in range(n - 1):
        a, b = random.choice(sorted(borders))
        one, two, three = range(count, count + 3)
        borders = (borders - {(a, b)}) | {(a, two), (a, three), (one, two), (one, three), (two, three), (b, one)}
        count += 3
    kept = sorted(borders)
    if feasible:
        kept.pop(random.randrange(len(kept)))
    names = [f"hard{i}" for i in range(count)]
    random.shuffle(names)
    yield "typedef int [1 3] Colour;"
    yield "".join(f"Colour easy{i};" for i in range(4 * n)) + "".join(f"Colour hard{i};" for i in range(count))
    yield from (f"neq({names[i]}, {names[j]});" for i, j in kept)
    yield from (f"neq(easy{i}, easy{random.randrange(i)});" for i in range(1, 4 * n))
    yield from (f"neq(easy{i}, hard{random.randrange(count)});" for i in range(4 * n) if random.random() < 0.4)


FAMILIES: dict[str, Callable[[int, bool], Iterable[str]]] = {
    "capacity": capacity,
    "unary": unary,
    "reservoir": reservoir,
    "pigeons": pigeons,
    "survey": survey,
    "instrument": instrument,
    "merging": merging,
    "rejecting": rejecting,
    "thrashing": thrashing,
    "knot": knot,
}


def model(family: str, n: int, feasible: bool) -> str:
    """The text of a problem."""
    return "\n".join(FAMILIES[family](n, feasible)) + "\n"
