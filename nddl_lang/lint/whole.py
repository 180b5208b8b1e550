"""All statements of a model in; what only they together tell out."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from nddl_lang.analysis import Analysis
from nddl_lang.lint.gist import Gist, restricted
from nddl_lang.lint.gist_counts import GistCounts
from nddl_lang.lint.network import Edge
from nddl_lang.lint.part import Facts, Key, Part
from nddl_lang.semantics import domains
from nddl_lang.semantics.schema import Domain, Interval, Kind, Variable
from nddl_lang.syntax.dialect import Dialect
from nddl_lang.syntax.includes import LIBRARY
from nddl_lang.syntax.nodes import BinaryExpr, ExprConstraint, NewExpr, RuleDecl, Statement
from nddl_lang.text.read import real_path
from nddl_lang.text.source import Source, Span


@dataclass(eq=False, slots=True)
class Whole:
    """A model: its statements and what they contribute.

    `is_whole` tells whether it is meant to run as it is: it makes objects, states goals or closes something.
    """

    analysis: Analysis
    parts: list[Part]
    gists: list[Gist]
    library: frozenset[Source]
    judged: frozenset[Source]
    usage: GistCounts
    is_whole: bool = False
    by_kind: dict[type, list[Part]] = field(default_factory=dict)
    gist_of: dict[Part, Gist] = field(default_factory=dict)
    timed: list[tuple[Part, tuple[Edge, ...]]] = field(default_factory=list)  # what the script demands of times
    objects: dict[str, list[NewExpr]] = field(default_factory=dict)
    given: dict[Key, list[tuple[Domain, Span]]] = field(default_factory=dict)
    assigned: dict[Key, Domain] = field(default_factory=dict)
    _ancestries: dict[str, list[str]] = field(default_factory=dict)

    @property
    def dialect(self) -> Dialect:
        """The dialect of the model."""
        return self.analysis.dialect

    def facts(self) -> Facts:
        """What findings in single statements may ask."""
        return Facts(self.analysis.schema, self.objects, self.assigned)

    def inner_given(self, part: Part) -> dict[Key, list[tuple[Domain, Span]]]:
        """What the comparisons inside a rule say about the values of its variables."""
        found: dict[Key, list[tuple[Domain, Span]]] = {}
        if isinstance(part.node, RuleDecl):
            for constraint in part.all(ExprConstraint):
                expression = constraint.expression
                if isinstance(expression, BinaryExpr):
                    given = restricted(part, expression.left, expression.op, expression.right, constraint.span)
                    for key, domain, span in given:
                        found.setdefault(key, []).append((domain, span))
        return found

    def is_own(self, span: Span | None) -> bool:
        """Whether a place stands in a text that is judged by this model, not one that other models include too."""
        return span is not None and span.source in self.judged

    def statements(self, kind: type[Statement]) -> list[Part]:
        """The statements of a class of nodes, in the order of their execution."""
        return self.by_kind.get(kind, [])

    def own(self, kind: type[Statement]) -> Iterator[Part]:
        """Those of them that are judged by this model."""
        return (part for part in self.statements(kind) if part.node.span.anchor.source in self.judged)

    def ancestry(self, name: str) -> list[str]:
        """Class `name`, its base, and so on up to the root."""
        known = self._ancestries.get(name)
        if known is None:
            known = self._ancestries[name] = self.analysis.schema.ancestry(name)
        return known


def assemble(
    analysis: Analysis, parts: list[Part], gists: list[Gist], usage: GistCounts, judged: frozenset[Path] = frozenset()
) -> Whole:
    """Put together what the statements contribute; `judged` are included files that the model is judged by too.

    `usage` is that of these statements.
    """
    paths = analysis.loaded.paths
    library = frozenset(source for source, path in paths.items() if Path(path).parent == LIBRARY)
    own = {source for source, path in paths.items() if source not in library and real_path(path) in judged}
    whole = Whole(analysis, parts, gists, library, frozenset({analysis.loaded.root, *own}), usage)
    whole.gist_of = dict(zip(parts, gists, strict=True))
    for part, each in whole.gist_of.items():
        whole.by_kind.setdefault(type(part.node), []).append(part)
        if each.times:
            whole.timed.append((part, each.times))
        if each.is_script and not whole.is_whole and part.node.span.source not in library:
            whole.is_whole = True
        for new in each.objects:
            for owner in whole.ancestry(new.class_name.name):
                whole.objects.setdefault(owner, []).append(new)
        for key, domain, span in each.given:
            whole.given.setdefault(key, []).append((domain, span))
            kind = _kind(key)
            before = whole.assigned.get(key)
            whole.assigned[key] = domain if before is None else domains.intersect(before, domain, kind) or domain
    return whole


def _kind(key: Key) -> Kind:
    return key[0].type.kind if isinstance(key[0], Variable) else Kind.FLOAT


def hull_of(domain: Domain | None) -> Interval | None:
    """The interval around what is known, None where nothing is."""
    return domains.hull(domain) if domain is not None else None
