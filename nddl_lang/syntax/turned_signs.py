"""Signs in, read as those that they were meant to be: `=>`, `=<`, `<>`, `===`, and a colon at the end of a line."""

from nddl_lang.syntax.braces import begins_declaration
from nddl_lang.syntax.builder import Builder
from nddl_lang.syntax.codes import EXPECTED, SUPERFLUOUS
from nddl_lang.syntax.expectation import accepts
from nddl_lang.syntax.tables import END
from nddl_lang.text.diagnostic import Edit, Fix

_TURNED = {
    ("-", ">"): ".",
    (":", "="): "=",
    ("=", ">"): ">=",
    ("=", "<"): "<=",
    ("<", ">"): "!=",
    ("=", "!"): "!=",
    ("==", "="): "==",
    ("!=", "="): "!=",
}
_EQUAL = ("equal", "equals")
_PARTED = {("<", "="): "<=", (">", "="): ">=", ("!", "="): "!=", ("=", "="): "==", (":", ":"): "::"}  # by blanks


def turn_signs(b: Builder, first: int, index: int, *, is_quiet: bool) -> bool:
    """Read the sign at `index`, and the one before it in the statement that begins at `first`, as one, if they are."""
    kinds = b.kinds
    if kinds[index] == "RELATION" and b.texts[index] in _EQUAL and kinds[index - 1] == "IDENT" and index > first:
        if not is_quiet:
            fix = Fix("write `==`", (Edit(b.at(index), "=="),))
            b.report(SUPERFLUOUS, b.at(index), text=b.texts[index], help="write `==`", fixes=(fix,))
        kinds[index] = b.texts[index] = "=="
        return True
    ahead = tuple(kinds[index : index + 2])
    if ahead == ("!", "=") or (ahead in _TURNED and (kinds[index - 1], kinds[index]) not in _TURNED):
        index += 1  # the first of the two does not fit already: `a + b =< c`
    pair = kinds[index - 1], kinds[index]
    if index <= first or (pair not in _TURNED and pair not in _PARTED):
        return False
    span = b.span(index - 1, index)
    written = span.text
    sign = _TURNED.get(pair) if b.ends[index - 1] == b.starts[index] else _PARTED.get(pair)
    if pair == ("=", "=") and begins_declaration(kinds, first):
        return False
    if sign is None or "".join(written.split(" ")) != "".join(pair):
        return False
    if not is_quiet:
        fix = Fix(f"write `{sign}`", (Edit(span, sign),))
        b.report(SUPERFLUOUS, span, text=written, help=f"write `{sign}`", fixes=(fix,))
    kinds[index] = b.texts[index] = sign
    b.starts[index] = b.starts[index - 1]
    b.remove(index - 1, index)
    return True


def end_at_colon(b: Builder, states: list[int], first: int, index: int, *, is_quiet: bool) -> bool:
    """Read the colon before `index`, which begins another statement, as the `;` that it was meant to be."""
    kinds = b.kinds
    if index - 1 <= first or kinds[index - 1] != ":" or not accepts(states[:-1], [";", kinds[index]]):
        return False
    if not is_quiet:
        fix = Fix("write `;`", (Edit(b.at(index - 1), ";"),))
        b.report(EXPECTED, b.at(index - 1), expected="`;`", found="`:`", help="write `;`", fixes=(fix,))
    kinds[index - 1] = b.texts[index - 1] = ";"
    return True


def join_paths(b: Builder, index: int, *, is_quiet: bool) -> None:
    """Read each `::` between two names, from the one at `index` to the end of the statement, as a `.`."""
    kinds = b.kinds
    last = next(at for at in range(index, len(kinds)) if kinds[at] in (";", "{", END))
    signs = [at for at in range(index, last) if kinds[at] == "::" and kinds[at - 1] == kinds[at + 1] == "IDENT"]
    if not is_quiet:
        fix = Fix("write `.`", tuple(Edit(b.at(at), ".") for at in signs))
        b.report(EXPECTED, b.at(index), expected="`.`", found="`::`", help="write `.`", fixes=(fix,))
    for at in signs:
        kinds[at] = b.texts[at] = "."
