"""Judge what `nddlc plan --json` prints by the model alone: is it a plan, and are its times just those that it leaves.

Every token that rules ask for must be there, stand where its rule wants it, and all claims must hold if everything
starts as early as is told, and again if as late as is told. Where no resource plays a part, no other times may do.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import islice, pairwise, permutations, product
from math import inf
from typing import Any

import z3

from tests.solver.whole.meaning import Find, Formula, Span, Use, Values, claimed, one_of, related, within_limits
from tests.solver.whole.model import (
    EVENTS,
    RESOURCES,
    Body,
    Call,
    Child,
    Claim,
    If,
    Local,
    Model,
    Relate,
    Variable,
)

Facts = dict[str, Any]
DOMAIN = re.compile(r"(\{|\[)(.*)(\}|\]) (\S+)")
MOST_MATCHINGS = 200
SLACK = 1e-4  # floats closer than 1e-5 are equal, each step of a chain may use that up


class ObjectionError(Exception):
    """Why something is no plan."""


def expect(holds: object, *why: object) -> None:
    """Object unless something holds."""
    if not holds:
        raise ObjectionError(" ".join(map(str, why)))


@dataclass
class Frame:
    """What names mean while the rules of a token run."""

    token: str
    children: dict[str, str] = field(default_factory=dict)
    locals: dict[str, str] = field(default_factory=dict)  # name to the key of its domain

    def inner(self) -> "Frame":
        return Frame(self.token, dict(self.children), dict(self.locals))


class Told:
    """What was printed: tokens by name, domains by key, and a term of z3 for each."""

    def __init__(self, model: Model, told: Facts) -> None:
        self.model = model
        self.values = Values(model)
        self.domains: dict[str, str] = told["domains"]
        self.tokens: dict[str, Facts] = {token["id"]: token for token in told["tokens"]}
        self.order: dict[str, list[str]] = told["order"]
        expect(len(self.tokens) == len(told["tokens"]), "two tokens of one name")
        self.terms: dict[str, Formula] = {}
        self.types: dict[str, Variable] = {}

    def stands_for(self, name: str) -> str:
        """The token that stands for one."""
        token = self.tokens[name]
        return token["merged_into"] if token["state"] == "MERGED" else name

    def children_of(self, name: str) -> list[str]:
        return [child for child, token in self.tokens.items() if token["master"] == name]

    def asked(self, child: str) -> tuple[str, str]:
        """What a rule asked for when it got a child."""
        return self.tokens[child]["predicate"], self.tokens[child]["relation"]

    def term(self, key: str, type_: str) -> Formula:
        """The term of the variable with that key."""
        expect(key in self.domains, "no domain told of", key)
        if key not in self.terms:
            self.terms[key] = self.values.fresh(key, type_)
        return self.terms[key]

    def values_told(self, key: str) -> tuple[bool, list[str]]:
        """Whether a domain is an interval, and its bounds or values."""
        found = DOMAIN.fullmatch(self.domains[key])
        expect(found, "unreadable domain", self.domains[key])
        assert found is not None
        return found[1] == "[", [item for item in found[2].split(", ") if item]

    def is_told(self, key: str, slack: float) -> Formula:
        """That a variable has one of the values told."""
        is_interval, items = self.values_told(key)
        term = self.terms[key]
        if is_interval:
            low, high = (float(item) for item in items)
            kept = [] if low == -inf else [term >= z3.RealVal(repr(low - slack))]
            return z3.And(kept if high == inf else [*kept, term <= z3.RealVal(repr(high + slack))])
        return z3.Or([term == self.values.constant(item) for item in items])


class Judge:
    """One way to say which token is which child; collects what must hold."""

    def __init__(self, told: Told, horizon: tuple[int, int]) -> None:
        self.told = told
        self.model = told.model
        self.horizon = horizon
        self.said: list[Formula] = []
        self.uses: list[Use] = []
        self.early: list[Formula] = []
        self.late: list[Formula] = []
        self.wider: list[Formula] = []
        self.fixed: list[Formula] = []

    # ---- terms ----

    def times(self, name: str) -> Span:
        """The times of the token that stands for one; both are the same for an event."""
        name = self.told.stands_for(name)
        if self.told.tokens[name]["predicate"] in EVENTS:
            at = self.told.term(f"{name}.time", "int")
            return Span(at, at)
        return Span(self.told.term(f"{name}.start", "int"), self.told.term(f"{name}.end", "int"))

    def find(self, frame: Frame) -> Find:
        return lambda name: self.term(frame, name)

    def term(self, frame: Frame, name: str) -> Formula:
        """What a name, path or constant means."""
        constant = self.told.values.constant(name)
        if constant is not None:
            return constant
        first, _, rest = name.partition(".")
        if rest and first in frame.children:
            return self.term(Frame(self.told.stands_for(frame.children[first])), rest)
        if rest:
            members = [
                (k, self.told.term(f"{thing.name}.{rest}", "int"))
                for k, thing in enumerate(self.model.things)
                if thing.class_name not in RESOURCES and rest in self.model.class_of(thing.class_name).members
            ]
            return one_of(self.term(frame, first), members)
        if name in frame.locals:
            return self.told.term(frame.locals[name], self.type_of(frame.locals[name]))
        if any(each.name == name for each in self.model.globals):
            return self.told.term(name, self.type_of(name))
        return self.told.term(f"{frame.token}.{name}", self.type_of(f"{frame.token}.{name}"))

    def type_of(self, key: str) -> str:
        """Whether a domain is of floats."""
        return "float" if self.told.domains.get(key, "").endswith("float") else "int"

    def is_true(self, claim: Claim, frame: Frame) -> bool:
        """The truth of a guard, whose variables must be decided."""
        said = claimed(claim, self.find(frame))
        values = []
        for key, term in self.told.terms.items():
            is_interval, items = self.told.values_told(key)
            if len(items) == 1 and not is_interval:
                values.append((term, self.told.values.constant(items[0])))
        truth = z3.simplify(z3.substitute(said, *values))
        expect(z3.is_true(truth) or z3.is_false(truth), frame.token, "tests what is not decided:", claim)
        return bool(z3.is_true(truth))

    # ---- rules ----

    def run_rules(self, name: str, children: list[str]) -> None:
        """Have all that follows from an active token; `children` in the order in which the text asks for them."""
        left = list(children)
        for body in self.model.bodies(self.told.tokens[name]["predicate"]):
            self.run(body, Frame(name), left)
        expect(not left, "nobody asked for", left)

    def run(self, body: Body, frame: Frame, left: list[str]) -> None:
        """What a block says."""
        for statement in body:
            match statement:
                case Local(variable):
                    key = f"{frame.token}::{variable.name}"
                    frame.locals[variable.name] = key
                    self.have(key, variable)
                case Child(label, relation, owner, kind):
                    child = next((each for each in left if self.told.asked(each) == (kind, relation)), None)
                    expect(child is not None, frame.token, "lacks its child", label)
                    assert child is not None
                    left.remove(child)
                    frame.children[label] = child
                    expect(self.told.tokens[child]["state"] in ("ACTIVE", "MERGED"), child, "is not in the plan")
                    self.said.append(related(relation, self.times(frame.token), self.times(child)))
                    if owner not in self.told.values.of_class:
                        self.said.append(self.object_of(child) == self.term(frame, owner))
                case If(condition, then, otherwise):
                    self.run(then if self.is_true(condition, frame) else otherwise, frame.inner(), left)
                case Call("uses", (thing, amount, _, _)):
                    span = self.times(frame.token)
                    charged = -self.term(frame, amount)
                    self.uses.append(Use(z3.BoolVal(True), self.term(frame, thing), span.start, span.end, charged))
                case _:
                    self.claim(statement, frame)

    def claim(self, statement: Claim | Relate | Any, frame: Frame) -> None:
        """A claim or relation."""
        if isinstance(statement, Relate):
            origin, target = frame.children[statement.origin], frame.children[statement.target]
            self.said.append(related(statement.relation, self.times(origin), self.times(target)))
        else:
            self.said.append(claimed(statement, self.find(frame)))

    def have(self, key: str, variable: Variable) -> None:
        """A variable: its values by the model, and by what is told; decided if it can be."""
        term = self.told.term(key, variable.type)
        self.said.append(self.told.values.within(term, variable))
        is_interval, items = self.told.values_told(key)
        if not variable.is_wide:
            expect(len(items) == 1 and not is_interval, key, "is not decided")
        self.fixed.append(self.told.is_told(key, SLACK if variable.type == "float" else 0.0))

    def object_of(self, name: str) -> Formula:
        return self.told.term(f"{self.told.stands_for(name)}.object", "int")

    # ---- the plan ----

    def tokens(self) -> Iterator[tuple[str, Facts]]:
        """Those that have variables."""
        return ((name, token) for name, token in self.told.tokens.items() if token["state"] != "MERGED")

    def see_token(self, name: str, token: Facts) -> None:
        """What holds of a token by its predicate, and the times told."""
        kind = token["predicate"]
        for variable in self.model.predicate(kind).parameters:
            if token["state"] == "ACTIVE" and kind.partition(".")[0] not in RESOURCES:
                self.have(f"{name}.{variable.name}", variable)
            else:
                term = self.told.term(f"{name}.{variable.name}", variable.type)
                self.said.append(self.told.values.within(term, variable))
                self.fixed.append(self.told.is_told(f"{name}.{variable.name}", SLACK))
        self.told.term(f"{name}.object", "int")
        self.fixed.append(self.told.is_told(f"{name}.object", 0.0))
        span = self.times(name)
        if kind not in EVENTS:
            duration = self.told.term(f"{name}.duration", "int")
            self.said += [duration >= 1, span.end == span.start + duration]
            self.fixed.append(self.told.is_told(f"{name}.duration", 0.0))
        for key, term in (("time", span.start),) if kind in EVENTS else (("start", span.start), ("end", span.end)):
            low, high = (float(bound) for bound in token["start" if key == "time" else key])
            expect(low > self.horizon[0] and high < self.horizon[1], name, "is not within the horizon")
            self.early.append(term == int(low))
            self.late.append(term == int(high))
            self.wider += [term < int(low), term > int(high)]
        for claim in self.model.predicate(kind).claims:
            self.said.append(claimed(claim, self.find(Frame(name))))

    def see_script(self) -> None:
        """Objects, globals, aims and what the script says of them."""
        model, told = self.model, self.told
        for thing in model.things:
            names = () if thing.class_name in RESOURCES else model.class_of(thing.class_name).members
            for name, values in zip(names, thing.members, strict=True):
                self.have(f"{thing.name}.{name}", Variable(name, "int", values))
        for variable in model.globals:
            self.have(variable.name, variable)
        frame = Frame("", {aim.label: aim.label for aim in model.aims})
        for aim in model.aims:
            expect(aim.label in told.tokens, aim.label, "is lost")
            token = told.tokens[aim.label]
            expect(token["predicate"] == aim.kind and token["master"] is None, aim.label, "is another token")
            states = {"ACTIVE"} if aim.is_active or aim.kind.partition(".")[0] in RESOURCES else {"ACTIVE", "MERGED"}
            expect(token["state"] in states | ({"REJECTED"} if aim.how == "rejectable" else set()), aim.label, token)
            if aim.owner in told.values.things:
                self.said.append(self.object_of(aim.label) == told.values.things[aim.owner])
        for variable in model.assigned:
            self.said.append(told.values.within(self.term(frame, variable.name), variable))
        for claim in model.claims:
            self.claim(claim, frame)

    def see_timelines(self) -> None:
        """Each active token on a timeline has its place there, and neighbours do not overlap."""
        for name, token in self.tokens():
            owner = token["predicate"].partition(".")[0]
            if token["state"] == "ACTIVE" and owner not in RESOURCES and self.model.class_of(owner).is_timeline:
                _, items = self.told.values_told(f"{name}.object")
                expect(len(items) == 1 and self.told.order.get(items[0], []).count(name) == 1, name, "has no place")
        for sequence in self.told.order.values():
            for one, other in pairwise(sequence):
                self.said.append(self.times(one).end <= self.times(other).start)

    def see_uses(self) -> None:
        """Active tokens of resources charge them."""
        for name, token in self.tokens():
            if token["predicate"].partition(".")[0] in RESOURCES and token["state"] == "ACTIVE":
                span = self.times(name)
                end = None if token["predicate"] in EVENTS else span.end
                amount = self.told.term(f"{name}.quantity", "float")
                signed = amount if token["predicate"] == "Reservoir.produce" else -amount
                self.uses.append(Use(z3.BoolVal(True), self.object_of(name), span.start, end, signed))

    def judge(self) -> None:
        """Raise an objection unless everything holds."""
        self.see_script()
        for name, token in self.tokens():
            self.see_token(name, token)
        self.see_timelines()
        self.see_uses()
        limits = within_limits(self.model, self.uses)
        for what, schedule in (("earliest", self.early), ("latest", self.late)):
            expect(holds(self.said + self.fixed + limits + schedule), "the", what, "times are no plan")
        if not self.uses:
            free = [self.told.is_told(key, 0.0) for key in self.told.terms if self.is_decided(key)]
            expect(not holds([*self.said, *free, z3.Or(self.wider)]), "times that would do are left out")

    def is_decided(self, key: str) -> bool:
        """Whether a variable has one value, and is no time."""
        is_interval, items = self.told.values_told(key)
        return len(items) == 1 and not is_interval and key.rpartition(".")[2] not in ("start", "end", "duration")


def holds(formulas: list[Formula]) -> bool:
    """Whether all hold for some values."""
    solver = z3.Solver()
    solver.add(formulas)
    return bool(solver.check() == z3.sat)


def judge_plan(model: Model, told: Facts, horizon: tuple[int, int]) -> None:
    """Raise an objection unless what is told is a plan of the model."""
    seen = Told(model, told)
    for name, token in seen.tokens.items():
        expect(token["state"] in ("ACTIVE", "MERGED", "REJECTED"), name, "is open")
        if token["state"] == "MERGED":
            other = seen.tokens.get(token["merged_into"])
            expect(other is not None and other["state"] == "ACTIVE", name, "is merged with nothing")
            assert other is not None
            expect(other["predicate"] == token["predicate"], name, "is merged with another predicate")
        if token["master"] is None:
            expect(any(aim.label == name for aim in model.aims), name, "came from nowhere")
        else:
            expect(seen.tokens.get(token["master"], {}).get("state") == "ACTIVE", name, "has no parent in the plan")
    first: ObjectionError | None = None
    active = [name for name, token in seen.tokens.items() if token["state"] == "ACTIVE"]
    for orders in islice(product(*(ways(seen, name) for name in active)), MOST_MATCHINGS):
        judge = Judge(seen, horizon)
        try:
            for name, children in zip(active, orders, strict=True):
                judge.run_rules(name, children)
            judge.judge()
        except ObjectionError as objection:
            first = first or objection
        else:
            return
    assert first is not None
    raise first


def ways(told: Told, name: str) -> list[list[str]]:
    """The orders in which the children of a token may have been asked for, as far as its own rules can tell.

    Guards fire when their variables are decided, so that the order of making does not tell children apart that have
    the same predicate and relation. As told comes first.
    """
    alike: dict[tuple[str, str], list[str]] = {}
    for child in told.children_of(name):
        alike.setdefault(told.asked(child), []).append(child)
    found: list[list[str]] = []
    first: ObjectionError | None = None
    for orders in product(*map(permutations, alike.values())):
        children = [child for order in orders for child in order]
        try:
            Judge(told, (0, 0)).run_rules(name, children)
        except ObjectionError as objection:
            first = first or objection
        else:
            found.append(children)
    if not found:
        assert first is not None
        raise first
    return found
