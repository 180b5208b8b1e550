"""The program: a model lowered to instructions that the runtime carries out, each with its span.

Operands say where a variable is found; instructions what happens to it. Bodies of rules and the script use the same.
"""

from dataclasses import dataclass

from nddl_lang.text.source import Span

STATE, OBJECT, DURATION, START, END, FIRST_PARAMETER = range(6)  # variables of a token, in order
TOKEN_VARIABLES, TOKEN_TIMES = ("state", "object", "duration", "start", "end"), ("start", "end", "duration")


@dataclass(frozen=True, slots=True)
class DomainConstant:
    """A set of values fixed by the text.

    `kind` is int, float, bool, string, symbol, enum or object; `type_name` the enum's or class's name or the kind.
    Either `interval` is set or `values`: numbers, booleans, texts, enum values by name (objects never).
    Infinite bounds are ±(2**52 - 1).
    """

    kind: str
    type_name: str
    interval: tuple[float | int, float | int] | None
    values: tuple[float | int | bool | str, ...] | None


@dataclass(frozen=True, slots=True)
class TypeCode:
    """A variable's type: kind and type_name as in `DomainConstant`; `domain` is the restriction of a typedef."""

    kind: str
    type_name: str
    domain: DomainConstant | None


# ---- operands ----


@dataclass(frozen=True, slots=True)
class Constant:
    """An anonymous variable that holds `domain` for ever."""

    domain: DomainConstant


@dataclass(frozen=True, slots=True)
class GlobalVariable:
    """Global variable number `index`."""

    index: int


@dataclass(frozen=True, slots=True)
class LocalVariable:
    """Variable slot of the rule instance, predicate body, script or constructor (whose parameters come first)."""

    slot: int


@dataclass(frozen=True, slots=True)
class TokenVariable:
    """Variable number `variable` (STATE, OBJECT, ..., FIRST_PARAMETER + k) of the token in slot `token`.

    In a rule slot 0 is the rule's own token. In the script, slots number the named and unnamed goals in order.
    An event (produce, consume) has its `time` at START, and END equals it.
    """

    token: int
    variable: int


@dataclass(frozen=True, slots=True)
class Field:
    """Member path of an object: a proxy while the object is not decided.

    `base` None is the constructor's own object; with no `members` it is that object itself (`this`).
    """

    base: "Operand | None"
    members: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class UnionOf:
    """An anonymous variable whose domain is the union of the operands, taken now: `{a, b}` of names."""

    operands: tuple["Operand", ...]


Operand = Constant | GlobalVariable | LocalVariable | TokenVariable | Field | UnionOf


# ---- instructions of rules and script ----


@dataclass(frozen=True, slots=True)
class NewVariable:
    """Make the variable of a local slot. `name` None marks the implicit result of an expression.

    The base domain is the type's, intersected with `domain`, or with the base domain of `copy_of`.
    A slot that is filled already (in a foreach) is filled anew.
    """

    slot: int
    name: str | None
    type: TypeCode
    domain: DomainConstant | None
    copy_of: Operand | None
    span: Span


@dataclass(frozen=True, slots=True)
class NewObject:
    """Allocate an object and put it in a local slot (in a rule), or in a global (script), or nowhere.

    `slot` or `global_index` make a variable of the type `type` that holds the new object. Arguments pass their current
    domain, so pending propagation is done first. `name` is the object's name; in a constructor it follows that of the
    object under construction (`a` + `.` + `b`), in a rule the runtime makes it unique; None means no name.
    """

    class_name: str
    constructor: int  # index into Class.constructors of the program
    arguments: tuple["Operand | NewObject", ...]
    name: str | None
    slot: int | None
    global_index: int | None
    span: Span
    type: TypeCode | None = None


@dataclass(frozen=True, slots=True)
class Post:
    """Post the constraint `name` (a row of the constraint table) on the operands.

    Synonyms are resolved: `multEq`, `max`, `min` arrive as `mulEq`, `allMax`, `allMin`.
    """

    name: str
    operands: tuple[Operand, ...]
    message: str | None
    span: Span


@dataclass(frozen=True, slots=True)
class Sample:
    """Bind `target` to the mission's value of the sampled parameter `parameter`; that decides it, as `specify` does."""

    target: Operand
    parameter: str
    span: Span


@dataclass(frozen=True, slots=True)
class Child:
    """Create a token in slot `slot` and relate it to the token in slot `origin`.

    `object` is "own" (equal to the rule token's object), "any", or the operand that holds the object.
    `bounds` are the relation bounds of the dialect nddlc: one (lower, upper) pair per constraint of the relation.
    """

    slot: int
    predicate: str  # full name
    label: str | None
    role: str | None  # condition, effect
    relation: str
    origin: int
    bounds: tuple[tuple[int, int], ...]
    object: "Operand | str"
    span: Span


