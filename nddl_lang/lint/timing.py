"""Find temporal demands of a rule that cannot hold together, branch by branch."""

from collections.abc import Iterator

from nddl_lang.lint.network import Edge, negative_cycle
from nddl_lang.lint.part import Finding, Part
from nddl_lang.lint.temporal import RuleTimes
from nddl_lang.syntax.nodes import Foreach, IfStatement, RuleDecl, RuleStatement
from nddl_lang.text.diagnostic import Code, Note, Severity

CONTRADICTION = Code("NDDL530", Severity.WARNING, "lint", "the times that are demanded here cannot all hold")
TOO_LONG = Code("NDDL531", Severity.WARNING, "lint", "a token lasts longer here than the one that contains it")
NO_DURATION = Code("NDDL532", Severity.WARNING, "lint", "a token lasts at least 1, so this cannot hold")


def lint_times(part: Part) -> Iterator[Finding]:
    """Contradictions between relations, durations and comparisons of times in a rule."""
    if not isinstance(part.node, RuleDecl):
        return
    times = RuleTimes(part)
    known = times.own_edges()
    pending: list[tuple[tuple[RuleStatement, ...], list[Edge], bool]] = [(part.node.body, known, True)]
    while pending:
        body, inherited, is_whole = pending.pop()
        mine = [edge for statement in body for edge in times.edges(statement)]
        edges = inherited + mine if mine else inherited
        cycle = negative_cycle(edges) if mine or is_whole else []
        if cycle:
            yield _contradiction(part, cycle)
            continue
        for statement in reversed(body):
            if isinstance(statement, IfStatement):
                pending += [(block, edges, False) for block in (statement.otherwise, statement.then) if block]
            elif isinstance(statement, Foreach):
                pending.append((statement.body, edges, False))


def _contradiction(part: Part, cycle: list[Edge]) -> Finding:
    own = part.node.span
    here = [
        edge for edge in cycle if edge.span is not None and edge.span.anchor is own.anchor and edge.span.end <= own.end
    ]
    last = max(here, key=lambda edge: (edge.span.start, edge.why) if edge.span is not None else (0, ""), default=None)
    span = last.span if last is not None and last.span is not None else own
    ordered = sorted(cycle, key=lambda edge: edge.span.begin if edge.span is not None else -1)
    notes = tuple(Note(edge.why, edge.span if edge.span is not span else None) for edge in ordered)
    return _code(cycle).at(span, notes=notes)


def _code(cycle: list[Edge]) -> Code:
    lasting = [edge for edge in cycle if edge.is_duration]
    tokens = {edge.earlier[0] for edge in lasting}
    if len(cycle) == 2 and len(lasting) == 2 and len(tokens) == 1 and any(edge.weight == 0 for edge in cycle):
        return NO_DURATION
    others = [edge for edge in cycle if not edge.is_duration]
    if len(tokens) == 2 and len(lasting) == 2 and others and all(edge.is_containment for edge in others):
        return TOO_LONG
    return CONTRADICTION
