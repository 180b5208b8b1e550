"""Say with z3 whether a small model has a plan.

All tokens that rules may ask for are laid out; each may stand alone, merge with another of its predicate, be rejected
if that is allowed, or not be there, with all that follows from it.
"""

from dataclasses import dataclass, field
from typing import Any

import z3

from tests.solver.whole.meaning import Find, Formula, Span, Use, Values, claimed, one_of, related, within_limits
from tests.solver.whole.model import (
    EVENTS,
    RESOURCES,
    Aim,
    Body,
    Call,
    Child,
    If,
    Local,
    Model,
    Relate,
    Variable,
)

MOST_TOKENS = 30
LONGEST_CHAIN = 4  # a predicate that asks for itself does so with a smaller number, of which there are no more


class TooLargeError(Exception):
    """More tokens than may be laid out."""


@dataclass
class Node:
    """A token that may be: its terms, and when it is there."""

    kind: str
    is_there: Formula
    is_active: Formula
    object: Formula
    start: Formula
    end: Formula
    parameters: dict[str, Formula]
    may_be_rejected: bool = False
    must_be_active: bool = False

    @property
    def span(self) -> Span:
        return Span(self.start, self.end)


@dataclass
class Frame:
    """What names mean in a rule of a token; the tokens and locals of outer blocks are seen too."""

    node: Node
    children: dict[str, Node] = field(default_factory=dict)
    locals: dict[str, Formula] = field(default_factory=dict)

    def inner(self) -> "Frame":
        return Frame(self.node, dict(self.children), dict(self.locals))


