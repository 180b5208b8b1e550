"""Small random models as data: what is written down as NDDL, and what a checker knows without reading NDDL."""

from dataclasses import dataclass
from random import Random

# (a, b, gap): b - a >= gap; a point is o(rigin) or t(arget), then its s(tart) or e(nd).
RELATIONS: dict[str, tuple[tuple[str, str, int], ...]] = {
    "any": (),
    "before": (("oe", "ts", 0),),
    "after": (("te", "os", 0),),
    "meets": (("oe", "ts", 0), ("ts", "oe", 0)),
    "met_by": (("te", "os", 0), ("os", "te", 0)),
    "starts": (("os", "ts", 0), ("ts", "os", 0)),
    "ends": (("oe", "te", 0), ("te", "oe", 0)),
    "equals": (("os", "ts", 0), ("ts", "os", 0), ("oe", "te", 0), ("te", "oe", 0)),
    "contains": (("os", "ts", 0), ("te", "oe", 0)),
    "contained_by": (("ts", "os", 0), ("oe", "te", 0)),
    "starts_before": (("os", "ts", 1),),
    "ends_after": (("te", "oe", 1),),
    "starts_during": (("ts", "os", 0), ("os", "te", 1)),
    "contains_end": (("os", "te", 1), ("te", "oe", 0)),
}
LINKS = ("eq", "neq", "lt", "leq")


@dataclass(frozen=True)
class Wish:
    """A child that a rule asks for: on the own object or on any, its `x` linked to that of the master."""

    relation: str
    is_own: bool
    predicate: str
    link: str | None


@dataclass(frozen=True)
class Behaviour:
    """The rule of a predicate: durations, children, and one more child if `x` has a value."""

    shortest: int
    longest: int
    wishes: tuple[Wish, ...]
    guarded: tuple[int, Wish] | None


@dataclass(frozen=True)
class Aim:
    """A token of the script; `timeline` None: any."""

    kind: str
    timeline: str | None
    predicate: str
    earliest: int
    latest: int


@dataclass(frozen=True)
class Model:
    """Everything; parameters `x` are 0 to 2, every class is a timeline."""

    behaviours: dict[str, Behaviour]
    timelines: tuple[str, ...]
    aims: tuple[Aim, ...]


def random_model(seed: int) -> Model:
    """Rules ask for later predicates only, so that every chain of children ends."""
    random = Random(seed)
    names = [f"p{i}" for i in range(random.randint(2, 4))]

    def wish(i: int) -> Wish:
        link = random.choice(LINKS) if random.random() < 0.5 else None
        return Wish(random.choice(list(RELATIONS)), random.random() < 0.5, random.choice(names[i + 1 :]), link)

    behaviours = {}
    for i, name in enumerate(names):
        shortest = random.randint(1, 3)
        wishes = tuple(wish(i) for _ in range(random.randint(0, 2))) if i + 1 < len(names) else ()
        guarded = (random.randint(0, 2), wish(i)) if i + 1 < len(names) and random.random() < 0.5 else None
        behaviours[name] = Behaviour(shortest, shortest + random.randint(0, 4), wishes, guarded)
    timelines = tuple(f"t{i}" for i in range(random.randint(1, 3)))
    aims = []
    for _ in range(random.randint(1, 4)):
        earliest = random.randint(0, 20)
        kind = random.choice(("goal", "goal", "fact", "rejectable"))
        where = random.choice((None, *timelines))
        aims.append(Aim(kind, where, random.choice(names), earliest, earliest + random.randint(0, 15)))
    return Model(behaviours, timelines, tuple(aims))


def written(model: Model) -> str:
    """A model as NDDL."""
    lines = ["class T extends Timeline {"]
    lines += [f"    predicate {name} {{ int x = [0 2]; }}" for name in model.behaviours]
    lines += ["}"]
    for name, behaviour in model.behaviours.items():
        body = [f"duration >= {behaviour.shortest};", f"duration <= {behaviour.longest};"]
        body += [text_of(wish, f"c{i}") for i, wish in enumerate(behaviour.wishes)]
        if behaviour.guarded is not None:
            value, wish = behaviour.guarded
            body.append(f"if (x == {value}) {{ {text_of(wish, 'g')} }}")
        lines.append(f"T::{name} {{ {' '.join(body)} }}")
    lines += [f"T {name} = new T();" for name in model.timelines] + ["close();"]
    for i, aim in enumerate(model.aims):
        lines.append(f"{aim.kind}({aim.timeline or 'T'}.{aim.predicate} a{i});")
        lines.append(f"a{i}.start = [{aim.earliest} {aim.latest}];")
    return "\n".join(lines) + "\n"


def text_of(wish: Wish, label: str) -> str:
    """A child and its link, as statements of a rule."""
    made = f"{wish.relation}({'object' if wish.is_own else 'T'}.{wish.predicate} {label});"
    return made if wish.link is None else f"{made} {wish.link}(x, {label}.x);"
