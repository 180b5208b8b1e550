"""Say in words what could have stood at a place where something else stands."""

from collections.abc import Sequence

from nddl_lang.syntax.tables import ACTIONS, END, GOTOS, RULES

_VALUE_STARTS = frozenset(("IDENT", "INT", "FLOAT", "STRING", "BOOL", "this", "(", "[", "SET", "new", "-", "!"))
_OPERATORS = frozenset(("||", "&&", "==", "!=", "<", "<=", ">", ">=", "+", "-", "*", "/"))
_NAMES = {
    "IDENT": "a name",
    "INT": "a number",
    "FLOAT": "a number",
    "STRING": "a string",
    "BOOL": "`true` or `false`",
    "BASETYPE": "a type",
    "RELATION": "a relation",
    "GOAL": "`goal`",
    "SET": "`{`",
    END: "the end of the file",
}
_MOST = 4


def accepts(states: list[int], kinds: Sequence[str]) -> bool:
    """Whether the parser, standing in `states`, could take in `kinds` one after the other."""
    return states_after(states, kinds) is not None


def states_after(states: list[int], kinds: Sequence[str]) -> list[int] | None:
    """The states of the parser that has taken in `kinds`, standing in `states` before; None where it could not."""
    states = states.copy()
    for kind in kinds:
        while True:
            action = ACTIONS[states[-1]].get(kind)
            if action is None:
                return None
            if action == 0:
                return states
            if action > 0:
                states.append(action)
                break
            head, size, _ = RULES[-action]
            if size:
                del states[-size:]
            states.append(GOTOS[states[-1]][head])
    return states


def expected_kinds(states: list[int]) -> set[str]:
    """All kinds of lexeme that could come next."""
    return {kind for kind in ACTIONS[states[-1]] if kind != "BROKEN" and accepts(states, [kind])}


def describe_expected(kinds: set[str]) -> str:
    """`kinds` in words: `a name, `,` or `;``."""
    words: list[str] = []
    rest = set(kinds)
    if {"IDENT", "class", "enum"} <= rest:
        return "`}`" + " or a statement" if "}" in rest else "a statement"
    if {"IDENT", "INT", "[", "("} <= rest:
        words.append("a value")
        rest -= _VALUE_STARTS
    if {"BASETYPE", "IDENT"} <= rest:
        words.append("a type")
        rest -= {"BASETYPE", "IDENT"}
    if "IDENT" in rest and "this" in rest:
        words.append("a name")
        rest -= {"IDENT", "this"}
    if rest & _OPERATORS:
        rest -= _OPERATORS
        words.append("an operator")
    rest.discard(".")
    words += sorted({_NAMES.get(kind, f"`{kind}`") for kind in rest}, key=lambda word: (word.startswith("`"), word))
    if len(words) > _MOST:
        words = words[:_MOST]
    if not words:
        return "something else"
    return words[0] if len(words) == 1 else ", ".join(words[:-1]) + " or " + words[-1]
