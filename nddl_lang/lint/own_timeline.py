"""One rule in; tokens of its own timeline that would have to overlap, which tokens of a timeline never do, out."""

from collections.abc import Iterator, Sequence
from itertools import combinations

from nddl_lang.lint.codes import OVERLAP
from nddl_lang.lint.network import Edge, Node, negative_cycle
from nddl_lang.lint.part import Facts, Finding, Part
from nddl_lang.lint.temporal import RuleTimes
from nddl_lang.semantics.schema import Predicate
from nddl_lang.syntax.nodes import Foreach, IfStatement, Instance, Relation, RuleDecl, RuleStatement
from nddl_lang.text.diagnostic import Diagnostic
from nddl_lang.text.source import Span

_TIMELINE = "Timeline"
_MOST = 8  # tokens of a timeline in one rule that are compared


class _Here:
    """A token on the timeline of the rule: its own, or a child; `is_any` if it may be on another of the class."""

    def __init__(self, token: object, name: str, predicate: Predicate, span: Span, *, is_any: bool) -> None:
        self.token = token
        self.name = name
        self.predicate = predicate
        self.span = span
        self.is_any = is_any

    def ends_before(self, other: "_Here") -> Edge:
        """What holds where this token comes first."""
        end: Node = (self.token, "end")
        return Edge((other.token, "start"), end, 0, "", None)


def lint_own_timeline(part: Part) -> Iterator[Finding]:
    """`contains(object.Other x)` in a rule of a timeline, and what comes to the same."""
    own = part.tables.predicates.get(part.node) if isinstance(part.node, RuleDecl) else None
    if not isinstance(part.node, RuleDecl) or own is None or own.is_event:
        return
    times = RuleTimes(part)
    itself = _Here(None, "this", own, part.node.predicate.span, is_any=False)
    told: set[object] = set()
    pending: list[tuple[tuple[RuleStatement, ...], list[Edge], list[_Here]]] = [
        (part.node.body, times.own_edges(), [itself])
    ]
    while pending:
        body, inherited, around = pending.pop()
        edges = [*inherited, *(edge for statement in body for edge in times.edges(statement))]
        here = [*around, *_children(part, body, own)]
        if negative_cycle(edges):
            continue  # told as a contradiction
        for one, other in combinations(here[:_MOST], 2):
            if one.predicate.name != other.predicate.name and other.token not in told and _overlap(edges, one, other):
                told.add(other.token)
                yield _finding(own.class_name, one, other)
        for statement in body:
            match statement:
                case IfStatement(then=then, otherwise=otherwise):
                    pending += [(block, edges, here) for block in (then, otherwise) if block]
                case Foreach(body=inner):
                    pending.append((inner, edges, here))


def _children(part: Part, body: Sequence[RuleStatement], own: Predicate) -> Iterator[_Here]:
    """The tokens that a block asks for on the rule's own timeline, or on any of its class."""
    for statement in body:
        for instance in statement.created if isinstance(statement, Relation) else ():
            target = part.tables.targets.get(instance)
            if target is None or target.predicate.is_event:
                continue
            is_any = target.object == "any" and target.predicate.class_name == own.class_name
            if is_any or target.object == "own":
                yield _Here(
                    target.label or instance, _text(instance), target.predicate, instance.path.span, is_any=is_any
                )


def _text(instance: Instance) -> str:
    return instance.name.name if instance.name is not None else instance.path.span.text


def _overlap(edges: list[Edge], one: _Here, other: _Here) -> bool:
    """Whether neither of two tokens can end before the other one starts."""
    return bool(negative_cycle([*edges, one.ends_before(other)]) and negative_cycle([*edges, other.ends_before(one)]))


def _finding(class_name: str, one: _Here, other: _Here) -> Finding:
    def finding(facts: Facts) -> Diagnostic | None:
        if _TIMELINE not in facts.schema.ancestry(class_name):
            return None
        if (one.is_any or other.is_any) and len(facts.objects.get(class_name, ())) != 1:
            return None
        name = f"the token of `{one.predicate.name}`" if one.token is None else f"`{one.name}`"
        return OVERLAP.at(other.span, name=f"`{other.name}`", other=name)

    return finding
