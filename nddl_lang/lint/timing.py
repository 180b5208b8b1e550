"""Find temporal demands that cannot hold together: in a rule, branch by branch, of several rules, and in the script."""

from bisect import bisect_left
from collections.abc import Iterator

from nddl_lang.lint.codes import CONTRADICTION, NO_DURATION, TOO_LONG
from nddl_lang.lint.network import Edge, negative_cycle
from nddl_lang.lint.part import Finding, Part
from nddl_lang.lint.temporal import RuleTimes
from nddl_lang.lint.whole import Whole
from nddl_lang.syntax.nodes import (
    Foreach,
    GoalStatement,
    IfStatement,
    MethodCall,
    PredicateDecl,
    RuleDecl,
    RuleStatement,
)
from nddl_lang.text.diagnostic import Code, Diagnostic, Note

_TAKING_BACK = frozenset(("reset", "cancel", "free"))


def lint_times_together(whole: Whole) -> Iterator[Diagnostic]:
    """Contradictions between rules that fire for the same token, and between the statements of the script."""
    rules: dict[str, dict[str, list[Part]]] = {}
    for part in whole.statements(RuleDecl):
        assert isinstance(part.node, RuleDecl)
        rules.setdefault(part.node.predicate.name, {}).setdefault(part.node.class_name.name, []).append(part)
    for (class_name, parts), of_others in ((each, others) for others in rules.values() for each in others.items()):
        inherited = [
            rule
            for ancestor in whole.ancestry(class_name)
            if ancestor != class_name and ancestor in of_others
            for rule in of_others[ancestor]
        ]
        if len(inherited) + len(parts) > 1:
            yield from _beside_others(parts, inherited)
    yield from _in_script(whole)


def _beside_others(parts: list[Part], inherited: list[Part]) -> Iterator[Diagnostic]:
    """The first rule that contradicts those that fire before it: of ancestors, and above it of its own class."""
    before = [edge for part in inherited for edge in _plain_edges(part)]
    own = [_plain_edges(part) for part in parts]

    def cycle_with(count: int) -> list[Edge]:
        return negative_cycle([*before, *(edge for edges in own[:count] for edge in edges)])

    first = bisect_left(range(len(parts) + 1), True, key=lambda count: cycle_with(count) != [])
    if 0 < first <= len(parts) and not negative_cycle(own[first - 1]):
        yield _contradiction(parts[first - 1], cycle_with(first))


def _plain_edges(part: Part) -> list[Edge]:
    """What a rule demands whatever its guards say."""
    assert isinstance(part.node, RuleDecl)
    times = RuleTimes(part)
    return [*times.own_edges(), *(edge for statement in part.node.body for edge in times.edges(statement))]


def _in_script(whole: Whole) -> Iterator[Diagnostic]:
    """What the script demands of its tokens, unless it takes something back."""
    for part in whole.statements(MethodCall):
        if isinstance(part.node, MethodCall) and part.node.method.name in _TAKING_BACK:
            return
    rejectable: set[object] = set()
    for part in whole.statements(GoalStatement):
        if isinstance(part.node, GoalStatement) and part.node.kind == "rejectable":
            rejectable |= {part.label_of(instance) for instance in part.node.instances}
    edges = [edge for _, demanded in whole.timed for edge in demanded]
    last = whole.timed[-1][0] if whole.timed else None
    edges = [edge for edge in edges if edge.earlier[0] not in rejectable and edge.later[0] not in rejectable]
    if last is not None and (cycle := negative_cycle(edges)):
        yield _contradiction(last, cycle)


def lint_times(part: Part) -> Iterator[Finding]:
    """Contradictions between relations, durations and comparisons in a rule, and in the body of a predicate."""
    times = RuleTimes(part)
    for predicate in part.all(PredicateDecl):
        assert isinstance(predicate, PredicateDecl)
        if cycle := negative_cycle([edge for statement in predicate.body for edge in times.edges(statement)]):
            yield _contradiction(part, cycle)
    if not isinstance(part.node, RuleDecl):
        return
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


def _contradiction(part: Part, cycle: list[Edge]) -> Diagnostic:
    own = part.node.span
    here = [
        edge for edge in cycle if edge.span is not None and edge.span.anchor is own.anchor and edge.span.end <= own.end
    ] or [edge for edge in cycle if edge.span is not None and edge.span.source is own.source]
    last = max(here, key=lambda edge: (edge.span.begin, edge.why) if edge.span is not None else (0, ""), default=None)
    span = last.span if last is not None and last.span is not None else own
    ordered = sorted(cycle, key=lambda edge: (edge.span.begin if edge.span is not None else -1, edge.why))
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
