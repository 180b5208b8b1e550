"""Rule satisfiability: for each rule and branch a witness, or the smallest set of lines that contradict each other.

A rule is taken by itself: its own token and the tokens that it asks for, each with what its predicate declares, and the
constants that the script sets. What other rules demand, and loops over objects, are left out: what is impossible here
is impossible in every plan.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import z3

from checker.proofs.claims import Claim, Number
from checker.proofs.codes import DEAD_BRANCH, IMPOSSIBLE_BRANCH, IMPOSSIBLE_RULE
from checker.proofs.conflict import minimal_core
from checker.proofs.instructions import assign_claim, domain_claim, object_claim, post_claim, relation_claim
from checker.proofs.operands import ProgramNames, Symbols, name_of, names_of, number, token_number
from compiler.program import (
    END,
    FIRST_PARAMETER,
    START,
    Assign,
    Call,
    Child,
    GlobalVariable,
    Guard,
    Instruction,
    NewGlobal,
    NewVariable,
    Operand,
    Post,
    Program,
    Relate,
    RuleCode,
)
from nddl_lang.text.diagnostic import Code, Diagnostic, Note
from nddl_lang.text.source import Span

_EFFORT = 2_000_000  # of one question, in z3's own unit
_MOST_GUARDS = 60  # of one rule


@dataclass(frozen=True, eq=False, slots=True)
class _Line:
    """What one line demands; `span` None: what tokens are."""

    claim: Claim
    span: Span | None


@dataclass(frozen=True, slots=True)
class Witness:
    """An example of a rule, or of a branch of it: values of the tokens' times and parameters."""

    predicate: str
    branch: Span | None
    values: tuple[tuple[str, str], ...]


def prove_rules(program: Program) -> tuple[list[Diagnostic], list[Witness]]:
    """What is impossible in the rules of a program, and examples of what is possible."""
    names = names_of(program)
    found: list[Diagnostic] = []
    witnesses: list[Witness] = []
    for rule in program.rules:
        proof = _RuleProof(names, rule)
        found += proof.findings()
        witnesses += proof.witnesses
    return found, witnesses


def _constants(program: Program, binding: "_Free") -> list[_Line]:
    """Global variables that the script sets once and for all, and what is declared of the others."""
    touched = {
        each.variable.index
        for each in program.script
        if isinstance(each, Call) and isinstance(each.variable, GlobalVariable)
    }
    lines = []
    for each in program.script:
        match each:
            case NewGlobal(index=index, domain=domain) if index not in touched and domain is not None:
                target = binding.world(index)
                lines.append(_Line(binding.symbols.within(target, domain), each.span))
            case Assign(target=GlobalVariable(index=index)) if index not in touched:
                claim = assign_claim(each, binding)
                if claim is not None:
                    lines.append(_Line(claim, each.span))
            case _:
                pass
    return lines


class _Free:
    """Everything that a body names, free: tokens and locals by their slots, globals by name, members unknown."""

    def __init__(self, names: ProgramNames, symbols: Symbols) -> None:
        self.names = names
        self.symbols = symbols
        self.predicates: dict[int, str] = {}
        self.labels: dict[int, str] = {}
        self.slots: dict[int, Number] = {}

    def token(self, slot: int) -> tuple[str, str] | None:
        """A token by its label."""
        known = self.predicates.get(slot)
        return None if known is None else (self.labels[slot], known)

    def local(self, slot: int) -> Number | None:
        """A local variable."""
        return self.slots.get(slot)

    def world(self, index: int) -> Number:
        """A global variable by its name."""
        name, code = self.names.program.globals[index]
        return self.symbols.variable(f"global {name}", code.kind)

    def member(self, base: Operand | None, members: Sequence[str]) -> Number | None:
        """A member may be anything."""
        return None


