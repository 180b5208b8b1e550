"""Write small random models, and say by trying everything whether they have a plan."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import permutations, product
from random import Random


@dataclass(frozen=True)
class Puzzle:
    """A model's text and whether a plan exists."""

    text: str
    has_plan: bool


def variables_puzzle(seed: int) -> Puzzle:
    """Global variables with constraints between them."""
    random = Random(seed)
    count = random.randint(2, 5)
    lines, domains = [], []
    for i in range(count):
        low = random.randint(-2, 2)
        values = list(range(low, low + random.randint(1, 4)))
        if random.random() < 0.3 and len(values) > 2:
            values.remove(random.choice(values[1:-1]))
            lines.append(f"int v{i} = {{{', '.join(map(str, values))}}};")
        else:
            lines.append(f"int v{i} = [{values[0]} {values[-1]}];")
        domains.append(values)
    tests = []
    for _ in range(random.randint(1, 2 * count)):
        a, b, c = (random.randrange(count) for _ in range(3))
        kind = random.choice(("neq", "leq", "lt", "eq", "addEq", "mulEq"))
        if kind in ("neq", "lt") and a == b:
            continue
        names = (a, b, c) if kind in ("addEq", "mulEq") else (a, b)
        lines.append(f"{kind}({', '.join(f'v{n}' for n in names)});")
        tests.append((kind, names))
    checks: dict[str, Callable[..., bool]] = {
        "neq": lambda x, y: x != y,
        "leq": lambda x, y: x <= y,
        "lt": lambda x, y: x < y,
        "eq": lambda x, y: x == y,
        "addEq": lambda x, y, z: x + y == z,
        "mulEq": lambda x, y, z: x * y == z,
    }
    has_plan = any(
        all(checks[kind](*(values[n] for n in names)) for kind, names in tests) for values in product(*domains)
    )
    return Puzzle("\n".join(lines) + "\n", has_plan)


def timelines_puzzle(seed: int) -> Puzzle:
    """Goals with windows, durations, precedences and a choice of timelines; none can merge, all must be in the plan."""
    random = Random(seed)
    count, places = random.randint(2, 5), random.randint(1, 2)
    end = random.randint(4, 14)
    lines = ["class T extends Timeline { predicate p { int n; } }"]
    lines += [f"T t{i} = new T();" for i in range(places)] + ["close();"]
    tokens: list[tuple[int, int, int, int | None]] = []
    for i in range(count):
        length = random.randint(1, 4)
        low = random.randint(0, end - 1)
        high = random.randint(low, end)
        fixed = random.randrange(places) if random.random() < 0.5 else None
        lines.append(f"goal({'T' if fixed is None else f't{fixed}'}.p g{i});")
        lines += [f"eq(g{i}.n, {i});", f"eq(g{i}.duration, {length});", f"g{i}.start = [{low} {high}];"]
        lines.append(f"leq(g{i}.end, {end});")
        tokens.append((length, low, high, fixed))
    orders = []
    for _ in range(random.randint(0, 2)):
        a, b = random.sample(range(count), 2)
        lines.append(f"g{a} before g{b};")
        orders.append((a, b))
    return Puzzle("\n".join(lines) + "\n", any_schedule(tokens, orders, places, end))


def any_schedule(
    tokens: list[tuple[int, int, int, int | None]], orders: list[tuple[int, int]], places: int, end: int
) -> bool:
    """Whether the tokens fit: some assignment, some order, each as early as it can be in that order."""
    count = len(tokens)
    for chosen in product(range(places), repeat=count):
        if any(fixed is not None and fixed != place for (_, _, _, fixed), place in zip(tokens, chosen, strict=True)):
            continue
        for sequence in permutations(range(count)):
            if starts_hold(tokens, orders, chosen, sequence, end):
                return True
    return False


def starts_hold(
    tokens: list[tuple[int, int, int, int | None]],
    orders: list[tuple[int, int]],
    chosen: tuple[int, ...],
    sequence: tuple[int, ...],
    end: int,
) -> bool:
    """Whether the tokens fit when they start in this order."""
    place_in = {token: position for position, token in enumerate(sequence)}
    if any(place_in[a] > place_in[b] for a, b in orders):
        return False
    free: dict[int, int] = {}
    done: dict[int, int] = {}
    for i in sequence:
        length, low, high, _ = tokens[i]
        start = max(low, free.get(chosen[i], 0), *(done[a] for a, b in orders if b == i), 0)
        if start > high or start + length > end:
            return False
        done[i] = free[chosen[i]] = start + length
    return True


