"""A relation between two tokens in; what it demands of their times, as constraints, out."""

from collections.abc import Iterator

from lsp.rows import demands, points_of
from nddl_lang.analysis import Analysis
from nddl_lang.semantics.relations import RelationRow
from nddl_lang.semantics.schema import Predicate
from nddl_lang.syntax.nodes import Relation


def demanded(analysis: Analysis, row: RelationRow, node: Relation) -> Iterator[tuple[str, tuple[str, ...]]]:
    """For each target of a relation how it is called, and what is demanded of it."""
    origin = analysis.tables.origins.get(node)
    if origin is None:
        return
    bounds = [(bound.lower.span.text, bound.upper.span.text) for bound in node.bounds]
    targets: list[tuple[str, Predicate]] = []
    if (existing := analysis.tables.existing.get(node)) is not None:
        targets.append((existing.name, existing.predicate))
    for instance in node.created:
        target = analysis.tables.targets.get(instance)
        if target is not None:
            targets.append((instance.name.name if instance.name else target.predicate.name, target.predicate))
    for name, predicate in targets:
        first, second = _prefix(origin.name), _prefix(name)
        points = points_of(first, second, origin.predicate.is_event, predicate.is_event)
        lines = demands(row, points, (f"{first}duration", f"{second}duration"), bounds)
        own = "this token" if origin.name == "this" else f"`{origin.name}`"
        yield f"{own} (`{origin.predicate.full_name}`) and `{name}` (`{predicate.full_name}`)", lines


def _prefix(name: str) -> str:
    return "" if name == "this" else f"{name}."
