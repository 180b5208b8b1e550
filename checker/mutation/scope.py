"""A model's declarations in, the names that a line of a rule may write out, each with its type."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from nddl_lang.semantics.natives import NATIVE_CLASSES
from nddl_lang.semantics.schema import Class
from nddl_lang.syntax.nodes import (
    ClassDecl,
    EnumDecl,
    NewExpr,
    PathExpr,
    PredicateDecl,
    Relation,
    TypedefDecl,
    VariableDecl,
)

_NUMBERS = ("int", "float")
_TRUTH = "bool"
_OWN = "object"


@dataclass(frozen=True, slots=True)
class Shape:
    """A predicate of a class with its parameters and their types, and what else may hold of it."""

    parameters: Mapping[str, str]
    others: tuple[str, ...] = ()  # predicates with at least these parameters
    is_event: bool = False  # it has no start and no end


@dataclass(frozen=True, eq=False, slots=True)
class LineScope:
    """What a line may name: variables of its rule and parameters, with their types, and tokens that were made before.

    `constants` are the numbers of the model, `objects` what it makes of classes, each with its class; `members` are the
    variables of classes.
    """

    owner: str = ""
    variables: Mapping[str, str] = field(default_factory=dict)
    tokens: Mapping[str, Shape] = field(default_factory=dict)
    constants: tuple[str, ...] = ()
    enums: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    objects: Mapping[str, str] = field(default_factory=dict)
    members: Mapping[str, Mapping[str, str]] = field(default_factory=dict)

    def type_of(self, parts: tuple[str, ...]) -> str:
        """The type of a variable as it is written; empty where it is none of a rule."""
        match parts:
            case (name,):
                return self.variables.get(name, "")
            case (label, name) if label in self.tokens:
                return self.tokens[label].parameters.get(name, "")
            case (label, name) if label in self.variables:
                return self.members.get(self.variables[label], {}).get(name, "")
            case _:
                return ""

    def enum_of(self, parts: tuple[str, ...]) -> str:
        """The enumeration that a value is of, as it is written; empty where it is none."""
        owners = self.enums if len(parts) == 1 else parts[:-1]
        if len(parts) > 2 or self.type_of(parts):
            return ""
        return next((name for name in owners if parts[-1] in self.enums.get(name, ())), "")

    def is_value(self, kind: str) -> bool:
        """Whether what is of a type has values that a model writes out."""
        return kind in (*_NUMBERS, _TRUTH) or kind in self.enums

    def alike(self, kind: str) -> Iterator[str]:
        """What of a type may be named: variables and parameters of tokens; numbers mix."""
        yield from (name for name, other in self.variables.items() if _fits(other, kind))
        for label, token in self.tokens.items():
            yield from (f"{label}.{name}" for name, other in token.parameters.items() if _fits(other, kind))
        for label, owner in self.variables.items():
            yield from (f"{label}.{name}" for name, other in self.members.get(owner, {}).items() if _fits(other, kind))
        if kind in _NUMBERS:
            yield from self.constants

    def own_members(self, parts: tuple[str, ...]) -> Iterator[str]:
        """The other members of the type that the own object has, where one of it is written."""
        members = self.members.get(self.owner, {})
        if len(parts) == 2 and parts[0] == _OWN and parts[1] in members:
            kind = members[parts[1]]
            yield from (f"{_OWN}.{name}" for name, known in members.items() if name != parts[1] and known == kind)

    def is_local(self, name: str) -> bool:
        """Whether a name is one of the rule."""
        return name in self.variables or name in self.tokens

    def beside(self, parts: tuple[str, ...]) -> Iterator[str]:
        """The other objects of the class of an object, or their same members, and its other members of the type."""
        kind = self.objects[parts[0]]
        behind = "".join(f".{part}" for part in parts[1:])
        yield from (f"{other}{behind}" for other, known in self.objects.items() if known == kind and other != parts[0])
        members = self.members.get(kind, {})
        for name, known in members.items() if len(parts) == 2 else ():  # the object and its member
            if name != parts[1] and known == members.get(parts[1]):
                yield f"{parts[0]}.{name}"


@dataclass(frozen=True, slots=True)
class _Class:
    """The predicates of a class with their parameters, and its members, each with its type."""

    base: str
    predicates: Mapping[str, Mapping[str, str]]
    members: Mapping[str, str]
    events: tuple[str, ...] = ()


class Scopes:
    """The declarations of a model, whose numbers are `constants`."""

    def __init__(self, statements: Iterable[Any], constants: Iterable[str]) -> None:
        self._classes = {name: _native(one) for name, one in NATIVE_CLASSES.items()}
        self._globals: dict[str, str] = {}
        self._enums: dict[str, tuple[str, ...]] = {}
        self._constants = tuple(constants)
        self._typedefs: dict[str, str] = {}
        self._objects: dict[str, str] = {}
        for one in statements:
            match one:
                case ClassDecl(members=members, base=base) if members is not None:
                    predicates = {
                        each.name.name: self._declared(each.body) for each in members if isinstance(each, PredicateDecl)
                    }
                    self._classes[one.name.name] = _Class(
                        base.name if base else "", predicates, self._declared(members)
                    )
                case TypedefDecl(base=known):
                    self._typedefs[one.name.name] = self._typedefs.get(known.name, known.name)
                case EnumDecl():
                    self._enums[one.name.name] = tuple(value.name for value in one.values)
                case VariableDecl():
                    self._globals |= self._declared((one,))
                    self._objects |= {
                        each.name.name: each.initialiser.class_name.name
                        for each in one.declarators
                        if isinstance(each.initialiser, NewExpr)
                    }
                case _:
                    pass
        self._members = {
            owner: {name: kind for one in reversed(self._line(owner)) for name, kind in one.members.items()}
            for owner in self._classes
        }

    def of_predicate(self, owner: str, predicate: str) -> LineScope:
        """What the first line of a rule may name."""
        variables = self._parameters(owner, predicate)
        return LineScope(owner, variables, {}, self._constants, self._enums, self._objects, self._members)

    @property
    def outside(self) -> LineScope:
        """What a line of no rule may name."""
        return LineScope(enums=self._enums, objects=self._objects)

    def after(self, names: LineScope, statement: Any) -> LineScope:
        """What the line after a statement may name."""
        match statement:
            case VariableDecl():
                return replace(names, variables={**names.variables, **self._declared((statement,))})
            case Relation(created=created):
                made = {one.name.name: self.kind(names, one.path) for one in created if one.name is not None}
                return replace(names, tokens={**names.tokens, **made})
            case _:
                return names

    def kind(self, names: LineScope, path: PathExpr) -> Shape:
        """The predicate that a child is made of."""
        *holders, predicate = (part.name for part in path.parts)
        owner = names.owner
        for holder in holders if holders != [_OWN] else ():
            members = self._members.get(owner, {})
            owner = names.variables.get(holder) or members.get(holder) or self._globals.get(holder) or holder
        mine = self._parameters(owner, predicate)
        known = sorted({name for one in self._line(owner) for name in one.predicates} - {predicate})
        others = tuple(one for one in known if mine.items() <= self._parameters(owner, one).items())
        return Shape(mine, others, any(predicate in one.events for one in self._line(owner)))

    def called(self, label: str, owner: str, predicate: str) -> list[str]:
        """The predicates of other classes whose name a token has that is of one with another name."""
        name = label.lower()
        kind = self._classes.get(owner)
        if kind is None or kind.events or name in predicate.lower() or predicate.lower() in name:
            return []
        return [
            f"{other}.{known}"
            for other, one in self._classes.items()
            for known in sorted(one.predicates)
            if other != owner and known.lower() == name and not one.events
        ]

    def _declared(self, body: Iterable[Any]) -> dict[str, str]:
        return {
            each.name.name: self._typedefs.get(one.type_name.name, one.type_name.name)
            for one in body
            if isinstance(one, VariableDecl)
            for each in one.declarators
        }

    def _parameters(self, owner: str, predicate: str) -> dict[str, str]:
        found = [one.predicates.get(predicate, {}) for one in reversed(self._line(owner))]
        return {name: kind for one in found for name, kind in one.items()}

    def _line(self, owner: str) -> list[_Class]:
        """A class and those that it extends."""
        found: list[_Class] = []
        while owner in self._classes and self._classes[owner] not in found:
            found.append(self._classes[owner])
            owner = found[-1].base
        return found


def _native(known: Class) -> _Class:
    predicates = {
        name: {each.name: each.type.base for each in one.parameters} for name, one in known.predicates.items()
    }
    events = tuple(name for name, one in known.predicates.items() if one.is_event)
    return _Class(known.base or "", predicates, {}, events)


def _fits(one: str, other: str) -> bool:
    """Whether what is of one type may stand where the other stands."""
    return one == other or (one in _NUMBERS and other in _NUMBERS)
