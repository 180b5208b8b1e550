"""Run the tables of the grammar over the lexemes of one piece, making nodes on the way."""

from typing import Any

from nddl_lang.syntax import builder, statements
from nddl_lang.syntax.brackets import DEPTH_LIMIT, STEPS
from nddl_lang.syntax.builder import Builder, Maker, pass_on, refuse_waiting
from nddl_lang.syntax.codes import TOO_DEEP
from nddl_lang.syntax.former import replace_former
from nddl_lang.syntax.piece import Piece
from nddl_lang.syntax.placement import CLASS, BlockGrammar, break_statement, head_of, place_statements
from nddl_lang.syntax.recovery import Recovery
from nddl_lang.syntax.tables import ACTIONS, END, GOTOS, RULES
from nddl_lang.syntax.walk import is_deeper

_MOST_MENDS = 20  # of a piece, for each of its lexemes

# Each of these makes a tree at most a few levels deeper; other lexemes only make it wider.
_DEEPENING = ("||", "&&", "==", "!=", "<", "<=", ">", ">=", "+", "-", "*", "/", "!", "if", "else", "(", "{")


def _maker(name: str | None) -> Maker:
    """The function that makes the node called `name` in the grammar."""
    if name is None:
        return pass_on
    maker: Maker = getattr(statements, name, None) or getattr(builder, name)
    return maker


_MAKERS: list[tuple[str, int, Maker]] = [(head, size, _maker(name)) for head, size, name in RULES]
# The actions that only give a part another name.
_PASSED_ON: dict[int | None, str] = {-number: rule[0] for number, rule in enumerate(RULES) if number and not rule[2]}


def parse_piece(piece: Piece, block: BlockGrammar, is_strict: bool) -> None:
    """Fill in the statements of `piece`, which stands in `block`, and what is wrong with them."""
    b = Builder(piece, is_strict)
    if piece.mends:
        _mend(b)
    if piece.has_former_words:
        replace_former(b)
    piece.statements = place_statements(b, _run(b), block)
    if block is CLASS and is_strict:
        statements.report_member_initialisers(b, piece.statements)
    if b.waiting:
        refuse_waiting(b)
    if len(piece.kinds) > DEPTH_LIMIT and _may_be_deep(piece) and is_deeper(piece.statements, DEPTH_LIMIT):
        _give_up(b)


def _mend(b: Builder) -> None:
    """Put in and leave out the braces that were found missing or too many when the piece was cut from the text."""
    b.own()
    for index, brace in sorted(b.piece.mends, reverse=True):
        if brace:
            b.insert(index, brace)
        else:
            b.remove(index, index + 1)


def _may_be_deep(piece: Piece) -> bool:
    """Whether there is enough in the piece that one thing could be nested so deep."""
    return sum(piece.kinds.count(kind) for kind in _DEEPENING) + 10 > DEPTH_LIMIT


def _give_up(b: Builder) -> None:
    """Nobody should have to walk a tree this deep: the piece is broken as a whole."""
    piece = b.piece
    span = piece.span(piece.starts[0], piece.ends[-1])
    piece.statements = (break_statement(b, span),)
    b.report(TOO_DEEP, head_of(span), limit=DEPTH_LIMIT, help=STEPS)


def _run(b: Builder) -> list[Any]:
    """The statements in the lexemes of `b`. Each step shifts, reduces, or mends, and mends are counted: so it ends."""
    kinds = [*b.kinds, END]
    states = [0]
    values: list[Any] = []
    actions, gotos, makers, passed_on = ACTIONS, GOTOS, _MAKERS, _PASSED_ON
    recovery: Recovery | None = None
    mends = most = 0
    index = 0
    kind = kinds[0]
    action = actions[0].get(kind)
    while True:
        if action is None:
            if recovery is None:
                recovery = Recovery(b, _MAKERS)
                kinds = b.kinds
                most = _MOST_MENDS * len(kinds)
            mends += 1
            if mends > most:  # some of them led nowhere
                return [break_statement(b, b.piece.span(0, b.piece.length))]
            index = recovery.recover(states, values, index)
            kind = kinds[index]
            action = actions[states[-1]].get(kind)
        elif action > 0:
            states.append(action)
            values.append(index)
            index += 1
            kind = kinds[index]
            action = actions[action].get(kind)
        elif action < 0:
            head: str | None
            head, size, make = makers[-action]
            if size:
                parts = values[-size:]
                del values[-size:]
                del states[-size:]
                values.append(make(b, parts))
            else:
                values.append(make(b, []))
            goto = gotos[states[-1]]
            # An operand climbs through the levels of the expression grammar without touching the stacks.
            while head is not None:
                state = goto[head]
                action = actions[state].get(kind)
                head = passed_on.get(action)
            states.append(state)
        else:
            result: list[Any] = values[0]
            return result
