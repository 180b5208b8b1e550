"""Draw small models whose verdict does not hang on the order of decisions, so that a plan is found just if one exists.

For that, what is never decided may only be bounded: times, by differences and decided values; floats with an interval,
by equality and <=. Each token lies within the horizon from the start. A guard tests what will be decided, so no
member of the token's own object. There are no loops over domains, no predicates in subclasses, no actions; tokens that
may be rejected are alone in what the script claims.
A resource is refused as soon as what charges it *now* is too much, whatever may come to its help later (as in EUROPA):
so what helps a reservoir is in the script, and rules only harm it. Quantities are constants: a flaw of a resource is
mended before variables are decided, for the worst of what a quantity may be.
"""

from random import Random

from tests.solver.whole.model import (
    RELATIONS,
    RESOURCES,
    Aim,
    Body,
    Call,
    Child,
    Claim,
    Class,
    Compare,
    If,
    Local,
    Model,
    Predicate,
    Relate,
    Statement,
    Thing,
    Variable,
)
from tests.solver.whole.random_claims import COLOURS, Draw, Scope, claim, decided_claim


def random_whole(seed: int, with_resources: bool = False) -> Model:
    """A model; with resources its rules charge some."""
    random = Random(seed)
    draw = Draw(random, random.randint(4, 14), [], {}, [], [], [])
    draw.harm = random.choice(("consume", "produce"))
    make_classes(draw)
    make_things(draw, with_resources)
    draw.globals = [int_variable(draw, f"g{k}") for k in range(random.choice((0, 0, 1, 2)))]
    if draw.chance(0.2):
        draw.globals.append(Variable("gt", "T", ()))
    rules: list[tuple[str, Body]] = []
    for at, kind in enumerate(draw.kinds):
        for _ in range(random.choice((0, 1, 1, 1, 2))):
            rules.append((kind, rule(draw, at, with_resources)))
    aims = [aim(draw, f"a{k}") for k in range(random.randint(1, 4))]
    assigned, claims = script(draw, aims)
    if with_resources:
        help_reservoirs(draw, aims, assigned)
    return Model(
        COLOURS,
        tuple(draw.classes),
        tuple(draw.things),
        tuple(draw.globals),
        tuple(rules),
        tuple(aims),
        tuple(assigned),
        tuple(claims),
    )


# ---- declarations ----


def int_variable(draw: Draw, name: str) -> Variable:
    """An int with two to four values, in one piece or not."""
    low = draw.random.randint(-1, 1)
    values = list(range(low, low + draw.random.randint(2, 4)))
    if len(values) > 2 and draw.chance(0.3):
        values.remove(draw.random.choice(values[1:-1]))
    return Variable(name, "int", tuple(values))


def parameter(draw: Draw, name: str) -> Variable:
    """A parameter of some type."""
    match draw.random.choice(("int", "int", "int", "bool", "E", "T", "float", "wide")):
        case "int":
            return int_variable(draw, name)
        case "float":
            return Variable(name, "float", tuple(sorted(draw.random.sample((0.0, 0.5, 1.0, 1.5, 2.0), 2))))
        case "wide":
            low = draw.random.choice((-0.5, 0.0, 0.5))
            return Variable(name, "float", (low, low + draw.random.choice((0.5, 1.0, 2.0))), is_wide=True)
        case type_:
            return Variable(name, type_, ())


def make_classes(draw: Draw) -> None:
    """One to three classes; their predicates in one order: rules ask for later ones only."""
    random = draw.random
    names = ["T", *random.sample(["U", "W"], random.choice((0, 1, 1, 2)))]
    owners = [random.choice(names) for _ in range(random.randint(2, 4))]
    for k, owner in enumerate(owners):
        draw.kinds.append(f"{owner}.p{k}")
    for owner in names:
        members = ("k",) if draw.chance(0.5) else ()
        predicates = []
        for kind in draw.kinds:
            if kind.startswith(f"{owner}."):
                parameters = tuple(parameter(draw, f"x{j}") for j in range(random.randint(0, 3)))
                inside: tuple[Claim, ...] = (Call("leq", ("0", "start")), Call("leq", ("end", str(draw.end))))
                if draw.chance(0.6):
                    inside = (*inside, Compare("<=", "duration", str(random.randint(1, 4))))
                predicates.append(Predicate(kind.partition(".")[2], parameters, inside))
                draw.predicates[kind] = predicates[-1]
        draw.classes.append(Class(owner, owner != "W", members, tuple(predicates)))


