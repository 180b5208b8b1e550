"""Turn grammar.lark into the tables that the parser runs on; `python -m nddl_lang.syntax.generate` writes them.

Lark analyses the grammar, the result is stored as JSON beside it. Checking a small model must not wait for lark to
be imported (60 ms) and for the analysis (400 ms), and a parser that knows its own tables can say what it expected
and mend what is missing.
"""

import json
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path
from typing import Any

from lark import Lark
from lark.lexer import Lexer, LexerState, Token

GRAMMAR = Path(__file__).with_name("grammar.lark")
TABLES = Path(__file__).with_name("tables.json")


class _NoLexer(Lexer):
    """Keeps lark from building a lexer of its own."""

    def __init__(self, conf: object) -> None:
        del conf

    def lex(self, lexer_state: LexerState, parser_state: object) -> Iterator[Token]:
        """Nothing is ever read here."""
        del lexer_state, parser_state
        return iter(())


def tables(grammar: str) -> dict[str, Any]:
    """Rules, actions and gotos of `grammar`, numbered by a walk from the start, so that equal grammars agree.

    An action above 0 shifts to that state, one below 0 reduces by that rule, 0 accepts. A rule is its head, the
    number of its parts, and the function that builds its node (null: pass the only part on).
    """
    lark = Lark(grammar, parser="lalr", lexer=_NoLexer, start="start", maybe_placeholders=False, keep_all_tokens=True)
    parse_table = lark.parser.parser._parse_table
    kinds = {terminal.name: terminal.pattern.value.replace("\\", "") for terminal in lark.terminals}
    numbers: dict[Any, int] = {}
    rules: list[list[Any]] = [["", 0, None]]
    start = parse_table.start_states["start"]
    end = parse_table.end_states["start"]
    order = {start: 0}
    pending = [start]
    actions: list[dict[str, int]] = []
    gotos: list[dict[str, int]] = []
    for state in pending:
        terminals: dict[str, int] = {}
        heads: dict[str, int] = {}
        for symbol, (action, target) in sorted(parse_table.states[state].items()):
            if action.name == "Reduce":
                if target not in numbers:
                    numbers[target] = len(rules)
                    rules.append([target.origin.name, len(target.expansion), target.alias])
                terminals[kinds.get(symbol, symbol)] = -numbers[target]
                continue
            if target not in order:
                order[target] = len(order)
                pending.append(target)
            is_head = symbol.islower() or (symbol.startswith("_") and symbol not in kinds)
            (heads if is_head else terminals)[kinds.get(symbol, symbol)] = order[target]
        actions.append({"$END": 0} if state == end else terminals)
        gotos.append(heads)
    return {
        "grammar": sha256(grammar.encode()).hexdigest(),
        "rules": rules,
        "actions": actions,
        "gotos": gotos,
    }


def render(content: dict[str, Any]) -> str:
    """`content` as JSON with one row in each line."""
    lines = []
    for key, value in content.items():
        if isinstance(value, list):
            rows = ",\n".join(json.dumps(row, separators=(",", ":")) for row in value)
            lines.append(f'"{key}": [\n{rows}\n]')
        else:
            lines.append(f'"{key}": {json.dumps(value)}')
    return "{\n" + ",\n".join(lines) + "\n}\n"


if __name__ == "__main__":
    TABLES.write_text(render(tables(GRAMMAR.read_text(encoding="utf-8"))), encoding="utf-8")
