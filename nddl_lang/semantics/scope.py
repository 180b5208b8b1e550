"""Know which names are visible at a place, and carry what a pass reads and writes."""

import re
from dataclasses import dataclass, field
from enum import Enum

from nddl_lang.semantics.callables import NATIVE_CALLABLES, Callables
from nddl_lang.semantics.natives import builtin_type
from nddl_lang.semantics.schema import (
    Label,
    LocalReference,
    Predicate,
    SideTables,
    TokenVariableReference,
    Type,
    Variable,
)
from nddl_lang.semantics.symbol_table import SymbolTable
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.nodes import NewExpr, PathExpr, Relation, RuleDecl, RuleStatement, VariableDecl
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Span

_ANY = ""  # stands for all names among those that are doubtful
_NAME = re.compile(r"[A-Za-z_$][A-Za-z0-9_$]*")
_HYPHENATED = re.compile(r"(?<![\w$])[A-Za-z_$][\w$]*(?:-[\w$]+)+")


@dataclass(eq=False, slots=True)
class Context:
    """What the passes over one top-level statement share."""

    symbols: SymbolTable
    dialect: Dialect
    tables: SideTables = field(default_factory=SideTables)
    complaints: list[Diagnostic] = field(default_factory=list)
    reported: set[str] = field(default_factory=set)  # unknown names, each complained about once per statement
    deferred: list["Deferred"] = field(default_factory=list)
    callables: Callables = NATIVE_CALLABLES

    def complain(self, diagnostic: Diagnostic) -> None:
        """Add a complaint."""
        self.complaints.append(diagnostic)


@dataclass(frozen=True, eq=False, slots=True)
class Deferred:
    """A `new` inside a constructor or rule, of a class that is defined further down; it is run after that."""

    new: NewExpr
    types: tuple[Type | None, ...]


class BlockKind(Enum):
    """What a statement is part of; the value completes `cannot stand in ...`."""

    SCRIPT = "the script"
    RULE = "a rule"
    PREDICATE = "a predicate"
    CONSTRUCTOR = "a constructor"


