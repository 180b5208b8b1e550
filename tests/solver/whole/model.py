"""Small models as data: nddlc gets the text that is written from them, the judges the data, and nothing of nddlc."""

from dataclasses import dataclass

# What relations say, as pairs (a, b, gap): b - a >= gap. Points: s(tart) and e(nd) of o(rigin) and t(arget).
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
    "parallels": (("os", "ts", 0), ("oe", "te", 0)),
    "paralleled_by": (("ts", "os", 0), ("te", "oe", 0)),
    "starts_before": (("os", "ts", 1),),
    "starts_after": (("ts", "os", 1),),
    "starts_before_end": (("os", "te", 1),),
    "starts_during": (("ts", "os", 0), ("os", "te", 1)),
    "ends_before": (("oe", "te", 1),),
    "ends_after": (("te", "oe", 1),),
    "ends_after_start": (("ts", "oe", 1),),
    "ends_during": (("ts", "oe", 1), ("oe", "te", 0)),
    "contains_start": (("os", "ts", 0), ("ts", "oe", 1)),
    "contains_end": (("os", "te", 1), ("te", "oe", 0)),
}
TIMES = ("start", "end", "duration")
RESOURCES = {"Reusable": ("uses",), "Unary": ("use",), "Reservoir": ("produce", "consume"), "CBReusable": ()}
EVENTS = ("Reservoir.produce", "Reservoir.consume")


@dataclass(frozen=True)
class Variable:
    """A parameter, local, global or member: a finite set of `values`, or from the first to the second if `is_wide`.

    `type` is int, float, bool, the enumeration E, or the name of a class; values are numbers or names.
    """

    name: str
    type: str
    values: tuple[int | float | str, ...]
    is_wide: bool = False


@dataclass(frozen=True)
class Compare:
    """`left op right`, each a name, a path, a constant, or two of these with an operator and blanks between."""

    op: str
    left: str
    right: str


@dataclass(frozen=True)
class Call:
    """A constraint by name."""

    op: str
    arguments: tuple[str, ...]


@dataclass(frozen=True)
class Junction:
    """Claims joined by && or ||."""

    op: str
    parts: "tuple[Claim, ...]"


@dataclass(frozen=True)
class Truth:
    """A bool as a claim."""

    name: str


Claim = Compare | Call | Junction | Truth


@dataclass(frozen=True)
class Child:
    """`relation(owner.predicate label);`: owner is `object`, a class, or something that is an object."""

    label: str
    relation: str
    owner: str
    kind: str  # Class.predicate


@dataclass(frozen=True)
class Relate:
    """`origin relation target;` between tokens that are there."""

    origin: str
    relation: str
    target: str


@dataclass(frozen=True)
class Local:
    """A variable of the rule; a class as type: any of its objects."""

    variable: Variable


@dataclass(frozen=True)
class If:
    """A guard and its branches."""

    condition: Claim
    then: "Body"
    otherwise: "Body"


Statement = Claim | Child | Relate | Local | If
Body = tuple[Statement, ...]


@dataclass(frozen=True)
class Predicate:
    """Parameters and what always holds of its tokens."""

    name: str
    parameters: tuple[Variable, ...]
    claims: tuple[Claim, ...]


@dataclass(frozen=True)
class Class:
    """A class: a timeline or not, the names of its int members, its predicates."""

    name: str
    is_timeline: bool
    members: tuple[str, ...]
    predicates: tuple[Predicate, ...]


@dataclass(frozen=True)
class Thing:
    """An object: for each member its values; for a resource the arguments of its constructor."""

    name: str
    class_name: str
    members: tuple[tuple[int, ...], ...]
    limits: tuple[float, ...] = ()


@dataclass(frozen=True)
class Aim:
    """A token of the script; owner is a class or an object; `is_active`: the script activates it."""

    label: str
    how: str  # goal, fact, rejectable
    owner: str
    kind: str  # Class.predicate
    is_active: bool


