"""Find predicates and rules that no goal leads to, chains of subgoals without an end, and actions without effect."""

from collections.abc import Iterator

from nddl_lang.lint.codes import CHAIN, ENDLESS, NEVER_FIRES, NO_EFFECT, UNREACHABLE
from nddl_lang.lint.declarations import AGENT_TIMELINE
from nddl_lang.lint.part import Part
from nddl_lang.lint.requests import ChildRequest
from nddl_lang.lint.whole import Whole
from nddl_lang.semantics.schema import Predicate
from nddl_lang.syntax.nodes import (
    ClassDecl,
    GoalStatement,
    Instance,
    PredicateDecl,
    Relation,
    RuleDecl,
)
from nddl_lang.text.diagnostic import Code, Diagnostic, Note

_FORWARD = frozenset({"meets", "before"})
_BACKWARD = frozenset({"met_by", "after"})


_Followers = dict[str, list[tuple[str, ChildRequest]]]


class _Graph:
    """Which tokens ask for which: rules by the full name of their predicate, in the order of the text."""

    def __init__(self, whole: Whole) -> None:
        self.whole = whole
        self.schema = whole.analysis.schema
        self.rules: dict[str, list[Part]] = {}
        self.requests: dict[Part, tuple[ChildRequest, ...]] = {}
        self.names: dict[Part, str] = {}
        for part, each in zip(whole.parts, whole.gists, strict=True):
            if each.predicate:
                self.rules.setdefault(each.predicate, []).append(part)
                self.requests[part] = each.requests
                self.names[part] = each.predicate

    def _rules_for(self, class_name: str, predicate: str) -> Iterator[Part]:
        """The rules that run for a token: those of its class and of the ancestors."""
        for owner in self.whole.ancestry(class_name):
            yield from self.rules.get(f"{owner}.{predicate}", ())

    def _reached(self, roots: list[Predicate]) -> set[str]:
        """The full names of the predicates that the roots lead to."""
        producers: dict[str, list[Predicate]] = {}
        for part, requests in self.requests.items():
            assert isinstance(part.node, RuleDecl)
            own = part.tables.predicates[part.node]
            for request in requests:
                if request.is_effect and own.is_action:
                    producers.setdefault(request.wanted.name, []).append(own)
        found: set[str] = set()
        pending = list(roots)
        while pending:
            predicate = pending.pop()
            if predicate.full_name in found:
                continue
            found.add(predicate.full_name)
            pending += producers.get(predicate.name, ())
            for part in self._rules_for(predicate.class_name, predicate.name):
                pending += (request.wanted for request in self.requests[part])
        return found


def lint_structure(whole: Whole) -> Iterator[Diagnostic]:
    """What the graph of the subgoals shows."""
    if not whole.is_whole:
        return
    graph = _Graph(whole)
    roots = [
        predicate
        for part in (*whole.statements(GoalStatement), *whole.statements(Relation))
        for instance in part.all(Instance)
        if (predicate := part.predicate_of(instance)) is not None
    ]
    idle = list(_without_effect(graph))
    if roots:
        yield from _unreachable(graph, roots, {predicate.full_name for _, predicate in idle})
    yield from _endless(graph)
    for node, predicate in idle:
        help_ = "mark what it brings about, as in `meets(effect object.p q);`"
        yield NO_EFFECT.at(node.name.span, help=help_, name=predicate.full_name)


def _unreachable(graph: _Graph, roots: list[Predicate], idle: set[str]) -> Iterator[Diagnostic]:
    """What no goal leads to, but for the `idle`: of these it is said why."""
    whole, schema = graph.whole, graph.schema
    for owner in schema.classes.values():
        if AGENT_TIMELINE in schema.ancestry(owner.name) or owner.is_native:
            roots += (*owner.predicates.values(), *owner.inherited.values())
    reached = graph._reached(roots)
    names: dict[str, set[str]] = {}
    for full_name in reached:
        owner_name, _, name = full_name.partition(".")
        names.setdefault(name, set()).add(owner_name)
    for part in whole.parts:
        if not whole.is_own(part.node.span):
            continue
        dead = [
            (node, predicate)
            for node in part.all(PredicateDecl)
            if (predicate := _declared(graph, part, node)) is not None
            and predicate.full_name not in idle
            and not _is_reached(graph, predicate, names)
        ]
        if isinstance(part.node, ClassDecl) and len(dead) > 1 and len(dead) == len(part.all(PredicateDecl)):
            yield UNREACHABLE.at(part.node.name.span, what=f"any token of class `{part.node.name.name}`")
        else:
            for node, predicate in dead:
                yield UNREACHABLE.at(node.name.span, what=f"a token of `{predicate.full_name}`")
        if isinstance(part.node, RuleDecl) and (predicate := part.tables.predicates.get(part.node)) is not None:
            # Of a predicate that nothing leads to, its declaration is complained about.
            is_told = predicate.class_name in predicate.declared_in and whole.is_own(predicate.span)
            if not is_told and not _is_reached(graph, predicate, names):
                help_ = None
                if made := sorted(set(schema.ancestry(predicate.class_name)) & names.get(predicate.name, set())):
                    help_ = f"tokens are made as `{made[0]}.{predicate.name}`; a rule goes by that, not by the object"
                yield NEVER_FIRES.at(part.node.predicate.span, help=help_, name=predicate.full_name)