class _RuleProof:
    """The questions about one rule."""

    def __init__(self, names: ProgramNames, rule: RuleCode) -> None:
        self.rule = rule
        self.binding = _Free(names, Symbols())
        self.witnesses: list[Witness] = []
        self.constants = _constants(names.program, self.binding)
        if self._check(self.constants)[0] == z3.unsat:
            self.constants = []  # the script's own fault
        self.guards = 0

    def findings(self) -> Iterator[Diagnostic]:
        """What is impossible in the rule."""
        base = [*self.constants, *self._token(0, self.rule.predicate, "")]
        lines = [*base, *self._lines(self.rule.body)]
        core = self._contradiction(lines, None)
        if core:
            yield _finding(IMPOSSIBLE_RULE, core, self.rule.span, predicate=self.rule.predicate)
            return
        yield from self._branches(self.rule.body, lines)

    def _branches(self, body: Sequence[Instruction], lines: list[_Line]) -> Iterator[Diagnostic]:
        for each in body:
            if not isinstance(each, Guard) or self.guards >= _MOST_GUARDS:
                continue
            self.guards += 1
            condition = number(each.condition, self.binding, [])
            for branch, holds in ((each.then, True), (each.otherwise, False)):
                if not branch or condition is None or not z3.is_arith(condition):
                    continue
                claim = condition != 0 if holds else condition == 0
                inside = [*lines, _Line(claim, each.span)]
                core = self._contradiction(inside, None)
                if core:
                    if not self._is_switch(each, lines):
                        where = branch[0].span
                        yield DEAD_BRANCH.at(where, why=_why(holds), notes=_notes(core, where, each.span))
                    continue
                kept = dict(self.binding.predicates), dict(self.binding.labels), dict(self.binding.slots)
                whole = [*inside, *self._lines(branch)]
                core = self._contradiction(whole, branch[0].span)
                if core and not _is_forbidden(core):
                    yield _finding(IMPOSSIBLE_BRANCH, core, branch[0].span)
                elif not core:
                    yield from self._branches(branch, whole)
                self.binding.predicates, self.binding.labels, self.binding.slots = kept

    def _is_switch(self, guard: Guard, lines: Sequence[_Line]) -> bool:
        """Whether the condition follows from constants alone."""
        spans = {id(each) for each in self.constants}
        condition = number(guard.condition, self.binding, [])
        own = [each for each in lines if id(each) in spans or _inside(each.span, guard.span)]
        assert condition is not None
        answers = [self._check([*own, _Line(claim, None)])[0] for claim in (condition != 0, condition == 0)]
        return z3.unsat in answers

    # ---- lines ----

    def _token(self, slot: int, predicate: str, label: str) -> list[_Line]:
        """What a token is, and what its predicate declares."""
        binding = self.binding
        binding.predicates[slot] = predicate
        name = label or ("this" if slot == 0 else f"{predicate}#{slot}")
        is_taken = any(known == name for other, known in binding.labels.items() if other != slot)
        binding.labels[slot] = f"{name}#{slot}" if is_taken else name
        code = binding.names.predicates.get(predicate)
        if code is None:
            return []
        name = binding.labels[slot]
        start, end, length = (
            binding.symbols.variable(f"{name}.{each}", "int") for each in ("start", "end", "duration")
        )
        least = 0 if code.is_event else 1
        lines = [_Line(z3.And(start + length == end, length >= least), None)]
        if code.is_event:
            lines.append(_Line(length == 0, None))
        for k, parameter in enumerate(code.parameters):
            target = token_number(name, predicate, FIRST_PARAMETER + k, binding.names, binding.symbols)
            assert target is not None
            if parameter.type.kind == "bool":
                lines.append(_Line(z3.And(target >= 0, target <= 1), None))
            for domain in (parameter.type.domain, parameter.domain):
                if domain is not None:
                    lines.append(_Line(binding.symbols.within(target, domain), parameter.span))
        kept = binding.predicates, binding.labels, binding.slots
        binding.predicates, binding.labels, binding.slots = {0: predicate}, {0: name}, {}
        lines += self._lines(code.body)
        binding.predicates, binding.labels, binding.slots = kept
        return lines

    def _lines(self, body: Sequence[Instruction]) -> list[_Line]:
        """What the lines of a body demand in any case."""
        found: list[_Line] = []
        binding = self.binding
        for each in body:
            claim: Claim | None = None
            match each:
                case NewVariable(slot=slot, type=code):
                    target = binding.slots[slot] = binding.symbols.anonymous(code.kind)
                    claim = domain_claim(each, target, binding)
                case Post():
                    claim = post_claim(each, binding)
                case Child(slot=slot):
                    found += self._token(slot, each.predicate, each.label or "")
                    claim = relation_claim(each, binding)
                    placed = object_claim(each, binding)
                    claim = claim if placed is None else placed if claim is None else z3.And(claim, placed)
                case Relate():
                    claim = relation_claim(each, binding)
                case Assign():
                    claim = assign_claim(each, binding)
                case _:
                    pass
            if claim is not None:
                found.append(_Line(claim, each.span))
        return found

    # ---- questions ----

    def _check(self, lines: Sequence[_Line]) -> "tuple[z3.CheckSatResult, z3.Solver, list[z3.BoolRef]]":
        solver = z3.Solver()
        solver.set("rlimit", _EFFORT)
        marks = [z3.Bool(f"line {k}") for k in range(len(lines))]
        for mark, line in zip(marks, lines, strict=True):
            solver.add(line.claim if line.span is None else z3.Implies(mark, line.claim))
        return solver.check(*marks), solver, marks

    def _contradiction(self, lines: Sequence[_Line], branch: Span | None) -> list[_Line]:
        """The lines of a smallest set that contradict each other; none where there is a witness, or z3 gives up."""
        answer, solver, marks = self._check(lines)
        if answer == z3.sat:
            self.witnesses.append(Witness(self.rule.predicate, branch, self._values(solver.model())))
        if answer != z3.unsat:
            return []
        core, _ = minimal_core(solver, marks, range(len(lines)))
        return [lines[k] for k in core if lines[k].span is not None]

    def _values(self, model: "z3.ModelRef") -> tuple[tuple[str, str], ...]:
        found = []
        for slot, predicate in sorted(self.binding.predicates.items()):
            name = self.binding.labels[slot]
            code = self.binding.names.predicates[predicate]
            for variable in (START, END, *range(FIRST_PARAMETER, FIRST_PARAMETER + len(code.parameters))):
                target = token_number(name, predicate, variable, self.binding.names, self.binding.symbols)
                if target is not None:
                    found.append((name_of(target), str(model.eval(target, model_completion=True))))
        return tuple(found)