def make_things(draw: Draw, with_resources: bool) -> None:
    """Some objects of each class, perhaps resources."""
    random = draw.random
    for each in draw.classes:
        for k in range(random.choice((1, 1, 2, 3)) if each.is_timeline else 1):
            members = tuple(
                int_variable(draw, "").values if draw.chance(0.3) else (random.randint(0, 2),) for _ in each.members
            )
            draw.things.append(Thing(f"{each.name.lower()}{k}", each.name, members))  # type: ignore[arg-type]
    if not with_resources:
        return
    for k, class_name in enumerate(random.choices(list(RESOURCES), k=random.choice((1, 1, 2)))):
        limits: tuple[float, ...] = (float(random.randint(1, 2)), 0.0)
        if class_name == "Reservoir":
            level = float(random.randint(0, 2))
            limits = (level, 0.0, 100.0) if draw.harm == "consume" else (-level, -100.0, 0.0)
        draw.things.append(Thing(f"r{k}", class_name, (), () if class_name == "Unary" else limits))


# ---- rules ----


def scope_of(draw: Draw, kind: str, path: str) -> Scope:
    """The names that a token of a kind has, behind a path."""
    owner, _, _ = kind.partition(".")
    scope = [(f"{path}start", "time"), (f"{path}end", "time"), (f"{path}duration", "span")]
    for each in draw.predicates[kind].parameters:
        scope.append((f"{path}{each.name}", "wide" if each.is_wide else each.type))
        scope += fields(draw, f"{path}{each.name}", each.type)
    owned = next(each for each in draw.classes if each.name == owner)
    scope += [(f"{path}object.{name}", "field") for name in owned.members]
    return scope


def fields(draw: Draw, path: str, type_: str) -> Scope:
    """The members of an object that is decided."""
    return [(f"{path}.{name}", "int") for each in draw.classes if each.name == type_ for name in each.members]


def rule(draw: Draw, at: int, with_resources: bool) -> Body:
    """A rule of the kind at a place of the order."""
    kind = draw.kinds[at]
    scope = scope_of(draw, kind, "") + [(each.name, each.type) for each in draw.globals]
    scope += [pair for each in draw.globals for pair in fields(draw, each.name, each.type)]
    body = block(draw, at, scope, 3, 0, with_resources)
    counts = [each.name for each in draw.predicates[kind].parameters if each.type == "int"]
    if counts and kind not in draw.recursive and draw.chance(0.15):
        draw.recursive.append(kind)
        body = (*body, again(draw, kind, draw.random.choice(counts)))
    return body


def again(draw: Draw, kind: str, name: str) -> If:
    """Another token of the same kind, as long as a parameter can become smaller."""
    label = draw.label()
    relation = draw.random.choice(("meets", "before", "met_by", "any", "starts_before"))
    owner = draw.random.choice(("object", kind.partition(".")[0]))
    least = str(draw.random.randint(-1, 1))
    smaller = Compare("<", f"{label}.{name}", name)
    return If(Compare(">", name, least), (Child(label, relation, owner, kind), smaller), ())


def block(draw: Draw, at: int, outer: Scope, most: int, depth: int, with_resources: bool) -> Body:
    """Some statements."""
    random = draw.random
    scope = list(outer)
    body: list[Statement] = []
    for _ in range(random.randint(1, most)):
        what = random.random()
        if what < 0.4 and at + 1 < len(draw.kinds):
            body.append(child(draw, at, scope))
        elif what < 0.5:
            variable = parameter(draw, f"v{draw.label()}")
            body.append(Local(variable))
            scope.append((variable.name, "wide" if variable.is_wide else variable.type))
            scope += fields(draw, variable.name, variable.type)
        elif what < 0.7 and depth < 2:
            test = decided_claim(draw, scope)
            if test is not None:
                then = block(draw, at, scope, 2, depth + 1, with_resources)
                otherwise = block(draw, at, scope, 2, depth + 1, with_resources) if draw.chance(0.4) else ()
                body.append(If(test, then, otherwise))
        elif what < 0.75:
            labels = sorted({name.partition(".")[0] for name, type_ in scope if "." in name and type_ == "time"})
            if len(labels) > 1:
                origin, target = random.sample(labels, 2)
                body.append(Relate(origin, random.choice(list(RELATIONS)), target))
        elif what < 0.9 and with_resources:
            body += charge(draw, scope)
        else:
            body.append(claim(draw, scope))
    return tuple(body)