def rules_model(seed: int) -> str:
    """Goals, facts and rejectables whose rules ask for more tokens, behind guards too; nobody knows the verdict."""
    random = Random(seed)
    end = random.randint(6, 16)
    predicates = [f"p{i}" for i in range(random.randint(2, 4))]
    lines = ["class T extends Timeline {"]
    lines += [f"    predicate {name} {{ int x; }}" for name in predicates]
    lines += ["}"]
    for i, name in enumerate(predicates):
        body = [f"duration >= {random.randint(1, 2)};", f"duration <= {random.randint(2, 4)};", f"leq(end, {end});"]
        body += ["leq(0, x);", f"leq(x, {random.randint(1, 3)});"]
        for child in predicates[i + 1 :]:
            if random.random() < 0.5:
                relation = random.choice(("before", "meets", "met_by", "contains", "after"))
                where = random.choice(("object", "T"))
                body.append(f"{relation}({where}.{child} c_{child});")
                if random.random() < 0.5:
                    link = random.choice((f"eq(c_{child}.x, x);", f"neq(c_{child}.x, x);", f"lt(x, c_{child}.x);"))
                    body.append(link)
        if i + 1 < len(predicates) and random.random() < 0.5:
            child = predicates[-1]
            body.append(f"if (x == {random.randint(0, 2)}) {{ meets(object.{child} g_{child}); }}")
        if random.random() < 0.4:
            body.append(f"int k = [0 {random.randint(1, 2)}];")
            body.append(random.choice(("neq(k, x);", "eq(k, x);", "leq(x, k);")))
        lines.append(f"T::{name} {{ {' '.join(body)} }}")
    lines += [f"T t{i} = new T();" for i in range(random.randint(1, 2))] + ["close();"]
    for i in range(random.randint(2, 4)):
        kind = random.choice(("goal", "goal", "fact", "rejectable"))
        lines.append(f"{kind}({random.choice(('t0', 'T'))}.{random.choice(predicates)} g{i});")
        low = random.randint(0, end - 2)
        lines.append(f"g{i}.start = [{low} {random.randint(low, end)}];")
        if random.random() < 0.3:
            lines.append(f"eq(g{i}.x, {random.randint(0, 2)});")
    return "\n".join(lines) + "\n"


def guards_model(seed: int) -> str:
    """Rules whose guards compare two parameters, so that a branch rests on more than one decision; no known verdict."""
    random = Random(seed)
    count = random.randint(2, 3)
    predicates = [f"p{i}" for i in range(random.randint(2, 3))]
    lines = ["int g0 = [0 2]; int g1 = [0 1];" + (" neq(g0, g1);" if random.random() < 0.5 else "")]
    lines.append("class T extends Timeline {")
    lines += [f"    predicate {name} {{ int x; int y; }}" for name in predicates]
    lines += ["}"]
    effects = ("neq(x, 0);", "neq(y, 1);", "eq(k, 0);", "lt(x, y);", "leq(k, 0);", "eq(s, 1);", "leq(end, 5);")
    for i, name in enumerate(predicates):
        body = [f"duration >= 1; duration <= {random.randint(1, 3)}; int k = [0 2]; int s = [0 4]; addEq(x, k, s);"]
        body.append(f"leq(0, x); leq(x, {random.randint(1, 2)}); leq(0, y); leq(y, {random.randint(1, 2)});")
        for number in range(random.randint(1, 2)):
            then = [random.choice((*effects, "eq(g1, x);", "neq(g0, y);"))]
            if i + 1 < len(predicates) and random.random() < 0.5:
                relation = random.choice(("meets", "before", "met_by", "contains"))
                child = random.choice(predicates[i + 1 :])
                then.append(f"{relation}(object.{child} c{number}); {random.choice(('eq', 'neq'))}(c{number}.x, y);")
            body.append(
                f"if ({random.choice(('x == y', 'x != y', 'x == 1', 'k == x', 'k == s'))}) {{ {' '.join(then)} }}"
            )
            if random.random() < 0.4:
                body.append(f"else {{ {random.choice(('neq(y, 0);', 'leq(k, 1);', 'neq(x, 2);'))} }}")
        if random.random() < 0.3:
            body.append(random.choice(("neq(k, y);", "neq(s, g0);")))
        lines.append(f"T::{name} {{ {' '.join(body)} }}")
    lines += [f"T t{i} = new T();" for i in range(random.randint(1, 2))] + ["close();"]
    for i in range(count):
        kind = random.choice(("goal", "goal", "rejectable"))
        lines.append(f"{kind}({random.choice(('t0', 'T'))}.{random.choice(predicates)} a{i});")
        lines.append(f"a{i}.start = [0 {random.randint(1, 8)}];")
        if i and random.random() < 0.5:
            lines.append(f"{random.choice(('eq', 'neq', 'leq'))}(a{i}.x, a{i - 1}.y);")
    return "\n".join(lines) + "\n"


