"""A program and a sampled parameter in, the lines out by which a draw reaches the times and parameters of a token.

A static slice: from the sampled variable through the constraints of the same rule that share a local variable with it.
It says how a draw acts inside the simulator when the conflict was found in another reactor, whose terms know no draw.
"""

from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from checker.single_values import single_value
from compiler.instructions import all_instructions, branched_instructions
from compiler.program import (
    DURATION,
    END,
    FIRST_PARAMETER,
    START,
    Child,
    Constant,
    Instruction,
    LocalVariable,
    Operand,
    Post,
    Program,
    RuleCode,
    Sample,
    TokenVariable,
)
from nddl_lang.text.source import Span
from runtime.executive.messages import Arguments
from runtime.executive.outcome import SourcePlace

_TESTS = {"testEq": True, "testNeq": False}
Branch = tuple[str, int, str]  # the file and offset of a guard, and `then` or `else`


@dataclass(frozen=True, slots=True)
class ArgumentCondition:
    """A condition that an argument of the rule's own token is `value`, or, unless `is_equal`, another one."""

    argument: str
    value: float | str
    is_equal: bool

    def fails(self, arguments: Arguments) -> bool:
        """Whether a token with such arguments does not fulfil it."""
        seen = single_value(dict(arguments).get(self.argument))
        return seen is not None and (seen == self.value) is not self.is_equal


@dataclass(frozen=True, slots=True)
class InfluenceLine:
    """A line of a rule that passes a draw on; `rule` is its predicate with the class, `predicate` without.

    It does so in missions that take all `branches` in which it stands, of tokens that fulfil all `tests`.
    """

    rule: str
    predicate: str
    place: SourcePlace
    branches: tuple[Branch, ...] = ()
    tests: tuple[ArgumentCondition, ...] = ()


Influence = Mapping[str, tuple[InfluenceLine, ...]]  # by parameter


def lines_of_influence(program: Program, parameter: str) -> tuple[InfluenceLine, ...]:
    """The lines in the order in which the draw passes through them; the line that samples comes first.

    Of the last lines only those are kept that bear on a token's times, if any do.
    """
    lines: list[InfluenceLine] = []
    for rule in program.rules:
        predicate = rule.predicate.rpartition(".")[2]
        placed = list(branched_instructions(rule.body))
        body = [instruction for instruction, _ in placed]
        within = {id(instruction): branches for instruction, branches in placed}
        tests = _tests_of(program, rule, [guard.condition for stands in within.values() for guard, _ in stands])
        for instruction in body:
            if isinstance(instruction, Sample) and instruction.parameter == parameter:
                found: list[Sample | Post] = [instruction, *_slice(body, instruction)]
                for one in found:
                    stands = within[id(one)]
                    branches = tuple(branch_of(guard.span, branch_name(is_else)) for guard, is_else in stands)
                    known = [(tests[guard.condition], is_else) for guard, is_else in stands if guard.condition in tests]
                    fulfilled = tuple(replace(test, is_equal=test.is_equal is not is_else) for test, is_else in known)
                    lines.append(InfluenceLine(rule.predicate, predicate, line_of(one.span), branches, fulfilled))
    return tuple(dict.fromkeys(lines))


def parameters_that_choose(program: Program, predicates: Container[str]) -> Iterator[str]:
    """The parameters that decide whether a rule asks for a token of some predicates."""
    for rule in program.rules:
        placed = list(branched_instructions(rule.body))
        body = [step for step, _ in placed]
        guards = [
            guard
            for step, within in placed
            if isinstance(step, Child) and step.predicate in predicates
            for guard, _ in within
        ]
        deciding = {one for guard in guards for one in (guard.condition, *guard.decided_by)}
        for sample in body if deciding else ():
            if isinstance(sample, Sample):
                reached = {sample.target, *(one for post in _reached(body, sample) for one in post.operands)}
                if deciding & reached:
                    yield sample.parameter


def _tests_of(program: Program, rule: RuleCode, conditions: Iterable[Operand]) -> dict[Operand, ArgumentCondition]:
    """What conditions of a rule say of the arguments of its own token, by the variables that hold their truth.

    An argument may hold it itself: `if (careful)`.
    """
    names = next((one.parameters for one in program.predicates if one.name == rule.predicate), ())
    found: dict[Operand, ArgumentCondition] = {}
    for one in conditions:
        if isinstance(one, TokenVariable) and one.token == 0 and one.variable >= FIRST_PARAMETER:
            found[one] = ArgumentCondition(names[one.variable - FIRST_PARAMETER].name, True, is_equal=True)
    for step in all_instructions(rule.body):
        if isinstance(step, Post) and step.name in _TESTS:
            match step.operands:
                case (truth, TokenVariable(token=0, variable=at), Constant(domain=domain)) if at >= FIRST_PARAMETER:
                    value = single_value(domain)
                    if value is not None:
                        found[truth] = ArgumentCondition(names[at - FIRST_PARAMETER].name, value, _TESTS[step.name])
                case _:
                    pass
    return found


def branch_name(is_else: bool) -> str:
    """What a branch of a guard is called."""
    return "else" if is_else else "then"


def branch_of(guard: Span, name: str) -> Branch:
    """What tells a branch of a guard from all others of a model."""
    return guard.source.name, guard.begin, name


def line_of(span: Span) -> SourcePlace:
    """The line of a span as the report shows it."""
    source = span.source
    return SourcePlace(source.name, span.line, span.column, source.line(span.line).partition("//")[0].strip())


def _reached(body: list[Instruction], sample: Sample) -> list[Post]:
    """The constraints that a draw comes to by local variables."""
    reached = {sample.target}
    posts: list[Post] = []
    grows = True
    while grows:
        grows = False
        for instruction in body:
            if isinstance(instruction, Post) and instruction not in posts and reached & set(instruction.operands):
                posts.append(instruction)
                reached.update(one for one in instruction.operands if isinstance(one, LocalVariable))
                grows = True
    return posts


def _slice(body: list[Instruction], sample: Sample) -> list[Post]:
    posts = _reached(body, sample)
    ends = [post for post in posts if any(_is_time(operand) for operand in post.operands)]
    if ends:
        last = posts.index(ends[-1])
        posts = [
            post for post in posts[: last + 1] if post in ends or any(_feeds(post, end) for end in posts[: last + 1])
        ]
    return posts


def _feeds(post: Post, other: Post) -> bool:
    """Whether two constraints share a local variable."""
    shared = set(post.operands) & set(other.operands)
    return post is not other and any(isinstance(one, LocalVariable) for one in shared)


def _is_time(operand: object) -> bool:
    return isinstance(operand, TokenVariable) and operand.variable in (DURATION, START, END)