class Scope:
    """The names of one block; those of the script are in the symbol table.

    `own` is the rule's or predicate's own token, `own_class` its class or the one that is constructed.
    A predicate's parameters become visible one by one.
    """

    __slots__ = (
        "_body",
        "_hidden",
        "_later",
        "_lost",
        "_own",
        "_unnamed",
        "_vague",
        "kind",
        "labels",
        "own",
        "own_class",
        "parameters",
        "parent",
        "variables",
    )

    def __init__(self, kind: BlockKind, own_class: str | None = None, own: Label | None = None) -> None:
        self.kind = kind
        self.own_class = own_class
        self.own = own
        self.parent: Scope | None = None
        self.variables: dict[str, LocalReference] = {}
        self.labels: dict[str, Label] = {}
        self.parameters: dict[str, Variable] = {}
        self._own: dict[str, TokenVariableReference] = {}
        self._lost: dict[str, Span] = {}
        self._later: dict[str, Span] = {}
        self._body: tuple[RuleStatement, ...] = ()
        self._vague: set[str] = set()
        self._unnamed: dict[str, PathExpr] = {}
        self._hidden: dict[Label, Label] = {}

    def block(self) -> "Scope":
        """The scope of a block inside this one."""
        inner = Scope(self.kind, self.own_class, self.own)
        inner.parent = self
        inner.parameters = self.parameters
        inner._own = self._own
        inner._lost = self._lost
        inner._later = self._later
        inner._body = self._body
        inner._vague = self._vague
        inner._unnamed = self._unnamed
        inner._hidden = self._hidden
        return inner

    def leave(self) -> None:
        """Close the block: its names are lost, but known to have been there."""
        for name, reference in self.variables.items():
            if reference.variable.span is not None:
                self._lost.setdefault(name, reference.variable.span)
        for name, label in self.labels.items():
            if label.span is not None:
                self._lost.setdefault(name, label.span)

    def lost_at(self, name: str) -> Span | None:
        """Where a block that is closed by now declared `name`."""
        return self._lost.get(name)

    def expect(self, name: str, span: Span) -> None:
        """Know that `name` is declared further down in the same rule, predicate or class."""
        self._later.setdefault(name, span)

    def declared_below(self, name: str) -> Span | None:
        """Where the same rule, predicate or class declares `name` further down."""
        if self._body:
            self._later.update(_declared_in(self._body))
            self._body = ()
        return self._later.get(name)

    def ask_unnamed(self, path: PathExpr) -> None:
        """Know that a token of this predicate is asked for without a name."""
        self._unnamed.setdefault(path.parts[-1].name.casefold(), path)

    def unnamed(self, name: str) -> PathExpr | None:
        """What asks for a token without a name, for which people may well write `name`."""
        return self._unnamed.get(name.casefold())

    def doubt(self, text: str) -> None:
        """Let the names in a text that was not understood be ones that it may have declared."""
        self._vague.update(_NAME.findall(text))

    def is_doubtful(self, name: str) -> bool:
        """Whether text that was not understood may have declared `name`."""
        return name in self._vague or _ANY in self._vague

    def doubt_all(self) -> None:
        """Let every unknown name from here on be one that was to be declared."""
        self._vague.add(_ANY)

    def name_token(self, label: Label) -> None:
        """Know a child token by its name, in place of one that had it before."""
        if (first := self.find_label(label.name)) is not None:
            self._hidden[label] = first
        self.labels[label.name] = label

    def hidden_by(self, label: Label) -> Label | None:
        """The token that had the same name before."""
        return self._hidden.get(label)

    def find_local(self, name: str) -> LocalReference | None:
        """The local variable, foreach variable or formal parameter of that name."""
        scope: Scope | None = self
        while scope is not None:
            if (found := scope.variables.get(name)) is not None:
                return found
            scope = scope.parent
        return None

    def find_label(self, name: str) -> Label | None:
        """The child token of that name, or the own token for `this`."""
        if name == "this":
            return self.own
        scope: Scope | None = self
        while scope is not None:
            if (found := scope.labels.get(name)) is not None:
                return found
            scope = scope.parent
        return None

    def find_own(self, name: str) -> TokenVariableReference | None:
        """The variable of that name of the own token."""
        if self.own is None:
            return None
        found = self._own.get(name)
        if found is None:
            parameter = self.parameters.get(name)
            type_ = parameter.type if parameter is not None else builtin_type(name, self.own.predicate)
            if type_ is not None:
                found = self._own[name] = TokenVariableReference(self.own, name, type_)
        return found

    def visible_labels(self) -> list[str]:
        """The names of the child tokens, nearest block first."""
        names: list[str] = []
        scope: Scope | None = self
        while scope is not None:
            names += scope.labels
            scope = scope.parent
        return names

    def visible(self) -> list[str]:
        """The names that this scope adds to those of the script."""
        names: list[str] = []
        scope: Scope | None = self
        while scope is not None:
            names += [*scope.variables, *scope.labels]
            scope = scope.parent
        return [*names, *self.parameters]


def names_in(text: str) -> list[str]:
    """The words of a text that could be names, those with a hyphen also as they are mended."""
    return [*_NAME.findall(text), *(each.replace("-", "_") for each in _HYPHENATED.findall(text))]


def rule_scope(predicate: Predicate, rule: RuleDecl) -> Scope:
    """The scope of a rule on `predicate`."""
    scope = Scope(BlockKind.RULE, predicate.class_name, Label("this", predicate, rule.predicate.span))
    scope._body = rule.body
    scope.parameters = {parameter.name: parameter for parameter in predicate.parameters}
    return scope


def _declared_in(body: tuple[RuleStatement, ...]) -> dict[str, Span]:
    """The names that a rule body declares outside of its blocks, and where."""
    names: dict[str, Span] = {}
    for statement in body:
        match statement:
            case VariableDecl(declarators=declarators):
                for declarator in declarators:
                    names.setdefault(declarator.name.name, declarator.name.span)
            case Relation(created=created):
                for instance in created:
                    if instance.name is not None:
                        names.setdefault(instance.name.name, instance.name.span)
            case _:
                pass
    return names


def is_told(context: Context, scope: Scope, name: str) -> bool:
    """Whether nothing more is to be said of an unknown name: it is told, or what may declare it was not understood."""
    return name in context.reported or scope.is_doubtful(name) or context.symbols.is_doubtful(name)