def _declared(graph: _Graph, part: Part, node: PredicateDecl) -> Predicate | None:
    name = getattr(getattr(part.node, "name", None), "name", None)
    owner = graph.schema.classes.get(name) if name is not None else None
    return owner.predicates.get(node.name.name) if owner is not None else None


def _is_reached(graph: _Graph, predicate: Predicate, names: dict[str, set[str]]) -> bool:
    owners = names.get(predicate.name, set())
    return any(graph.schema.is_subclass(owner, predicate.class_name) for owner in owners)


def _endless(graph: _Graph) -> Iterator[Diagnostic]:
    """Predicates that in any case ask for another token of the same predicate, at first or second hand."""
    later: _Followers = {}
    same: _Followers = {}
    for part, requests in graph.requests.items():
        for request in requests:
            if not request.is_certain or request.relation.origin is not None:
                continue
            wanted = request.wanted.full_name
            word = request.relation.relation.name
            if wanted in graph.rules and word not in _BACKWARD:
                followers = later if word in _FORWARD else same
                followers.setdefault(graph.names[part], []).append((wanted, request))
    yield from _cycles(graph, same, ENDLESS)
    yield from _cycles(graph, later, CHAIN)


def _cycles(graph: _Graph, followers: _Followers, code: Code) -> Iterator[Diagnostic]:
    _prune(followers)
    told: set[str] = set()
    for name in followers:
        owner, _, word = name.partition(".")
        if name in told:
            continue
        cycle = _cycle(name, followers)
        told.update(each for each, _ in cycle)
        if not cycle or not graph.whole.is_own(cycle[0][1].relation.span):
            continue
        # Tokens that may be equal are merged; and what an agent plans ends with how far it looks ahead.
        if code is ENDLESS and not any(request.is_other for _, request in cycle):
            continue
        if code is CHAIN and AGENT_TIMELINE in graph.schema.ancestry(owner):
            continue
        notes = tuple(Note(f"which asks for `{each}` here", request.relation.span) for each, request in cycle[1:])
        yield code.at(cycle[0][1].relation.span, notes=notes, name=word)


def _prune(followers: _Followers) -> None:
    """Leave out what leads to no cycle."""
    before: dict[str, list[str]] = {}
    count = {name: len(requests) for name, requests in followers.items()}
    for name, requests in followers.items():
        for wanted, _ in requests:
            before.setdefault(wanted, []).append(name)
    pending = [wanted for wanted in before if wanted not in followers]
    while pending:
        for name in before.get(pending.pop(), ()):
            count[name] -= 1
            if count[name] == 0:
                del followers[name]
                pending.append(name)


def _cycle(name: str, followers: _Followers) -> list[tuple[str, ChildRequest]]:
    """The shortest way from a predicate back to itself."""
    ways: _Followers = {}
    frontier: list[str] = [name]
    while frontier:
        following: list[str] = []
        for at in frontier:
            for wanted, request in followers.get(at, ()):
                way = [*ways.get(at, ()), (wanted, request)]
                if wanted == name:
                    return way
                if wanted not in ways:
                    ways[wanted] = way
                    following.append(wanted)
        frontier = following
    return []


def _without_effect(graph: _Graph) -> Iterator[tuple[PredicateDecl, Predicate]]:
    whole = graph.whole
    for part in whole.own(ClassDecl):
        for node in part.all(PredicateDecl):
            if not node.is_action:
                continue
            predicate = _declared(graph, part, node)
            if predicate is None or predicate.name in whole.usage.requested:
                continue  # what is asked for by its name need not bring anything about
            rules = list(graph._rules_for(predicate.class_name, predicate.name))
            below = [
                rule
                for name in graph.rules
                if name.endswith(f".{predicate.name}")
                and graph.schema.is_subclass(name.partition(".")[0], predicate.class_name)
                for rule in graph.rules[name]
            ]
            if not any(request.is_effect for rule in rules + below for request in graph.requests[rule]):
                yield node, predicate
