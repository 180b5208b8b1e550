"""Index of names: an analysis in; every occurrence of every declared name, by symbol and by place, out."""

from bisect import bisect_right
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import Enum
from functools import cached_property

from nddl_lang.analysis import Analysis
from nddl_lang.semantics.schema import (
    ClassReference,
    Constructor,
    EnumValue,
    GlobalReference,
    Kind,
    Label,
    LocalReference,
    MemberReference,
    Predicate,
    Reference,
    SideTables,
    TokenReference,
    TokenVariableReference,
    Type,
    Typedef,
    Variable,
)
from nddl_lang.syntax.nodes import (
    Assignment,
    CallConstraint,
    CallExpr,
    ClassDecl,
    ConstructorDecl,
    EnumDecl,
    Foreach,
    FormalParameter,
    Identifier,
    Instance,
    MethodCall,
    NewExpr,
    PathExpr,
    PredicateDecl,
    Relation,
    RuleDecl,
    Statement,
    TypedefDecl,
    VariableDecl,
)
from nddl_lang.syntax.walk import descendants
from nddl_lang.text.source import Anchor, Span


class SymbolType(Enum):
    """What a name is the name of."""

    CLASS = "class"
    ENUM = "enum"
    ENUM_VALUE = "enum value"
    TYPEDEF = "typedef"
    PREDICATE = "predicate"
    VARIABLE = "variable"
    TOKEN = "token"
    RELATION = "relation"
    CALLABLE = "constraint"


class Role(Enum):
    """What an occurrence does with its symbol."""

    DECLARES = "declares"
    HAS_RULE = "has rule"
    REQUESTS = "requests"
    WRITES = "writes"
    READS = "reads"


class VariableKind(Enum):
    """What a variable belongs to."""

    GLOBAL = "global"
    MEMBER = "member"
    PARAMETER = "parameter"
    LOCAL = "local"


@dataclass(frozen=True, slots=True)
class Symbol:
    """A declared name. `owner` tells equal names apart: the enum of a value, the root class of a predicate, the place
    of the declaration of a variable or token.
    """

    type: SymbolType
    name: str
    owner: object = None


@dataclass(frozen=True, eq=False, slots=True)
class Occurrence:
    """One place where a symbol is named; of a variable with what it belongs to."""

    symbol: Symbol
    span: Span
    role: Role
    kind: VariableKind | None = None


class _InStatement:
    """The occurrences in one statement in order of execution, and by the piece of text that they stand in."""

    __slots__ = ("by_anchor", "occurrences")

    def __init__(self, occurrences: Iterable[Occurrence]) -> None:
        self.occurrences = tuple(occurrences)
        found: dict[Anchor, list[Occurrence]] = {}
        for each in self.occurrences:
            found.setdefault(each.span.anchor, []).append(each)
        self.by_anchor = {anchor: _in_order(each) for anchor, each in found.items()}


def _in_order(occurrences: Iterable[Occurrence]) -> list[Occurrence]:
    return sorted(occurrences, key=lambda each: each.span.start)


class NameIndex:
    """The occurrences of one analysis, statement by statement in the order of execution."""

    def __init__(self, by_statement: Iterable[_InStatement]) -> None:
        self._by_statement = tuple(by_statement)

    @cached_property
    def all(self) -> dict[Symbol, list[Occurrence]]:
        """The occurrences of each symbol in order of execution."""
        found: dict[Symbol, list[Occurrence]] = {}
        for statement in self._by_statement:
            for each in statement.occurrences:
                found.setdefault(each.symbol, []).append(each)
        return found

    @cached_property
    def _by_anchor(self) -> dict[Anchor, list[Occurrence]]:
        """The occurrences of each top-level statement of a text, in the order of the text."""
        found: dict[Anchor, list[Occurrence]] = {}
        for statement in self._by_statement:
            for anchor, occurrences in statement.by_anchor.items():
                others = found.get(anchor)
                found[anchor] = occurrences if others is None else _in_order((*others, *occurrences))
        return found

    def within(self, anchor: Anchor) -> list[Occurrence]:
        """The occurrences in one top-level statement."""
        return self._by_anchor.get(anchor, [])

    def at(self, anchor: Anchor, offset: int) -> Occurrence | None:
        """What is named at `offset` of the text, or ends there."""
        here = self.within(anchor)
        at = offset - anchor.offset
        index = bisect_right(here, at, key=lambda each: each.span.start) - 1
        return here[index] if index >= 0 and at <= here[index].span.end else None

    def of(self, symbol: Symbol) -> list[Occurrence]:
        """The occurrences of `symbol`."""
        return self.all.get(symbol, [])

    def declarations(self, symbol: Symbol) -> list[Occurrence]:
        """Where `symbol` is declared: a class also where it is announced and by its constructors."""
        return [each for each in self.of(symbol) if each.role is Role.DECLARES]