def _is_forbidden(core: Sequence[_Line]) -> bool:
    """Whether one line is false by itself, such as `eq(1, 2)`: who writes that forbids the branch."""
    return len(core) == 1 and z3.is_false(z3.simplify(core[0].claim))


def _why(holds: bool) -> str:
    return "its condition cannot hold" if holds else "the condition before it always holds"


def _inside(span: Span | None, outer: Span) -> bool:
    return (
        span is not None and span.source is outer.source and outer.begin <= span.begin < outer.begin + len(outer.text)
    )


def _notes(core: Sequence[_Line], where: Span, condition: Span) -> tuple[Note, ...]:
    spans = [each.span for each in core if each.span is not None and each.span is not condition]
    ordered = sorted(dict.fromkeys(spans), key=lambda span: (span.source.name, span.begin))
    head = Note("its condition is here", condition)
    return (head, *(Note("this holds there too", span) for span in ordered if span is not where))


def _finding(code: Code, core: Sequence[_Line], own: Span, predicate: str = "") -> Diagnostic:
    """At the last line of the core that the rule has; notes for the others."""
    spans = list(dict.fromkeys(each.span for each in core if each.span is not None))
    mine = [span for span in spans if _inside(span, own)] or spans
    last = max(mine, key=lambda span: span.begin)
    ordered = sorted((span for span in spans if span is not last), key=lambda span: (span.source.name, span.begin))
    notes = tuple(Note("this contradicts it", span) for span in ordered)
    return code.at(last, notes=notes, predicate=predicate)
