"""The checked meaning of a model: types, classes, predicates, rules, and what every name refers to.

Built by `nddl_lang.analysis.analyse`; read by the compiler, the linter and the language server.
"""

from dataclasses import dataclass, field
from enum import Enum

from nddl_lang.syntax.nodes import (
    ClassDecl,
    ConstructorDecl,
    EnumDecl,
    Expr,
    FormalParameter,
    Identifier,
    PredicateDecl,
    RuleDecl,
    TypedefDecl,
    VariableDecl,
)
from nddl_lang.text.source import Span

INFINITY = 4503599627370495  # 2**52 - 1, the bound of EUROPA's arithmetic on 64-bit builds


class Kind(Enum):
    """The shape of a value."""

    INT = "int"
    FLOAT = "float"
    BOOL = "bool"
    STRING = "string"
    SYMBOL = "symbol"
    ENUM = "enum"
    OBJECT = "object"


@dataclass(frozen=True, slots=True)
class Interval:
    """All numbers from `lower` to `upper`, both included."""

    lower: float | int
    upper: float | int


@dataclass(frozen=True, slots=True)
class Values:
    """A finite set of values: numbers, booleans, texts, or enum values by name, in written order."""

    items: tuple[float | int | bool | str, ...]


Domain = Interval | Values


@dataclass(frozen=True, slots=True)
class Type:
    """A type as written: `name` is the typedef's, `base` the basic, enum or class name below it."""

    kind: Kind
    name: str
    base: str
    restriction: Domain | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Enumeration:
    """An enum; values in written order."""

    name: str
    values: tuple[str, ...]
    node: EnumDecl | None
    span: Span | None
    doc: str | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Typedef:
    """A named restriction of a type."""

    name: str
    type: Type
    node: TypedefDecl | None
    span: Span | None
    doc: str | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Variable:
    """A global variable, a member, a parameter or a rule local; `initialiser` as written."""

    name: str
    type: Type
    span: Span | None
    initialiser: Expr | None = None
    node: VariableDecl | FormalParameter | None = None
    doc: str | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Constructor:
    """A constructor; `node` is None for the implicit empty one and for those of native classes."""

    class_name: str
    parameters: tuple[Variable, ...]
    node: ConstructorDecl | None
    span: Span | None


@dataclass(frozen=True, eq=False, slots=True)
class Predicate:
    """A predicate or action as class `class_name` has it: `parameters` of all levels, the ancestor's first.

    `nodes` are the declarations of all levels, the ancestor's first; `declared_in` names the classes of `nodes`.
    `is_event` marks `produce` and `consume` of a Reservoir: `time` in place of start and end.
    """

    class_name: str
    name: str
    parameters: tuple[Variable, ...]
    is_action: bool
    is_event: bool
    nodes: tuple[PredicateDecl, ...]
    declared_in: tuple[str, ...]
    span: Span | None
    doc: str | None = None

    @property
    def full_name(self) -> str:
        """`Class.predicate`, as reports print it."""
        return f"{self.class_name}.{self.name}"


@dataclass(eq=False, slots=True)
class Class:
    """A class with what it declares itself; look through `Schema.find_member` and the like for what it inherits.

    `inherited` holds the predicates of its ancestors as this class has them, under full names of its own.
    """

    name: str
    base: str | None
    members: dict[str, Variable] = field(default_factory=dict)
    constructors: list[Constructor] = field(default_factory=list)
    predicates: dict[str, Predicate] = field(default_factory=dict)
    inherited: dict[str, Predicate] = field(default_factory=dict)
    is_native: bool = False
    is_defined: bool = True
    node: ClassDecl | None = None
    span: Span | None = None
    doc: str | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Rule:
    """A rule on the tokens of `predicate`."""

    predicate: Predicate
    node: RuleDecl


# ---- what a name refers to ----


@dataclass(frozen=True, slots=True)
class EnumValue:
    """A value of an enum."""

    enum: str
    value: str


@dataclass(frozen=True, eq=False, slots=True)
class GlobalReference:
    """A global variable (an object is a global variable of a class type)."""

    variable: Variable


@dataclass(frozen=True, eq=False, slots=True)
class LocalReference:
    """A rule local, a foreach variable, or a constructor's formal parameter."""

    variable: Variable


@dataclass(frozen=True, slots=True)
class ClassReference:
    """A class, as in `C.close()` and `C.p`."""

    name: str


