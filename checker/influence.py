"""A program and a sampled parameter in, the lines out by which a draw reaches the times and parameters of a token.

A static slice: from the sampled variable through the constraints of the same rule that share a local variable with it.
It says how a draw acts inside the simulator when the conflict was found in another reactor, whose terms know no draw.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from compiler.instructions import branched_instructions
from compiler.program import (
    DURATION,
    END,
    START,
    Instruction,
    LocalVariable,
    Post,
    Program,
    Sample,
    TokenVariable,
)
from nddl_lang.text.source import Span
from runtime.executive.outcome import SourcePlace

Branch = tuple[str, int, str]  # the file and offset of a guard, and `then` or `else`


@dataclass(frozen=True, slots=True)
class InfluenceLine:
    """A line of a rule that passes a draw on; `rule` is its predicate with the class, `predicate` without.

    It does so in missions that take all `branches` in which it stands.
    """

    rule: str
    predicate: str
    place: SourcePlace
    branches: tuple[Branch, ...] = ()


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
        branches = {
            id(instruction): tuple(branch_of(guard.span, branch_name(is_else)) for guard, is_else in within)
            for instruction, within in placed
        }
        for instruction in body:
            if isinstance(instruction, Sample) and instruction.parameter == parameter:
                found: list[Sample | Post] = [instruction, *_slice(body, instruction)]
                lines += [
                    InfluenceLine(rule.predicate, predicate, line_of(one.span), branches[id(one)]) for one in found
                ]
    return tuple(dict.fromkeys(lines))


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


def _slice(body: list[Instruction], sample: Sample) -> list[Post]:
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
