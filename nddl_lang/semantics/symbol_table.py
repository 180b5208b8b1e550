"""Symbol table of a script, which records what the present statement reads and writes.

A model is a script: a statement means what it means after the statements above it. Everything that a statement can see
of them is an entry, looked up by table and name. What it looked up (with the answers) and what it put are recorded, so
that the statement need not be analysed again while it would get the same answers.
"""

from collections.abc import Iterator, Mapping
from typing import Any, cast

from nddl_lang.semantics.natives import NATIVE_CLASSES, NATIVE_ENUM, NATIVE_ENUM_VALUES
from nddl_lang.semantics.schema import (
    Class,
    Domain,
    Enumeration,
    EnumValue,
    Label,
    Predicate,
    Rule,
    Schema,
    Typedef,
    Variable,
)
from nddl_lang.text.source import Span

Entry = tuple[str, str]

_RULE = "rule"
_DECLARED = frozenset({"class", "enum", "value", "typedef", "global", "goal"})
ALL_NAMES: Entry = ("names", "*")
_EVERYTHING = "*"


def doubt(name: str = _EVERYTHING) -> dict[Entry, object]:
    """The entry by which `name`, or every name, is one that text not understood may declare."""
    return {("doubt", name): True}


def declare_below(name: str, span: Span) -> dict[Entry, object]:
    """The entry by which the script declares `name` somewhere."""
    return {("below", name): span}


class LeftBehind:
    """What a statement leaves behind: entries that others can look up, declarations among them, and rules.

    `number` tells the names that it declares from all others; 0 where it declares none.
    """

    __slots__ = ("declared", "entries", "number", "rules")

    def __init__(self, writes: dict[Entry, object]) -> None:
        self.entries = {entry: value for entry, value in writes.items() if entry[0] != _RULE}
        self.rules = [cast(Rule, value) for entry, value in writes.items() if entry[0] == _RULE]
        self.declared = [(*entry, value) for entry, value in self.entries.items() if entry[0] in _DECLARED]
        names = tuple([each[:2] for each in self.declared])
        self.number = hash(names) if names else 0


_NATIVE = LeftBehind(
    {
        **{("class", name): native for name, native in NATIVE_CLASSES.items()},
        ("enum", NATIVE_ENUM.name): NATIVE_ENUM,
        **{("value", name): value for name, value in NATIVE_ENUM_VALUES.items()},
    }
)