def uses_model(seed: int) -> str:
    """Tasks that share machines and a tank, some only in one mode; nobody knows the verdict."""
    random = Random(seed)
    end, most = random.randint(5, 10), random.randint(1, 3)
    lines = ["class L extends Timeline { predicate run { int m; } }"]
    body = [f"leq(0, m); leq(m, {random.randint(0, 2)}); duration >= 1; duration <= 4; leq(end, {end});"]
    body.append(f"if (m == 0) {{ equals(Reusable.uses u); eq(u.quantity, {random.randint(1, most)}.0); }}")
    if random.random() < 0.7:
        body.append(
            f"if (m == 1) {{ starts(Reusable.uses u); eq(u.quantity, 1.0); u.duration == {random.randint(1, 4)}; }}"
        )
    if random.random() < 0.6:
        body.append(f"if (m != {random.randint(0, 2)}) {{ starts(Reservoir.consume c); c.quantity == 1.0; }}")
        body.append("else { ends(Reservoir.produce c); c.quantity == 1.0; }")
    lines.append(f"L::run {{ {' '.join(body)} }}")
    lines += [f"Reusable r{i} = new Reusable({random.randint(1, most)}.0, 0.0);" for i in range(2)]
    lines += [f"Reservoir v = new Reservoir({random.randint(0, 2)}.0, 0.0, {random.randint(2, 4)}.0);"]
    lines += [f"L l{i} = new L();" for i in range(3)] + ["close();"]
    for i in range(random.randint(2, 3)):
        low = random.randint(0, 3)
        lines.append(f"{random.choice(('goal', 'goal', 'rejectable'))}({random.choice((f'l{i}', 'L'))}.run a{i});")
        lines.append(
            f"a{i}.start = [{low} {random.randint(low + 1, end)}]; a{i}.duration = [1 {random.randint(3, 4)}];"
        )
        if i and random.random() < 0.4:
            lines.append(f"{random.choice(('eq', 'neq', 'leq'))}(a{i}.m, a{i - 1}.m);")
    return "\n".join(lines) + "\n"


def loops_model(seed: int) -> str:
    """Rules with a `foreach` over variables that are decided, or not yet, when it runs; no known verdict."""
    random = Random(seed)
    globals_ = random.randint(1, 3)

    def one() -> str:
        return f"v{random.randrange(globals_)}"

    lines = ["class A extends Timeline { int k; A(int v) { k = v; } predicate work { int z; } }"]
    lines.append("class S extends Timeline { predicate q { A o; int c; } predicate r { int c; } }")
    lines.append("class T extends Timeline { predicate p { int w; int u; } }")
    of_z = random.choice(("", "z == object.k;", "z != object.k;"))
    lines.append(f"A::work {{ object.k {random.choice(('==', '!=', '<='))} {random.randint(0, 2)}; {of_z} }}")
    lines.append("T t = new T(); S s1 = new S(); S s2 = new S();")
    lines += [f"A a{i} = new A({random.randint(0, 2)});" for i in range(random.randint(2, 4))]
    lines += ["close();", *(f"A v{i};" for i in range(globals_))]
    if globals_ > 1 and random.random() < 0.5:
        lines.append("neq(v0, v1);")
    otherwise = random.choice(("u == 1;", "u == 0; u == 1;", "contains(s2.r y);"))
    then = f"contains(s1.q x); {random.choice(('x.c == u;', ''))}"
    also = "if (u == 1) { contains(s2.r more); }" if random.random() < 0.4 else ""
    lines.append(f"T::p {{ if (w == {random.randint(0, 1)}) {{ {then} }} else {{ {otherwise} }} {also} }}")
    inner = random.choice(("contains(e.work y);", "any(e.work y); y.z == c;", "e.k == c;"))
    last = random.choice(("", "eq(o, v0);", "c == 1;"))
    lines.append(f"S::q {{ foreach (e in {random.choice((one(), 'o'))}) {{ {inner} }} {last} }}")
    lines.append(f"S::r {{ foreach (e in {one()}) {{ {random.choice(('contains(e.work y);', 'e.k != c;'))} }} }}")
    lines.append("goal(t.p g); g.w = {0, 1}; g.u = {0, 1}; g.start = 0; g.end = 12;")
    return "\n".join(lines)