class Layout:
    """All tokens that a plan of a model may have, and what must hold of them."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.values = Values(model)
        self.solver = z3.Solver()
        self.nodes: list[Node] = []
        self.uses: list[Use] = []
        self.globals: dict[str, Formula] = {}
        self.members: dict[tuple[int, str], Formula] = {}
        self.count = 0
        self.lay_out()

    def lay_out(self) -> None:
        """Objects and globals, aims with all that follows from them, then what relates tokens."""
        model = self.model
        for k, thing in enumerate(model.things):
            for name, values in zip(
                () if thing.class_name in RESOURCES else model.class_of(thing.class_name).members,
                thing.members,
                strict=True,
            ):
                self.members[k, name] = self.variable(Variable(f"{thing.name}.{name}", "int", values), z3.BoolVal(True))
        for variable in model.globals:
            self.globals[variable.name] = self.variable(variable, z3.BoolVal(True))
        aims = {aim.label: self.aim(aim) for aim in model.aims}
        outside = Frame(next(iter(aims.values())), aims)
        for variable in model.assigned:
            self.solver.add(self.values.within(self.term(outside, variable.name), variable))
        for claim in model.claims:
            self.solver.add(self.said(claim, outside))
        for node in aims.values():
            self.run_rules(node, ())
        self.fix_states()
        self.keep_apart()
        self.solver.add(within_limits(model, self.uses))

    def variable(self, variable: Variable, when: Formula) -> Formula:
        """A term of its own for a variable, with one of its values where it is there."""
        self.count += 1
        term = self.values.fresh(f"{variable.name}.{self.count}", variable.type)
        self.solver.add(z3.Implies(when, self.values.within(term, variable)))
        return term

    def aim(self, aim: Aim) -> Node:
        """A token of the script."""
        node = self.node(aim.kind, z3.BoolVal(True))
        node.may_be_rejected = aim.how == "rejectable"
        node.must_be_active = aim.is_active
        if aim.owner in self.values.things:
            self.solver.add(node.object == self.values.things[aim.owner])
        return node

    def node(self, kind: str, is_there: Formula) -> Node:
        """A token with what its predicate says of it."""
        if len(self.nodes) >= MOST_TOKENS:
            raise TooLargeError
        predicate = self.model.predicate(kind)
        k = len(self.nodes)
        start = z3.Int(f"start.{k}")
        end = start if kind in EVENTS else z3.Int(f"end.{k}")
        owner = Variable("object", kind.partition(".")[0], ())
        node = Node(kind, is_there, z3.Bool(f"active.{k}"), self.variable(owner, is_there), start, end, {})
        node.parameters = {each.name: self.variable(each, is_there) for each in predicate.parameters}
        self.nodes.append(node)
        frame = Frame(node)
        if kind not in EVENTS:
            self.solver.add(z3.Implies(is_there, end >= start + 1))
        for claim in predicate.claims:
            self.solver.add(z3.Implies(is_there, claimed(claim, self.finder(frame))))
        if kind.partition(".")[0] in RESOURCES:
            node.must_be_active = True
            sign = 1 if kind == "Reservoir.produce" else -1
            amount = sign * node.parameters["quantity"]
            self.uses.append(Use(node.is_active, node.object, start, None if kind in EVENTS else end, amount))
        return node

    # ---- rules ----

    def run_rules(self, node: Node, chain: tuple[str, ...]) -> None:
        """Everything that follows if a token is active."""
        if chain.count(node.kind) == LONGEST_CHAIN:
            self.solver.add(z3.Not(node.is_active))
            return
        for body in self.model.bodies(node.kind):
            self.run(body, Frame(node), node.is_active, (*chain, node.kind))

    def run(self, body: Body, frame: Frame, when: Formula, chain: tuple[str, ...]) -> None:
        """What a block says when it runs."""
        for statement in body:
            match statement:
                case Local(variable):
                    frame.locals[variable.name] = self.variable(variable, when)
                case Child(label, relation, owner, kind):
                    child = self.node(kind, when)
                    frame.children[label] = child
                    self.solver.add(z3.Implies(when, related(relation, frame.node.span, child.span)))
                    if owner not in self.values.of_class:
                        self.solver.add(z3.Implies(when, child.object == self.term(frame, owner)))
                    self.run_rules(child, chain)
                case If(condition, then, otherwise):
                    holds = claimed(condition, self.finder(frame))
                    self.run(then, frame.inner(), z3.And(when, holds), chain)
                    self.run(otherwise, frame.inner(), z3.And(when, z3.Not(holds)), chain)
                case Call("uses", (thing, amount, _, _)):
                    charged = -self.term(frame, amount)
                    self.uses.append(Use(when, self.term(frame, thing), frame.node.start, frame.node.end, charged))
                case _:
                    self.solver.add(z3.Implies(when, self.said(statement, frame)))

    def said(self, statement: Any, frame: Frame) -> Formula:
        """What a claim or a relation between tokens that are there says."""
        if isinstance(statement, Relate):
            return related(
                statement.relation, frame.children[statement.origin].span, frame.children[statement.target].span
            )
        return claimed(statement, self.finder(frame))

    def finder(self, frame: Frame) -> Find:
        return lambda name: self.term(frame, name)

    def term(self, frame: Frame, name: str) -> Formula:
        """What a name, path or constant means in a rule."""
        constant = self.values.constant(name)
        if constant is not None:
            return constant
        first, _, rest = name.partition(".")
        if rest and first in frame.children:
            return self.term(Frame(frame.children[first]), rest)
        if rest:
            index = self.term(frame, first)
            return one_of(index, [(k, term) for (k, member), term in self.members.items() if member == rest])
        node = frame.node
        for table in (frame.locals, node.parameters, self.globals):
            if name in table:
                return table[name]
        times = {"start": node.start, "time": node.start, "end": node.end, "object": node.object}
        return node.end - node.start if name == "duration" else times[name]

    # ---- between tokens ----

    def fix_states(self) -> None:
        """Each token that is there stands for itself, is merged with one that does, or is rejected."""
        for k, node in enumerate(self.nodes):
            ways = [node.is_active]
            if node.must_be_active:
                self.solver.add(node.is_active == node.is_there)
                continue
            if node.may_be_rejected:
                ways.append(z3.Bool(f"rejected.{k}"))
            for i, other in enumerate(self.nodes):
                if i != k and other.kind == node.kind:
                    way = z3.Bool(f"merged.{k}.{i}")
                    ways.append(way)
                    alike = [node.parameters[name] == term for name, term in other.parameters.items()]
                    alike += [node.object == other.object, node.start == other.start, node.end == other.end]
                    self.solver.add(z3.Implies(way, z3.And(other.is_active, *alike)))
            self.solver.add(z3.Implies(node.is_there, z3.PbEq([(way, 1) for way in ways], 1)))
            self.solver.add(z3.Implies(z3.Not(node.is_there), z3.Not(z3.Or(ways))))

    def keep_apart(self) -> None:
        """Tokens on one timeline follow each other."""
        for k, one in enumerate(self.nodes):
            owner = one.kind.partition(".")[0]
            if owner in RESOURCES or not self.model.class_of(owner).is_timeline:
                continue
            for other in self.nodes[:k]:
                if other.kind.partition(".")[0] == owner:
                    apart = z3.Or(one.end <= other.start, other.end <= one.start)
                    shared = z3.And(one.is_active, other.is_active, one.object == other.object)
                    self.solver.add(z3.Implies(shared, apart))


def has_plan(model: Model) -> bool | None:
    """Whether there is any plan; None if that is too much to lay out."""
    try:
        found = Layout(model).solver.check()
    except TooLargeError:
        return None
    assert found != z3.unknown
    return bool(found == z3.sat)
