"""A conflict in, z3's word on it out: do its lines contradict each other, and is each of them needed.

What a line demands is read off the text of the model. Of the engine's account only two things are taken: to which
tokens a line applied, and what no line says (observations, requests, the clock, decisions).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import pairwise

import z3

from checker.proofs.called import Asking, Called, Decider, Opaque
from checker.proofs.claims import Claim, Number, bounds_claim, claim_of, member_claim
from checker.proofs.instructions import (
    assign_claim,
    domain_claim,
    drawn_claim,
    given_claim,
    object_claim,
    post_claim,
    relation_claim,
)
from checker.proofs.levels import demand_claim, is_demand
from checker.proofs.operands import Symbols
from checker.proofs.places import ModelText, WrittenLine
from checker.proofs.term_binding import TermBinding
from compiler.program import (
    DURATION,
    END,
    START,
    Assign,
    Child,
    NewGlobal,
    NewObject,
    NewVariable,
    Post,
    Relate,
    Sample,
    TokenVariable,
)
from runtime.executive.outcome import Conflict, ConflictElement, ElementKind
from runtime.plan.readout.names import TokenName, VariableName
from runtime.plan.readout.statements import Argument, Term

# Work in z3's own unit, not in seconds, so that the answer does not depend on the machine; about two seconds here.
EFFORT = 20_000_000


class Finding(Enum):
    """What z3 says of a conflict."""

    CONFIRMED = "confirmed"  # the lines cannot hold together
    REFUTED = "not confirmed"  # they can: the engine saw more than they say, or is wrong
    UNKNOWN = "undecided"  # z3 gave up


@dataclass(frozen=True, slots=True)
class Confirmation:
    """z3's answer. `core` numbers the elements of a set that contradicts itself and of which each is needed.

    That start + duration = end is what a token is, and in no core.
    `is_minimal`: each was shown to be needed; not so where z3 gave up. `written` counts the elements of the core whose
    meaning was read off the model's text. `called` are constraints in Python in the core: z3 knows of them only what
    calls have shown. `untranslated` names what z3 was not told.
    """

    finding: Finding
    core: tuple[int, ...]
    untranslated: tuple[str, ...]
    is_minimal: bool = True
    written: int = 0
    called: tuple[Called, ...] = ()


def confirm(conflict: Conflict, text: ModelText | None = None, effort: int = EFFORT) -> Confirmation:
    """Ask z3 whether the elements of `conflict` can hold together (the engine said they cannot)."""
    reader = _Reader(text)
    solver = z3.Solver()
    solver.set("rlimit", effort)
    marks = [z3.Bool(f"element {number}") for number in range(len(conflict.elements))]
    untranslated: list[str] = []
    needed: list[int] = []
    written: set[int] = set()
    opaque: dict[int, Opaque] = {}
    for number, element in enumerate(conflict.elements):
        if _is_duration(element):
            continue  # what a token is
        claim = reader.written(element)
        if claim is not None:
            written.add(number)
        elif (asked := reader.opaque(element, marks[number])) is not None:
            opaque[number] = asked
            needed.append(number)
            continue
        claims = reader.told(element, untranslated) if claim is None else [(claim, frozenset())]
        for each, limits in claims:
            # That a token lasts as long as lines let it says nothing without these lines.
            sources = [k for k, other in enumerate(conflict.elements) if k != number and _shares(other, limits)]
            if len({term for k in sources for term in conflict.elements[k].terms}.intersection(limits)) == len(limits):
                solver.add(z3.Implies(z3.And(marks[number], *[marks[k] for k in sources]), each))
        if claims:
            needed.append(number)
    solver.add(*reader.definitions(conflict))
    missing = tuple(dict.fromkeys(untranslated))
    asking = Asking(solver, list(opaque.values()))
    answer = asking.check(*[marks[number] for number in needed])
    if answer != z3.unsat:
        return Confirmation(Finding.REFUTED if answer == z3.sat else Finding.UNKNOWN, (), missing)
    core, is_minimal = minimal_core(asking, marks, needed)
    called = tuple(dict.fromkeys(opaque[number].called for number in core if number in opaque))
    return Confirmation(Finding.CONFIRMED, core, missing, is_minimal, len(written.intersection(core)), called)


def needed_elements(conflict: Conflict, found: Confirmation) -> tuple[int, ...]:
    """The numbers of the elements that the contradiction needs, all of them where z3 has not confirmed it."""
    if found.finding is not Finding.CONFIRMED or found.untranslated:
        return tuple(range(len(conflict.elements)))
    return found.core


def minimal_core(solver: Decider, marks: "Sequence[z3.BoolRef]", needed: Sequence[int]) -> tuple[tuple[int, ...], bool]:
    """Drop one after the other, the first first, while the rest still contradicts itself (deletion-based MUS).

    `solver` has just found that all marks together cannot hold. The second value tells whether each of what is left
    was shown to be needed.
    """
    core = {str(mark) for mark in solver.unsat_core()}
    kept = [number for number in needed if str(marks[number]) in core]
    is_minimal = True
    for number in list(kept):
        rest = [other for other in kept if other != number]
        answer = solver.check(*[marks[other] for other in rest])
        if answer == z3.unsat:
            kept = rest
        elif answer == z3.unknown:
            is_minimal = False
    return tuple(kept), is_minimal


class _Reader:
    """Elements as claims; the variables of a token are named after it, so that lines meet in them."""

    def __init__(self, text: ModelText | None) -> None:
        self.text = text
        self.symbols = Symbols()

    # ---- what the text says ----

    def written(self, element: ConflictElement) -> Claim | None:
        """What the line of an element demands; None where no line says it, or it is not clear of which tokens."""
        reactor = next((one.reactor for one in element.variables), "")
        if self.text is None or element.place is None or len(element.terms) != 1:
            return None
        term = element.terms[0]
        found = [
            claim
            for line in self.text.at(reactor, element.place, element.token.predicate if element.token else "")
            if (claim := self._claim(line, term, element.variables, element.token, reactor)) is not None
        ]
        return found[0] if len(found) == 1 else None

    def _lasts(self, reactor: str, token: TokenName | None) -> Claim:
        start, length, end = (
            self.symbols.variable(f"{reactor}:{token}.{name}", "int") for name in ("start", "duration", "end")
        )
        return start + length == end

    def _claim(
        self, line: WrittenLine, term: Term, variables: Sequence[VariableName], own: TokenName | None, reactor: str
    ) -> Claim | None:
        instruction = line.instruction
        binding = TermBinding(line, self.symbols, variables, own, reactor)
        match instruction:
            case Child() | Relate() if term.name == "precedence":
                return relation_claim(instruction, binding)
            case Child():
                return object_claim(instruction, binding)
            case Post(operands=operands):
                if not _is_of(instruction, term, binding.align(operands, term)):
                    return None
                return post_claim(instruction, binding)
            case Assign() if term.name == "bounds":
                return assign_claim(instruction, binding)
            case Sample(target=target) if term.name == "sampledParameter":
                binding.align((target,), Term("", term.arguments[:1]))
                value = self.symbols.constant(_number(term.arguments[2]), variables[0].kind)
                return drawn_claim(target, value, binding)
            case NewGlobal(domain=domain) if term.name == "bounds" and domain is not None:
                return self.symbols.within(self.number(term.arguments[0]), domain)
            case NewObject() if term.name == "bounds":
                given = given_claim(instruction, variables[0].name, self.number(variables[0]), binding)
                return None if given is None else z3.And(given, bounds_claim(term, self.number))
            case NewVariable(name=str()) if term.name == "bounds":
                local = binding.local(instruction.slot)
                return None if local is None else domain_claim(instruction, local, binding)
            case _:
                return None

    def opaque(self, element: ConflictElement, mark: Claim) -> Opaque | None:
        """The constraint in Python that an element is, if it does not say the same in built-in ones."""
        if self.text is None or element.kind is not ElementKind.CONSTRAINT or len(element.terms) != 1:
            return None
        (term,) = element.terms
        constraint = self.text.constraint(term.name)
        if constraint is None:
            return None
        return Opaque(constraint, mark, term.arguments, [self.number(one) for one in term.arguments], self.symbols)

    # ---- what the flight says ----

    def told(self, element: ConflictElement, untranslated: list[str]) -> list[tuple[Claim, frozenset[Term]]]:
        """What an element says by itself, where no line does; each with the limits that it uses up, if it does."""
        found = []
        terms = element.terms
        if is_demand(terms):
            return [(demand_claim(terms, self.number), frozenset())]
        latest = [number for number, term in enumerate(terms) if term.name == "latest"]
        for number, term in enumerate(terms[: latest[0]] if latest else terms):
            claim = self._term(term)
            limit = _limit_of(terms, number) if element.kind is ElementKind.LONGEST else None
            if claim is None:
                untranslated.append(term.name)
            else:
                found.append((claim, frozenset(() if limit is None else (limit,))))
        for number, after in pairwise([*latest, len(terms)]):
            variable, value = terms[number].arguments
            limits = frozenset(one for one in terms[number + 1 : after] if not _is_length(one))
            found.append((self.number(variable) >= self.number(value), limits))
        return found

    def _term(self, term: Term) -> Claim | None:
        if term.name == "bounds":
            return bounds_claim(term, self.number)
        if term.name == "memberOf":
            return member_claim(term, self.number)
        if term.name == "sampledParameter":
            return self.number(term.arguments[0]) == self.number(term.arguments[2])
        if any(isinstance(one, float) and not math.isfinite(one) for one in term.arguments):
            return None
        numbers = [self.number(one) for one in term.arguments]
        if term.name == "precedence":
            return numbers[1] - numbers[0] <= numbers[2]
        return claim_of(term.name, numbers)

    def number(self, operand: Argument) -> Number:
        """A variable, a number, or the number of a name."""
        if isinstance(operand, VariableName):
            return self.symbols.variable(f"{operand.reactor}:{operand}", operand.kind)
        return self.symbols.constant(operand, "float" if isinstance(operand, float) else "int")

    def definitions(self, conflict: Conflict) -> list[Claim]:
        """What variables are: truth values are 0 or 1, a token ends its duration after its start."""
        named = conflict.variables
        found = [z3.And(self.number(one) >= 0, self.number(one) <= 1) for one in named if one.kind == "bool"]
        owners = dict.fromkeys((one.reactor, one.token) for one in named if one.token is not None)
        for reactor, token in owners:
            found.append(self._lasts(reactor, token))
            if self._is_event(reactor, token):
                names = (f"{reactor}:{token}.{name}" for name in ("time", "start", "end"))
                found += [a == b for a, b in pairwise(self.symbols.variable(name, "int") for name in names)]
        return found

    def _is_event(self, reactor: str, token: TokenName) -> bool:
        """Whether a token has one time only."""
        program = self.text.programs.get(reactor) if self.text is not None else None
        codes = program.predicates if program is not None else ()
        return any(code.is_event for code in codes if code.name == token.predicate)


def _is_duration(element: ConflictElement) -> bool:
    """Whether an element says that start + duration = end of one token."""
    return len(element.terms) == 1 and _is_length(element.terms[0])


def _is_length(term: Term) -> bool:
    match term:
        case Term(name="temporalDistance", arguments=(VariableName() as a, VariableName() as b, VariableName() as c)):
            return (a.name, b.name, c.name) == ("start", "duration", "end") and a.token == b.token == c.token
        case _:
            return False


def _shares(element: ConflictElement, terms: frozenset[Term]) -> bool:
    return not terms.isdisjoint(element.terms)


def _limit_of(terms: Sequence[Term], number: int) -> Term | None:
    """The term that is used up where a term holds; `a <= b` is in a pair of terms (runtime/executive/story.py)."""
    match terms[number].name, terms[number].arguments:
        case "precedence", (target, source, int(weight)):
            return Term("precedence", (source, target, -weight))
        case "lt", (most, _) if number:
            return Term("leq", (terms[number - 1].arguments[0], most))
        case _:
            return None


def _number(value: Argument) -> float | int:
    assert isinstance(value, int | float)
    return value


def _is_of(post: Post, term: Term, is_aligned: bool) -> bool:
    """Whether a term may be what the engine made of a constraint: the same one, or an edge between two times."""
    return is_aligned or (term.name == "precedence" and _is_temporal(post))


def _is_temporal(post: Post) -> bool:
    points = (START, END, DURATION)
    return any(isinstance(each, TokenVariable) and each.variable in points for each in post.operands)