def child(draw: Draw, at: int, scope: Scope) -> Child:
    """A child of a later kind, on the own object, an object that a variable holds, or any."""
    random = draw.random
    kind = random.choice(draw.kinds[at + 1 :])
    owner = kind.partition(".")[0]
    owners = [owner, owner, *(thing.name for thing in draw.things if thing.class_name == owner)]
    owners += ["object"] * 2 if draw.kinds[at].startswith(f"{owner}.") else []
    owners += [name for name, type_ in scope if type_ == owner and "." not in name]
    label = draw.label()
    scope += scope_of(draw, kind, f"{label}.")
    return Child(label, random.choice(list(RELATIONS)), random.choice(owners), kind)


def charge(draw: Draw, scope: Scope) -> Body:
    """A use of a resource, with a quantity that is known."""
    random = draw.random
    thing = random.choice([thing for thing in draw.things if thing.class_name in RESOURCES])
    amount = f"{random.randint(1, 2)}.0"
    if thing.class_name == "CBReusable":
        return (Call("uses", (thing.name, amount, "start", "end")),)
    label = draw.label()
    kind = f"{thing.class_name}.{draw.harm if thing.class_name == 'Reservoir' else RESOURCES[thing.class_name][0]}"
    owner = random.choice((thing.name, thing.class_name))
    if thing.class_name == "Reservoir":
        relation = random.choice(("starts", "ends", "contains_start", "contains"))
        return (Child(label, relation, owner, kind), Compare("==", f"{label}.quantity", amount))
    scope += [(f"{label}.start", "time"), (f"{label}.end", "time"), (f"{label}.duration", "span")]
    relation = random.choice(("equals", "starts", "ends", "contains", "meets"))
    made: Body = (Child(label, relation, owner, kind), Compare("<=", f"{label}.duration", str(random.randint(1, 4))))
    return made if thing.class_name == "Unary" else (*made, Compare("==", f"{label}.quantity", amount))


# ---- script ----


def aim(draw: Draw, label: str) -> Aim:
    """A token of the script."""
    random = draw.random
    kind = random.choice(draw.kinds)
    owner = kind.partition(".")[0]
    owners = [owner, *(thing.name for thing in draw.things if thing.class_name == owner)]
    how = random.choice(("goal", "goal", "goal", "fact", "rejectable"))
    return Aim(label, how, random.choice(owners), kind, how != "rejectable" and draw.chance(0.1))


def script(draw: Draw, aims: list[Aim]) -> tuple[list[Variable], list[Claim | Relate]]:
    """What the script assigns and claims."""
    random = draw.random
    assigned: list[Variable] = []
    claims: list[Claim | Relate] = []
    for each in aims:
        if draw.chance(0.5):
            low = random.randint(0, draw.end - 1)
            times = tuple(range(low, random.randint(low, draw.end) + 1))
            assigned.append(Variable(f"{each.label}.start", "int", times))
        for variable in draw.predicates[each.kind].parameters:
            values = variable.values
            if values and not variable.is_wide and draw.chance(0.3):
                assigned.append(Variable(f"{each.label}.{variable.name}", variable.type, (random.choice(values),)))
    firm = [each for each in aims if each.how != "rejectable"]
    scope = [pair for each in firm for pair in scope_of(draw, each.kind, f"{each.label}.")]
    scope += [(each.name, each.type) for each in draw.globals]
    for _ in range(random.randint(0, 2)):
        if len(firm) > 1 and draw.chance(0.3):
            origin, target = random.sample(firm, 2)
            claims.append(Relate(origin.label, random.choice(list(RELATIONS)), target.label))
        elif firm:
            claims.append(claim(draw, scope))
    return assigned, claims


def help_reservoirs(draw: Draw, aims: list[Aim], assigned: list[Variable]) -> None:
    """What helps reservoirs, at times that are more or less known."""
    how = "produce" if draw.harm == "consume" else "consume"
    for thing in draw.things:
        for _ in range(draw.random.choice((0, 1, 2)) if thing.class_name == "Reservoir" else 0):
            label = draw.label()
            low = draw.random.randint(0, draw.end)
            times = tuple(range(low, min(low + draw.random.randint(0, 4), draw.end) + 1))
            aims.append(Aim(label, "goal", thing.name, f"Reservoir.{how}", False))
            assigned.append(Variable(f"{label}.time", "int", times))
            assigned.append(Variable(f"{label}.quantity", "float", (float(draw.random.randint(1, 2)),)))