@dataclass(frozen=True)
class Model:
    """Everything. `claims` are those of the script, about globals and aims, with assignments `path = values`."""

    colours: tuple[str, ...]
    classes: tuple[Class, ...]
    things: tuple[Thing, ...]
    globals: tuple[Variable, ...]
    rules: tuple[tuple[str, Body], ...]
    aims: tuple[Aim, ...]
    assigned: tuple[Variable, ...]
    claims: tuple[Claim | Relate, ...]

    def predicate(self, kind: str) -> Predicate:
        """The predicate called Class.predicate."""
        owner, _, name = kind.partition(".")
        if owner in RESOURCES:
            wide = Variable("quantity", "float", (1.0, 1.0) if owner == "Unary" else (0.0, 1000.0), is_wide=True)
            return Predicate(name, (wide,), ())
        return next(each for each in self.class_of(owner).predicates if each.name == name)

    def class_of(self, name: str) -> Class:
        """The class of that name."""
        return next(each for each in self.classes if each.name == name)

    def bodies(self, kind: str) -> list[Body]:
        """The rules of a predicate."""
        return [body for name, body in self.rules if name == kind]


# ---- as text ----


def written(model: Model) -> str:
    """The model as NDDL."""
    lines = [f"enum E {{ {', '.join(model.colours)} }}"]
    lines += [f"class {each.name};" for each in model.classes]
    for each in model.classes:
        lines.append(f"class {each.name}{' extends Timeline' if each.is_timeline else ''} {{")
        lines += [f"    int {name};" for name in each.members]
        for predicate in each.predicates:
            parameters = " ".join(declared(variable) for variable in predicate.parameters)
            lines.append(f"    predicate {predicate.name} {{ {parameters} {body_text(predicate.claims)} }}")
        lines.append("}")
    for thing in model.things:
        limits = ", ".join(map(str, thing.limits))
        lines.append(f"{thing.class_name} {thing.name} = new {thing.class_name}({limits});")
        if thing.class_name not in RESOURCES:
            for name, values in zip(model.class_of(thing.class_name).members, thing.members, strict=True):
                lines.append(f"{thing.name}.{name} = {domain(Variable(name, 'int', values))};")
    lines.append("close();")
    lines += [declared(variable) for variable in model.globals]
    lines += [f"{kind.replace('.', '::')} {{ {body_text(body)} }}" for kind, body in model.rules]
    for aim in model.aims:
        lines.append(f"{aim.how}({aim.owner}.{aim.kind.partition('.')[2]} {aim.label});")
    lines += [f"{variable.name} = {domain(variable)};" for variable in model.assigned]
    lines += [text(claim) for claim in model.claims]
    lines += [f"{aim.label}.activate();" for aim in model.aims if aim.is_active]
    return "\n".join(lines) + "\n"


def declared(variable: Variable) -> str:
    """A declaration; objects and truths are free if they may be anything."""
    is_free = variable.type not in ("int", "float") and not variable.values
    return f"{variable.type} {variable.name};" if is_free else f"{variable.type} {variable.name} = {domain(variable)};"


def domain(variable: Variable) -> str:
    """The values as a literal."""
    values = variable.values
    if len(values) == 1:
        return str(values[0])
    if variable.is_wide:
        return f"[{values[0]} {values[1]}]"
    if variable.type == "int" and list(values) == list(range(int(values[0]), int(values[-1]) + 1)):
        return f"[{values[0]} {values[-1]}]"
    return f"{{{', '.join(map(str, values))}}}"


def body_text(body: Body) -> str:
    """Statements, one after the other."""
    return " ".join(text(statement) for statement in body)


def text(statement: Statement) -> str:
    """A statement."""
    match statement:
        case Child(label, relation, owner, kind):
            return f"{relation}({owner}.{kind.partition('.')[2]} {label});"
        case Relate(origin, relation, target):
            return f"{origin} {relation} {target};"
        case Local(variable):
            return declared(variable)
        case If(condition, then, otherwise):
            rest = f" else {{ {body_text(otherwise)} }}" if otherwise else ""
            return f"if ({claim_text(condition)}) {{ {body_text(then)} }}{rest}"
        case _:
            return f"{claim_text(statement)};"


def claim_text(claim: Claim) -> str:
    """A claim without its semicolon."""
    match claim:
        case Compare(op, left, right):
            return f"{left} {op} {right}"
        case Call(op, arguments):
            return f"{op}({', '.join(arguments)})"
        case Junction(op, parts):
            return f" {op} ".join(claim_text(part) for part in parts)
        case Truth(name):
            return name