class NameIndexer:
    """Indexes a model again and again while it is edited, each time only the statements that changed."""

    def __init__(self) -> None:
        self._known: dict[SideTables, _InStatement] = {}

    def index(self, analysis: Analysis) -> NameIndex:
        """The names of `analysis`."""
        known: dict[SideTables, _InStatement] = {}
        for statement in analysis.statements:
            tables = analysis.by_statement[statement]
            found = self._known.get(tables)
            known[tables] = found or _InStatement(_occurrences(statement, tables))
        self._known = known
        return NameIndex(known.values())


def symbol_of_predicate(predicate: Predicate) -> Symbol:
    """The symbol of a predicate: one for all classes that declare it again or inherit it."""
    root = predicate.declared_in[0] if predicate.declared_in else predicate.class_name
    return Symbol(SymbolType.PREDICATE, predicate.name, root)


def symbol_of_class(name: str) -> Symbol:
    """The symbol of a class."""
    return Symbol(SymbolType.CLASS, name)


def _symbol_of_variable(variable: Variable) -> Symbol:
    span = variable.span
    return Symbol(SymbolType.VARIABLE, variable.name, (span.anchor, span.start) if span is not None else variable)


def _symbol_of_label(label: Label) -> Symbol | None:
    if label.name == "this" or label.span is None:
        return None
    return Symbol(SymbolType.TOKEN, label.name, (label.span.anchor, label.span.start))


def _symbol_of_value(value: EnumValue) -> Symbol:
    return Symbol(SymbolType.ENUM_VALUE, value.value, value.enum)


def _symbol_of_type(name: str, type_: Type) -> Symbol | None:
    if name != type_.base:
        return Symbol(SymbolType.TYPEDEF, name)
    match type_.kind:
        case Kind.OBJECT:
            return symbol_of_class(name)
        case Kind.ENUM:
            return Symbol(SymbolType.ENUM, name)
        case _:
            return None


def _symbol_of(reference: Reference) -> Symbol | None:
    """The symbol that a reference leads to; None for what the language brings along, such as `this` and `start`."""
    match reference:
        case EnumValue():
            return _symbol_of_value(reference)
        case GlobalReference(variable=variable) | LocalReference(variable=variable):
            return _symbol_of_variable(variable)
        case ClassReference(name=name):
            return symbol_of_class(name)
        case TokenReference(label=label):
            return _symbol_of_label(label)
        case TokenVariableReference(label=label, name=name):
            found = next((each for each in label.predicate.parameters if each.name == name), None)
            return _symbol_of_variable(found) if found is not None else None
        case MemberReference(members=members):
            return _symbol_of_variable(members[-1]) if members else None


def _symbol_of_declared(thing: object) -> Symbol | None:
    match thing:
        case Variable():
            return _symbol_of_variable(thing)
        case Label():
            return _symbol_of_label(thing)
        case Predicate():
            return symbol_of_predicate(thing)
        case EnumValue():
            return _symbol_of_value(thing)
        case Typedef(name=name):
            return Symbol(SymbolType.TYPEDEF, name)
        case Constructor(class_name=name):
            return symbol_of_class(name)
        case _:
            return None


_KINDS: dict[type, VariableKind] = {
    GlobalReference: VariableKind.GLOBAL,
    LocalReference: VariableKind.LOCAL,
    TokenVariableReference: VariableKind.PARAMETER,
    MemberReference: VariableKind.MEMBER,
}
# The names that stand in a node itself, with what each means.
_Named = Iterator[tuple[Identifier, Symbol | None, Role, VariableKind | None]]


def _occurrences(statement: Statement, tables: SideTables) -> Iterator[Occurrence]:
    walk = _Walk(statement, tables)
    for node in descendants(statement):
        for name, symbol, role, kind in walk.named(node):
            if symbol is not None and name.span.start < name.span.end:
                yield Occurrence(symbol, name.span, role, kind)