class SymbolTable:
    """The entries of a script up to one of its statements; `schema` holds the declarations among them."""

    def __init__(self) -> None:
        self.schema = schema = Schema()
        self._declared: dict[str, dict[str, Any]] = {
            "class": schema.classes,
            "enum": schema.enums,
            "value": schema.enum_values,
            "typedef": schema.typedefs,
            "global": schema.globals,
            "goal": schema.goals,
        }
        self.reads: dict[Entry, object] = {}
        self.writes: dict[Entry, object] = {}
        self._entries: dict[Entry, object] = {ALL_NAMES: 0}
        self._names = 0
        self.replay(_NATIVE)

    # ---- the record ----

    def begin(self) -> None:
        """Start the record of the next statement."""
        self.reads, self.writes = {}, {}
        self._entries[ALL_NAMES] = self._names

    def answers(self, reads: dict[Entry, object]) -> bool:
        """Whether a statement that got these answers would get the same ones now."""
        entries = self._entries
        entries[ALL_NAMES] = self._names
        for entry, answer in reads.items():
            current = entries.get(entry)
            if current is not answer and current != answer:
                return False
        return True

    def replay(self, left: LeftBehind) -> None:
        """Leave behind what a statement left behind when it was analysed."""
        if left.entries:
            self._entries.update(left.entries)
        for table, name, value in left.declared:
            self._declared[table][name] = value
        if left.rules:
            self.schema.rules += left.rules
        if left.number:
            self._number(left)

    def leave(self) -> LeftBehind:
        """What the present statement leaves behind, now that all of it is analysed."""
        left = LeftBehind(self.writes)
        self._number(left)
        return left

    def _number(self, left: LeftBehind) -> None:
        if left.number:
            self._names = hash((self._names, left.number))

    def entries(self) -> dict[Entry, object]:
        """All entries as they stand."""
        return dict(self._entries)

    def suppose(self, entries: Mapping[Entry, object]) -> None:
        """State entries about the script as a whole, which no statement puts."""
        self._entries.update(entries)

    def look(self, table: str, name: str) -> object:
        """The value of an entry, None where nothing has put it."""
        entry = (table, name)
        value = self._entries.get(entry)
        if entry not in self.reads and entry not in self.writes:
            self.reads[entry] = value
        return value

    def put(self, table: str, name: str, value: object) -> None:
        """Put an entry; a declaration enters the schema."""
        self.writes[table, name] = self._entries[table, name] = value
        self._enter(table, name, value)

    def _enter(self, table: str, name: str, value: object) -> None:
        declared = self._declared.get(table)
        if declared is not None:
            declared[name] = value
        elif table == _RULE:
            self.schema.rules.append(cast(Rule, value))

    # ---- declarations ----

    def find_class(self, name: str) -> Class | None:
        """The class of that name, native or declared above."""
        return cast(Class | None, self.look("class", name))

    def find_enum(self, name: str) -> Enumeration | None:
        """The enum of that name."""
        return cast(Enumeration | None, self.look("enum", name))

    def find_value(self, name: str) -> EnumValue | None:
        """The enum value of that name."""
        return cast(EnumValue | None, self.look("value", name))

    def find_typedef(self, name: str) -> Typedef | None:
        """The typedef of that name."""
        return cast(Typedef | None, self.look("typedef", name))

    def find_global(self, name: str) -> Variable | None:
        """The global variable of that name."""
        return cast(Variable | None, self.look("global", name))

    def find_goal(self, name: str) -> Label | None:
        """The token of the script with that name."""
        return cast(Label | None, self.look("goal", name))

    def ancestry(self, name: str) -> Iterator[Class]:
        """Class `name`, its base, and so on up to the root."""
        seen: set[str] = set()
        current: str | None = name
        while current is not None and current not in seen:
            seen.add(current)
            found = self.find_class(current)
            if found is None:
                return
            yield found
            current = found.base

    def is_subclass(self, name: str, ancestor: str) -> bool:
        """Whether class `name` is `ancestor` or extends it, as far as is known: one that is partial may do so."""
        return any(owner.name == ancestor for owner in self.ancestry(name)) or self._lacks_base(name)

    def _lacks_base(self, name: str) -> bool:
        """Whether what a class extends was not understood."""
        bases = (owner.node.base for owner in self.ancestry(name) if owner.node is not None)
        return any(base is not None and self.find_class(base.name) is None for base in bases)

    def find_member(self, class_name: str, member: str) -> Variable | None:
        """Member `member` of a class, inherited ones included."""
        for owner in self.ancestry(class_name):
            if (found := owner.members.get(member)) is not None:
                return found
        return None

    def find_predicate(self, class_name: str, predicate: str) -> Predicate | None:
        """Predicate `predicate` as a class has it, declared or inherited."""
        owner = self.find_class(class_name)
        if owner is None:
            return None
        return owner.predicates.get(predicate) or owner.inherited.get(predicate)

    def names(self, *tables: str) -> Iterator[str]:
        """All names declared above in these tables, native ones included."""
        self.look(*ALL_NAMES)
        for table in tables:
            yield from self._declared[table]

    # ---- what earlier mistakes make uncertain ----

    def is_doubtful(self, name: str) -> bool:
        """Whether an earlier mistake may be why `name` is unknown: text not understood, or a faulty declaration."""
        return (
            self.look("doubt", name) is not None
            or self.look("doubt", _EVERYTHING) is not None
            or self.look("faulty", name) is not None
        )

    def put_faulty(self, name: str) -> None:
        """Note that the declaration of `name` was complained about."""
        self.put("faulty", name, True)

    def is_partial(self, class_name: str) -> bool:
        """Whether some of what the class declares or inherits was not understood."""
        return any(self.look("partial", owner.name) is not None for owner in self.ancestry(class_name))

    def put_partial(self, class_name: str) -> None:
        """Note that some of the class was not understood."""
        self.put("partial", class_name, True)

    def declared_below(self, name: str) -> Span | None:
        """Where the script declares `name` further down."""
        return cast(Span | None, self.look("below", name))

    # ---- what the script has done ----

    def closed_at(self, class_name: str) -> Span | None:
        """The statement that closed the class, or all classes."""
        return cast(Span | None, self.look("closed", _EVERYTHING) or self.look("closed", class_name))

    def put_closed(self, class_name: str | None, span: Span) -> None:
        """Note that no further objects of the class (None: of any class) may join."""
        self.put("closed", class_name or _EVERYTHING, span)

    def has_objects(self, class_name: str) -> bool:
        """Whether an object of the class may exist."""
        return self.look("objects", class_name) is not None

    def put_object(self, class_name: str) -> None:
        """Note that an object of the class may exist now."""
        for owner in list(self.ancestry(class_name)):
            if self.look("objects", owner.name) is None:
                self.put("objects", owner.name, True)

    def base_domain(self, variable: str) -> Domain | None:
        """A superset of the base domain of `a`, `g.x`, None where nothing is known."""
        return cast(Domain | None, self.look("domain", variable))

    def put_base_domain(self, variable: str, domain: Domain | None) -> None:
        """Note what the base domain of a variable lies within."""
        self.put("domain", variable, domain)

    def token_kind(self, goal: str) -> str:
        """What made a token of the script: goal, fact, rejectable, or child (of a relation)."""
        return cast(str, self.look("kind", goal))

    def put_token(self, goal: str, kind: str, state: str) -> None:
        """Note a new token of the script."""
        self.put("kind", goal, kind)
        self.put("state", goal, state)

    def token_state(self, goal: str) -> str | None:
        """The state of a token of the script, None where it is not known for certain."""
        return cast(str | None, self.look("state", goal))

    def put_token_state(self, goal: str, state: str | None) -> None:
        """Note the state of a token of the script."""
        self.put("state", goal, state)