@dataclass(frozen=True, eq=False, slots=True)
class Label:
    """A token with a name: a goal at top level, a child in a rule; `this` is the rule's own token."""

    name: str
    predicate: Predicate
    span: Span | None


@dataclass(frozen=True, eq=False, slots=True)
class TokenReference:
    """A token; used as a value it means its `state`."""

    label: Label


@dataclass(frozen=True, eq=False, slots=True)
class TokenVariableReference:
    """A variable of a token: a parameter or one of state, object, start, end, duration, time."""

    label: Label
    name: str
    type: Type


@dataclass(frozen=True, eq=False, slots=True)
class MemberReference:
    """Member `members[0].members[1]...` of the object that `base` denotes.

    `base` None is the constructor's own object; without members it is that object itself (`this`).
    """

    base: "GlobalReference | LocalReference | TokenVariableReference | None"
    members: tuple[Variable, ...]


Reference = (
    EnumValue
    | GlobalReference
    | LocalReference
    | ClassReference
    | TokenReference
    | TokenVariableReference
    | MemberReference
)


@dataclass(eq=False, slots=True)
class Schema:
    """All declarations of a model, native ones included, by name; dictionaries keep the order of declaration."""

    enums: dict[str, Enumeration] = field(default_factory=dict)
    enum_values: dict[str, EnumValue] = field(default_factory=dict)
    typedefs: dict[str, Typedef] = field(default_factory=dict)
    classes: dict[str, Class] = field(default_factory=dict)
    globals: dict[str, Variable] = field(default_factory=dict)
    rules: list[Rule] = field(default_factory=list)
    goals: dict[str, Label] = field(default_factory=dict)

    def ancestry(self, name: str) -> list[str]:
        """Class `name`, its base, and so on up to the root."""
        chain: dict[str, None] = {}
        current: str | None = name
        while current is not None and current in self.classes and current not in chain:
            chain[current] = None
            current = self.classes[current].base
        return list(chain)

    def is_subclass(self, name: str, ancestor: str) -> bool:
        """Whether class `name` is `ancestor` or extends it."""
        return ancestor in self.ancestry(name)

    def find_member(self, class_name: str, member: str) -> Variable | None:
        """Member `member` of `class_name`, inherited ones included."""
        for name in self.ancestry(class_name):
            if (found := self.classes[name].members.get(member)) is not None:
                return found
        return None

    def find_predicate(self, class_name: str, predicate: str) -> Predicate | None:
        """Predicate `predicate` as `class_name` has it, declared or inherited."""
        owner = self.classes.get(class_name)
        if owner is None:
            return None
        return owner.predicates.get(predicate) or owner.inherited.get(predicate)


@dataclass(frozen=True, eq=False, slots=True)
class Chosen:
    """The constructor that a `new` or a `super(...)` calls."""

    constructor: Constructor


@dataclass(frozen=True, eq=False, slots=True)
class Target:
    """The predicate that an instance names, and where its object comes from.

    `object` is "own" (the rule token's object), "any" (any instance of the class), or the reference to an object.
    """

    predicate: Predicate
    object: Reference | str
    label: Label | None


@dataclass(eq=False, slots=True)
class SideTables:
    """What the passes found out about nodes, keyed by the node itself."""

    references: dict[object, Reference] = field(default_factory=dict)  # PathExpr | Identifier -> what it names
    types: dict[object, Type] = field(default_factory=dict)  # Expr -> its type
    constructors: dict[object, Chosen] = field(default_factory=dict)  # NewExpr | SuperCall -> constructor
    targets: dict[object, Target] = field(default_factory=dict)  # Instance -> predicate and object
    origins: dict[object, Label] = field(default_factory=dict)  # Relation -> its origin token
    existing: dict[object, Label] = field(default_factory=dict)  # Relation with a bare target -> that token
    locals: dict[object, Variable] = field(default_factory=dict)  # Declarator | Foreach -> its variable
    declared: dict[Identifier, object] = field(default_factory=dict)  # name at its declaration -> what it declares
    sampled: dict[object, Reference] = field(default_factory=dict)  # CallExpr, CallConstraint -> sampled parameter
    predicates: dict[RuleDecl, Predicate] = field(default_factory=dict)  # rule -> the predicate that it is on
    type_names: dict[Identifier, Type] = field(default_factory=dict)  # type or class name where it is used