class _Walk:
    """NameIndex what stands in the nodes of one statement, each node after those that it is part of."""

    def __init__(self, statement: Statement, tables: SideTables) -> None:
        self._tables = tables
        self._written: set[PathExpr] = set()
        self._parameters: set[object] = set()  # declarations of variables in predicates
        match statement:
            case ClassDecl():
                self._kind = VariableKind.MEMBER
            case VariableDecl():
                self._kind = VariableKind.GLOBAL
            case _:
                self._kind = VariableKind.LOCAL

    def named(self, node: object) -> _Named:
        """The names that stand in the node itself."""
        tables = self._tables
        match node:
            case PathExpr():
                yield from self._path(node)
            case Assignment(target=target):
                self._written.add(target)
            case Instance(path=path, name=name):
                if (wanted := tables.targets.get(node)) is not None:
                    yield path.parts[-1], symbol_of_predicate(wanted.predicate), Role.REQUESTS, None
                if name is not None:
                    yield self._declared(name)
            case Relation(origin=origin, relation=relation):
                yield relation, Symbol(SymbolType.RELATION, relation.name), Role.READS, None
                if origin is not None and (reference := tables.references.get(origin)) is not None:
                    yield origin, _symbol_of(reference), Role.READS, None
            case CallConstraint(name=name) | CallExpr(function=name) | MethodCall(method=name):
                yield name, Symbol(SymbolType.CALLABLE, name.name), Role.READS, None
            case NewExpr(class_name=name):
                yield name, symbol_of_class(name.name), Role.READS, None
            case VariableDecl(type_name=name, declarators=declarators):
                yield self._type(name)
                kind = VariableKind.PARAMETER if node in self._parameters else self._kind
                yield from (self._declared(each.name, kind) for each in declarators)
            case FormalParameter(type_name=type_name, name=name):
                yield self._type(type_name)
                yield self._declared(name, VariableKind.LOCAL)
            case TypedefDecl(base=base, name=name):
                yield self._type(base)
                yield self._declared(name)
            case Foreach(variable=variable):
                yield self._declared(variable, VariableKind.LOCAL)
            case PredicateDecl(name=name, body=body):
                self._parameters.update(body)
                yield self._declared(name)
            case ConstructorDecl(name=name):
                yield self._declared(name)
            case _:
                yield from self._types(node)

    def _types(self, node: object) -> _Named:
        tables = self._tables
        match node:
            case ClassDecl(name=name, base=base):
                yield name, symbol_of_class(name.name), Role.DECLARES, None
                if base is not None:
                    yield base, symbol_of_class(base.name), Role.READS, None
            case EnumDecl(name=name, values=values):
                if name in tables.declared:
                    yield name, Symbol(SymbolType.ENUM, name.name), Role.DECLARES, None
                yield from (self._declared(each) for each in values)
            case RuleDecl(class_name=class_name, predicate=name):
                yield class_name, symbol_of_class(class_name.name), Role.READS, None
                if (predicate := tables.predicates.get(node)) is not None:
                    yield name, symbol_of_predicate(predicate), Role.HAS_RULE, None
            case _:
                pass

    def _declared(
        self, name: Identifier, kind: VariableKind | None = None
    ) -> tuple[Identifier, Symbol | None, Role, VariableKind | None]:
        return name, _symbol_of_declared(self._tables.declared.get(name)), Role.DECLARES, kind

    def _type(self, name: Identifier) -> tuple[Identifier, Symbol | None, Role, None]:
        type_ = self._tables.type_names.get(name)
        return name, _symbol_of_type(name.name, type_) if type_ is not None else None, Role.READS, None

    def _path(self, path: PathExpr) -> _Named:
        references = self._tables.references
        whole = references.get(path)
        for part in path.parts:
            is_written = path in self._written and part is path.parts[-1]
            role = Role.WRITES if is_written else Role.READS
            reference = references.get(part)
            if reference is None and len(path.parts) == 1:
                reference = whole
            if reference is not None:
                yield part, _symbol_of(reference), role, _KINDS.get(type(reference))
            elif isinstance(whole, EnumValue) and len(path.parts) == 2 and part is path.parts[0]:
                yield part, Symbol(SymbolType.ENUM, part.name), role, None