@dataclass(frozen=True, slots=True)
class Relate:
    """Relate two tokens that exist."""

    relation: str
    origin: int
    target: int
    bounds: tuple[tuple[int, int], ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Guard:
    """Run `then` or `otherwise` once every variable of `decided_by` is decided and `condition` has a truth value.

    The instructions that compute `condition` stand before the guard in the same body. `decided_by` holds no single
    constants; a constant with several values is never decided. A `Field` is decided once its base is (or once its
    base domain is a single value). A branch that runs later sees the slots as they were when the guard was reached
    (this matters in a foreach), and what it puts in slots is seen by nobody outside the branch.
    """

    condition: Operand
    decided_by: tuple[Operand, ...]
    then: tuple["Instruction", ...]
    otherwise: tuple["Instruction", ...]
    span: Span


@dataclass(frozen=True, slots=True)
class ObjectLoop:
    """Run `body` once per object in the collection's domain now, with the object in `slot`; freeze the domain."""

    slot: int
    collection: Operand
    body: tuple["Instruction", ...]
    span: Span


# ---- instructions of the script only ----


@dataclass(frozen=True, slots=True)
class NewGlobal:
    """Make global variable `index`; its base domain is `domain`, a copy of `copy_of`'s base domain, or the type's."""

    index: int
    name: str
    type: TypeCode
    domain: DomainConstant | None
    copy_of: Operand | None
    span: Span


@dataclass(frozen=True, slots=True)
class Assign:
    """Intersect the base domain of `target` with `domain` or with that of `value`; a single value decides it.

    Also found in bodies of predicates (`duration = [5 9];`) and constructors. A `value` that is a formal parameter
    of a constructor or a `NewObject` has one domain only, the current one. `g.state = ACTIVE` arrives as a `Call`.
    """

    target: Operand
    name: str  # of the target, for messages
    domain: DomainConstant | None
    value: "Operand | NewObject | None"
    span: Span


@dataclass(frozen=True, slots=True)
class NewToken:
    """A goal, fact or rejectable (`kind`); `object` as in `Child` (never "own").

    `a before (t.r c);` at top level arrives as a goal and a `Relate`.
    """

    slot: int
    predicate: str
    label: str | None
    kind: str
    object: "Operand | str"
    span: Span


@dataclass(frozen=True, slots=True)
class Call:
    """A method call: target is a token slot, an operand, a class name, or nothing (`close()`).

    Methods: activate, merge, reject, cancel (of a token); specify, reset, close (of a variable); constrain, free,
    set_capacity, set_limit (of an object); close (of a class, of everything).
    Arguments are operands or, for tokens, `TokenVariable(slot, STATE)`.
    """

    method: str
    token: int | None
    variable: Operand | None
    class_name: str | None
    arguments: tuple[Operand, ...]
    name: str  # of the target, for messages
    span: Span


Instruction = (
    NewVariable | NewObject | Post | Sample | Child | Relate | Guard | ObjectLoop | NewGlobal | Assign | NewToken | Call
)


# ---- declarations ----


@dataclass(frozen=True, slots=True)
class MemberCode:
    """A member of a class, inherited ones included. Initialisers are assignments of the constructors (no `domain`)."""

    name: str
    type: TypeCode
    domain: DomainConstant | None


@dataclass(frozen=True, slots=True)
class ParameterCode:
    """A parameter of a predicate; `copy_of` where its initialiser is a name."""

    name: str
    type: TypeCode
    domain: DomainConstant | None
    copy_of: Operand | None
    span: Span | None


@dataclass(frozen=True, slots=True)
class SuperCode:
    """`super(...)`: run constructor number `constructor` of class `class_name`."""

    class_name: str
    constructor: int
    arguments: tuple[Operand, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class ConstructorCode:
    """Formal parameters occupy local slots 0..n-1 of `slots`; targets are `Field(None, (member,))`.

    `super()` is written out unless the base class has no constructor without parameters. Besides `Assign`, the
    dialect nddlc may need `NewVariable` and `Post` here, for members initialised by an expression.
    """

    parameters: tuple[TypeCode, ...]
    body: tuple["SuperCode | Instruction", ...]
    span: Span | None
    slots: int = 0


@dataclass(frozen=True, slots=True)
class ClassCode:
    """A class; `members` of the ancestor first. `native` names the built-in behaviour it inherits, if any:
    Timeline, Reservoir, Reusable, CBReusable, Unary."""

    name: str
    base: str | None
    members: tuple[MemberCode, ...]
    constructors: tuple[ConstructorCode, ...]
    native: str | None
    span: Span | None


@dataclass(frozen=True, slots=True)
class PredicateCode:
    """A predicate as class `class_name` has it: one entry per class that declares or inherits it.

    `body` holds constraints and assignments of all levels (token slot 0), the ancestor's first; it runs when a token
    is made, after all its variables are. Parameters keep their numbers in subclasses.
    `effects` lists what an action's rules yield in any case, for support: full predicate names in order of appearance.
    """

    name: str  # full name, Class.predicate
    class_name: str
    parameters: tuple[ParameterCode, ...]
    body: tuple[Instruction, ...]
    body_slots: int
    body_tokens: int
    is_action: bool
    is_event: bool
    effects: tuple[str, ...]
    rules: tuple[int, ...]  # indices into Program.rules that fire on it, the ancestor's first
    span: Span | None


@dataclass(frozen=True, slots=True)
class RuleCode:
    """A rule body; `slots` variable slots and `tokens` token slots per instance (token slot 0 is the rule's own).

    `declared_at` counts the instructions of the script that stand above the rule: a token activated by one of them
    (index < declared_at) does not fire it. It also fires on tokens of subclasses, see `PredicateCode.rules`.
    """

    predicate: str
    body: tuple[Instruction, ...]
    slots: int
    tokens: int
    span: Span
    declared_at: int = 0


@dataclass(frozen=True, slots=True)
class ParameterSite:
    """A sampled parameter and every place that uses it; `default` is the range the model gives, if any."""

    name: str
    kind: str
    default: DomainConstant | None
    uses: tuple[Span, ...]


@dataclass(frozen=True, slots=True)
class Program:
    """A compiled model."""

    enums: tuple[tuple[str, tuple[str, ...]], ...]
    classes: tuple[ClassCode, ...]
    predicates: tuple[PredicateCode, ...]
    rules: tuple[RuleCode, ...]
    globals: tuple[tuple[str, TypeCode], ...]
    script: tuple[Instruction, ...]
    script_slots: int  # implicit variables of the script
    script_tokens: int
    sampled: tuple[ParameterSite, ...]
