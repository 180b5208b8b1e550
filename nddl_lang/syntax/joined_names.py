"""A declaration whose name has a blank in it in, such as `int HEATING MAX = 60;`; the two words as one name out."""

from nddl_lang.syntax.builder import Builder
from nddl_lang.syntax.codes import SUPERFLUOUS
from nddl_lang.text.diagnostic import Edit, Fix

_NAMED = frozenset(("class", "enum", "predicate", "action"))
_BODIES = frozenset(("{", "extends"))


def join_names(b: Builder, first: int, index: int) -> bool:
    """Read the name at the lexeme `index` as the rest of the one before it; whether the statement declares that one.

    The statement begins at the lexeme `first`, and the parser did not know what to make of `index`.
    """
    kinds, texts = b.kinds, b.texts
    if kinds[index - 1 : index + 1] != ["IDENT", "IDENT"] or "\n" in b.span(index - 1, index).text:
        return False
    following = kinds[index + 1]
    is_type = kinds[first] in _NAMED and index == first + 2 and following in _BODIES
    is_variable = index == first + 2 and (
        (kinds[first] == "BASETYPE" and following in ("=", ";")) or (kinds[first] == "IDENT" and following == "=")
    )
    if not is_type and not is_variable:
        return False
    name = f"{texts[index - 1]}{'' if is_type else '_'}{texts[index]}"
    span = b.span(index - 1, index)
    fix = Fix(f"write `{name}`", (Edit(span, name),), safe=False)
    b.report(SUPERFLUOUS, b.at(index), text=texts[index], help=f"a name has no blanks: write `{name}`", fixes=(fix,))
    texts[index - 1], b.ends[index - 1] = name, b.ends[index]
    b.remove(index, index + 1)
    return True
