"""Judge tokens: their own variables, the body of their predicate, the rules that fired, and merged twins."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from checker.judge.bench import Bench, RuleUse, Tok
from checker.judge.bodies import Written
from checker.judge.bulk_tokens import BulkJudge, judge_in_bulk
from checker.judge.choosing import MOST_TRIES, Choosing
from checker.judge.operands import BUILT_IN, BodyFrame, VariableNames
from checker.judge.relating import Step
from checker.judge.report import Disagreement
from checker.judge.steps import Domain, compile_steps, domain_test
from checker.judge.straight_code import lasts_rightly
from checker.judge.straight_judge import StraightJudge
from checker.judge.tables import Tables
from checker.judge.values import UNKNOWN, ends_of, is_open, may_be_equal
from compiler.program import END, FIRST_PARAMETER, OBJECT, START, PredicateCode, Program, RuleCode
from nddl_lang.text.source import Span
from runtime.executive.record import BodyRun, TokenRecord, Value


@dataclass(frozen=True, eq=False, slots=True)
class RuleJudge:
    """A rule ready to be judged."""

    steps: tuple[Step, ...]
    slots: int
    tokens: int
    span: Span


@dataclass(frozen=True, eq=False, slots=True)
class PredicateJudge:
    """A predicate ready to be judged: `tests` are of its parameters, where they say anything."""

    code: PredicateCode
    tests: tuple[tuple[int, str, Domain], ...]
    body: tuple[Step, ...]
    rules: tuple[int, ...]
    least_duration: int


@dataclass(frozen=True, eq=False, slots=True)
class ProgramJudge:
    """A program ready to be judged."""

    program: Program
    names: VariableNames
    predicates: dict[str, PredicateJudge]
    rules: tuple[RuleJudge, ...]
    script: tuple[Step, ...]
    globals: tuple[tuple[int, str, Domain], ...]
    timelines: frozenset[str]  # classes whose objects hold one token at a time
    bulk: BulkJudge
    straight: StraightJudge

    @property
    def codes(self) -> dict[str, PredicateCode]:
        """The predicates by name."""
        return self.names.predicates


def compile_program(program: Program, written: Written) -> ProgramJudge:
    """Compile everything that a model says of a mission."""
    names = VariableNames(program)
    predicates = {code.name: _predicate(code, program, written) for code in program.predicates}
    rules = tuple(_rule(rule, program, written) for rule in program.rules)
    script = compile_steps(program.script, names, written)
    worlds = []
    for k, (name, type_) in enumerate(program.globals):
        test = domain_test(type_, None, names)
        if test is not None:
            worlds.append((k, name, test))
    timelines = frozenset(code.name for code in program.classes if code.native == "Timeline")
    bulk = BulkJudge(program, written, names.predicates)
    straight = StraightJudge(program, written, names.predicates)
    return ProgramJudge(program, names, predicates, rules, script, tuple(worlds), timelines, bulk, straight)


def _predicate(code: PredicateCode, program: Program, written: Written) -> PredicateJudge:
    names = VariableNames(program)
    names.tokens[0] = ("", code.name)
    tests = []
    for k, parameter in enumerate(code.parameters):
        test = domain_test(parameter.type, parameter.domain, names)
        if test is not None:
            tests.append((FIRST_PARAMETER + k, parameter.name, test))
    body = compile_steps(code.body, names, written)
    return PredicateJudge(code, tuple(tests), body, code.rules, 0 if code.is_event else 1)


def _rule(rule: RuleCode, program: Program, written: Written) -> RuleJudge:
    names = VariableNames(program)
    names.tokens[0] = ("", rule.predicate)
    return RuleJudge(compile_steps(rule.body, names, written), rule.slots, rule.tokens, rule.span)


def judge_tokens(judge: ProgramJudge, bench: Bench, tables: Tables | None) -> None:
    """Judge every token that has begun; those that are alike at once, if there are tables."""
    last = bench.last_tick
    left: Iterable[TokenRecord]
    if isinstance(bench.record.tokens, tuple) and not bench.infers:
        left = judge.straight.judge(bench, bench.record.tokens)
    else:
        left = bench.record.tokens if tables is None else judge_in_bulk(judge.bulk, bench, tables)
    for tok in bench.tokens.of(left):
        record = tok.record
        state = record.state
        if state == "active":
            latest = record.start if isinstance(record.start, int) else ends_of(record.start)[1]
            if latest > last:
                continue
            _judge_token(judge, bench, tok)
        elif state == "merged":
            _judge_merged(judge, bench, tok)


def _judge_token(judge: ProgramJudge, bench: Bench, tok: Tok) -> None:
    record, values = tok.record, tok.values
    known = judge.predicates[record.predicate]
    _judge_times(bench, tok, known.least_duration, known.code.span)
    for index, name, test in known.tests:
        if not bench.weigh(test(bench, values[index])):
            what = ((name, values[index]),)
            bench.report("domain", name, (tok,), what, "its value", "outside of its declaration", known.code.span)
    thing = values[OBJECT]
    if isinstance(thing, str):
        class_name = bench.members[thing][0] if thing in bench.members else ""
        if not bench.weigh(judge.names.is_kind_of(class_name, known.code.class_name)):
            bench.report(
                "domain", "object", (tok,), (("object", thing),), "its object", "of another class", known.code.span
            )
    if known.body:
        frame = BodyFrame(bench, tok, [UNKNOWN] * known.code.body_slots, [tok, *[None] * known.code.body_tokens])
        for step in known.body:
            step(frame)
    if tok.is_cut:
        if known.rules:
            bench.skip("rules of a token that was cut off by a repair")
        return
    if not known.rules and not record.runs:
        return
    if bench.infers and not record.runs:
        for number in known.rules:
            _find_run(bench, tok, number, judge.rules[number])
        return
    if not _has_fired(bench, tok, known, record.runs):
        return
    for run in record.runs:
        rule = judge.rules[run.rule]
        frame = BodyFrame(bench, tok, [UNKNOWN] * rule.slots, [tok, *[None] * rule.tokens])
        frame.follow(run)
        for step in rule.steps:
            step(frame)


def _find_run(bench: Bench, tok: Tok, number: int, rule: RuleJudge) -> None:
    """Judge a rule whose run nobody recorded: under some choice of its children all of it must hold.

    If it does under none, that choice is told of which the fewest children are missing and, then, the least is wrong.
    """
    choosing = Choosing(number)
    before, uses = len(bench.found), len(bench.uses)
    best: tuple[tuple[int, int], list[Disagreement], list[RuleUse], BodyRun] | None = None
    for tries in range(MOST_TRIES):
        choosing.begin()
        choosing.known.clear()
        frame = BodyFrame(bench, tok, [UNKNOWN] * rule.slots, [tok, *[None] * rule.tokens])
        frame.choosing = choosing
        for _ in range(2):  # the second time with the locals that the first has found
            del bench.found[before:]
            del bench.uses[uses:]
            choosing.begin()
            for step in rule.steps:
                step(frame)
        if len(bench.found) == before:
            bench.runs.setdefault(tok.key, []).append(choosing.run())
            return
        wrong = sum(one.kind == "child" for one in bench.found[before:]), len(bench.found) - before
        if best is None or wrong < best[0]:
            best = wrong, bench.found[before:], bench.uses[uses:], choosing.run()
        del bench.found[before:]
        del bench.uses[uses:]
        if not choosing.advance():
            break
        if tries == MOST_TRIES - 1:
            bench.skip("a rule with too many choices")
            return
    assert best is not None
    bench.found += best[1]
    bench.uses += best[2]
    bench.runs.setdefault(tok.key, []).append(best[3])


def _has_fired(bench: Bench, tok: Tok, known: PredicateJudge, runs: tuple[BodyRun, ...]) -> bool:
    """Whether the rules of a token fired, and no others; what the script activates early fires what stands above."""
    fired = tuple([run.rule for run in runs])
    if fired == known.rules:
        bench.judged += 1
        return True
    if tok.record.origin in ("goal", "fact") and set(fired) <= set(known.rules):
        bench.skip("rules that stand below the activation of a token")
        return True
    bench.judged += 1
    bench.report(
        "child", "rules", (tok,), (), f"{len(fired)} rules fired", f"{len(known.rules)} rules apply", known.code.span
    )
    return False


def _judge_times(bench: Bench, tok: Tok, least: int, span: Span | None) -> None:
    record = tok.record
    bench.judged += 1
    if isinstance(record.end, int) and isinstance(record.start, int):
        if record.duration == record.end - record.start and record.duration >= least:
            return
    if not lasts_rightly(record, least):
        values = (("start", record.start), ("duration", record.duration), ("end", record.end))
        bench.report("duration", "duration", (tok,), values, "start + duration = end", "it is not", span)


def _judge_merged(judge: ProgramJudge, bench: Bench, tok: Tok) -> None:
    """A merged token has the values of the one that stands for it, and is of its predicate."""
    other, mine = tok.standing, tok.record
    if other is tok:
        bench.skip("a merged token whose other half was never recorded")
        return
    if tok.is_cut:
        return
    theirs = other.record
    suffix = mine.predicate.rpartition(".")[2]
    is_alike = theirs.predicate == mine.predicate or (
        theirs.predicate.rpartition(".")[2] == suffix
        and judge.names.is_kind_of(theirs.predicate.rpartition(".")[0], mine.predicate.rpartition(".")[0])
    )
    if not is_alike:
        bench.report("merge", "predicate", (tok, other), (), mine.predicate, theirs.predicate)
    bench.judged += 1
    if mine.start == theirs.start and mine.end == theirs.end and mine.arguments == theirs.arguments:
        return
    is_strict = mine.tick == theirs.tick and mine.fate == theirs.fate
    is_early = mine.tick < theirs.tick and mine.tick <= bench.last_repair  # bounds of then may have been given up
    ours: tuple[tuple[int, Any], ...] = ((OBJECT, mine.object), (START, mine.start), (END, mine.end))
    ours += tuple((FIRST_PARAMETER + k, value) for k, value in enumerate(mine.arguments))
    for index, value in ours:
        if is_early and is_open(value):
            continue
        if index < len(other.values) and not _are_one(value, other.values[index], is_strict):
            name = BUILT_IN.get(index) or judge.predicates[mine.predicate].code.parameters[index - FIRST_PARAMETER].name
            pair: tuple[tuple[str, Value], ...] = (
                (f"{tok.name}.{name}", value),
                (f"{other.name}.{name}", other.values[index]),
            )
            bench.report("merge", name, (tok, other), pair, "they are one", "they differ")


def _are_one(mine: Value, theirs: Value, is_strict: bool) -> bool:
    """Whether a variable of a merged token and that of the other half agree; strictly, if they are of one moment."""
    return may_be_equal(mine, theirs) and not (is_strict and is_open(mine) != is_open(theirs))
