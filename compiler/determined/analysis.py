"""Decide whether a reactor is determined: a program and its timelines in, an order of timelines and reasons out."""

from dataclasses import dataclass

from compiler.determined.assemble import compile_block
from compiler.determined.code import Line, RegisterBlock, RegisterLayout
from compiler.determined.model import ReactorModel
from compiler.determined.reasons import ChoiceReason, FreeChoice, UndeterminedError
from compiler.determined.relations import FOLLOWING, MERGED, TOGETHER
from compiler.program import (
    DURATION,
    Assign,
    Call,
    Guard,
    NewToken,
    Operand,
    Post,
    PredicateCode,
    Program,
    Relate,
    Sample,
    TokenVariable,
)

_MOST_PARAMETERS = 62  # as many bits has the mask of what is given


@dataclass(frozen=True, slots=True)
class DeterminismAnalysis:
    """What was found: the order in which timelines are synchronised, and the reasons against, if any."""

    model: ReactorModel
    layout: RegisterLayout
    order: tuple[int, ...]
    blocks: tuple[RegisterBlock, ...]
    reasons: tuple[ChoiceReason, ...]

    @property
    def is_determined(self) -> bool:
        """Whether the reactor can be compiled."""
        return not self.reasons


def analyse(program: Program, lines: tuple[Line, ...], lookahead: int) -> DeterminismAnalysis:
    """Look at every token that may start on a timeline of the reactor, as somebody may ask for it or as the default.

    `lines` are the timelines of the reactor and, with the role "other", the model's other ones.
    """
    model = ReactorModel(program, lines)
    widths = [max((len(each.parameters) for each in model.predicates_of(n)), default=0) for n in range(len(lines))]
    tells_lengths = _speaks_of_lengths(program)
    layout = RegisterLayout(lines, [each + tells_lengths for each in widths], tells_lengths=tells_lengths)
    reasons: dict[ChoiceReason, None] = {}
    if lookahead > 1:
        reasons[ChoiceReason(FreeChoice.LOOKAHEAD, "the reactor", None)] = None
    for instruction in program.script:
        match instruction:
            case NewToken(kind=kind, predicate=goal, span=span) if kind != "fact":
                reasons[ChoiceReason(FreeChoice.GOAL, goal, span)] = None
            case Relate(span=span):
                reasons[ChoiceReason(FreeChoice.STATEMENT, span.text.split("\n")[0], span)] = None
            case Call(method=method, span=span) if method != "close":
                reasons[ChoiceReason(FreeChoice.STATEMENT, span.text.split("\n")[0], span)] = None
            case _:
                pass
    blocks: list[RegisterBlock] = []
    for number, line in enumerate(lines):
        if line.role == "other":
            continue
        for predicate in model.predicates_of(number):
            if predicate.span is None or predicate.is_action or predicate.is_event:
                continue
            if len(predicate.parameters) > _MOST_PARAMETERS:
                reasons[ChoiceReason(FreeChoice.FUNCTION, predicate.name, predicate.span)] = None
                continue
            try:
                blocks.append(compile_block(model, layout, number, predicate, _everything(predicate)))
            except UndeterminedError as obstacle:
                reasons[obstacle.reason] = None
    order: tuple[int, ...] = ()
    try:
        order = _order_of(model, blocks)
    except UndeterminedError as obstacle:
        reasons[obstacle.reason] = None
    return DeterminismAnalysis(model, layout, order, tuple(blocks), tuple(reasons))


def _everything(predicate: PredicateCode) -> int:
    return (1 << len(predicate.parameters)) - 1


def _speaks_of_lengths(program: Program) -> bool:
    """Whether a rule says how long a token that it asks for lasts."""
    pending = [rule.body for rule in program.rules]
    while pending:
        for instruction in pending.pop():
            match instruction:
                case Guard(then=then, otherwise=otherwise):
                    pending += [then, otherwise]
                case Post(operands=operands) if any(map(_is_length_of_another, operands)):
                    return True
                case Assign(target=target) | Sample(target=target) if _is_length_of_another(target):
                    return True
                case _:
                    pass
    return False


def _is_length_of_another(operand: Operand) -> bool:
    return isinstance(operand, TokenVariable) and operand.token != 0 and operand.variable == DURATION


def _order_of(model: ReactorModel, blocks: list[RegisterBlock]) -> tuple[int, ...]:
    """Timelines in the order in which they are synchronised.

    Who starts a token on another one, or lets one follow there, comes before it; who reads what holds there, after it.
    """
    before: dict[int, set[int]] = {n: set() for n, line in enumerate(model.lines) if line.role != "other"}
    for block in blocks:
        for token in block.tokens[1:]:
            parent = block.tokens[token.parent].line
            if token.how in (TOGETHER, FOLLOWING) and token.line != parent:
                before[token.line].add(parent)
            elif token.how == MERGED:
                before[parent].add(token.line)
    order: list[int] = []
    while len(order) < len(before):
        free = [n for n in before if n not in order and before[n] <= set(order)]
        if not free:
            names = ", ".join(f"`{model.lines[n].name}`" for n in before if n not in order)
            raise UndeterminedError(FreeChoice.CYCLE, names, None)
        order.append(free[0])
    return tuple(order)
