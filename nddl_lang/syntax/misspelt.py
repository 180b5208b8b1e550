"""Find the word of the language that a name was meant to be, where the statement makes sense with it."""

from functools import lru_cache

from nddl_lang.syntax.expectation import accepts
from nddl_lang.syntax.words import ELSEWHERE, FORMER, KINDS, RELATIONS
from nddl_lang.text.nearest import nearest

_WORDS = tuple(word for word in KINDS if word not in FORMER)
# A name as short as these is no misspelt word unless it has the same letters.
_SHORT = 3
_TIMES = {"starts": "start", "ends": "end"}
_COMPARES = frozenset(("==", "!=", "<", "<=", ">", ">="))
_BEFORE_TIME = _COMPARES | {".", "+", "-", "*", "/"}
_MOST_LEXEMES = 400  # of a statement up to a mistake
_REMEMBERED = 256  # answers: one mistake may stand in thousands of lines


def meant_time(kinds: list[str], texts: list[str], first: int, index: int) -> tuple[int, str] | None:
    """A lexeme before which, or at which, a statement stops making sense, and the time that its relation was meant for.

    `q.starts >= 4` and `ends <= 9`: behind a dot, and before a comparison, no relation can stand.
    """
    for at in (index, index - 1):
        time = _TIMES.get(texts[at]) if first <= at < len(texts) else None
        if (
            time is not None
            and kinds[at] == "RELATION"
            and (kinds[at - 1] in _BEFORE_TIME or kinds[at + 1] in _COMPARES)
        ):
            return at, time
    return None


def meant_word(
    states: list[int], kinds: list[str], texts: list[str], first: int, index: int
) -> tuple[int, str | None] | None:
    """The lexeme that should be a word of the language, and that word, None for some relation or kind of goal.

    `states` are those of the parser before the statement that begins at the lexeme `first` and cannot go on with the
    lexeme `index`. With the word in its place the parser gets beyond the lexeme after that. A statement of very many
    lexemes is not looked through: the parser would read it anew for each.
    """
    if index - first > _MOST_LEXEMES:
        return None
    for at in dict.fromkeys((index, index - 1, index - 2, first)):
        if at < first or kinds[at] != "IDENT":
            continue
        before, after = kinds[first:at], kinds[at + 1 : max(at, index) + 2]
        fitting = _fitting(tuple(states), tuple(before), tuple(after))
        if not fitting:
            continue
        word = _meant(texts[at], fitting)
        if word is not None:
            return at, word
        # `overlaps(object.p q)`: only relations and goals take a path and a name.
        if at == first and "RELATION" in fitting and kinds[at + 1] == "(" and "." in kinds[at:index]:
            return at, None
    return None


@lru_cache(_REMEMBERED)
def _fitting(states: tuple[int, ...], before: tuple[str, ...], after: tuple[str, ...]) -> frozenset[str]:
    """The kinds of words that the parser takes between these kinds of lexemes."""
    return frozenset(kind for kind in {*KINDS.values()} if accepts([*states], [*before, kind, *after]))


@lru_cache(_REMEMBERED)
def _meant(name: str, fitting: frozenset[str]) -> str | None:
    """The word of these kinds that `name` stands for."""
    words = [word for word in _WORDS if KINDS[word] in fitting]
    if ELSEWHERE.get(name) in words:
        return ELSEWHERE[name]
    begun = [word for word in words if word.startswith(f"{name}_")]
    if len(begun) == 1:  # `contained(...)`: the other half was forgotten
        return begun[0]
    word = nearest(name, words)
    if word is None and (other := nearest(name, [each for each in ELSEWHERE if len(each) > _SHORT])) is not None:
        return ELSEWHERE[other] if ELSEWHERE[other] in words else None
    if word is None or (len(name) <= _SHORT and sorted(name.casefold()) != sorted(word)):
        return None
    return word


def all_relations() -> str:
    """The relations in one line."""
    return ", ".join(f"`{name}`" for name in RELATIONS if name != "equal")
