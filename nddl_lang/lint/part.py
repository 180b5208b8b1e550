"""One top-level statement in, with what is known of it; what the lints ask about it out, worked out once."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

from nddl_lang.semantics.schema import (
    Domain,
    Label,
    MemberReference,
    Predicate,
    Reference,
    Schema,
    SideTables,
    TokenReference,
    TokenVariableReference,
    Variable,
)
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.nodes import Instance, NewExpr, Statement
from nddl_lang.syntax.walk import descendants
from nddl_lang.text.diagnostic import Diagnostic

Node = TypeVar("Node")
Key = tuple[object, str]  # what tells a variable from all others: a variable, or a token and a name


class Part:
    """A top-level statement, its side tables, and all nodes in it by class."""

    __slots__ = ("_nodes", "dialect", "node", "tables")

    def __init__(self, node: Statement, tables: SideTables, dialect: Dialect) -> None:
        self.node = node
        self.tables = tables
        self.dialect = dialect
        self._nodes: dict[type, list[Any]] = {}
        for below in descendants(node):
            self._nodes.setdefault(type(below), []).append(below)

    def all(self, kind: type[Node]) -> list[Node]:
        """The nodes of a class, in written order."""
        return self._nodes.get(kind, [])

    def reference(self, node: object) -> Reference | None:
        """What a path or name refers to."""
        return self.tables.references.get(node)

    def label_of(self, instance: Instance) -> Label | None:
        """The label of a created token, None where it has none."""
        target = self.tables.targets.get(instance)
        return target.label if target is not None else None

    def predicate_of(self, instance: Instance) -> Predicate | None:
        """The predicate of a created token."""
        target = self.tables.targets.get(instance)
        return target.predicate if target is not None else None


@dataclass(frozen=True, eq=False, slots=True)
class Facts:
    """What a finding in one statement may need to know about the others."""

    schema: Schema
    objects: Mapping[str, list[NewExpr]]  # what makes the objects of a class or of its subclasses
    assigned: Mapping[Key, Domain]  # what assignments of the script leave to variables and to those of its tokens


# Some findings depend on the other statements: those are worked out when all are known.
Conditional = Callable[[Facts], Diagnostic | None]
Finding = Diagnostic | Conditional
PartLint = Callable[[Part], Iterable[Finding]]


def parameter_of(predicate: Predicate, name: str) -> Variable | None:
    """The parameter of that name."""
    return next((parameter for parameter in predicate.parameters if parameter.name == name), None)


def mentioned_labels(part: Part) -> Iterator[Label]:
    """The tokens that a statement refers to after their creation."""
    for reference in part.tables.references.values():
        base = reference.base if isinstance(reference, MemberReference) else reference
        if isinstance(base, TokenReference | TokenVariableReference):
            yield base.label
